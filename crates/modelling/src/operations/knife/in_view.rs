//! Faces as they are seen in a direction, to find those that a line passes.

use trigon_math::{Bounds3, DVec2, DVec3};

use super::ProjectedLine;
use super::project::ParallelLine;
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::operations::box_tree::{BoxItem, BoxTree};

/// How far beside a line a point may lie that rounding puts on it, in parts of the largest coordinate, if the line is seen
/// in its full length. The normal of a line is off by at most 3 ε of its length before it is projected, over a depth of at
/// most 2 √3 such coordinates; sides and progress are off by 8 ε of that distance each. All of it is below 100 ε = 2.3e-14.
const ROUNDING: f64 = 1e-13;

/// A tree of the faces' boxes in the plane of projection.
pub(super) struct FacesInView<'f> {
    faces: &'f [FaceId],
    tree: BoxTree,
    /// By item of the tree: the index of its face.
    indices: Vec<u32>,
    /// Faces with a position that is not finite: they have no box.
    without_box: Vec<u32>,
    view: View,
    largest_coordinate: f64,
}

/// The plane of projection.
#[derive(Clone, Copy)]
struct View {
    right: DVec3,
    up: DVec3,
}

impl View {
    fn project(self, point: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(point), self.up.dot(point))
    }
}

impl<'f> FacesInView<'f> {
    /// The direction has unit length.
    pub(super) fn new(mesh: &EditMesh, faces: &'f [FaceId], direction: DVec3) -> Self {
        let (right, up) = direction.any_orthonormal_pair();
        let view = View { right, up };
        let (mut items, mut indices, mut without_box) = (Vec::new(), Vec::new(), Vec::new());
        let mut largest_coordinate = 0.0_f64;
        for (index, &face) in (0..).zip(faces) {
            let positions = || mesh.face_vertices(face).map(|vertex| mesh.point(vertex));
            if !positions().all(DVec3::is_finite) {
                without_box.push(index);
                continue;
            }
            let of_face = positions().map(|position| position.abs().max_element()).fold(0.0, f64::max);
            largest_coordinate = largest_coordinate.max(of_face);
            let bounds = Bounds3::from_points(positions().map(|position| view.project(position).extend(0.0)));
            items.push(BoxItem { bounds, middle: (bounds.min + bounds.max) / 2.0 });
            indices.push(index);
        }
        Self { faces, tree: BoxTree::new(&items), indices, without_box, view, largest_coordinate }
    }

    /// The faces that a line in this direction may pass between its ends, in their order: all that it passes, and some
    /// beside it.
    pub(super) fn beside(&self, line: &ParallelLine) -> Vec<FaceId> {
        let stripe = Stripe::new(line, self.view, self.largest_coordinate);
        if !stripe.is_finite() {
            return self.faces.to_vec();
        }
        let mut found = self.without_box.clone();
        self.tree.for_each_touching(
            |bounds| stripe.touches(bounds),
            |item| found.push(self.indices[item as usize]),
        );
        found.sort_unstable();
        found.into_iter().map(|index| self.faces[index as usize]).collect()
    }
}

/// All points within a distance from a line in the plane of projection.
struct Stripe {
    ends: [DVec2; 2],
    margin: f64,
}

impl Stripe {
    fn new(line: &ParallelLine, view: View, largest_coordinate: f64) -> Self {
        // Where a cut along the line begins and ends, by the numbers that decide it.
        let ends = line.sights().map(|sight| {
            let progress = line.progress(sight.origin + sight.direction);
            view.project(line.ends[0] + line.along * (progress / line.along.length_squared()))
        });
        let of_line = line.ends.map(|end| end.abs().max_element());
        let largest = largest_coordinate.max(of_line[0]).max(of_line[1]);
        // A line that is seen nearly as a point has a normal that rounding turns.
        let shortened = (line.ends[1] - line.ends[0]).length() / line.normal.length();
        Self { ends, margin: ROUNDING * largest * shortened }
    }

    fn is_finite(&self) -> bool {
        self.margin.is_finite() && self.ends.iter().all(|end| end.is_finite())
    }

