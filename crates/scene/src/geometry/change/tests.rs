//! Geometry that follows changes, and images of it, beside those of a scene that was made
//! with the changed mesh.

use proptest::prelude::*;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, MeshBuilder, MeshChange, primitives};
use trigon_raster::{EdgeFlags, Texture, TextureFormat};

use super::super::Columns;
use super::*;
use crate::{
    ElementSet, FixedBitSet, Light, Mark, Marks, Material, MeshAsset, MeshId, Node, NormalMap, Outputs,
    RenderSettings, Renderer, Scene, Style, TextureBinding, render,
};

/// Everything that images are made of, triangle by triangle, as bits.
#[derive(Debug, PartialEq)]
struct Contents {
    triangles: Vec<[Vec<u32>; 3]>,
    faces: Vec<u32>,
    /// The slot of each run, and its triangles.
    runs: Vec<(u32, usize)>,
    triangulated: Vec<u32>,
    edge_flags: Vec<EdgeFlags>,
    side_edges: Vec<[u32; 3]>,
    bounds: [[u64; 6]; 2],
}

impl Contents {
    fn of(asset: &MeshAsset) -> Self {
        let geometry = asset.geometry();
        let columns = &geometry.columns;
        let lists = columns.positions.iter().chain(columns.uv_sets.iter().flatten());
        let lists: Vec<&Vec<f32>> = lists.chain(columns.colors.iter().flatten()).collect();
        let corner = |vertex: u32, face: u32| {
            let normal = columns.normal(vertex as usize, face).to_array();
            let values = lists.iter().map(|column| column[vertex as usize]);
            values.chain(normal).map(f32::to_bits).collect::<Vec<_>>()
        };
        let (flags, sides) = (geometry.edge_flags(asset.mesh()), geometry.side_edges(asset.mesh()));
        let is_real = |triangle: &usize| !geometry.is_filler(*triangle);
        let all: Vec<usize> = (0..geometry.triangles.len()).filter(is_real).collect();
        for filler in (0..geometry.triangles.len()).filter(|triangle| !is_real(triangle)) {
            let [a, b, c] = geometry.triangles[filler];
            assert!(a == b && b == c && sides[filler] == [u32::MAX; 3], "filler {filler} is seen");
        }
        let runs = geometry.runs.iter().map(|run| (run.slot, run.triangles.clone().filter(is_real).count()));
        Self {
            triangles: all
                .iter()
                .map(|&of| geometry.triangles[of].map(|vertex| corner(vertex, geometry.face(of))))
                .collect(),
            faces: all.iter().map(|&triangle| geometry.face(triangle)).collect(),
            runs: runs.filter(|&(_, count)| count > 0).collect(),
            triangulated: all.iter().map(|&triangle| geometry.triangulated(triangle)).collect(),
            edge_flags: all.iter().map(|&triangle| flags[triangle]).collect(),
            side_edges: all.iter().map(|&triangle| sides[triangle]).collect(),
            bounds: [asset.bounds(), geometry.bounds()].map(|bounds| {
                let ends = bounds.min.to_array().into_iter().chain(bounds.max.to_array());
                ends.map(f64::to_bits).collect::<Vec<_>>().try_into().expect("six numbers")
            }),
        }
    }
}

fn asset(scene: &Scene) -> (MeshId, &MeshAsset) {
    scene.meshes().iter().next().expect("a scene of one mesh")
}

/// The same scene without anything that is known about its mesh.
fn fresh(scene: &Scene) -> Scene {
    let mut fresh = scene.clone();
    let (id, asset) = asset(scene);
    fresh.replace_mesh(id, asset.mesh().clone()).expect("it is there");
    fresh
}

/// Few numbers, so that corners agree and polygons are flat, have no area, or flip over.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        20 => (-2_i8..=2).prop_map(f32::from),
        4 => -2.0_f32..2.0,
        1 => prop::sample::select(vec![-0.0, f32::NAN, f32::INFINITY, 1e30]),
    ]
}

