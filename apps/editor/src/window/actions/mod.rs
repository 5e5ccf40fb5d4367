//! Every user action, in one table: menus, keys, the command search and the key list are all generated from
//! it, so that they always agree.

mod table;

use trigon_document::Document;

use crate::icon::Icon;
use crate::request::{FileAction, FileRequest, Request, ToolKind, UiRequest, ViewRequest};

/// The menus of the bar, in their order. Others are opened by keys.
pub(crate) const MENUS: [&str; 8] = ["File", "Edit", "Add", "Select", "Mesh", "UV", "View", "Help"];

/// One row of the table.
#[derive(Debug)]
pub(crate) struct Action {
    /// In the keymap file, as `edit.undo`.
    pub(crate) name: &'static str,
    /// The menu, as `Mesh`, or a menu within it, as `Mesh/Delete`.
    pub(crate) menu: &'static str,
    /// In menus.
    pub(crate) label: &'static str,
    /// The chords that it has unless a user says otherwise, with spaces between them.
    pub(crate) keys: &'static str,
    pub(crate) needs: Needs,
    pub(crate) does: Does,
    /// A sentence for tool tips and the help sheet.
    pub(crate) help: &'static str,
}

/// What an action does.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Does {
    /// Runs the command of this JSON.
    Run(&'static str),
    Tool(ToolKind),
    View(ViewRequest),
    File(FileAction),
    Ui(UiRequest),
    Undo,
    Redo,
    RepeatLast,
}

/// What has to be so before an action can run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Needs {
    Nothing,
    ObjectMode,
    /// Object mode, and something selected.
    Objects,
    TwoObjects,
    EditMode,
    /// Edit mode, or a mesh among what is selected.
    Meshes,
    /// Edit mode, and something selected.
    Elements,
    /// Something selected, in either mode.
    Selected,
    SomethingDone,
    SomethingUndone,
    SomethingToRepeat,
}

/// Makes a table of actions: menu, name, label, keys, needs, what it does => help.
macro_rules! actions {
    ($($menu:literal $name:literal $label:literal $keys:literal $needs:ident $does:expr => $help:literal;)*) => {
        pub(super) const ACTIONS: &[Action] = &[$(Action {
            name: $name,
            menu: $menu,
            label: $label,
            keys: $keys,
            needs: Needs::$needs,
            does: $does,
            help: $help,
        }),*];
    };
}
use actions;

/// All actions, menu by menu.
pub(crate) fn all() -> impl Iterator<Item = &'static Action> {
    table::ACTIONS.iter()
}

/// The action of this name.
pub(crate) fn named(name: &str) -> Option<&'static Action> {
    all().find(|action| action.name == name)
}

/// The tools of the bar on the left, by the names of their actions.
const TOOLS: [(&str, Icon); 14] = [
    ("select.box", Icon::SelectBox),
    ("select.circle", Icon::SelectCircle),
    ("select.lasso", Icon::SelectLasso),
    ("tool.move", Icon::Move),
    ("tool.rotate", Icon::Rotate),
    ("tool.scale", Icon::Scale),
    ("mesh.extrude", Icon::Extrude),
    ("mesh.inset", Icon::Inset),
    ("mesh.bevel", Icon::Bevel),
    ("mesh.loop_cut", Icon::LoopCut),
    ("mesh.knife", Icon::Knife),
    ("mesh.edge_slide", Icon::Slide),
    ("tool.shrink_fatten", Icon::ShrinkFatten),
    ("view.measure", Icon::Measure),
];

/// A tool that has a button.
pub(crate) struct ToolButton {
    pub(crate) action: &'static Action,
    pub(crate) icon: Icon,
}

/// The menu of a click with the right button.
pub(crate) const CONTEXT_MENU: &str = "Context";

/// What that menu offers, of both modes.
const CONTEXT: [&str; 21] = [
    "edit.mode",
    "tool.move",
    "tool.rotate",
    "tool.scale",
    "edit.duplicate",
    "edit.rename",
    "edit.join",
    "face.smooth",
    "face.flat",
    "edit.hide",
    "edit.delete",
    "mesh.extrude",
    "mesh.inset",
    "mesh.bevel",
    "mesh.loop_cut",
    "mesh.subdivide",
    "mesh.fill",
    "mesh.bridge",
    "merge.menu",
    "mesh.duplicate",
    "delete.menu",
];

/// What menus at the pointer offer beside their own entries.
const ALSO: [(&str, &[&str]); 3] = [
    (
        "Mesh/Vertex",
        &[
            "mesh.connect",
            "mesh.fill",
            "mesh.bevel_vertices",
            "mesh.edge_slide",
            "merge.menu",
            "mesh.reset_vertices",
        ],
    ),
    (
        "Mesh/Edge",
        &["mesh.bevel", "mesh.loop_cut", "mesh.subdivide", "mesh.bridge", "mesh.edge_slide", "mesh.fill"],
    ),
    (
        "Mesh/Face",
        &[
            "mesh.extrude",
            "extrude.along_normals",
            "mesh.extrude_individual",
            "mesh.inset",
            "mesh.fill",
            "mesh.grid_fill",
            "mesh.triangulate",
            "mesh.tris_to_quads",
        ],
    ),
];

