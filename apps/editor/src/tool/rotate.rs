//! Rotating: from the pointer or typed numbers to axis and angle.

use trigon_document::mesh::math::DVec3;
use trigon_document::{Command, Rotate, TransformSpace};

use super::snap::rounded;
use super::transform::TransformTool;
use super::view::ToolView;

/// How far a trackball turns for a logical pixel, in degrees.
const TRACKBALL: f64 = 0.5;

impl TransformTool {
    /// The command that turns the selection about the locked axis, or about the line of sight.
    pub(super) fn rotate(&mut self, view: &ToolView) -> Result<Command, String> {
        let towards_viewer = view.towards_viewer();
        let axis = self.constraint.axis(&self.frames).unwrap_or(towards_viewer);
        // Seen from behind, a rotation about an axis is reversed.
        let dragged = if axis.dot(towards_viewer) < 0.0 { -self.turn } else { self.turn };
        let step = self.settings.snap.angle_step(self.modal.is_precise());
        let dragged = if self.snaps() { rounded(dragged, step) } else { dragged };
        let typed = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())?;
        let angle = typed.unwrap_or(dragged);
        self.text = format!("Rotate {angle:.2}°");
        Ok(self.rotation(axis, angle))
    }

    /// The command that turns the selection as a ball under the pointer.
    pub(super) fn trackball(&mut self, view: &ToolView) -> Result<Command, String> {
        let way = self.modal.pointer.way() * (TRACKBALL / view.scale);
        let mut angles = [way.x, way.y];
        if self.modal.numeric.is_active() {
            let typed = self.modal.numeric.values().map_err(|error| error.to_string())?;
            angles = [0, 1].map(|place| typed.get(place).copied().flatten().unwrap_or(0.0));
        }
        let [across, down] = angles;
        let turn = view.camera.up() * across + view.camera.right() * down;
        self.text = format!("Trackball {across:.2}°, {down:.2}°");
        let angle = turn.length();
        Ok(self.rotation(if angle > 0.0 { turn } else { DVec3::Y }, angle))
    }

    fn rotation(&self, axis: DVec3, angle: f64) -> Command {
        Rotate {
            angle,
            axis: axis.to_array(),
            center: self.center(),
            space: TransformSpace::World,
            individual: self.individual(),
            proportional: self.proportional(),
        }
        .into()
    }
}
