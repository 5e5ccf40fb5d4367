//! Pins, and texture coordinates that come together, onto lines and to even sizes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_modelling::{FaceId, StitchSettings, UvAlignment};

use super::{Action, Outcome, selected_uv_corners};
use crate::error::EditError;
use crate::selection::ElementKind;
use crate::state::{AfterEdit, Change};

const SOMETHING: &str = "at least one selected element";
const EDGES: &str = "at least one selected edge";
const FACES: &str = "at least one selected face";

/// Pins the texture coordinates of the selected elements, and of corners that share them, or frees them. `unwrap` lays out
/// the other coordinates of an island around them, and `pack_islands` leaves islands with pins where they are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct PinUvs {
    /// The set of texture coordinates, from 0.
    #[schemars(range(min = 0, max = 31))]
    pub uv_set: u32,
    /// Whether they are pinned.
    pub pinned: bool,
}

impl Default for PinUvs {
    fn default() -> Self {
        Self { uv_set: 0, pinned: true }
    }
}

impl Action for PinUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (uv_set, kind) = (self.uv_set as usize, change.selection().kind());
        let mut count = 0;
        change.edit_selected("pinning texture coordinates", SOMETHING, |mesh, selection| {
            let corners = selected_uv_corners(mesh, selection, kind, uv_set);
            count += match self.pinned {
                true => mesh.pin_uvs(uv_set, &corners)?,
                false => mesh.unpin_uvs(uv_set, &corners)?,
            };
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::counted("changed", count, ["corner", "corners"]))
    }
}

/// Brings islands of texture coordinates together along the selected edges: each is turned and moved to the one that stays
/// or came before it, and then both sides get the same coordinates. The island of the active face stays, or else that
/// with most faces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StitchUvs {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// Whether both sides meet in the middle, and not at the island that was there first.
    pub at_midpoints: bool,
    /// Whether the edges are no seams afterwards.
    pub clear_seams: bool,
}

impl Default for StitchUvs {
    fn default() -> Self {
        let StitchSettings { at_midpoints, clear_seams, .. } = StitchSettings::default();
        Self { uv_set: 0, at_midpoints, clear_seams }
    }
}

impl Action for StitchUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let kind = change.selection().kind();
        let &Self { uv_set, at_midpoints, clear_seams } = self;
        let mut count = 0;
        change.edit_selected("stitching texture coordinates", EDGES, |mesh, selection| {
            let active = (kind == ElementKind::Face).then(|| selection.order().last().copied()).flatten();
            let active = active.map(FaceId::new);
            let settings = StitchSettings { uv_set: uv_set as usize, active, at_midpoints, clear_seams };
            count += mesh.stitch_uvs(&selection.edges(mesh, kind), &settings)?.edges;
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::counted("stitched", count, ["edge", "edges"]))
    }
}

/// Moves the texture coordinates of the selected elements of each mesh, and of corners that share them, to one line.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AlignUvs {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
    /// To which line.
    pub to: UvAlignment,
}

impl Action for AlignUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (uv_set, kind) = (self.uv_set as usize, change.selection().kind());
        change.edit_selected("aligning texture coordinates", SOMETHING, |mesh, selection| {
            let corners = selected_uv_corners(mesh, selection, kind, uv_set);
            mesh.align_uvs(uv_set, &corners, self.to)?;
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::silent())
    }
}

/// Projects the texture coordinates along chains of selected edges onto the line between the ends of each, which stay.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct StraightenUvs {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
}

impl Action for StraightenUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (mut chains, mut left_out) = (0, 0);
        change.edit_selected_edges("straightening texture coordinates", EDGES, |mesh, edges| {
            let straightened = mesh.straighten_uvs(self.uv_set as usize, edges)?;
            chains += straightened.chains;
            left_out += straightened.left_out;
            Ok(())
        })?;
        let mut outcome = Outcome::counted("straightened", chains, ["chain", "chains"]);
        if left_out > 0 {
            outcome.warnings.push(format!(
                "{left_out} groups of edges are unchanged, because they are no chains with two ends: select them \
                 without branches"
            ));
        }
        Ok(outcome)
    }
}

/// Scales the islands of the selected faces about their middles, so that areas in the image are in proportion to those on
/// the surface. Islands with pins are unchanged.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AverageIslandScale {
    /// The set of texture coordinates, from 0.
    pub uv_set: u32,
}

impl Action for AverageIslandScale {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let mut count = 0;
        change.edit_selected_faces("averaging the scale of islands", FACES, |mesh, faces| {
            count += mesh.average_uv_island_scale(faces, self.uv_set as usize)?;
            Ok(())
        })?;
        Ok(Outcome::counted("scaled", count, ["island", "islands"]))
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_io::LoadOptions;
    use trigon_mesh::primitives;
    use trigon_scene::{Material, Scene};

    use crate::document::Document;
    use crate::tests::commands::{run, run_all, try_run};

    /// A grid of 4 × 2 with a seam across its middle, unwrapped.
    fn halves() -> Document {
        let mut scene = Scene::new();
        scene.add_object("object", primitives::grid(4.0, 2.0, 4, 2), Material::default());
        let mut document = Document::new(scene);
        let middle = json!({ "op": "select_within", "min": [-0.1, -1, -2], "max": [0.1, 1, 2] });
        run_all(
            &mut document,
            &[
                json!({ "op": "edit_objects", "objects": ["object"] }),
                json!({ "op": "set_element_kind", "kind": "edge" }),
                middle,
                json!({ "op": "mark_seam" }),
                json!({ "op": "set_element_kind", "kind": "face" }),
                json!({ "op": "select_all" }),
                json!({ "op": "unwrap", "margin": 0.1 }),
            ],
        );
        document
    }

