//! The elements nearest to a point of an image, how far a polygon's vertices and edges are from a pixel, and sets of
//! elements that are filled one by one.

use std::cmp::Ordering;

use fixedbitset::FixedBitSet;
use trigon_camera::Projector;
use trigon_math::{DVec2, DVec3};
use trigon_mesh::Mesh;

use super::object::PickObject;
use super::screen::nearer_first;
use crate::elements::ElementSet;
use crate::node::NodeId;

/// The elements nearest to a point of an image, each with its node.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Nearest {
    /// The vertex whose point is nearest.
    pub vertex: Option<(NodeId, u32)>,
    /// The edge of whose points one is nearest.
    pub edge: Option<(NodeId, u32)>,
    /// The face of whose pixels' centres one is nearest.
    pub face: Option<(NodeId, u32)>,
}

/// The nearest element of a kind so far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    target: DVec2,
    found: Option<NearestCandidate>,
}

/// An element that may be the nearest one.
#[derive(Clone, Copy, Debug)]
struct NearestCandidate {
    /// From the target, in pixels squared.
    distance_squared: f64,
    depth: f64,
    /// The index of its node.
    object: u32,
    /// Its own index.
    element: u32,
}

impl NearestCandidate {
    fn order(&self, other: &Self) -> Ordering {
        let order = self.distance_squared.total_cmp(&other.distance_squared);
        let order = order.then(self.depth.total_cmp(&other.depth));
        order.then((self.object, self.element).cmp(&(other.object, other.element)))
    }
}

impl Best {
    pub(super) fn new(target: DVec2) -> Self {
        Self { target, found: None }
    }

    /// A point of an element. Of equally near ones that which is nearer to the camera
    /// stays, and of those the first of the first node, whatever the order.
    pub(super) fn offer(&mut self, at: DVec2, depth: f64, object: u32, element: u32) {
        let distance_squared = at.distance_squared(self.target);
        self.improve(NearestCandidate { distance_squared, depth, object, element });
    }

    /// The better of two.
    pub(super) fn merged(mut self, other: Self) -> Self {
        if let Some(found) = other.found {
            self.improve(found);
        }
        self
    }

    fn improve(&mut self, new: NearestCandidate) {
        if self.found.is_none_or(|old| new.order(&old) == Ordering::Less) {
            self.found = Some(new);
        }
    }

    /// The index of the node, and that of the element.
    pub(super) fn element(&self) -> Option<(u32, u32)> {
        self.found.map(|found| (found.object, found.element))
    }
}

/// A set that grows element by element.
pub(super) struct Sets<'o, 's, C> {
    objects: &'o [Option<PickObject<'s>>],
    count: C,
    bits: Vec<FixedBitSet>,
}

impl<'o, 's, C: Fn(&Mesh) -> usize> Sets<'o, 's, C> {
    /// `count` tells how many elements a mesh has.
    pub(super) fn new(objects: &'o [Option<PickObject<'s>>], count: C) -> Self {
        Self { objects, count, bits: vec![FixedBitSet::new(); objects.len()] }
    }

    /// Adds an element of the node with this index, if there is such an element.
    #[inline]
    pub(super) fn insert(&mut self, object: u32, element: u32) {
        let Some(bits) = self.bits.get_mut(object as usize) else { return };
        if bits.is_empty() {
            // Its first.
            let Some(object) = &self.objects[object as usize] else { return };
            bits.grow((self.count)(object.mesh()));
        }
        if (element as usize) < bits.len() {
            bits.insert(element as usize);
        }
    }

    pub(super) fn finish(self) -> ElementSet {
        let mut set = ElementSet::default();
        for (object, bits) in self.objects.iter().zip(self.bits) {
            if let Some(object) = object {
                set.add(object.node, bits);
            }
        }
        set
    }
}

/// A polygon on the screen.
pub(super) struct FaceOutline<'m> {
    mesh: &'m Mesh,
    face: usize,
    /// For each corner where it is drawn; `None` before the near plane.
    corners: Vec<Option<DVec2>>,
    /// For each corner what is drawn of the side to the next one.
    sides: Vec<Option<[DVec2; 2]>>,
}

impl<'m> FaceOutline<'m> {
    /// `position` tells where a vertex is in the world.
    pub(super) fn new(
        mesh: &'m Mesh,
        face: usize,
        projector: &Projector,
        position: impl Fn(u32) -> DVec3,
    ) -> Self {
        let points: Vec<DVec3> = mesh.face_vertices(face).iter().map(|&vertex| position(vertex)).collect();
        let near = projector.camera().projection.near();
        let is_visible = |point: DVec3| -projector.to_camera(point).z >= near;
        let corner = |&point: &DVec3| projector.to_screen(point).filter(|_| is_visible(point));
        let side =
            |from: usize| projector.line_to_screen([points[from], points[(from + 1) % points.len()]], near);
        let corners = points.iter().map(corner).collect();
        Self { mesh, face, corners, sides: (0..points.len()).map(side).collect() }
    }

    /// The vertices with their distances from a point in pixels.
    pub(super) fn vertices(&self, point: DVec2) -> Vec<(u32, f64)> {
        let vertices = self.mesh.face_vertices(self.face).iter().zip(&self.corners);
        vertices.filter_map(|(&vertex, corner)| Some((vertex, corner.as_ref()?.distance(point)))).collect()
    }

    /// The edges with their distances from a point in pixels.
    pub(super) fn edges(&self, point: DVec2) -> Vec<(u32, f64)> {
        let sides = self.mesh.face_corners(self.face).zip(&self.sides);
        let distances = sides.filter_map(|(corner, side)| {
            Some((self.mesh.corner_edge(corner)?, distance_to_segment(point, side.as_ref()?)))
        });
        distances.collect()
    }
}

fn distance_to_segment(point: DVec2, &ends: &[DVec2; 2]) -> f64 {
    let [start, end] = nearer_first(ends, |&end| end);
    let along = end - start;
    let share = (point - start).dot(along) / along.length_squared();
    // A segment without length is its start.
    let share = if share > 0.0 { share.clamp(0.0, 1.0) } else { 0.0 };
    point.distance(start + along * share)
}
