//! Ten thousand random operations on random meshes, a third of them non-manifold or open.
//!
//! After each the structure is whole; a refusal changes nothing; undoing all gives the first bytes,
//! redoing all the last. Each operation is run a hundred times at least, and of these runs four
//! fifths at least change the mesh: a test that only ever met refusals would show nothing. The counts are printed
//! (`cargo test -p trigon-document --test random_operations -- --nocapture`).

use std::collections::BTreeMap;

use serde_json::{Value, json};
use trigon_document::mesh::math::{SplitMix64, Vec3};
use trigon_document::mesh::{Attributes, Mesh, MeshBuilder, primitives};
use trigon_document::modelling::{EdgeId, EditMesh, FaceId};
use trigon_document::scene::{Material, MeshId, Scene};
use trigon_document::{Command, Document, Selection};

const OPERATIONS: usize = 10_000;
const RUNS_OF_EACH: usize = 100;
/// A mesh that has grown beyond this is put away: the operations on it would take the time of many.
const MOST_FACES: usize = 1500;

/// −1 to 1.
fn signed(random: &mut SplitMix64) -> f64 {
    random.between(-1.0, 1.0)
}

fn vector(random: &mut SplitMix64) -> [f64; 3] {
    [(); 3].map(|()| signed(random))
}

/// Polygons over random vertices: anything may touch anything.
fn soup(random: &mut SplitMix64) -> Mesh {
    let mut builder = MeshBuilder::new();
    let count = 8 + random.below(20);
    for _ in 0..count {
        builder.push_vertex(Vec3::from_array(vector(random).map(|x| x as f32 * 2.0)));
    }
    for _ in 0..12 + random.below(12) {
        let face: Vec<u32> = (0..3 + random.below(4)).map(|_| random.below(count) as u32).collect();
        // Some have too few vertices.
        drop(builder.push_face(&face));
    }
    builder.build()
}

