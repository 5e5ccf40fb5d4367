//! Values that no file should hold, everywhere at once: NaN, infinities, denormals, −0
//! and numbers that overflow when they are squared.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, SkinWeights, primitives};
use trigon_scene::{
    AlphaMode, Frame, Light, Material, MetallicRoughness, Node, Outputs, RenderSettings, Renderer, Scene,
    Shading, ShadingModel, Skin, Style, Transform, render,
};

use super::flight::{check_ids, check_numbers};
use super::flight_oracle::Oracle;
use super::flight_scenes::in_triangles;
use crate::effort::cases;

/// f32 of every kind.
fn wild() -> impl Strategy<Value = f32> {
    prop_oneof![
        6 => -2.0_f32..2.0,
        1 => any::<u32>().prop_map(f32::from_bits),
        1 => prop::sample::select(vec![
            0.0, -0.0, 1e-45, -1e-40, f32::MIN_POSITIVE, 1e-20, 1e20, 1e38, f32::MAX, f32::MIN, f32::NAN,
            f32::INFINITY, f32::NEG_INFINITY,
        ]),
    ]
}

/// f64 of every kind.
fn wild_wide() -> impl Strategy<Value = f64> {
    prop_oneof![
        12 => -2.0_f64..2.0,
        1 => any::<u64>().prop_map(f64::from_bits),
        1 => prop::sample::select(vec![
            0.0, -0.0, 5e-324, 1e-310, 1e-160, 1e160, 1e300, f64::MAX, f64::NAN, f64::INFINITY, f64::NEG_INFINITY,
        ]),
    ]
}

fn vectors(count: usize) -> impl Strategy<Value = Vec<Vec3>> {
    prop::collection::vec(prop::array::uniform3(wild()).prop_map(Vec3::from), count)
}

/// A cube with all attributes, none of which can be trusted.
fn mesh() -> impl Strategy<Value = Mesh> {
    let corners = || vectors(24);
    let quads = || prop::collection::vec(prop::array::uniform4(wild()).prop_map(Vec4::from), 24);
    (vectors(8), corners(), quads(), corners(), quads(), prop::collection::vec(wild(), 16), any::<bool>())
        .prop_map(|(positions, normals, tangents, uvs, colors, weights, skinned)| {
            let mut mesh = primitives::cube(1.0);
            // Every other one stays, so that something is seen.
            for (place, wild) in mesh.positions_mut().iter_mut().zip(positions).step_by(2) {
                *place = wild;
            }
            let attributes = Attributes {
                corner_normals: Some(normals),
                corner_tangents: Some(tangents),
                uv_sets: vec![uvs.iter().map(|uv| Vec2::new(uv.x, uv.y)).collect()],
                corner_colors: Some(colors),
                skin: skinned.then(|| SkinWeights::new(2, vec![0; 16], weights)).flatten(),
                ..Attributes::default()
            };
            mesh.set_attributes(attributes).expect("one value for each");
            mesh
        })
}

fn transform() -> impl Strategy<Value = Transform> {
    let wide = || prop::array::uniform3(wild_wide()).prop_map(DVec3::from_array);
    let decomposed =
        (wide(), prop::array::uniform4(wild_wide()), wide()).prop_map(|(scale, [x, y, z, w], to)| {
            Transform::from_scale_rotation_translation(scale, DQuat::from_xyzw(x, y, z, w), to)
        });
    let affine = prop::array::uniform4(wide()).prop_map(|[x, y, z, translation]| {
        Transform::Affine(DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation })
    });
    prop_oneof![2 => Just(Transform::IDENTITY), 1 => decomposed, 1 => affine]
}

fn material() -> impl Strategy<Value = Material> {
    let alpha = prop_oneof![
        Just(AlphaMode::Opaque),
        Just(AlphaMode::Blend),
        wild().prop_map(|cutoff| AlphaMode::Mask { cutoff })
    ];
    (prop::array::uniform8(wild()), alpha, 0..4_u8, any::<bool>()).prop_map(
        |([r, g, b, a, c, d, e, ior], alpha_mode, law, double_sided)| {
            let shading = match law {
                0 => Shading::Unlit,
                1 => Shading::Lambert,
                2 => Shading::blinn_phong(Vec3::new(c, d, e), c),
                _ => Shading::MetallicRoughness(MetallicRoughness {
                    metallic: c,
                    roughness: d,
                    specular: e,
                    specular_color: Vec3::new(r, c, d),
                    ..MetallicRoughness::default()
                }),
            };
            Material {
                base_color: Vec4::new(r, g, b, a),
                emissive: Vec3::new(e, d, c),
                shading,
                alpha_mode,
                ior,
                double_sided,
                ..Material::default()
            }
        },
    )
}

