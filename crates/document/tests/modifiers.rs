//! A random stack of modifiers on a random mesh gives what applying them one after the other gives, to the byte, after any
//! sequence of edits and undos: by `apply_modifier`, and by the commands for elements that each modifier stands for. Undoing
//! gives the first bytes.

use serde_json::{Value, json};
use trigon_document::mesh::math::{SplitMix64, Vec2, Vec3};
use trigon_document::mesh::{Attributes, Mesh, MeshBuilder, primitives};
use trigon_document::modelling::{BeveledEdges, EditMesh, Modifier, ModifierState, StackedModifier};
use trigon_document::scene::{Material, MeshId, Scene};
use trigon_document::{Command, Document};

/// Sessions, each with a mesh of its own.
const SESSIONS: u64 = 60;
/// Edits in each.
const STEPS: usize = 12;
/// A mesh beyond this is put away: stacks on it would take the time of many.
const MOST_FACES: usize = 300;

fn vector(random: &mut SplitMix64) -> [f64; 3] {
    [(); 3].map(|()| random.between(-1.5, 1.5))
}

/// Polygons over random vertices: anything may touch anything.
fn soup(random: &mut SplitMix64) -> Mesh {
    let mut builder = MeshBuilder::new();
    let count = 8 + random.below(8);
    for _ in 0..count {
        builder.push_vertex(Vec3::from_array(vector(random).map(|x| x as f32)));
    }
    for _ in 0..12 {
        let face: Vec<u32> = (0..3 + random.below(3)).map(|_| random.below(count) as u32).collect();
        // Some have too few vertices.
        drop(builder.push_face(&face));
    }
    builder.build()
}

fn mesh(random: &mut SplitMix64) -> Mesh {
    let mut mesh = match random.below(7) {
        0 => soup(random),
        1 => primitives::grid(2.0, 2.0, 3, 2),
        2 => primitives::torus(1.0, 0.4, 5, 4),
        3 => primitives::icosphere(1.0, 1),
        4 => primitives::cylinder(1.0, 2.0, 6),
        5 => primitives::polyline(&[Vec3::ZERO, Vec3::X, Vec3::ONE]),
        _ => primitives::cube(2.0),
    };
    let uvs = (0..mesh.corner_count()).map(|corner| Vec2::new(corner as f32 * 0.125, 0.5)).collect();
    let attributes = Attributes { uv_sets: vec![uvs], ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one for each corner");
    mesh
}

/// A group that limits a modifier: none, one that meshes may have, or one that none has.
fn group(random: &mut SplitMix64) -> &'static str {
    ["", "", "Group", "nothing"][random.below(4)]
}

fn modifier(random: &mut SplitMix64) -> Value {
    let distance = [Value::Null, json!(0.0), json!(0.01), json!(0.5)][random.below(4)].clone();
    match random.below(9) {
        0 => json!({ "kind": "subdivision", "levels": 1 + random.below(2) }),
        1 => {
            let axes = [(); 3].map(|()| random.below(2) == 0);
            let [bisect, flip] = [(); 2].map(|()| random.below(3) == 0);
            json!({ "kind": "mirror", "axes": axes, "merge_distance": distance, "bisect": bisect, "flip": flip })
        }
        2 => json!({
            "kind": "array", "count": 1 + random.below(3), "offset": vector(random), "relative_offset": vector(random),
            "merge_distance": distance,
        }),
        3 => json!({
            "kind": "bevel", "edges": (["angle", "sharp", "creased", "all"][random.below(4)]),
            "width": random.between(0.0, 0.3), "segments": 1 + random.below(2), "harden_normals": random.below(2) == 0,
            "group": group(random),
        }),
        4 => json!({ "kind": "weld", "distance": random.between(0.0, 0.8) }),
        5 => {
            let (group, invert) = (group(random), random.below(2) == 0);
            json!({
                "kind": "solidify", "thickness": random.between(0.0, 0.5), "rim": random.below(2) == 0,
                "group": group, "invert_group": invert,
            })
        }
        6 => json!({ "kind": "decimate", "ratio": random.between(0.0, 1.0), "group": group(random) }),
        7 => json!({ "kind": "screw", "steps": 3 + random.below(3), "height": random.between(-1.0, 1.0) }),
        _ => json!({ "kind": "triangulate", "least_corners": 4 + random.below(2) }),
    }
}

