//! Lines and points in the colours of their vertices. glTF 2.0, section 3.7.2.1: without normals they show base colour
//! times COLOR_0, plus emission, whatever the light.

use trigon_mesh::Attributes;

use super::*;
use crate::{AlphaMode, Effect, EffectPlan, Lighting};

/// The background, opaque.
const BACKGROUND: Vec4 = Vec4::new(0.25, 0.25, 0.25, 1.0);

const HALF: Vec4 = Vec4::new(0.5, 1.0, 0.25, 1.0);

/// Three vertices from left to right, half a unit apart, with colours.
fn three(colors: [Vec4; 3], elements: impl Fn(&mut MeshBuilder)) -> Mesh {
    let mut builder = MeshBuilder::new();
    // +X is on the left.
    for x in [0.5, 0.0, -0.5] {
        builder.push_vertex(Vec3::new(x, 0.0, 0.0));
    }
    elements(&mut builder);
    let mut mesh = builder.build();
    let vertex_colors = Some(colors.to_vec());
    mesh.set_attributes(Attributes { vertex_colors, ..Attributes::default() }).expect("one for each vertex");
    mesh
}

fn points(builder: &mut MeshBuilder) {
    (0..3).for_each(|vertex| {
        builder.push_loose_point(vertex).expect("a vertex");
    });
}

fn line(builder: &mut MeshBuilder) {
    builder.push_loose_edge(0, 1).expect("two vertices");
    builder.push_loose_edge(1, 2).expect("two vertices");
}

fn camera() -> Camera {
    let projection = Projection::orthographic(2.0, 0.1, 100.0).expect("in range");
    Camera::look_at(DVec3::new(0.0, 10.0, 0.0), DVec3::ZERO, DVec3::Z).with_projection(projection)
}

fn settings() -> RenderSettings {
    RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(BACKGROUND.truncate()),
        // No light at all.
        lighting: Lighting::Scene,
        line_width: 2.0,
        outputs: Outputs { radiance: true, ..Outputs::default() },
        ..RenderSettings::new(SIDE, SIDE)
    }
}

fn scene_of(mesh: Mesh, material: Material) -> Scene {
    let mut scene = Scene::new();
    scene.add_object("it", mesh, material);
    scene
}

/// What a column of the image shows in its middle.
fn middle(scene: &Scene, column: u32) -> Vec3 {
    let frame = render(scene, &camera(), &settings()).expect("in range");
    let light = frame.radiance.expect("asked for")[((SIDE / 2) * SIDE + column) as usize];
    Vec3::new(light.x, light.y, light.z)
}

/// The columns of the three vertices.
const COLUMNS: [u32; 3] = [SIDE / 4, SIDE / 2, 3 * SIDE / 4];

fn base(base_color: Vec4) -> Material {
    Material { base_color, ..Material::default() }
}

#[test]
fn points_show_the_colours_of_their_vertices_times_the_base_colour() {
    let colors = [Vec4::new(1.0, 0.0, 0.5, 1.0), Vec4::ONE, Vec4::new(0.0, 0.125, 1.0, 1.0)];
    let scene = scene_of(three(colors, points), base(HALF));
    for (color, column) in colors.into_iter().zip(COLUMNS) {
        assert_eq!(
            middle(&scene, column),
            (color * HALF).truncate(),
            "in column {column}, without any light"
        );
    }
    assert_eq!(middle(&scene, SIDE / 8), BACKGROUND.truncate(), "beside them");
}

#[test]
fn colours_go_along_lines() {
    let colors = [Vec4::W, Vec4::ONE, Vec4::new(1.0, 0.0, 0.0, 1.0)];
    let scene = scene_of(three(colors, line), base(HALF));
    for step in 0..24 {
        // The middle of a pixel, half a pixel after the vertex.
        let share = (step as f32 + 0.5) / 24.0;
        for (vertex, first) in [(0, COLUMNS[0]), (1, COLUMNS[1])] {
            let expected = (colors[vertex] * (1.0 - share) + colors[vertex + 1] * share) * HALF;
            let found = middle(&scene, first + step);
            // A line is a pixel longer at either end, and its colours are stretched with it.
            assert!((found - expected.truncate()).abs().max_element() < 1.0 / 24.0, "{found} for {expected}");
        }
    }
}

#[test]
fn emission_is_added() {
    let material = Material { emissive: Vec3::new(0.0, 0.5, 2.0), ..base(HALF) };
    for elements in [points, line] {
        let scene = scene_of(three([Vec4::ONE; 3], elements), material.clone());
        assert_eq!(middle(&scene, COLUMNS[1]), Vec3::new(0.5, 1.5, 2.25), "base colour and emission");
    }
}

#[test]
fn alpha_counts_where_the_material_says_so() {
    let colors = [0.25, 0.75, 1.0].map(|alpha| Vec4::new(1.0, 0.0, 0.0, alpha));
    let over = |alpha: f32| Vec3::X * alpha + BACKGROUND.truncate() * (1.0 - alpha);
    let cases = [
        (AlphaMode::Opaque, [Vec3::X; 2]),
        (AlphaMode::Mask { cutoff: 0.5 }, [BACKGROUND.truncate(), Vec3::X]),
        (AlphaMode::Blend, [over(0.25), over(0.75)]),
    ];
    for (alpha_mode, expected) in cases {
        for (elements, tolerance) in [(points as fn(&mut MeshBuilder), 1e-6), (line, 0.03)] {
            let scene = scene_of(three(colors, elements), Material { alpha_mode, ..base(Vec4::ONE) });
            for (expected, column) in expected.into_iter().zip(COLUMNS) {
                let found = middle(&scene, column);
                assert!((found - expected).abs().max_element() <= tolerance, "{found} with {alpha_mode:?}");
            }
        }
    }
}

#[test]
fn the_plan_knows_what_points_have_in_every_style() {
    let material = Material { alpha_mode: AlphaMode::Blend, emissive: Vec3::ONE, ..base(Vec4::ONE) };
    let scene = scene_of(three([Vec4::ONE; 3], points), material);
    for style in [Style::Surface, Style::Wireframe] {
        let plan = EffectPlan::new(&scene, &camera(), &RenderSettings { style, ..settings() });
        for effect in [Effect::VertexColors, Effect::Transparency, Effect::Emission] {
            assert!(plan.is_on(effect), "{effect} in {style:?}: {}", plan.decision(effect));
        }
        assert!(!plan.is_on(Effect::Lamps) && !plan.is_on(Effect::AmbientLight), "points need no light");
    }
}

#[test]
fn many_points_are_smaller() {
    let settings = RenderSettings::new(1000, 1000);
    assert_eq!(settings.size_of_points(1), 3.0, "a point alone");
    assert_eq!(settings.size_of_points(1_000_000), 2.0, "four pixels for each of as many points as pixels");
    assert_eq!(settings.size_of_points(10_000_000), 1.0, "no less than a pixel");
    let draft = RenderSettings { line_width: 0.5, ..RenderSettings::new(500, 500) };
    assert_eq!(draft.size_of_points(1_000_000), 1.0, "half as large in an image of half the size");
    let chosen = RenderSettings { point_size: Some(7.0), ..settings };
    assert_eq!(chosen.size_of_points(10_000_000), 7.0, "as asked");
}
