//! What is pointed at is what gets selected: held against the scene's picker by where elements are,
//! not by their numbers, on models whose numbering has holes.

use std::collections::BTreeSet;

use serde_json::json;
use trigon_mesh::math::{DVec3, Vec3};
use trigon_mesh::{Mesh, primitives};
use trigon_modelling::{FaceId, VertexId};
use trigon_scene::camera::{Camera, Projector, Viewport};
use trigon_scene::{Frame, Material, Node, Outputs, RenderSettings, Scene, render};

use super::*;
use crate::tests::commands::run;

const SIZE: Viewport = Viewport { width: 96, height: 72 };

/// A document and an image of it.
struct View {
    document: Document,
    camera: Camera,
    frame: Frame,
}

impl View {
    fn new(mut document: Document) -> Self {
        let outputs = Outputs { ids: true, ..Outputs::NONE };
        let settings =
            RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(SIZE.width, SIZE.height) };
        let scene = document.scene();
        let camera = scene.overview(settings.aspect());
        let frame = render(scene, &camera, &settings).expect("a small image");
        Self { document, camera, frame }
    }

    fn with<T>(&self, reach: Reach, ask: impl FnOnce(&Picks<'_>) -> T) -> T {
        let picker = Picker::new(self.document.nodes(), &self.camera, &self.frame);
        ask(&Picks::new(&self.document, &picker, Projector::new(&self.camera, SIZE), reach))
    }

    fn picked<T>(&self, ask: impl FnOnce(&Picker<'_>) -> T) -> T {
        ask(&Picker::new(self.document.nodes(), &self.camera, &self.frame))
    }

    /// Runs a command that was picked, if any.
    fn select(&mut self, reach: Reach, ask: impl FnOnce(&Picks<'_>) -> Option<Command>) {
        if let Some(command) = self.with(reach, ask) {
            self.document.run(command.clone()).unwrap_or_else(|error| panic!("{command:?}: {error}"));
        }
    }

    fn mesh_id(&self) -> MeshId {
        self.document.selection().meshes().next().expect("one is edited").0
    }

    /// Where the selected elements are.
    fn selected(&self) -> BTreeSet<Vec<[u32; 3]>> {
        let (id, selection) = self.document.selection().meshes().next().expect("one is edited");
        let (mesh, kind) = (self.document.mesh(id).expect("it is edited"), self.document.selection().kind());
        selection.indices().map(|element| corners_of(mesh, kind, element)).collect()
    }

    /// Where the elements are that the picker finds, of the object that is edited.
    fn found(&self, kind: ElementKind, set: &ElementSet) -> BTreeSet<Vec<[u32; 3]>> {
        let scene = self.document.nodes();
        let is_edited = |node: &NodeId| scene.node(*node).and_then(|node| node.mesh) == Some(self.mesh_id());
        let mesh = scene.meshes().get(self.mesh_id()).expect("it stays").mesh();
        let own = set.iter().filter(|(node, _)| is_edited(node));
        own.map(|(_, element)| shown_corners(mesh, kind, element as usize)).collect()
    }
}

/// The bits of all positions of an element.
fn corners(positions: impl Iterator<Item = Vec3>) -> Vec<[u32; 3]> {
    let mut bits: Vec<_> = positions.map(|position| position.to_array().map(f32::to_bits)).collect();
    bits.sort_unstable();
    bits
}

fn corners_of(mesh: &EditMesh, kind: ElementKind, element: u32) -> Vec<[u32; 3]> {
    let at = |vertex| mesh.position(vertex);
    match kind {
        ElementKind::Vertex => corners([at(VertexId::new(element))].into_iter()),
        ElementKind::Edge => corners(mesh.edge_vertices(EdgeId::new(element)).map(at).into_iter()),
        ElementKind::Face => corners(mesh.face_vertices(FaceId::new(element)).map(at)),
    }
}

fn shown_corners(mesh: &Mesh, kind: ElementKind, element: usize) -> Vec<[u32; 3]> {
    let at = |vertex: u32| mesh.positions()[vertex as usize];
    match kind {
        ElementKind::Vertex => corners([at(element as u32)].into_iter()),
        ElementKind::Edge => corners(mesh.edges()[element].map(at).into_iter()),
        ElementKind::Face => {
            corners(mesh.face_corners(element).map(|corner| at(mesh.corner_vertices()[corner])))
        }
    }
}

/// An edited object with holes in all numberings, and a ball beside it that hides a part of it and is
/// not edited.
fn documents() -> Vec<Document> {
    let models = [
        primitives::torus(2.0, 0.7, 12, 8),
        primitives::icosphere(1.5, 2),
        primitives::grid(3.0, 3.0, 7, 6),
        primitives::cylinder(1.0, 2.0, 9),
    ];
    models.into_iter().map(|model| document(model, true)).collect()
}

fn document(model: Mesh, has_ball: bool) -> Document {
    let mut scene = Scene::new();
    let mut add = |name: &str, mesh: Mesh, at: DVec3| {
        let (mesh, material) = (scene.add_mesh(name, mesh), scene.add_material(Material::default()));
        scene.add(Node::from_mesh(mesh, material).with_name(name).at(at))
    };
    if has_ball {
        add("ball", primitives::icosphere(0.6, 2), DVec3::new(1.0, 0.6, 1.6));
    }
    add("model", model, DVec3::new(0.0, 0.1, 0.2));
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "edit_objects", "objects": ["model"] }));
    run(&mut document, json!({ "op": "set_element_kind", "kind": "face" }));
    run(&mut document, json!({ "op": "select", "elements": [2, 5, 6] }));
    run(&mut document, json!({ "op": "delete" }));
    run(&mut document, json!({ "op": "select", "elements": [8] }));
    // New elements take the places of those that are gone, not in the order of their places.
    run(&mut document, json!({ "op": "extrude" }));
    run(&mut document, json!({ "op": "translate", "offset": [0.01, 0.25, 0.02] }));
    document
}

