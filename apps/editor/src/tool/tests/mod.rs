//! Recorded inputs on documents, with places in closed form.
//!
//! The view looks along −Z at the origin, which is drawn at (400, 300); a pixel is 1 cm wide there, x
//! points right and y up.

mod knife;
mod modelling;
mod moves;
mod properties;
mod transforms;

use trigon_document::mesh::math::{DVec2, DVec3, Vec3};
use trigon_document::mesh::primitives;
use trigon_document::modelling::EditMesh;
use trigon_document::scene::{Material, MeshId, Scene};
use trigon_document::{Command, Document};
use trigon_window::{Hands, Input, Key, Modifiers};

use super::view::tests::front;
use super::*;

/// A document, a view and two hands.
struct Session {
    document: Document,
    view: ToolView,
    hands: Hands,
}

impl Session {
    /// A cube of 2 m around the origin and a grid of 4 by 4 quads of 1 m on the plane y = 0; the
    /// pointer is at the origin.
    fn new() -> Self {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(2.0), Material::default());
        scene.add_object("grid", primitives::grid(4.0, 4.0, 4, 4), Material::default());
        let hands = Hands { pointer: Some(DVec2::new(400.0, 300.0)), modifiers: Modifiers::NONE };
        Self { document: Document::new(scene), view: front(), hands }
    }

    fn run(mut self, commands: &[&str]) -> Self {
        for json in commands {
            let command: Command =
                serde_json::from_str(json).unwrap_or_else(|error| panic!("{json}: {error}"));
            self.document.run(command).unwrap_or_else(|error| panic!("{json}: {error}"));
        }
        self
    }

    fn object(name: &str) -> Self {
        Self::new().run(&[&format!(r#"{{ "op": "select", "objects": ["{name}"] }}"#)])
    }

    /// In edit mode, with elements of a kind selected; all if none are named.
    fn editing(name: &str, kind: &str, elements: &[u32]) -> Self {
        let select = match elements {
            [] => r#"{ "op": "select_all" }"#.to_owned(),
            _ => format!(r#"{{ "op": "select", "elements": {elements:?} }}"#),
        };
        Self::object(name).run(&[
            r#"{ "op": "edit_objects" }"#,
            &format!(r#"{{ "op": "set_element_kind", "kind": "{kind}" }}"#),
            &select,
        ])
    }

    fn at(mut self, x: f64, y: f64) -> Self {
        self.hands.pointer = Some(DVec2::new(x, y));
        self
    }

    fn transform(&self, kind: TransformKind, settings: TransformSettings) -> TransformTool {
        TransformTool::start(kind, settings, &self.document, self.hands, &self.view).expect("selected")
    }

    fn input(&mut self, tool: &mut dyn Tool, input: Input) -> ToolState {
        tool.input(&input, self.hands, &self.view, &mut self.document)
    }

    fn drag(&mut self, tool: &mut dyn Tool, x: f64, y: f64) -> ToolState {
        self.hands.pointer = Some(DVec2::new(x, y));
        self.input(tool, Input::PointerMoved)
    }

    fn hold(&mut self, tool: &mut dyn Tool, modifiers: Modifiers) {
        self.hands.modifiers = modifiers;
        self.input(tool, Input::ModifiersChanged);
    }

    /// Types keys: capital letters with Shift, `>` Tab, `<` Backspace, `!` Enter, `?` Escape.
    fn keys(&mut self, tool: &mut dyn Tool, keys: &str) -> ToolState {
        let mut state = ToolState::Running;
        for character in keys.chars() {
            let key = match character {
                '>' => Key::Tab,
                '<' => Key::Backspace,
                '!' => Key::Enter,
                '?' => Key::Escape,
                ' ' => Key::Space,
                character => Key::Character(character.to_ascii_lowercase()),
            };
            let held = self.hands.modifiers;
            if character.is_ascii_uppercase() {
                self.hands.modifiers = Modifiers::SHIFT;
            }
            state = self.input(tool, Input::Key { logical: Some(key), physical: None, repeat: false });
            self.hands.modifiers = held;
        }
        state
    }

    fn mesh(&self) -> (MeshId, EditMesh) {
        let (id, _) = self.document.selection().meshes().next().expect("it is edited");
        (id, self.document.mesh(id).expect("it is edited").clone())
    }

    fn positions(&self) -> Vec<Vec3> {
        let (_, mesh) = self.mesh();
        mesh.vertices().map(|vertex| mesh.position(vertex)).collect()
    }

    fn place(&self) -> DVec3 {
        let object = self.document.selection().active.expect("one is selected");
        self.document.nodes().world_transform(object).translation
    }

    fn bytes(&self) -> Vec<u8> {
        self.document.to_native().encode().expect("it is small").to_bytes().to_vec()
    }

    /// The vertices all went as told, within the rounding of f32.
    fn moved(&self, before: &[Vec3], to: impl Fn(DVec3) -> DVec3) {
        for (from, now) in before.iter().zip(self.positions()) {
            let expected = to(from.as_dvec3());
            assert!(now.as_dvec3().distance(expected) < 1e-5, "{from} goes to {now}, not to {expected}");
        }
    }
}

fn settings() -> TransformSettings {
    TransformSettings::default()
}
