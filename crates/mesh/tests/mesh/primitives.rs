//! The standard objects against what is known about them.

use std::f64::consts::{PI, SQRT_2};

use trigon_math::{Vec3, elementary};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_mesh::{Mesh, RenderMesh};

/// Vertices, edges and faces, and that the faces close a volume.
fn check_solid(name: &str, mesh: &Mesh, counts: [usize; 3], euler: i64) {
    let found = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
    assert_eq!(found, counts, "{name}: vertices, edges, faces");
    assert_eq!(mesh.euler_characteristic(), euler, "{name}: Euler characteristic");
    assert!(mesh.is_closed(), "{name} is not closed");
    assert!(mesh.volume() > 0.0, "{name} is inside out");
    check_surface(name, mesh);
}

/// Normals of unit length on the side of the face, and texture coordinates in
/// the image that do not mirror it.
fn check_surface(name: &str, mesh: &Mesh) {
    let faces = mesh.face_normals();
    let normals = mesh.shading_normals();
    for (face, corners) in mesh.faces().enumerate() {
        for corner in corners.clone() {
            let normal = normals[corner];
            assert!((normal.length() - 1.0).abs() < 1e-6, "{name}: |{normal}| at corner {corner}");
            let side = normal.dot(faces[face]);
            assert!(side > 0.2, "{name}: the normal at corner {corner} of face {face} looks away: {side}");
        }
        let uvs = &mesh.attributes().uv_sets[0][corners];
        let area: f32 = (1..uvs.len() - 1).map(|i| (uvs[i] - uvs[0]).perp_dot(uvs[i + 1] - uvs[0])).sum();
        assert!(area < 0.0, "{name}: face {face} mirrors its image ({area}), v points down");
        let inside = uvs.iter().all(|uv| uv.x >= 0.0 && uv.x <= 2.0 && uv.y >= 0.0 && uv.y <= 1.0);
        assert!(inside, "{name}: face {face} leaves the image: {uvs:?}");
    }
}

fn check_close(what: &str, found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected, "{what} is {found}, not {expected}");
}

