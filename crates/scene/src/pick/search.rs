//! Which faces, vertices and edges a point or a region hits: how a picker visits pixels, triangles and points.

use std::collections::VecDeque;
use std::ops::{ControlFlow, Range};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;
use trigon_math::DVec2;

use super::covering::Centers;
use super::hiding::{Candidate, Hiding};
use super::nearby::Kind;
use super::nearby::Nearby;
use super::nearest::Best;
use super::nearest::FaceOutline;
use super::nearest::Sets;
use super::object::{CachedPoints, VisibleVertices};
use super::object::{PickObject, objects, visible_origins};
use super::picker::{Picker, Reach};
use super::region::{Area, Region, center};
use crate::elements::ElementSet;
use crate::frame::Hit;

/// Elements that a thread takes at a time.
const SHARE: usize = 1 << 13;

/// Shares that are taken before it is looked how many points there are.
const SHARES: usize = 64;

/// Points after which a thread leaves the rest of its share for later: an edge may have
/// as many as the image has columns.
const SHARE_POINTS: usize = 1 << 14;

/// Once there are so many points, it is decided which of them are hidden: with those of a last
/// round about 250 MB.
const POINTS: usize = 1 << 22;

/// Triangles that a thread takes at a time.
const TRIANGLES: usize = 4096;

