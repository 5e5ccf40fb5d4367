//! Decides which points of elements are hidden by faces that the elements do not belong to.
//!
//! The points are sorted into pixels. Every drawn triangle then tests the points in the pixels around the triangle. The
//! triangle hides the points that it covers on the screen and that lie behind it. Each triangle is read once, and a
//! triangle as small as a pixel tests few points, so the time grows with triangles plus points, not with their product.
//! Points are tested in f64 at their own positions, never at pixel centres. Quick tests come first (`occluders`).

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use trigon_math::DVec2;
use trigon_math::at_level;
use trigon_math::simd::Token;
use trigon_raster::simd::Simd;

use super::forms::Forms;
use super::nearby::{Nearby, NearbyTriangles};
use super::object::Facing;
use super::object::PickObject;
use super::occluders::{Around, Extent, Group, Pixels};
use super::occluders::{Probe, Probes};
use super::region::Area;
use super::screen::{Screen, Spot, doubled_area};
use crate::frame::Frame;

/// Triangles that a thread takes at a time.
const TRIANGLES: usize = 4096;

/// Rows of pixels whose points a thread sorts at a time.
const BAND: u32 = 16;

/// A point of an element that lies in a region.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) spot: Spot,
    /// The index of the node.
    pub(super) object: u32,
    pub(super) element: u32,
}

/// The points of elements, sorted by the pixels that they lie in.
pub(super) struct Hiding<'p> {
    frame: &'p Frame,
    columns: Range<u32>,
    rows: Range<u32>,
    bands: Vec<Band>,
}

/// The points in some rows of pixels.
struct Band {
    /// For each pixel where its points begin, and the end of the last one's.
    starts: Vec<u32>,
    points: Vec<Candidate>,
    probes: Probes,
    hidden: Vec<AtomicBool>,
}

impl<'p> Hiding<'p> {
    /// The candidates, in any number of lists, have to lie in the area. There have to be
    /// fewer than `u32::MAX` of them.
    pub(super) fn new(screen: &Screen, frame: &'p Frame, area: &Area<'_>, lists: &[Vec<Candidate>]) -> Self {
        let (columns, rows) = (area.columns.clone(), area.rows.clone());
        let band = |candidate: &Candidate| (candidate.spot.at.y as u32 - rows.start) / BAND;
        let band_count = rows.len().div_ceil(BAND as usize);
        let sorted: Vec<Sorted> =
            lists.par_iter().map(|list| Sorted::new(band_count, list.iter().map(band).collect())).collect();
        let points_of = |band: usize| -> Vec<&Candidate> {
            let parts = lists.iter().zip(&sorted);
            parts.flat_map(|(list, sorted)| sorted.of(band).iter().map(|&at| &list[at as usize])).collect()
        };
        let bands = (0..band_count as u32).into_par_iter().map(|band| {
            let first = rows.start + band * BAND;
            Band::new(screen, [columns.start, first], columns.len(), &points_of(band as usize))
        });
        let bands = bands.collect();
        Self { frame, columns, rows, bands }
    }

    /// Lets the faces of an object hide points. `is_own` tells whether a candidate
    /// belongs to a face of that object.
    pub(super) fn hide(&self, nearby: &Nearby<'_>, is_own: impl Fn(u32, &Candidate) -> bool + Sync) {
        let Some(triangles) = nearby.triangles() else { return };
        let level = Token::best();
        for (facing, run) in triangles.drawn.runs() {
            let wins = |face: u32, at: DVec2| facing.is_opaque || self.wins(nearby.object, face, at);
            let hides = |face: u32, point: &Candidate| wins(face, point.spot.at) && !is_own(face, point);
            let indices = triangles.indices(run);
            let starts: Vec<usize> = indices.clone().step_by(TRIANGLES).collect();
            starts.into_par_iter().for_each(|start| {
                let share = start..indices.end.min(start + TRIANGLES);
                at_level!(level, simd => self.visit_all(simd, &triangles, facing, share, &hides));
            });
        }
    }

    /// What is asked of the candidates that nothing hides, in lists.
    pub(super) fn visible<T: Send>(&self, visit: impl Fn(&Candidate) -> T + Sync) -> Vec<Vec<T>> {
        let of_band = |band: &Band| {
            let points = band.points.iter().zip(&band.hidden);
            let visible = points.filter(|(_, hidden)| !hidden.load(Ordering::Relaxed));
            visible.map(|(point, _)| visit(point)).collect()
        };
        self.bands.par_iter().map(of_band).collect()
    }

    /// Whether the image shows a face in the pixel of a point.
    fn wins(&self, object: &PickObject<'_>, face: u32, at: DVec2) -> bool {
        let pixel = at.y as usize * self.frame.width as usize + at.x as usize;
        let id = |ids: &Option<Vec<u32>>| ids.as_ref().and_then(|ids| ids.get(pixel).copied());
        id(&self.frame.object_ids) == Some(object.node.index() as u32)
            && id(&self.frame.face_ids) == Some(face)
    }

    fn visit_all<S: Simd>(
        &self,
        simd: S,
        triangles: &NearbyTriangles<'_>,
        facing: Facing,
        indices: Range<usize>,
        hides: &impl Fn(u32, &Candidate) -> bool,
    ) {
        let mut group = Group::new();
        for index in indices {
            triangles.pieces(index, |piece| {
                let [a, b, c] = piece;
                if !facing.draws(doubled_area([a.at, b.at, c.at])) {
                    return;
                }
                let extent = Extent::new(piece);
                let Some(pixels) = extent.pixels(&self.columns, &self.rows) else { return };
                if !group.takes(&pixels) {
                    self.visit(simd, &group, hides);
                    group.clear();
                }
                let face = triangles.drawn.face(triangles.number(index));
                group.push(piece, face, extent, pixels);
            });
        }
        self.visit(simd, &group, hides);
    }

