//! Who is seen at each sample of a tile: opaque triangles, then masked ones.

use super::cover::Cover;
use super::eight::Eight;
use super::{Counts, Covering, Scratch, Surfaces, TileArea, masked};
use crate::bin::Place;
use crate::frame::FrameView;
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
    let mut ready = Ready::default();
    for (number, &place) in places[..opaque].iter().enumerate() {
        if number == ready.end {
            ready.refill(simd, frame, area, &places[..opaque], number);
        }
        let covering = match ready.lane(number) {
            None => single(frame, area, place),
            Some((eight, lane)) => {
                if cover.tile_hides(buffer, eight.high[lane]) {
                    counts.tiles_rejected += 1;
                    continue;
                }
                if !MULTI && let Some(tiny) = eight.tiny(lane) {
                    cover.tiny(simd, &tiny, number as u32, buffer, counts);
                    continue;
                }
                eight.covering(lane, frame.grid.pattern)
            }
        };
        if let Some(covering) = covering {
            cover.triangle::<S, MULTI>(simd, &covering, number as u32, buffer, counts);
        }
    }
}

/// Triangles that were made ready together.
#[derive(Default)]
struct Ready {
    start: usize,
    end: usize,
    eight: Option<Eight>,
}

impl Ready {
    /// Makes the triangles from number `start` on ready, up to eight.
    #[inline(always)]
    fn refill<S: Simd>(
        &mut self,
        simd: S,
        frame: &FrameView<'_>,
        area: &TileArea,
        places: &[Place],
        start: usize,
    ) {
        let count = side_by_side(frame, &places[start..]);
        self.start = start;
        self.end = start + count.max(1);
        self.eight = match count {
            0 => None,
            _ => Some(eight(simd, frame, area, &places[start..start + count])),
        };
    }

    /// Where a triangle is, if it is small.
    #[inline(always)]
    fn lane(&self, number: usize) -> Option<(&Eight, usize)> {
        let lane = number - self.start;
        self.eight.as_ref().filter(|eight| eight.small >> lane & 1 != 0).map(|eight| (eight, lane))
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
    Eight::new(simd, area, frame.grid.pattern, columns)
}

/// One triangle of the tile.
#[inline(never)]
pub(super) fn single(frame: &FrameView<'_>, area: &TileArea, place: Place) -> Option<Covering> {
    Covering::new(&frame.triangle(place), &frame.grid, area)
}
