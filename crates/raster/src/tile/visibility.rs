//! Who is seen at each sample of a tile: opaque triangles, then masked ones.

use super::cover::Cover;
use super::eight::Eight;
use super::micro::Covered;
use super::starts::Starts;
use super::{Counts, Covering, Scratch, Surfaces, TileArea, VisibilityBuffer, masked};
use crate::bin::Place;
use crate::frame::FrameView;
use crate::setup::SetupTriangle;
use crate::simd::{Each, LANES, Simd, at_level, lanes_of};

/// Finds the nearest opaque or masked triangle at every sample.
pub(crate) fn resolve_visibility(
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    surfaces: &Surfaces,
) {
    let mut counts = Counts::default();
    if !surfaces.opaque.is_empty() {
        at_level!(frame.token, simd => match frame.grid.pattern.count() {
            1 => cover_opaque::<_, false>(simd, frame, area, scratch, (surfaces.opaque.len(), &mut counts)),
            _ => cover_opaque::<_, true>(simd, frame, area, scratch, (surfaces.opaque.len(), &mut counts)),
        });
    }
    scratch.buffer.settle();
    masked::cover_masked(frame, area, scratch, surfaces.masked.clone());
    scratch.buffer.blank_outside(area);
    if frame.timed {
        scratch.stats.samples_seen += scratch.buffer.seen() as u64;
    }
    scratch.stats.add_counts(&counts);
}

#[inline(always)]
fn cover_opaque<S: Simd, const MULTI: bool>(
    simd: S,
    frame: &FrameView<'_>,
    area: &TileArea,
    scratch: &mut Scratch,
    (opaque, counts): (usize, &mut Counts),
) {
    let Scratch { places, buffer, .. } = scratch;
    let precedes = |ours: u32, theirs: u32| frame.precedes(places[ours as usize], places[theirs as usize]);
    let cover = Cover {
        area: *area,
        offsets: frame.grid.pattern.offsets(),
        in_order: frame.plan.ordinals_are_keys,
        hierarchical: frame.hierarchical,
        precedes: &precedes,
    };
    let places = &places[..opaque];
    let mut starts = Starts::new(cover.offsets);
    let mut covered = Covered::new();
    let mut start = 0;
    while start < opaque {
        let together = side_by_side(frame, &places[start..]);
        let eight = (together > 0).then(|| eight(simd, frame, area, &places[start..start + together]));
        let end = start + together.max(1);
        if !MULTI && let Some(eight) = eight.as_ref().filter(|eight| eight.micro) {
            cover.micro(simd, (eight, &mut covered), start as u32, buffer, counts);
        } else {
            if let Some(eight) = &eight {
                starts.find::<S, MULTI>(simd, &cover, eight);
            }
            for (lane, &place) in places[start..end].iter().enumerate() {
                let ready = eight.as_ref().map(|eight| (eight, &mut starts, lane));
                cover_one::<S, MULTI>(simd, frame, &cover, ready, (place, start + lane), (buffer, counts));
            }
        }
        start = end;
    }
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

/// How many of the first of some triangles, up to eight, are whole primitives
/// of one draw.
#[inline(always)]
fn side_by_side(frame: &FrameView<'_>, places: &[Place]) -> usize {
    let first = places[0];
    if !first.is_whole() {
        return 0;
    }
    let end = frame.plan.draws[frame.draw_of(first)].ordinals.end;
    let belongs = |place: &Place| place.is_whole() && place.ordinal < end;
    places.iter().take(LANES).take_while(|place| belongs(place)).count()
}

/// Up to eight whole primitives of one draw; lanes to spare repeat the
/// first.
#[inline(always)]
fn eight<S: Simd>(simd: S, frame: &FrameView<'_>, area: &TileArea, places: &[Place]) -> Eight {
    // Apart, so that it is compiled once.
    simd.vectorize(
        #[inline(always)]
        || eight_apart(simd, frame, area, places),
    )
}

#[inline(always)]
fn eight_apart<S: Simd>(simd: S, frame: &FrameView<'_>, area: &TileArea, places: &[Place]) -> Eight {
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
    let columns = [0, 1, 2].each(
        #[inline(always)]
        |corner| {
            corners.each(
                #[inline(always)]
                |corners| vertices.get(corners[corner]),
            )
        },
    );
    Eight::new(simd, area, frame.grid.pattern, (columns, places.len()))
}

/// One triangle of the tile.
pub(crate) fn single(frame: &FrameView<'_>, area: &TileArea, place: Place) -> Option<Covering> {
    covering_apart(frame, area, &frame.triangle(place))
}

/// Not inlined, so that it is compiled once.
#[inline(never)]
fn covering_apart(frame: &FrameView<'_>, area: &TileArea, triangle: &SetupTriangle) -> Option<Covering> {
    Covering::new(triangle, &frame.grid, area)
}
