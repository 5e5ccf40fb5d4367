//! Tangents of polygons whose triangles disagree on them, against MikkTSpace written again in f64 from M. S.
//! Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008.

use proptest::prelude::*;
use trigon_math::{DVec2, DVec3, Vec2, Vec3};
use trigon_mesh::{Attributes, Mesh};

use crate::outlines::mesh;

/// One triangle of a polygon: its corners, and what its texture coordinates say.
struct Triangle {
    corners: [usize; 3],
    /// Whether texture coordinates go round as the corners do.
    is_preserving: bool,
    /// The direction of growing u, of any length.
    along_u: DVec3,
    /// How long the two vectors are of which that is the difference.
    terms: f64,
}

/// Six roundings of f32, as a share.
const ROUNDED: f64 = 6.0 / (1 << 24) as f64;

impl Triangle {
    fn new(corners: [u32; 3], place: &impl Fn(usize) -> (DVec3, DVec2)) -> Self {
        let corners = corners.map(|corner| corner as usize);
        let [(p, uv), (q, st), (r, xy)] = corners.map(place);
        let [a, b] = [st - uv, xy - uv];
        let twice_area = a.perp_dot(b);
        // The solution for the derivative by u of P = P₀ + s a + t b, times the area without its sign.
        let along_u = ((q - p) * b.y - (r - p) * a.y) * twice_area.signum();
        let terms = (q - p).length() * b.y.abs() + (r - p).length() * a.y.abs();
        Self { corners, is_preserving: twice_area > 0.0, along_u, terms }
    }

    /// The angle at a corner as the surface's normal sees it, the direction of u there, and how far f32 may be off in
    /// their product: the angle of a cosine near 1 or -1 is lost in its rounding, and the direction in its terms'.
    fn at(
        &self,
        corner: usize,
        normal: DVec3,
        place: &impl Fn(usize) -> (DVec3, DVec2),
    ) -> (f64, DVec3, f64) {
        let own = self.corners.iter().position(|&other| other == corner).expect("it is one of them");
        let [this, next, last] = [own, own + 1, own + 2].map(|i| place(self.corners[i % 3]).0);
        let flat = |v: DVec3| (v - normal * normal.dot(v)).normalize_or_zero();
        let (out, back) = (flat(next - this), flat(last - this));
        #[expect(
            clippy::disallowed_methods,
            reason = "of the oracle's own; its last bit is far below the bound"
        )]
        let angle = out.dot(back).clamp(-1.0, 1.0).acos();
        let of_angle = (8.0 * ROUNDED / out.cross(back).length()).min((16.0 * ROUNDED).sqrt());
        let flattened = (self.along_u - normal * normal.dot(self.along_u)).length();
        (angle, flat(self.along_u), of_angle + angle * 8.0 * ROUNDED * self.terms / flattened)
    }
}

/// The tangent of a corner with its sign, and how far f32 may be off; none if it is in no triangle.
///
/// Triangles around a corner belong together as long as each has an edge at the corner in common with the next, and
/// both or none of them mirror the texture. The first of a polygon's triangles at the corner decides.
fn tangent(mesh: &Mesh, corner: usize) -> Option<(DVec3, f64, f64)> {
    let uvs = &mesh.attributes().uv_sets[0];
    let place = |corner: usize| {
        let vertex = mesh.corner_vertices()[corner] as usize;
        (mesh.positions()[vertex].as_dvec3(), uvs[corner].as_dvec2())
    };
    let normal = mesh.shading_normals()[corner].as_dvec3();
    let all: Vec<Triangle> =
        mesh.triangulation().triangles.iter().map(|&corners| Triangle::new(corners, &place)).collect();
    let around: Vec<&Triangle> = all.iter().filter(|triangle| triangle.corners.contains(&corner)).collect();
    let mut group = vec![*around.first()?];
    let mut seen = vec![false; around.len()];
    seen[0] = true;
    while let Some(found) = (0..around.len()).find(|&i| {
        let shares = |other: &&Triangle| {
            let common = other.corners.iter().filter(|c| around[i].corners.contains(c)).count();
            common == 2 && other.is_preserving == around[i].is_preserving
        };
        !seen[i] && group.iter().any(shares)
    }) {
        seen[found] = true;
        group.push(around[found]);
    }
    let parts: Vec<(f64, DVec3, f64)> =
        group.iter().map(|triangle| triangle.at(corner, normal, &place)).collect();
    let sum: DVec3 = parts.iter().map(|(angle, along, _)| *along * *angle).sum();
    let off: f64 = parts.iter().map(|(angle, _, off)| off + angle * ROUNDED).sum();
    // In MikkTSpace v points up.
    let side = if group[0].is_preserving { -1.0 } else { 1.0 };
    Some((sum.normalize_or_zero(), side, 2.0 * off / sum.length()))
}

/// A polygon around the origin, bent a little, with texture coordinates that have nothing to do with its shape.
fn polygon() -> impl Strategy<Value = Mesh> {
    let corner = (0.5_f32..2.0, -0.3_f32..0.3, [-8_i8..=8, -8_i8..=8], 0.2_f32..1.0);
    (prop::collection::vec(corner, 4), [-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0]).prop_map(
        |(corners, axis)| {
            let total: f32 = corners.iter().map(|(.., step)| step).sum();
            let axis = (Vec3::from_array(axis) + Vec3::Z * 0.01).normalize();
            let [right, up] = [axis.any_orthonormal_vector(), axis.cross(axis.any_orthonormal_vector())];
            let mut turn = 0.0;
            let position = |&(radius, height, _, step): &(f32, f32, [i8; 2], f32)| {
                let (sine, cosine) =
                    trigon_math::elementary::sin_cos(f64::from(turn / total) * std::f64::consts::TAU);
                turn += step;
                (right * cosine as f32 + up * sine as f32) * radius + axis * height
            };
            let positions: Vec<Vec3> = corners.iter().map(position).collect();
            let face: Vec<u32> = (0..positions.len() as u32).collect();
            let mut mesh = mesh(&positions, &[&face]);
            let uvs = corners.iter().map(|&(_, _, uv, _)| Vec2::from(uv.map(f32::from)) / 4.0).collect();
            mesh.set_attributes(Attributes { uv_sets: vec![uvs], ..Attributes::default() })
                .expect("one each");
            mesh
        },
    )
}

/// Whether every triangle has an area in the texture, so that none takes its neighbour's tangent.
fn has_areas(mesh: &Mesh) -> bool {
    let uvs = &mesh.attributes().uv_sets[0];
    mesh.triangulation().triangles.iter().all(|corners| {
        let [a, b, c] = corners.map(|corner| uvs[corner as usize]);
        (b - a).perp_dot(c - a) != 0.0
    })
}

proptest! {
    #[test]
    fn a_polygon_whose_triangles_disagree_has_the_tangents_of_the_first(mesh in polygon()) {
        prop_assume!(has_areas(&mesh));
        let tangents = mesh.generate_tangents(0).expect("there is a set");
        for (corner, found) in tangents.iter().enumerate() {
            // A polygon that is folded may have corners in no triangle. And of u along the normal nothing is left in the
            // surface: then rounding decides whether that triangle has a tangent, or the next one does.
            let Some((exact, side, bound)) = tangent(&mesh, corner).filter(|(.., bound)| *bound < 0.1) else {
                continue;
            };
            prop_assert_eq!(f64::from(found.w), side, "the side of corner {}", corner);
            let error = (found.truncate().as_dvec3() - exact).length();
            prop_assert!(error <= bound, "corner {}: {} instead of {} ± {}", corner, found, exact, bound);
        }
    }
}