/// A command that changes the elements or the stack; it may be refused.
fn step(random: &mut SplitMix64) -> Value {
    let index = random.below(3);
    match random.below(19) {
        0..5 => json!({ "op": "add_modifier", "modifier": modifier(random) }),
        5 => json!({ "op": "set_modifier", "index": index, "modifier": modifier(random) }),
        6 => json!({ "op": "remove_modifier", "index": index }),
        7 => json!({ "op": "move_modifier", "index": index, "to": random.below(3) }),
        8 => json!({ "op": "show_modifier", "index": index, "on": random.below(3) > 0 }),
        9 => json!({ "op": "apply_modifier", "index": index }),
        10 => json!({ "op": "set_subdivision", "levels": random.below(3) }),
        11 => json!({ "op": "translate", "offset": vector(random) }),
        12 => json!({ "op": "extrude", "distance": 0.3 }),
        13 => json!({ "op": "delete", "what": (["vertices", "edges", "faces"][random.below(3)]) }),
        14 => json!({ "op": "crease", "crease": 0.5 }),
        15 => json!({ "op": "add_vertex_group" }),
        16 => {
            let falloff = json!({ "radius": random.between(0.1, 2.0), "connected": random.below(2) == 0 });
            json!({ "op": "assign_to_vertex_group", "weight": random.between(0.0, 1.0), "falloff": falloff })
        }
        17 => json!({ "op": "rename_vertex_group", "name": (["Group", "other"][random.below(2)]) }),
        _ => json!({ "op": "mark_sharp" }),
    }
}

struct Session {
    document: Document,
    id: MeshId,
}

impl Session {
    fn new(mesh: Mesh) -> Self {
        let mut scene = Scene::new();
        let node = scene.add_object("mesh", mesh, Material::default());
        let id = scene.node(node).and_then(|node| node.mesh).expect("it has a mesh");
        let mut document = Document::new(scene);
        for command in [json!({ "op": "select_all" }), json!({ "op": "edit_objects", "objects": [0] })] {
            document.run(serde_json::from_value(command).expect("a command")).expect("it has a mesh");
        }
        Self { document, id }
    }

    fn mesh(&self) -> &EditMesh {
        self.document.mesh(self.id).expect("it is edited")
    }

    /// Whether it was done.
    fn run(&mut self, json: Value) -> bool {
        let command: Command =
            serde_json::from_value(json.clone()).unwrap_or_else(|error| panic!("{json}: {error}"));
        self.document.run(command).is_ok()
    }

    fn select(&mut self, kind: &str, elements: &[u32]) {
        assert!(self.run(json!({ "op": "set_element_kind", "kind": kind })), "it is in edit mode");
        assert!(self.run(json!({ "op": "select", "objects": [0], "elements": elements })), "they exist");
    }

    fn select_all(&mut self, kind: &str) {
        assert!(self.run(json!({ "op": "set_element_kind", "kind": kind })), "it is in edit mode");
        assert!(self.run(json!({ "op": "select_all" })), "it is in edit mode");
    }

    /// Selects some elements, one in three.
    fn select_some(&mut self, random: &mut SplitMix64) {
        let kind = ["vertex", "edge", "face"][random.below(3)];
        let all: Vec<u32> = match kind {
            "vertex" => self.mesh().vertices().map(|vertex| vertex.index()).collect(),
            "edge" => self.mesh().edges().map(|edge| edge.index()).collect(),
            _ => self.mesh().faces().map(|face| face.index()).collect(),
        };
        let some: Vec<u32> = all.into_iter().filter(|_| random.below(3) == 0).collect();
        self.select(kind, &some);
    }

    /// Undoes back to a number of entries.
    fn undo_to(&mut self, done: usize) {
        while self.document.history().done().len() > done {
            self.document.undo().expect("there is an entry");
        }
    }

