//! Outer ink: what the edges of a face cover of pixels in which the face is not visible.
//!
//! Let T be the triangle visible in a pixel (the farthest one, if its samples show several), and U a triangle visible
//! in another pixel, no farther away than a line reaches. The pixel shows the edges of U if both conditions hold:
//! 1. The pixel shows the background; or all of U lies in front of all of T; or T or U is large. If none of
//!    these holds, T and U are small neighbours in a dense mesh: the edge between them belongs to both, and
//!    each paints its own half.
//! 2. The point of the edge that is nearest to the pixel lies in front of the plane of T; or their faces have a vertex
//!    in common and T does not cover that point.
//!
//! All triangles of U's face count, because some may be slivers that cover no sample. The same holds for T's own
//! face.
//!
//! To find the pixels for which this is possible, rows of pixels are tested at once against the greatest depth around
//! each. Only these pixels look at their neighbours one by one. The result depends on what is visible around a pixel,
//! and not on tiles.

mod edged_face;
mod visible_rows;

pub(crate) use edged_face::{parts, slots};

use crate::bin::TriangleRef;
use crate::draw::Overlap;
use crate::ink::{EdgePoint, Ink, LARGE, OutlinedHalves, VisibleFaces};
use crate::simd::{F32, InlineMap, LANES, Simd, U32, at_level, inlined, prelude::*, unzipped};
use crate::tile_buffer::{MAX_SIDE, NO_TRIANGLE, PIXELS, TileArea, TileRows, VisibilityBuffer};
use crate::view::{FrameView, VisibleTile};
use edged_face::EdgedFace;
use std::ops::Range;
use visible_rows::{VisibleRows, beside_large, in_front};

/// Triangles that are kept ready: neighbouring pixels ask for the same ones.
const READY: usize = 16;

/// What outer halves of lines cover in a tile.
#[derive(Default)]
pub(crate) struct OuterInk {
    /// By the number of the pixel.
    covered: Vec<Overlap>,
    /// The pixels that something covers.
    touched: Vec<u32>,
    /// The triangles in the tile and its margin.
    faces: VisibleFaces,
    /// `None` until edges are painted.
    rows: Option<Box<VisibleRows>>,
    /// The lanes of each group that the tile draws itself.
    own: Vec<u8>,
    own_part: [Range<usize>; 2],
    /// Faces whose edges are examined, and faces over which they lie.
    ready: [ReadyFaces; 2],
}

/// Faces that are kept for the next pixels, with the indices of their triangles.
#[derive(Default)]
struct ReadyFaces(Vec<(u32, EdgedFace)>);

impl OuterInk {
    /// Starts a tile with this many triangles.
    pub(crate) fn begin(&mut self, triangle_count: usize) {
        self.covered.resize(PIXELS, Overlap::default());
        for pixel in self.touched.drain(..) {
            self.covered[pixel as usize] = Overlap::default();
        }
        self.faces.begin(triangle_count);
    }

    /// Where the triangles of the tile and its margin are recorded.
    pub(crate) fn faces_mut(&mut self) -> &mut VisibleFaces {
        &mut self.faces
    }

    /// The lanes of each group of a tile that the tile draws itself; all that is beside is
    /// drawn by its neighbours.
    pub(crate) fn own_lanes(&mut self, frame: &FrameView<'_>, area: &TileArea) -> &[u8] {
        let part = frame.own_part(area);
        if self.own.is_empty() || self.own_part != part {
            let [columns, rows] = &part;
            let lanes = |group: usize| {
                (0..LANES).fold(0, |lanes, lane| {
                    let [x, y] = TileArea::pixel_at(group * LANES + lane);
                    lanes | u8::from(columns.contains(&x) && rows.contains(&y)) << lane
                })
            };
            self.own.clear();
            self.own.extend((0..PIXELS / LANES).map(lanes));
            self.own_part = part;
        }
        &self.own
    }

    /// Whether anything is covered.
    pub(crate) fn is_empty(&self) -> bool {
        self.touched.is_empty()
    }

    /// What is covered, by the number of the pixel; `None` if nothing is.
    pub(crate) fn covered(&self) -> Option<&[Overlap]> {
        (!self.is_empty()).then_some(&self.covered)
    }

    /// What is covered of a pixel by its number.
    #[inline(always)]
    pub(crate) fn at(&self, pixel: usize) -> Overlap {
        if self.is_empty() { Overlap::default() } else { self.covered[pixel] }
    }

    /// Finds what lines cover beyond their triangles, of some pixels if it is known which are asked for, and which are those
    /// or within reach of them. All triangles that are visible in the latter must have been noted.
    pub(crate) fn find(
        &mut self,
        frame: &FrameView<'_>,
        ink: &Ink,
        tile: VisibleTile<'_>,
        requested: Option<[&TileRows; 2]>,
    ) {
        if !self.faces.has_lines {
            return;
        }
        self.own_lanes(frame, tile.area);
        let reach = ink.reach() as usize;
        let mut rows = self.rows.take().unwrap_or_else(VisibleRows::new);
        const ALL: TileRows = [u64::MAX; MAX_SIDE];
        let [requested, near] = requested.unwrap_or([&ALL; 2]);
        let found = at_level!(frame.token, simd => {
            self.spread(simd, tile, near, &mut rows);
            self.candidates(simd, tile.area, &rows, requested, reach)
        });
        self.ready.iter_mut().for_each(ReadyFaces::clear);
        for y in self.own_part[1].clone() {
            let mut rest = found[y];
            while rest != 0 {
                let x = rest.trailing_zeros() as usize;
                rest &= rest - 1;
                self.cover(frame, ink, tile, &rows, [x, y]);
            }
        }
        self.rows = Some(rows);
    }

