//! The gizmo on the selection: handles to move, rotate and scale it with the mouse.

use trigon_document::scene::math::{DMat3, DVec3, elementary};
use trigon_window::egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, vec2};

use super::AXIS_COLORS;
use super::view::{OverlayView, distance_to_line};

/// From the middle to the tips, in logical pixels.
const ARM: f64 = 80.0;
/// The start of the arms, as a fraction of their length: the middle is a separate handle.
const START: f64 = 0.2;
/// Where squares of planes lie, as shares of the arms.
const PLANE: [f64; 2] = [0.3, 0.5];
/// Of the tips, in logical pixels.
const TIP: f32 = 5.0;
/// Of the ring around all others, as a share of the arms.
const OUTER: f64 = 1.2;
/// A square that covers less is left out, in logical pixels.
const LEAST_AREA: f32 = 4.0;
/// Pieces of a ring.
const PIECES: usize = 64;
/// How near the pointer has to be, in logical pixels.
const GRAB: f32 = 7.0;

/// What the gizmo does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GizmoKind {
    Move,
    Rotate,
    Scale,
}

/// A part of the gizmo that can be dragged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Handle {
    /// Along an axis, or around it: 0 to 2.
    Axis(usize),
    /// In the plane perpendicular to an axis: 0 to 2.
    Plane(usize),
    /// In the plane of the image, around the line of sight, or equally in all directions.
    View,
}

/// The gizmo at a position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gizmo {
    pub(crate) kind: GizmoKind,
    /// The pivot, in the world.
    pub(crate) center: DVec3,
    /// Its axes, of unit length, in the world.
    pub(crate) axes: DMat3,
}

impl Gizmo {
    /// Draws it; the handle under the pointer is brighter.
    pub(crate) fn draw(&self, painter: &Painter, view: &OverlayView, under_pointer: Option<Handle>) {
        for handle in self.handles() {
            let color = match handle {
                Handle::Axis(axis) | Handle::Plane(axis) => AXIS_COLORS[axis],
                Handle::View => Color32::WHITE,
            };
            let is_bright = under_pointer == Some(handle);
            let color = if is_bright { color } else { color.gamma_multiply(0.75) };
            let stroke = Stroke::new(if is_bright { 4.0 } else { 2.5 }, color);
            for line in self.lines(view, handle) {
                painter.line_segment(line, stroke);
            }
            if let Some(shape) = self.area(view, handle) {
                painter.add(Shape::convex_polygon(shape, color.gamma_multiply(0.5), Stroke::new(1.0, color)));
            }
            if let (Handle::Axis(axis), Some(tip)) = (handle, self.tip(view, handle)) {
                self.draw_tip(painter, tip, AXIS_COLORS[axis]);
            }
        }
    }

    fn draw_tip(&self, painter: &Painter, tip: Pos2, color: Color32) {
        let shape = match self.kind {
            GizmoKind::Move => Shape::circle_filled(tip, TIP, color),
            GizmoKind::Scale => {
                Shape::rect_filled(Rect::from_center_size(tip, vec2(2.0 * TIP, 2.0 * TIP)), 0.0, color)
            }
            GizmoKind::Rotate => return,
        };
        painter.add(shape);
    }

    /// The handle under the pointer; of several the nearest, and of equally near ones the first of
    /// axes, planes and view.
    pub(crate) fn handle_at(&self, view: &OverlayView, pointer: Pos2) -> Option<Handle> {
        let distance = |handle: &Handle| {
            let is_inside = self.area(view, *handle).is_some_and(|area| contains(&area, pointer));
            let lines = self.lines(view, *handle).into_iter().map(|line| distance_to_line(line, pointer));
            let tip = self.tip(view, *handle).map(|tip| tip.distance(pointer));
            let nearest = lines.chain(tip).fold(f32::INFINITY, f32::min);
            if is_inside { 0.0 } else { nearest }
        };
        self.handles()
            .into_iter()
            .map(|handle| (distance(&handle), handle))
            .filter(|&(distance, _)| distance <= GRAB)
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map(|(_, handle)| handle)
    }