    /// The bits of all coordinates of the first set, and which of them are pinned.
    fn uvs(document: &Document) -> Vec<(u32, u32, bool)> {
        let (id, _) = document.selection().meshes().next().expect("it is edited");
        let mesh = document.mesh(id).expect("it is there");
        let of = |corner| {
            let uv = mesh.uv(0, corner).expect("it is unwrapped");
            (uv.x.to_bits(), uv.y.to_bits(), mesh.is_uv_pinned(0, corner))
        };
        mesh.corners().map(of).collect()
    }

    #[test]
    fn pins_are_undone_and_saved_and_hold_what_is_unwrapped() {
        let mut document = halves();
        let free = uvs(&document);
        let pin = |document: &mut Document, pinned: bool| {
            try_run(document, json!({ "op": "pin_uvs", "pinned": pinned })).expect("selected").message
        };
        run(&mut document, json!({ "op": "select", "elements": [0, 1] }));
        assert_eq!(pin(&mut document, true), "changed 12 corners", "and those that share coordinates");
        let pinned = uvs(&document);
        run_all(&mut document, &[json!({ "op": "select_all" }), json!({ "op": "unwrap", "margin": 0.3 })]);
        for (now, before) in uvs(&document).iter().zip(&pinned).filter(|(_, before)| before.2) {
            assert_eq!(now, before, "pinned");
        }
        let packed = try_run(&mut document, json!({ "op": "pack_islands" })).expect("one is free").message;
        assert_eq!(packed, "packed 1 island");
        document.undo().expect("packed");
        document.undo().expect("unwrapped");
        assert_eq!(uvs(&document), pinned, "undone to the bit");

        let file = document.to_native().encode().expect("small").to_bytes();
        let (mut again, warnings) =
            Document::open_bytes("a.glb".as_ref(), &file, &LoadOptions::default()).expect("its own");
        run(&mut again, json!({ "op": "edit_objects", "objects": ["object"] }));
        assert_eq!((uvs(&again), warnings), (pinned, vec![]), "saved and opened");
        run_all(
            &mut again,
            &[json!({ "op": "set_element_kind", "kind": "face" }), json!({ "op": "select_all" })],
        );
        assert_eq!(pin(&mut again, false), "changed 12 corners");
        assert_eq!(uvs(&again), free, "as without pins");
    }

    #[test]
    fn halves_are_stitched_scaled_and_straightened() {
        let mut document = halves();
        let unwrapped = uvs(&document);
        for (command, message) in [
            (json!({ "op": "average_island_scale" }), "scaled 2 islands"),
            (json!({ "op": "stitch_uvs" }), "stitched 2 edges"),
            (json!({ "op": "pack_islands" }), "packed 1 island"),
            (json!({ "op": "align_uvs", "to": "y" }), ""),
        ] {
            let outcome = try_run(&mut document, command.clone()).expect("possible");
            assert_eq!(outcome.message, message, "{command}");
        }
        let heights: std::collections::BTreeSet<u32> = uvs(&document).iter().map(|uv| uv.1).collect();
        assert_eq!(heights.len(), 1, "all on one line");
        (0..4).for_each(|_| document.undo().expect("four"));
        assert_eq!(uvs(&document), unwrapped, "undone to the bit");
        let refused =
            try_run(&mut document, json!({ "op": "straighten_uvs" })).expect_err("no chain").to_string();
        assert!(refused.contains("two ends"), "{refused}");
        run(&mut document, json!({ "op": "set_element_kind", "kind": "edge" }));
        let row = json!({ "op": "select_within", "min": [-3, -1, -0.1], "max": [3, 1, 0.1] });
        run(&mut document, row);
        let straight = try_run(&mut document, json!({ "op": "straighten_uvs" })).expect("two chains").message;
        assert_eq!(straight, "straightened 2 chains", "one in each half");
    }

    /// A pin that moves takes its island along, in one step.
    #[test]
    fn what_is_moved_live_is_unwrapped_again() {
        let mut document = halves();
        run_all(
            &mut document,
            &[
                json!({ "op": "set_element_kind", "kind": "vertex" }),
                json!({ "op": "select_within", "min": [-3, -1, -2], "max": [-1.9, 1, 2] }),
                json!({ "op": "pin_uvs" }),
                json!({ "op": "select_within", "min": [-3, -1, -2], "max": [-1.9, 1, -0.9] }),
            ],
        );
        let before = uvs(&document);
        run(&mut document, json!({ "op": "translate_uvs", "offset": [0.1, 0.0] }));
        let alone = uvs(&document);
        document.undo().expect("moved");
        run(&mut document, json!({ "op": "translate_uvs", "offset": [0.1, 0.0], "live_unwrap": true }));
        let live = uvs(&document);
        let changed = |after: &[(u32, u32, bool)]| before.iter().zip(after).filter(|(a, b)| a != b).count();
        assert_eq!(changed(&alone), 1, "one corner");
        assert!((8..=16).contains(&changed(&live)), "its half follows: {}", changed(&live));
        for ((alone, live), _) in alone.iter().zip(&live).zip(&before).filter(|(_, before)| before.2) {
            assert_eq!(alone, live, "pins are where they were moved");
        }
        document.undo().expect("one step");
        assert_eq!(uvs(&document), before);
        run_all(
            &mut document,
            &[
                json!({ "op": "set_element_kind", "kind": "edge" }),
                json!({ "op": "select", "elements": [0] }),
            ],
        );
        run(&mut document, json!({ "op": "mark_seam", "live_unwrap": true }));
        document.undo().expect("one step");
        assert_eq!(uvs(&document), before);
    }
}
