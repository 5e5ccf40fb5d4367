//! The scene as a tree: what is hidden, shown, selected and looked at.

use trigon_scene::{Node, NodeId};
use trigon_window::{Stage, egui};

/// How far children are moved to the right, in points.
const INDENT: f32 = 12.0;

/// Deeper than that, rows are not moved farther, so that names stay in view.
const DEEPEST: usize = 8;

/// The tree, and what it is searched for.
#[derive(Default)]
pub(super) struct TreePanel {
    search: String,
}

/// What was done to a row.
enum Done {
    Toggled,
    Selected,
    LookedAt,
}

impl TreePanel {
    pub(super) fn show(&mut self, ui: &mut egui::Ui, stage: &mut Stage, beside: &[NodeId]) {
        let field = egui::TextEdit::singleline(&mut self.search).hint_text("Search");
        ui.add(field.desired_width(f32::INFINITY)).accessible_name("Search the scene");
        let search = self.search.trim().to_lowercase();
        let is_found = |id: NodeId| {
            let name = stage.scene.node(id).map_or("", |node| node.name.as_str());
            !beside.contains(&id) && (search.is_empty() || name.to_lowercase().contains(&search))
        };
        let rows: Vec<(NodeId, usize)> =
            stage.scene.tree().into_iter().filter(|&(id, _)| is_found(id)).collect();
        if rows.is_empty() {
            ui.label(if search.is_empty() { "The scene is empty." } else { "No node has such a name." });
        }
        let height = ui.spacing().interact_size.y;
        let mut done = None;
        // However many there are, only those in view are laid out.
        egui::ScrollArea::vertical().auto_shrink(false).show_rows(ui, height, rows.len(), |ui, range| {
            for &(id, depth) in &rows[range] {
                if let Some(what) = ui.push_id(id, |ui| row(ui, stage, id, depth)).inner {
                    done = Some((id, what));
                }
            }
        });
        if let Some((id, what)) = done {
            apply(stage, id, &what);
        }
    }
}

fn apply(stage: &mut Stage, id: NodeId, done: &Done) {
    match done {
        Done::Toggled => {
            if let Some(node) = stage.scene.node_mut(id) {
                node.visible = !node.visible;
            }
        }
        Done::Selected => stage.selection = Some(id),
        Done::LookedAt => {
            stage.selection = Some(id);
            let points: Vec<_> = stage.scene.visible_points_below(id).collect();
            if !points.is_empty() {
                stage.fit_points(&points);
            }
        }
    }
}

/// An eye, the name, and what the node holds.
fn row(ui: &mut egui::Ui, stage: &Stage, id: NodeId, depth: usize) -> Option<Done> {
    let node = stage.scene.node(id)?;
    let mut done = None;
    ui.horizontal(|ui| {
        let mut is_visible = node.visible;
        let what = if is_visible { "Hide" } else { "Show" };
        let eye = ui.checkbox(&mut is_visible, "").on_hover_text(what);
        if eye.accessible_name(format!("{what} {}", name(node))).changed() {
            done = Some(Done::Toggled);
        }
        ui.add_space(INDENT * depth.min(DEEPEST) as f32);
        let is_hidden = !node.visible
            || stage
                .scene
                .ancestors(id)
                .any(|above| stage.scene.node(above).is_some_and(|node| !node.visible));
        let text = egui::RichText::new(format!("{}{}", name(node), kind(node)));
        let text = if is_hidden { text.weak() } else { text };
        let button = egui::Button::selectable(stage.selection == Some(id), text).truncate();
        let response = ui.add(button).on_hover_text("Click: select. Double click: look at.");
        let response = response.accessible_name(name(node));
        if response.double_clicked() {
            done = Some(Done::LookedAt);
        } else if response.clicked() {
            done = Some(Done::Selected);
        }
    });
    done
}

fn name(node: &Node) -> &str {
    if node.name.is_empty() { "(no name)" } else { &node.name }
}

/// What is no mesh and no mere group says what it is.
fn kind(node: &Node) -> &'static str {
    match node {
        Node { light: Some(_), .. } => " (light)",
        Node { camera: Some(_), .. } => " (camera)",
        _ => "",
    }
}
