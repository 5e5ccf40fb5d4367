//! The document on the stage: its scene, its selection, and its display settings.

use trigon_document::X_RAY;
use trigon_document::scene::{Reach, Shadows, Style};
use trigon_window::Stage;
use trigon_window::scene::{Display, Lighting, Reflection};

use super::editor::Editor;
use super::images;
use super::surfaces::Surfaces;
use crate::request::DisplayMode;
use crate::show::show;

impl Editor {
    /// Shows the document as it is now.
    pub(super) fn show_document(&mut self, stage: &mut Stage) {
        let editor = self;
        editor.pointing.wait();
        let changed = show(&mut editor.document, &mut stage.scene);
        let (local, surfaces) = (&editor.view.local, Surfaces::of(editor.view.display, editor.view.solid));
        let is_same_part = editor.look.local == *local;
        let is_same = is_same_part && editor.look.surfaces == surfaces;
        let is_own = local.is_none() && surfaces == Surfaces::Own;
        if !is_same || (changed.nodes && !is_own) {
            show_partly(editor, stage, surfaces);
        }
        if changed.anything || !is_same_part {
            editor.pointing.forget();
        }
        editor.look.marks.update(&mut editor.document);
        set_look(editor, stage);
    }

    /// Whether what is hidden by faces can be seen and selected.
    pub(crate) fn reach(&self) -> Reach {
        let sees_through = self.view.x_ray || self.view.display == DisplayMode::Wireframe;
        if sees_through { Reach::Through } else { Reach::Visible }
    }
}

/// Hides what the local view leaves out, and gives surfaces the materials of the display mode. Only the
/// stage's nodes and materials are changed, which follow the document's as a whole.
fn show_partly(editor: &mut Editor, stage: &mut Stage, surfaces: Surfaces) {
    stage.scene.swap_parts(&mut editor.document.nodes().parts());
    editor.look.local.clone_from(&editor.view.local);
    editor.look.surfaces = surfaces;
    if let Some(only) = &editor.view.local {
        for (id, node) in stage.scene.nodes_mut() {
            node.visible &= node.mesh.is_none() || only.contains(&id);
        }
    }
    surfaces.dress(&mut stage.scene);
}

/// The shadows of the document's lights in the view. The studio's lights move with the camera, and have none.
const SHADOWS: Shadows = Shadows::Maps { resolution: 2048 };

/// Style, lights and marks of the mode that the editor is in.
fn set_look(editor: &Editor, stage: &mut Stage) {
    let is_editing = editor.document.selection().is_editing();
    let display = editor.view.display;
    let settings = &mut stage.settings;
    settings.style = match display {
        DisplayMode::Wireframe => Style::Wireframe,
        _ if editor.view.x_ray => Style::SurfaceWithEdges,
        _ => Style::Surface,
    };
    settings.display = if display == DisplayMode::Matcap { Display::Matcap } else { Display::Shaded };
    settings.lighting = if display == DisplayMode::Rendered { Lighting::Automatic } else { Lighting::Studio };
    let has_shadows = display == DisplayMode::Rendered && images::has_lamps(editor.document.nodes());
    settings.effects.shadows = if has_shadows { SHADOWS } else { Shadows::Off };
    settings.reflection =
        if display == DisplayMode::Solid { Reflection::Lambert } else { Reflection::Material };
    editor.look.marks.apply(settings, editor.reach());
    if editor.view.x_ray && !is_editing {
        settings.x_ray = X_RAY;
    }
}
