//! Images that follow from the last one beside fresh ones, whatever changes in between.

use std::num::NonZeroUsize;
use std::sync::Arc;

use proptest::prelude::*;
use trigon_camera::Camera;
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshChange, primitives};
use trigon_raster::simd::SimdLevel;
use trigon_raster::{Cancel, Rect, Texture, TextureFormat};

use crate::{
    AlphaMode, AmbientOcclusion, Background, EffectSettings, ElementSet, Environment, FixedBitSet, Fog,
    Frame, Light, Mark, Marks, Material, MeshId, Node, NodeId, Outline, Outputs, RenderSettings, Renderer,
    Scene, Shadows, Style, TextureBinding, ToneMapping, VertexPoints, render,
};

/// A scene, and what is changed in it.
struct Model {
    scene: Scene,
    meshes: Vec<MeshId>,
    nodes: Vec<NodeId>,
}

fn texture(level: u8) -> Texture {
    Texture::new(1, 1, vec![[level, 90, 220, 255]], TextureFormat::Srgb).expect("one texel")
}

/// A ring without normals of its own, a sphere of triangles behind it, and a pane before both;
/// a line beside them. The meshes have been changed once.
fn model(pane: AlphaMode) -> Model {
    let mut ring = primitives::torus(1.0, 0.4, 16, 10);
    let attributes = Attributes { corner_normals: None, ..ring.attributes().clone() };
    ring.set_attributes(attributes).expect("one less");
    let mut wire = trigon_mesh::MeshBuilder::new();
    for x in [-1.5, 1.5] {
        wire.push_vertex(Vec3::new(x, 0.9, 0.4));
    }
    wire.push_loose_edge(0, 1).expect("two vertices");
    let mut scene = Scene::new();
    let binding = TextureBinding::new(scene.add_texture("dots", texture(40)));
    let glass =
        Material { alpha_mode: pane, base_color: Vec4::new(0.9, 0.3, 0.2, 0.4), ..Material::default() };
    let textured = Material { base_color_texture: Some(binding), ..Material::default() };
    let objects = [
        (ring, Material::default(), DVec3::ZERO),
        (primitives::icosphere(0.8, 2), textured, DVec3::new(0.2, 0.1, -1.0)),
        (primitives::grid(1.0, 1.0, 4, 4), glass, DVec3::new(0.4, -0.3, 1.0)),
        (wire.build(), Material::default(), DVec3::ZERO),
    ];
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (mesh, material, place) in objects {
        let (mesh, material) = (scene.add_mesh("mesh", mesh), scene.add_material(material));
        nodes.push(scene.add(Node::from_mesh(mesh, material).at(place)));
        scene.change_mesh(mesh, &MeshChange::default()).expect("nothing to be changed");
        meshes.push(mesh);
    }
    nodes.push(scene.add(Node::from_light(Light::directional(0.8))));
    Model { scene, meshes, nodes }
}

impl Model {
    fn mesh(&self, number: usize) -> &Mesh {
        self.scene.meshes().get(self.meshes[number]).expect("it is there").mesh()
    }

    /// The scene, knowing nothing of its meshes.
    fn fresh(&self) -> Scene {
        let mut fresh = self.scene.clone();
        for (number, &mesh) in self.meshes.iter().enumerate() {
            fresh.replace_mesh(mesh, self.mesh(number).clone()).expect("it is there");
        }
        fresh
    }
}

/// What happens between two images.
#[derive(Clone, Debug)]
enum Event {
    /// Vertices of a mesh are moved.
    Moved(usize, Vec<(u32, [f32; 3])>),
    Nothing,
    CameraMoved(f64),
    NodeMoved(usize, f64),
    NodeHidden(usize),
    Painted(f32),
    TextureExchanged(u8),
    MeshReplaced(usize),
    LightDimmed(f32),
    Cancelled,
    /// The frame's user writes into it.
    FrameUsed,
    Settings(usize),
    /// Elements of a mesh are marked in a colour of this level: edges, faces or vertices.
    Marked(usize, usize, Vec<u8>, f32),
    /// Other elements are in the first mark of edges, faces or vertices.
    Selected(usize, usize, Vec<u8>),
    VerticesShown(Option<f32>),
    XRay(f32),
}

