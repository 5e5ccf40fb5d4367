//! Who is seen at each sample of a tile: opaque triangles, then masked ones, then what is shown
//! over them.

use super::cover::Cover;
use super::eight::Eight;
use super::micro::Covered;
use super::quad::QuadEdges;
use super::single::covering_apart;
use super::starts::Starts;
use super::ties::COMPARISON;
use super::{Counts, NOBODY, Surfaces, TileArea, TileState, VisibilityBuffer, masked};
use crate::Stats;
use crate::bin::Place;
use crate::frame::FrameView;
use crate::shade::Shading;
use crate::simd::{Each, LANES, Simd, at_level, lanes_of};
use crate::vertex::ScreenVertex;
use std::cell::Cell;

/// Finds the nearest opaque or masked triangle at every sample.
pub(crate) fn resolve_visibility(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    surfaces: &Surfaces,
    (shading, stats): (&mut Shading, &mut Stats),
) {
    let mut counts = Counts::default();
    if !surfaces.opaque.is_empty() {
        counts = cover_opaque(frame, area, state, surfaces.opaque.len());
    }
    state.buffer.settle();
    masked::cover_masked(frame, area, state, surfaces.masked.clone(), (shading, stats));
    state.buffer.blank_outside(area);
    if frame.timed {
        stats.samples_seen += state.buffer.seen() as u64;
    }
    stats.add_counts(&counts);
}

/// Lets what is shown over surfaces compete with them.
///
/// The buffer may not begin again as for [`cover_opaque`]: it holds what masks have let
/// through. So ties are decided one by one, however many there are.
pub(crate) fn cover_overlay(
    frame: &FrameView<'_>,
    area: &TileArea,
    state: &mut TileState,
    surfaces: &Surfaces,
    stats: &mut Stats,
) {
    if surfaces.overlay.is_empty() {
        return;
    }
    let TileState { places, buffer, ties, .. } = state;
    if !surfaces.masked.is_empty() {
        buffer.forget_nearest();
    }
    let precedes = |ours: u32, theirs: u32| frame.precedes(places[ours as usize], places[theirs as usize]);
    let cover = Cover {
        area: *area,
        offsets: frame.grid.pattern.offsets(),
        in_order: false,
        by_draws: true,
        ties,
        may_give_up: false,
        hierarchical: frame.hierarchical,
        precedes: &precedes,
    };
    let mut counts = Counts::default();
    let end = surfaces.overlay.end;
    cover_all(frame, &cover, (&places[..end], surfaces.overlay.start), (buffer, &mut counts));
    buffer.settle();
    buffer.blank_outside(area);
    stats.add_counts(&counts);
}

/// Lets the first so many of the tile's triangles compete.
fn cover_opaque(frame: &FrameView<'_>, area: &TileArea, state: &mut TileState, opaque: usize) -> Counts {
    let TileState { places, buffer, ties, key_order, reordered, .. } = state;
    let places = &places[..opaque];
    // Ties of one triangle are mostly with the same other one.
    let last = Cell::new(([NOBODY; 2], false));
    let precedes = |ours: u32, theirs: u32| {
        let (pair, wins) = last.get();
        if pair == [ours, theirs] {
            return wins;
        }
        ties.spend(COMPARISON);
        let wins = frame.precedes(places[ours as usize], places[theirs as usize]);
        last.set(([ours, theirs], wins));
        wins
    };
    let cover = Cover {
        area: *area,
        offsets: frame.grid.pattern.offsets(),
        in_order: frame.plan.ordinals_are_keys,
        by_draws: true,
        ties,
        may_give_up: true,
        hierarchical: frame.hierarchical,
        precedes: &precedes,
    };
    let mut counts = Counts::default();
    if cover_all(frame, &cover, (places, 0), (buffer, &mut counts)) {
        return counts;
    }
    key_order.sort(frame, places);
    reordered.clear();
    reordered.extend(key_order.of(places));
    buffer.clear(area, cover.offsets.len());
    counts = Counts { tiles_reordered: 1, ..Counts::default() };
    let cover = Cover { in_order: true, by_draws: false, ..cover };
    cover_all(frame, &cover, (reordered, 0), (buffer, &mut counts));
    buffer.settle();
    key_order.name_winners(buffer);
    counts
}

/// Lets triangles, from the one of this number on, compete one after the other; false if ties became too many.
fn cover_all(
    frame: &FrameView<'_>,
    cover: &Cover<'_>,
    (places, first): (&[Place], usize),
    (buffer, counts): (&mut VisibilityBuffer, &mut Counts),
) -> bool {
    at_level!(frame.token, simd => match frame.grid.pattern.count() {
        1 => cover_places::<_, false>(simd, frame, cover, (places, first), (buffer, counts)),
        _ => cover_places::<_, true>(simd, frame, cover, (places, first), (buffer, counts)),
    })
}

