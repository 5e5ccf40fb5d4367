//! What meshes and renderers keep from frame to frame changes no byte of a later one.

use proptest::prelude::*;
use trigon_mesh::{Deltas, Mesh, MorphTarget};

use super::*;
use crate::{AmbientOcclusion, Fog, MaterialId, NodeId, Outputs, TextureId};

/// A square with two UV sets, the second turned by a quarter. Half of it is in another
/// material slot, and a morph target moves it to the right.
fn square() -> Mesh {
    let mut square = primitives::grid(1.0, 1.0, 2, 1);
    let attributes = square.attributes().clone();
    let turned = attributes.uv_sets[0].iter().map(|uv| uv.perp()).collect();
    let positions = Deltas::from_dense(vec![Vec3::X; square.vertex_count()]);
    let attributes = Attributes {
        uv_sets: vec![attributes.uv_sets[0].clone(), turned],
        face_materials: Some(vec![0, 1]),
        morph_targets: vec![MorphTarget { positions, ..MorphTarget::default() }],
        ..attributes
    };
    square.set_attributes(attributes).expect("a value for each element");
    square
}

/// The same scene with nothing kept of any mesh.
fn cold(scene: &Scene) -> Scene {
    let mut cold = scene.clone();
    let meshes: Vec<_> = scene.meshes().iter().map(|(id, asset)| (id, asset.mesh().clone())).collect();
    for (id, mesh) in meshes {
        cold.replace_mesh(id, mesh).expect("it is there");
    }
    cold
}

/// An image of one texel.
fn texel(texel: [u8; 4]) -> Texture {
    Texture::new(1, 1, vec![texel], TextureFormat::Linear).expect("one texel")
}

/// A square, and a material for each of its UV sets with a normal map on that one, which
/// bends normals towards growing u.
fn bumpy_square(weight: f32) -> (Scene, NodeId, [MaterialId; 2]) {
    let mut scene = Scene::new();
    let texture = scene.add_texture("towards u", texel([218, 128, 218, 255]));
    let materials = [0, 1].map(|uv_set| {
        let binding = TextureBinding { uv_set, ..TextureBinding::new(texture) };
        let normal_map = Some(NormalMap { binding, scale: 1.0 });
        scene.add_material(Material { normal_map, ..matt(Vec3::ONE) })
    });
    let mesh = scene.add_mesh("square", square());
    let node = Node { materials: materials.to_vec(), ..Node::from_mesh(mesh, materials[0]) };
    let node = scene.add(Node { morph_weights: vec![weight], ..node });
    scene.add(shining(Light::directional(1.0), DVec3::ZERO, DVec3::new(-1.0, -1.0, 0.1)));
    (scene, node, materials)
}

/// The first normal map that asked for tangents got those of its own UV set, and so did
/// all others of the mesh, in this image and in later ones.
#[test]
fn normal_maps_on_two_uv_sets_each_have_their_own_tangents() {
    let settings = settings(EffectSettings::default());
    let settings =
        RenderSettings { outputs: Outputs { normals: true, ..Outputs::default() }, ..settings.clone() };
    let draw = |scene: &Scene| render(scene, &from_above(), &settings).expect("drawn");
    for weight in [0.0, 0.5] {
        let (mut scene, node, materials) = bumpy_square(weight);
        let in_slots = |scene: &mut Scene, slots: [usize; 2]| {
            scene.node_mut(node).expect("it is there").materials = slots.map(|slot| materials[slot]).into();
        };
        let [along_u, along_other] = [[0, 0], [1, 1]].map(|slots| {
            in_slots(&mut scene, slots);
            let drawn = draw(&scene);
            assert!(drawn == draw(&cold(&scene)), "after another map, in slots {slots:?}");
            drawn
        });
        assert!(along_u != along_other, "the sets are turned against each other");
        for slots in [[0, 1], [1, 0]] {
            in_slots(&mut scene, slots);
            for (mixed, order) in [(draw(&scene), "warm"), (draw(&cold(&scene)), "cold")] {
                for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
                    // The halves meet in the middle of the square.
                    let middle = SIDE / 2 + (weight * SIDE as f32 / WIDE as f32) as u32;
                    let one = [&along_u, &along_other][slots[usize::from(x >= middle)]];
                    assert_eq!(mixed.pixel(x, y), one.pixel(x, y), "({x}, {y}), {slots:?}, {order}");
                }
            }
        }
    }
}

