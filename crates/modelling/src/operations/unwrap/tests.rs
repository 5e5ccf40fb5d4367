//! Unwrapping as a whole, against areas of intersection, singular values, and exact orientations.

use proptest::prelude::*;
use trigon_math::{DMat3, DVec2, DVec3, Orientation, SplitMix64, Vec3, orientation};
use trigon_mesh::{Mesh, MeshBuilder, Triangulator, primitives};

use super::*;
use crate::ids::EdgeId;
use crate::tests::{check_operation, meshes};

/// A triangle in texture coordinates with v upwards, and its shape on the surface.
pub(super) struct UvTriangle {
    pub(super) uv: [DVec2; 3],
    pub(super) surface: [DVec3; 3],
}

impl UvTriangle {
    fn surface_area(&self) -> f64 {
        let [a, b, c] = self.surface;
        (b - a).cross(c - a).length() / 2.0
    }

    pub(super) fn uv_area(&self) -> f64 {
        let [a, b, c] = self.uv;
        (b - a).perp_dot(c - a) / 2.0
    }

    /// The sum of the squared singular values of the map from texture coordinates to the surface, from its metric
    /// (P. Sander, J. Snyder, S. Gortler and H. Hoppe, *Texture Mapping Progressive Meshes*, 2001).
    fn squared_stretch(&self) -> f64 {
        let ([a, b, c], [p, q, r]) = (self.uv, self.surface);
        let double = 2.0 * self.uv_area();
        let along_s = (p * (b.y - c.y) + q * (c.y - a.y) + r * (a.y - b.y)) / double;
        let along_t = (p * (c.x - b.x) + q * (a.x - c.x) + r * (b.x - a.x)) / double;
        along_s.length_squared() + along_t.length_squared()
    }
}

fn uv_triangles(mesh: &EditMesh, faces: &[FaceId]) -> Vec<UvTriangle> {
    let mut triangles = Vec::new();
    for &face in faces {
        let corners: Vec<_> = mesh.face_corners(face).collect();
        let positions: Vec<Vec3> =
            corners.iter().map(|&corner| mesh.position(mesh.corner_vertex(corner))).collect();
        let mut indices = Vec::new();
        Triangulator::default().complete_polygon(&positions, &mut indices);
        triangles.extend(indices.iter().map(|triangle| UvTriangle {
            uv: triangle.map(|i| {
                let uv = mesh.uv(0, corners[i as usize]).expect("there is a set").as_dvec2();
                DVec2::new(uv.x, -uv.y)
            }),
            surface: triangle.map(|i| positions[i as usize].as_dvec3()),
        }));
    }
    triangles
}

/// The L² stretch of all triangles: 1 if areas and angles are preserved, otherwise more.
pub(super) fn stretch(triangles: &[UvTriangle]) -> f64 {
    let surface: f64 = triangles.iter().map(UvTriangle::surface_area).sum();
    let flat: f64 = triangles.iter().map(UvTriangle::uv_area).sum();
    let squared: f64 =
        triangles.iter().map(|triangle| triangle.surface_area() * triangle.squared_stretch() / 2.0).sum();
    (squared / surface).sqrt() * (flat / surface).sqrt()
}

/// The area of the intersection of two triangles, by clipping the first at the sides of the second (I. Sutherland and
/// G. Hodgman, 1974).
pub(super) fn common_area(one: &[DVec2; 3], other: &[DVec2; 3]) -> f64 {
    let mut polygon = one.to_vec();
    for side in 0..3 {
        let (from, to) = (other[side], other[(side + 1) % 3]);
        let distance = |point: DVec2| (to - from).perp_dot(point - from);
        let mut clipped = Vec::new();
        for (i, &a) in polygon.iter().enumerate() {
            let b = polygon[(i + 1) % polygon.len()];
            let (at_a, at_b) = (distance(a), distance(b));
            if at_a >= 0.0 {
                clipped.push(a);
            }
            if (at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0) {
                clipped.push(a.lerp(b, at_a / (at_a - at_b)));
            }
        }
        polygon = clipped;
    }
    let area = |(i, point): (usize, &DVec2)| point.perp_dot(polygon[(i + 1) % polygon.len()]) / 2.0;
    polygon.iter().enumerate().map(area).sum()
}

