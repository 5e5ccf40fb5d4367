//! What is captured is drawn again to the byte, whatever the scene holds.

use trigon_camera::{Camera, PixelCenters, Projection, Viewport};
use trigon_io::{Capture, Limits};
use trigon_math::{DAffine3, DMat3, DVec2, DVec3, Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Deltas, Mesh, MeshBuilder, MorphTarget, SkinWeights, primitives};
use trigon_scene::{
    AlphaMode, AmbientOcclusion, Animation, Background, Channel, Curve, EffectSettings, Environment, Filter,
    Fog, Interpolation, Light, Lighting, Material, MetalReflection, MetallicRoughness, MipFilter, Node,
    NormalMap, Occlusion, Outline, ParameterField, Property, Reflection, RenderSettings, Sampler, Scene,
    Shading, ShadingModel, Shadows, SightRays, Skin, Sky, Style, Texture, TextureBinding, TextureFormat,
    ToneMapping, Transform, Wrap, render, showcase,
};

fn settings() -> RenderSettings {
    RenderSettings { samples_per_axis: 1, ..RenderSettings::new(48, 32) }
}

/// Captures an image, reads it back, and draws it again.
fn check(what: &str, scene: &Scene, camera: &Camera, settings: &RenderSettings) {
    let frame = render(scene, camera, settings).expect("in range");
    let colors: std::collections::BTreeSet<_> = frame.color.chunks(4).collect();
    assert!(colors.len() > 1, "{what}: something is in the image");
    let file = Capture::new(scene.clone(), *camera, settings.clone(), &frame).to_bytes();
    let capture = Capture::from_bytes("a.trigon", &file, &Limits::default()).expect("a capture");
    assert_eq!(&capture.camera, camera, "{what}");
    assert_eq!(&capture.settings, settings, "{what}");
    let again = render(&capture.scene, &capture.camera, &capture.settings).expect("in range");
    assert_eq!(capture.mismatch(&again), None, "{what}");
    assert!(capture.to_bytes() == file, "{what}: what was read is written as it was");
}

fn with_effects(effects: EffectSettings) -> RenderSettings {
    RenderSettings { effects, ..settings() }
}

#[test]
fn the_showcase_under_every_effect() {
    let scene = showcase();
    let camera = scene.overview(1.5);
    let nodes = scene.nodes().iter().skip(1).map(|(id, _)| id).collect();
    let none = EffectSettings::default;
    let environment = |environment| Some(std::sync::Arc::new(environment));
    for effects in [
        none(),
        EffectSettings { shadows: Shadows::Maps { resolution: 64 }, ..none() },
        EffectSettings { shadows: Shadows::Rays, sight: SightRays::all(2), ..none() },
        EffectSettings { sight: SightRays::Off, ..none() },
        EffectSettings { sight: SightRays::Glass { bounces: 3 }, ..none() },
        EffectSettings { metal_reflection: MetalReflection::Ambient, ..none() },
        EffectSettings { ambient_occlusion: Some(AmbientOcclusion::new(2, 1.0)), ..none() },
        EffectSettings { environment: environment(Environment::from_sky(&Sky::default())), ..none() },
        EffectSettings {
            environment: environment(Environment::uniform(Vec3::X)),
            exposure: trigon_scene::Exposure::Stops(0.5),
            ..none()
        },
        EffectSettings {
            fog: Some(Fog { color: Vec3::ONE, density: 0.1 }),
            tone_mapping: ToneMapping::KhronosPbrNeutral,
            outline: Some(Outline { nodes, color: Vec3::Y, width: 2 }),
            ..none()
        },
    ] {
        check(
            &format!("{effects:?}").chars().take(200).collect::<String>(),
            &scene,
            &camera,
            &with_effects(effects),
        );
    }
}

