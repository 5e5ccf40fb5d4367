//! How a picker goes through pixels, triangles and points.

use std::ops::{ControlFlow, Range};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;
use trigon_math::DVec2;

use super::covering::Centers;
use super::elements::Sets;
use super::hiding::{Candidate, Hiding};
use super::kind::Kind;
use super::nearest::Best;
use super::object::{Object, objects};
use super::outline::Outline;
use super::picker::{Picker, Reach};
use super::region::{Area, Region, center};
use crate::elements::ElementSet;
use crate::frame::Hit;

/// Elements whose points are found at a time. An edge may have as many points as the
/// picture has columns, and those of these are held in memory.
const ELEMENTS: usize = 1 << 14;

/// Of those, elements that a thread takes at a time.
const SHARE: usize = 1 << 11;

/// Once there are so many points, it is decided which of them are hidden: 128 MB.
const POINTS: usize = 1 << 22;

/// Triangles that a thread takes at a time.
const TRIANGLES: usize = 4096;

impl<'p> Picker<'p> {
    pub(super) fn area<'r>(&self, region: &'r Region) -> Area<'r> {
        Area::new(region, self.projector.viewport())
    }

    /// By the indices of their nodes.
    pub(super) fn objects(&self) -> &[Option<Object<'p>>] {
        self.objects.get_or_init(|| objects(self.scene, &self.screen))
    }

    /// The polygon of a hit on the screen; `None` for lines and points.
    pub(super) fn outline(&self, hit: &Hit) -> Option<Outline<'_>> {
        let object = self.objects().get(hit.node.index())?.as_ref()?;
        let face = hit.face.filter(|&face| face < object.mesh().face_count())?;
        Some(Outline::new(object.mesh(), face, &self.projector, |vertex| object.place(vertex)))
    }

    /// The vertices or edges that are hit in a region.
    pub(super) fn elements(&self, kind: Kind, region: &Region, reach: Reach) -> ElementSet {
        let mut sets = Sets::new(self.objects(), move |mesh| kind.count(mesh));
        self.points(kind, &self.area(region), reach, |point| sets.insert(point.object, point.element));
        sets.finish()
    }

    /// Calls `found` with the points of elements that are hit in an area.
    pub(super) fn points(
        &self,
        kind: Kind,
        area: &Area<'_>,
        reach: Reach,
        mut found: impl FnMut(&Candidate),
    ) {
        let mut points = Vec::new();
        let mut decide = |points: &mut Vec<Candidate>| {
            match reach {
                Reach::Through => points.iter().for_each(&mut found),
                Reach::Visible => self.visible(kind, area, points, &mut found),
            }
            points.clear();
        };
        for object in self.objects().iter().flatten().filter(|_| !area.is_empty()) {
            let count = kind.count(object.mesh());
            for start in (0..count).step_by(ELEMENTS) {
                let part = start..count.min(start + ELEMENTS);
                let shares: Vec<Vec<Candidate>> = shares(part)
                    .into_par_iter()
                    .map(|share| kind.candidates(object, &self.screen, area, share))
                    .collect();
                points.extend(shares.into_iter().flatten());
                if points.len() >= POINTS {
                    decide(&mut points);
                }
            }
        }
        decide(&mut points);
    }

    /// Those of some points that no face hides but their own.
    fn visible(&self, kind: Kind, area: &Area<'_>, points: &[Candidate], found: &mut impl FnMut(&Candidate)) {
        if points.is_empty() {
            return;
        }
        let hiding = Hiding::new((&self.screen, self.frame), area, points);
        for object in self.objects().iter().flatten() {
            let index = object.node.index() as u32;
            hiding.hide(object, |face, number| {
                let point = &points[number as usize];
                point.object == index && kind.belongs(object.mesh(), face, point.element)
            });
        }
        hiding.seen().for_each(|number| found(&points[number]));
    }

    /// The place of a pixel in the lists of a frame.
    pub(super) fn pixel(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.frame.width as usize + x as usize
    }

    /// Calls `found` with each face that wins a pixel whose centre lies in an area, for
    /// neighbouring pixels in a row once: the index of its node, its own, and the pixel.
    pub(super) fn winners(&self, area: &Area<'_>, mut found: impl FnMut(u32, u32, [u32; 2])) {
        let (Some(objects), Some(faces)) = (&self.frame.object_ids, &self.frame.face_ids) else { return };
        for row in area.rows.clone() {
            for run in area.runs(row) {
                let [start, end] = [run.start, run.end].map(|column| self.pixel([column, row]));
                let ids = objects[start..end].iter().zip(&faces[start..end]);
                let mut last = [u32::MAX; 2];
                for (column, (&object, &face)) in run.zip(ids) {
                    if [object, face] != last && face != u32::MAX {
                        found(object, face, [column, row]);
                    }
                    last = [object, face];
                }
            }
        }
    }

    /// The faces that cover a pixel's centre.
    pub(super) fn faces_through(&self, centers: &Centers) -> ElementSet {
        let mut sets = ElementSet::default();
        for object in self.objects().iter().flatten() {
            let none = || FixedBitSet::with_capacity(object.mesh().face_count());
            let add = |set: &mut FixedBitSet, face: u32, _: [u32; 2], _: f64| {
                set.insert(face as usize);
                ControlFlow::Break(())
            };
            let known = |set: &FixedBitSet, face: u32| set.contains(face as usize);
            let merged = |mut one: FixedBitSet, other: FixedBitSet| {
                one.union_with(&other);
                one
            };
            sets.add(object.node, self.covered(centers, object, Visit { none, known, add, merged }));
        }
        sets
    }

    /// The face of whose pixels' centres one is nearest to a point.
    pub(super) fn nearest_face(&self, target: DVec2, area: &Area<'_>, reach: Reach) -> Best {
        let mut best = Best::new(target);
        match reach {
            Reach::Visible => {
                let of = |object: u32| self.objects().get(object as usize).and_then(Option::as_ref);
                for_each_pixel(area, |[x, y]| {
                    let Some(hit) = self.frame.hit(self.scene.nodes(), x, y) else { return };
                    let (object, face) = (hit.node.index() as u32, hit.face);
                    let face =
                        face.filter(|&face| of(object).is_some_and(|of| face < of.mesh().face_count()));
                    if let Some(face) = face {
                        best.offer(center(x, y), 0.0, object, face as u32);
                    }
                });
            }
            Reach::Through => {
                let centers = Centers::new(area);
                for object in self.objects().iter().flatten() {
                    let index = object.node.index() as u32;
                    let none = || Best::new(target);
                    let add = |best: &mut Best, face: u32, [x, y]: [u32; 2], depth: f64| {
                        best.offer(center(x, y), depth, index, face);
                        ControlFlow::Continue(())
                    };
                    let known = |_: &Best, _: u32| false;
                    let visit = Visit { none, known, add, merged: Best::merged };
                    best = best.merged(self.covered(&centers, object, visit));
                }
            }
        }
        best
    }

    /// Visits the pixels that an object's faces cover, on all threads.
    fn covered<T: Send>(
        &self,
        centers: &Centers,
        object: &Object<'_>,
        visit: Visit<
            impl Fn() -> T + Sync + Send,
            impl Fn(&T, u32) -> bool + Sync + Send,
            impl Fn(&mut T, u32, [u32; 2], f64) -> ControlFlow<()> + Sync + Send,
            impl Fn(T, T) -> T + Sync + Send,
        >,
    ) -> T {
        let Visit { none, known, add, merged } = visit;
        let Some(drawn) = object.drawn().filter(|_| !centers.is_empty()) else { return none() };
        let corners = drawn.corners(&self.screen);
        let triangles = (0..drawn.triangle_count()).into_par_iter().with_min_len(TRIANGLES);
        let visited = triangles.fold(&none, |mut found, triangle| {
            let face = drawn.face(triangle);
            if !known(&found, face) {
                drawn.pieces((&self.screen, corners), triangle, |piece| {
                    let _ = centers.covered(piece, |pixel, depth| add(&mut found, face, pixel, depth));
                });
            }
            found
        });
        visited.reduce(&none, merged)
    }
}

/// What to do with faces that are visited by several threads: what there is before the
/// first, whether a face need not be visited any more, what to do with a pixel that it
/// covers, and how to bring together what two threads have found. The last must not
/// depend on their order.
struct Visit<N, K, A, M> {
    none: N,
    known: K,
    add: A,
    merged: M,
}

/// A range in parts.
fn shares(range: Range<usize>) -> Vec<Range<usize>> {
    let end = range.end;
    range.step_by(SHARE).map(|start| start..end.min(start + SHARE)).collect()
}

/// Calls `visit` with each pixel whose centre lies in an area.
pub(super) fn for_each_pixel(area: &Area<'_>, mut visit: impl FnMut([u32; 2])) {
    for row in area.rows.clone() {
        area.runs(row).into_iter().flatten().for_each(|column| visit([column, row]));
    }
}