/// The entries that the menu at the pointer lists first; they are in the bar's menus, too.
pub(crate) fn also_in(menu: &str) -> impl Iterator<Item = &'static Action> {
    let names = ALSO.iter().find(|(name, _)| *name == menu).map_or(&[][..], |(_, names)| names);
    names.iter().filter_map(|name| named(name))
}

/// What is often done with what is selected, in this mode.
pub(crate) fn context(is_editing: bool) -> impl Iterator<Item = &'static Action> {
    CONTEXT.iter().filter_map(|name| named(name)).filter(move |action| action.fits_mode(is_editing))
}

/// The tools that have a button, of both modes.
pub(crate) fn tools() -> impl Iterator<Item = ToolButton> {
    TOOLS.iter().filter_map(|&(name, icon)| named(name).map(|action| ToolButton { action, icon }))
}

impl Action {
    /// The request that choosing it sends to the editor.
    pub(crate) fn request(&self) -> Request {
        match self.does {
            Does::Run(json) => {
                Request::Run(serde_json::from_str(json).expect("a test reads the commands of the table"))
            }
            Does::Tool(tool) => Request::StartTool(tool),
            Does::View(view) => Request::View(view),
            Does::File(file) => Request::File(FileRequest::Ask(file)),
            Does::Ui(ui) => Request::Ui(ui),
            Does::Undo => Request::Undo,
            Does::Redo => Request::Redo,
            Does::RepeatLast => Request::RepeatLast,
        }
    }

    /// Whether it starts this tool.
    pub(crate) fn starts(&self, tool: ToolKind) -> bool {
        matches!(self.does, Does::Tool(own) if own == tool)
    }

    /// Why it cannot run now; `None` if it can.
    pub(crate) fn refusal(&self, document: &Document) -> Option<&'static str> {
        let is_editing = document.selection().is_editing();
        match self.needs {
            Needs::Objects | Needs::TwoObjects | Needs::ObjectMode if is_editing => {
                return Some("works on whole objects: leave edit mode first (Tab)");
            }
            Needs::EditMode | Needs::Elements if !is_editing => {
                return Some(
                    "works on the elements of a mesh: select an object and enter edit mode first (Tab)",
                );
            }
            _ => {}
        }
        let is_met = self.needs.are_met(document);
        (!is_met).then(|| self.needs.remedy(is_editing))
    }

    /// Whether it opens a menu at the pointer, which a menu has no use for.
    pub(crate) fn opens_menu(&self) -> bool {
        matches!(self.does, Does::Ui(UiRequest::Popup(_)))
    }

    /// Whether what it makes lies on what was there, so that it is moved next.
    pub(crate) fn makes_copies(&self) -> bool {
        ["edit.duplicate", "edit.duplicate_linked", "mesh.duplicate", "mesh.extend_vertices"]
            .contains(&self.name)
    }

    /// Whether it is an action of the mode that the document is in.
    pub(crate) fn fits_mode(&self, is_editing: bool) -> bool {
        match self.needs {
            Needs::Objects | Needs::TwoObjects | Needs::ObjectMode => !is_editing,
            Needs::EditMode | Needs::Elements => is_editing,
            _ => true,
        }
    }
}

impl Needs {
    fn are_met(self, document: &Document) -> bool {
        let (selection, history) = (document.selection(), document.history());
        let elements = || selection.meshes().any(|(_, elements)| !elements.is_empty());
        match self {
            Self::Nothing | Self::ObjectMode | Self::EditMode => true,
            Self::Objects => !selection.objects.is_empty(),
            Self::TwoObjects => selection.objects.len() > 1,
            Self::Elements => elements(),
            Self::Selected if selection.is_editing() => elements(),
            Self::Meshes => selection.is_editing() || selects_mesh(document),
            Self::Selected => !selection.objects.is_empty(),
            Self::SomethingDone => !history.done().is_empty(),
            Self::SomethingUndone => !history.undone().is_empty(),
            Self::SomethingToRepeat => history.done().iter().any(|entry| !entry.command().is_selection()),
        }
    }

    /// Why it cannot be, and what to do about it.
    fn remedy(self, is_editing: bool) -> &'static str {
        match self {
            Self::TwoObjects => "needs two objects: click one, then Shift+click another",
            Self::Elements => "needs something selected: click a vertex, an edge or a face first",
            Self::Selected if is_editing => {
                "needs something selected: click a vertex, an edge or a face first"
            }
            Self::Meshes => "needs an object with a mesh: click one first",
            Self::Objects | Self::Selected => "needs an object: click one first",
            Self::SomethingDone => "there is nothing to undo",
            Self::SomethingUndone => "there is nothing to redo",
            Self::SomethingToRepeat => "there is nothing to repeat yet",
            Self::Nothing | Self::ObjectMode | Self::EditMode => "",
        }
    }
}

fn selects_mesh(document: &Document) -> bool {
    let has_mesh = |id| document.nodes().node(id).is_some_and(|node| node.mesh.is_some());
    document.selection().objects.iter().any(|&id| has_mesh(id))
}

#[cfg(test)]
mod tests;