#[test]
fn every_style_law_and_background() {
    let mut scene = Scene::new();
    scene.add_object("wires", wires(), Material::default());
    let camera = scene.overview(1.5);
    let plain = settings();
    for settings in [
        RenderSettings { style: Style::SurfaceWithEdges, line_width: 2.5, ..settings() },
        RenderSettings { style: Style::Wireframe, edge_color: Vec3::Z, point_size: Some(5.5), ..settings() },
        RenderSettings { style: Style::HiddenLine, samples: 4, ..settings() },
        RenderSettings { lighting: Lighting::Studio, shading: ShadingModel::Flat, ..settings() },
        RenderSettings { shading: ShadingModel::Gouraud, background: Background::Transparent, ..settings() },
        RenderSettings { background: Background::Color(Vec3::Y), light_intensity: 0.5, ..settings() },
        RenderSettings { reflection: Reflection::Lambert, samples_per_axis: 2, ..settings() },
        RenderSettings { reflection: Reflection::BlinnPhong, lighting: Lighting::Scene, ..plain },
        RenderSettings { reflection: Reflection::MetallicRoughness, ..settings() },
        RenderSettings { background: Background::Environment, ..settings() },
        RenderSettings {
            background: Background::Environment,
            ..with_effects(EffectSettings {
                environment: Some(std::sync::Arc::new(Environment::from_sky(&Sky::default()))),
                ..EffectSettings::default()
            })
        },
    ] {
        check(&format!("{settings:?}"), &scene, &camera, &settings);
    }
}

/// Polygons, turned over, with an edge and a point beside them.
fn wires() -> Mesh {
    let mut builder = MeshBuilder::new();
    let cube = primitives::cube(1.0);
    for &position in cube.positions() {
        builder.push_vertex(position);
    }
    for face in cube.faces() {
        builder.push_face(&cube.corner_vertices()[face]).expect("a face of the cube");
    }
    let [a, b] = [Vec3::ONE, Vec3::new(1.0, 0.2, 0.5)].map(|at| builder.push_vertex(at));
    builder.push_loose_edge(a, b).expect("two vertices");
    builder.push_loose_point(a).expect("a vertex");
    let mut mesh = builder.build();
    mesh.flip_faces();
    let color = |vertex: usize| Vec4::new(1.0, vertex as f32 / 16.0, 0.25, 1.0);
    let vertex_colors = Some((0..mesh.vertex_count()).map(color).collect());
    mesh.set_attributes(Attributes { vertex_colors, ..mesh.attributes().clone() }).expect("one for each");
    mesh
}

#[test]
fn every_projection() {
    let scene = showcase();
    let camera = scene.overview(1.5);
    let image = Viewport { width: 48, height: 32 };
    let (focal, center) = (DVec2::new(60.0, 60.5), DVec2::new(20.25, 17.0));
    let projections = [
        Projection::perspective(0.7, 0.1, Some(50.0)),
        Projection::orthographic(4.0, -1.0, 40.0),
        Projection::frustum(-0.05, 0.07, -0.04, 0.03, 0.1, None),
        Projection::pinhole(focal, center, image, PixelCenters::AtIntegers, 0.1),
    ];
    for projection in projections {
        let projection = projection.expect("good numbers");
        check(&format!("{projection:?}"), &scene, &camera.with_projection(projection), &settings());
    }
}

/// Removed items leave holes; what refers to them goes on finding nothing.
#[test]
fn holes_and_what_leads_into_them() {
    let mut scene = Scene::new();
    let texture = |scene: &mut Scene, color| {
        let texture = Texture::new(1, 1, vec![color], TextureFormat::Srgb).expect("a texel");
        scene.add_texture("texel", texture)
    };
    let (gone, red) = (texture(&mut scene, [0, 255, 0, 255]), texture(&mut scene, [255, 0, 0, 255]));
    let dead = scene.add_material(Material::from_color(Vec3::Y));
    let mesh = scene.add_mesh("cube", primitives::cube(1.0));
    let first = scene.add(Node::default());
    for (step, texture) in [(0.0, gone), (1.5, red)] {
        let material = scene.add_material(Material::from_texture(texture));
        let node = scene.add(Node::from_mesh(mesh, material).at(DVec3::X * step));
        scene.add_child(node, Node::from_mesh(mesh, dead).at(DVec3::Y * 1.5)).expect("just added");
    }
    scene.remove(first);
    scene.materials.remove(dead);
    scene.textures.remove(gone);
    check("holes", &scene, &scene.overview(1.5), &settings());
}