fn regions() -> Vec<Region> {
    let point = DVec2::new;
    vec![
        Region::Rectangle { min: DVec2::ZERO, max: point(96.0, 72.0) },
        Region::Rectangle { min: point(20.3, 15.0), max: point(60.0, 40.7) },
        Region::Circle { center: point(50.0, 36.0), radius: 14.0 },
        Region::Lasso(vec![point(10.0, 10.0), point(80.0, 20.0), point(40.0, 65.0), point(50.0, 30.0)]),
        Region::Rectangle { min: DVec2::ZERO, max: point(1.0, 1.0) },
    ]
}

const KINDS: [ElementKind; 3] = [ElementKind::Vertex, ElementKind::Edge, ElementKind::Face];
const REACHES: [Reach; 2] = [Reach::Visible, Reach::Through];

fn set_kind(view: &mut View, kind: ElementKind) {
    view.document.run(crate::SetElementKind { kind, extend: false }.into()).expect("always possible");
}

#[test]
fn regions_select_what_the_picker_finds_in_every_mode() {
    let mut compared = 0;
    for document in documents() {
        let mut view = View::new(document);
        for kind in KINDS {
            set_kind(&mut view, kind);
            for (reach, region) in
                REACHES.iter().flat_map(|&reach| regions().into_iter().map(move |r| (reach, r)))
            {
                let set = view.picked(|picker| match kind {
                    ElementKind::Vertex => picker.vertices(&region, reach),
                    ElementKind::Edge => picker.edges(&region, reach),
                    ElementKind::Face => picker.faces(&region, reach),
                });
                let found = view.found(kind, &set);
                compared += found.len();
                for action in [
                    SelectAction::Replace,
                    SelectAction::Add,
                    SelectAction::Remove,
                    SelectAction::Toggle,
                    SelectAction::Intersect,
                ] {
                    let before = view.selected();
                    view.select(reach, |picks| picks.region(&region, action));
                    let expected: BTreeSet<_> = match action {
                        SelectAction::Replace => found.clone(),
                        SelectAction::Add => before.union(&found).cloned().collect(),
                        SelectAction::Remove => before.difference(&found).cloned().collect(),
                        SelectAction::Toggle => before.symmetric_difference(&found).cloned().collect(),
                        SelectAction::Intersect => before.intersection(&found).cloned().collect(),
                    };
                    assert_eq!(view.selected(), expected, "{kind:?} {reach:?} {region:?} {action:?}");
                }
            }
        }
    }
    assert!(compared > 1000, "{compared} elements were compared");
}