fn event() -> impl Strategy<Value = Event> {
    let way = prop_oneof![8 => -0.2_f32..0.2, 1 => -9.0_f32..9.0, 1 => Just(f32::NAN)];
    let moves = prop::collection::vec((any::<u32>(), prop::array::uniform3(way)), 0..4);
    prop_oneof![
        12 => (0..4_usize, moves).prop_map(|(mesh, moves)| Event::Moved(mesh, moves)),
        1 => Just(Event::Nothing),
        1 => (-0.3..0.3).prop_map(Event::CameraMoved),
        1 => (0..4_usize, -0.3..0.3).prop_map(|(node, way)| Event::NodeMoved(node, way)),
        1 => (0..5_usize).prop_map(Event::NodeHidden),
        1 => (0.0_f32..1.0).prop_map(Event::Painted),
        1 => any::<u8>().prop_map(Event::TextureExchanged),
        1 => (0..4_usize).prop_map(Event::MeshReplaced),
        1 => (0.1_f32..1.0).prop_map(Event::LightDimmed),
        1 => Just(Event::Cancelled),
        1 => Just(Event::FrameUsed),
        2 => (0..SETTINGS.len()).prop_map(Event::Settings),
        2 => (0..3_usize, 0..4_usize, prop::collection::vec(any::<u8>(), 0..6), 0.0_f32..1.0)
            .prop_map(|(kind, node, elements, level)| Event::Marked(kind, node, elements, level)),
        8 => (0..3_usize, 0..4_usize, prop::collection::vec(any::<u8>(), 0..6))
            .prop_map(|(kind, node, elements)| Event::Selected(kind, node, elements)),
        1 => prop::option::of(0.5_f32..6.0).prop_map(Event::VerticesShown),
        1 => prop_oneof![Just(0.0), 0.0_f32..1.0].prop_map(Event::XRay),
    ]
}

/// What becomes of the settings; those of the effects begin from none.
const SETTINGS: [fn(&mut RenderSettings, &Model); 20] = [
    |settings, _| settings.effects = EffectSettings::default(),
    |settings, _| settings.effects.shadows = Shadows::Maps { resolution: 32 },
    |settings, _| settings.effects.shadows = Shadows::Rays,
    |settings, _| settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(2, 1.0)),
    |settings, _| settings.effects.fog = Some(Fog { color: Vec3::ONE, density: 0.2 }),
    |settings, _| settings.effects.exposure = crate::Exposure::Stops(0.5),
    |settings, _| settings.effects.tone_mapping = ToneMapping::KhronosPbrNeutral,
    |settings, model| {
        settings.effects.outline =
            Some(Outline { nodes: model.nodes[..1].to_vec(), color: Vec3::X, width: 2 });
    },
    |settings, _| settings.effects.environment = Some(Arc::new(Environment::uniform(Vec3::splat(0.7)))),
    |settings, _| settings.background = Background::Color(Vec3::Y),
    |settings, _| (settings.width, settings.height) = (settings.height, settings.width),
    |settings, _| settings.style = Style::HiddenLine,
    |settings, _| settings.style = Style::Wireframe,
    |settings, _| settings.line_width = 4.0,
    |settings, _| settings.samples = 4,
    |settings, _| settings.outputs = Outputs { depth: true, ids: true, ..settings.outputs },
    |settings, _| settings.outputs = Outputs { radiance: true, triangle_ids: true, ..settings.outputs },
    |settings, _| (settings.style, settings.x_ray) = (Style::SurfaceWithEdges, 0.4),
    |settings, _| settings.style = Style::SurfaceWithEdges,
    |settings, _| settings.marks = Marks::default(),
];