/// A binding with nothing at its default.
fn binding(scene: &mut Scene, format: TextureFormat) -> TextureBinding {
    let texel = |i: u8| [i * 16, 255 - i * 9, i * 7, if i < 8 { 255 } else { 96 }];
    let texture = Texture::new(4, 3, (0..12).map(texel).collect(), format).expect("twelve texels");
    let sampler = Sampler {
        wrap_u: Wrap::MirroredRepeat,
        wrap_v: Wrap::ClampToEdge,
        magnification: Filter::Nearest,
        minification: Filter::Linear,
        mip: MipFilter::Anisotropic(4),
    };
    let transform = trigon_math::glam::Affine2::from_scale_angle_translation(
        Vec2::new(2.0, 1.5),
        0.3,
        Vec2::new(0.1, -0.2),
    );
    TextureBinding { uv_set: 1, transform, sampler, ..TextureBinding::new(scene.add_texture("t", texture)) }
}

#[test]
fn every_part_of_a_material() {
    let mut scene = Scene::new();
    let colors = Some(binding(&mut scene, TextureFormat::Srgb));
    let data = binding(&mut scene, TextureFormat::Linear);
    let physical = MetallicRoughness {
        metallic: 0.3,
        roughness: 0.4,
        texture: Some(data),
        specular: 0.7,
        specular_texture: Some(data),
        specular_color: Vec3::new(1.0, 0.5, 0.2),
        specular_color_texture: colors,
    };
    let highlights = Shading::BlinnPhong { specular: Vec3::ONE, shininess: 9.0, specular_texture: colors };
    for (shading, alpha_mode) in [
        (Shading::MetallicRoughness(physical), AlphaMode::Blend),
        (highlights, AlphaMode::Mask { cutoff: 0.5 }),
        (Shading::Lambert, AlphaMode::Opaque),
        (Shading::Unlit, AlphaMode::Blend),
    ] {
        let mut material = Material {
            name: "all".to_owned(),
            base_color: Vec4::new(0.9, 0.8, 0.7, 0.6),
            base_color_texture: colors,
            shading,
            emissive: Vec3::new(0.1, 0.0, 0.2),
            emissive_texture: colors,
            normal_map: Some(NormalMap { binding: data, scale: 0.5 }),
            occlusion: Some(Occlusion { binding: data, strength: 0.5 }),
            alpha_mode,
            double_sided: false,
            ior: 1.3,
            ..Material::default()
        };
        for row in Material::EXTENSION_PARAMETERS {
            match row.field {
                ParameterField::Share(field) | ParameterField::Amount(field) => {
                    field(&mut material).into_iter().for_each(|share| *share = 0.5);
                }
                ParameterField::Color(field) => {
                    field(&mut material).into_iter().for_each(|color| *color = Vec3::new(1.0, 0.5, 0.2));
                }
                ParameterField::Texture(place) => {
                    let is_color = place.format() == TextureFormat::Srgb;
                    material.set_texture(place, if is_color { colors } else { Some(data) });
                }
            }
        }
        let mut scene = scene.clone();
        scene.add_object("cube", dressed_cube(), material);
        scene.add(Node::from_light(Light::spot(3.0).with_range(9.0)).at(DVec3::Z * 2.0));
        scene.add(Node::from_light(Light::ambient(0.2).with_color(Vec3::new(1.0, 0.9, 0.8))));
        let effects = EffectSettings { sight: SightRays::all(2), ..EffectSettings::default() };
        check(&format!("{shading:?}"), &scene, &scene.overview(1.5), &with_effects(effects));
    }
}