fn everything(style: Style, shading: ShadingModel, of_blended: bool) -> RenderSettings {
    let outputs = Outputs { of_blended, ..Outputs::ALL };
    RenderSettings { outputs, samples_per_axis: 1, style, shading, ..RenderSettings::new(32, 24) }
}

fn style() -> impl Strategy<Value = (Style, ShadingModel)> {
    prop_oneof![
        Just((Style::Surface, ShadingModel::Phong)),
        Just((Style::Surface, ShadingModel::Gouraud)),
        Just((Style::Surface, ShadingModel::Flat)),
        Just((Style::SurfaceWithEdges, ShadingModel::Phong)),
        Just((Style::HiddenLine, ShadingModel::Phong)),
    ]
}

/// A scene of one such mesh, on a skin if it has weights, and a lamp.
fn scene(mesh: Mesh, transform: Transform, material: Material, lamp: Light) -> Scene {
    let mut scene = Scene::new();
    let skinned = mesh.attributes().skin.is_some();
    let node = scene.add_object("hostile", mesh, material);
    scene.add(Node::from_light(lamp).at(DVec3::new(1.0, 2.0, 3.0)));
    if skinned {
        let joint = scene.add(Node::default().with_transform(transform));
        let skin = Skin { joints: vec![joint], ..Skin::default() };
        let skin = scene.skins.insert(skin);
        scene.node_mut(node).expect("just added").skin = Some(skin);
    } else {
        scene.node_mut(node).expect("just added").transform = transform;
    }
    scene
}

/// How far ahead of the eye the plate is, in metres.
const PLATE: f64 = 0.5;

/// A plate with sound numbers before the eye, over the middle of the image; its id.
fn add_plate(scene: &mut Scene, camera: &Camera) -> u32 {
    let node = scene.add_object("plate", primitives::cube(1.0), Material::from_color(Vec3::ONE));
    let [size, thickness] = [0.2, 1e-3];
    let ahead = camera.orientation * DVec3::NEG_Z;
    scene.node_mut(node).expect("just added").transform = Transform::from_scale_rotation_translation(
        DVec3::new(size, size, thickness),
        camera.orientation,
        camera.position + ahead * (PLATE + thickness / 2.0),
    );
    node.index() as u32
}