    /// What a view shows, from results that it retained.
    fn shown(&mut self) -> Mesh {
        let scene = self.document.scene_to_render();
        scene.meshes().get(self.id).expect("it is in the scene").mesh().clone()
    }

    /// Each modifier by the command that applies it; one that a view leaves out is removed.
    fn apply_all(&mut self, states: &[ModifierState]) {
        for state in states {
            let is_shown = matches!(state, ModifierState::Shown);
            let op = if is_shown { "apply_modifier" } else { "remove_modifier" };
            assert!(self.run(json!({ "op": op, "index": 0 })), "it was shown");
        }
    }

    /// What modifiers stand for, by commands on selected elements.
    fn do_all(&mut self, stack: &[StackedModifier]) {
        for modifier in stack.iter().filter(|stacked| stacked.is_on).map(|stacked| &stacked.modifier) {
            let done = self.document.history().done().len();
            if !self.do_as(modifier) {
                self.undo_to(done);
            }
        }
    }

    /// Whether nothing was refused.
    fn do_as(&mut self, modifier: &Modifier) -> bool {
        let has_faces = self.mesh().face_count() > 0;
        match modifier {
            Modifier::Subdivision(settings) => {
                !has_faces || self.run(json!({ "op": "catmull_clark", "levels": settings.levels }))
            }
            Modifier::Mirror(settings) => (0..3).filter(|&axis| settings.axes[axis]).all(|axis| {
                let mut normal = [0.0; 3];
                normal[axis] = if settings.flip { -1.0 } else { 1.0 };
                let (plane, distance) = (json!({ "normal": normal }), settings.merge_distance);
                if settings.bisect && has_faces {
                    self.select_all("face");
                    let distance = distance.unwrap_or(0.0);
                    return self
                        .run(json!({ "op": "symmetrize", "plane": plane, "merge_distance": distance }));
                }
                self.select_all("edge");
                let copy =
                    json!({ "op": "mirror", "plane": plane, "copy": true, "merge_distance": distance });
                self.mesh().edge_count() == 0 || self.run(copy)
            }),
            Modifier::Array(settings) => {
                let mesh = self.mesh();
                let points = || mesh.vertices().map(|vertex| mesh.position(vertex).as_dvec3());
                let lowest = points().reduce(|a, b| a.min(b)).unwrap_or_default();
                let size = points().reduce(|a, b| a.max(b)).unwrap_or_default() - lowest;
                let step: Vec<f64> = (0..3)
                    .map(|axis| settings.offset[axis] + settings.relative_offset[axis] * size[axis])
                    .collect();
                let all: Vec<u32> = mesh.vertices().map(|vertex| vertex.index()).collect();
                for number in 1..settings.count {
                    self.select("vertex", &all);
                    let offset: Vec<f64> = step.iter().map(|length| length * f64::from(number)).collect();
                    let is_done = all.is_empty()
                        || self.run(json!({ "op": "duplicate" }))
                            && self.run(json!({ "op": "translate", "offset": offset }));
                    if !is_done {
                        return false;
                    }
                }
                settings.merge_distance.is_none_or(|distance| self.merge(distance))
            }
            Modifier::Bevel(settings) => {
                let mesh = self.mesh();
                let edges = mesh.edges().filter(|&edge| match settings.edges {
                    BeveledEdges::Sharp => mesh.is_sharp(edge),
                    BeveledEdges::Creased => mesh.crease(edge) > 0.0,
                    BeveledEdges::All | BeveledEdges::Angle => true,
                });
                let edges: Vec<u32> = edges.map(|edge| edge.index()).collect();
                self.select("edge", &edges);
                if settings.edges == BeveledEdges::Angle {
                    assert!(self.run(json!({ "op": "select_sharp", "angle": settings.angle })), "it selects");
                }
                let within = json!({ "op": "select_vertex_group", "group": settings.group, "minimum": 0.5, "action": "intersect" });
                if !settings.group.is_empty() && !self.run(within) {
                    return false;
                }
                // Where there is nothing to bevel it is refused, and nothing changes.
                self.run(json!({
                    "op": "bevel", "width": settings.width, "segments": settings.segments,
                    "harden_normals": settings.harden_normals,
                }));
                true
            }
            Modifier::Weld(settings) => self.merge(settings.distance),
            Modifier::Solidify(settings) => {
                self.select_all("face");
                let solidify = json!({
                    "op": "solidify", "thickness": settings.thickness, "offset": settings.offset,
                    "even": settings.even, "rim": settings.rim, "group": settings.group,
                    "invert_group": settings.invert_group,
                });
                !has_faces || self.run(solidify)
            }
            Modifier::Decimate(settings) => {
                self.select_all("face");
                let (ratio, group) = (settings.ratio, &settings.group);
                !has_faces || self.run(json!({ "op": "decimate", "ratio": ratio, "group": group }))
            }
            Modifier::Screw(_) | Modifier::Boolean(_) => false,
            Modifier::Triangulate(settings) => {
                let is_large = |&face: &_| self.mesh().face_size(face) >= settings.least_corners as usize;
                let faces: Vec<u32> = self.mesh().faces().filter(is_large).map(|face| face.index()).collect();
                self.select("face", &faces);
                faces.is_empty() || self.run(json!({ "op": "triangulate" }))
            }
        }
    }

