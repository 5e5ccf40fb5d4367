//! Keyframes of any numbers: rotations and vectors in steps, lines and cubic splines, against appendix C of the
//! glTF 2.0 specification written again in plain f64.

use proptest::prelude::*;
use trigon_math::{DQuat, DVec3};
use trigon_scene::{Animation, Channel, Curve, Interpolation, Node, NodePose, Property, Scene, Transform};

use crate::effort::cases;

/// Keyframes of four numbers. With splines each has an incoming tangent, a value and an outgoing tangent.
#[derive(Clone, Debug)]
struct Keys {
    interpolation: Interpolation,
    times: Vec<f32>,
    vectors: Vec<[[f32; 4]; 3]>,
}

/// Usual numbers, and any that are finite.
fn number() -> impl Strategy<Value = f32> {
    let any = any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |number| number.is_finite());
    prop_oneof![8 => -1.0_f32..1.0, 2 => -100.0_f32..100.0, 1 => Just(0.0), 1 => any]
}

fn keys() -> impl Strategy<Value = (Keys, f64)> {
    let interpolation =
        prop_oneof![Just(Interpolation::Step), Just(Interpolation::Linear), Just(Interpolation::CubicSpline)];
    let vector = || [number(), number(), number(), number()];
    // Equal, opposite and near neighbours besides.
    let key = ([vector(), vector(), vector()], prop::sample::select(vec![0_u8, 0, 0, 1, 2, 3]));
    let start = prop_oneof![Just(0.0_f32), -1e3_f32..1e3, -1e-3_f32..1e-3];
    let step = prop_oneof![4 => 1e-3_f32..10.0, 1 => 1e-30_f32..1e-3, 1 => 10.0_f32..1e30];
    let keys = prop::collection::vec((key, step), 1..6);
    // From before the first keyframe to after the last.
    (interpolation, start, keys, -0.2_f64..1.2, any::<bool>()).prop_map(
        |(interpolation, start, keys, share, is_at_key)| {
            let (mut times, mut vectors) = (vec![], Vec::<[[f32; 4]; 3]>::new());
            let mut time = start;
            for ((mut vector, like_the_last), step) in keys {
                if let Some(last) = vectors.last() {
                    match like_the_last {
                        1 => vector[1] = last[1],
                        2 => vector[1] = last[1].map(|value| -value),
                        3 => vector[1] = last[1].map(|value| value * (1.0 + f32::EPSILON)),
                        _ => {}
                    }
                }
                vectors
                    .push(vector.map(|part| part.map(|value| if value.is_finite() { value } else { 1.0 })));
                times.push(time);
                time = (time + step).max(time.next_up());
            }
            let (first, last) = (f64::from(times[0]), f64::from(times[times.len() - 1]));
            let key = (share.clamp(0.0, 0.99) * times.len() as f64) as usize;
            let at = if is_at_key { f64::from(times[key]) } else { first + share * (last - first).max(1.0) };
            (Keys { interpolation, times, vectors }, at)
        },
    )
}

impl Keys {
    fn curve(&self, width: usize) -> Curve {
        let parts = if self.interpolation == Interpolation::CubicSpline { 0..3 } else { 1..2 };
        let values = self.vectors.iter().flat_map(|key| key[parts.clone()].iter().flat_map(|v| &v[..width]));
        Curve::new(self.interpolation, width, self.times.clone(), values.copied().collect()).expect("a curve")
    }

    /// The keyframe at or before a time, the share of the way to the next, and the seconds between both; just the
    /// keyframe where none is on one of both sides.
    fn place(&self, time: f64) -> (usize, Option<[f64; 2]>) {
        // Steps are at the numbers that keyframes are.
        let time = if self.interpolation == Interpolation::Step { f64::from(time as f32) } else { time };
        let times: Vec<f64> = self.times.iter().map(|&time| f64::from(time)).collect();
        let last = times.len() - 1;
        if time < times[0] {
            return (0, None);
        }
        let before = (0..=last).rfind(|&key| times[key] <= time).expect("the first is");
        if before == last {
            return (last, None);
        }
        let seconds = times[before + 1] - times[before];
        (before, Some([(time - times[before]) / seconds, seconds]))
    }