    /// The requested pixels that lines of others may cover: a bit for each column of each row.
    #[inline(always)]
    fn candidates<S: Simd>(
        &self,
        simd: S,
        area: &TileArea,
        visible: &VisibleRows,
        requested: &TileRows,
        reach: usize,
    ) -> TileRows {
        let [columns, rows] = self.own_part.clone();
        let own = (u64::MAX >> (MAX_SIDE - columns.len())) << columns.start;
        let mut found = [0; MAX_SIDE];
        for y in rows.filter(|&y| requested[y] != 0) {
            let around = y.saturating_sub(reach)..(y + reach + 1).min(area.size[1]);
            let mut bits = in_front(simd, visible, y, around.clone(), reach);
            if self.faces.has_large {
                bits |= beside_large(simd, visible, y, around, reach);
            }
            found[y] = bits & own & requested[y];
        }
        found
    }

    /// Lays what pixels see out in rows. Where no column of a group is `near` what is asked for, anything may stay.
    #[inline(always)]
    fn spread<S: Simd>(&self, simd: S, tile: VisibleTile<'_>, near: &TileRows, rows: &mut VisibleRows) {
        let area = tile.area;
        if area.padded() != [MAX_SIDE; 2] {
            rows.least.fill([f32::NEG_INFINITY; MAX_SIDE]);
            rows.large.fill([0.0; MAX_SIDE]);
            rows.nearest.fill([NO_TRIANGLE; MAX_SIDE]);
        }
        let [columns, height] = area.padded();
        for (y, x) in (0..height).step_by(2).flat_map(|y| (0..columns).step_by(4).map(move |x| (y, x))) {
            if (near[y] | near[y + 1]) >> x & 0xf == 0 {
                continue;
            }
            self.spread_group(simd, tile, rows, [x, y]);
        }
    }

    /// Does so for a group of pixels, the first of which is in column `x` and row `y`.
    #[inline(always)]
    fn spread_group<S: Simd>(
        &self,
        simd: S,
        VisibleTile { buffer, triangles, .. }: VisibleTile<'_>,
        rows: &mut VisibleRows,
        [x, y]: [usize; 2],
    ) {
        let [nearest, farthest] = ends(buffer, TileArea::group_of([x / 4, y / 2]));
        // The background comes after all triangles.
        let indices = inlined(
            #[inline(always)]
            |visible: [u32; LANES]| {
                <[u32; LANES]>::from(U32::simd_from(simd, visible).min(triangles.len() as u32))
            },
        );
        let depths = inlined(
            #[inline(always)]
            |visible: [u32; LANES]| {
                let ranges = indices(visible).each(
                    #[inline(always)]
                    |index| self.faces.depths[index as usize].bits(),
                );
                unzipped(simd, ranges).each(
                    #[inline(always)]
                    |depths| <[f32; LANES]>::from(depths.bitcast::<F32<S>>()),
                )
            },
        );
        let [least, mut greatest] = depths(nearest);
        if buffer.samples > 1 {
            [_, greatest] = depths(farthest);
        }
        put(&mut rows.least, [x, y], least);
        put(&mut rows.greatest, [x, y], greatest);
        put(&mut rows.nearest, [x, y], nearest);
        put(&mut rows.farthest, [x, y], farthest);
        if self.faces.has_large {
            let is_large = |index: u32| self.faces.lines[index as usize].radius >= LARGE;
            let large = indices(nearest).each(|index| f32::from(u8::from(is_large(index))));
            put(&mut rows.large, [x, y], large);
        }
    }

    /// Finds what lines of others cover of a pixel.
    fn cover(
        &mut self,
        frame: &FrameView<'_>,
        ink: &Ink,
        VisibleTile { area, triangles, .. }: VisibleTile<'_>,
        rows: &VisibleRows,
        [x, y]: [usize; 2],
    ) {
        let reach = ink.reach() as usize;
        let own = rows.farthest[y][x];
        let point = area.point([x as i32, y as i32], [128, 128]);
        let mut most = self.cover_by_own(frame, ink, triangles, own, point);
        let mut last = own;
        let columns = x.saturating_sub(reach)..(x + reach + 1).min(area.size[0]);
        for row in y.saturating_sub(reach)..(y + reach + 1).min(area.size[1]) {
            for column in columns.clone() {
                let other = rows.nearest[row][column];
                // Most often the same as before.
                if other == last || other == own || other == NO_TRIANGLE {
                    continue;
                }
                last = other;
                let covered = self.cover_by(frame, ink, triangles, [other, own], point);
                most = most.or(covered);
            }
        }
        if most.share > 0.0 {
            let pixel = TileArea::index_of([x, y]);
            self.covered[pixel] = most;
            self.touched.push(pixel as u32);
        }
    }

