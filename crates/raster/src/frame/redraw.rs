//! Redraws a frame after a small change: few vertices run again, and few tiles are drawn.

use super::affected_primitives::AffectedSearch;
use super::change::{Signature, can_update};
use super::follow::PrimitiveUpdate;
use super::layout::Layout;
use super::moving::MovingPrimitives;
use super::set_up::SetUpContext;
use super::stages::{Arena, SomeTiles, VertexValues, finish, prepare};
use super::{DrawChange, FrameOptions, Redraw};
use crate::clock::Clock;
use crate::ink::Ink;
use crate::pass::Pass;
use crate::{StageTimes, Target};

/// Draws a pass into a target that holds an earlier frame. If `changes` lists how the pass differs
/// from the last one, only the tiles that may differ are drawn.
pub(crate) fn redraw(
    arena: &mut Arena,
    pass: &Pass<'_>,
    target: &mut Target<'_>,
    changes: Option<&[DrawChange<'_>]>,
    options: FrameOptions<'_>,
) -> Redraw {
    let layout = Layout::new(pass, target, options);
    let signature = Signature::new(pass, &layout, options.workers.count());
    let is_last = arena.last_signature.take().is_some_and(|last| last == signature);
    let changes = changes.filter(|changes| {
        let can_update = || can_update(&arena.plan, pass, changes);
        is_last && can_update() && arena.plan.has_points_of(&pass.draws, layout.axis)
    });
    let mut scratches = std::mem::take(&mut arena.scratches);
    let mut moving = std::mem::take(&mut arena.moving);
    let (mut view, tiles) = match changes {
        Some(changes) => {
            let UpdatedStages { tiles, times } = update(arena, &mut moving, pass, &layout, changes, options);
            (arena.view(pass, target, layout, options, times), Some(tiles))
        }
        None => {
            moving.clear();
            (prepare(arena, pass, target, options), None)
        }
    };
    view.moving = &moving.chunks;
    let parts = match &tiles {
        Some(tiles) => tiles.iter().map(|&tile| view.drawn_rect(tile)).collect(),
        None => vec![view.drawn],
    };
    let some = tiles.as_deref().map(|numbers| SomeTiles { numbers, cache: moving.cache() });
    let stats = finish(&view, some, target, options, &mut scratches);
    (arena.scratches, arena.moving) = (scratches, moving);
    // What was cancelled may be half done.
    arena.last_signature = (!options.is_cancelled()).then_some(signature);
    Redraw { stats, parts }
}

/// What is known when all before the tiles is done.
struct UpdatedStages {
    /// The tiles that may differ.
    tiles: Vec<u32>,
    times: StageTimes,
}

/// The stages up to the tiles for a pass that differs little from the last one.
fn update(
    arena: &mut Arena,
    moving: &mut MovingPrimitives,
    pass: &Pass<'_>,
    layout: &Layout,
    changes: &[DrawChange<'_>],
    options: FrameOptions<'_>,
) -> UpdatedStages {
    let (axis, grid) = (layout.axis, layout.grid);
    let Arena { plan, screen_vertices, varyings, chunks, changed_vertices, .. } = arena;
    plan.update_points(&pass.draws, axis);
    let mut clock = Clock::new(options.timed);
    changed_vertices.mark(plan, changes);
    changed_vertices.run(
        &pass.draws,
        plan,
        grid.viewport,
        options,
        VertexValues { screen_vertices, varyings },
    );
    let vertices = clock.lap();
    let update = PrimitiveUpdate {
        set_up: SetUpContext {
            pass: &pass.draws,
            plan,
            screen_vertices,
            grid: &grid,
            axis,
            token: options.token,
        },
        search: AffectedSearch {
            pass: &pass.draws,
            plan,
            vertices: changed_vertices,
            changes,
            has_edges: layout.ink.as_ref().is_some_and(Ink::has_lines),
        },
        may_part: layout.wants.bytes.is_some() && grid.pattern.count() == 1,
        options,
    };
    let tiles = update.run(&mut chunks[..plan.chunks], moving);
    UpdatedStages { tiles, times: StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() } }
}