    fn value(&self, key: usize) -> [f64; 4] {
        self.vectors[key][1].map(f64::from)
    }

    /// A component at a time, and the sum of the magnitudes of its terms. A spline is the Bézier curve with the same
    /// ends and slopes, by de Casteljau's construction.
    fn component(&self, time: f64, component: usize) -> [f64; 2] {
        let (key, between) = self.place(time);
        let start = self.value(key)[component];
        let Some([t, seconds]) = between else { return [start, start.abs()] };
        let end = self.value(key + 1)[component];
        let between = |a: f64, b: f64| a + (b - a) * t;
        match self.interpolation {
            Interpolation::Step => [start, start.abs()],
            Interpolation::Linear => [between(start, end), start.abs() + end.abs()],
            Interpolation::CubicSpline => {
                let leaving = seconds * f64::from(self.vectors[key][2][component]);
                let arriving = seconds * f64::from(self.vectors[key + 1][0][component]);
                let points = [start, start + leaving / 3.0, end - arriving / 3.0, end];
                let [a, b, c] = [0, 1, 2].map(|i| between(points[i], points[i + 1]));
                let [a, b] = [between(a, b), between(b, c)];
                [between(a, b), start.abs() + end.abs() + leaving.abs() + arriving.abs()]
            }
        }
    }

    /// Whether the ends are at a right angle but for rounding, so that both arcs are equally short.
    fn is_ambiguous(&self, time: f64) -> bool {
        let (key, between) = self.place(time);
        let ends = || Some([unit(self.value(key))?, unit(self.value(key + 1))?]);
        let is_line = self.interpolation == Interpolation::Linear && between.is_some();
        is_line && ends().is_some_and(|[a, b]| (0..4).map(|i| a[i] * b[i]).sum::<f64>().abs() < 1e-15)
    }

    /// The unit quaternion at a time and how far rounding may move it; none where rounding decides whether it has a
    /// length at all.
    fn rotation(&self, time: f64) -> Option<([f64; 4], f64)> {
        let (key, between) = self.place(time);
        if let (Interpolation::Linear, Some([t, _])) = (self.interpolation, between) {
            return Some((arc(unit(self.value(key))?, unit(self.value(key + 1))?, t), 1e-13));
        }
        let parts: [[f64; 2]; 4] = std::array::from_fn(|component| self.component(time, component));
        let length = parts.iter().map(|[value, _]| value * value).sum::<f64>().sqrt();
        let terms: f64 = parts.iter().map(|[_, terms]| terms).sum();
        // Each side rounds a term at most 16 times, and squares below 2^-1022 lose their digits.
        let error = 32.0 * f64::EPSILON * terms / length;
        (length > 1e-150 && error < 0.1).then(|| (parts.map(|[value, _]| value / length), 2.0 * error))
    }
}

fn unit(quaternion: [f64; 4]) -> Option<[f64; 4]> {
    let length = quaternion.iter().map(|value| value * value).sum::<f64>().sqrt();
    (length > 0.0).then(|| quaternion.map(|value| value / length))
}

/// A share of the shorter arc between unit quaternions, by halving the arc that contains it: the middle of an arc is
/// the direction of the sum of its ends.
fn arc(from: [f64; 4], to: [f64; 4], share: f64) -> [f64; 4] {
    let dot: f64 = (0..4).map(|i| from[i] * to[i]).sum();
    let (mut low, mut high) = (from, if dot < 0.0 { to.map(|value| -value) } else { to });
    let mut rest = share;
    for _ in 0..52 {
        let middle = unit(std::array::from_fn(|i| low[i] + high[i])).expect("at most a right angle apart");
        rest *= 2.0;
        if rest < 1.0 {
            high = middle;
        } else {
            (low, rest) = (middle, rest - 1.0);
        }
    }
    low
}