/// Fails if a triangle is turned over, outside the image, or overlaps another.
pub(super) fn check_layout(triangles: &[UvTriangle]) -> Result<(), String> {
    for (i, one) in triangles.iter().enumerate() {
        let [a, b, c] = one.uv;
        if orientation(a, b, c) != Orientation::CounterClockwise {
            return Err(format!("triangle {i} is turned over: {a} {b} {c}"));
        }
        if one.uv.iter().any(|uv| !(0.0..=1.0).contains(&uv.x) || !(-1.0..=0.0).contains(&uv.y)) {
            return Err(format!("triangle {i} is outside"));
        }
        for other in &triangles[i + 1..] {
            let common = common_area(&one.uv, &other.uv);
            // Coordinates are rounded to 2⁻²⁴; sides of seams lie on each other.
            if common > 1e-6 * one.uv_area().min(other.uv_area()) + 1e-9 {
                return Err(format!("two triangles have {common} in common"));
            }
        }
    }
    Ok(())
}

fn unwrapped(
    start: &Mesh,
    seams: impl Fn(&EditMesh, EdgeId) -> bool,
    settings: &UnwrapSettings,
) -> (EditMesh, Unwrapped) {
    let (mut mesh, _) = EditMesh::from_mesh(start);
    let seams: Vec<EdgeId> = mesh.edges().filter(|&edge| seams(&mesh, edge)).collect();
    if !seams.is_empty() {
        mesh.mark_seams(&seams).expect("they exist");
    }
    let faces: Vec<FaceId> = mesh.faces().collect();
    let unwrapped = mesh.unwrap_faces(&faces, settings).expect("it can be laid flat");
    (mesh, unwrapped)
}

pub(super) fn all_triangles(mesh: &EditMesh) -> Vec<UvTriangle> {
    uv_triangles(mesh, &mesh.faces().collect::<Vec<_>>())
}

/// A grid over the unit square whose vertices a function moves.
pub(super) fn grid(columns: u32, rows: u32, mut moved: impl FnMut(DVec2) -> DVec3) -> Mesh {
    let mut builder = MeshBuilder::new();
    for y in 0..=rows {
        for x in 0..=columns {
            let at = DVec2::new(f64::from(x) / f64::from(columns), f64::from(y) / f64::from(rows));
            builder.push_vertex(moved(at).as_vec3());
        }
    }
    for y in 0..rows {
        for x in 0..columns {
            let first = y * (columns + 1) + x;
            builder.push_face(&[first, first + 1, first + columns + 2, first + columns + 1]).expect("a quad");
        }
    }
    builder.build()
}

/// An edge between positions that both fulfil a condition.
fn is_between(mesh: &EditMesh, edge: EdgeId, condition: impl Fn(Vec3) -> bool) -> bool {
    mesh.edge_vertices(edge).iter().all(|&vertex| condition(mesh.position(vertex)))
}

#[test]
fn a_cube_unfolds_into_a_cross() {
    // All edges of the top and one of the bottom are joined, the four upright ones and three of the bottom are cut.
    let is_cut = |mesh: &EditMesh, edge| {
        let is_top = is_between(mesh, edge, |position| position.y > 0.0);
        let is_hinge = is_between(mesh, edge, |position| position.y < 0.0 && position.z > 0.0);
        !is_top && !is_hinge
    };
    let (mesh, unwrapped) = unwrapped(&primitives::cube(2.0), is_cut, &UnwrapSettings::default());
    assert_eq!((unwrapped.islands, unwrapped.not_conformal, unwrapped.turned_over), (1, 0, 0), "one cross");
    let triangles = all_triangles(&mesh);
    check_layout(&triangles).expect("no overlap");
    assert!((stretch(&triangles) - 1.0).abs() < 1e-6, "{}", stretch(&triangles));
    for (triangle, edges) in triangles.iter().map(|triangle| (triangle, [[0, 1], [1, 2], [2, 0]])) {
        let ratio = |[a, b]: [usize; 2]| {
            triangle.uv[a].distance(triangle.uv[b]) / triangle.surface[a].distance(triangle.surface[b])
        };
        let ratios = edges.map(ratio);
        assert!(
            (ratios[0] / ratios[1] - 1.0).abs() < 1e-5 && (ratios[1] / ratios[2] - 1.0).abs() < 1e-5,
            "{ratios:?}"
        );
    }
}