    fn merge(&mut self, distance: f64) -> bool {
        self.select_all("vertex");
        let merge = json!({ "op": "merge", "at": "distance", "distance": distance });
        self.mesh().vertex_count() == 0 || self.run(merge)
    }
}

/// Whether a command does the same with elements that can be selected together.
fn has_command(modifier: &Modifier) -> bool {
    !matches!(modifier, Modifier::Screw(_) | Modifier::Boolean(_))
}

/// Compares what is shown now with what is made in both ways. Returns how many modifiers were shown.
fn check(session: &mut Session, what: &str) -> usize {
    let (before, done) = (session.mesh().clone(), session.document.history().done().len());
    let shown = session.shown();
    let states: Vec<ModifierState> = session.document.modifier_states(session.id).cloned().collect();
    // Commands have no limit such as that of a view.
    if states.iter().any(|state| matches!(state, ModifierState::Fewer(_) | ModifierState::TooDense(_))) {
        return 0;
    }
    session.apply_all(&states);
    assert!(session.mesh().modifiers().is_empty(), "{what}: the stack is empty");
    assert_eq!(session.mesh().check_structure(), Ok(()), "{what}");
    assert!(session.mesh().to_mesh().0 == shown, "{what}: applied one after the other\n{states:?}");
    session.undo_to(done);
    assert!(*session.mesh() == before, "{what}: undone to the byte");
    assert!(session.shown() == shown, "{what}: shown as before");
    let shown_count = states.iter().filter(|state| matches!(state, ModifierState::Shown)).count();
    if before.modifiers().iter().any(|stacked| !has_command(&stacked.modifier)) {
        return shown_count;
    }
    // Once more, from the mesh alone.
    while session.run(json!({ "op": "remove_modifier", "index": 0 })) {}
    session.do_all(before.modifiers());
    assert!(session.mesh().to_mesh().0 == shown, "{what}: by commands on elements\n{states:?}");
    session.undo_to(done);
    assert!(*session.mesh() == before, "{what}: undone to the byte");
    shown_count
}

#[test]
fn stacks_give_what_commands_give_after_any_edits_and_undos() {
    let mut shown = 0;
    for seed in 0..SESSIONS {
        let mut random = SplitMix64::new(seed);
        let mut session = Session::new(mesh(&mut random));
        let mut script = Vec::new();
        for _ in 0..STEPS {
            session.select_some(&mut random);
            let command = step(&mut random);
            script.push(command.to_string());
            let is_done = session.run(command);
            if session.mesh().face_count() > MOST_FACES {
                break;
            }
            for _ in 0..random.below(3) {
                drop(if random.below(2) == 0 { session.document.undo() } else { session.document.redo() });
                script.push("undone or done again".to_owned());
            }
            if is_done {
                shown += check(&mut session, &format!("session {seed}\n{}", script.join("\n")));
            }
        }
    }
    assert!(shown > 500, "a test of empty stacks would show nothing: {shown} modifiers");
}