/// The list of the textures that rays and shadow maps look up had no gaps: one that was
/// gone could not be told from another one.
#[test]
fn a_texture_that_is_gone_is_not_taken_for_another() {
    let holes = Arc::new(texel([255, 255, 255, 0]));
    let mut scene = Scene::new();
    let [color, transmission] = ["colour", "transmission"].map(|name| {
        let id = scene.add_texture(name, texel([0; 4]));
        scene.textures.get_mut(id).expect("just added").texture = Arc::clone(&holes);
        id
    });
    let material = Material {
        base_color_texture: Some(TextureBinding::new(color)),
        transmission_texture: Some(TextureBinding::new(transmission)),
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        ..matt(Vec3::ONE)
    };
    scene.add_object("floor", primitives::plane(3.0, 3.0), matt(Vec3::ONE));
    let square = scene.add_object("square", primitives::plane(1.0, 1.0), material);
    scene.node_mut(square).expect("just added").transform = Transform::from_translation(DVec3::Y);
    scene.add(shining(Light::directional(1.0), DVec3::ZERO, DVec3::new(1.0, -1.0, 0.0)));
    let settings =
        settings(EffectSettings { shadows: Shadows::Maps { resolution: 64 }, ..EffectSettings::default() });
    let mut warm = Renderer::new(settings.clone());
    warm.render(&scene, &from_above()).expect("drawn");
    for gone in [transmission, color] {
        // Clones share what was made of their meshes, so that these are the same casters.
        let mut scene = scene.clone();
        scene.textures.remove(gone);
        let drawn = warm.render(&scene, &from_above()).expect("drawn");
        let fresh = render(&scene, &from_above(), &settings).expect("drawn");
        assert!(drawn == fresh, "without {gone:?}");
    }
}

/// What may happen to a scene and to settings between two images.
#[derive(Clone, Debug)]
enum Change {
    /// Of a slot of a node.
    Material(usize, usize, usize),
    Move(usize, f64),
    Hide(usize, bool),
    Morph(usize, f32),
    /// Another image under the same id.
    Texture(usize, [u8; 4]),
    /// The mesh of all nodes.
    Mesh(bool),
    /// One of its vertices.
    Vertex(u32, [f32; 3]),
    Camera(bool),
    Shadows(Shadows),
    /// Bounces, and rays of ambient occlusion.
    Rays(u32, Option<u32>),
    Shading(ShadingModel),
    Style(Style),
    /// Fog, exposure and an outline.
    Laid(bool),
    Outputs(bool),
    /// Samples per axis, samples and threads.
    Samples(u32, u32, usize),
    Size(u32, u32),
}

fn change() -> impl Strategy<Value = Change> {
    let shadows = prop::sample::select(vec![
        Shadows::Off,
        Shadows::Maps { resolution: 16 },
        Shadows::Maps { resolution: 32 },
        Shadows::Rays,
    ]);
    let shading = vec![ShadingModel::Flat, ShadingModel::Gouraud, ShadingModel::Phong];
    let styles = vec![Style::Surface, Style::SurfaceWithEdges, Style::Wireframe, Style::HiddenLine];
    prop_oneof![
        6 => (0..3_usize, 0..2_usize, 0..6_usize).prop_map(|(node, slot, to)| Change::Material(node, slot, to)),
        2 => (0..3_usize, -1.0..1.0).prop_map(|(node, to)| Change::Move(node, to)),
        1 => (0..3_usize, any::<bool>()).prop_map(|(node, visible)| Change::Hide(node, visible)),
        2 => (0..3_usize, 0.0_f32..1.0).prop_map(|(node, weight)| Change::Morph(node, weight)),
        2 => (0..2_usize, any::<[u8; 4]>()).prop_map(|(texture, texel)| Change::Texture(texture, texel)),
        1 => any::<bool>().prop_map(Change::Mesh),
        3 => (0..6_u32, prop::array::uniform3(-1.0_f32..1.0)).prop_map(|(vertex, to)| Change::Vertex(vertex, to)),
        1 => any::<bool>().prop_map(Change::Camera),
        3 => shadows.prop_map(Change::Shadows),
        2 => (0..3_u32, prop::option::of(1..4_u32)).prop_map(|(bounces, rays)| Change::Rays(bounces, rays)),
        1 => prop::sample::select(shading).prop_map(Change::Shading),
        1 => prop::sample::select(styles).prop_map(Change::Style),
        1 => any::<bool>().prop_map(Change::Laid),
        1 => any::<bool>().prop_map(Change::Outputs),
        1 => (1..3_u32, prop::sample::select(vec![1, 2, 4]), 1..3_usize)
            .prop_map(|(axis, samples, threads)| Change::Samples(axis, samples, threads)),
        1 => (1..40_u32, 1..30_u32).prop_map(|(width, height)| Change::Size(width, height)),
    ]
}

/// What is changed, and drawn in between.
struct Changing {
    scene: Scene,
    nodes: [NodeId; 3],
    materials: [MaterialId; 6],
    textures: [TextureId; 2],
    camera: Camera,
    settings: RenderSettings,
}