#[inline(always)]
fn cover_places<S: Simd, const MULTI: bool>(
    simd: S,
    frame: &FrameView<'_>,
    cover: &Cover<'_>,
    (places, first): (&[Place], usize),
    (buffer, counts): (&mut VisibilityBuffer, &mut Counts),
) -> bool {
    // A copy of its own, which may stay in registers.
    let cover = &{ *cover };
    let mut starts = Starts::new(cover.offsets);
    let mut covered = Covered::new();
    let mut edges = QuadEdges::new(frame.grid.pattern);
    let mut start = first;
    while start < places.len() {
        let together = side_by_side(frame, cover, &places[start..]);
        let eight = (together > 0).then(|| eight(simd, frame, cover, &places[start..start + together]));
        let mut end = start + together.max(1);
        if eight.is_none()
            && cover_quad::<S, MULTI>(
                simd,
                frame,
                cover,
                &mut edges,
                (places[start], start),
                (buffer, counts),
            )
        {
            // Both of its triangles.
            end += 1;
        } else if !MULTI && let Some(eight) = eight.as_ref().filter(|eight| eight.micro) {
            cover.micro(simd, (eight, &mut covered), start as u32, buffer, counts);
        } else {
            if let Some(eight) = &eight {
                starts.find::<S, MULTI>(simd, cover, eight);
            }
            for (lane, &place) in places[start..end].iter().enumerate() {
                let ready = eight.as_ref().map(|eight| (eight, &mut starts, lane));
                cover_one::<S, MULTI>(simd, frame, cover, ready, (place, start + lane), (buffer, counts));
            }
        }
        if !cover.in_order && cover.may_give_up && cover.ties.are_many() {
            return false;
        }
        start = end;
    }
    true
}

/// A line or a point of which this is the first triangle; false if it is not, or has to go the
/// way of triangles.
#[inline(always)]
fn cover_quad<S: Simd, const MULTI: bool>(
    simd: S,
    frame: &FrameView<'_>,
    cover: &Cover<'_>,
    edges: &mut QuadEdges,
    (place, number): (Place, usize),
    (buffer, counts): (&mut VisibilityBuffer, &mut Counts),
) -> bool {
    let first = place.is_first_half().then(|| frame.chunk_of(place));
    let Some(quad) = first.and_then(|chunk| chunk.quad(place)) else { return false };
    cover.quad::<S, MULTI>(simd, (quad, edges), number as u32, buffer, counts)
}

/// One triangle, perhaps a lane of eight that are ready.
#[inline(always)]
fn cover_one<S: Simd, const MULTI: bool>(
    simd: S,
    frame: &FrameView<'_>,
    cover: &Cover<'_>,
    ready: Option<(&Eight, &mut Starts, usize)>,
    (place, number): (Place, usize),
    (buffer, counts): (&mut VisibilityBuffer, &mut Counts),
) {
    let covering = match ready.filter(|(eight, _, lane)| eight.small >> lane & 1 != 0) {
        None => {
            let triangle = frame.triangle(place);
            if cover.tile_hides(buffer, triangle.nearest()) {
                counts.tiles_rejected += 1;
                return;
            }
            covering_apart(frame, &cover.area, &triangle)
        }
        Some((eight, starts, lane)) => {
            if eight.is_tiny(lane) {
                cover.tiny::<S, MULTI>(simd, (eight, starts, lane), number as u32, buffer, counts);
                return;
            }
            if cover.tile_hides(buffer, eight.high[lane]) {
                counts.tiles_rejected += 1;
                return;
            }
            eight.covering(lane, cover.offsets)
        }
    };
    if let Some(covering) = covering {
        cover.triangle::<S, MULTI>(simd, &covering, number as u32, buffer, counts);
    }
}

/// How many of the first of some triangles, up to eight, are whole primitives of one draw;
/// of any, if triangles are not in the order of draws.
#[inline(always)]
fn side_by_side(frame: &FrameView<'_>, cover: &Cover<'_>, places: &[Place]) -> usize {
    let first = places[0];
    if !first.is_whole() {
        return 0;
    }
    let end = if cover.by_draws { frame.plan.draws[frame.draw_of(first)].ordinals.end } else { u32::MAX };
    let belongs = |place: &Place| place.is_whole() && place.ordinal < end;
    places.iter().take(LANES).take_while(|place| belongs(place)).count()
}

/// Up to eight whole primitives; lanes to spare repeat the first.
#[inline(always)]
fn eight<S: Simd>(simd: S, frame: &FrameView<'_>, cover: &Cover<'_>, places: &[Place]) -> Eight {
    // Apart, so that each is compiled once.
    let (area, pattern) = (&cover.area, frame.grid.pattern);
    if cover.by_draws {
        simd.vectorize(
            #[inline(always)]
            || Eight::new(simd, area, pattern, (corners_of_one(frame, places), places.len())),
        )
    } else {
        simd.vectorize(
            #[inline(always)]
            || Eight::new(simd, area, pattern, (corners_of_several(frame, places), places.len())),
        )
    }
}

/// The vertices of up to eight whole primitives of one draw.
#[inline(always)]
fn corners_of_one<'f>(frame: &FrameView<'f>, places: &[Place]) -> [[&'f ScreenVertex; LANES]; 3] {
    let draw = frame.draw_of(places[0]);
    let plan = &frame.plan.draws[draw];
    let (vertices, geometry) = (frame.vertices(draw), &frame.pass[plan.draw].geometry);
    let corners: [[u32; 3]; LANES] = lanes_of(
        #[inline(always)]
        |lane| {
            let place = places.get(lane).unwrap_or(&places[0]);
            geometry.corners(place.ordinal - plan.ordinals.start)
        },
    );
    [0, 1, 2].each(
        #[inline(always)]
        |corner| {
            corners.each(
                #[inline(always)]
                |corners| vertices.get(corners[corner]),
            )
        },
    )
}

/// The vertices of up to eight whole primitives of several draws.
///
/// Not inlined: few tiles need it.
#[inline(never)]
fn corners_of_several<'f>(frame: &FrameView<'f>, places: &[Place]) -> [[&'f ScreenVertex; LANES]; 3] {
    let corners = lanes_of(|lane| frame.corners(*places.get(lane).unwrap_or(&places[0])));
    [0, 1, 2].each(|corner| corners.each(|corners| corners[corner]))
}
