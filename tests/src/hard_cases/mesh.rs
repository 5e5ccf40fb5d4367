//! Meshes whose attributes say nothing or contradict each other, as they are drawn.
//! Polygons and normals themselves are tested in `crates/mesh/tests`.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, primitives};
use trigon_scene::{
    Background, Light, Lighting, Material, Node, RenderSettings, Scene, Shading, ShadingModel, Transform,
    render,
};

use super::flight::{check_numbers, settings};
use crate::effort::cases;

/// A square of two metres that faces +Z, with a normal for each corner.
fn square(normals: [Vec3; 4]) -> Mesh {
    let mut builder = MeshBuilder::new();
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let corners = corners.map(|(x, y)| builder.push_vertex(Vec3::new(x, y, 0.0)));
    builder.push_face(&corners).expect("four vertices that exist");
    let mut mesh = builder.build();
    let attributes = Attributes { corner_normals: Some(normals.to_vec()), ..Attributes::default() };
    mesh.set_attributes(attributes).expect("four normals for four corners");
    mesh
}

/// Pixels on a side of the image of normals; eight make a metre.
const NORMALS: u32 = 24;

/// Where a pixel's centre is on the square, in metres.
fn on_square(index: usize) -> [f64; 2] {
    let [column, row] =
        [index as u32 % NORMALS, index as u32 / NORMALS].map(|at| (f64::from(at) + 0.5) / 8.0);
    [column - 1.5, 1.5 - row]
}

/// The weights of three of the square's corners at a point of it, by areas.
fn weights([a, b, c]: [[f64; 2]; 3], [x, y]: [f64; 2]) -> [f64; 3] {
    let cross = |p: [f64; 2], q: [f64; 2]| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x);
    let areas = [cross(b, c), cross(c, a), cross(a, b)];
    areas.map(|area| area / areas.iter().sum::<f64>())
}

/// The sums of the corners' unit normals at a point of the square: along either diagonal, for a quad may be cut
/// along both. What has no direction stands upright.
fn sums(normals: &[Vec3; 4], point: [f64; 2]) -> Vec<DVec3> {
    const CORNERS: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let unit = |normal: Vec3| {
        let wide = normal.as_dvec3();
        if wide.is_finite() && wide != DVec3::ZERO { wide / wide.length() } else { DVec3::Z }
    };
    let halves = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]];
    let shares = halves.map(|half| weights(half.map(|corner: usize| CORNERS[corner]), point));
    let within = halves.iter().zip(shares).filter(|(_, shares)| shares.iter().all(|&share| share >= 0.0));
    within
        .map(|(half, shares)| {
            half.iter().zip(shares).map(|(&corner, share)| unit(normals[corner]) * share).sum()
        })
        .collect()
}

fn normal() -> impl Strategy<Value = Vec3> {
    let number = || {
        prop_oneof![-1.0_f32..1.0, Just(0.0), Just(-0.0), Just(f32::MIN_POSITIVE), Just(1e-45), Just(1e30)]
    };
    let wild = prop_oneof![4 => Just(0.0_f32), 1 => Just(f32::NAN), 1 => Just(f32::INFINITY)];
    (number(), number(), number(), wild).prop_map(|(x, y, z, wild)| Vec3::new(x, y, z) + Vec3::splat(wild))
}