    fn handles(&self) -> Vec<Handle> {
        let axes = [0, 1, 2].map(Handle::Axis);
        let planes = [0, 1, 2].map(Handle::Plane);
        match self.kind {
            GizmoKind::Rotate => axes.into_iter().chain([Handle::View]).collect(),
            _ => axes.into_iter().chain(planes).chain([Handle::View]).collect(),
        }
    }

    /// The length of its arms in metres.
    fn size(&self, view: &OverlayView) -> f64 {
        ARM * view.pixel_size(self.center)
    }

    /// What a handle consists of, in logical pixels.
    fn lines(&self, view: &OverlayView, handle: Handle) -> Vec<[Pos2; 2]> {
        let size = self.size(view);
        let camera = view.camera();
        match (self.kind, handle) {
            (GizmoKind::Rotate, Handle::Axis(axis)) => {
                self.ring(view, self.axes.col((axis + 1) % 3) * size, self.axes.col((axis + 2) % 3) * size)
            }
            (GizmoKind::Rotate, Handle::View) => {
                self.ring(view, camera.right() * size * OUTER, camera.up() * size * OUTER)
            }
            (_, Handle::Axis(axis)) => {
                let [from, to] = [START, 1.0].map(|share| self.center + self.axes.col(axis) * size * share);
                view.line(from, to).into_iter().collect()
            }
            (_, Handle::View) => {
                self.ring(view, camera.right() * size * START * 0.7, camera.up() * size * START * 0.7)
            }
            (_, Handle::Plane(_)) => Vec::new(),
        }
    }

    /// A circle, or of a circle around an axis the half that is nearer to the eye: the other half would be
    /// taken for it.
    fn ring(&self, view: &OverlayView, right: DVec3, up: DVec3) -> Vec<[Pos2; 2]> {
        let at = |piece: usize| {
            let (sin, cos) = elementary::sin_cos(piece as f64 / PIECES as f64 * std::f64::consts::TAU);
            right * cos + up * sin
        };
        let forward = view.camera().forward();
        // Rings that face the eye are drawn completely.
        let slack = right.length() * 0.05;
        let is_near = |offset: DVec3| offset.dot(forward) <= slack;
        (0..PIECES)
            .map(|piece| [at(piece), at(piece + 1)])
            .filter(|&[from, to]| is_near((from + to) * 0.5))
            .filter_map(|[from, to]| view.line(self.center + from, self.center + to))
            .collect()
    }

    /// The square of a plane; none if it is seen edge-on.
    fn area(&self, view: &OverlayView, handle: Handle) -> Option<Vec<Pos2>> {
        let Handle::Plane(axis) = handle else { return None };
        let size = self.size(view);
        let [right, up] = [1, 2].map(|next| self.axes.col((axis + next) % 3) * size);
        let [low, high] = PLANE;
        let corners = [(low, low), (high, low), (high, high), (low, high)];
        let corners_on_screen = corners.map(|(x, y)| view.point(self.center + right * x + up * y));
        let corners_on_screen: Vec<Pos2> = corners_on_screen.into_iter().collect::<Option<_>>()?;
        // Seen edge-on, its outline has no direction, and its corners would be NaN.
        let (one, other) =
            (corners_on_screen[2] - corners_on_screen[0], corners_on_screen[3] - corners_on_screen[1]);
        let area = 0.5 * (one.x * other.y - one.y * other.x).abs();
        (area >= LEAST_AREA).then_some(corners_on_screen)
    }

    /// The end of an arm.
    fn tip(&self, view: &OverlayView, handle: Handle) -> Option<Pos2> {
        match (self.kind, handle) {
            (GizmoKind::Rotate, _) => None,
            (_, Handle::Axis(axis)) => view.point(self.center + self.axes.col(axis) * self.size(view)),
            (_, Handle::View) => view.point(self.center),
            (_, Handle::Plane(_)) => None,
        }
    }
}

