//! Overlays that are not in the scene: lights, cameras, cursor, grid, gizmos and the outlines of
//! gestures, as shapes of the interface.
//!
//! `view` projects points and lines to logical pixels, clipped at the near plane; each other file
//! draws one kind of overlay with it and, if it can be clicked, finds what is under the pointer.
//! Nothing here changes the document.

mod axes;
mod camera_frame;
mod gesture;
mod gizmo;
mod grid;
mod lights;
mod view;

pub(crate) use axes::{axis_view_at, draw_axes, draw_cursor, draw_origins};
pub(crate) use camera_frame::draw_camera_frame;
pub(crate) use gesture::{GestureOutline, draw_gesture};
pub(crate) use gizmo::{Gizmo, GizmoKind, Handle};
pub(crate) use grid::draw_grid;
pub(crate) use lights::{camera_at, draw_cameras, draw_lights, light_at};
pub(crate) use view::{OverlayView, distance_to_line};

use trigon_window::egui::Color32;

/// The colours of x, y and z, as in Blender.
const AXIS_COLORS: [Color32; 3] =
    [Color32::from_rgb(255, 51, 82), Color32::from_rgb(139, 220, 0), Color32::from_rgb(40, 144, 255)];

/// Letters, for users who cannot tell the colours apart.
const AXIS_NAMES: [&str; 3] = ["X", "Y", "Z"];

/// Of what is selected.
const SELECTED: Color32 = Color32::from_rgb(255, 160, 40);

/// Of what is not.
const PLAIN: Color32 = Color32::from_gray(220);

/// How near the pointer has to be to a line or a point, in logical pixels.
const GRAB: f32 = 8.0;

#[cfg(test)]
mod tests {
    use trigon_document::scene::camera::{Camera, Viewport};
    use trigon_document::scene::math::{DMat3, DVec3};
    use trigon_document::scene::{Light, Node, Scene};
    use trigon_document::{Command, Document};
    use trigon_window::egui::{Context, Painter, RawInput, Rect, pos2};

    use super::*;

    /// Lights of all kinds, all selected.
    fn document() -> Document {
        let mut scene = Scene::new();
        for (x, light) in
            [Light::point(1.0), Light::directional(1.0), Light::spot(1.0)].into_iter().enumerate()
        {
            scene.add(Node::from_light(light).with_name("light").at(DVec3::X * x as f64));
        }
        let mut document = Document::new(scene);
        let all: Command = serde_json::from_str(r#"{ "op": "select_all" }"#).expect("a command");
        document.run(all).expect("always possible");
        document
    }

    fn draw_all(painter: &Painter, document: &Document, view: &OverlayView) {
        draw_grid(painter, view, &|points| vec![Some(3.0); points.len()]);
        draw_lights(painter, document, view);
        draw_cameras(painter, document, view);
        draw_origins(painter, document, view);
        draw_cursor(painter, view, DVec3::ZERO);
        draw_axes(painter, view, pos2(50.0, 50.0));
        for kind in [GizmoKind::Move, GizmoKind::Rotate, GizmoKind::Scale] {
            let gizmo = Gizmo { kind, center: DVec3::ZERO, axes: DMat3::IDENTITY };
            gizmo.draw(painter, view, gizmo.handle_at(view, pos2(100.0, 100.0)));
        }
        for gesture in [
            GestureOutline::Box([pos2(10.0, 90.0), pos2(80.0, 20.0)]),
            GestureOutline::Circle { center: pos2(40.0, 40.0), radius: 25.0 },
            GestureOutline::Lasso(vec![pos2(1.0, 1.0), pos2(90.0, 5.0), pos2(40.0, 80.0)]),
        ] {
            draw_gesture(painter, &gesture);
        }
    }

    #[test]
    fn all_is_drawn_at_places_that_are_numbers_from_wherever_it_is_seen() {
        let document = document();
        let viewport = Viewport { width: 400, height: 300 };
        let eyes = [
            DVec3::new(4.0, 3.0, 5.0),
            // On a light, on the floor, straight above, far away.
            DVec3::ZERO,
            DVec3::new(5.0, 0.0, 0.0),
            DVec3::new(0.0, 8.0, 0.0),
            DVec3::splat(1e8),
        ];
        for eye in eyes {
            let camera = Camera::look_at(eye, DVec3::new(0.5, 0.0, 0.0), DVec3::Y);
            let view = OverlayView::new(&camera, viewport, 1.0);
            let mut output = Context::default().run_ui(RawInput::default(), |ui| {
                let area = Rect::from_min_max(pos2(0.0, 0.0), pos2(400.0, 300.0));
                draw_all(&ui.painter().with_clip_rect(area), &document, &view);
            });
            output.textures_delta.clear();
            assert!(output.shapes.len() > 20, "{} shapes from {eye}", output.shapes.len());
            for clipped in output.shapes {
                let bounds = clipped.shape.visual_bounding_rect();
                // Nothing has no bounds.
                assert!(bounds.is_finite() || bounds == Rect::NOTHING, "{:?} from {eye}", clipped.shape);
            }
        }
    }
}