proptest! {
    #![proptest_config(cases(64))]

    /// Normals of any kind at the corners: the square covers its pixels, and each shows the unit vector along the sum
    /// of its corners' unit normals. Where neighbours cancel each other it may be zero, but never anything in between;
    /// and nothing is NaN.
    #[test]
    fn any_corner_normals_shade_without_nan(
        normals in prop::array::uniform4(normal()),
        model in prop_oneof![Just(ShadingModel::Flat), Just(ShadingModel::Gouraud), Just(ShadingModel::Phong)],
    ) {
        let mut scene = Scene::new();
        scene.add_object("square", square(normals), Material::default());
        let settings = RenderSettings { shading: model, ..settings([NORMALS; 2]) };
        let projection = Projection::orthographic(3.0, 0.1, 10.0).expect("in range");
        let camera = Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y).with_projection(projection);
        let frame = render(&scene, &camera, &settings).expect("in range");
        check_numbers(&frame);
        let (ids, shown) = (frame.object_ids.expect("asked for"), frame.normals.expect("asked for"));
        for (index, (&id, normal)) in ids.iter().zip(&shown).enumerate() {
            let point = on_square(index);
            let is_on_it = point.iter().all(|at| at.abs() < 1.0);
            prop_assert_eq!(id == 0, is_on_it, "at {:?}", point);
            // Three squares, two sums, a root and three quotients, each to half a unit of
            // the last place.
            let error = (normal.as_dvec3().length() - 1.0).abs();
            prop_assert!(*normal == Vec3::ZERO || error < 4.0 * f64::from(f32::EPSILON), "{}", normal);
            // A corner's normal is rounded when it is stored, when it is turned and made a unit vector again, and the sum
            // once more; weights are those of corners in f32: 32 roundings, over what is left of the sum. Where that
            // is a thousandth, the direction is open.
            let is_right = |sum: &DVec3| {
                let bound = 32.0 * f64::from(f32::EPSILON) / 2.0 / sum.length();
                sum.length() < 1e-3 || (normal.as_dvec3() - sum.normalize()).length() <= bound
            };
            let expected = sums(&normals, point);
            let is_expected = if is_on_it { expected.iter().any(is_right) } else { *normal == Vec3::ZERO };
            prop_assert!(is_expected, "{} at {:?} instead of one of {:?}", normal, point, expected);
        }
    }

    /// Texture coordinates that are equal, in line, or no numbers still give every corner
    /// a tangent: a unit vector, and a side.
    #[test]
    fn any_texture_coordinates_give_tangents(
        uvs in prop::collection::vec(prop::array::uniform2(prop_oneof![
            3 => (-2..3_i8).prop_map(f32::from), 1 => -1e5_f32..1e5, 1 => Just(f32::NAN), 1 => Just(f32::INFINITY), 1 => Just(1e-45),
        ]), 24),
        flattened in any::<bool>(),
    ) {
        let mut mesh = primitives::cube(1.0);
        if flattened {
            mesh.positions_mut().iter_mut().for_each(|place| place.x = 0.0);
        }
        let uv_sets = vec![uvs.into_iter().map(Vec2::from).collect()];
        mesh.set_attributes(Attributes { uv_sets, ..Attributes::default() }).expect("24 corners");
        let tangents = mesh.generate_tangents(0).expect("there is a set");
        for tangent in &tangents {
            // As above.
            let error = (tangent.truncate().as_dvec3().length() - 1.0).abs();
            prop_assert!(error < 4.0 * f64::from(f32::EPSILON), "{} is no unit vector", tangent);
            prop_assert!(tangent.w.abs() == 1.0, "{} has no side", tangent);
        }
        if flattened {
            return Ok(());
        }
        let triangles = mesh.triangulation().triangles;
        for (corner, tangent) in tangents.iter().enumerate() {
            let around: Vec<_> = triangles.iter().filter(|triangle| triangle.contains(&(corner as u32))).collect();
            // Two triangles share the others; how they are weighed is MikkTSpace's.
            let [triangle] = around[..] else { continue };
            let Some(directions) = Directions::of(&mesh, triangle) else { continue };
            let along_u = directions.along_u.normalize();
            let difference = (tangent.truncate().as_dvec3() - along_u).length();
            prop_assert!(difference < directions.error, "corner {}: {} instead of {}", corner, tangent, along_u);
            let bitangent = directions.normal.cross(tangent.truncate().as_dvec3()) * f64::from(tangent.w);
            prop_assert!(bitangent.dot(directions.along_v) < 0.0, "corner {}: v falls along the bitangent", corner);
        }
    }
}

