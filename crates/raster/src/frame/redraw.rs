//! Redraws a frame after a small change: few vertices run again, and few tiles are drawn.

use super::change::{DirtyTiles, Signature, can_follow};
use super::layout::Layout;
use super::set_up::SetUp;
use super::stages::{Arena, finish, prepare};
use super::touched::Found;
use super::{DrawChange, FrameOptions, Redraw};
use crate::bin::EarlierEntries;
use crate::clock::Clock;
use crate::ink::Ink;
use crate::pass::Pass;
use crate::view::FrameView;
use crate::{StageTimes, Target};
use std::sync::{Mutex, PoisonError};

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
    let (view, tiles) = match changes {
        Some(changes) => {
            let (view, tiles) = follow(arena, pass, (layout, target), changes, options);
            (view, Some(tiles))
        }
        None => (prepare(arena, pass, target, options), None),
    };
    let parts = match &tiles {
        Some(tiles) => tiles.iter().map(|&tile| view.drawn_rect(tile)).collect(),
        None => vec![view.drawn],
    };
    let stats = finish(&view, (tiles.as_deref(), target), options, &mut scratches);
    arena.scratches = scratches;
    // What was cancelled may be half done.
    arena.followed = (!options.is_cancelled()).then_some(signature);
    Redraw { stats, parts }
}

/// The same for a pass that differs little from the last one, and the tiles that may
/// differ.
fn follow<'f>(
    arena: &'f mut Arena,
    pass: &'f Pass<'_>,
    (layout, target): (Layout, &Target<'_>),
    changes: &[DrawChange<'_>],
    options: FrameOptions<'_>,
) -> (FrameView<'f>, Vec<u32>) {
    let (axis, grid) = (layout.axis, layout.grid);
    let has_lines = layout.ink.as_ref().is_some_and(Ink::has_lines);
    let Arena { plan, places, varyings, chunks, touched, .. } = arena;
    let used = chunks.len().min(plan.chunks);
    plan.update_points(&pass.draws, axis);
    let mut clock = Clock::new(options.timed);
    touched.mark(plan, changes);
    touched.run_vertices(&pass.draws, plan, grid.viewport, options, (places, varyings));
    let vertices = clock.lap();
    let tiles = DirtyTiles::new(&grid);
    let rest = Mutex::new(chunks[..used].iter_mut());
    let next = || rest.lock().unwrap_or_else(PoisonError::into_inner).next();
    let many = used > 1;
    let set_up = SetUp { pass: &pass.draws, plan, places, grid: &grid, axis, token: options.token };
    options.workers.run(many, |_| {
        let (mut found, mut earlier) = (Found::default(), EarlierEntries::default());
        while let Some(chunk) = next()
            && !options.is_cancelled()
        {
            touched.triangles(&pass.draws, plan, (changes, has_lines), chunk, &mut found);
            if found.any {
                tiles.add(&grid, chunk, &found.differ);
            }
            if found.any_moved {
                set_up.moved(chunk, &found.moved, &mut earlier);
                tiles.add(&grid, chunk, &found.differ);
            }
        }
    });
    let times = StageTimes { vertices, set_up: clock.lap(), ..StageTimes::default() };
    (arena.view((pass, target), layout, options, used, times), tiles.listed())
}