/// With several kinds, a region selects what it selects of each, as elements of the first kind.
#[test]
fn regions_select_every_kind_that_is_enabled() {
    let mut compared = 0;
    for document in documents() {
        let mut view = View::new(document);
        for kinds in [[0, 1, 2].as_slice(), &[0, 2], &[0, 1], &[1, 2]] {
            for (reach, region) in
                REACHES.iter().flat_map(|&reach| regions().into_iter().map(move |r| (reach, r)))
            {
                let first = KINDS[kinds[0]];
                let mut expected = BTreeSet::new();
                for &kind in kinds {
                    // One kind alone, as another test compares it, then converted.
                    set_kind(&mut view, KINDS[kind]);
                    view.select(reach, |picks| picks.region(&region, SelectAction::Replace));
                    set_kind(&mut view, first);
                    expected.extend(view.selected());
                }
                for &kind in &kinds[1..] {
                    let kind = KINDS[kind];
                    view.document.run(crate::SetElementKind { kind, extend: true }.into()).expect("possible");
                }
                view.select(reach, |picks| picks.region(&region, SelectAction::Replace));
                compared += expected.len();
                assert_eq!(view.selected(), expected, "{kinds:?} {reach:?} {region:?}");
            }
        }
    }
    assert!(compared > 1000, "{compared} elements were compared");
}

#[test]
fn vertices_are_those_whose_points_lie_in_the_region() {
    // The rule itself, by this test's own projection.
    for document in documents() {
        let mut view = View::new(document);
        set_kind(&mut view, ElementKind::Vertex);
        let (min, max) = (DVec2::new(12.3, 9.0), DVec2::new(70.0, 60.7));
        view.select(Reach::Through, |picks| {
            picks.region(&Region::Rectangle { min, max }, SelectAction::Replace)
        });
        let node = view
            .document
            .nodes()
            .nodes()
            .iter()
            .find(|(_, node)| node.name == "model")
            .expect("it is there")
            .0;
        let world = view.document.nodes().world_transform(node);
        let projector = Projector::new(&view.camera, SIZE);
        let mesh = view.document.mesh(view.mesh_id()).expect("it is edited");
        let inside = mesh.vertices().filter(|&vertex| {
            let at = projector.to_screen(world.transform_point3(mesh.position(vertex).as_dvec3()));
            let is_used = mesh.vertex_edges(vertex).next().is_some();
            is_used && at.is_some_and(|at| at.cmpge(min).all() && at.cmplt(max).all())
        });
        let expected: BTreeSet<_> =
            inside.map(|v| corners_of(mesh, ElementKind::Vertex, v.index())).collect();
        assert!(!expected.is_empty(), "the region is on the model");
        assert_eq!(view.selected(), expected);
    }
}

#[test]
fn clicks_select_the_nearest_that_is_edited() {
    for document in documents() {
        let mut view = View::new(document);
        for kind in KINDS {
            set_kind(&mut view, kind);
            let mut found = 0;
            for (x, y) in (4..96).step_by(13).flat_map(|x| (3..72).step_by(11).map(move |y| (x, y))) {
                let point = DVec2::new(f64::from(x), f64::from(y));
                view.select(Reach::Visible, |picks| picks.click(point, 6.0, SelectAction::Replace));
                let selected = view.selected();
                let circle = Region::Circle { center: point, radius: 6.0 };
                let near = view.picked(|picker| match kind {
                    ElementKind::Vertex => picker.vertices(&circle, Reach::Visible),
                    ElementKind::Edge => picker.edges(&circle, Reach::Visible),
                    ElementKind::Face => picker.faces(&circle, Reach::Visible),
                });
                let near = view.found(kind, &near);
                assert_eq!(selected.len(), usize::from(!near.is_empty()), "{kind:?} at {point}");
                assert!(selected.is_subset(&near), "{kind:?} at {point}");
                found += selected.len();
            }
            assert!(found > 3, "{kind:?}: {found} clicks hit something");
        }
    }
}