/// A cube with two UV sets, normals, colours, slots and smooth faces.
fn dressed_cube() -> Mesh {
    let mut cube = primitives::cube(1.0);
    let uv: Vec<Vec2> = (0..cube.corner_count()).map(|i| Vec2::new((i % 4) as f32, (i % 3) as f32)).collect();
    let fourth = |i: usize| Vec4::new((i % 4) as f32 / 3.0, 1.0, 0.5, 1.0);
    let attributes = Attributes {
        uv_sets: vec![uv.iter().map(|uv| *uv * 0.3).collect(), uv],
        corner_colors: Some((0..cube.corner_count()).map(fourth).collect()),
        face_materials: Some(vec![0; cube.face_count()]),
        face_smooth: Some((0..cube.face_count()).map(|face| face % 2 == 0).collect()),
        ..cube.attributes().clone()
    };
    cube.set_attributes(attributes).expect("one value for each");
    cube
}

/// A tower whose upper half follows one of two joints and a morph target, half way
/// through its animation.
#[test]
fn joints_targets_and_animations() {
    let mut tower = primitives::cube(1.0);
    let above = |position: &Vec3| if position.y > 0.0 { 1.0 } else { 0.1 };
    let weights = tower.positions().iter().flat_map(|position| [above(position), 0.37]).collect();
    let joints = tower.positions().iter().flat_map(|_| [1, 0]).collect();
    let delta = |position: &Vec3| if position.y > 0.0 { Vec3::new(0.3, 0.1, 0.0) } else { Vec3::ZERO };
    let positions = Deltas::from_dense(tower.positions().iter().map(delta));
    let attributes = Attributes {
        skin: SkinWeights::new(2, joints, weights),
        morph_targets: vec![MorphTarget { name: "lean".to_owned(), positions, ..MorphTarget::default() }],
        ..tower.attributes().clone()
    };
    tower.set_attributes(attributes).expect("two weights for each vertex");
    let mut scene = Scene::new();
    let root = scene.add(Node::default());
    let tip = scene.add_child(root, Node::default().at(DVec3::Y * 0.5)).expect("just added");
    let shear = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::new(0.2, 1.0, 0.0), DVec3::Z));
    let inverse_bind_matrices = vec![shear, DAffine3::from_translation(DVec3::Y * -0.5)];
    let skin =
        scene.skins.insert(Skin { name: "bones".to_owned(), joints: vec![root, tip], inverse_bind_matrices });
    let body = scene.add_object("tower", tower, Material::from_color(Vec3::X));
    let node = scene.node_mut(body).expect("just added");
    (node.skin, node.morph_weights, node.transform) = (Some(skin), vec![0.25], Transform::Affine(shear));
    let channel = |node, property, interpolation, width: usize, values: Vec<f32>| Channel {
        node,
        property,
        curve: Curve::new(interpolation, width, vec![0.0, 2.0], values).expect("two keyframes"),
    };
    let turn = vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.6, 0.8];
    let channels = vec![
        channel(tip, Property::Rotation, Interpolation::Linear, 4, turn),
        channel(body, Property::MorphWeights, Interpolation::Step, 1, vec![0.5, 1.0]),
        channel(
            root,
            Property::Translation,
            Interpolation::CubicSpline,
            3,
            (0..18).map(|i| i as f32 / 9.0).collect(),
        ),
        channel(root, Property::Scale, Interpolation::Linear, 3, vec![1.0, 1.0, 1.0, 1.0, 2.0, 1.0]),
    ];
    scene.animations = vec![Animation { name: "sway".to_owned(), channels }];
    let pose = scene.pose(&scene.animations[0], 1.0);
    scene.apply_pose(&pose);
    check("a pose", &scene, &scene.overview(1.5), &settings());
}

/// Marked elements are part of the settings: their sets come back.
#[test]
fn marked_elements_are_captured() {
    let mut scene = Scene::new();
    let node = scene.add_object("ball", primitives::icosphere(1.0, 1), Material::default());
    let mut elements = trigon_scene::ElementSet::default();
    let mut bits = trigon_scene::FixedBitSet::with_capacity(80);
    bits.extend([0, 33, 79]);
    elements.add(node, bits);
    let mark = trigon_scene::Mark { elements: elements.into(), color: Vec3::X, opacity: 0.5, outlined: true };
    let mut settings = settings();
    settings.marks.faces = vec![mark];
    check("marks", &scene, &scene.overview(1.5), &settings);
}
