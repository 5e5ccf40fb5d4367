//! Lights as a few concentric circles with their names and a line in the direction in which they shine, and
//! cameras as their view pyramids.

use trigon_document::Document;
use trigon_document::scene::camera::{Camera, Projector, Viewport};
use trigon_document::scene::math::{DAffine3, DVec2, DVec3, elementary};
use trigon_document::scene::{Light, LightKind, NodeId};
use trigon_window::egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, vec2};

use super::view::{OverlayView, distance_to_line};
use super::{GRAB, PLAIN, SELECTED};

/// Of the circles, in logical pixels.
const RADII: [f32; 3] = [4.0, 8.0, 12.0];
/// Of the line in the direction of the light, in logical pixels at the light.
const RAY: f64 = 60.0;
/// Lines that draw a spot light's cone.
const CONE_LINES: usize = 8;

/// Draws all lights that have a position or a direction.
pub(crate) fn draw_lights(painter: &Painter, document: &Document, view: &OverlayView) {
    for (id, light, world) in lights(document) {
        let color = if document.selection().objects.contains(&id) { SELECTED } else { PLAIN };
        let stroke = Stroke::new(1.0, color);
        if let Some(center) = view.point(world.translation) {
            for radius in RADII {
                painter.circle_stroke(center, radius, stroke);
            }
            let name = &document.nodes().node(id).expect("it was just listed").name;
            write(painter, center, name, color);
        }
        for [from, to] in shape(&light, &world, view) {
            if let Some(line) = view.line(from, to) {
                painter.line_segment(line, stroke);
            }
        }
    }
}

fn write(painter: &Painter, center: Pos2, name: &str, color: Color32) {
    let at = center + vec2(RADII[2] + 4.0, 0.0);
    painter.text(at, Align2::LEFT_CENTER, name, FontId::proportional(12.0), color);
}

/// The light whose circles are under the pointer: the nearest to the camera of several.
pub(crate) fn light_at(document: &Document, view: &OverlayView, pointer: Pos2) -> Option<NodeId> {
    let is_near = |world: &DAffine3| {
        view.point(world.translation).is_some_and(|center| center.distance(pointer) <= RADII[2].max(GRAB))
    };
    lights(document)
        .filter(|(_, _, world)| is_near(world))
        .min_by(|a, b| view.distance(a.2.translation).total_cmp(&view.distance(b.2.translation)))
        .map(|(id, ..)| id)
}

/// All visible lights but ambient ones, with their places in the world.
fn lights(document: &Document) -> impl Iterator<Item = (NodeId, Light, DAffine3)> {
    let scene = document.nodes();
    let transforms = scene.visible_transforms();
    scene.nodes().iter().filter_map(move |(id, node)| {
        let light = node.light.as_deref().filter(|light| light.kind != LightKind::Ambient)?;
        Some((id, *light, transforms[id.index()]?))
    })
}

/// Lines that tell where it shines.
fn shape(light: &Light, world: &DAffine3, view: &OverlayView) -> Vec<[DVec3; 2]> {
    let origin = world.translation;
    let length = RAY * view.pixel_size(origin);
    let direction = |local: DVec3| world.transform_vector3(local).normalize_or_zero() * length;
    match light.kind {
        LightKind::Ambient | LightKind::Point => Vec::new(),
        LightKind::Directional => vec![[origin, origin + direction(DVec3::NEG_Z)]],
        LightKind::Spot { outer, .. } => {
            let (sin, cos) = elementary::sin_cos(f64::from(outer));
            let rim = |index: usize| {
                let turn = index as f64 / CONE_LINES as f64 * std::f64::consts::TAU;
                let (up, right) = elementary::sin_cos(turn);
                origin + direction(DVec3::new(sin * right, sin * up, -cos))
            };
            let sides = (0..CONE_LINES).step_by(2).map(|index| [origin, rim(index)]);
            let around = (0..CONE_LINES).map(|index| [rim(index), rim(index + 1)]);
            sides.chain(around).collect()
        }
    }
}

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
        let visible = lines.iter().filter_map(|&[from, to]| view.line(from, to));
        visible.map(|line| distance_to_line(line, pointer)).fold(f32::INFINITY, f32::min)
    };
    cameras(document)
        .map(|(id, lines)| (id, nearest(&lines)))
        .filter(|&(_, distance)| distance <= GRAB)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(id, _)| id)
}

fn cameras(document: &Document) -> impl Iterator<Item = (NodeId, Vec<[DVec3; 2]>)> {
    let transforms = document.nodes().visible_transforms();
    let all = document.nodes().cameras().into_iter();
    all.filter(move |(id, _)| transforms[id.index()].is_some()).map(|(id, camera)| (id, pyramid(&camera)))
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
    use super::super::view::tests::front;
    use super::*;
    use trigon_document::scene::{Node, Scene};
    use trigon_window::egui::pos2;

    fn document() -> (Document, [NodeId; 4]) {
        let mut scene = Scene::new();
        let lights = [Light::point(1.0), Light::directional(1.0), Light::spot(1.0), Light::ambient(1.0)];
        let ids = [0, 1, 2, 3].map(|index| {
            scene.add(Node::from_light(lights[index]).at(DVec3::new(index as f64 - 1.0, 0.0, 0.0)))
        });
        (Document::new(scene), ids)
    }

    #[test]
    fn the_light_under_the_pointer_is_found() {
        let (document, [point, directional, spot, _]) = document();
        let view = front();
        let at = |x: f64| view.point(DVec3::new(x, 0.0, 0.0)).expect("before the eye");
        assert_eq!(light_at(&document, &view, at(-1.0)), Some(point));
        assert_eq!(light_at(&document, &view, at(0.0) + vec2(0.0, 11.0)), Some(directional));
        assert_eq!(light_at(&document, &view, at(1.0)), Some(spot));
        assert_eq!(light_at(&document, &view, at(2.0)), None, "ambient light is nowhere");
        assert_eq!(light_at(&document, &view, pos2(0.0, 0.0)), None, "far from all");
    }

    #[test]
    fn cones_are_as_wide_as_they_shine() {
        let view = front();
        let lines = shape(&Light::spot(1.0), &DAffine3::IDENTITY, &view);
        assert_eq!(lines.len(), 4 + CONE_LINES);
        for [_, rim] in &lines {
            // 45°: as far from the axis as along it, as well as f32 holds the angle.
            assert!((rim.truncate().length() + rim.z).abs() < 1e-6, "{rim}");
        }
        let rays = shape(&Light::directional(1.0), &DAffine3::IDENTITY, &view);
        assert!(matches!(rays[..], [[DVec3::ZERO, to]] if to.z < 0.0), "along −Z: {rays:?}");
    }

    #[test]
    fn a_camera_is_found_by_its_lines() {
        let mut scene = Scene::new();
        let mut node = Node::default();
        node.camera = Some(Box::default());
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