fn place() -> impl Strategy<Value = Vec3> {
    prop::array::uniform3(coordinate()).prop_map(Vec3::from_array)
}

/// Any polygons over a few vertices: edges have any number of faces, and corners repeat.
fn soup() -> impl Strategy<Value = Mesh> {
    let faces = prop::collection::vec(prop::collection::vec(any::<u32>(), 3..7), 1..12);
    (prop::collection::vec(place(), 3..12), faces, any::<bool>()).prop_map(|(places, faces, is_loose)| {
        let mut builder = MeshBuilder::new();
        for &place in &places {
            builder.push_vertex(place);
        }
        let vertex = |index: &u32| index % places.len() as u32;
        for face in faces {
            // Some have too few vertices.
            let _ = builder.push_face(&face.iter().map(vertex).collect::<Vec<_>>());
        }
        if is_loose {
            builder.push_loose_edge(0, 1).expect("two vertices");
            builder.push_loose_point(2).expect("a third");
        }
        builder.build()
    })
}

/// Surfaces as they are modelled.
fn surface() -> impl Strategy<Value = Mesh> {
    prop::sample::select(vec![
        primitives::torus(1.0, 0.4, 7, 5),
        primitives::grid(2.0, 2.0, 4, 3),
        primitives::icosphere(1.0, 1),
        primitives::dodecahedron(1.0),
        primitives::cube(1.5),
        primitives::cone(1.0, 1.0, 40),
    ])
}

/// What a mesh has on its corners and faces.
#[derive(Clone, Debug)]
struct Dress {
    seed: u32,
    normals: bool,
    /// In so many faces one is flat; none is smooth where this is 0.
    smooth: u32,
    uv_sets: usize,
    colors: bool,
    slots: u32,
}

fn dress() -> impl Strategy<Value = Dress> {
    (any::<u32>(), any::<bool>(), 0..4_u32, 0..3_usize, any::<bool>(), 1..4_u32).prop_map(
        |(seed, normals, smooth, uv_sets, colors, slots)| Dress {
            seed,
            normals,
            smooth,
            uv_sets,
            colors,
            slots,
        },
    )
}

impl Dress {
    /// Of a few numbers one.
    fn pick(&self, index: usize, salt: u32, of: u32) -> u32 {
        let mixed = (index as u32 ^ self.seed.wrapping_add(salt << 20)).wrapping_mul(0x9E37_79B9);
        (mixed ^ mixed >> 15) % of
    }
}

fn bound() -> impl Strategy<Value = Mesh> {
    (prop_oneof![soup(), surface()], dress()).prop_map(|(mut mesh, dress)| {
        let (corners, faces) = (0..mesh.corner_count(), 0..mesh.face_count());
        // Zero normals are none.
        let normals = [Vec3::ZERO, Vec3::X, Vec3::new(0.0, 3.0, 4.0), Vec3::NEG_Z];
        let normal = |corner| normals[dress.pick(corner, 1, 4) as usize];
        let uv =
            |corner, set| Vec2::new(dress.pick(corner, set, 3) as f32, dress.pick(corner, set + 7, 2) as f32);
        let color = |corner| Vec4::new(dress.pick(corner, 5, 3) as f32 * 0.5, 0.5, 1.0, 1.0);
        let attributes = Attributes {
            corner_normals: dress.normals.then(|| corners.clone().map(normal).collect()),
            uv_sets: (0..dress.uv_sets as u32)
                .map(|set| corners.clone().map(|corner| uv(corner, set)).collect())
                .collect(),
            corner_colors: dress.colors.then(|| corners.clone().map(color).collect()),
            face_materials: (dress.slots > 1)
                .then(|| faces.clone().map(|face| dress.pick(face, 3, dress.slots)).collect()),
            face_smooth: (dress.smooth > 0)
                .then(|| faces.clone().map(|face| face % dress.smooth as usize != 1).collect()),
            ..Attributes::default()
        };
        mesh.set_attributes(attributes).expect("a value for each element");
        mesh
    })
}