#[test]
fn loops_paths_and_linked_parts_are_those_of_the_selected_kind() {
    let mut view = View::new(document(primitives::torus(2.0, 0.7, 12, 8), false));
    set_kind(&mut view, ElementKind::Edge);
    let middle = |view: &View, reach| {
        let all = Region::Rectangle { min: DVec2::ZERO, max: SIZE.size() };
        let edges = view.picked(|picker| picker.edges(&all, reach));
        edges.iter().nth(edges.len() / 2).expect("there are many")
    };
    let (node, number) = middle(&view, Reach::Visible);
    let target = view.with(Reach::Visible, |picks| picks.target(ElementKind::Edge, node, number));
    let target = target.expect("it is edited");
    let mesh = view.document.mesh(target.mesh).expect("it is edited").clone();
    let world = view.document.nodes().world_transform(node);
    let [a, b] = mesh.edge_vertices(EdgeId::new(target.element)).map(|v| mesh.position(v).as_dvec3());
    let point = Projector::new(&view.camera, SIZE)
        .to_screen(world.transform_point3(a.lerp(b, 0.5)))
        .expect("it is seen");
    let corners = |edges: Vec<EdgeId>| -> BTreeSet<_> {
        edges.into_iter().map(|edge| corners_of(&mesh, ElementKind::Edge, edge.index())).collect()
    };
    let picked = view.with(Reach::Visible, |picks| picks.nearest(ElementKind::Edge, point, 3.0));
    let edge = EdgeId::new(picked.expect("one is near").element);
    view.select(Reach::Visible, |picks| picks.edge_loop(point, 3.0, SelectAction::Replace));
    assert_eq!(view.selected(), corners(edge_loop(&mesh, edge)), "the loop");
    view.select(Reach::Visible, |picks| picks.edge_ring(point, 3.0, SelectAction::Replace));
    assert_eq!(view.selected(), corners(edge_ring(&mesh, edge)), "the ring");
    view.select(Reach::Visible, |picks| picks.linked(point, 3.0, SelectAction::Replace));
    assert_eq!(view.selected(), corners(mesh.edges().collect()), "all of one piece");
    run(
        &mut view.document,
        json!({ "op": "select", "elements": [mesh.edges().next().expect("many").index()] }),
    );
    view.select(Reach::Visible, |picks| picks.path(point, 3.0));
    let first = mesh.edges().next().expect("many").index();
    let path = shortest_path(&mesh, ElementKind::Edge, first, edge.index()).expect("one piece");
    assert_eq!(view.selected(), corners(path.into_iter().map(EdgeId::new).collect()), "the path");
    let order = view.document.selection().of(target.mesh).expect("it is edited").order();
    assert_eq!(order.last(), Some(&edge.index()), "the end of the path is active");
    set_kind(&mut view, ElementKind::Face);
    view.select(Reach::Visible, |picks| picks.edge_loop(point, 3.0, SelectAction::Replace));
    let faces = face_loop(&mesh, edge).into_iter();
    let faces: BTreeSet<_> = faces.map(|face| corners_of(&mesh, ElementKind::Face, face.index())).collect();
    assert_eq!(view.selected(), faces, "the loop of faces");
}

#[test]
fn what_is_hidden_is_not_selected() {
    let mut document = document(primitives::grid(3.0, 3.0, 7, 6), false);
    run(&mut document, json!({ "op": "select", "elements": [10, 11, 12] }));
    run(&mut document, json!({ "op": "hide" }));
    let mut view = View::new(document);
    for kind in KINDS {
        set_kind(&mut view, kind);
        let all = Region::Rectangle { min: DVec2::ZERO, max: SIZE.size() };
        view.select(Reach::Through, |picks| picks.region(&all, SelectAction::Replace));
        let (id, selection) = view.document.selection().meshes().next().expect("one is edited");
        let mesh = view.document.mesh(id).expect("it is edited");
        let selected: Vec<u32> = selection.indices().collect();
        assert!(selected.iter().all(|&element| is_selectable(mesh, kind, element)), "{kind:?}");
        assert!(!selected.is_empty(), "{kind:?}");
    }
}