/// The pixels in the middle show the plate, or something of any numbers that is nearer.
fn check_plate(frame: &Frame, plate: u32) {
    let (ids, depths) =
        (frame.object_ids.as_ref().expect("asked for"), frame.depth.as_ref().expect("asked for"));
    let [width, height] = [frame.width, frame.height].map(|size| size as usize);
    for at in
        [height / 2 - 1, height / 2].iter().flat_map(|y| [y * width + width / 2 - 1, y * width + width / 2])
    {
        let (id, depth) = (ids[at], f64::from(depths[at]));
        // Depth is rounded to f32 as 0.1 over itself, and the plate's corners are.
        let error = (depth - PLATE).abs();
        assert!(id != plate || error < 1e-6, "the plate is seen at {depth}");
        assert!(
            id == plate || (depth > 0.0 && depth < PLATE),
            "node {id} is seen at {depth}, behind the plate"
        );
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn no_value_in_a_scene_makes_an_output_nan(
        mesh in mesh(), transform in transform(), material in material(), lamp in prop::array::uniform4(wild()),
        (style, shading) in style(), of_blended in any::<bool>(),
    ) {
        let [intensity, range, red, blue] = lamp;
        let lamp = Light { color: Vec3::new(red, 1.0, blue), range, ..Light::point(intensity) };
        let mut scene = scene(mesh, transform, material, lamp);
        let camera = Camera::look_at(DVec3::new(2.0, 1.5, 3.0), DVec3::ZERO, DVec3::Y);
        let plate = add_plate(&mut scene, &camera);
        let frame = render(&scene, &camera, &everything(style, shading, of_blended)).expect("in range");
        check_numbers(&frame);
        check_plate(&frame, plate);
    }

    /// Nor in a camera, whose fields are open to everybody.
    #[test]
    fn no_value_in_a_camera_makes_an_output_nan(
        position in prop::array::uniform3(wild_wide()), orientation in prop::array::uniform4(wild_wide()), parallel in any::<bool>(),
    ) {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(1.0), Material::default());
        let projection = if parallel { Projection::orthographic(3.0, -5.0, 5.0) } else { Projection::perspective(1.0, 0.1, None) };
        let [x, y, z, w] = orientation;
        let camera = Camera {
            position: DVec3::from_array(position),
            orientation: DQuat::from_xyzw(x, y, z, w),
            projection: projection.expect("in range"),
        };
        let settings = everything(Style::SurfaceWithEdges, ShadingModel::Phong, false);
        let mut renderer = Renderer::new(settings);
        check_numbers(&renderer.render(&scene, &camera).expect("in range"));
        // And it leaves no trace: the next camera shows the cube.
        let sound = Camera::look_at(DVec3::Z * 3.0, DVec3::ZERO, DVec3::Y);
        let next = renderer.render(&scene, &sound).expect("in range");
        check_numbers(&next);
        let middle = (next.height / 2 * next.width + next.width / 2) as usize;
        prop_assert_eq!(next.object_ids.as_ref().map(|ids| ids[middle]), Some(0), "the cube is in the middle");
        prop_assert!(next == render(&scene, &sound, renderer.settings()).expect("in range"), "as by a new renderer");
    }
}

/// A cube whose corners have these weights, on joints a metre to the right and a metre to the left.
fn followed(weights: &[f32]) -> Frame {
    let mut mesh = in_triangles(&primitives::cube(1.0));
    let joints = [0_u16, 1].repeat(8);
    let skin = SkinWeights::new(2, joints, weights.repeat(8)).expect("two for each of eight");
    mesh.set_attributes(Attributes { skin: Some(skin), ..Attributes::default() }).expect("eight vertices");
    let mut scene = Scene::new();
    let node = scene.add_object("cube", mesh, Material::default());
    let joints = [DVec3::X, DVec3::NEG_X].map(|place| scene.add(Node::default().at(place)));
    let skin = scene.skins.insert(Skin { joints: joints.to_vec(), ..Skin::default() });
    scene.node_mut(node).expect("just added").skin = Some(skin);
    let settings = everything(Style::Surface, ShadingModel::Phong, false);
    render(&scene, &from_front(), &settings).expect("in range")
}

fn from_front() -> Camera {
    Camera::look_at(DVec3::Z * 6.0, DVec3::ZERO, DVec3::Y)
}

/// Rays meet a cube without joints that far to the right, where the frame shows it.
fn check_shift(frame: &Frame, metres: f64, context: &str) {
    let mut scene = Scene::new();
    let cube = scene.add_object("cube", in_triangles(&primitives::cube(1.0)), Material::default());
    scene.node_mut(cube).expect("just added").transform = Transform::from_translation(DVec3::X * metres);
    let oracle = Oracle::new(&scene, &from_front(), [frame.width, frame.height]);
    let decided = check_ids(frame, &oracle, context);
    assert!(decided > 0.9, "{context}: {decided} of the pixels are decided");
}

/// Weights count by their share of the sum, whatever that is.
#[test]
fn weights_that_do_not_sum_to_one_count_by_their_share() {
    for weights in [
        [0.75, 0.25],
        [3.0, 1.0],
        [0.375, 0.125],
        [3e38, 1e38],
        [f32::from_bits(3), f32::from_bits(1)],
        [0.75e-30, 0.25e-30],
    ] {
        // Three quarters of the way to the first joint less a quarter of that to the second. Three and one
        // of the least steps that there are, and decimals, are a rounding away from three to one.
        check_shift(&followed(&weights), 0.5, &format!("{weights:?}"));
    }
    for nothing in [[0.0, 0.0], [f32::NAN, 0.0], [-1.0, f32::INFINITY]] {
        check_shift(&followed(&nothing), 1.0, &format!("{nothing:?}: the first joint"));
    }
}