impl<'p> Picker<'p> {
    pub(super) fn area<'r>(&self, region: &'r Region) -> Area<'r> {
        Area::new(region, self.projector.viewport())
    }

    /// By the indices of their nodes.
    pub(super) fn objects(&self) -> &[Option<PickObject<'p>>] {
        self.objects.get_or_init(|| objects(self.scene, &self.screen, &CachedPoints::default()))
    }

    /// The polygon of a hit on the screen; `None` for lines and points.
    pub(super) fn outline(&self, hit: &Hit) -> Option<FaceOutline<'_>> {
        let object = self.objects().get(hit.node.index())?.as_ref()?;
        let face = hit.face.filter(|&face| face < object.mesh().face_count())?;
        Some(FaceOutline::new(object.mesh(), face, &self.projector, |vertex| object.position(vertex)))
    }

    /// The objects beside an area; none if that is empty.
    pub(super) fn nearby<'q>(&'q self, area: &'q Area<'q>) -> Vec<Nearby<'q>> {
        let objects = self.objects().iter().flatten().filter(|_| !area.is_empty());
        objects.map(|object| Nearby::new(object, &self.screen, area)).collect()
    }

    /// The vertices or edges that are hit in a region.
    pub(super) fn elements(&self, kind: Kind, region: &Region, reach: Reach) -> ElementSet {
        let visible = self.visible.get().and_then(Option::as_deref);
        match (reach, kind, visible) {
            (Reach::Visible, Kind::Vertex, Some(visible)) => {
                self.having_points(kind, region, |object, vertex| {
                    visible.vertices.of(object.node).is_some_and(|visible| visible.contains(vertex))
                })
            }
            (Reach::Visible, ..) => self.decided(kind, region),
            (Reach::Through, ..) => self.having_points(kind, region, |_, _| true),
        }
    }

    /// The visible vertices of all of the image; `None` if they cannot be kept.
    pub(super) fn visible_vertices(&self) -> Option<VisibleVertices> {
        let origins = visible_origins(self.objects(), &self.screen)?;
        let whole = Region::Rectangle { min: DVec2::ZERO, max: self.projector.viewport().size() };
        Some(VisibleVertices { origins, vertices: self.decided(Kind::Vertex, &whole) })
    }

    /// The visible elements in a region, of which it is decided which are hidden.
    fn decided(&self, kind: Kind, region: &Region) -> ElementSet {
        let area = self.area(region);
        let mut sets = Sets::new(self.objects(), move |mesh| kind.count(mesh));
        let names = |point: &Candidate| [point.object, point.element];
        self.visible(kind, &self.nearby(&area), names, |[object, element]| sets.insert(object, element));
        sets.finish()
    }

    /// The elements with a point in a region, of those that pass a test.
    fn having_points(
        &self,
        kind: Kind,
        region: &Region,
        passes: impl Fn(&PickObject<'_>, usize) -> bool + Sync,
    ) -> ElementSet {
        let area = self.area(region);
        let mut sets = Sets::new(self.objects(), move |mesh| kind.count(mesh));
        for nearby in &self.nearby(&area) {
            let has_point = |element: usize| {
                let mut has_point = false;
                kind.points(nearby, element, |_| has_point = true);
                has_point
            };
            let of_share = |share: Range<usize>| -> Vec<u32> {
                let elements = share.map(|number| nearby.element(kind, number));
                let found = elements.filter(|&element| passes(nearby.object, element) && has_point(element));
                found.map(|element| element as u32).collect()
            };
            let found: Vec<_> = shares(nearby.count(kind)).into_par_iter().map(of_share).collect();
            let object = nearby.object.node.index() as u32;
            found.into_iter().flatten().for_each(|element| sets.insert(object, element));
        }
        sets.finish()
    }

    /// The element of whose points one is nearest to a point.
    pub(super) fn nearest_element(
        &self,
        kind: Kind,
        target: DVec2,
        nearby: &[Nearby<'_>],
        reach: Reach,
    ) -> Best {
        let mut best = Best::new(target);
        let mut offer =
            |point: Candidate| best.offer(point.spot.at, point.spot.depth, point.object, point.element);
        match reach {
            Reach::Visible => self.visible(kind, nearby, |point| *point, offer),
            Reach::Through => {
                self.candidates(kind, nearby, |lists| lists.iter().flatten().copied().for_each(&mut offer));
            }
        }
        best
    }

    /// Calls `found` with what is asked of the points of elements that are seen in an area.
    fn visible<T: Send>(
        &self,
        kind: Kind,
        nearby: &[Nearby<'_>],
        visit: impl Fn(&Candidate) -> T + Sync,
        mut found: impl FnMut(T),
    ) {
        self.candidates(kind, nearby, |lists| {
            let [first, ..] = nearby else { return };
            let hiding = Hiding::new(&self.screen, self.frame, first.area, lists);
            for nearby in nearby {
                let object = nearby.object;
                let index = object.node.index() as u32;
                hiding.hide(nearby, |face, point| {
                    point.object == index && kind.belongs(object.mesh(), face, point.element)
                });
            }
            hiding.visible(&visit).into_iter().flatten().for_each(&mut found);
        });
    }

    /// Calls `decide` with all points of elements in an area, many at a time.
    fn candidates(&self, kind: Kind, nearby: &[Nearby<'_>], mut decide: impl FnMut(&[Vec<Candidate>])) {
        let shares = nearby
            .iter()
            .flat_map(|nearby| shares(nearby.count(kind)).into_iter().map(move |share| (nearby, share)));
        let mut waiting: VecDeque<(&Nearby<'_>, Range<usize>)> = shares.collect();
        let (mut lists, mut count) = (Vec::new(), 0);
        while !waiting.is_empty() {
            let round: Vec<_> = waiting.drain(..waiting.len().min(SHARES)).collect();
            let found = round.into_par_iter().map(|(nearby, share)| {
                let (points, rest) = points(kind, nearby, share);
                (points, (nearby, rest))
            });
            for (points, rest) in found.collect::<Vec<_>>() {
                count += points.len();
                lists.extend(Some(points).filter(|points| !points.is_empty()));
                waiting.extend(Some(rest).filter(|(_, rest)| !rest.is_empty()));
            }
            if count >= POINTS {
                decide(&lists);
                lists.clear();
                count = 0;
            }
        }
        if count > 0 {
            decide(&lists);
        }
    }

    /// The place of a pixel in the lists of a frame.
    pub(super) fn pixel(&self, [x, y]: [u32; 2]) -> usize {
        y as usize * self.frame.width as usize + x as usize
    }

    /// Calls `found` with each face that wins a pixel whose centre lies in an area, for
    /// neighbouring pixels in a row once: the index of its node, its own, and the pixel.
    pub(super) fn visible_faces(&self, area: &Area<'_>, mut found: impl FnMut(u32, u32, [u32; 2])) {
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
    pub(super) fn faces_through(&self, area: &Area<'_>) -> ElementSet {
        let centers = &Centers::new(area);
        let mut sets = ElementSet::default();
        for nearby in self.nearby(area) {
            let object = nearby.object;
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
            sets.add(object.node, self.covered(&nearby, centers, Visit { none, known, add, merged }));
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
                for nearby in self.nearby(area) {
                    let index = nearby.object.node.index() as u32;
                    let none = || Best::new(target);
                    let add = |best: &mut Best, face: u32, [x, y]: [u32; 2], depth: f64| {
                        best.offer(center(x, y), depth, index, face);
                        ControlFlow::Continue(())
                    };
                    let known = |_: &Best, _: u32| false;
                    let visit = Visit { none, known, add, merged: Best::merged };
                    best = best.merged(self.covered(&nearby, &centers, visit));
                }
            }
        }
        best
    }

    /// Visits the pixels that an object's faces cover, on all threads.
    fn covered<T: Send>(
        &self,
        nearby: &Nearby<'_>,
        centers: &Centers,
        visit: Visit<
            impl Fn() -> T + Sync + Send,
            impl Fn(&T, u32) -> bool + Sync + Send,
            impl Fn(&mut T, u32, [u32; 2], f64) -> ControlFlow<()> + Sync + Send,
            impl Fn(T, T) -> T + Sync + Send,
        >,
    ) -> T {
        let Visit { none, known, add, merged } = visit;
        let Some(triangles) = nearby.triangles().filter(|_| !centers.is_empty()) else { return none() };
        let indices = triangles.indices(0..triangles.drawn.triangle_count());
        let visited = indices.into_par_iter().with_min_len(TRIANGLES).fold(&none, |mut found, index| {
            let face = triangles.drawn.face(triangles.number(index));
            if !known(&found, face) {
                triangles.pieces(index, |piece| {
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

/// So many elements in parts.
fn shares(count: usize) -> Vec<Range<usize>> {
    (0..count).step_by(SHARE).map(|start| start..count.min(start + SHARE)).collect()
}

/// The points of some elements, and what is left of these for later.
fn points(kind: Kind, nearby: &Nearby<'_>, share: Range<usize>) -> (Vec<Candidate>, Range<usize>) {
    let (mut points, object) = (Vec::with_capacity(share.len()), nearby.object.node.index() as u32);
    for number in share.clone() {
        let element = nearby.element(kind, number);
        kind.points(nearby, element, |spot| {
            points.push(Candidate { spot, object, element: element as u32 });
        });
        if points.len() >= SHARE_POINTS {
            return (points, number + 1..share.end);
        }
    }
    (points, share.end..share.end)
}

/// Calls `visit` with each pixel whose centre lies in an area.
pub(super) fn for_each_pixel(area: &Area<'_>, mut visit: impl FnMut([u32; 2])) {
    for row in area.rows.clone() {
        area.runs(row).into_iter().flatten().for_each(|column| visit([column, row]));
    }
}
