//! Recorded sessions: whole models made by mouse and keyboard alone, in a window without a display. A session is a
//! text with one action in each line, as `script` describes; what it asserts is what its user would see.

mod bottle;
mod bracket;
mod chair;
mod crate_box;
mod elements;
mod habits;
mod house;
mod light;
mod mug;
mod newcomer;
mod script;
mod slats;
mod spring;
mod table;
mod tour;

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use trigon_document::Document;
use trigon_document::modelling::EditMesh;
use trigon_window::scene::Frame;
use trigon_window::scene::camera::Viewport;
use trigon_window::{
    AnimationState, Handler, Hands, HeadlessWindow, Input, Modifiers, Stage, Taken, Tick, egui,
};

use crate::window::editor::Editor;
use crate::window::keys::Keys;
use crate::window::settings;

pub(super) const SIZE: Viewport = Viewport { width: 1280, height: 800 };

/// The window's editor, at which a test looks meanwhile.
struct Watched(Rc<RefCell<Editor>>);

impl Handler for Watched {
    fn start(&mut self, stage: &mut Stage) {
        self.0.borrow_mut().start(stage);
    }

    fn frame(&mut self, stage: &mut Stage, tick: Tick) -> AnimationState {
        self.0.borrow_mut().frame(stage, tick)
    }

    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        self.0.borrow_mut().input(stage, input, hands)
    }

    fn command(&mut self, stage: &mut Stage, name: &str) {
        self.0.borrow_mut().command(stage, name);
    }

    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        self.0.borrow_mut().interface(stage, ui);
    }

    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, modifiers: Modifiers) {
        self.0.borrow_mut().dropped(stage, paths, modifiers);
    }

    fn close_requested(&mut self, stage: &mut Stage) {
        self.0.borrow_mut().close_requested(stage);
    }

    fn image(&mut self, stage: &mut Stage, frame: Frame) {
        self.0.borrow_mut().image(stage, frame);
    }

    fn woken(&mut self, stage: &mut Stage) {
        self.0.borrow_mut().woken(stage);
    }
}

/// Somebody at the editor.
pub(super) struct User<'a> {
    pub(super) window: HeadlessWindow<'a>,
    pub(super) editor: Rc<RefCell<Editor>>,
    /// What `$FOLDER` in a script is.
    folder: &'a Path,
    /// Where the images of a script go, if they are wanted.
    images: Option<PathBuf>,
}

/// Opens the editor with these files in a window of a size, and lets somebody work.
pub(super) fn at_the_editor(
    folder: &Path,
    files: &[PathBuf],
    size: Viewport,
    work: impl FnOnce(&mut User<'_>),
) {
    let mut stage = Stage::new("test");
    settings::prepare(&mut stage);
    // The images' edges are not what is tested.
    stage.settings.samples_per_axis = 1;
    // Whoever works here has answered the question of the first start.
    let state = folder.join("state");
    std::fs::create_dir_all(&state).expect("made");
    std::fs::write(state.join("editor.json"), r#"{ "up": "Y" }"#).expect("written");
    let editor = Editor::new(Keys::default(), Some(state), files.to_vec());
    let editor = Rc::new(RefCell::new(editor));
    let mut handler = Watched(Rc::clone(&editor));
    let window = HeadlessWindow::open(stage, &mut handler, size);
    work(&mut User { window, editor, folder, images: None });
}

/// Does what a script says, which may use the image `$FOLDER/wood.png`, and ends with the document saved as `$FOLDER/saved.glb`, and opens that in another
/// editor: it is the same to the last byte.
fn saved_and_reopened(script: &str, finished: impl Fn(&Document, &Path)) {
    let folder = tempfile::tempdir().expect("a folder");
    let wood: Vec<u8> = (0..64).flat_map(|pixel| [150 + pixel % 8 * 10, 100, 60]).collect();
    trigon_io::write_png(folder.path().join("wood.png"), 8, 8, trigon_io::Pixels::Rgb8(&wood))
        .expect("written");
    let mut before = Vec::new();
    at_the_editor(folder.path(), &[], SIZE, |user| {
        user.play(script);
        finished(&user.editor.borrow().document, folder.path());
        before = user.bytes();
    });
    at_the_editor(folder.path(), &[folder.path().join("saved.glb")], SIZE, |user| {
        user.wait_for_title("saved.glb - trigon");
        finished(&user.editor.borrow().document, folder.path());
        assert!(user.bytes() == before, "what was saved is what was opened");
    });
}

/// What leaves an empty document with the same cube in it: everything is deleted, and the cube is added by the menu.
const FROM_NOTHING: &str = "
    keys A X
    objects 0
    see The scene is empty.
    keys Shift+A
    type cube                                       # searches the menu
    keys Enter
    objects 1
";

/// Plays a script that begins with the default cube, once from there and once from an empty document; see
/// [`saved_and_reopened`].
fn from_the_cube_and_from_nothing(script: &str, finished: impl Fn(&Document, &Path)) {
    for start in ["", FROM_NOTHING] {
        saved_and_reopened(&format!("{start}{script}"), &finished);
    }
}

impl User<'_> {
    /// Lets other threads do what they are at until no image is rendered or written any more.
    fn wait_for_images(&mut self) {
        loop {
            let editor = self.editor.borrow();
            if editor.images.rendering.is_none() && editor.images.under_way().is_none() {
                return;
            }
            drop(editor);
            self.window.wait();
        }
    }

    /// All that a file holds of the document.
    fn bytes(&self) -> Vec<u8> {
        self.editor.borrow().document.to_native().encode().expect("it is small").to_bytes().to_vec()
    }

    /// Lets other threads do what they are at until the window is called so.
    fn wait_for_title(&mut self, title: &str) {
        while self.window.stage().title() != title {
            let editor = self.editor.borrow();
            let is_waiting = editor.loading.is_some() || editor.saving.is_some();
            assert!(is_waiting, "{:?} instead: {:?}", self.window.stage().title(), editor.message);
            drop(editor);
            self.window.wait();
        }
    }
}

/// The mesh of the object of this name.
fn mesh<'a>(document: &'a Document, name: &str) -> &'a EditMesh {
    let nodes = document.nodes().nodes();
    let (_, node) = nodes.iter().find(|(_, node)| node.name == name).expect("an object of this name");
    document.mesh(node.mesh.expect("it has a mesh")).expect("the mesh is there")
}

/// By the divergence theorem over fans of the faces, in cubic metres: the mesh is closed, its faces look
/// outwards, and each is flat and seen whole from its first corner or its volume does not depend on the fan.
fn volume(mesh: &EditMesh) -> f64 {
    let mut volume = 0.0;
    for face in mesh.faces() {
        let corners: Vec<_> =
            mesh.face_vertices(face).map(|vertex| mesh.position(vertex).as_dvec3()).collect();
        volume += corners.windows(2).skip(1).map(|pair| corners[0].dot(pair[0].cross(pair[1]))).sum::<f64>();
    }
    volume / 6.0
}

/// Vertices minus edges plus faces.
fn euler(mesh: &EditMesh) -> i64 {
    mesh.vertex_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

/// Edges that do not have exactly two faces.
fn open_edges(mesh: &EditMesh) -> usize {
    mesh.edges().filter(|edge| mesh.edge_faces(*edge).count() != 2).count()
}