/// Other values for elements that are counted modulo those of the mesh.
#[derive(Clone, Debug)]
enum Edit {
    Position(u32, Vec3),
    Normal(u32, Vec3),
    Uv(usize, u32, Vec2),
    Color(u32, f32),
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let edit = prop_oneof![
        5 => (any::<u32>(), place()).prop_map(|(vertex, to)| Edit::Position(vertex, to)),
        1 => (any::<u32>(), place()).prop_map(|(corner, to)| Edit::Normal(corner, to)),
        1 => (0..2_usize, any::<u32>(), place())
            .prop_map(|(set, corner, to)| Edit::Uv(set, corner, to.truncate())),
        1 => (any::<u32>(), coordinate()).prop_map(|(corner, to)| Edit::Color(corner, to)),
    ];
    prop::collection::vec(edit, 0..5)
}

impl Edit {
    /// Another value for the same element.
    fn with(&self, to: Vec3) -> Self {
        match *self {
            Self::Position(vertex, _) => Self::Position(vertex, to),
            Self::Normal(corner, _) => Self::Normal(corner, to),
            Self::Uv(set, corner, _) => Self::Uv(set, corner, to.truncate()),
            Self::Color(corner, _) => Self::Color(corner, to.x),
        }
    }
}

/// How a change goes on from the one before it: what is known of that one is used again, or must not be.
#[derive(Clone, Copy, Debug)]
enum Next {
    Others,
    Same,
    Fewer,
    More,
    /// The same elements get the values that they had.
    Undone,
}

fn next() -> impl Strategy<Value = Next> {
    prop::sample::select(vec![Next::Others, Next::Same, Next::Same, Next::Fewer, Next::More, Next::Undone])
}

impl Next {
    /// What is edited after `last`.
    fn edits(self, last: &[Edit], others: &[Edit], to: Vec3) -> Vec<Edit> {
        let again = last.iter().zip(0_u8..).map(|(edit, number)| edit.with(to * f32::from(number)));
        match self {
            Self::Others => others.to_vec(),
            Self::Same | Self::Undone => again.collect(),
            Self::Fewer => again.skip(1).collect(),
            Self::More => again.chain(others.iter().cloned()).collect(),
        }
    }
}

/// What a mesh has not is left out.
fn change(mesh: &Mesh, edits: &[Edit]) -> MeshChange {
    let attributes = mesh.attributes();
    let mut change =
        MeshChange { uv_sets: vec![Vec::new(); attributes.uv_sets.len()], ..MeshChange::default() };
    for edit in edits {
        let corner = |corner: u32| corner % mesh.corner_count().max(1) as u32;
        match *edit {
            Edit::Position(vertex, to) => {
                change.positions.push((vertex % mesh.vertex_count() as u32, to));
            }
            _ if mesh.corner_count() == 0 => {}
            Edit::Normal(at, to) if attributes.corner_normals.is_some() => {
                change.corner_normals.push((corner(at), to));
            }
            Edit::Uv(set, at, to) if set < attributes.uv_sets.len() => {
                change.uv_sets[set].push((corner(at), to));
            }
            Edit::Color(at, to) if attributes.corner_colors.is_some() => {
                change.corner_colors.push((corner(at), Vec4::new(to, 0.3, to, 1.0)));
            }
            Edit::Normal(..) | Edit::Uv(..) | Edit::Color(..) => {}
        }
    }
    change
}