/// Name, constructor, (vertices, edges, faces), corners of a face, area, volume.
type Known = (&'static str, fn(f32) -> Mesh, [usize; 3], usize, f64, f64);

#[test]
fn the_platonic_solids() {
    // Counts, surface and volume for edge 1, from any table.
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let table: [Known; 5] = [
        ("tetrahedron", primitives::tetrahedron, [4, 6, 4], 3, 3.0_f64.sqrt(), SQRT_2 / 12.0),
        ("cube", primitives::cube, [8, 12, 6], 4, 6.0, 1.0),
        ("octahedron", primitives::octahedron, [6, 12, 8], 3, 2.0 * 3.0_f64.sqrt(), SQRT_2 / 3.0),
        (
            "dodecahedron",
            primitives::dodecahedron,
            [20, 30, 12],
            5,
            3.0 * (25.0 + 10.0 * 5.0_f64.sqrt()).sqrt(),
            (15.0 + 7.0 * 5.0_f64.sqrt()) / 4.0,
        ),
        (
            "icosahedron",
            primitives::icosahedron,
            [12, 30, 20],
            3,
            5.0 * 3.0_f64.sqrt(),
            5.0 * golden.powi_2() / 6.0,
        ),
    ];
    for (name, make, counts, corners, area, volume) in table {
        for edge in [1.0, 0.25, 40.0] {
            let mesh = make(edge);
            check_solid(name, &mesh, counts, 2);
            assert!(
                (0..mesh.face_count()).all(|f| mesh.face_vertices(f).len() == corners),
                "{name}: corners"
            );
            let size = f64::from(edge);
            check_close(name, mesh.surface_area(), area * size * size, 1e-6);
            check_close(name, mesh.volume(), volume * size * size * size, 1e-6);
            for [a, b] in mesh.edges() {
                let length = mesh.positions()[*a as usize].distance(mesh.positions()[*b as usize]);
                check_close(name, f64::from(length), size, 1e-6);
            }
        }
    }
}

/// Squares without `powi`, which is not the same on every machine.
trait Square {
    fn powi_2(self) -> f64;
}

impl Square for f64 {
    fn powi_2(self) -> f64 {
        self * self
    }
}

#[test]
fn the_pyramid_of_the_source() {
    let pyramid = primitives::pyramid(2.0, 3.0);
    check_solid("pyramid", &pyramid, [5, 8, 5], 2);
    assert_eq!(RenderMesh::from_mesh(&pyramid).triangles.len(), 6, "six triangles");
    check_close("the pyramid's volume", pyramid.volume(), 4.0, 1e-6);
}

#[test]
fn level_surfaces_face_up() {
    let surfaces = [
        ("plane", primitives::plane(2.0, 3.0), [4, 4, 1], 6.0),
        ("grid", primitives::grid(2.0, 3.0, 4, 5), [30, 49, 20], 6.0),
        ("disc", primitives::disc(1.0, 6), [6, 6, 1], 1.5 * 3.0_f64.sqrt()),
    ];
    for (name, mesh, counts, area) in surfaces {
        let found = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
        assert_eq!(found, counts, "{name}: vertices, edges, faces");
        check_close(name, mesh.surface_area(), area, 1e-6);
        assert!(mesh.face_normals().iter().all(|&n| n == Vec3::Y), "{name} does not face up");
        check_surface(name, &mesh);
    }
}

#[test]
fn spheres() {
    let (segments, rings) = (24, 12);
    let sphere = primitives::uv_sphere(2.0, 24, 12);
    let vertices = (rings - 1) * segments + 2;
    check_solid("uv sphere", &sphere, [vertices, vertices + segments * rings - 2, segments * rings], 2);
    let triangles = (0..sphere.face_count()).filter(|&f| sphere.face_vertices(f).len() == 3).count();
    assert_eq!(triangles, 2 * segments, "triangles at the poles only");
    check_close("the uv sphere's volume", sphere.volume(), 4.0 / 3.0 * PI * 8.0, 0.03);

    for subdivisions in 0..4 {
        let sphere = primitives::icosphere(2.0, subdivisions);
        let faces = 20 * 4_usize.pow(subdivisions);
        check_solid("icosphere", &sphere, [faces / 2 + 2, faces * 3 / 2, faces], 2);
    }
    let volume = primitives::icosphere(2.0, 4).volume();
    check_close("the icosphere's volume", volume, 4.0 / 3.0 * PI * 8.0, 0.005);
    for sphere in [sphere, primitives::icosphere(2.0, 3)] {
        for (corner, &vertex) in sphere.corner_vertices().iter().enumerate() {
            let position = sphere.positions()[vertex as usize];
            let normal = sphere.shading_normals()[corner];
            assert!((position / 2.0).distance(normal) < 1e-6, "the normal of {position} is {normal}");
            if corner > 100 {
                break;
            }
        }
    }
}

#[test]
fn cylinder_and_cone() {
    let n = 16;
    // A regular polygon's share of the circle round it.
    let share = elementary::sin(2.0 * PI / 16.0) * 16.0 / (2.0 * PI);
    let cylinder = primitives::cylinder(0.5, 2.0, 16);
    check_solid("cylinder", &cylinder, [2 * n, 3 * n, n + 2], 2);
    check_close("the cylinder's volume", cylinder.volume(), share * PI * 0.25 * 2.0, 1e-6);
    assert_eq!(cylinder.face_vertices(n).len(), n, "the ends are polygons");
    let cone = primitives::cone(0.5, 2.0, 16);
    check_solid("cone", &cone, [n + 1, 2 * n, n + 1], 2);
    check_close("the cone's volume", cone.volume(), share * PI * 0.25 * 2.0 / 3.0, 1e-6);
    // The rim is sharp, the side is smooth: two drawn vertices per rim vertex.
    assert_eq!(RenderMesh::from_mesh(&without_uvs(cylinder)).positions.len(), 4 * n, "drawn vertices");
    // At the tip every triangle has a normal of its own.
    assert_eq!(RenderMesh::from_mesh(&without_uvs(cone)).positions.len(), 3 * n, "drawn vertices");
}

fn without_uvs(mut mesh: Mesh) -> Mesh {
    let mut attributes = mesh.attributes().clone();
    attributes.uv_sets.clear();
    mesh.set_attributes(attributes).expect("fewer lists fit as well");
    mesh
}

#[test]
fn torus_and_knot() {
    let torus = primitives::torus(2.0, 0.5, 48, 24);
    check_solid("torus", &torus, [1152, 2304, 1152], 0);
    check_close("the torus's volume", torus.volume(), 2.0 * PI * PI * 2.0 * 0.25, 0.02);
    check_close("the torus's area", torus.surface_area(), 4.0 * PI * PI * 2.0 * 0.5, 0.02);
    for (turns, loops) in [(2, 3), (3, 2), (1, 1), (5, 8), (4, 6)] {
        let shape = TorusKnot { turns, loops, tube_radius: 0.1, segments: 400, ..TorusKnot::default() };
        check_solid("torus knot", &primitives::torus_knot(&shape), [6400, 12800, 6400], 0);
    }
    let twice = TorusKnot { turns: 4, loops: 6, ..TorusKnot::default() };
    let once = primitives::torus_knot(&TorusKnot::default());
    assert_eq!(primitives::torus_knot(&twice), once, "4:6 is 2:3");
}

#[test]
fn wires_have_no_faces() {
    let segment = primitives::segment(Vec3::ZERO, Vec3::X);
    assert_eq!((segment.edges(), segment.face_count()), (&[[0, 1]][..], 0), "a segment");
    let polyline = primitives::polyline(&[Vec3::ZERO, Vec3::X, Vec3::Y]);
    assert_eq!(polyline.loose_edges(), [[0, 1], [1, 2]], "a polyline stays open");
    assert_eq!(primitives::polyline(&[Vec3::X]).loose_points(), [0], "one point is a point");
    assert_eq!(primitives::polyline(&[]), Mesh::default(), "no points, nothing");
    let ring = primitives::ring(1.0, 8);
    assert_eq!((ring.vertex_count(), ring.edge_count()), (8, 8), "a ring closes");
}

#[test]
fn every_parameter_gives_a_mesh() {
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(primitives::cube(bad), primitives::cube(1.0), "a cube of {bad}");
        assert_eq!(primitives::torus(bad, bad, 3, 3), primitives::torus(1.0, 1.0, 3, 3), "a torus of {bad}");
    }
    assert_eq!(primitives::uv_sphere(1.0, 0, 0), primitives::uv_sphere(1.0, 3, 2), "the coarsest sphere");
    assert_eq!(primitives::cylinder(1.0, 1.0, 1), primitives::cylinder(1.0, 1.0, 3), "the coarsest cylinder");
    assert_eq!(primitives::disc(1.0, u32::MAX).corner_count(), 2048, "the finest disc");
    assert_eq!(primitives::grid(1.0, 1.0, 0, u32::MAX).face_count(), 2048, "the finest row");
    for mesh in [primitives::uv_sphere(1.0, 3, 2), primitives::cone(1.0, 1.0, 3), primitives::teapot(0)] {
        assert!(mesh.positions().iter().all(|p| p.is_finite()), "all positions are finite");
    }
}

