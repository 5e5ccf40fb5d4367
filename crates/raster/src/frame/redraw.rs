//! Redraws a frame after a small change: few vertices run again, and few tiles are drawn.

use super::change::{Signature, can_follow};
use super::follow::Follow;
use super::layout::Layout;
use super::moving::Moving;
use super::set_up::SetUp;
use super::stages::{Arena, SomeTiles, finish, prepare};
use super::{DrawChange, FrameOptions, Redraw};
use crate::clock::Clock;
use crate::ink::Ink;
use crate::pass::Pass;
use crate::view::FrameView;
use crate::{StageTimes, Target};

/// Draws a pass into a target that holds an earlier frame. If `changes` lists how the pass differs
/// from the last one, only the tiles that may differ are drawn.
pub(crate) fn redraw(
    arena: &mut Arena,
    pass: &Pass<'_>,
    (target, changes): (&mut Target<'_>, Option<&[DrawChange<'_>]>),
    options: FrameOptions<'_>,
) -> Redraw {
    let layout = Layout::new(pass, target, options);
    let signature = Signature::new(pass, &layout, options.workers.count());
    let is_last = arena.followed.take().is_some_and(|last| last == signature);
    let changes = changes.filter(|changes| {
        let can_follow = || can_follow(&arena.plan, pass, changes);
        is_last && can_follow() && arena.plan.has_points_of(&pass.draws, layout.axis)
    });
    let mut scratches = std::mem::take(&mut arena.scratches);
    let mut moving = std::mem::take(&mut arena.moving);
    let (mut view, tiles) = match changes {
        Some(changes) => {
            let (view, tiles) = follow((arena, &mut moving), pass, (layout, target), changes, options);
            (view, Some(tiles))
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
    let some = tiles.as_deref().map(|numbers| SomeTiles { numbers, kept: moving.kept() });
    let stats = finish(&view, (some, target), options, &mut scratches);
    (arena.scratches, arena.moving) = (scratches, moving);
    // What was cancelled may be half done.
    arena.followed = (!options.is_cancelled()).then_some(signature);
    Redraw { stats, parts }
}

/// The same up to the tiles for a pass that differs little from the last one, and the tiles that may
/// differ.
fn follow<'f>(
    (arena, moving): (&'f mut Arena, &mut Moving),
    pass: &'f Pass<'_>,
    (layout, target): (Layout, &Target<'_>),
    changes: &[DrawChange<'_>],
    options: FrameOptions<'_>,
) -> (FrameView<'f>, Vec<u32>) {
    let (axis, grid) = (layout.axis, layout.grid);
    let Arena { plan, places, varyings, chunks, touched, .. } = arena;
    let used = chunks.len().min(plan.chunks);
    plan.update_points(&pass.draws, axis);
    let mut clock = Clock::new(options.timed);
    touched.mark(plan, changes);
    touched.run_vertices(&pass.draws, plan, grid.viewport, options, (places, varyings));
    let vertices = clock.lap();
    let follow = Follow {
        set_up: SetUp { pass: &pass.draws, plan, places, grid: &grid, axis, token: options.token },
        touched,
        changes,
        has_lines: layout.ink.as_ref().is_some_and(Ink::has_lines),
        may_part: layout.wants.bytes.is_some() && grid.pattern.count() == 1,
        options,
    };
    let tiles = follow.run(&mut chunks[..used], moving);
    let times = StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() };
    (arena.view((pass, target), layout, options, used, times), tiles)
}