/// A mesh in three materials, one of which has a normal map.
fn scene_of(mesh: Mesh) -> Scene {
    let mut scene = Scene::new();
    let texel = Texture::new(1, 1, vec![[200, 90, 220, 255]], TextureFormat::Linear).expect("one texel");
    let texture = scene.add_texture("bumps", texel);
    let binding = TextureBinding::new(texture);
    let materials = [
        Material { double_sided: true, ..Material::from_color(Vec3::new(0.9, 0.6, 0.2)) },
        Material { normal_map: Some(NormalMap { binding, scale: 1.0 }), ..Material::from_color(Vec3::ONE) },
        Material { base_color_texture: Some(binding), ..Material::default() },
    ]
    .map(|material| scene.add_material(material));
    let mesh = scene.add_mesh("mesh", mesh);
    scene.add(Node { materials: materials.to_vec(), ..Node::from_mesh(mesh, materials[0]) });
    scene.add(Node::from_light(Light::directional(0.8)));
    scene.add(Node::from_light(Light::ambient(0.2)));
    scene
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(192))]

    #[test]
    fn geometry_that_followed_holds_what_new_geometry_does(
        mesh in bound(),
        steps in prop::collection::vec((next(), edits(), place(), any::<bool>()), 1..10),
    ) {
        let mut scene = scene_of(mesh);
        asset(&scene).1.geometry();
        let (mut last, mut before) = (Vec::new(), asset(&scene).1.mesh().clone());
        for (next, edits, to, is_looked_at) in steps {
            let (id, asset_before) = asset(&scene);
            last = next.edits(&last, &edits, to);
            let mut change = change(asset_before.mesh(), &last);
            if let Next::Undone = next {
                let mut changed = ChangedElements::default();
                changed.add(&change);
                change = changed.values_in(&before);
            }
            before = asset_before.mesh().clone();
            scene.change_mesh(id, &change).expect("the mesh has it all");
            if is_looked_at {
                let (kept, fresh) = (Contents::of(asset(&scene).1), Contents::of(asset(&fresh(&scene)).1));
                prop_assert_eq!(kept, fresh, "after {:?}", change);
            }
        }
        prop_assert_eq!(Contents::of(asset(&scene).1), Contents::of(asset(&fresh(&scene)).1), "in the end");
    }

    #[test]
    fn images_after_changes_are_those_of_the_changed_mesh(
        mesh in bound(),
        steps in prop::collection::vec(edits(), 1..4),
        style in prop::sample::select(vec![Style::Surface, Style::SurfaceWithEdges, Style::HiddenLine]),
    ) {
        let mut scene = scene_of(mesh);
        let camera = scene_of(primitives::cube(3.0)).overview(1.0);
        let outputs = Outputs { depth: true, ids: true, normals: true, triangle_ids: true, ..Outputs::default() };
        let marks = every_other_edge(&scene);
        let settings =
            RenderSettings { samples_per_axis: 1, style, marks, outputs, ..RenderSettings::new(20, 20) };
        let mut warm = Renderer::new(settings.clone());
        warm.render(&scene, &camera).expect("drawn");
        for edits in steps {
            let (id, asset) = asset(&scene);
            let change = change(asset.mesh(), &edits);
            scene.change_mesh(id, &change).expect("the mesh has it all");
            let kept = warm.render(&scene, &camera).expect("drawn");
            let fresh = render(&fresh(&scene), &camera, &settings).expect("drawn");
            prop_assert!(kept == fresh, "{:?}", change);
        }
    }
}

/// Every other edge of a scene in a colour of its own.
fn every_other_edge(scene: &Scene) -> Marks {
    let (node, _) = scene.nodes().iter().find(|(_, node)| node.mesh.is_some()).expect("there is a mesh");
    let mut bits = FixedBitSet::new();
    (0..asset(scene).1.mesh().edge_count()).step_by(2).for_each(|edge| bits.grow_and_insert(edge));
    let mut set = ElementSet::default();
    set.add(node, bits);
    let mark = Mark { elements: set.into(), color: Vec3::X, opacity: 1.0, outlined: false };
    Marks { edges: vec![mark], ..Marks::default() }
}