/// Some elements of a node in a colour of this level.
fn mark(node: NodeId, elements: &[u8], level: f32) -> Mark {
    let mut bits = FixedBitSet::new();
    elements.iter().for_each(|&element| bits.grow_and_insert(usize::from(element)));
    let mut set = ElementSet::default();
    set.add(node, bits);
    let color = Vec3::new(1.0, level, 0.0);
    Mark { elements: Arc::new(set), color, opacity: 0.5 + 0.5 * level, outlined: level > 0.5 }
}

/// Where an image is drawn.
#[derive(Clone, Copy, Debug)]
enum Place {
    OwnFrame,
    /// A shared frame that is dropped after the next one is drawn.
    Shared,
    /// One that is kept.
    Held,
}

fn place() -> impl Strategy<Value = Place> {
    prop_oneof![2 => Just(Place::OwnFrame), 4 => Just(Place::Shared), 1 => Just(Place::Held)]
}

/// A renderer that has drawn what was before.
struct Sequence {
    model: Model,
    camera: Camera,
    renderer: Renderer,
    frame: Frame,
    /// The last shared one.
    shown: Arc<Frame>,
    /// Those that are kept, and what they showed in the beginning.
    held: Vec<(Arc<Frame>, Frame)>,
}

impl Sequence {
    fn new(model: Model, settings: RenderSettings) -> Self {
        let camera = model.scene.overview(settings.aspect());
        let (renderer, frame, shown) = (Renderer::new(settings), Frame::default(), Arc::default());
        Self { model, camera, renderer, frame, shown, held: Vec::new() }
    }

    fn apply(&mut self, event: &Event) {
        let Self { model, camera, renderer, frame, .. } = self;
        match event {
            Event::Moved(mesh, moves) => {
                let positions = model.mesh(*mesh).positions();
                let moved = |&(vertex, way): &(u32, [f32; 3])| {
                    let vertex = vertex % positions.len() as u32;
                    (vertex, positions[vertex as usize] + Vec3::from_array(way))
                };
                let positions = moves.iter().map(moved).collect();
                let change = MeshChange { positions, ..MeshChange::default() };
                model.scene.change_mesh(model.meshes[*mesh], &change).expect("it has these vertices");
            }
            Event::Nothing => {}
            Event::CameraMoved(way) => camera.position.x += way,
            Event::NodeMoved(node, way) => {
                let node = model.scene.node_mut(model.nodes[*node]).expect("it is there");
                node.transform.set_translation(DVec3::splat(*way));
            }
            Event::NodeHidden(node) => {
                let node = model.scene.node_mut(model.nodes[*node]).expect("it is there");
                node.visible = !node.visible;
            }
            Event::Painted(level) => {
                let (_, material) = model.scene.materials.iter_mut().next().expect("there are some");
                material.base_color.x = *level;
            }
            Event::TextureExchanged(level) => {
                let (_, asset) = model.scene.textures.iter_mut().next().expect("there is one");
                asset.texture = Arc::new(texture(*level));
            }
            Event::MeshReplaced(mesh) => {
                let same = model.mesh(*mesh).clone();
                model.scene.replace_mesh(model.meshes[*mesh], same).expect("it is there");
            }
            Event::LightDimmed(intensity) => {
                let node = model.scene.node_mut(model.nodes[4]).expect("it is there");
                node.light = Some(Box::new(Light::directional(*intensity)));
            }
            Event::Cancelled => {
                let cancel = Cancel::default();
                cancel.cancel();
                let mut given_up = Frame::default();
                renderer
                    .render_cancellable(&model.scene, camera, &cancel, &mut given_up)
                    .expect_err("it was cancelled");
                renderer.render_shared(&model.scene, camera, Some(&cancel)).expect_err("it was cancelled");
            }
            Event::FrameUsed => {
                frame.color.fill(7);
                frame.depth.iter_mut().flatten().for_each(|depth| *depth = 0.5);
                frame.face_ids = None;
            }
            Event::Settings(number) => SETTINGS[*number](renderer.settings_mut(), model),
            Event::Marked(kind, node, elements, level) => {
                let Marks { edges, faces, vertices } = &mut renderer.settings_mut().marks;
                let list = [edges, faces, vertices].into_iter().nth(*kind).expect("one of three");
                list.insert(0, mark(model.nodes[*node], elements, *level));
            }
            Event::Selected(kind, node, elements) => {
                let Marks { edges, faces, vertices } = &mut renderer.settings_mut().marks;
                let list = [edges, faces, vertices].into_iter().nth(*kind).expect("one of three");
                if let Some(first) = list.first_mut() {
                    first.elements = mark(model.nodes[*node], elements, 0.0).elements;
                }
            }
            Event::VerticesShown(size) => {
                let points = |size| VertexPoints { size, ..VertexPoints::default() };
                renderer.settings_mut().vertices = size.map(points);
            }
            Event::XRay(share) => renderer.settings_mut().x_ray = *share,
        }
    }

