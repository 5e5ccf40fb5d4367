//! Animations: curves over time for properties of nodes. A curve has keyframes and interpolation (glTF 2.0 specification,
//! appendix C); a channel names the property and the node. `scene/pose` computes the state of an animation at one moment.

use trigon_math::{DQuat, elementary};

use crate::node::NodeId;

/// The interpolation between two keyframes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// The value of the earlier one.
    Step,
    /// Linear; for rotations the shortest arc, at constant speed.
    #[default]
    Linear,
    /// A cubic Hermite spline with tangents from the file.
    CubicSpline,
}

/// Vectors of one width over time.
///
/// Guaranteed: at least one keyframe, times that are finite and increase, and one value per
/// keyframe, or three with cubic splines.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    interpolation: Interpolation,
    width: usize,
    times: Vec<f32>,
    values: Vec<f32>,
}

/// The position of a time among the keyframes.
#[derive(Clone, Copy)]
enum CurvePosition {
    /// At a keyframe, or before the first or after the last.
    At(usize),
    /// Between two keyframes.
    Between {
        from: usize,
        /// 0 at the earlier, 1 at the later.
        share: f64,
        /// Seconds between the two.
        seconds: f64,
    },
}

impl Curve {
    /// A curve of vectors with `width` numbers. `times` are seconds. `values` has one vector per
    /// keyframe; with cubic splines three: the incoming tangent, the value, the outgoing tangent,
    /// both per second.
    ///
    /// `None` if the lengths do not match, there is no keyframe, a time is not finite, or they do
    /// not increase. Values that are not finite become 0.
    #[must_use]
    pub fn new(
        interpolation: Interpolation,
        width: usize,
        times: Vec<f32>,
        mut values: Vec<f32>,
    ) -> Option<Self> {
        let each = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let needed = times.len().checked_mul(each)?.checked_mul(width)?;
        let increase = times.windows(2).all(|pair| pair[0] < pair[1]);
        if times.is_empty() || width == 0 || values.len() != needed || !increase || !times[0].is_finite() {
            return None;
        }
        if !times[times.len() - 1].is_finite() {
            return None;
        }
        values.iter_mut().filter(|value| !value.is_finite()).for_each(|value| *value = 0.0);
        Some(Self { interpolation, width, times, values })
    }

    /// The number of components of a vector.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// The interpolation between keyframes.
    #[must_use]
    pub fn interpolation(&self) -> Interpolation {
        self.interpolation
    }

    /// The times of the keyframes in seconds, increasing.
    #[must_use]
    pub fn times(&self) -> &[f32] {
        &self.times
    }

    /// The numbers of all keyframes, as [`Self::new`] takes them.
    #[must_use]
    pub fn values(&self) -> &[f32] {
        &self.values
    }

    /// The vector at a time in seconds. Before the first keyframe, and for NaN, it is the first
    /// one's; after the last, the last one's. With [`Interpolation::Step`] the time is rounded to f32
    /// as keyframes are, so that a keyframe written for the time k / 24 is reached at k / 24 in f64.
    #[must_use]
    pub fn at(&self, time: f64) -> Vec<f64> {
        let position = self.locate(time);
        (0..self.width).map(|channel| self.component(position, channel)).collect()
    }

    /// [`Self::at`] for vectors of three numbers; missing ones are 0.
    pub(crate) fn vector(&self, time: f64) -> [f64; 3] {
        let position = self.locate(time);
        [0, 1, 2].map(|channel| if channel < self.width { self.component(position, channel) } else { 0.0 })
    }

    /// The curve as a rotation, its vectors as quaternions (x, y, z, w): linear ones rotate about
    /// one axis, and the result is a unit quaternion. `None` if vectors do not have four numbers,
    /// or the result has no length.
    pub(crate) fn rotation(&self, time: f64) -> Option<DQuat> {
        if self.width != 4 {
            return None;
        }
        let position = self.locate(time);
        match (self.interpolation, position) {
            (Interpolation::Linear, CurvePosition::Between { from, share, .. }) => slerp(
                self.quaternion(CurvePosition::At(from))?,
                self.quaternion(CurvePosition::At(from + 1))?,
                share,
            ),
            (Interpolation::Linear, CurvePosition::At(_))
            | (Interpolation::Step | Interpolation::CubicSpline, _) => self.quaternion(position),
        }
    }