    /// Whether a box has points in the stripe: by the axes, and by the direction across the line.
    fn touches(&self, bounds: &Bounds3) -> bool {
        let [a, b] = self.ends;
        let (low, high) = (bounds.min.truncate(), bounds.max.truncate());
        let margin = DVec2::splat(self.margin);
        let is_beside = (a.min(b) - margin).cmpgt(high).any() || low.cmpgt(a.max(b) + margin).any();
        let across = (b - a).perp();
        let distance = across.dot((low + high) / 2.0 - a).abs();
        let reach = across.abs().dot((high - low) / 2.0) + self.margin * across.length();
        !is_beside && distance <= reach
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::primitives;

    use super::*;
    use crate::VertexId;
    use crate::tests::meshes;

    fn edit(mesh: trigon_mesh::Mesh) -> EditMesh {
        EditMesh::from_mesh(&mesh).0
    }

    fn all(mesh: &EditMesh) -> Vec<FaceId> {
        mesh.faces().collect()
    }

    /// Lines in a direction: between any points, from vertex to vertex, and almost along it.
    fn lines(mesh: &EditMesh, direction: DVec3, points: &[[f64; 3]]) -> Vec<ParallelLine> {
        let vertices: Vec<VertexId> = mesh.vertices().collect();
        let nearest = |point: DVec3| {
            let distance = |&vertex: &VertexId| mesh.point(vertex).distance_squared(point);
            vertices.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        let ends = points.windows(2).flat_map(|pair| {
            let [a, b] = [pair[0], pair[1]].map(DVec3::from);
            let [at_a, at_b] = [a, b].map(|end| nearest(end).map_or(end, |vertex| mesh.point(vertex)));
            let along = a + direction * (b - a).length();
            [[a, b], [at_a, at_b], [a, along], [a, along + DVec3::splat(1e-15)]]
        });
        ends.filter_map(|ends| ParallelLine::new(ends, direction)).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// The cuts of all faces, one by one, are those of the faces that are found.
        #[test]
        fn no_face_that_a_line_passes_is_missed(
            start in meshes(),
            direction in prop::array::uniform3(-1.0_f64..1.0),
            is_axis: bool,
            points in prop::collection::vec(prop::array::uniform3(-3.0_f64..3.0), 2..6),
            bits in any::<u64>(),
        ) {
            let mesh = edit(start);
            let direction = if is_axis { DVec3::NEG_Y } else { DVec3::from(direction).normalize_or(DVec3::X) };
            let mut faces = all(&mesh);
            faces.retain(|face| bits >> (face.0 % 64) & 1 != 0);
            faces.reverse();
            let view = FacesInView::new(&mesh, &faces, direction);
            for line in lines(&mesh, direction, &points) {
                let found = view.beside(&line);
                prop_assert_eq!(mesh.knife_through(&found, &line), mesh.knife_through(&faces, &line));
            }
        }
    }

    #[test]
    fn far_faces_are_not_looked_at_and_those_without_a_box_are() {
        let mut mesh = edit(primitives::grid(30.0, 30.0, 30, 30));
        let faces = all(&mesh);
        let line = |from: [f64; 2], to: [f64; 2]| {
            let ends = [from, to].map(|[x, z]| DVec3::new(x, 7.0, z));
            ParallelLine::new(ends, DVec3::NEG_Y).expect("not a point")
        };
        let short = line([0.2, 0.3], [0.4, 0.6]);
        let diagonal = line([-15.0, -14.5], [14.5, 15.0]);
        let view = FacesInView::new(&mesh, &faces, DVec3::NEG_Y);
        // A leaf has up to four faces, and none of them is far from the others.
        assert!(view.beside(&short).len() <= 4, "{} faces", view.beside(&short).len());
        assert!((59..=240).contains(&view.beside(&diagonal).len()), "{} faces", view.beside(&diagonal).len());
        let corner = mesh.face_vertices(faces[0]).next().expect("a vertex");
        mesh.set_position(corner, Vec3::new(f32::NAN, 0.0, 0.0));
        let view = FacesInView::new(&mesh, &faces, DVec3::NEG_Y);
        assert!(view.beside(&short).contains(&faces[0]), "it may be anywhere");
    }
}
