//! Clicks: what is selected by them.

use trigon_edit::scene::NodeId;
use trigon_edit::{
    Command, ElementKind, ObjectName, Select, SelectAction, SelectLinked, SelectLoop, SelectNone, SelectPath,
    SelectRing,
};
use trigon_window::scene::camera::Projector;
use trigon_window::scene::math::{DVec2, DVec3};
use trigon_window::{Hands, Modifiers, Stage};

use super::editor::Editor;
use super::show::{element_numbers, mesh_of};
use crate::request::Request;

/// A press that moves further than this many logical pixels is no click.
const SLOP: f64 = 4.0;

/// The left button is down.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Click {
    at: DVec2,
    modifiers: Modifiers,
    /// Whether the pointer has moved too far for a click.
    is_drag: bool,
}

impl Click {
    pub(crate) fn new(hands: Hands) -> Option<Self> {
        hands.pointer.map(|at| Self { at, modifiers: hands.modifiers, is_drag: false })
    }

    /// The pointer moved.
    pub(crate) fn moved(&mut self, hands: Hands, scale: f64) {
        self.is_drag |= hands.pointer.is_some_and(|to| to.distance(self.at) > SLOP * scale);
    }

    /// Where and with which modifiers the click was, if it is one.
    pub(crate) fn released(self) -> Option<(DVec2, Modifiers)> {
        (!self.is_drag).then_some((self.at, self.modifiers))
    }
}

/// Selects what is at a place of the window.
pub(crate) fn click(editor: &mut Editor, stage: &mut Stage, at: DVec2, modifiers: Modifiers) {
    for command in commands(editor, stage, at, modifiers) {
        editor.perform(stage, Request::Run(command));
    }
}

fn commands(editor: &Editor, stage: &Stage, at: DVec2, modifiers: Modifiers) -> Vec<Command> {
    let has = |modifier| modifiers.contains(modifier);
    let action = if has(Modifiers::SHIFT) { SelectAction::Toggle } else { SelectAction::Replace };
    let is_editing = editor.document.selection().is_editing();
    let Some((hit, _)) = stage.pick(at) else {
        // A click beside everything selects nothing, unless it was to add.
        let clears = action == SelectAction::Replace;
        return if clears { vec![SelectNone {}.into()] } else { Vec::new() };
    };
    let objects = vec![ObjectName::of(hit.node)];
    if !is_editing {
        return vec![Select { objects, elements: Vec::new(), action }.into()];
    }
    let Some(face) = hit.face else { return Vec::new() };
    // Loops and rings are of edges; a click with Ctrl goes on from what was selected last.
    let (alt, ctrl) = (has(Modifiers::ALT), has(Modifiers::CTRL));
    let action = if ctrl && !alt { SelectAction::Add } else { action };
    let Some(element) = element_at(editor, stage, (hit.node, face), at) else { return Vec::new() };
    let mut commands = vec![Select { objects, elements: vec![element], action }.into()];
    match (alt, ctrl) {
        (true, true) => commands.push(SelectRing {}.into()),
        (true, false) => commands.push(SelectLoop {}.into()),
        (false, true) => commands.push(SelectPath {}.into()),
        (false, false) => {}
    }
    commands
}

/// Adds what hangs together with what is at a place; nothing where no edited mesh is.
pub(crate) fn linked(editor: &Editor, stage: &Stage, at: DVec2) -> Vec<Command> {
    let element = stage.pick(at).and_then(|(hit, _)| {
        let element = element_at(editor, stage, (hit.node, hit.face?), at)?;
        Some((ObjectName::of(hit.node), element))
    });
    let Some((object, element)) = element else { return Vec::new() };
    let select = Select { objects: vec![object], elements: vec![element], action: SelectAction::Add };
    vec![select.into(), SelectLinked {}.into()]
}

/// The element of the kind that is selected that is nearest to a place, at a face that is seen there.
fn element_at(editor: &Editor, stage: &Stage, (node, face): (NodeId, usize), at: DVec2) -> Option<u32> {
    let document = &editor.document;
    let (id, kind) = (mesh_of(document, node)?, document.selection().kind());
    let mesh = document.nodes().meshes().get(id)?.mesh();
    let numbers = element_numbers(document, id, kind)?;
    let transform = document.nodes().world_transform(node);
    let projector = Projector::new(&stage.camera(), stage.viewport());
    let place = |vertex: u32| -> Option<DVec2> {
        let position: DVec3 = mesh.positions().get(vertex as usize)?.as_dvec3();
        projector.to_screen(transform.transform_point3(position))
    };
    let shown = match kind {
        ElementKind::Face => face,
        ElementKind::Vertex => {
            let vertices = mesh.face_vertices(face).iter();
            let distances = vertices.filter_map(|&vertex| Some((place(vertex)?.distance(at), vertex)));
            distances.min_by(|a, b| a.0.total_cmp(&b.0))?.1 as usize
        }
        ElementKind::Edge => {
            let corners = mesh.face_corners(face);
            let vertices = mesh.face_vertices(face);
            let distances = corners.enumerate().filter_map(|(index, corner)| {
                let ends = [vertices[index], vertices[(index + 1) % vertices.len()]];
                let [from, to] = [place(ends[0])?, place(ends[1])?];
                Some((distance_to_line(at, from, to), mesh.corner_edge(corner)?))
            });
            distances.min_by(|a, b| a.0.total_cmp(&b.0))?.1 as usize
        }
    };
    numbers.get(shown).copied()
}

/// From a point to a piece of a line.
fn distance_to_line(at: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let length = along.length_squared();
    let share = if length > 0.0 { ((at - from).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    at.distance(from + along * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_to_a_line_ends_at_its_ends() {
        let (from, to) = (DVec2::ZERO, DVec2::new(10.0, 0.0));
        assert_eq!(distance_to_line(DVec2::new(5.0, 3.0), from, to), 3.0, "beside it");
        assert_eq!(distance_to_line(DVec2::new(13.0, 4.0), from, to), 5.0, "beyond its end");
        assert_eq!(distance_to_line(DVec2::new(3.0, 4.0), from, from), 5.0, "a line of no length");
    }
}