    fn draw(&mut self) {
        self.renderer.render_into(&self.model.scene, &self.camera, &mut self.frame).expect("drawn");
    }

    fn draw_at(&mut self, place: Place) {
        if let Place::OwnFrame = place {
            return self.draw();
        }
        let before = std::mem::take(&mut self.shown);
        self.shown = self.renderer.render_shared(&self.model.scene, &self.camera, None).expect("drawn");
        self.frame = Frame::clone(&self.shown);
        if let Some(parts) = self.renderer.redrawn_between(&before, &self.shown) {
            assert_same_outside(&before, &self.shown, &parts);
        }
        if let Place::Held = place {
            self.held.push((Arc::clone(&self.shown), self.frame.clone()));
        }
    }

    fn fresh(&self) -> Frame {
        render(&self.model.fresh(), &self.camera, self.renderer.settings()).expect("drawn")
    }
}

/// Two frames of one size differ at most in some parts.
fn assert_same_outside(before: &Frame, after: &Frame, parts: &[Rect]) {
    assert_eq!((before.width, before.height), (after.width, after.height));
    let [one, other] = [before, after].map(|frame| frame.color.as_chunks::<4>().0);
    for (pixel, (one, other)) in one.iter().zip(other).enumerate() {
        let at = [pixel as u32 % after.width, pixel as u32 / after.width].map(|at| at as i32);
        let holds = |part: &Rect| (0..2).all(|axis| (part.min[axis]..part.max[axis]).contains(&at[axis]));
        assert!(one == other || parts.iter().any(holds), "pixel {at:?} is in none of {parts:?}");
    }
}