#[test]
fn six_sides_of_a_cube_are_packed_with_their_margin() {
    let settings = UnwrapSettings { margin: 0.05, ..UnwrapSettings::default() };
    let (mut mesh, unwrapped) = unwrapped(&primitives::cube(2.0), |_, _| true, &settings);
    assert_eq!(unwrapped.islands, 6, "each side alone");
    check_apart(&mesh, 0.05);
    let areas: Vec<f64> = all_triangles(&mesh).iter().map(UvTriangle::uv_area).collect();
    assert!(areas.iter().all(|area| (area / areas[0] - 1.0).abs() < 1e-5), "{areas:?}");
    // A cube on which all sides show the whole image is packed again.
    let faces: Vec<FaceId> = mesh.faces().collect();
    mesh.project_uvs_on_box(&faces, 0, &crate::BoxProjection { height: 2.0, ..Default::default() })
        .expect("possible");
    let packing = PackSettings { margin: 0.02, ..PackSettings::default() };
    assert_eq!(mesh.pack_uv_islands(&faces, 0, &packing), Ok(6));
    check_apart(&mesh, 0.02);
}

/// Each face is an island of its own here: their bounding rectangles are at least `margin` apart.
fn check_apart(mesh: &EditMesh, margin: f64) {
    let bounds = |face| {
        let uvs = || uv_triangles(mesh, &[face]).into_iter().flat_map(|triangle| triangle.uv);
        let low = uvs().fold(DVec2::INFINITY, DVec2::min);
        (low, uvs().fold(DVec2::NEG_INFINITY, DVec2::max))
    };
    let all: Vec<_> = mesh.faces().map(bounds).collect();
    let least = margin - 1e-6;
    for (i, &(low, high)) in all.iter().enumerate() {
        assert!(
            low.x >= least && high.x <= 1.0 - least && low.y >= least - 1.0 && high.y <= -least,
            "{low} {high}"
        );
        for &(other_low, other_high) in &all[i + 1..] {
            let gap = (low - other_high).max(other_low - high);
            assert!(gap.max_element() >= least, "{gap}");
        }
    }
}

#[test]
fn a_cylinder_with_a_seam_is_rolled_out() {
    let is_rim = |mesh: &EditMesh, edge| {
        is_between(mesh, edge, |position| position.y > 0.0)
            || is_between(mesh, edge, |position| position.y < 0.0)
    };
    let is_cut =
        |mesh: &EditMesh, edge| is_rim(mesh, edge) || is_between(mesh, edge, |position| position.x > 0.999);
    let (mesh, unwrapped) =
        unwrapped(&primitives::cylinder(1.0, 3.0, 24), is_cut, &UnwrapSettings::default());
    assert_eq!((unwrapped.islands, unwrapped.not_conformal), (3, 0), "two caps and the side");
    check_layout(&all_triangles(&mesh)).expect("no overlap");
    let scale = |triangle: &UvTriangle| triangle.uv_area() / triangle.surface_area();
    let triangles = all_triangles(&mesh);
    for triangle in &triangles {
        assert!((scale(triangle) / scale(&triangles[0]) - 1.0).abs() < 1e-4, "all areas in proportion");
        for corner in 0..3 {
            let [uv, surface] =
                [angle_of(triangle.uv.map(|uv| uv.extend(0.0)), corner), angle_of(triangle.surface, corner)];
            assert!((uv - surface).abs() < 1e-4, "{uv} for {surface}");
        }
    }
}