/// The volume that a view shows of the mesh of an object.
fn shown_volume(document: &mut Document, name: &str) -> f64 {
    let scene = document.scene_to_render();
    let (_, node) = scene.nodes().iter().find(|(_, node)| node.name == name).expect("it is there");
    let mesh = scene.meshes().get(node.mesh.expect("it has one")).expect("it is in the scene").mesh();
    EditMesh::from_mesh(mesh).0.volume()
}

fn run(document: &mut Document, json: Value) {
    let command = serde_json::from_value(json.clone()).expect("a command");
    document.run(command).unwrap_or_else(|error| panic!("{json}: {error}"));
}

#[test]
fn a_boolean_follows_the_other_object() {
    let mut scene = Scene::new();
    scene.add_object("body", primitives::cube(2.0), Material::default());
    scene.add_object("drill", primitives::cube(1.0), Material::default());
    let mut document = Document::new(scene);
    let drilled = 8.0 - 0.5;
    let is_near = |volume: f64, expected: f64| (volume - expected).abs() < 1e-6;
    run(&mut document, json!({ "op": "select", "objects": ["drill"] }));
    run(&mut document, json!({ "op": "translate", "offset": [0, 1, 0] }));
    let boolean = json!({ "kind": "boolean", "object": "drill" });
    run(&mut document, json!({ "op": "add_modifier", "object": "body", "modifier": boolean }));
    assert!(is_near(shown_volume(&mut document, "body"), drilled), "a hole from above");
    run(&mut document, json!({ "op": "translate", "offset": [0, 1, 0] }));
    assert!(is_near(shown_volume(&mut document, "body"), 8.0), "the drill is away");
    document.undo().expect("the move");
    assert!(is_near(shown_volume(&mut document, "body"), drilled), "it is back");
    run(&mut document, json!({ "op": "rename_object", "object": "drill", "name": "tool" }));
    run(
        &mut document,
        json!({ "op": "add_modifier", "object": "tool", "modifier": { "kind": "array", "relative_offset": [0, -1, 0] } }),
    );
    assert!(is_near(shown_volume(&mut document, "body"), 8.0 - 1.5), "a longer drill of another name");
    let bytes = document.to_native().encode().expect("it is small").to_bytes();
    let options = trigon_io::LoadOptions::default();
    let (mut again, warnings) =
        Document::open_bytes("a.glb".as_ref(), &bytes, &options).expect("it is whole");
    assert_eq!(warnings, []);
    assert!(is_near(shown_volume(&mut again, "body"), 8.0 - 1.5), "saved with names");
    run(&mut document, json!({ "op": "apply_modifier", "object": "body" }));
    run(&mut document, json!({ "op": "delete_objects" }));
    assert!(is_near(shown_volume(&mut document, "body"), 8.0 - 1.5), "the hole stays");
    document.undo().expect("the deletion");
    document.undo().expect("the hole");
    run(&mut document, json!({ "op": "delete_objects" }));
    assert!(is_near(shown_volume(&mut document, "body"), 8.0), "without a drill there is no hole");
}

#[test]
fn copies_stand_to_each_other_as_another_object_to_the_mesh() {
    let mut scene = Scene::new();
    scene.add_object("post", primitives::cube(1.0), Material::default());
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "add_empty", "name": "step" }));
    run(&mut document, json!({ "op": "set_transform", "location": [2, 0, 0], "scale": [2, 2, 2] }));
    let array = json!({ "kind": "array", "count": 3, "relative_offset": [0, 0, 0], "object": "step" });
    run(&mut document, json!({ "op": "add_modifier", "object": "post", "modifier": array }));
    // Each copy is twice as large as the one before: 1, 8 and 64 cubic metres.
    assert!((shown_volume(&mut document, "post") - 73.0).abs() < 1e-4, "three cubes");
    run(&mut document, json!({ "op": "set_transform", "scale": [1, 1, 1] }));
    assert!((shown_volume(&mut document, "post") - 3.0).abs() < 1e-4, "of one size");
    let scene = document.scene_to_render();
    assert!((scene.bounds().max.x - 4.5).abs() < 1e-6, "0, 2 and 4 m away: {:?}", scene.bounds());
}