/// Where a triangle's texture coordinates grow.
struct Directions {
    along_u: DVec3,
    along_v: DVec3,
    normal: DVec3,
    /// How far a tangent computed in f32 may be from the direction of `along_u`.
    error: f64,
}

impl Directions {
    /// From the two equations `edge = u * along_u + v * along_v`, by Cramer's rule. `None` if they cannot be told from
    /// linearly dependent ones in f32.
    fn of(mesh: &Mesh, triangle: &[u32; 3]) -> Option<Self> {
        let position =
            |corner: u32| mesh.positions()[mesh.corner_vertices()[corner as usize] as usize].as_dvec3();
        let uv = |corner: u32| mesh.attributes().uv_sets[0][corner as usize].as_dvec2();
        let [a, b, c] = *triangle;
        let (first, second) = (position(b) - position(a), position(c) - position(a));
        let (of_first, of_second) = (uv(b) - uv(a), uv(c) - uv(a));
        let products = [of_first.x * of_second.y, of_first.y * of_second.x];
        let determinant = products[0] - products[1];
        // Two differences, a product and a sum, each rounded.
        let rounding = 4.0 * f64::from(f32::EPSILON);
        let is_decided = determinant.abs() > rounding * (products[0].abs() + products[1].abs());
        // NaN is not decided; smaller products are no normal numbers in f32.
        if !is_decided || determinant.abs() < 1e-30 {
            return None;
        }
        let scaled = first * of_second.y - second * of_first.y;
        let size = first.length() * of_second.y.abs() + second.length() * of_first.y.abs();
        Some(Self {
            along_u: scaled / determinant,
            along_v: (second * of_first.x - first * of_second.x) / determinant,
            normal: first.cross(second),
            // The same, and a unit vector's.
            error: rounding * (1.0 + size / scaled.length()),
        })
    }
}

/// Normals that point against each other along an edge have no direction in its middle.
/// The edge runs through samples, so there the sum is exactly zero; of the nine samples
/// of the pixel, six are on the square, and one of them may be dark. One that is NaN
/// would take all nine with it.
#[test]
fn opposite_normals_on_an_edge_leave_no_hole() {
    const PIXELS: u32 = 33;
    let along = Vec3::new(0.6, 0.0, 0.8);
    for model in [ShadingModel::Gouraud, ShadingModel::Phong] {
        let mut scene = Scene::new();
        let matt = Material { shading: Shading::Lambert, base_color: Vec4::ONE, ..Material::default() };
        scene.add_object("square", square([along, -along, -along, along]), matt);
        for backwards in [DQuat::IDENTITY, DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0)] {
            let turned = Transform::from_scale_rotation_translation(DVec3::ONE, backwards, DVec3::ZERO);
            scene.add(Node::from_light(Light::directional(1.0)).with_transform(turned));
        }
        let settings = RenderSettings {
            shading: model,
            lighting: Lighting::Scene,
            background: Background::Color(Vec3::ZERO),
            samples_per_axis: 3,
            ..settings([PIXELS; 2])
        };
        // 16 pixels to the metre: the middle of the uppermost row is at y = 1.
        let projection = Projection::orthographic(f64::from(PIXELS) / 16.0, 0.1, 10.0).expect("in range");
        let camera = Camera::look_at(DVec3::Z * 4.0, DVec3::ZERO, DVec3::Y).with_projection(projection);
        let frame = render(&scene, &camera, &settings).expect("in range");
        check_numbers(&frame);
        // Both lamps together shine with 0.8 of their light on either side; five ninths
        // of that are 0.44, six 0.53, and linear 0.43 and 0.54 are the bytes 175 and 194.
        let middle = frame.pixel(PIXELS / 2, 0)[0];
        assert!((175..=194).contains(&middle), "{model:?}: the middle of the edge shows {middle}");
    }
}
