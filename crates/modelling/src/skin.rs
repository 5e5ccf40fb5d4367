//! The joints that one vertex follows.

use std::cmp::Ordering;

/// The most joints that a vertex follows while it is edited.
pub(super) const MOST: usize = 8;

/// More than the sum of [`MOST`] weights that were rounded to f32 can be off.
const ROUNDING: f64 = 1e-6;

/// Joints and their weights, the heaviest first. Weights sum to 1, unless all are 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Influences {
    pub(super) joints: [u16; MOST],
    pub(super) weights: [f32; MOST],
}

impl Influences {
    /// From any number of joints, each at most once: the heaviest [`MOST`], so scaled that they
    /// sum to 1. Weights that do so already, but for rounding, keep their bits. Joints with a negative
    /// weight are left out: beyond the vertices between which values are blended, the joint of the far one
    /// would push.
    pub(super) fn heaviest(mut all: Vec<(u16, f64)>) -> Self {
        all.retain(|&(_, weight)| weight > 0.0);
        all.sort_by(|a, b| b.1.partial_cmp(&a.1).unwrap_or(Ordering::Equal).then(a.0.cmp(&b.0)));
        all.truncate(MOST);
        let sum: f64 = all.iter().map(|(_, weight)| weight).sum();
        let sum = if (sum - 1.0).abs() <= ROUNDING { 1.0 } else { sum };
        let mut influences = Self::default();
        if sum > 0.0 {
            for (slot, (joint, weight)) in all.into_iter().enumerate() {
                influences.joints[slot] = joint;
                influences.weights[slot] = (weight / sum) as f32;
            }
        }
        influences
    }

    /// The sum of parts of influences.
    pub(super) fn blended(parts: &[(Self, f64)]) -> Self {
        let mut all: Vec<(u16, f64)> = Vec::new();
        for (influences, part) in parts {
            for (&joint, &weight) in influences.joints.iter().zip(&influences.weights) {
                let weight = f64::from(weight) * part;
                match all.iter_mut().find(|(known, _)| *known == joint) {
                    Some((_, sum)) => *sum += weight,
                    None if weight > 0.0 => all.push((joint, weight)),
                    None => {}
                }
            }
        }
        Self::heaviest(all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_way_between_two_vertices_both_joints_count_half() {
        let of = |joint| Influences::heaviest(vec![(joint, 1.0)]);
        let half = Influences::blended(&[(of(3), 0.5), (of(1), 0.5)]);
        assert_eq!((&half.joints[..2], &half.weights[..3]), (&[1, 3][..], &[0.5, 0.5, 0.0][..]), "joints");
        assert_eq!(Influences::blended(&[(half, 1.0)]), half, "nothing is lost");
    }

    #[test]
    fn beyond_a_vertex_no_joint_pushes() {
        let of = |joint| Influences::heaviest(vec![(joint, 1.0)]);
        let beyond = Influences::blended(&[(of(3), 1.5), (of(1), -0.5)]);
        assert_eq!(beyond, of(3), "as at the vertex itself");
        let mixed = Influences::heaviest(vec![(1, 0.5), (3, 0.5)]);
        assert_eq!(Influences::blended(&[(mixed, 2.0), (of(1), -1.0)]), of(3), "one joint is gone");
    }

    #[test]
    fn of_many_joints_the_heaviest_stay_and_sum_to_one() {
        let kept = Influences::heaviest((0..12).map(|joint| (joint, f64::from(joint))).collect());
        assert_eq!(kept.joints, [11, 10, 9, 8, 7, 6, 5, 4], "the heaviest");
        let sum: f32 = kept.weights.iter().sum();
        assert!((sum - 1.0).abs() < 1e-6, "rounded sum of eight is {sum}");
    }

    #[test]
    fn weights_that_are_scaled_stay_as_they_are() {
        let thirds = Influences::heaviest(vec![(0, 1.0), (1, 1.0), (2, 1.0), (3, 4.0)]);
        let again = |from: Influences| {
            let all = from.joints.into_iter().zip(from.weights.map(f64::from));
            Influences::heaviest(all.filter(|&(_, weight)| weight > 0.0).collect())
        };
        assert_eq!(again(thirds), thirds, "to the last bit");
    }
}