impl Changing {
    /// Three nodes with one mesh.
    fn new() -> Self {
        let mut scene = Scene::new();
        let textures = [
            scene.add_texture("bumps", texel([218, 128, 218, 255])),
            scene.add_texture("holes", texel([200, 90, 40, 128])),
        ];
        let [bumps, holes] = textures.map(TextureBinding::new);
        let bumpy = |uv_set| {
            let normal_map = NormalMap { binding: TextureBinding { uv_set, ..bumps }, scale: 1.0 };
            Material { normal_map: Some(normal_map), ..matt(Vec3::ONE) }
        };
        let mask = AlphaMode::Mask { cutoff: 0.5 };
        let materials = [
            bumpy(0),
            bumpy(1),
            Material { base_color_texture: Some(holes), alpha_mode: mask, ..matt(Vec3::ONE) },
            Material {
                base_color: Vec4::new(0.2, 0.9, 0.4, 0.5),
                alpha_mode: AlphaMode::Blend,
                ..metal(0.2)
            },
            metal(1.0),
            Material { transmission: 0.8, transmission_texture: Some(holes), ..metal(0.0) },
        ]
        .map(|material| scene.add_material(material));
        let mesh = scene.add_mesh("square", square());
        let nodes = [0, 1, 2].map(|number| {
            let place = DVec3::new(0.3, f64::from(number) - 1.0, -0.2) * f64::from(number);
            let node =
                Node { materials: vec![materials[0], materials[1]], ..Node::from_mesh(mesh, materials[0]) };
            scene.add(Node { morph_weights: vec![0.0], ..node.at(place) })
        });
        scene.add(shining(Light::directional(0.7), DVec3::ZERO, DVec3::new(1.0, -1.0, 0.3)));
        scene.add(shining(Light::spot(3.0), DVec3::new(0.2, 4.0, 0.1), DVec3::NEG_Y));
        scene.add(Node::from_light(Light::ambient(0.2)));
        let settings = RenderSettings { width: 24, height: 18, ..settings(EffectSettings::default()) };
        Self { scene, nodes, materials, textures, camera: from_above(), settings }
    }

    fn change(&mut self, change: &Change) {
        match *change {
            Change::Material(number, slot, to) => {
                let material = self.materials[to];
                self.node(number).materials[slot] = material;
            }
            Change::Move(number, to) => {
                self.node(number).transform.set_translation(DVec3::new(to, 0.5 - to, 0.1));
            }
            Change::Hide(number, visible) => self.node(number).visible = visible,
            Change::Morph(number, weight) => self.node(number).morph_weights = vec![weight],
            Change::Texture(number, color) => {
                let asset = self.scene.textures.get_mut(self.textures[number]).expect("none is removed");
                asset.texture = Arc::new(texel(color));
            }
            Change::Mesh(flat) => {
                let (id, _) = self.scene.meshes().iter().next().expect("there is one");
                let mesh = if flat { square() } else { primitives::cube(0.8) };
                self.scene.replace_mesh(id, mesh).expect("it is there");
            }
            Change::Vertex(vertex, to) => {
                let (id, _) = self.scene.meshes().iter().next().expect("there is one");
                let positions = vec![(vertex, Vec3::from_array(to))];
                let change = trigon_mesh::MeshChange { positions, ..Default::default() };
                self.scene.change_mesh(id, &change).expect("either mesh has 6 vertices");
            }
            Change::Camera(above) => self.camera = if above { from_above() } else { from_front() },
            _ => self.change_settings(change),
        }
    }

    fn node(&mut self, number: usize) -> &mut Node {
        self.scene.node_mut(self.nodes[number]).expect("none is removed")
    }

    fn change_settings(&mut self, change: &Change) {
        let Self { settings, nodes, .. } = self;
        match *change {
            Change::Shadows(shadows) => settings.effects.shadows = shadows,
            Change::Rays(bounces, rays) => {
                settings.effects.sight = SightRays::all(bounces);
                let sampling = [RaySampling::Full, RaySampling::Shared][bounces as usize % 2];
                settings.effects.ambient_occlusion =
                    rays.map(|rays| AmbientOcclusion { sampling, ..AmbientOcclusion::new(rays, 1.0) });
            }
            Change::Shading(model) => settings.shading = model,
            Change::Style(style) => settings.style = style,
            Change::Laid(on) => {
                let EffectSettings { fog, exposure, outline, .. } = &mut settings.effects;
                *fog = on.then_some(Fog { color: Vec3::X, density: 0.1 });
                *exposure = Exposure::Stops(if on { 0.5 } else { 0.0 });
                *outline = on.then(|| Outline { nodes: vec![nodes[1]], color: Vec3::Y, width: 1 });
            }
            Change::Outputs(all) => {
                let some =
                    Outputs { radiance: true, depth: true, ids: true, normals: true, ..Outputs::default() };
                settings.outputs = if all { some } else { Outputs::default() };
            }
            Change::Samples(axis, samples, threads) => {
                (settings.samples_per_axis, settings.samples) = (axis, samples);
                settings.threads = std::num::NonZeroUsize::new(threads);
            }
            Change::Size(width, height) => (settings.width, settings.height) = (width, height),
            _ => unreachable!("the scene's changes are made already"),
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn whatever_was_drawn_before_an_image_is_that_of_a_new_renderer(changes in prop::collection::vec(change(), 1..12)) {
        let mut changing = Changing::new();
        let mut warm = Renderer::new(changing.settings.clone());
        for change in &changes {
            changing.change(change);
            let Changing { scene, camera, settings, .. } = &changing;
            *warm.settings_mut() = settings.clone();
            let kept = warm.render(scene, camera).expect("drawn");
            let fresh = render(&cold(scene), camera, settings).expect("drawn");
            prop_assert!(kept == fresh, "after {change:?}");
        }
    }
}