fn mesh(random: &mut SplitMix64) -> Mesh {
    let mut mesh = match random.below(9) {
        0 | 1 => soup(random),
        2 => primitives::grid(2.0, 2.0, 2 + random.below(4) as u32, 2 + random.below(4) as u32),
        3 => primitives::torus(2.0, 0.5, 5, 4),
        4 => primitives::icosphere(1.0, 1),
        5 => primitives::cylinder(1.0, 2.0, 6),
        6 => primitives::uv_sphere(1.0, 6, 5),
        7 => primitives::dodecahedron(1.0),
        _ => primitives::cube(2.0),
    };
    let corners = mesh.corner_count();
    let attributes =
        Attributes { uv_sets: vec![vec![Default::default(); corners]], ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one for each corner");
    mesh
}

/// What has to be selected for an operation.
#[derive(Clone, Copy)]
enum Needs {
    /// Of this kind ("vertex" …), about so many elements in one place.
    Some(&'static str, usize),
    /// The edges around one face, of an even number if there is one; the face goes.
    Outline,
}

/// An operation: its name, what it needs, and its parameters.
struct Operation {
    name: &'static str,
    needs: Needs,
    parameters: fn(&mut SplitMix64, &Chosen<'_>) -> Value,
}

/// What is selected.
struct Chosen<'s> {
    mesh: &'s EditMesh,
    first: Option<u32>,
}

impl Chosen<'_> {
    /// Whether the first selected edge has a mark.
    fn edge(&self, has: fn(&EditMesh, EdgeId) -> bool) -> bool {
        self.first.is_some_and(|edge| has(self.mesh, EdgeId::new(edge)))
    }

    /// A cut across the first selected face, from one of its edges to another.
    fn across(&self) -> Value {
        let Some(face) = self.first else { return json!([]) };
        let edges: Vec<EdgeId> = self.mesh.face_edges(FaceId::new(face)).collect();
        let on = |edge: EdgeId, position: f64| json!({ "at": "edge", "edge": (edge.index()), "position": position });
        json!([on(edges[0], 0.5), on(edges[edges.len() / 2], 0.25)])
    }

    /// Whether the first selected face has a mark.
    fn face(&self, has: fn(&EditMesh, FaceId) -> bool) -> bool {
        self.first.is_some_and(|face| has(self.mesh, FaceId::new(face)))
    }
}

/// All commands that change meshes.
fn operations() -> Vec<Operation> {
    use Needs::Some;
    let operation = |name, needs, parameters| Operation { name, needs, parameters };
    vec![
        operation("translate", Some("vertex", 5), |r, _| json!({ "offset": vector(r) })),
        operation(
            "rotate",
            Some("face", 3),
            |r, _| json!({ "angle": signed(r) * 90.0, "axis": vector(r), "individual": r.below(3) == 0 }),
        ),
        operation("scale", Some("edge", 4), |r, _| json!({ "factors": vector(r).map(|x| 1.0 + 0.5 * x) })),
        operation("shear", Some("vertex", 5), |r, _| json!({ "factor": signed(r) })),
        operation("to_sphere", Some("face", 4), |r, _| json!({ "factor": signed(r) })),
        operation("shrink_fatten", Some("face", 4), |r, _| json!({ "distance": 0.2 * signed(r) })),
        operation("push_pull", Some("vertex", 4), |r, _| json!({ "distance": 0.2 * signed(r) })),
        operation("reset_vertices", Some("vertex", 1000), |_, _| json!({})),
        operation("subdivide", Some("edge", 6), |r, _| json!({ "cuts": 1 + r.below(3) })),
        operation(
            "loop_cut",
            Some("edge", 1),
            |r, _| json!({ "cuts": 1 + r.below(2), "position": signed(r) * 0.5 }),
        ),
        operation("slide_edges", Some("edge", 1), |r, _| json!({ "factor": 0.5 * signed(r) })),
        operation(
            "slide_vertices",
            Some("vertex", 3),
            |r, _| json!({ "factor": 0.5 * signed(r), "direction": vector(r) }),
        ),
        operation("merge", Some("vertex", 3), |r, _| {
            let at = ["center", "first", "last", "collapse", "distance"][r.below(5)];
            json!({ "at": at, "distance": 1.0 })
        }),
        operation("mark_sharp", Some("edge", 4), |_, at| json!({ "sharp": (!at.edge(EditMesh::is_sharp)) })),
        operation("mark_seam", Some("edge", 4), |_, at| json!({ "seam": (!at.edge(EditMesh::is_seam)) })),
        operation("crease", Some("edge", 4), |r, _| json!({ "crease": (signed(r) + 1.0) / 2.0 })),
        operation("add_vertex_group", Some("vertex", 4), |r, _| json!({ "empty": r.below(4) == 0 })),
        operation(
            "assign_to_vertex_group",
            Some("vertex", 3),
            |r, _| json!({ "weight": r.between(0.0, 1.0), "falloff": { "radius": 1.5, "connected": r.below(2) == 0 } }),
        ),
        operation("remove_from_vertex_group", Some("vertex", 2), |_, _| json!({})),
        operation(
            "rename_vertex_group",
            Some("vertex", 1),
            |r, _| json!({ "name": r.below(1 << 20).to_string() }),
        ),
        operation("remove_vertex_group", Some("vertex", 1), |_, _| json!({})),
        operation("shade", Some("face", 4), |_, at| json!({ "smooth": (!at.face(EditMesh::is_smooth)) })),
        operation("assign_material", Some("face", 4), |r, _| json!({ "material": r.below(50) })),
        operation("hide", Some("face", 2), |_, _| json!({})),
        operation("reveal", Some("face", 1), |_, _| json!({})),
        operation("flip_normals", Some("face", 3), |_, _| json!({})),
        operation("recalculate_normals", Some("face", 1000), |r, _| json!({ "inside": r.below(2) == 0 })),
        operation(
            "mirror",
            Some("face", 4),
            |r, _| json!({ "plane": { "normal": vector(r) }, "copy": r.below(2) == 0, "merge_distance": 0.01 }),
        ),
        operation("symmetrize", Some("face", 1000), |r, _| json!({ "plane": { "normal": vector(r) } })),
        operation(
            "extrude",
            Some("face", 3),
            |r, _| json!({ "distance": (0.3 * signed(r)), "individual": (r.below(3) == 0) }),
        ),
        operation("inset", Some("face", 3), |r, _| {
            let mode = ["region", "individual", "outset"][r.below(3)];
            json!({ "thickness": 0.05, "depth": (0.1 * signed(r)), "mode": mode })
        }),
        operation(
            "bevel",
            Some("edge", 3),
            |r, _| json!({ "width": 0.05, "segments": (1 + r.below(3)), "vertices": (r.below(4) == 0) }),
        ),
        operation("bevel", Some("edge", 6), |r, _| {
            let types = ["offset", "width", "depth", "percent", "absolute"];
            let (outer, inner) = (["sharp", "patch", "arc"][r.below(3)], ["sharp", "arc"][r.below(2)]);
            json!({
                "width": 0.03, "width_type": types[r.below(5)], "segments": (1 + r.below(3)),
                "outer_miter": outer, "inner_miter": inner, "mark_sharp": (r.below(2) == 0),
                "mark_seams": (r.below(2) == 0), "harden_normals": (r.below(2) == 0)
            })
        }),
        operation(
            "rip",
            Some("edge", 2),
            |r, _| json!({ "direction": (vector(r)), "fill": (r.below(2) == 0) }),
        ),
        operation(
            "solidify",
            Some("face", 3),
            |r, _| json!({ "thickness": 0.05, "offset": (signed(r)), "even": (r.below(2) == 0) }),
        ),
        operation(
            "spin",
            Some("edge", 2),
            |r, _| json!({ "axis": (vector(r)), "angle": (90.0 * signed(r)), "steps": (1 + r.below(3)) }),
        ),
        operation("decimate", Some("face", 1000), |r, _| json!({ "ratio": (r.between(0.5, 0.9)) })),
        operation("un_subdivide", Some("face", 1000), |_, _| json!({})),
        operation("bisect", Some("face", 1000), |r, _| {
            let [clear_outer, clear_inner, fill] = [6, 6, 2].map(|times| r.below(times) == 0);
            json!({
                "point": (vector(r).map(|x| 0.3 * x)), "normal": (vector(r)), "clear_outer": clear_outer,
                "clear_inner": clear_inner, "fill": fill
            })
        }),
        operation(
            "wireframe",
            Some("face", 2),
            |r, _| json!({ "thickness": 0.02, "replace": (r.below(2) == 0) }),
        ),
        operation("poke", Some("face", 2), |r, _| json!({ "offset": (0.2 * signed(r)) })),
        operation("convex_hull", Some("vertex", 8), |r, _| json!({ "replace": (r.below(2) == 0) })),
        operation("duplicate", Some("face", 3), |r, _| json!({ "offset": (vector(r)) })),
        operation("split_off", Some("face", 2), |_, _| json!({})),
        operation("dissolve", Some("edge", 1), |_, _| json!({})),
        operation("dissolve_flat", Some("face", 1000), |_, _| json!({ "angle": 40 })),
        operation("catmull_clark", Some("face", 1), |_, _| json!({})),
        operation("triangulate", Some("face", 3), |_, _| json!({})),
        operation(
            "tris_to_quads",
            Some("face", 1000),
            |_, _| json!({ "face_angle": 180, "shape_angle": 180 }),
        ),
        operation("connect_vertices", Some("vertex", 4), |_, _| json!({})),
        operation("fill", Some("edge", 3), |_, _| json!({})),
        operation("grid_fill", Needs::Outline, |r, _| json!({ "offset": r.below(4) })),
        operation("knife", Some("face", 1), |_, at| json!({ "strokes": [at.across()] })),
        operation("bridge", Some("edge", 2), |_, _| json!({})),
        operation("project_uvs", Some("face", 3), |r, _| json!({ "normal": (vector(r)) })),
        operation("project_uvs_on_box", Some("face", 3), |r, _| json!({ "center": (vector(r)) })),
        operation("project_uvs_cylinder", Some("face", 3), |r, _| json!({ "axis": (vector(r)) })),
        operation("project_uvs_sphere", Some("face", 3), |r, _| json!({ "axis": (vector(r)) })),
        operation("unwrap", Some("face", 3), |r, _| json!({ "minimize_stretch": r.below(3) })),
        operation("smart_project", Some("face", 5), |r, _| json!({ "angle_limit": r.between(5.0, 89.0) })),
        operation("pin_uvs", Some("face", 2), |_, at| {
            let is_pinned =
                |mesh: &EditMesh, face| mesh.face_corners(face).all(|at| mesh.is_uv_pinned(0, at));
            json!({ "pinned": (!at.face(is_pinned)) })
        }),
        operation("stitch_uvs", Some("edge", 5), |r, _| json!({ "at_midpoints": r.below(2) == 0 })),
        operation("pack_islands", Some("face", 5), |r, _| json!({ "rotate": r.below(2) == 0 })),
        operation("make_solid", Some("face", 1), |_, _| json!({ "within": 0.3, "zero_area": 0.05 })),
        operation("repair", Some("face", 1), |_, _| json!({ "zero_length": 0.3, "zero_area": 0.05 })),
        operation(
            "delete",
            Some("face", 2),
            |r, _| json!({ "what": (["vertices", "edges", "faces", "only_faces"][r.below(4)]) }),
        ),
    ]
}

fn command(op: &str, parameters: Value) -> Command {
    let mut object = parameters;
    object["op"] = op.into();
    serde_json::from_value(object.clone()).unwrap_or_else(|error| panic!("{object}: {error}"))
}

/// A document with one mesh that is edited.
struct Session {
    document: Document,
    mesh: MeshId,
}

impl Session {
    fn new(mesh: Mesh) -> Self {
        let mut scene = Scene::new();
        let node = scene.add_object("mesh", mesh, Material::default());
        let mesh = scene.node(node).and_then(|node| node.mesh).expect("it has a mesh");
        let mut document = Document::new(scene);
        document.run(command("edit_objects", json!({ "objects": [0] }))).expect("it has a mesh");
        Self { document, mesh }
    }

    fn mesh(&self) -> &EditMesh {
        self.document.mesh(self.mesh).expect("it is edited")
    }

    fn state(&self) -> (EditMesh, Selection) {
        (self.mesh().clone(), self.document.selection().clone())
    }

    /// Selects about as many elements as are needed, one beside the other.
    fn select(&mut self, needs: Needs, random: &mut SplitMix64) {
        let (kind, count) = match needs {
            Needs::Some(kind, count) => (kind, count),
            Needs::Outline => ("edge", 0),
        };
        self.run("set_element_kind", json!({ "kind": kind }));
        let mesh = self.mesh();
        let all: Vec<u32> = match kind {
            "vertex" => mesh.vertices().filter(|&v| !mesh.is_vertex_hidden(v)).map(|v| v.index()).collect(),
            "edge" => mesh.edges().filter(|&e| !mesh.is_edge_hidden(e)).map(|e| e.index()).collect(),
            _ => mesh.faces().filter(|&f| !mesh.is_face_hidden(f)).map(|f| f.index()).collect(),
        };
        if all.is_empty() {
            return;
        }
        if count == 0 {
            let faces: Vec<FaceId> = mesh.faces().filter(|&face| !mesh.is_face_hidden(face)).collect();
            let even: Vec<FaceId> =
                faces.into_iter().filter(|&face| mesh.face_size(face).is_multiple_of(2)).collect();
            let face = even.get(random.below(even.len())).copied();
            let outline = face.into_iter().flat_map(|face| mesh.face_edges(face));
            let outline: Vec<u32> = outline.map(EdgeId::index).collect();
            // What is filled has to be a gap.
            if let Some(face) = face {
                self.run("set_element_kind", json!({ "kind": "face" }));
                self.run("select", json!({ "elements": [face.index()] }));
                self.run("delete", json!({ "what": "only_faces" }));
                self.run("set_element_kind", json!({ "kind": "edge" }));
            }
            return self.run("select", json!({ "elements": outline }));
        }
        if count >= 1000 {
            return self.run("select_all", json!({}));
        }
        let place = random.below(all.len());
        let mut chosen: Vec<u32> =
            all.iter().cycle().skip(place).take(count.min(all.len())).copied().collect();
        chosen.dedup();
        self.run("select", json!({ "elements": chosen }));
    }

    fn run(&mut self, op: &str, parameters: Value) {
        self.document.run(command(op, parameters)).unwrap_or_else(|error| panic!("{op}: {error}"));
    }

    /// Whether the scene's mesh, which follows changes, is the one that would be made anew.
    fn shows_what_is_edited(&mut self) -> bool {
        self.document.scene();
        let shown = self.document.nodes().meshes().get(self.mesh).expect("it stays");
        *shown.mesh() == self.mesh().to_mesh().0
    }

    /// Back to the start and forth again.
    fn finish(mut self, first: &(EditMesh, Selection)) {
        let last = self.state();
        let entries = self.document.history().done().len();
        // The first entry is edit mode.
        for _ in 1..entries {
            self.document.undo().expect("it was done");
        }
        assert!(self.state() == *first, "all undone gives the first bytes");
        assert!(self.shows_what_is_edited(), "the first mesh");
        for _ in 1..entries {
            self.document.redo().expect("it was undone");
        }
        assert!(self.state() == last, "all done again gives the last bytes");
        assert!(self.shows_what_is_edited(), "the last mesh");
    }
}

#[derive(Default)]
struct Count {
    done: usize,
    changed: usize,
    refused: usize,
}

#[test]
fn ten_thousand_random_operations_keep_meshes_whole() {
    let mut random = SplitMix64::new(22);
    let operations = operations();
    let mut counts: BTreeMap<&str, Count> = BTreeMap::new();
    let mut total = 0;
    while total < OPERATIONS || counts.values().any(|count| count.done < RUNS_OF_EACH) {
        assert!(total < 20 * OPERATIONS, "some operation is always refused");
        let mut session = Session::new(mesh(&mut random));
        let first = session.state();
        for _ in 0..25 {
            // What was run least comes first, so that each gets its share.
            let fewest = |operation: &&Operation| counts.get(operation.name).map_or(0, |count| count.done);
            let operation = if random.below(2) == 0 {
                &operations[random.below(operations.len())]
            } else {
                operations.iter().min_by_key(fewest).expect("there are some")
            };
            // So that there is something to do.
            let prepare = match operation.name {
                "recalculate_normals" | "make_solid" => Some(("face", 2, "flip_normals")),
                "tris_to_quads" | "dissolve_flat" => Some(("face", 2, "triangulate")),
                // Quads throughout.
                "triangulate" => Some(("face", 1, "catmull_clark")),
                "reveal" => Some(("face", 2, "hide")),
                "reset_vertices" => Some(("vertex", 5, "to_sphere")),
                "un_subdivide" => Some(("face", 1, "catmull_clark")),
                "remove_from_vertex_group" => Some(("vertex", 1000, "add_vertex_group")),
                "assign_to_vertex_group" | "rename_vertex_group" | "remove_vertex_group" => {
                    Some(("vertex", 1, "add_vertex_group"))
                }
                // A loose edge.
                "repair" => Some(("vertex", 1, "extrude")),
                _ => None,
            };
            if let Some((kind, count, prepare)) = prepare {
                session.select(Needs::Some(kind, count), &mut random);
                // Where nothing can be prepared, the operation counts all the same.
                drop(session.document.run(command(prepare, json!({}))));
            }
            session.select(operation.needs, &mut random);
            let before = session.mesh().clone();
            let selection = session.document.selection().of(session.mesh).expect("it is edited");
            let chosen = Chosen { mesh: session.mesh(), first: selection.indices().next() };
            let parameters = (operation.parameters)(&mut random, &chosen);
            let said = parameters.to_string();
            let result = session.document.run(command(operation.name, parameters));
            total += 1;
            let count = counts.entry(operation.name).or_default();
            let has_changed = *session.mesh() != before;
            if let Err(error) = &result {
                count.refused += 1;
                assert!(!has_changed, "{} was refused ({error}) and changed the mesh", operation.name);
            } else {
                count.done += 1;
                count.changed += usize::from(has_changed);
            }
            if let Err(broken) = session.mesh().check_structure() {
                panic!("after {} {said}: {broken}", operation.name);
            }
            assert!(
                session.shows_what_is_edited(),
                "after {} {said} the scene shows another mesh",
                operation.name
            );
            if session.mesh().face_count() > MOST_FACES || session.mesh().face_count() == 0 {
                break;
            }
        }
        session.finish(&first);
    }
    println!("{:24} {:>6} {:>8} {:>8}", "operation", "done", "changed", "refused");
    for (name, count) in &counts {
        println!("{name:24} {:>6} {:>8} {:>8}", count.done, count.changed, count.refused);
    }
    for (name, count) in &counts {
        let share = count.changed as f64 / count.done as f64;
        assert!(share >= 0.8, "{name} changed only {} of {} meshes", count.changed, count.done);
    }
    println!("{total} operations");
}