    fn quaternion(&self, position: CurvePosition) -> Option<DQuat> {
        let [x, y, z, w] = [0, 1, 2, 3].map(|channel| self.component(position, channel));
        unit(DQuat::from_xyzw(x, y, z, w))
    }

    fn locate(&self, time: f64) -> CurvePosition {
        // Keyframes are numbers of f32. The time k / fps in f64 lies before its own keyframe, wherever f32
        // rounds that up: a step would show the value before. Rounded to f32, both are the same number.
        // Between other keyframes nothing jumps, and the time stays as precise as it is.
        let time = if self.interpolation == Interpolation::Step { f64::from(time as f32) } else { time };
        // The number of keyframes at or before the time.
        let passed = self.times.partition_point(|&key| f64::from(key) <= time);
        if passed == 0 || passed == self.times.len() {
            return CurvePosition::At(passed.saturating_sub(1));
        }
        let (start, end) = (f64::from(self.times[passed - 1]), f64::from(self.times[passed]));
        let seconds = end - start;
        CurvePosition::Between { from: passed - 1, share: (time - start) / seconds, seconds }
    }

    fn component(&self, position: CurvePosition, channel: usize) -> f64 {
        let (each, middle) = if self.interpolation == Interpolation::CubicSpline { (3, 1) } else { (1, 0) };
        let number =
            |key: usize, part: usize| f64::from(self.values[(key * each + part) * self.width + channel]);
        let (from, t, seconds) = match position {
            CurvePosition::At(key) => return number(key, middle),
            CurvePosition::Between { from, share, seconds } => (from, share, seconds),
        };
        let (start, end) = (number(from, middle), number(from + 1, middle));
        match self.interpolation {
            Interpolation::Step => start,
            Interpolation::Linear => start * (1.0 - t) + end * t,
            Interpolation::CubicSpline => {
                let (leaving, arriving) = (seconds * number(from, 2), seconds * number(from + 1, 0));
                let (square, cube) = (t * t, t * t * t);
                (2.0 * cube - 3.0 * square + 1.0) * start
                    + (cube - 2.0 * square + t) * leaving
                    + (3.0 * square - 2.0 * cube) * end
                    + (cube - square) * arriving
            }
        }
    }
}

/// Spherical linear interpolation of unit quaternions along the shorter arc.
fn slerp(from: DQuat, to: DQuat, t: f64) -> Option<DQuat> {
    // For smaller angles, the sine in the denominator loses more accuracy than the difference
    // between chord and arc.
    const NEAR: f64 = 1.0 - 1e-9;
    let cosine = from.dot(to);
    let (to, cosine) = if cosine < 0.0 { (-to, -cosine) } else { (to, cosine) };
    if cosine > NEAR {
        return unit(from * (1.0 - t) + to * t);
    }
    let angle = elementary::acos(cosine);
    let sine = elementary::sin(angle);
    let (early, late) = (elementary::sin(angle * (1.0 - t)) / sine, elementary::sin(angle * t) / sine);
    unit(from * early + to * late)
}

fn unit(rotation: DQuat) -> Option<DQuat> {
    let length = rotation.length();
    (length > 0.0 && length.is_finite()).then(|| rotation / length)
}

/// The property of a node that changes, and the width of the curve's vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Property {
    /// Three numbers: metres in the parent's space.
    Translation,
    /// Four numbers: a quaternion, x, y, z, w.
    Rotation,
    /// Three factors.
    Scale,
    /// One number for each morph target of the node's mesh.
    MorphWeights,
}

/// A curve for one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct Channel {
    /// The node; a channel of a removed node does nothing.
    pub node: NodeId,
    /// Which.
    pub property: Property,
    /// Over time.
    pub curve: Curve,
}

/// An animation. If several channels change the same property of the same node, the last one
/// counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// A display name; need not be unique.
    pub name: String,
    /// What moves.
    pub channels: Vec<Channel>,
}

