//! Frames along a path that turn around it no more than its bends need, for sweeping a cross-section.

use trigon_math::{DMat3, DVec3, unit_or_zero};

/// Three perpendicular unit vectors at a point of a path.
#[derive(Debug, Clone, Copy)]
pub(super) struct SweepFrame {
    /// Along the path.
    pub(super) tangent: DVec3,
    /// Across it.
    pub(super) right: DVec3,
}

impl SweepFrame {
    /// At the beginning of a path. `right` is the part of a vector that is across the path, or any direction across it
    /// if there is none.
    pub(super) fn new(tangent: DVec3, towards: DVec3) -> Self {
        let tangent = match unit_or_zero(tangent) {
            DVec3::ZERO => DVec3::Z,
            tangent => tangent,
        };
        Self { tangent, right: across(tangent, towards) }
    }

    /// The third direction: the tangent, `right` and it are right-handed.
    pub(super) fn up(&self) -> DVec3 {
        self.tangent.cross(self.right)
    }

    /// Its directions as columns.
    pub(super) fn axes(&self) -> DMat3 {
        DMat3::from_cols(self.tangent, self.right, self.up())
    }

    /// The frame at the next point of the path, which is a step away and has another tangent: W. Wang, B. Jüttler,
    /// D. Zheng and Y. Liu, "Computation of Rotation Minimizing Frames", 2008, by two reflections. Its error shrinks
    /// with the fourth power of the length of steps.
    pub(super) fn after(&self, step: DVec3, tangent: DVec3) -> Self {
        let next = match unit_or_zero(tangent) {
            DVec3::ZERO => self.tangent,
            tangent => tangent,
        };
        // Without a step, or where the path turns back, the shorter rotation between both tangents is as good as any.
        let step = if unit_or_zero(step) == DVec3::ZERO { self.tangent + next } else { step };
        let (right, along) = (reflected(self.right, step), reflected(self.tangent, step));
        Self { tangent: next, right: across(next, reflected(right, next - along)) }
    }
}

/// A vector as seen in a mirror that is perpendicular to another; itself if that has no direction.
fn reflected(vector: DVec3, normal: DVec3) -> DVec3 {
    let normal = unit_or_zero(normal);
    vector - normal * (2.0 * normal.dot(vector))
}

/// The direction of the part of a vector that is perpendicular to a unit vector; any perpendicular if there is none.
fn across(tangent: DVec3, vector: DVec3) -> DVec3 {
    let part = |vector: DVec3| unit_or_zero(vector - tangent * tangent.dot(vector));
    let least = tangent.abs();
    let axis = if least.x <= least.y && least.x <= least.z {
        DVec3::X
    } else if least.y <= least.z {
        DVec3::Y
    } else {
        DVec3::Z
    };
    // What is across but for rounding has a direction that is only rounding.
    let has_part = (vector - tangent * tangent.dot(vector)).length() > 1e-9 * vector.length();
    if has_part { part(vector) } else { part(axis) }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, TAU};

    use trigon_math::elementary::sin_cos;

    use super::*;

    /// Along a helix around Z, a frame turns against the one of its curvature by its torsion times its length: Frenet's
    /// formulas.
    #[test]
    fn along_a_helix_frames_turn_by_the_torsion() {
        let (radius, slope, steps) = (2.0_f64, 0.5_f64, 400);
        let at = |i: usize| {
            let (sin, cos) = sin_cos(TAU * i as f64 / f64::from(steps));
            let angle = TAU * i as f64 / f64::from(steps);
            (
                DVec3::new(radius * cos, radius * sin, slope * angle),
                DVec3::new(-radius * sin, radius * cos, slope),
            )
        };
        let mut frame = SweepFrame::new(at(0).1, DVec3::NEG_X);
        for i in 1..=steps as usize {
            frame = frame.after(at(i).0 - at(i - 1).0, at(i).1);
        }
        // The normal of the curve is again −X after a turn.
        let length = TAU * (radius * radius + slope * slope).sqrt();
        let torsion = slope / (radius * radius + slope * slope);
        let (sin, cos) = sin_cos(-torsion * length);
        let binormal = frame.tangent.cross(DVec3::NEG_X);
        let expected = DVec3::NEG_X * cos + binormal * sin;
        assert!(frame.right.distance(expected) < 1e-6, "{} for {expected}", frame.right);
    }

    #[test]
    fn frames_are_perpendicular_whatever_the_path_does() {
        let bends = [DVec3::X, DVec3::NEG_X, DVec3::ZERO, DVec3::new(0.0, 1e-300, 0.0), DVec3::NAN, DVec3::Y];
        for step in bends {
            for tangent in bends {
                let frame = SweepFrame::new(DVec3::X, DVec3::new(5.0, 0.0, 2.0)).after(step, tangent);
                assert!(frame.tangent.dot(frame.right).abs() < 1e-12, "{step} and {tangent}");
                assert!((frame.axes().determinant() - 1.0).abs() < 1e-12, "{step} and {tangent}");
            }
        }
        let quarter = SweepFrame::new(DVec3::X, DVec3::Y).after(DVec3::new(1.0, 1.0, 0.0), DVec3::Y);
        let (sin, cos) = sin_cos(FRAC_PI_2);
        assert!(
            quarter.right.distance(DVec3::new(-sin, cos, 0.0)) < 1e-12,
            "a bend in the plane turns it along"
        );
    }
}