/// Whether geometry is where it was before a change.
fn is_in_place(scene: &mut Scene, change: &MeshChange) -> bool {
    let address = |scene: &Scene| asset(scene).1.geometry().columns.positions[0].as_ptr();
    let before = address(scene);
    let id = asset(scene).0;
    scene.change_mesh(id, change).expect("the mesh has it all");
    address(scene) == before
}

/// A step outwards, which folds no polygon.
fn moved(scene: &Scene, vertex: u32) -> MeshChange {
    let place = asset(scene).1.mesh().positions()[vertex as usize];
    MeshChange { positions: vec![(vertex, place * 1.01)], ..MeshChange::default() }
}

#[test]
fn geometry_follows_in_place_from_the_second_change_on() {
    let mut scene = scene_of(primitives::torus(1.0, 0.4, 30, 20));
    // The first change makes it anew.
    is_in_place(&mut scene, &MeshChange::default());
    for vertex in 0..4 {
        let change = moved(&scene, vertex);
        assert!(is_in_place(&mut scene, &change), "vertex {vertex}");
    }
    let (holder, change) = (scene.clone(), moved(&scene, 9));
    assert!(!is_in_place(&mut scene, &change), "somebody else draws it");
    drop(holder);
    assert!(is_in_place(&mut scene, &change), "now it is its own");
}

/// A renderer keeps shadows and what they were cast by, and yet holds no geometry.
#[test]
fn kept_shadows_do_not_hold_geometry() {
    let mut scene = scene_of(primitives::torus(1.0, 0.4, 30, 20));
    let mut renderer = Renderer::builder().size(8, 8).build();
    renderer.settings_mut().effects.shadows = crate::Shadows::Maps { resolution: 16 };
    let camera = scene.overview(1.0);
    is_in_place(&mut scene, &MeshChange::default());
    renderer.render(&scene, &camera).expect("drawn");
    let change = moved(&scene, 3);
    assert!(is_in_place(&mut scene, &change), "nobody else has it");
    let kept = renderer.render(&scene, &camera).expect("drawn");
    assert!(kept == render(&fresh(&scene), &camera, renderer.settings()).expect("drawn"), "new shadows");
}

/// Whoever drags vertices over their neighbours folds polygons, which have fewer triangles then.
#[test]
fn folded_polygons_made_all_geometry_anew() {
    let mut scene = scene_of(primitives::grid(4.0, 2.0, 20, 10));
    is_in_place(&mut scene, &MeshChange::default());
    let places = asset(&scene).1.mesh().positions().to_vec();
    let mut counts = Vec::new();
    for step in [1.5, 0.0, -2.5, 0.4, 1.7] {
        let moved = (0..places.len()).step_by(5);
        let to = |vertex: usize| (vertex as u32, places[vertex] + Vec3::new(0.2 * step, 0.15 * step, 0.0));
        let change = MeshChange { positions: moved.map(to).collect(), ..MeshChange::default() };
        let id = asset(&scene).0;
        scene.change_mesh(id, &change).expect("the grid has these vertices");
        let geometry = asset(&scene).1.geometry();
        assert!(geometry.change.is_some(), "it followed where vertices moved by {step}");
        counts.push(geometry.fillers.len());
        assert_eq!(Contents::of(asset(&scene).1), Contents::of(asset(&fresh(&scene)).1), "moved by {step}");
    }
    assert!(counts[0] > 10 && counts[2] > 10, "some fold: {counts:?}");
    assert!(counts[1] == 0 && counts[3] == 0, "none does: {counts:?}");
}