impl Animation {
    /// Seconds from 0 to its last keyframe; 0 without keyframes. The caller decides whether it
    /// repeats: `time % duration`.
    #[must_use]
    pub fn duration(&self) -> f64 {
        let ends = self.channels.iter().filter_map(|channel| channel.curve.times().last());
        ends.fold(0.0, |longest, &end| if f64::from(end) > longest { f64::from(end) } else { longest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(interpolation: Interpolation, width: usize, times: &[f32], values: &[f32]) -> Curve {
        Curve::new(interpolation, width, times.to_vec(), values.to_vec()).expect("a curve")
    }

    #[test]
    fn steps_and_lines_hold_beyond_their_ends() {
        let (times, values) = ([1.0, 2.0, 4.0], [10.0, 20.0, 0.0]);
        let check = |interpolation, expected: [(f64, f64); 7]| {
            let curve = curve(interpolation, 1, &times, &values);
            for (time, value) in expected {
                assert_eq!(curve.at(time), [value], "{interpolation:?} at {time}");
            }
        };
        let nan = f64::NAN;
        let step =
            [(0.0, 10.0), (1.0, 10.0), (1.75, 10.0), (2.0, 20.0), (3.0, 20.0), (9.0, 0.0), (nan, 10.0)];
        check(Interpolation::Step, step);
        let line =
            [(0.0, 10.0), (1.0, 10.0), (1.75, 17.5), (2.0, 20.0), (3.0, 10.0), (9.0, 0.0), (nan, 10.0)];
        check(Interpolation::Linear, line);
    }

    #[test]
    fn a_cubic_spline_is_the_hermite_polynomial() {
        // . t³ from 0 to 2 seconds: value 0 and 8, slope 0 and 12. A cubic is reproduced exactly.
        let curve = curve(Interpolation::CubicSpline, 1, &[0.0, 2.0], &[9.0, 0.0, 0.0, 12.0, 8.0, 9.0]);
        for time in [0.0, 0.3, 1.0, 1.7, 2.0] {
            let [value] = curve.at(time)[..] else { panic!("one number") };
            assert!((value - time * time * time).abs() < 1e-14, "{value} at {time}");
        }
    }

    #[test]
    fn linear_rotations_turn_evenly_and_the_short_way() {
        let turn = |angle: f64| {
            let (sine, cosine) = elementary::sin_cos(angle / 2.0);
            [0.0, sine as f32, 0.0, cosine as f32]
        };
        let mut values = [turn(0.0), turn(1.0)].concat();
        for negated in [false, true] {
            if negated {
                values[4..].iter_mut().for_each(|value| *value = -*value);
            }
            let curve = curve(Interpolation::Linear, 4, &[0.0, 1.0], &values);
            let rotation = curve.rotation(0.25).expect("a rotation");
            let (sine, cosine) = elementary::sin_cos(0.125);
            let exact = DQuat::from_xyzw(0.0, sine, 0.0, cosine);
            assert!((rotation - exact).length() < 1e-7, "a quarter of the way: {rotation}");
        }
        let still = curve(Interpolation::Linear, 4, &[0.0, 1.0], &[turn(0.5), turn(0.5)].concat());
        assert!(still.rotation(0.5).expect("a rotation").is_normalized(), "no division by zero");
        let none = curve(Interpolation::Linear, 4, &[0.0], &[0.0; 4]);
        assert_eq!(none.rotation(0.0), None, "no length, no rotation");
    }

    #[test]
    fn broken_curves_are_refused() {
        let new = |times: &[f32], values: usize| {
            Curve::new(Interpolation::Linear, 3, times.to_vec(), vec![0.0; values]).is_some()
        };
        assert!(new(&[0.0, 1.0], 6), "the right length");
        assert!(!new(&[0.0, 1.0], 5), "too short");
        assert!(!new(&[], 0), "no keyframe");
        assert!(!new(&[1.0, 1.0], 6), "two at one time");
        assert!(!new(&[0.0, f32::NAN], 6) && !new(&[f32::NAN], 3), "not a number");
        assert!(!new(&[0.0, f32::INFINITY], 6) && !new(&[f32::NEG_INFINITY, 0.0], 6), "not finite");
    }
}
