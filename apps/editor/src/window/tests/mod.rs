//! The window's interface by labels and keys, drawn by the window's own painter.

mod camera_view;
mod first_hour;
mod four_views;
mod images;
mod keys;
mod knife;
mod rows;
mod saving;
mod selections;
mod sessions;
mod tools;
mod up;
mod uv;

use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use trigon_window::egui::{Key, Modifiers as Held};
use trigon_window::{EguiTestRenderer, Handler, Hands, Input, Key as WindowKey, Modifiers, Stage, Taken};

use super::editor::{Editor, Message, WELCOME};
use super::keys::Keys;
use super::{interface, settings};
use crate::request::Request;

/// An editor with its stage, as a test works it.
struct Worked {
    editor: Editor,
    stage: Stage,
}

impl Worked {
    fn new() -> Self {
        let mut stage = Stage::new("test");
        settings::prepare(&mut stage);
        let mut editor = Editor::new(Keys::default(), None, Vec::new());
        editor.start(&mut stage);
        Self { editor, stage }
    }

    fn key(&mut self, key: WindowKey, modifiers: Modifiers) -> Taken {
        let input = Input::Key { logical: Some(key), physical: None, repeat: false };
        self.editor.input(&mut self.stage, &input, Hands { pointer: None, modifiers })
    }

    fn character(&mut self, key: char) {
        assert_eq!(self.key(WindowKey::Character(key), Modifiers::NONE), Taken::Yes, "{key} does something");
    }

    fn objects(&self) -> usize {
        self.editor.document.nodes().nodes().len()
    }

    /// Of the meshes on the stage.
    fn faces(&self) -> usize {
        self.stage.scene.meshes().iter().map(|(_, asset)| asset.mesh().face_count()).sum()
    }

    fn refusal(&self) -> &str {
        match &self.editor.message {
            Message::Refusal(text) => text,
            Message::Hint(text) | Message::Info(text) => panic!("done: {text}"),
        }
    }
}

/// Waits for the load that is under way.
fn finish_load(editor: &mut Editor, stage: &mut Stage) {
    let loading = editor.loading.take().expect("it was begun");
    editor.loaded(stage, &loading.path, loading.version, loading.wait());
}

/// Waits for the save that is under way.
fn finish_save(editor: &mut Editor, stage: &mut Stage) {
    let outcome = editor.saving.as_ref().expect("it was begun").wait();
    editor.saved(stage, outcome);
}

fn harness() -> Harness<'static, Worked> {
    Harness::builder().with_size([1280.0, 800.0]).renderer(EguiTestRenderer::default()).build_ui_state(
        |ui, worked: &mut Worked| {
            for request in interface::show(&mut worked.editor, &mut worked.stage, ui) {
                worked.editor.perform(&mut worked.stage, request);
            }
        },
        Worked::new(),
    )
}

#[test]
fn a_first_start_shows_a_cube_and_how_to_begin() {
    let worked = Worked::new();
    let names: Vec<_> = worked.stage.scene.nodes().iter().map(|(_, node)| node.name.clone()).collect();
    assert_eq!(names, ["Cube", "Light"], "on the stage");
    assert_eq!(worked.stage.title(), "untitled - trigon", "nothing is unsaved");
    let harness = harness();
    harness.get_by_label(WELCOME);
}

#[test]
fn menus_run_actions_and_undo_takes_them_back() {
    let mut harness = harness();
    // The tab of this name comes after the menu.
    harness.get_all_by_label("Add").next().expect("the menu").click();
    harness.run();
    harness.get_by_label("Torus").click();
    harness.run();
    assert_eq!(harness.state().objects(), 3, "the torus is there");
    assert_eq!(harness.state().stage.title(), "*untitled - trigon", "and not saved");
    harness.get_by_label("Edit").click();
    harness.run();
    harness.get_by_label("Undo").click();
    harness.run();
    assert_eq!(harness.state().objects(), 2, "it is gone");
    assert_eq!(harness.state().stage.title(), "untitled - trigon", "and so is the mark");
}

#[test]
fn the_search_finds_a_command_by_its_name_and_enter_runs_it() {
    let mut harness = harness();
    harness.state_mut().key(WindowKey::Function(3), Modifiers::NONE);
    harness.run();
    let field = harness.get_by_label("name of a command");
    field.focus();
    field.type_text("teapot");
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(harness.state().objects(), 3, "a teapot");
    assert!(harness.state().editor.search.is_none(), "the search is over");
    harness.state_mut().key(WindowKey::Function(3), Modifiers::NONE);
    harness.run();
    harness.key_press_modifiers(Held::NONE, Key::Escape);
    harness.run();
    assert!(harness.state().editor.search.is_none(), "Escape closes it");
}