fn angle_of(points: [DVec3; 3], corner: usize) -> f64 {
    let [here, a, b] = [0, 1, 2].map(|next| points[(corner + next) % 3]);
    trigon_math::angle(a - here, b - here)
}

#[test]
fn what_would_overlap_is_laid_out_in_another_way() {
    // A ramp that winds three times around an axis: rolled out it lies on itself.
    let winding = grid(60, 2, |at| {
        let (sin, cos) = trigon_math::elementary::sin_cos(at.x * 3.0 * std::f64::consts::TAU);
        DVec3::new(cos, 0.0, sin) * (1.0 + at.y) + DVec3::Y * at.x * 0.3
    });
    let (mesh, unwrapped) = unwrapped(&winding, |_, _| false, &UnwrapSettings::default());
    assert_eq!(
        (unwrapped.islands, unwrapped.not_conformal, unwrapped.turned_over),
        (1, 1, 0),
        "not conformal"
    );
    check_layout(&all_triangles(&mesh)).expect("no overlap");
}

#[test]
fn steps_make_the_stretch_of_a_dome_smaller() {
    let dome = grid(12, 12, |at| {
        let flat = (at - 0.5) * 1.9;
        DVec3::new(flat.x, flat.y, 1.5 * (1.0 - flat.x * flat.x) * (1.0 - flat.y * flat.y))
    });
    let mut last = f64::INFINITY;
    for minimize_stretch in [0, 1, 5] {
        let settings = UnwrapSettings { minimize_stretch, ..UnwrapSettings::default() };
        let (mesh, unwrapped) = unwrapped(&dome, |_, _| false, &settings);
        assert_eq!((unwrapped.not_conformal, unwrapped.turned_over), (0, 0), "after {minimize_stretch}");
        let triangles = all_triangles(&mesh);
        check_layout(&triangles).expect("no overlap");
        let stretch = stretch(&triangles);
        assert!(stretch < last, "{stretch} after {minimize_stretch} steps, {last} before");
        last = stretch;
    }
}

#[test]
fn what_cannot_be_laid_flat_is_refused_with_a_remedy() {
    for closed in [primitives::cube(1.0), primitives::torus(2.0, 0.5, 8, 6)] {
        let (mut mesh, _) = EditMesh::from_mesh(&closed);
        let faces: Vec<FaceId> = mesh.faces().collect();
        let before = mesh.clone();
        let refusal = mesh.unwrap_faces(&faces, &UnwrapSettings::default()).expect_err("it is closed");
        assert!(refusal.to_string().contains("mark seams"), "{refusal}");
        let too_wide = UnwrapSettings { margin: 1.0, ..UnwrapSettings::default() };
        assert!(mesh.unwrap_faces(&faces, &too_wide).is_err(), "nothing is left");
        assert!(
            mesh.unwrap_faces(&faces, &UnwrapSettings { uv_set: 3, ..Default::default() }).is_err(),
            "no third set"
        );
        assert!(mesh == before, "nothing was done");
    }
}

