//! What lies over the picture and is not in the scene: lights, cameras, cursor, grid, gizmos and the
//! outlines of gestures, as shapes of the interface.
//!
//! `view` projects points and lines to logical pixels, cut at the near plane; each other file draws
//! one thing with it and, where it can be clicked, tells what is under the pointer. Nothing
//! here changes the document.

mod axes;
mod cameras;
mod cursor;
mod gesture;
mod gizmo;
mod grid;
mod lights;
mod view;

pub(crate) use axes::{axis_view_at, draw_axes};
pub(crate) use cameras::{camera_at, draw_cameras};
pub(crate) use cursor::{draw_cursor, draw_origins};
pub(crate) use gesture::{Gesture, draw_gesture};
pub(crate) use gizmo::{Gizmo, GizmoKind, Handle};
pub(crate) use grid::draw_grid;
pub(crate) use lights::{draw_lights, light_at};
pub(crate) use view::OverlayView;

use trigon_window::egui::Color32;

/// The colours of x, y and z, as in Blender.
const AXIS_COLORS: [Color32; 3] =
    [Color32::from_rgb(255, 51, 82), Color32::from_rgb(139, 220, 0), Color32::from_rgb(40, 144, 255)];

/// Letters, so that nobody has to tell the colours apart.
const AXIS_NAMES: [&str; 3] = ["X", "Y", "Z"];

/// Of what is selected.
const SELECTED: Color32 = Color32::from_rgb(255, 160, 40);

/// Of what is not.
const PLAIN: Color32 = Color32::from_gray(220);

/// How near the pointer has to be to a line or a point, in logical pixels.
const GRAB: f32 = 8.0;