#[test]
fn keys_go_through_the_modes() {
    let mut worked = Worked::new();
    worked.character('i');
    assert!(worked.refusal().contains("Tab"), "{}", worked.refusal());
    worked.key(WindowKey::Character('a'), Modifiers::ALT);
    assert_eq!(worked.key(WindowKey::Tab, Modifiers::NONE), Taken::Yes, "Tab is the editor's");
    assert!(worked.editor.document.selection().is_editing(), "edit mode");
    worked.character('3');
    worked.character('a');
    worked.key(WindowKey::Character('t'), Modifiers::CTRL);
    assert_eq!(worked.faces(), 12, "Ctrl+T cuts six squares");
    worked.key(WindowKey::Character('z'), Modifiers::CTRL);
    assert_eq!(worked.faces(), 6, "and Ctrl+Z is undo");
    worked.key(WindowKey::Character('z'), Modifiers::CTRL | Modifiers::SHIFT);
    worked.key(WindowKey::Tab, Modifiers::NONE);
    assert!(!worked.editor.document.selection().is_editing(), "object mode again");
}

#[test]
fn closing_with_changes_asks_first() {
    let mut harness = harness();
    harness.state_mut().character('a');
    harness.state_mut().key(WindowKey::Character('d'), Modifiers::SHIFT);
    assert_eq!(harness.state().objects(), 4, "both are copied");
    let Worked { editor, stage } = harness.state_mut();
    editor.close_requested(stage);
    harness.run();
    harness.get_by_label("Save");
    harness.get_by_label("Discard");
    harness.get_by_label("Cancel").click();
    harness.run();
    assert!(harness.state().editor.question.is_none(), "nothing happens");
    assert_eq!(harness.state().objects(), 4, "all is there");
}

#[test]
fn a_document_is_saved_and_opened_again() {
    use crate::request::FileRequest;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("chair");
    let mut worked = Worked::new();
    worked.character('a');
    worked.key(WindowKey::Character('d'), Modifiers::SHIFT);
    let Worked { editor, stage } = &mut worked;
    editor.perform(stage, Request::File(FileRequest::SaveAs(path.clone())));
    finish_save(editor, stage);
    assert_eq!(stage.title(), "chair.glb - trigon", "saved: {:?}", editor.message);
    editor.perform(stage, Request::File(FileRequest::Ask(crate::request::FileAction::New)));
    assert_eq!(editor.document.nodes().nodes().len(), 2, "another document");
    editor.perform(stage, Request::File(FileRequest::Open(path.with_extension("glb"))));
    finish_load(editor, stage);
    assert_eq!(editor.document.nodes().nodes().len(), 4, "again: {:?}", editor.message);
    assert!(!editor.file.is_unsaved(), "as it was saved");
    editor.loaded(stage, &path, None, Err("it is broken".into()));
    assert_eq!(worked.objects(), 4, "a load that fails leaves the document");
    assert_eq!(worked.refusal(), "it is broken", "and says why");
}

/// Such a file has nothing to be drawn.
#[test]
fn what_has_no_mesh_is_saved_and_opened_again_and_another_file_imported() {
    use crate::request::FileRequest;
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("light.glb");
    let mut worked = Worked::new();
    worked.character('x');
    let Worked { editor, stage } = &mut worked;
    editor.perform(stage, Request::File(FileRequest::SaveAs(path.clone())));
    finish_save(editor, stage);
    assert_eq!(stage.title(), "light.glb - trigon", "saved: {:?}", editor.message);
    editor.perform(stage, Request::File(FileRequest::Open(path.clone())));
    finish_load(editor, stage);
    assert_eq!(editor.document.nodes().nodes().len(), 1, "the light: {:?}", editor.message);
    let square = folder.path().join("square.obj");
    std::fs::write(&square, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").expect("written");
    editor.perform(stage, Request::File(FileRequest::Import(square)));
    finish_load(editor, stage);
    assert_eq!(worked.objects(), 2, "the square, too");
    let Worked { editor, stage } = &mut worked;
    let exported = folder.path().join("both.stl");
    editor.perform(stage, Request::File(FileRequest::Export(exported.clone())));
    assert!(exported.exists(), "by its ending: {:?}", editor.message);
}

#[test]
fn a_menu_at_the_pointer_is_worked_by_keys() {
    let mut harness = harness();
    harness.state_mut().key(WindowKey::Character('a'), Modifiers::SHIFT);
    harness.run();
    harness.key_press(Key::ArrowDown);
    harness.run();
    harness.key_press(Key::Enter);
    harness.run();
    let names: Vec<_> =
        harness.state().stage.scene.nodes().iter().map(|(_, node)| node.name.clone()).collect();
    assert_eq!(names, ["Cube", "Light", "Cube.001"], "the second entry of Add");
    assert!(harness.state().editor.popup.is_none(), "and the menu is gone");
    harness.state_mut().key(WindowKey::Character('a'), Modifiers::SHIFT);
    harness.run();
    harness.key_press(Key::Escape);
    harness.run();
    assert!(harness.state().editor.popup.is_none(), "Escape closes it");
    assert_eq!(harness.state().objects(), 3, "and adds nothing");
}

#[test]
fn an_entry_that_cannot_run_is_grey_and_says_why() {
    let mut harness = harness();
    harness.get_by_label("Mesh").click();
    harness.run();
    let inset = harness.get_by_label("Inset Faces");
    assert!(inset.accesskit_node().is_disabled(), "no mesh is edited");
    inset.hover();
    harness.run();
    harness.get_by_label_contains("enter edit mode first (Tab)");
}