#[test]
fn round_objects_touch_their_bounds() {
    for mesh in [primitives::uv_sphere(0.5, 32, 16), primitives::cylinder(0.5, 1.0, 32)] {
        let bounds = mesh.bounds();
        assert_eq!(
            (bounds.min.as_vec3(), bounds.max.as_vec3()),
            (Vec3::splat(-0.5), Vec3::splat(0.5)),
            "the box"
        );
    }
}

/// The disc, and both ends of the cylinder, show the circle that fits in the image, +x to the right and −z up
/// as seen from outside.
#[test]
fn flat_ends_show_the_circle_in_the_image() {
    let disc = primitives::disc(2.0, 16);
    for (uv, vertex) in disc.attributes().uv_sets[0].iter().zip(disc.face_vertices(0)) {
        let place = disc.positions()[*vertex as usize];
        let expected = [0.5 + 0.25 * place.x, 0.5 + 0.25 * place.z];
        assert!(uv.distance(expected.into()) < 1e-6, "{place} is at {uv} of the image, not {expected:?}");
    }
    let cylinder = primitives::cylinder(2.0, 1.0, 16);
    let mut start = 0;
    for face in 0..cylinder.face_count() {
        let corners = cylinder.face_vertices(face);
        if corners.len() == 16 {
            let uvs = &cylinder.attributes().uv_sets[0][start..start + 16];
            for (uv, vertex) in uvs.iter().zip(corners) {
                let place = cylinder.positions()[*vertex as usize];
                let from_center = uv.distance([0.5, 0.5].into());
                assert!((from_center - 0.5).abs() < 1e-6, "{place} is at {uv}, not on the circle");
                assert!((uv.x - 0.5 - 0.25 * place.x).abs() < 1e-6, "{place} is at {uv}: +x is to the right");
            }
        }
        start += corners.len();
    }
}