    /// The coverage of a pixel by lines of its own face, other than those of its visible triangle: only if
    /// that is large, as for other triangles.
    fn cover_by_own(
        &mut self,
        frame: &FrameView<'_>,
        ink: &Ink,
        triangles: &[TriangleRef],
        own: u32,
        point: [i32; 2],
    ) -> Overlap {
        if own == NO_TRIANGLE || self.faces.lines[own as usize].radius < LARGE {
            return Overlap::default();
        }
        let line = self.faces.lines[own as usize];
        let ground = self.ready[1].face(frame, triangles, own);
        if !ground.has_parts() {
            return Overlap::default();
        }
        let outlined = OutlinedHalves::on(ink, line.radius);
        let overlap = |edge: EdgePoint| line.overlap(&edge, ink.is_outlined(edge.mark).then_some(outlined));
        ground.nearest(point).map(overlap).fold(Overlap::default(), Overlap::or)
    }

    /// The coverage of a pixel by lines of a triangle other than its visible one.
    fn cover_by(
        &mut self,
        frame: &FrameView<'_>,
        ink: &Ink,
        triangles: &[TriangleRef],
        [other, own]: [u32; 2],
        point: [i32; 2],
    ) -> Overlap {
        let index = |triangle: u32| (triangle as usize).min(triangles.len());
        let [ours, theirs] = [own, other].map(|triangle| self.faces.lines[index(triangle)]);
        let least = self.faces.depths[index(other)].least;
        let is_before = least > self.faces.depths[index(own)].greatest;
        let is_large = ours.radius >= LARGE || theirs.radius >= LARGE;
        if !(is_before || (is_large && least > f32::NEG_INFINITY)) {
            return Overlap::default();
        }
        let [others, grounds] = &mut self.ready;
        let lined = others.face(frame, triangles, other);
        let ground = (own != NO_TRIANGLE).then(|| grounds.face(frame, triangles, own));
        let are_joined = ground.is_some_and(|ground| ground.shares_a_vertex(lined));
        let line = if are_joined { theirs.narrower(ours) } else { theirs };
        let is_narrower = are_joined && ours.half.is_finite() && ours.radius < theirs.radius;
        let outlined = OutlinedHalves::on(ink, if is_narrower { ours.radius } else { theirs.radius });
        lined.nearest(point).fold(Overlap::default(), |most, edge| {
            let covered = line.overlap(&edge, ink.is_outlined(edge.mark).then_some(outlined));
            let is_visible = || {
                ground.is_none_or(
                    |ground| {
                        if are_joined { !ground.hides(&edge) } else { ground.is_behind(&edge) }
                    },
                )
            };
            if covered.is_above(most) && is_visible() { covered } else { most }
        })
    }
}

impl ReadyFaces {
    /// Forgets all, and keeps their memory.
    fn clear(&mut self) {
        self.0.resize_with(READY, || (NO_TRIANGLE, EdgedFace::default()));
        self.0.iter_mut().for_each(|(index, _)| *index = NO_TRIANGLE);
    }

    /// The face of a triangle of the tile.
    fn face(&mut self, frame: &FrameView<'_>, triangles: &[TriangleRef], index: u32) -> &EdgedFace {
        let (of, face) = &mut self.0[index as usize % READY];
        if *of != index {
            face.set(frame, triangles[index as usize]);
            *of = index;
        }
        face
    }
}

/// Puts the values of a group of pixels into the rows of a tile; `x` and `y` are those of its first pixel.
#[inline(always)]
fn put<T: Copy>(rows: &mut [[T; MAX_SIDE]; MAX_SIDE], [x, y]: [usize; 2], values: [T; LANES]) {
    let (upper, lower) = values.split_at(LANES / 2);
    rows[y][x..x + LANES / 2].copy_from_slice(upper);
    rows[y + 1][x..x + LANES / 2].copy_from_slice(lower);
}

/// The nearest and the farthest triangles that the samples of the pixels of a group see.
#[inline(always)]
fn ends(buffer: &VisibilityBuffer, group: usize) -> [[u32; LANES]; 2] {
    let samples = group * buffer.samples..(group + 1) * buffer.samples;
    let visible = &buffer.visible().as_chunks::<LANES>().0[samples.clone()];
    if let [visible] = visible {
        return [*visible; 2];
    }
    let depth = &buffer.depth.as_chunks::<LANES>().0[samples];
    let (mut ends, mut depths) = ([visible[0]; 2], [depth[0]; 2]);
    for (visible, depth) in visible.iter().zip(depth).skip(1) {
        for lane in 0..LANES {
            if depth[lane] > depths[0][lane] {
                (ends[0][lane], depths[0][lane]) = (visible[lane], depth[lane]);
            }
            if depth[lane] < depths[1][lane] {
                (ends[1][lane], depths[1][lane]) = (visible[lane], depth[lane]);
            }
        }
    }
    ends
}
