//! `--json`: a line for each input, and what names mean in other outputs.

use serde_json::Value;

use super::*;

impl Folder {
    /// The lines of JSON on standard output.
    fn listed(&self, flags: &str, code: i32) -> Vec<Value> {
        let output = self.run(flags);
        assert_eq!(output.status.code(), Some(code), "{flags}: {output:?}");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
    }
}

#[test]
fn facts_are_written_as_json() {
    let folder = Folder::new();
    let facts = &folder.listed("corner.obj --resolution 40,30 --output o.png --json", 0)[0];
    assert_eq!(facts["faces"], 3, "{facts}");
    assert_eq!((&facts["width"], &facts["written"][0]), (&40.into(), &"o.png".into()), "{facts}");
    assert!(facts["draw_seconds"].as_f64().expect("a number") > 0.0, "{facts}");
    assert_eq!(folder.listed("corner.obj corner.obj --no-render --json", 0).len(), 2, "a line each");
    folder.said("corner.obj --output - --json", 2);

    folder.write("inside.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    let check = &folder.listed("inside.obj --check --json", 1)[0];
    assert_eq!(
        (&check["ok"], &check["findings"][0]["fault"]),
        (&false.into(), &"inside-out".into()),
        "{check}"
    );
}

/// An input that failed was left out, so that lines and inputs no longer matched.
#[test]
fn every_input_has_a_line() {
    let folder = Folder::new();
    folder.write("broken.glb", "no model");
    folder.write("empty.obj", "");
    for flags in ["--no-render", "--output {model}.png --resolution 8,8", "--explain-pixel 3,3"] {
        let lines = folder.listed(&format!("corner.obj broken.glb gone.obj empty.obj {flags} --json"), 1);
        assert_eq!(lines.len(), 4, "{flags}: {lines:?}");
        assert!(lines[0]["failure"].is_null(), "{flags}: {}", lines[0]);
        for (line, file) in lines[1..].iter().zip(["broken.glb", "gone.obj", "empty.obj"]) {
            assert_eq!((&line["file"], &line["exit_code"]), (&file.into(), &1.into()), "{flags}: {line}");
            assert!(line["failure"].as_str().is_some_and(|why| why.contains(file)), "{flags}: {line}");
        }
    }
    let lines = folder.listed("corner.obj empty.obj --remove-empty-file-groups --no-render --json", 0);
    assert_eq!(lines.len(), 2, "what is skipped has a line, too: {lines:?}");
    let compared = folder.listed("corner.obj --compare gone.obj --output c.png --json", 1);
    assert!(compared[0]["failure"].as_str().is_some_and(|why| why.contains("gone.obj")), "{compared:?}");
}

/// A square at z = 0 in a turned node below a moved one.
const NESTED: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
"nodes": [{"name": "arm", "translation": [10, 0, 0], "children": [1]},
{"name": "hand", "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 2, 2], "mesh": 0}],
"meshes": [{"name": "card", "primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
"materials": [{"name": "paint", "alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
"buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]}"#;

#[test]
fn nodes_have_ids_names_and_matrices() {
    let folder = Folder::new();
    folder.write("nested.gltf", NESTED);
    let drawn = "nested.gltf --resolution 40,30 --output o.png --outputs object-ids --json";
    for flags in ["nested.gltf --no-render --json", drawn] {
        let facts = &folder.listed(flags, 0)[0];
        let [arm, hand] = [&facts["node_list"][0], &facts["node_list"][1]];
        assert_eq!((&arm["name"], &arm["parent"], &arm["mesh"]), (&"arm".into(), &Value::Null, &Value::Null));
        assert_eq!(
            (&hand["name"], &hand["parent"], &hand["mesh"]),
            (&"hand".into(), &arm["id"], &"card".into())
        );
        // By columns: X becomes 2 Y, Y becomes −2 X, moved by 10.
        let expected = [0.0, 2.0, 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 10.0, 0.0, 0.0, 1.0];
        let matrix = hand["matrix"].as_array().expect("sixteen numbers");
        for (number, expected) in matrix.iter().zip(expected) {
            assert!((number.as_f64().expect("a number") - expected).abs() < 1e-15, "{hand}");
        }
        let paint = &facts["material_list"][0];
        assert_eq!((&paint["name"], &paint["alpha_mode"]), (&"paint".into(), &"mask".into()), "{facts}");
        assert_eq!(hand["materials"][0], paint["id"], "{facts}");
    }
    // The number in the image is the id of the list.
    let ids = array(&folder.path("o.object-ids.npy"));
    let shown = ids.chunks(4).map(|id| u32::from_le_bytes(id.try_into().expect("four bytes")));
    let shown: std::collections::HashSet<u32> = shown.filter(|&id| id != u32::MAX).collect();
    assert_eq!(shown.into_iter().collect::<Vec<u32>>(), [1], "only the hand has a mesh");
}

/// The camera in the line projects the corners of the model to where the image shows them.
#[test]
fn the_camera_is_that_of_the_image() {
    let folder = Folder::new();
    folder.write("wall.obj", "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 0 1 0\nf 1 2 3 4\n");
    let flags = "wall.obj --resolution 60,40 --output o.png --no-background --samples=1 --json";
    let facts =
        &folder.listed(&format!("{flags} --camera-position 4,3,6 --camera-focal-point 1,0.5,0"), 0)[0];
    let camera = &facts["camera"];
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().expect("a list").iter().map(|number| number.as_f64().expect("a number")).collect()
    };
    let (eye, turn) = (numbers(&camera["position"]), numbers(&camera["rotation"]));
    assert_eq!(
        (&eye[..], camera["projection"].as_str()),
        (&[4.0, 3.0, 6.0][..], Some("perspective")),
        "{camera}"
    );
    let k: Vec<Vec<f64>> = (0..3).map(|row| numbers(&camera["K"][row])).collect();
    // By hand: the inverse of the rotation, then K with Y down and Z forward.
    let project = |point: [f64; 3]| {
        let [x, y, z, w] = [-turn[0], -turn[1], -turn[2], turn[3]];
        let p = [point[0] - eye[0], point[1] - eye[1], point[2] - eye[2]];
        let t = [2.0 * (y * p[2] - z * p[1]), 2.0 * (z * p[0] - x * p[2]), 2.0 * (x * p[1] - y * p[0])];
        let across = [y * t[2] - z * t[1], z * t[0] - x * t[2], x * t[1] - y * t[0]];
        let [right, up, back] = std::array::from_fn(|i| p[i] + w * t[i] + across[i]);
        [k[0][0] * right / -back + k[0][2], k[1][1] * -up / -back + k[1][2]]
    };
    let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 1.0, 0.0], [0.0, 1.0, 0.0]].map(project);
    let image = image(&folder.path("o.png"));
    let covered = |x: usize, y: usize| image.rgba[4 * (y * image.width as usize + x) + 3] > 0;
    for y in 0..40 {
        for x in 0..60 {
            let center = [x as f64 + 0.5, y as f64 + 0.5];
            let sides: Vec<f64> = (0..4)
                .map(|i| {
                    let (a, b) = (corners[i], corners[(i + 1) % 4]);
                    let (right, down) = (b[0] - a[0], b[1] - a[1]);
                    let length = (right * right + down * down).sqrt();
                    ((b[0] - a[0]) * (center[1] - a[1]) - (b[1] - a[1]) * (center[0] - a[0])) / -length
                })
                .collect();
            let inside = sides.iter().copied().fold(f64::INFINITY, f64::min);
            // Corners are snapped to 1/256 pixel.
            if inside.abs() > 0.01 {
                assert_eq!(covered(x, y), inside > 0.0, "({x}, {y}): {sides:?}");
            }
        }
    }
}

#[test]
fn what_cannot_be_printed_is_a_fault_on_request() {
    let folder = Folder::new();
    // A tetrahedron, and one that lacks a face.
    let closed = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    folder.write("closed.obj", closed);
    folder.write("open.obj", closed.trim_end_matches("f 2 3 4\n"));
    for (file, flag, code) in
        [("closed", "--check=print", 0), ("open", "--check=print", 1), ("open", "--check", 0)]
    {
        let facts = &folder.listed(&format!("{file}.obj {flag} --json"), code)[0];
        assert_eq!(facts["ok"], code == 0, "{file} {flag}: {facts}");
        let list = if code == 1 { "findings" } else { "notes" };
        assert_eq!(facts[list][0]["fault"] == "open-edges", file == "open", "{file} {flag}: {facts}");
    }
    let said = folder.said("open.obj --check=paper", 2);
    assert!(said.contains("true, false or print"), "{said}");
}

/// A bad value said only which flag, not where it stood.
#[test]
fn a_bad_value_names_the_file_that_holds_it() {
    let folder = Folder::new();
    folder.write("config.json", r#"[{"options": {"edges": true, "roughness": "wet"}}]"#);
    folder.write("imperative.json", r#"[{"options": {"!up": "sideways"}}]"#);
    let state = r#"{"format": "trigon state 1", "files": ["corner.obj"], "options": {"up": "sideways"}}"#;
    folder.write("state.json", state);
    for (flags, file, word) in [
        ("corner.obj --config=config.json", "config.json", "wet"),
        ("corner.obj --config=imperative.json", "imperative.json", "sideways"),
        ("--load-statefile=state.json", "state.json", "sideways"),
    ] {
        let said = folder.said(&format!("{flags} --output o.png"), 2);
        assert!(said.contains(file) && said.contains(word), "{flags}: {said}");
    }
    let said = folder.said("corner.obj --config=config.json --roughness=0.5 --up=sideways --output o.png", 2);
    assert!(!said.contains("config.json"), "what is typed is wrong: {said}");
}
