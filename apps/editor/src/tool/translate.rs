//! Moving, rotating and scaling: from the pointer or typed numbers to the offset, to axis and angle, and to
//! factors along axes.

use trigon_document::mesh::math::{DMat3, DVec3};
use trigon_document::{Command, Rotate, Scale, TransformSpace, Translate};

use super::constraint::Freedom;
use super::numeric::NumericEntry;
use super::snap::{SnapTarget, rounded, rounded_along};
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
                let position = self.modal.pointer.in_window().unwrap_or_default();
                let through = self.settings.snap.through;
                let found =
                    self.targets.as_ref().and_then(|targets| targets.find(target, view, position, through));
                self.snapped = found;
                let Some(found) = found else { return offset };
                let retained = self.retained.iter().filter(|&&retained| retained != found);
                let (sum, count) =
                    retained.fold((found, 1.0), |(sum, count), retained| (sum + *retained, count + 1.0));
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
pub(super) fn shown(metres: f64) -> String {
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
            angles = [0, 1].map(|index| typed.get(index).copied().flatten().unwrap_or(0.0));
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
        let is_behind = (self.modal.pointer.position() - center).dot(arm) < 0.0;
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
