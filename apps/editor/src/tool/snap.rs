//! Snapping: to increments, to the grid, and to vertices, edges and faces of elements that do not
//! move.

use trigon_document::mesh::math::{DMat3, DVec2, DVec3};

use super::selected::Selected;

/// To what a movement snaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SnapTarget {
    /// Steps from where it started.
    #[default]
    Increment,
    /// Places on the grid.
    Grid,
    /// The nearest vertex in the image.
    Vertex,
    /// The nearest edge in the image.
    Edge,
    /// The face under the pointer.
    Face,
}

/// The point of the selection that is moved onto the target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SnapSource {
    /// The one nearest to the target.
    #[default]
    Closest,
    /// The middle of the box around the selection.
    Center,
    /// The mean.
    Median,
    /// What was selected last.
    Active,
}

/// How tools snap. Ctrl inverts whether they do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SnapSettings {
    /// Whether they snap without Ctrl.
    pub(crate) is_on: bool,
    pub(crate) target: SnapTarget,
    pub(crate) source: SnapSource,
    /// Steps of moves, in metres; also those of the grid.
    pub(crate) step: f64,
    /// Steps of turns, in degrees.
    pub(crate) angle: f64,
    /// Steps of scales.
    pub(crate) factor: f64,
    /// Whether what faces hide is snapped to: X-ray.
    pub(crate) through: bool,
}

impl Default for SnapSettings {
    fn default() -> Self {
        let (target, source) = (SnapTarget::default(), SnapSource::default());
        Self { is_on: false, target, source, step: 1.0, angle: 5.0, factor: 0.1, through: false }
    }
}

/// With Shift a step is divided in so many.
const FINER: f64 = 10.0;
/// The same of turns: from 5° to 1°.
const FINER_ANGLE: f64 = 5.0;

impl SnapSettings {
    /// The step of moves.
    pub(crate) fn length_step(&self, is_precise: bool) -> f64 {
        if is_precise { self.step / FINER } else { self.step }
    }

    /// The step of turns, in degrees.
    pub(crate) fn angle_step(&self, is_precise: bool) -> f64 {
        if is_precise { self.angle / FINER_ANGLE } else { self.angle }
    }

    /// The step of scales.
    pub(crate) fn factor_step(&self, is_precise: bool) -> f64 {
        if is_precise { self.factor / FINER } else { self.factor }
    }
}

/// The nearest multiple of a step; the value itself where the step is none.
pub(crate) fn rounded(value: f64, step: f64) -> f64 {
    let rounded = (value / step).round() * step;
    if rounded.is_finite() { rounded } else { value }
}

/// The same along axes of unit length at right angles.
pub(crate) fn rounded_along(value: DVec3, axes: &DMat3, step: f64) -> DVec3 {
    let inverse = axes.transpose();
    let parts = inverse * value;
    *axes * DVec3::new(rounded(parts.x, step), rounded(parts.y, step), rounded(parts.z, step))
}

impl SnapSource {
    /// The point of a selection, as it started, that is to lie on a target; `offset` is how far it would move
    /// without snapping.
    pub(crate) fn point(self, selected: &Selected, offset: DVec3, target: DVec3) -> DVec3 {
        let distance = |point: &&DVec3| (**point + offset).distance_squared(target);
        let closest = || selected.points.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        match self {
            Self::Closest => closest().copied().unwrap_or_else(|| selected.median()),
            Self::Center => selected.bounds_center(),
            Self::Median => selected.median(),
            Self::Active => selected.active.unwrap_or_else(|| selected.median()),
        }
    }
}

/// The selected point that is drawn nearest to a position, if one is within a distance in pixels.
pub(crate) fn nearest_on_screen(
    points: &[DVec3],
    screen: impl Fn(DVec3) -> Option<DVec2>,
    place: DVec2,
    within: f64,
) -> Option<DVec3> {
    let drawn = points.iter().filter_map(|&point| Some((screen(point)?.distance(place), point)));
    let nearest = drawn.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= within).then_some(nearest.1)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn values_round_to_steps() {
        assert_eq!(rounded(1.4, 1.0), 1.0, "down");
        assert_eq!(rounded(-1.6, 1.0), -2.0, "away from zero");
        assert_eq!(rounded(0.3, 0.0), 0.3, "no step");
        let turned = DMat3::from_cols(DVec3::Y, DVec3::NEG_X, DVec3::Z);
        assert_eq!(rounded_along(DVec3::new(0.4, 1.6, 0.0), &turned, 1.0), DVec3::Y * 2.0, "in other axes");
    }

    #[test]
    fn shift_makes_steps_finer() {
        let settings = SnapSettings::default();
        assert_eq!((settings.length_step(false), settings.length_step(true)), (1.0, 0.1), "moves");
        assert_eq!((settings.angle_step(false), settings.angle_step(true)), (5.0, 1.0), "turns");
        assert_eq!((settings.factor_step(false), settings.factor_step(true)), (0.1, 0.01), "scales");
    }

    #[test]
    fn sources_are_points_of_the_selection() {
        let selected = Selected {
            points: vec![DVec3::ZERO, DVec3::ZERO, DVec3::X * 6.0],
            active: None,
            origin: DVec3::ZERO,
            local: DMat3::IDENTITY,
            normal: DMat3::IDENTITY,
            is_editing: true,
        };
        let source = |source: SnapSource| source.point(&selected, DVec3::X, DVec3::X * 5.0).x;
        assert_eq!(source(SnapSource::Closest), 6.0, "7 is nearer to 5 than 1");
        assert_eq!((source(SnapSource::Center), source(SnapSource::Median)), (3.0, 2.0), "middles");
        assert_eq!(source(SnapSource::Active), 2.0, "the median without an active one");
    }

    proptest! {
        #[test]
        fn rounding_goes_at_most_half_a_step(value in -1e3f64..1e3, step in 0.01f64..10.0) {
            prop_assert!((rounded(value, step) - value).abs() <= step * 0.5 + 1e-9);
        }
    }
}