/// Whether a point lies in a convex polygon of either winding.
fn contains(polygon: &[Pos2], point: Pos2) -> bool {
    let side = |index: usize| {
        let (a, b) = (polygon[index], polygon[(index + 1) % polygon.len()]);
        (b - a).rot90().dot(point - a)
    };
    let sides = || (0..polygon.len()).map(side);
    sides().all(|side| side > 0.0) || sides().all(|side| side < 0.0)
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::camera::{Camera, Viewport};

    use super::*;

    fn view() -> OverlayView {
        let camera = Camera::look_at(DVec3::new(3.0, 4.0, 5.0), DVec3::ZERO, DVec3::Y);
        OverlayView::new(&camera, Viewport { width: 800, height: 600 }, 1.0)
    }

    fn gizmo(kind: GizmoKind) -> Gizmo {
        Gizmo { kind, center: DVec3::ZERO, axes: DMat3::IDENTITY }
    }

    #[test]
    fn squares_are_left_out_that_are_seen_from_their_edges() {
        use trigon_document::scene::camera::{Camera, Projection, Viewport};
        let camera = Camera::look_at(DVec3::Z * 10.0, DVec3::ZERO, DVec3::Y);
        let projection = Projection::orthographic(5.0, 0.1, 100.0).expect("valid");
        let viewport = Viewport { width: 800, height: 600 };
        let view = OverlayView::new(&camera.with_projection(projection), viewport, 1.0);
        let gizmo = Gizmo { kind: GizmoKind::Move, center: DVec3::ZERO, axes: DMat3::IDENTITY };
        let has_area = [0, 1, 2].map(|axis| gizmo.area(&view, Handle::Plane(axis)).is_some());
        assert_eq!(has_area, [false, false, true], "of three only the one that faces the eye");
    }

    #[test]
    fn each_handle_is_found_where_it_is_drawn() {
        let view = view();
        for kind in [GizmoKind::Move, GizmoKind::Rotate, GizmoKind::Scale] {
            let gizmo = gizmo(kind);
            for handle in gizmo.handles() {
                let area = gizmo
                    .area(&view, handle)
                    .map(|area| area.iter().fold(Pos2::ZERO, |sum, corner| sum + corner.to_vec2() / 4.0));
                let lines = gizmo.lines(&view, handle);
                // A ring crosses others here and there.
                let on_line = lines.iter().map(|[from, to]| from.lerp(*to, 0.5));
                let found =
                    on_line.chain(area).filter(|&at| gizmo.handle_at(&view, at) == Some(handle)).count();
                assert!(2 * found > lines.len(), "{kind:?} {handle:?}: {found} of {}", lines.len());
            }
        }
    }

    #[test]
    fn beside_it_nothing_is_found() {
        let (view, gizmo) = (view(), gizmo(GizmoKind::Move));
        let center = view.point(DVec3::ZERO).expect("before the eye");
        assert_eq!(gizmo.handle_at(&view, center + vec2(150.0, 0.0)), None);
        assert_eq!(gizmo.handle_at(&view, center), Some(Handle::View));
    }

    #[test]
    fn it_is_as_large_on_the_screen_at_any_distance() {
        for distance in [0.1, 1.0, 1000.0] {
            let camera = Camera::look_at(DVec3::Z * distance, DVec3::ZERO, DVec3::Y);
            let camera = camera
                .with_projection(camera.projection.with_planes(distance * 0.01, None).expect("positive"));
            let view = OverlayView::new(&camera, Viewport { width: 800, height: 600 }, 1.0);
            let tip = gizmo(GizmoKind::Move).tip(&view, Handle::Axis(0)).expect("before the eye");
            assert!((tip.x - 400.0 - ARM as f32).abs() < 0.01, "{tip} at {distance} m");
        }
    }
}
