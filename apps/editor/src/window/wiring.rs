//! Where the parts that are made elsewhere come in: panels on the right, the panel of the last operation,
//! tools that follow the pointer.

use trigon_edit::{Bevel, Command, Document, Extrude, Inset, LoopCut, ObjectName, Select, SelectAction};
use trigon_window::egui::{self, Ui};

use crate::request::{Request, ToolKind};

/// What panels remember.
#[derive(Debug, Default)]
pub(crate) struct Panels {}

/// The upper right: all objects.
pub(crate) fn outliner(ui: &mut Ui, document: &Document, _: &mut Panels, requests: &mut Vec<Request>) {
    let (scene, selection) = (document.nodes(), document.selection());
    for (id, node) in scene.nodes().iter() {
        let name = if node.name.is_empty() { "(no name)" } else { node.name.as_str() };
        let is_selected = selection.objects.contains(&id);
        if ui.selectable_label(is_selected, name).clicked() && !selection.is_editing() {
            let add = ui.input(|input| input.modifiers.shift);
            let action = if add { SelectAction::Toggle } else { SelectAction::Replace };
            let objects = vec![ObjectName::of(id)];
            requests.push(Request::Run(Select { objects, elements: Vec::new(), action }.into()));
        }
    }
}

/// The lower right: tabs.
pub(crate) fn tabs(ui: &mut Ui, document: &Document, _: &mut Panels, _: &mut Vec<Request>) {
    let scene = document.nodes();
    let selection = document.selection();
    let elements: usize = selection.meshes().map(|(_, elements)| elements.len()).sum();
    egui::Grid::new("information").num_columns(2).show(ui, |ui| {
        let rows = [
            ("Objects", scene.nodes().len()),
            ("Selected", if selection.is_editing() { elements } else { selection.objects.len() }),
        ];
        for (name, count) in rows {
            ui.label(name);
            ui.label(count.to_string());
            ui.end_row();
        }
    });
}

/// What is done at once where a tool cannot follow the pointer yet; its values can be adjusted.
pub(crate) fn without_tool(tool: ToolKind) -> Option<Command> {
    Some(match tool {
        ToolKind::Extrude => Extrude { distance: 0.5, ..Extrude::default() }.into(),
        ToolKind::ExtrudeIndividual => {
            Extrude { distance: 0.5, individual: true, ..Extrude::default() }.into()
        }
        ToolKind::Inset => Inset { thickness: 0.2, ..Inset::default() }.into(),
        ToolKind::Bevel => Bevel::default().into(),
        ToolKind::BevelVertices => Bevel { vertices: true, ..Bevel::default() }.into(),
        ToolKind::LoopCut => LoopCut::default().into(),
        _ => return None,
    })
}
