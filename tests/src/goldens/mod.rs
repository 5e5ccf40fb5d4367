//! Golden images: small, exact, one fact each.

mod compare;

use compare::assert_golden;
use trigon_camera::Camera;
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder, primitives};
use trigon_scene::{
    AlphaMode, Background, Light, Lighting, Material, Node, RenderSettings, Sampler, Scene, Shading, Style,
    Texture, TextureBinding, TextureFormat, Transform, render,
};

const RED: Vec3 = Vec3::new(0.8, 0.1, 0.05);

/// 96×64 pixels, 2×2 samples, on a flat grey.
fn settings() -> RenderSettings {
    RenderSettings {
        background: Background::Color(Vec3::splat(0.4)),
        samples_per_axis: 2,
        ..RenderSettings::new(96, 64)
    }
}

fn check(name: &str, scene: &Scene, camera: &Camera, settings: &RenderSettings) {
    assert_golden(name, &render(scene, camera, settings).expect("the settings are in range"));
}

fn single(mesh: Mesh, material: Material) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("it", mesh, material);
    scene
}

/// Straight at the scene from +Z.
fn front(scene: &Scene) -> Camera {
    Camera::default().fit(&scene.bounds(), DVec3::NEG_Z, DVec3::Y, 1.5, 0.1)
}

#[test]
fn the_teapot_stands_upright_with_its_spout_to_the_right() {
    let scene = single(primitives::teapot(6), Material::from_color(RED));
    check("teapot", &scene, &front(&scene), &settings());
}

#[test]
fn a_wire_pyramid_shows_its_eight_edges_and_no_diagonal() {
    let scene = single(primitives::pyramid(1.0, 1.0), Material::default());
    let settings = RenderSettings { style: Style::Wireframe, ..settings() };
    check("pyramid_wireframe", &scene, &scene.overview(1.5), &settings);
}

#[test]
fn a_hidden_line_cube_shows_nine_edges() {
    let scene = single(primitives::cube(1.0), Material::default());
    let settings = RenderSettings { style: Style::HiddenLine, ..settings() };
    check("cube_hidden_line", &scene, &scene.overview(1.5), &settings);
}

#[test]
fn edges_lie_on_their_surface_without_fighting() {
    let scene = single(primitives::dodecahedron(1.0), Material::from_color(RED));
    let settings = RenderSettings { style: Style::SurfaceWithEdges, ..settings() };
    check("dodecahedron_edges", &scene, &scene.overview(1.5), &settings);
}

/// Four texels: red, green above blue, white.
fn four_colors(scene: &mut Scene) -> TextureBinding {
    let texels = vec![[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255], [255, 255, 255, 64]];
    let texture = Texture::new(2, 2, texels, TextureFormat::Srgb).expect("four texels");
    TextureBinding { sampler: Sampler::default(), ..TextureBinding::new(scene.add_texture("four", texture)) }
}

fn quad(scene: &mut Scene, material: Material) {
    let mut builder = MeshBuilder::new();
    let corners = [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let corners = corners.map(|corner| builder.push_vertex(corner));
    builder.push_face(&corners).expect("a quadrilateral");
    let mut mesh = builder.build();
    // v grows downwards: the lower left corner is (0, 1).
    let uvs = vec![Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::ZERO];
    let attributes = Attributes { uv_sets: vec![uvs], ..Attributes::default() };
    mesh.set_attributes(attributes).expect("one coordinate a corner");
    scene.add_object("quad", mesh, material);
}

#[test]
fn a_texture_lies_with_its_first_texel_at_the_upper_left() {
    let mut scene = Scene::new();
    let binding = four_colors(&mut scene);
    let material =
        Material { base_color_texture: Some(binding), shading: Shading::Unlit, ..Material::default() };
    quad(&mut scene, Material { base_color: Vec4::ONE, ..material });
    check("texture_orientation", &scene, &front(&scene), &settings());
}

#[test]
fn a_mask_cuts_holes_where_alpha_is_below_the_cutoff() {
    let mut scene = Scene::new();
    let binding = four_colors(&mut scene);
    let alpha_mode = AlphaMode::Mask { cutoff: 0.5 };
    let material = Material { base_color_texture: Some(binding), alpha_mode, ..Material::default() };
    quad(&mut scene, Material { base_color: Vec4::ONE, shading: Shading::Unlit, ..material });
    check("alpha_mask", &scene, &front(&scene), &settings());
}

#[test]
fn panes_blend_in_the_order_of_depth_not_of_submission() {
    let pane = |scene: &mut Scene, color: Vec4, at: DVec3| {
        let material = Material { base_color: color, alpha_mode: AlphaMode::Blend, ..Material::default() };
        let mesh = scene.add_mesh("pane", primitives::cube(1.0));
        let material = scene.add_material(material.with_shading(Shading::Unlit));
        scene.add(Node::from_mesh(mesh, material).at(at));
    };
    let (near, far) =
        ((Vec4::new(0.9, 0.1, 0.1, 0.5), DVec3::Z * 1.5), (Vec4::new(0.1, 0.1, 0.9, 0.5), DVec3::X * 0.6));
    let mut images = Vec::new();
    for order in [[near, far], [far, near]] {
        let mut scene = Scene::new();
        for (color, at) in order {
            pane(&mut scene, color, at);
        }
        let frame = render(&scene, &front(&scene), &settings()).expect("in range");
        assert_golden("blend_two_panes", &frame);
        images.push(frame.color);
    }
    assert!(images[0] == images[1], "the order of submission does not matter");
}

#[test]
fn a_point_light_falls_off_over_a_floor() {
    let mut scene =
        single(primitives::plane(4.0, 4.0), Material::from_color(Vec3::ONE).with_shading(Shading::Lambert));
    scene.add(Node::from_light(Light::point(0.6)).at(DVec3::new(-0.8, 0.7, 0.0)));
    let settings = RenderSettings { lighting: Lighting::Scene, ..settings() };
    check("point_light", &scene, &scene.overview(1.5), &settings);
}

#[test]
fn a_mirrored_object_is_lit_like_its_twin() {
    let mut scene = Scene::new();
    let cone = scene.add_mesh("cone", primitives::cone(0.5, 1.0, 24));
    let material = scene.add_material(Material { double_sided: false, ..Material::from_color(RED) });
    scene.add(Node::from_mesh(cone, material).at(DVec3::new(-0.7, 0.0, 0.0)));
    let mirror = Transform::from_scale_rotation_translation(
        DVec3::new(-1.0, 1.0, 1.0),
        trigon_math::DQuat::IDENTITY,
        DVec3::new(0.7, 0.0, 0.0),
    );
    scene.add(Node::from_mesh(cone, material).with_transform(mirror));
    check("mirrored", &scene, &scene.overview(1.5), &settings());
}