#[test]
fn objects_are_selected_by_points_and_regions() {
    let mut view = View::new(documents().remove(0));
    run(&mut view.document, json!({ "op": "leave_edit_mode" }));
    let names = |view: &View| -> Vec<String> {
        let scene = view.document.nodes();
        let selected = view.document.selection().objects.iter();
        selected.map(|&node| scene.node(node).expect("it stays").name.clone()).collect()
    };
    let all = Region::Rectangle { min: DVec2::ZERO, max: SIZE.size() };
    view.select(Reach::Visible, |picks| picks.region(&all, SelectAction::Replace));
    assert_eq!(names(&view), ["ball", "model"]);
    view.select(Reach::Visible, |picks| picks.click(DVec2::new(0.5, 0.5), 2.0, SelectAction::Add));
    assert_eq!(names(&view).len(), 2, "adding nothing changes nothing");
    view.select(Reach::Visible, |picks| picks.click(DVec2::new(0.5, 0.5), 2.0, SelectAction::Replace));
    assert!(names(&view).is_empty(), "a click beside all");
    let (x, y) = (0..96)
        .flat_map(|x| (0..72).map(move |y| (x, y)))
        .find(|&(x, y)| view.frame.hit(view.document.nodes().nodes(), x, y).is_some())
        .expect("something is seen");
    let hit = view.frame.hit(view.document.nodes().nodes(), x, y).expect("as found");
    let point = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
    view.select(Reach::Visible, |picks| picks.click(point, 2.0, SelectAction::Replace));
    assert_eq!(view.document.selection().objects.iter().copied().collect::<Vec<_>>(), [hit.node]);
}

/// A cube with a surface of two levels, as a window shows it: through a copy of the scene.
fn smooth_cube(kind: &str) -> (Document, Scene) {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(2.0), Material::default());
    let (mut document, mut copy) = (Document::new(scene), Scene::new());
    run(&mut document, json!({ "op": "edit_objects", "objects": ["cube"] }));
    run(&mut document, json!({ "op": "set_element_kind", "kind": kind }));
    run(&mut document, json!({ "op": "set_subdivision", "levels": 2 }));
    for change in document.take_scene_changes() {
        change.apply(document.nodes(), &mut copy);
    }
    (document, copy)
}

/// What a click near the image of a point selects.
fn clicked(kind: &str, at: DVec3) -> Vec<u32> {
    let (mut document, copy) = smooth_cube(kind);
    let outputs = Outputs { ids: true, ..Outputs::NONE };
    let settings =
        RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(SIZE.width, SIZE.height) };
    let camera = copy.overview(settings.aspect());
    let frame = render(&copy, &camera, &settings).expect("a small image");
    let picker = Picker::new(&copy, &camera, &frame);
    let projector = Projector::new(&camera, SIZE);
    let point = projector.to_screen(at).expect("it is in the image") + DVec2::splat(0.25);
    let command =
        Picks::new(&document, &picker, projector, Reach::Visible).click(point, 5.0, SelectAction::Replace);
    run_picked(&mut document, command);
    let (_, selection) = document.selection().meshes().next().expect("one is edited");
    selection.indices().collect()
}

fn run_picked(document: &mut Document, command: Option<Command>) {
    document.run(command.expect("something is there")).unwrap_or_else(|error| panic!("{error}"));
}

#[test]
fn clicks_on_a_subdivision_surface_lead_to_its_cage() {
    let (document, copy) = smooth_cube("vertex");
    let (id, _) = document.selection().meshes().next().expect("one is edited");
    let mesh = document.mesh(id).expect("it is edited");
    assert_eq!(
        copy.meshes().get(id).expect("the copy has it").mesh().face_count(),
        96,
        "the surface is shown"
    );
    let corner = Vec3::ONE;
    let vertex = mesh.vertices().find(|vertex| mesh.position(*vertex) == corner).expect("a cube has it");
    assert_eq!(clicked("vertex", corner.as_dvec3()), [vertex.index()], "the cage's, beside the surface");
    let top = mesh.faces().find(|face| mesh.face_center(*face).y > 0.5).expect("a cube has one");
    // On the surface, which lies below the cage.
    assert_eq!(clicked("face", DVec3::new(0.1, 0.65, 0.2)), [top.index()], "by a part of it");
    let edge = mesh.edges().find(|edge| {
        mesh.edge_vertices(*edge)
            .into_iter()
            .all(|end| mesh.position(end).y == 1.0 && mesh.position(end).x == 1.0)
    });
    let edge = edge.expect("a cube has it").index();
    assert_eq!(clicked("edge", DVec3::new(1.0, 1.0, 0.3)), [edge], "the cage's, beside the surface");
}