/// A polygon without area has no triangle.
#[test]
fn a_polygon_may_lose_its_area_and_get_it_back() {
    let mut scene = scene_of(primitives::dodecahedron(1.0));
    let id = asset(&scene).0;
    let places = asset(&scene).1.mesh().positions().to_vec();
    let all = |to: &dyn Fn(usize) -> Vec3| MeshChange {
        positions: (0..places.len()).map(|vertex| (vertex as u32, to(vertex))).collect(),
        ..MeshChange::default()
    };
    let mut counts = Vec::new();
    for change in [all(&|_| Vec3::ZERO), all(&|vertex| places[vertex])] {
        scene.change_mesh(id, &change).expect("a dodecahedron has 20 vertices");
        let geometry = asset(&scene).1.geometry();
        counts.push(geometry.triangles.len() - geometry.fillers.len());
        assert_eq!(Contents::of(asset(&scene).1), Contents::of(asset(&fresh(&scene)).1), "as made anew");
    }
    assert_eq!(counts, [0, 36], "nothing, and twelve pentagons");
}

/// What a vertex shows, as bits.
fn shown(geometry: &Geometry, vertex: usize) -> Vec<u32> {
    let Columns { positions, normals, tangents, uv_sets, colors, .. } = &geometry.columns;
    let lists = positions.iter().chain(normals).chain(uv_sets.iter().flatten());
    let lists = lists.chain(tangents.iter().flatten()).chain(colors.iter().flatten());
    lists.map(|column| column[vertex].to_bits()).collect()
}

/// A vertex without a place has no normal, and its neighbours are told beside it.
#[test]
fn a_vertex_may_lose_its_place() {
    let mut torus = primitives::torus(1.0, 0.4, 16, 10);
    let attributes = Attributes { corner_normals: None, ..torus.attributes().clone() };
    torus.set_attributes(attributes).expect("one less");
    let mut scene = scene_of(torus);
    is_in_place(&mut scene, &MeshChange::default());
    let places = asset(&scene).1.mesh().positions().to_vec();
    for to in [f32::NAN, 0.3, f32::INFINITY, 0.0] {
        let before: Vec<_> = (0..160).map(|vertex| shown(asset(&scene).1.geometry(), vertex)).collect();
        let positions = vec![(17, places[17]), (61, places[61] + Vec3::new(to, 0.0, 0.0))];
        is_in_place(&mut scene, &MeshChange { positions, ..MeshChange::default() });
        assert_eq!(Contents::of(asset(&scene).1), Contents::of(asset(&fresh(&scene)).1), "moved by {to}");
        let geometry = asset(&scene).1.geometry();
        let told = &geometry.change.as_ref().expect("it followed").vertices;
        for (vertex, before) in before.iter().enumerate() {
            let differs = shown(geometry, vertex) != *before;
            assert!(!differs || told.contains(&(vertex as u32)), "vertex {vertex}, moved by {to}");
        }
    }
}

/// What is drawn again follows from that: whoever drags a vertex changes places, and a few diagonals.
#[test]
fn triangles_are_told_if_and_only_if_they_have_other_corners_or_edges() {
    let mut scene = scene_of(primitives::torus(1.0, 0.4, 30, 20));
    is_in_place(&mut scene, &MeshChange::default());
    let triangles = |scene: &Scene| -> Vec<_> {
        let (geometry, mesh) = (asset(scene).1.geometry(), asset(scene).1.mesh());
        let edges = geometry.edge_flags(mesh).iter().copied().zip(geometry.side_edges(mesh).iter().copied());
        geometry.triangles.iter().copied().zip(edges).collect()
    };
    let mut before = triangles(&scene);
    let (mut differing, mut vertices) = (0, 0);
    for vertex in (0..600).step_by(37) {
        let change = moved(&scene, vertex);
        assert!(is_in_place(&mut scene, &change));
        let after = triangles(&scene);
        let differs = |triangle: &u32| before[*triangle as usize] != after[*triangle as usize];
        let expected: Vec<u32> = (0..1200).filter(differs).collect();
        let told = asset(&scene).1.geometry().change.as_ref().expect("it followed");
        assert_eq!(told.triangles, expected, "after vertex {vertex} moved");
        (differing, vertices) = (differing + expected.len(), vertices + told.vertices.len());
        before = after;
    }
    assert!(vertices > 16 && differing < 8 * 17, "{differing} triangles around {vertices} vertices");
}