/// The factor of a grid's system takes memory in proportion to n log n: a limit is a count of its entries.
#[test]
fn ten_thousand_faces_need_little_work() {
    let hills = grid(100, 100, |at| {
        let (sin, cos) = trigon_math::elementary::sin_cos(at.x * 9.0);
        DVec3::new(at.x, at.y, 0.05 * (sin + cos * at.y))
    });
    let (mut mesh, _) = EditMesh::from_mesh(&hills);
    let faces: Vec<FaceId> = mesh.faces().collect();
    let settings = UnwrapSettings::default();
    let (unwrapped, _) =
        mesh.transaction_within(12 << 20, |mesh| mesh.unwrap_faces(&faces, &settings)).expect("it is enough");
    assert_eq!(unwrapped, Unwrapped { islands: 1, ..Unwrapped::default() });
    let refusal = mesh.transaction_within(1 << 20, |mesh| mesh.unwrap_faces(&faces, &settings));
    assert!(matches!(refusal, Err(Refusal::Memory { .. })), "{refusal:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// What is flat already is congruent afterwards, wherever it lies and whatever its seams that end within.
    #[test]
    fn a_flat_chart_stays_as_it_is(
        [columns, rows] in [1u32..7, 1u32..7],
        seed in any::<u64>(),
        turn in prop::array::uniform3(-3.0f64..3.0),
        method in prop_oneof![Just(0u32), Just(5)],
    ) {
        let mut random = SplitMix64::new(seed);
        let [x, y, z] = turn;
        let turn = DMat3::from_rotation_x(x) * DMat3::from_rotation_y(y) * DMat3::from_rotation_z(z);
        let flat = grid(columns, rows, |at| {
            let size = DVec2::new(f64::from(columns), f64::from(rows));
            let offset = DVec2::new(random.between(-0.2, 0.2), random.between(-0.2, 0.2));
            turn * (at * size + offset).extend(0.0)
        });
        let settings = UnwrapSettings { minimize_stretch: method, ..UnwrapSettings::default() };
        let (mesh, unwrapped) = unwrapped(&flat, |mesh, edge| !mesh.is_boundary(edge) && edge.index() % 7 == 3, &settings);
        prop_assert_eq!((unwrapped.not_conformal, unwrapped.turned_over), (0, 0));
        let triangles = all_triangles(&mesh);
        prop_assert_eq!(check_layout(&triangles), Ok(()));
        if unwrapped.islands == 1 {
            prop_assert!((stretch(&triangles) - 1.0).abs() < 1e-6, "{}", stretch(&triangles));
        }
    }

    /// Random mountains, with both methods and steps: nothing is turned over, nothing overlaps.
    #[test]
    fn no_layout_overlaps(
        [columns, rows] in [2u32..7, 2u32..7],
        seed in any::<u64>(),
        height in 0.0f64..1.5,
        method in prop_oneof![Just(UnwrapMethod::Conformal), Just(UnwrapMethod::Convex)],
        minimize_stretch in 0u32..6,
    ) {
        let mut random = SplitMix64::new(seed);
        let mountains = grid(columns, rows, |at| {
            let [x, y] = [(); 2].map(|()| random.between(-0.05, 0.05));
            DVec3::new(at.x + x, at.y + y, random.between(0.0, height))
        });
        let settings = UnwrapSettings { method, minimize_stretch, ..UnwrapSettings::default() };
        let (mesh, unwrapped) = unwrapped(&mountains, |_, _| false, &settings);
        prop_assert_eq!(unwrapped.turned_over, 0);
        prop_assert_eq!(check_layout(&all_triangles(&mesh)), Ok(()));
    }

    /// Random meshes with random seams: the structure stays, and undo gives the same bytes.
    #[test]
    fn unwrapping_is_undone(start in meshes(), bits in any::<u64>(), minimize_stretch in 0u32..4, new_set in any::<bool>()) {
        let (mut mesh, _) = EditMesh::from_mesh(&start);
        let seams: Vec<EdgeId> = mesh.edges().filter(|edge| bits >> (edge.index() % 64) & 1 != 0).collect();
        if !seams.is_empty() {
            mesh.mark_seams(&seams).expect("they exist");
        }
        let faces: Vec<FaceId> = mesh.faces().filter(|face| bits >> (face.index() % 61) & 1 != 0).collect();
        let settings = UnwrapSettings { uv_set: usize::from(new_set), minimize_stretch, ..UnwrapSettings::default() };
        let done = check_operation(&mesh, |mesh| mesh.unwrap_faces(&faces, &settings)).map_err(TestCaseError::fail)?;
        if let Some((after, _)) = done {
            for corner in faces.iter().flat_map(|&face| after.face_corners(face)) {
                let uv = after.uv(settings.uv_set, corner).expect("it was added");
                prop_assert!((0.0..=1.0).contains(&uv.x) && (0.0..=1.0).contains(&uv.y), "{}", uv);
            }
            let packing = PackSettings::default();
            let packed = check_operation(&after, |mesh| mesh.pack_uv_islands(&faces, settings.uv_set, &packing));
            prop_assert!(packed.map_err(TestCaseError::fail)?.is_some(), "what was unwrapped can be packed");
        }
    }
}