fn settings() -> impl Strategy<Value = RenderSettings> {
    let levels: Vec<_> = SimdLevel::ALL.into_iter().filter(|level| level.is_supported()).collect();
    let style = prop::sample::select(vec![Style::Surface, Style::SurfaceWithEdges]);
    let size = prop::array::uniform2(16..90_u32);
    (size, 1..3_u32, 1..4_usize, prop::sample::select(levels), style, any::<bool>()).prop_map(
        |([width, height], samples_per_axis, threads, level, style, depth)| RenderSettings {
            samples_per_axis,
            style,
            threads: NonZeroUsize::new(threads),
            simd: Some(level),
            outputs: Outputs { depth, ids: depth, ..Outputs::default() },
            ..RenderSettings::new(width, height)
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    #[test]
    fn whatever_changes_images_are_fresh_ones(
        settings in settings(),
        pane in prop::sample::select(vec![AlphaMode::Opaque, AlphaMode::Mask { cutoff: 0.3 }, AlphaMode::Blend]),
        events in prop::collection::vec((event(), place()), 4..12),
    ) {
        let mut sequence = Sequence::new(model(pane), settings);
        sequence.draw();
        for (event, place) in &events {
            sequence.apply(event);
            sequence.draw_at(*place);
            prop_assert!(sequence.frame == sequence.fresh(), "after {event:?}, {place:?}");
        }
        prop_assert!(sequence.held.iter().all(|(held, before)| **held == *before), "nobody draws into them");
    }
}

/// An image that is not drawn to the end takes the memory of the last one, which the next image then cannot follow.
#[test]
fn images_after_one_that_was_refused_or_cancelled_are_fresh_ones() {
    let settings = RenderSettings { style: Style::SurfaceWithEdges, ..RenderSettings::new(48, 36) };
    let refuse: [fn(&mut RenderSettings, &Cancel); 3] = [
        |settings, _| settings.width = 0,
        |settings, cancel| {
            settings.outputs = Outputs { ids: true, ..Outputs::NONE };
            cancel.cancel();
        },
        |settings, cancel| {
            settings.display = crate::Display::Depth;
            cancel.cancel();
        },
    ];
    let mut sequence = Sequence::new(model(AlphaMode::Opaque), settings.clone());
    for refuse in refuse {
        for _ in 0..3 {
            sequence.draw_at(Place::Shared);
        }
        sequence.shown = Arc::default();
        let cancel = Cancel::default();
        refuse(sequence.renderer.settings_mut(), &cancel);
        let Sequence { model, camera, renderer, .. } = &mut sequence;
        renderer.render_shared(&model.scene, camera, Some(&cancel)).expect_err("it was refused");
        *renderer.settings_mut() = settings.clone();
        sequence.apply(&moved(3));
        sequence.draw_at(Place::Shared);
        assert!(sequence.frame == sequence.fresh());
    }
}

/// How many tiles the last image has drawn.
fn tiles(sequence: &Sequence) -> u64 {
    sequence.renderer.stats().tiles
}

fn moved(vertex: u32) -> Event {
    Event::Moved(0, vec![(vertex, [0.03, 0.0, 0.0])])
}

#[test]
fn from_the_third_image_on_only_what_changes_is_drawn() {
    let settings = RenderSettings { samples_per_axis: 1, ..RenderSettings::new(640, 480) };
    let mut sequence = Sequence::new(model(AlphaMode::Opaque), settings);
    sequence.draw();
    let all = tiles(&sequence);
    sequence.apply(&moved(3));
    sequence.draw();
    assert_eq!(tiles(&sequence), all, "the second from the same camera is kept, and drawn as a whole");
    for vertex in [40, 41, 90] {
        sequence.apply(&moved(vertex));
        sequence.draw();
        assert!((1..all / 2).contains(&tiles(&sequence)), "{} of {all} tiles", tiles(&sequence));
        assert!(sequence.frame == sequence.fresh(), "the bytes of a fresh image");
    }
    sequence.draw();
    assert_eq!(tiles(&sequence), 0, "nothing has changed");
    sequence.apply(&Event::CameraMoved(0.1));
    sequence.draw();
    assert!(tiles(&sequence) > all / 2, "from another place everything looks different");
}

/// Points and lines have the vertices of the mesh, and not of what is drawn of it: with either of
/// them a moved vertex drew everything.
#[test]
fn points_and_lines_follow_moved_vertices() {
    for style in [Style::Surface, Style::SurfaceWithEdges, Style::HiddenLine, Style::Wireframe] {
        let settings = RenderSettings {
            samples_per_axis: 1,
            style,
            vertices: Some(VertexPoints::default()),
            ..RenderSettings::new(640, 480)
        };
        let mut sequence = Sequence::new(model(AlphaMode::Opaque), settings);
        sequence.draw();
        let all = tiles(&sequence);
        sequence.draw();
        for vertex in [40, 41, 90] {
            sequence.apply(&moved(vertex));
            sequence.draw();
            assert!((1..all / 2).contains(&tiles(&sequence)), "{style:?}: {} of {all}", tiles(&sequence));
            assert!(sequence.frame == sequence.fresh(), "{style:?}: the bytes of a fresh image");
        }
    }
}

#[test]
fn effects_that_reach_over_tiles_draw_everything() {
    let settings = RenderSettings { samples_per_axis: 1, ..RenderSettings::new(320, 240) };
    for number in [1, 2, 3, 5, 6, 7, 17] {
        let mut sequence = Sequence::new(model(AlphaMode::Opaque), settings.clone());
        sequence.apply(&Event::Settings(number));
        sequence.draw();
        let all = tiles(&sequence);
        for vertex in 0..4 {
            sequence.apply(&moved(vertex));
            sequence.draw();
            assert_eq!(tiles(&sequence), all, "settings {number}");
        }
    }
}

#[test]
fn what_is_marked_follows_and_other_colours_draw_everything() {
    let settings = RenderSettings {
        samples_per_axis: 1,
        style: Style::SurfaceWithEdges,
        ..RenderSettings::new(640, 480)
    };
    let mut sequence = Sequence::new(model(AlphaMode::Opaque), settings);
    // Enough of 320 edges and 160 faces for some on the side that is seen.
    sequence.apply(&Event::Marked(0, 0, (0..250).step_by(9).collect(), 0.2));
    sequence.apply(&Event::Marked(1, 0, (0..160).step_by(7).collect(), 0.7));
    sequence.draw();
    let all = tiles(&sequence);
    sequence.draw();
    for vertex in [3, 40, 41] {
        sequence.apply(&moved(vertex));
        sequence.draw();
        assert!((1..all / 2).contains(&tiles(&sequence)), "{} of {all} tiles", tiles(&sequence));
        assert!(sequence.frame == sequence.fresh(), "the bytes of a fresh image");
    }
    let others: [fn(&mut RenderSettings); 2] = [
        |settings| settings.marks.edges[0].color = Vec3::Z,
        |settings| settings.vertices = Some(VertexPoints::default()),
    ];
    for (number, change) in others.into_iter().enumerate() {
        let before = sequence.frame.color.clone();
        change(sequence.renderer.settings_mut());
        sequence.draw();
        assert!(tiles(&sequence) > all / 2, "change {number}: {} of {all} tiles", tiles(&sequence));
        assert!(sequence.frame.color != before, "change {number} is seen");
        assert!(sequence.frame == sequence.fresh(), "change {number}: the bytes of a fresh image");
    }
}

/// A click marks another element, and a box of half of a mesh draws no more than what it changes.
#[test]
fn where_other_elements_are_marked_alone_is_drawn() {
    for style in [Style::SurfaceWithEdges, Style::HiddenLine, Style::Wireframe] {
        let settings = RenderSettings {
            samples_per_axis: 1,
            style,
            vertices: Some(VertexPoints::default()),
            ..RenderSettings::new(640, 480)
        };
        let mut sequence = Sequence::new(model(AlphaMode::Opaque), settings);
        for kind in 0..3 {
            sequence.apply(&Event::Marked(kind, 0, vec![0], 0.2));
        }
        sequence.draw();
        let all = tiles(&sequence);
        let mut seen = [0; 3];
        for round in 0..12 {
            let kind = round % 3;
            // Far apart: some lie on the side that is seen.
            let elements = (0..4).map(|number| (7 * round + 31 * number) as u8).collect();
            let before = sequence.frame.color.clone();
            sequence.apply(&Event::Selected(kind, 0, elements));
            sequence.draw();
            seen[kind] += usize::from(sequence.frame.color != before);
            assert!(tiles(&sequence) < all / 2, "{style:?}, {kind}: {} of {all}", tiles(&sequence));
            assert!(sequence.frame == sequence.fresh(), "{style:?}, {kind}: the bytes of a fresh image");
        }
        let faces_show = usize::from(style == Style::SurfaceWithEdges);
        let least = [2, 2 * faces_show, 2];
        assert!(seen.iter().zip(least).all(|(&seen, least)| seen >= least), "{style:?}: {seen:?} were seen");
        for kind in 0..3 {
            sequence.apply(&Event::Selected(kind, 0, Vec::new()));
            sequence.draw();
            assert!(tiles(&sequence) < all / 2, "{style:?}, no {kind}: {} of {all}", tiles(&sequence));
            assert!(sequence.frame == sequence.fresh(), "{style:?}, no {kind}: the bytes of a fresh image");
        }
    }
}