    /// Lets the triangles of a group hide the points in the pixels around them.
    fn visit<S: Simd>(&self, simd: S, group: &Group, hides: &impl Fn(u32, &Candidate) -> bool) {
        let Some(Around { pixels, extent }) = group.around() else { return };
        simd.vectorize(
            #[inline(always)]
            || {
                let mut forms = None;
                for row in pixels.rows.clone() {
                    let band = &self.bands[(row / BAND) as usize];
                    let numbers = band.points_of(row % BAND, &pixels.columns, self.columns.len());
                    band.probes.for_each_hidden(
                        simd,
                        extent,
                        numbers,
                        #[inline(always)]
                        |number| {
                            if band.hidden[number].load(Ordering::Relaxed) {
                                return;
                            }
                            let forms = forms.get_or_insert_with(
                                #[inline(always)]
                                || {
                                    let (origin, reach) = self.around(pixels);
                                    Forms::new(simd, &group.pieces, origin, reach)
                                },
                            );
                            let bits = forms.that_may_hide(simd, band.probes.get(number)) & group.bits();
                            if bits != 0 && band.is_hidden(number, group, bits, hides) {
                                band.hidden[number].store(true, Ordering::Relaxed);
                            }
                        },
                    );
                }
            },
        );
    }

    /// The upper left corner of some pixels, and how far they go from there.
    fn around(&self, pixels: &Pixels) -> (DVec2, DVec2) {
        let corner = |columns: u32, rows: u32| DVec2::new(columns.into(), rows.into());
        let first = corner(self.columns.start, self.rows.start);
        let start = corner(pixels.columns.start, pixels.rows.start);
        (first + start, corner(pixels.columns.end, pixels.rows.end) - start)
    }
}

impl Band {
    /// `left` and `top` are its first pixel.
    fn new(screen: &Screen, [left, top]: [u32; 2], columns: usize, points: &[&Candidate]) -> Self {
        let pixel = |point: &&Candidate| {
            let [x, y] = point.spot.at.to_array().map(|at| at as u32);
            (y - top) * columns as u32 + (x - left)
        };
        let Sorted { starts, order } =
            Sorted::new(columns * BAND as usize, points.iter().map(pixel).collect());
        let points: Vec<Candidate> = order.iter().map(|&number| *points[number as usize]).collect();
        let probes = Probes::new(screen, points.iter().map(|point| &point.spot));
        let hidden = points.iter().map(|_| AtomicBool::new(false)).collect();
        Self { starts, points, probes, hidden }
    }

    /// Whether one of some triangles hides a point: the exact test.
    #[inline(never)]
    fn is_hidden(
        &self,
        number: usize,
        group: &Group,
        mut bits: u64,
        hides: &impl Fn(u32, &Candidate) -> bool,
    ) -> bool {
        let Probe { at, hiding_depth } = *self.probes.get(number);
        while bits != 0 {
            let (piece, face) = group.get(bits.trailing_zeros() as usize);
            let is_behind = depth_at(&piece, at).is_some_and(|depth| depth > hiding_depth);
            if is_behind && hides(face, &self.points[number]) {
                return true;
            }
            bits &= bits - 1;
        }
        false
    }

    /// The points of some pixels of a row, both counted from the first.
    #[inline]
    fn points_of(&self, row: u32, pixels: &Range<u32>, columns: usize) -> Range<usize> {
        let first = row as usize * columns;
        let [start, end] =
            [pixels.start, pixels.end].map(|pixel| self.starts[first + pixel as usize] as usize);
        start..end
    }
}

/// Numbers of things, sorted by their keys; of equal keys in their order.
struct Sorted {
    /// For each key where its things begin, and the end of the last one's.
    starts: Vec<u32>,
    order: Vec<u32>,
}

impl Sorted {
    /// `keys` has the key of each thing, less than `count`.
    fn new(count: usize, keys: Vec<u32>) -> Self {
        let mut starts = vec![0_u32; count + 1];
        keys.iter().for_each(|&key| starts[key as usize] += 1);
        let mut end = 0;
        for start in &mut starts {
            end += *start;
            *start = end;
        }
        // Now each is where the next key's things begin; they are put in from the back.
        let mut order = vec![0; keys.len()];
        for (number, &key) in keys.iter().enumerate().rev() {
            let start = &mut starts[key as usize];
            *start -= 1;
            order[*start as usize] = number as u32;
        }
        Self { starts, order }
    }

    fn of(&self, key: usize) -> &[u32] {
        &self.order[self.starts[key] as usize..self.starts[key + 1] as usize]
    }
}

/// How deep a triangle is at a point of the screen; `None` where it is not.
#[inline]
pub(super) fn depth_at(piece: &[Spot; 3], at: DVec2) -> Option<f64> {
    let [a, b, c] = piece.map(|spot| spot.at - at);
    // Twice the areas between the point and each side: the shares of the corners.
    let shares = [b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)];
    let inside = shares.iter().all(|&share| share >= 0.0) || shares.iter().all(|&share| share <= 0.0);
    let sum: f64 = shares.iter().sum();
    if !inside || sum == 0.0 {
        return None;
    }
    let [a, b, c] = piece.map(|spot| spot.depth);
    Some((shares[0] * a + shares[1] * b + shares[2] * c) / sum)
}