/// The node's own transform where nothing is animated.
const OWN: Transform = Transform::Decomposed {
    translation: DVec3::X,
    rotation: DQuat::from_xyzw(0.0, 0.0, 0.6, 0.8),
    scale: DVec3::ONE,
};

fn posed(property: Property, curve: Curve, time: f64) -> NodePose {
    let mut scene = Scene::new();
    let node = scene.add(Node::default().with_transform(OWN));
    let animation = Animation { name: String::new(), channels: vec![Channel { node, property, curve }] };
    scene.pose(&animation, time).nodes.remove(&node).expect("it is animated")
}

proptest! {
    #![proptest_config(cases(1024))]

    #[test]
    fn rotations_follow_their_keyframes((keys, time) in keys()) {
        let transform = posed(Property::Rotation, keys.curve(4), time).transform;
        let Some(Transform::Decomposed { translation, rotation, scale }) = transform else { panic!("in parts") };
        prop_assert!((rotation.length() - 1.0).abs() < 1e-15, "{rotation} is no unit quaternion");
        prop_assert_eq!((translation, scale), (DVec3::X, DVec3::ONE), "they stay");
        if let Some((exact, bound)) = keys.rotation(time) {
            let found = rotation.to_array();
            let error = (0..4).map(|i| (found[i] - exact[i]).abs()).fold(0.0, f64::max);
            let is_near = error <= bound.max(1e-15);
            prop_assert!(is_near || keys.is_ambiguous(time), "{rotation} at {time}, not {exact:?} ± {bound}");
        }
    }

    #[test]
    fn vectors_follow_their_keyframes((keys, time) in keys()) {
        let transform = posed(Property::Scale, keys.curve(3), time).transform;
        let Some(Transform::Decomposed { scale, .. }) = transform else { panic!("in parts") };
        let weights = posed(Property::MorphWeights, keys.curve(4), time).morph_weights.expect("they are animated");
        for component in 0..3 {
            let [exact, terms] = keys.component(time, component);
            let error = (scale[component] - exact).abs();
            prop_assert!(error <= 32.0 * f64::EPSILON * terms, "{} at {time}, not {exact}", scale[component]);
        }
        for (component, &found) in weights.iter().enumerate() {
            let [exact, terms] = keys.component(time, component);
            let bound = 32.0 * f64::EPSILON * terms;
            let [low, high] = [exact - bound, exact + bound].map(|value| value as f32);
            prop_assert!((low..=high).contains(&found), "{found} at {time}, not {exact}");
        }
    }
}

proptest! {
    #![proptest_config(cases(8))]

    /// Steps with a keyframe at every frame k, at k / fps rounded to f32 as exporters write it, are sampled at k / fps in
    /// f64: frame k shows keyframe k, at every whole rate and also hours later; right before a keyframe the one before it
    /// is shown. With times compared as they are 9 of 25 frames at 24 per second were late by one.
    #[test]
    fn every_frame_at_the_rate_of_its_steps_shows_its_own_keyframe(first in prop_oneof![Just(0_u32), 0..1_u32 << 20]) {
        const KEYS: u32 = 60;
        for fps in 1..=240_u32 {
            let time = |key: u32| f64::from(first + key) / f64::from(fps);
            let times: Vec<f32> = (0..KEYS).map(|key| time(key) as f32).collect();
            let values = (0..KEYS).map(|key| key as f32).collect();
            let curve = Curve::new(Interpolation::Step, 1, times.clone(), values).expect("times are apart");
            for key in 0..KEYS {
                let found = posed(Property::MorphWeights, curve.clone(), time(key)).morph_weights.expect("animated");
                prop_assert_eq!(found[0], key as f32, "frame {} at {} per second", first + key, fps);
                let before = f64::from(times[key as usize].next_down());
                let shown = posed(Property::MorphWeights, curve.clone(), before).morph_weights.expect("animated");
                prop_assert_eq!(shown[0], key.saturating_sub(1) as f32, "before frame {}", first + key);
            }
        }
    }
}
