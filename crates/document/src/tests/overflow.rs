//! Coordinates beyond what files hold: refused, and the document stays as it was.

use super::*;
use crate::tests::commands::try_run;

/// Each of these was accepted, and the export wrote 0 or left faces out.
#[test]
fn a_coordinate_beyond_f32_is_refused() {
    let cases: [(&[serde_json::Value], &str); 7] = [
        // The scripts that were reported.
        (&[json!({ "op": "scale", "factors": [1e200, 1e200, 1e200] })], "object \"torus\""),
        (&[json!({ "op": "translate", "offset": [1e308, 0.0, 0.0] })], "object \"torus\""),
        (
            &[
                json!({ "op": "edit_objects", "objects": ["torus"] }),
                json!({ "op": "set_element_kind", "kind": "vertex" }),
                json!({ "op": "select", "elements": [0] }),
                json!({ "op": "translate", "offset": [0.0, 1e39, 0.0] }),
            ],
            "vertex 0",
        ),
        // Others of the kind.
        (
            &[json!({ "op": "set_transform", "object": "torus", "location": [0.0, 0.0, 4e38] })],
            "object \"torus\"",
        ),
        (
            &[
                json!({ "op": "edit_objects", "objects": ["torus"] }),
                json!({ "op": "select_all" }),
                json!({ "op": "scale", "factors": [1e39, 1.0, 1.0] }),
            ],
            "vertex",
        ),
        (
            &[
                json!({ "op": "edit_objects", "objects": ["torus"] }),
                json!({ "op": "set_element_kind", "kind": "face" }),
                json!({ "op": "select_all" }),
                json!({ "op": "extrude", "offset": [0.0, 1e39, 0.0] }),
            ],
            "vertex",
        ),
        (
            &[
                json!({ "op": "scale", "factors": [1e30, 1e30, 1e30] }),
                json!({ "op": "set_transform", "object": "torus", "location": [1e38, 0.0, 0.0] }),
                json!({ "op": "scale", "factors": [1e30, 1.0, 1.0] }),
            ],
            "object \"torus\"",
        ),
    ];
    for (commands, culprit) in cases {
        let mut document = document();
        let (last, first) = commands.split_last().expect("a command");
        run_all(&mut document, &[json!({ "op": "select", "objects": ["torus"] })]);
        run_all(&mut document, first);
        let before = state(&document);
        let error = try_run(&mut document, last.clone()).map(drop).expect_err("it does not fit").to_string();
        assert!(error.contains(culprit) && error.contains("beyond 3.4e38"), "{last}: {error}");
        assert!(state(&document) == before, "{last}: nothing changed");
    }
}

/// What fits still works, up to the largest numbers.
#[test]
fn a_coordinate_within_f32_is_accepted() {
    let mut document = document();
    run_all(
        &mut document,
        &[
            json!({ "op": "select", "objects": ["torus"] }),
            json!({ "op": "translate", "offset": [3e38, 0.0, 0.0] }),
            json!({ "op": "clear_transform", "location": true }),
            json!({ "op": "edit_objects", "objects": ["torus"] }),
            json!({ "op": "set_element_kind", "kind": "vertex" }),
            json!({ "op": "select", "elements": [0] }),
            json!({ "op": "translate", "offset": [0.0, 3e38, 0.0] }),
        ],
    );
}
