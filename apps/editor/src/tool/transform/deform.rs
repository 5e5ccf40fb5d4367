//! Shrink and fatten, push and pull, to sphere: one number from the pointer, which grows upwards and
//! rightwards.

use trigon_document::{Command, PushPull, ShrinkFatten, ToSphere};

use super::super::snap::rounded;
use super::super::view::ToolView;
use super::TransformTool;
use crate::tool::TransformKind;

/// Logical pixels from 0 to a whole sphere.
const WHOLE_SPHERE: f64 = 200.0;

impl TransformTool {
    /// The command that deforms the selection by what the pointer or the numbers say.
    pub(super) fn deform(&mut self, view: &ToolView) -> Result<Command, String> {
        let way = self.modal.pointer.way();
        let (dragged, step) = if self.kind == TransformKind::ToSphere {
            let factor = (way.x / (WHOLE_SPHERE * view.scale)).clamp(0.0, 1.0);
            (factor, self.settings.snap.factor_step(self.modal.is_precise()))
        } else {
            let up = -way.y * view.metres_per_pixel(self.pivot());
            (up, self.settings.snap.length_step(self.modal.is_precise()))
        };
        let typed = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())?;
        let amount = typed.unwrap_or(if self.snaps() { rounded(dragged, step) } else { dragged });
        let proportional = self.proportional();
        let (text, command) = match self.kind {
            TransformKind::ToSphere => (
                format!("To Sphere {amount:.4}"),
                ToSphere { factor: amount, center: None, proportional }.into(),
            ),
            TransformKind::PushPull => {
                let command = PushPull { distance: amount, center: None, proportional };
                (format!("Push/Pull {amount:.4} m"), command.into())
            }
            _ => {
                let command = ShrinkFatten { distance: amount, proportional };
                (format!("Shrink/Fatten {amount:.4} m"), command.into())
            }
        };
        self.text = text;
        Ok(command)
    }
}