/// Of several kinds the first one holds the selection: a face is its vertices.
#[test]
fn a_click_on_a_face_beside_vertices_selects_and_toggles_all_of_its_vertices() {
    let mut scene = Scene::new();
    scene.add_object("grid", primitives::grid(2.0, 2.0, 2, 2), Material::default());
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "edit_objects", "objects": ["grid"] }));
    let mut view = View::new(document);
    set_kind(&mut view, ElementKind::Vertex);
    let both = crate::SetElementKind { kind: ElementKind::Face, extend: true };
    view.document.run(both.into()).expect("always possible");
    let mesh = view.document.mesh(view.mesh_id()).expect("it is edited").clone();
    let projector = Projector::new(&view.camera, SIZE);
    for face in mesh.faces() {
        let center = projector.to_screen(mesh.face_center(face)).expect("it is in the image");
        let corners: BTreeSet<_> =
            mesh.face_vertices(face).map(|v| corners([mesh.position(v)].into_iter())).collect();
        let mut click = |action| {
            view.select(Reach::Visible, |picks| picks.click(center, 4.0, action));
            view.selected()
        };
        assert_eq!(click(SelectAction::Replace), corners, "face {face:?}");
        assert!(click(SelectAction::Toggle).is_empty(), "all were selected: now none is");
        // With one of its vertices selected before, the others come to it.
        let vertex = mesh.face_vertices(face).next().expect("four of them");
        let at = projector.to_screen(mesh.position(vertex).as_dvec3()).expect("it is in the image");
        view.select(Reach::Visible, |picks| picks.click(at, 4.0, SelectAction::Replace));
        assert_eq!(view.selected().len(), 1, "a vertex");
        view.select(Reach::Visible, |picks| picks.click(center, 4.0, SelectAction::Toggle));
        assert_eq!(view.selected(), corners, "face {face:?}");
    }
}

/// By this test's own projection, also where something that is not edited is nearer to the pointer.
#[test]
fn of_several_vertices_in_reach_the_nearest_is_selected() {
    let mut others_are_nearer = 0;
    for document in documents() {
        let mut view = View::new(document);
        set_kind(&mut view, ElementKind::Vertex);
        let projector = Projector::new(&view.camera, SIZE);
        for (x, y) in (4..96).step_by(5).flat_map(|x| (3..72).step_by(5).map(move |y| (x, y))) {
            let (point, radius) = (DVec2::new(f64::from(x), f64::from(y)), 12.0);
            let set = view
                .picked(|picker| picker.vertices(&Region::Circle { center: point, radius }, Reach::Through));
            let near = view.found(ElementKind::Vertex, &set);
            if near.is_empty() {
                continue;
            }
            let node = view.document.nodes().nodes().iter().find(|(_, node)| node.name == "model");
            let world = view.document.nodes().world_transform(node.expect("it is there").0);
            let distance = |bits: &Vec<[u32; 3]>| {
                let position = Vec3::from(bits[0].map(f32::from_bits)).as_dvec3();
                projector.to_screen(world.transform_point3(position)).expect("it is seen").distance(point)
            };
            let nearest = near.iter().map(&distance).fold(f64::INFINITY, f64::min);
            let very_nearest = view.picked(|picker| picker.nearest(point, radius, Reach::Through).vertex);
            let is_others = very_nearest.is_some_and(|(other, _)| {
                view.document.nodes().node(other).is_some_and(|node| node.name == "ball")
            });
            others_are_nearer += usize::from(is_others && near.len() > 1);
            view.select(Reach::Through, |picks| picks.click(point, radius, SelectAction::Replace));
            let selected: Vec<f64> = view.selected().iter().map(&distance).collect();
            assert_eq!(selected.len(), 1, "at {point}");
            assert!(selected[0] < nearest + 1e-3, "at {point}: {} instead of {nearest}", selected[0]);
        }
    }
    assert!(others_are_nearer > 20, "{others_are_nearer} times the ball was nearer");
}
