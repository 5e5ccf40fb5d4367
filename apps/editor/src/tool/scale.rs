//! Scaling: from the pointer or typed numbers to factors along axes.

use trigon_document::mesh::math::DMat3;
use trigon_document::{Command, Scale, TransformSpace};

use super::constraint::Freedom;
use super::snap::rounded;
use super::transform::TransformTool;
use super::view::ToolView;

impl TransformTool {
    /// The command that scales the selection about the pivot.
    pub(super) fn scale(&mut self, view: &ToolView) -> Result<Command, String> {
        let factors = match self.typed_factors()? {
            Some(factors) => factors,
            None => self.free_factors(self.dragged_factor(view)),
        };
        let axes = self.constraint.axes(&self.frames);
        let [x, y, z] = factors;
        self.text = format!("Scale {x:.4}, {y:.4}, {z:.4}");
        Ok(Scale {
            factors,
            orientation: (axes != DMat3::IDENTITY).then(|| axes.to_cols_array_2d()),
            center: self.center(),
            space: TransformSpace::World,
            individual: self.individual(),
            proportional: self.proportional(),
        }
        .into())
    }

    /// How much farther from the pivot the pointer is than it was; negative on the other side.
    fn dragged_factor(&self, view: &ToolView) -> f64 {
        /// A pointer that starts nearer to the pivot than this, in logical pixels, counts as if it started at
        /// this distance.
        const LEAST: f64 = 1.0;
        let Some(center) = view.screen(self.pivot()) else { return 1.0 };
        let arm = self.modal.pointer.start() - center;
        let [now, start] = self.modal.distances(center);
        let factor = now / start.max(LEAST * view.scale);
        let is_behind = (self.modal.pointer.place() - center).dot(arm) < 0.0;
        let factor = if self.modal.pointer.way().length() == 0.0 { 1.0 } else { factor };
        let factor = if is_behind { -factor } else { factor };
        let step = self.settings.snap.factor_step(self.modal.is_precise());
        if self.snaps() { rounded(factor, step) } else { factor }
    }

    /// A factor along the axes that are free.
    fn free_factors(&self, factor: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| match self.constraint.freedom() {
            None => factor,
            Some(Freedom::Along(along)) if along.index() == axis => factor,
            Some(Freedom::Across(across)) if across.index() != axis => factor,
            Some(_) => 1.0,
        })
    }

    /// A single number counts for all axes that are free.
    fn typed_factors(&self) -> Result<Option<[f64; 3]>, String> {
        if !self.modal.numeric.is_active() {
            return Ok(None);
        }
        let values = self.modal.numeric.values().map_err(|error| error.to_string())?;
        if let [Some(factor), ref others @ ..] = values[..]
            && others.iter().all(Option::is_none)
        {
            return Ok(Some(self.free_factors(factor)));
        }
        let mut values = values.into_iter();
        let is_free = self.free_factors(0.0).map(|factor| factor == 0.0);
        Ok(Some(is_free.map(|is_free| if is_free { values.next().flatten().unwrap_or(1.0) } else { 1.0 })))
    }
}
