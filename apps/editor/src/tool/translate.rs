//! Moving: from the pointer or typed numbers to the offset.

use trigon_document::mesh::math::{DMat3, DVec3};
use trigon_document::{Command, TransformSpace, Translate};

use super::constraint::Freedom;
use super::numeric::NumericEntry;
use super::snap::{SnapTarget, rounded_along};
use super::transform::TransformTool;
use super::view::ToolView;

impl TransformTool {
    /// The command that moves the selection to where the pointer or the numbers take it.
    pub(super) fn translate(&mut self, view: &ToolView) -> Result<Command, String> {
        let axes = self.constraint.axes(&self.frames);
        let freedom = self.constraint.freedom();
        let offset = match typed_offset(&self.modal.numeric, freedom, &axes)? {
            Some(offset) => offset,
            None => self.dragged_offset(view),
        };
        let [x, y, z] = (axes.transpose() * offset).to_array().map(shown);
        self.text = format!("Move ({x}, {y}, {z}) m, {} m", shown(offset.length()));
        Ok(Translate {
            offset: offset.to_array(),
            space: TransformSpace::World,
            proportional: self.proportional(),
        }
        .into())
    }

    fn dragged_offset(&mut self, view: &ToolView) -> DVec3 {
        let from = self.source.unwrap_or_else(|| self.selected.median());
        let way = self.modal.pointer.way();
        let axis = self.constraint.axis(&self.frames);
        let offset = match (self.constraint.freedom(), axis) {
            (Some(Freedom::Along(_)), Some(axis)) => axis * view.dragged_along(from, axis, way),
            (Some(Freedom::Across(_)), Some(normal)) => view.dragged_within(from, normal, way),
            _ => view.dragged(from, way),
        };
        self.snapped = None;
        if self.snaps() { self.snapped_offset(view, from, offset) } else { offset }
    }

    fn snapped_offset(&mut self, view: &ToolView, from: DVec3, offset: DVec3) -> DVec3 {
        let step = self.settings.snap.length_step(self.modal.is_precise());
        let axes = self.constraint.axes(&self.frames);
        let target = self.settings.snap.target;
        let snapped = match target {
            SnapTarget::Increment => rounded_along(offset, &axes, step),
            SnapTarget::Grid => rounded_along(from + offset, &DMat3::IDENTITY, step) - from,
            SnapTarget::Vertex | SnapTarget::Edge | SnapTarget::Face => {
                let place = self.modal.pointer.in_window().unwrap_or_default();
                let through = self.settings.snap.through;
                let found =
                    self.targets.as_ref().and_then(|targets| targets.find(target, view, place, through));
                self.snapped = found;
                let Some(found) = found else { return offset };
                let kept = self.kept.iter().filter(|&&kept| kept != found);
                let (sum, count) = kept.fold((found, 1.0), |(sum, count), kept| (sum + *kept, count + 1.0));
                let found = sum / count;
                let source = self.source;
                found
                    - source.unwrap_or_else(|| self.settings.snap.source.point(&self.selected, offset, found))
            }
        };
        within_lock(snapped, self.constraint.freedom(), &axes)
    }
}

/// With four digits after the point, and no minus before a zero.
fn shown(metres: f64) -> String {
    let text = format!("{metres:.4}");
    if text == "-0.0000" { "0.0000".into() } else { text }
}

/// What a lock leaves of an offset.
fn within_lock(offset: DVec3, freedom: Option<Freedom>, axes: &DMat3) -> DVec3 {
    let Some(freedom) = freedom else { return offset };
    let axis = axes.col(freedom.axis().index());
    let along = axis * offset.dot(axis);
    match freedom {
        Freedom::Along(_) => along,
        Freedom::Across(_) => offset - along,
    }
}

/// The offset that typed numbers mean: along the axes that are free, in their order.
pub(super) fn typed_offset(
    numeric: &NumericEntry,
    freedom: Option<Freedom>,
    axes: &DMat3,
) -> Result<Option<DVec3>, String> {
    if !numeric.is_active() {
        return Ok(None);
    }
    let values = numeric.values().map_err(|error| error.to_string())?;
    let free = (0..3).filter(|&axis| match freedom {
        None => true,
        Some(Freedom::Along(along)) => along.index() == axis,
        Some(Freedom::Across(across)) => across.index() != axis,
    });
    Ok(Some(free.zip(values).map(|(axis, value)| axes.col(axis) * value.unwrap_or(0.0)).sum()))
}
