//! What the window's own keys do, except keys that act while they are held.

use trigon_camera::OrbitStyle;
use trigon_scene::{NodeId, Style};

use crate::keymap::Action;
use crate::stage::{Stage, Visibility};

impl Stage {
    /// Does what a key with this action does, at once. Nothing comes of actions that go on while a key is
    /// down, of the application's own, and of giving the keyboard to the interface.
    pub fn act(&mut self, action: Action) {
        act(self, action);
    }
}

/// Does it. Held keys and the application's commands are not for this function.
pub(crate) fn act(stage: &mut Stage, action: Action) {
    match action {
        Action::View(view) => {
            stage.orbit.set_view(view);
            stage.fit_view();
        }
        Action::Elevate(angle) => stage.orbit.orbit(0.0, angle),
        Action::Roll(angle) => stage.orbit.roll(angle),
        Action::ResetView => stage.reset_view(),
        Action::ToggleOrthographic => stage.orbit.toggle_orthographic(),
        Action::ToggleOrbitStyle => toggle_orbit_style(stage),
        Action::ToggleEdges => toggle_edges(stage),
        Action::CycleWireframe => cycle_wireframe(stage),
        Action::CycleSamples => cycle_samples(stage),
        Action::ToggleCheatSheet => toggle_cheat_sheet(stage),
        Action::OpenMenu => stage.open_menu(None),
        Action::UndoMove => undo(stage),
        Action::RedoMove => redo(stage),
        Action::ToggleFullScreen => stage.full_screen = !stage.full_screen,
        Action::ToggleFrameTime => stage.frame_time = stage.frame_time.toggled(),
        Action::SelectNext => select(stage, Direction::Forward),
        Action::SelectPrevious => select(stage, Direction::Backward),
        Action::LookAtSelected => look_at_selected(stage),
        Action::Dismiss if stage.cheat_sheet == Visibility::Shown => stage.cheat_sheet = Visibility::Hidden,
        Action::Dismiss if stage.selection.is_none() => stage.full_screen = false,
        Action::Dismiss => stage.selection = None,
        Action::Quit => stage.exit(),
        Action::ScaleText(factor) => stage.text_scale = (stage.text_scale * factor).clamp(0.5, 4.0),
        Action::EnterInterface | Action::Hold(_) | Action::Command => {}
    }
}

/// Tells which object was selected.
pub(crate) fn announce_selection(stage: &mut Stage) {
    let Some(node) = stage.selection.and_then(|id| stage.scene.node(id)) else { return };
    let name = if node.name.is_empty() { "an unnamed object" } else { node.name.as_str() };
    let text = format!("Selected: {name}");
    stage.overlay.notify(text);
}

#[derive(Debug, Clone, Copy)]
enum Direction {
    Forward,
    Backward,
}

/// Selects the next visible object, in the order of their indices.
fn select(stage: &mut Stage, direction: Direction) {
    let nodes = stage.scene.nodes().iter();
    let objects: Vec<NodeId> =
        nodes.filter(|(_, node)| node.visible && node.mesh.is_some()).map(|(id, _)| id).collect();
    let count = objects.len();
    let current = objects.iter().position(|&id| Some(id) == stage.selection);
    let next = match (current, direction) {
        (Some(i), Direction::Forward) => (i + 1) % count,
        (Some(i), Direction::Backward) => (i + count - 1) % count,
        (None, Direction::Forward) => 0,
        (None, Direction::Backward) => count.saturating_sub(1),
    };
    stage.selection = objects.get(next).copied();
    announce_selection(stage);
}

/// Shown again, the list is not searched for what was looked for last.
fn toggle_cheat_sheet(stage: &mut Stage) {
    stage.cheat_sheet = stage.cheat_sheet.toggled();
    stage.command_search.clear();
}

fn undo(stage: &mut Stage) {
    if !stage.undo_move() {
        stage.overlay.notify("no object was moved");
    }
}

fn redo(stage: &mut Stage) {
    if !stage.redo_move() {
        stage.overlay.notify("nothing was undone");
    }
}

fn look_at_selected(stage: &mut Stage) {
    match stage.selection_bounds().and_then(|bounds| bounds.center()) {
        Some(middle) => stage.orbit.set_target(middle),
        None => say_nothing_is_selected(stage),
    }
}

/// After a key that does something to the selected object.
pub(crate) fn say_nothing_is_selected(stage: &mut Stage) {
    stage.overlay.notify("no object is selected; Tab or a click selects one");
}

fn toggle_orbit_style(stage: &mut Stage) {
    let (style, name) = match stage.orbit.style() {
        OrbitStyle::Turntable => (OrbitStyle::Trackball, "Trackball"),
        OrbitStyle::Trackball => (OrbitStyle::Turntable, "Turntable"),
    };
    stage.orbit.set_style(style);
    stage.overlay.notify(name);
}

fn toggle_edges(stage: &mut Stage) {
    stage.settings.style = match stage.settings.style {
        Style::Surface => Style::SurfaceWithEdges,
        _ => Style::Surface,
    };
}

fn cycle_wireframe(stage: &mut Stage) {
    let (style, name) = match stage.settings.style {
        Style::Wireframe => (Style::HiddenLine, "Hidden lines"),
        Style::HiddenLine => (Style::Surface, "Surface"),
        Style::Surface | Style::SurfaceWithEdges => (Style::Wireframe, "Wireframe"),
    };
    stage.settings.style = style;
    stage.overlay.notify(name);
}

fn cycle_samples(stage: &mut Stage) {
    /// The most that the renderer takes, along each side of a pixel.
    const MOST: u32 = 4;
    let next = stage.settings.samples_per_axis % MOST + 1;
    (stage.settings.samples_per_axis, stage.settings.samples) = (next, 1);
    let unit = if next == 1 { "sample" } else { "samples" };
    stage.overlay.notify(format!("{} {unit} per pixel", next * next));
}

#[cfg(test)]
mod tests;
