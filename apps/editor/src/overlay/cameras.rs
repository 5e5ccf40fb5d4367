//! The cameras of the scene, drawn as their view pyramids.

use trigon_document::Document;
use trigon_document::scene::NodeId;
use trigon_document::scene::camera::{Camera, Projector, Viewport};
use trigon_document::scene::math::{DVec2, DVec3};
use trigon_window::egui::{Painter, Pos2, Stroke};

use super::view::{OverlayView, distance_to_line};
use super::{GRAB, PLAIN, SELECTED};

/// How far from the eye the pyramid's base is, in metres.
const LENGTH: f64 = 1.0;
/// Of the image that a camera takes, if its projection does not tell.
const FRAME: Viewport = Viewport { width: 16, height: 9 };

/// Draws all visible cameras.
pub(crate) fn draw_cameras(painter: &Painter, document: &Document, view: &OverlayView) {
    for (id, lines) in cameras(document) {
        let color = if document.selection().objects.contains(&id) { SELECTED } else { PLAIN };
        for [from, to] in lines {
            if let Some(line) = view.line(from, to) {
                painter.line_segment(line, Stroke::new(1.0, color));
            }
        }
    }
}

/// The camera one of whose lines is under the pointer.
pub(crate) fn camera_at(document: &Document, view: &OverlayView, pointer: Pos2) -> Option<NodeId> {
    let nearest = |lines: &[[DVec3; 2]]| {
        let seen = lines.iter().filter_map(|&[from, to]| view.line(from, to));
        seen.map(|line| distance_to_line(line, pointer)).fold(f32::INFINITY, f32::min)
    };
    cameras(document)
        .map(|(id, lines)| (id, nearest(&lines)))
        .filter(|&(_, distance)| distance <= GRAB)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(id, _)| id)
}

fn cameras(document: &Document) -> impl Iterator<Item = (NodeId, Vec<[DVec3; 2]>)> {
    let places = document.nodes().visible_transforms();
    let all = document.nodes().cameras().into_iter();
    all.filter(move |(id, _)| places[id.index()].is_some()).map(|(id, camera)| (id, pyramid(&camera)))
}

/// The edges of what a camera sees up to the base, and a triangle on its upper side.
fn pyramid(camera: &Camera) -> Vec<[DVec3; 2]> {
    let projector = Projector::new(camera, frame(camera));
    let size = projector.viewport().size();
    let at = |x: f64, y: f64, distance: f64| projector.at_distance(size * DVec2::new(x, y), distance);
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let Some(base) = corners.map(|(x, y)| at(x, y, LENGTH)).into_iter().collect::<Option<Vec<_>>>() else {
        return Vec::new();
    };
    let tips = corners.map(|(x, y)| at(x, y, 0.0).unwrap_or(camera.position));
    let mut lines: Vec<[DVec3; 2]> = (0..4).map(|i| [base[i], base[(i + 1) % 4]]).collect();
    lines.extend((0..4).map(|i| [tips[i], base[i]]));
    let height = (base[0] - base[3]) * 0.3;
    let [left, right] = [0.3, 0.7].map(|share| base[0].lerp(base[1], share) + height * 0.2);
    let top = base[0].lerp(base[1], 0.5) + height;
    lines.extend([[left, right], [right, top], [top, left]]);
    lines
}

/// An image with the aspect ratio of the projection.
fn frame(camera: &Camera) -> Viewport {
    match camera.projection.own_aspect() {
        Some(aspect) if aspect > 0.0 => Viewport { width: (aspect * 1000.0) as u32, height: 1000 },
        _ => FRAME,
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::camera::Projection;
    use trigon_document::scene::{Node, Scene};
    use trigon_window::egui::pos2;

    use super::super::view::tests::front;
    use super::*;

    #[test]
    fn a_camera_is_found_by_its_lines() {
        let mut scene = Scene::new();
        let mut node = Node::default();
        node.camera = Some(Projection::default());
        let id = scene.add(node);
        let document = Document::new(scene);
        let view = front();
        // Its tip is at the origin.
        assert_eq!(camera_at(&document, &view, pos2(202.0, 151.0)), Some(id));
        assert_eq!(camera_at(&document, &view, pos2(10.0, 10.0)), None);
    }

    #[test]
    fn the_base_is_what_the_camera_sees() {
        let camera = Camera::default();
        let projector = Projector::new(&camera, FRAME);
        for [from, _] in &pyramid(&camera)[..4] {
            let at = projector.to_screen(*from).expect("before the eye");
            let on_border = (at.x.abs() < 1e-9 || (at.x - 16.0).abs() < 1e-9)
                && (at.y.abs() < 1e-9 || (at.y - 9.0).abs() < 1e-9);
            assert!(on_border, "{at} is a corner of the image");
        }
    }
}
