//! Random scripts over all commands, with arguments drawn from the commands' schema, some of them invalid: nothing
//! panics, and what they leave is saved, opened again and exported to every format, with finite numbers in it.
//!
//! `PROPTEST_CASES=10000` makes it a sweep, and with `TRIGON_EXPORTS=folder` it writes what each script leaves in every
//! format, for `tests/peers/check_exports.py`; see `docs/testing.md`.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

use proptest::prelude::*;
use serde_json::{Map, Value, json};
use trigon_document::mesh::math::SplitMix64;
use trigon_document::{Command, Document, Paste, command_schema};
use trigon_io::{ExportOptions, LoadOptions, load_from_slice, writers};
use trigon_modelling::EditMesh;

fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(command_schema)
}

fn resolved(value: &'static Value) -> &'static Value {
    match value["$ref"].as_str().and_then(|path| path.rsplit('/').next()) {
        Some(name) => &schema()["$defs"][name],
        None => value,
    }
}

/// Names of objects, materials, vertex groups and files; some are there.
const NAMES: [&str; 8] = ["Cube", "Plane", "Cube.001", "Material", "Group", "nobody", "+Z", ""];

/// Commands that leave closed meshes closed, whatever they are given: nothing is opened, removed or copied in part.
const CLOSED_STAYS_CLOSED: [&str; 24] = [
    "bevel",
    "catmull_clark",
    "connect_vertices",
    "crease",
    "dissolve",
    "dissolve_flat",
    "flip_normals",
    "knife",
    "loop_cut",
    "push_pull",
    "recalculate_normals",
    "rotate",
    "scale",
    "select_less",
    "select_more",
    "select_sharp",
    "set_element_kind",
    "shear",
    "shrink_fatten",
    "slide_edges",
    "subdivide",
    "to_sphere",
    "triangulate",
    "tris_to_quads",
];

/// Draws arguments.
struct Arguments(SplitMix64);

impl Arguments {
    fn chance(&mut self, one_in: usize) -> bool {
        self.0.below(one_in) == 0
    }

    /// One of all commands, or of those that leave closed meshes closed.
    fn command(&mut self, is_closed: bool) -> Value {
        let variants = schema()["oneOf"].as_array().expect("the commands");
        let name = CLOSED_STAYS_CLOSED[self.0.below(CLOSED_STAYS_CLOSED.len())];
        let named = || variants.iter().find(|variant| variant["properties"]["op"]["const"] == name);
        let variant = match is_closed {
            true => named().expect("the names are those of commands"),
            false => &variants[self.0.below(variants.len())],
        };
        let mut command = self.object(resolved(variant));
        command["op"] = variant["properties"]["op"]["const"].clone();
        command
    }

    /// Each parameter that is required, and half of the others.
    fn object(&mut self, of: &'static Value) -> Value {
        let required: Vec<&str> =
            of["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        let mut object = Map::new();
        for (name, property) in of["properties"].as_object().into_iter().flatten() {
            if required.contains(&name.as_str()) || self.chance(2) {
                object.insert(name.clone(), self.value(property));
            }
        }
        object.into()
    }

    fn value(&mut self, of: &'static Value) -> Value {
        if self.chance(60) {
            let wrong = [json!(null), json!(-1), json!("wrong"), json!([]), json!(1e300)];
            return wrong[self.0.below(wrong.len())].clone();
        }
        // A variant with its tag, and its parameters by reference.
        let tag = of["properties"].as_object().filter(|_| !of["$ref"].is_null());
        if let Some((tag, name)) = tag.and_then(|tag| tag.iter().next()) {
            let mut variant = self.object(resolved(of));
            variant[tag] = name["const"].clone();
            return variant;
        }
        let of = resolved(of);
        if !of["const"].is_null() {
            return of["const"].clone();
        }
        for key in ["oneOf", "anyOf", "enum"] {
            if let Some(choices) = of[key].as_array() {
                let choice = &choices[self.0.below(choices.len())];
                return if key == "enum" { choice.clone() } else { self.value(choice) };
            }
        }
        let kind = match &of["type"] {
            Value::Array(kinds) => kinds[self.0.below(kinds.len())].as_str(),
            kind => kind.as_str(),
        };
        match kind {
            Some("object") => self.object(of),
            Some("array") => {
                let count = of["maxItems"].as_u64().map_or_else(|| self.0.below(4), |count| count as usize);
                (0..count).map(|_| self.value(&of["items"])).collect()
            }
            Some("boolean") => self.chance(2).into(),
            Some("integer") => {
                // Great counts take time and show nothing else.
                let least = of["minimum"].as_u64().unwrap_or(0);
                (least + self.0.below(4) as u64).into()
            }
            Some("number") => self.number().into(),
            Some("string") => NAMES[self.0.below(NAMES.len())].into(),
            _ => Value::Null,
        }
    }

    fn number(&mut self) -> f64 {
        const SPECIAL: [f64; 8] = [0.0, 1.0, -1.0, 0.5, 90.0, 1e30, -1e-30, 3.0e38];
        if self.chance(3) { SPECIAL[self.0.below(SPECIAL.len())] } else { self.0.between(-2.0, 2.0) }
    }
}

/// Shapes with a border, and the teapot, whose parts pass through each other.
const OPEN_SHAPES: [&str; 4] = ["plane", "grid", "disc", "teapot"];

/// Small models of the corpus.
fn corpus() -> &'static [PathBuf] {
    static FILES: OnceLock<Vec<PathBuf>> = OnceLock::new();
    FILES.get_or_init(|| {
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/corpus");
        let mut files = Vec::new();
        for folder in ["ok", "geom", "obj", "ply", "off", "stl", "anim", "float"] {
            let entries =
                std::fs::read_dir(PathBuf::from(root).join(folder)).expect("a folder of the corpus");
            files.extend(entries.map(|entry| entry.expect("an entry").path()));
        }
        files.sort();
        files
    })
}

fn run(document: &mut Document, json: Value) -> bool {
    serde_json::from_value::<Command>(json).is_ok_and(|command| document.run(command).is_ok())
}

/// A document to begin with: a model of the corpus, or two primitives; then everything is selected, often in edit mode.
fn start(arguments: &mut Arguments, is_closed: bool) -> Document {
    let mut document = Document::default();
    if !is_closed && arguments.chance(3) {
        let path = &corpus()[arguments.0.below(corpus().len())];
        if let Ok((opened, _)) = Document::open(path, &LoadOptions::default()) {
            document = opened;
        }
    }
    let shapes = schema()["$defs"]["Shape"]["examples"].as_array().expect("of each shape one");
    let closed: Vec<&Value> =
        shapes.iter().filter(|shape| OPEN_SHAPES.iter().all(|name| shape["shape"] != *name)).collect();
    for name in ["Cube", "Plane"] {
        let shape = match is_closed {
            true => closed[arguments.0.below(closed.len())],
            false => &shapes[arguments.0.below(shapes.len() - 1)],
        };
        run(&mut document, json!({ "op": "add_object", "object": shape, "name": name }));
    }
    if arguments.chance(2) {
        run(&mut document, json!({ "op": "edit_objects", "objects": ["Cube"] }));
        let kind = ["vertex", "edge", "face"][arguments.0.below(3)];
        run(&mut document, json!({ "op": "set_element_kind", "kind": kind }));
    }
    run(&mut document, json!({ "op": "select_all" }));
    document
}

/// What a random script left.
struct Case {
    script: Vec<String>,
    /// Whether all meshes were closed, and all commands leave them so.
    is_closed: bool,
    /// How many faces lay on others before the script.
    doubled_faces: usize,
    /// Whether all positions were finite before: what is not edited is saved as it came.
    is_finite: bool,
}

impl Case {
    fn new(document: &mut Document, is_closed: bool) -> Self {
        let scene = document.scene();
        let meshes = || scene.meshes().iter().map(|(_, asset)| asset.mesh());
        let doubled_faces = meshes().map(|mesh| EditMesh::from_mesh(mesh).0.doubled_faces().len()).sum();
        let is_finite = meshes().all(|mesh| mesh.positions().iter().all(|position| position.is_finite()));
        Self { script: Vec::new(), is_closed, doubled_faces, is_finite }
    }

    /// The case's files for another program: `TRIGON_EXPORTS` names the folder.
    fn folder(&self) -> Option<PathBuf> {
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = PathBuf::from(std::env::var_os("TRIGON_EXPORTS")?).join(format!("{number:06}"));
        std::fs::create_dir_all(&folder).expect("the folder can be made");
        let facts = json!({
            "closed": self.is_closed, "doubled_faces": self.doubled_faces, "finite": self.is_finite, "script": self.script.join("\n"),
        });
        std::fs::write(folder.join("case.json"), facts.to_string()).expect("the folder can be written to");
        Some(folder)
    }
}

fn write(folder: Option<&Path>, name: &str, bytes: &[u8]) {
    if let Some(folder) = folder {
        std::fs::write(folder.join(name), bytes).expect("the folder can be written to");
    }
}

fn check(document: &mut Document, case: &Case) -> Result<(), TestCaseError> {
    let folder = case.folder();
    let folder = folder.as_deref();

    let ids: Vec<_> = document.scene().meshes().iter().map(|(id, _)| id).collect();
    for id in ids {
        if let Some(mesh) = document.mesh(id) {
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            let is_finite = mesh.vertices().all(|vertex| mesh.position(vertex).is_finite());
            prop_assert!(is_finite, "a position is no number");
        }
    }
    let native = document.to_native();
    let file = native.encode().map_err(|error| TestCaseError::fail(error.to_string()))?;
    write(folder, "saved.glb", &file.to_bytes());
    let opened = Document::open_bytes("a.glb".as_ref(), &file.to_bytes(), &LoadOptions::default());
    let (again, _) = opened.map_err(|error| TestCaseError::fail(error.to_string()))?;
    prop_assert_eq!(again.nodes().nodes().len(), document.nodes().nodes().len());
    for writer in writers() {
        let name = format!("a.{}", writer.extensions[0]);
        // What a format cannot hold at all is refused.
        let Ok(export) = document.export(&name, writer.format, &ExportOptions::default()) else { continue };
        export.files.iter().for_each(|file| write(folder, &file.name, &file.bytes));
        let model = export.files.last().expect("the model");
        let options = LoadOptions { may_be_empty: true, ..LoadOptions::default() };
        let loaded = load_from_slice(&name, &model.bytes, &options);
        let loaded = loaded.map_err(|error| TestCaseError::fail(format!("{name}: {error}")))?;
        for (_, asset) in loaded.scene.meshes().iter() {
            let is_finite = asset.mesh().positions().iter().all(|position| position.is_finite());
            prop_assert!(is_finite, "{}: a position is no number", name);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn whatever_a_script_says_the_document_is_saved_opened_and_exported(seed in any::<u64>(), length in 1_usize..12) {
        let mut arguments = Arguments(SplitMix64::new(seed));
        let is_closed = arguments.chance(4);
        let mut document = start(&mut arguments, is_closed);
        let mut case = Case::new(&mut document, is_closed);
        for _ in 0..length {
            if !is_closed && arguments.chance(8) {
                if let Ok(bytes) = document.copy() {
                    let _ = document.run(Paste { glb: bytes.into() }.into());
                }
                continue;
            }
            if arguments.chance(4) {
                run(&mut document, json!({ "op": "select_all" }));
            }
            let command = arguments.command(is_closed);
            case.script.push(command.to_string());
            if run(&mut document, command) && arguments.chance(6) {
                document.undo().expect("one was done");
                document.redo().expect("it was undone");
            }
        }
        if let Err(error) = check(&mut document, &case) {
            return Err(TestCaseError::fail(format!("{error}\n{}", case.script.join("\n"))));
        }
    }
}
