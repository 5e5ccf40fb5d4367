//! Which joints each vertex follows, and how strongly.

/// For each vertex the same number of joints with their weights.
///
/// Guaranteed: every weight is within 0…1 and those of a vertex sum to 1 (but
/// for rounding).
#[derive(Debug, Clone, PartialEq)]
pub struct SkinWeights {
    per_vertex: usize,
    joints: Vec<u16>,
    weights: Vec<f32>,
}

impl SkinWeights {
    /// Joints and weights, `per_vertex` of each for every vertex in turn; none
    /// when the lists are not that long, or `per_vertex` is 0.
    ///
    /// Weights are divided by their sum. One that is negative or not finite
    /// counts as 0, and a vertex without any weight follows its first joint.
    pub fn new(per_vertex: usize, joints: Vec<u16>, mut weights: Vec<f32>) -> Option<Self> {
        if per_vertex == 0 || joints.len() != weights.len() || !joints.len().is_multiple_of(per_vertex) {
            return None;
        }
        weights.chunks_exact_mut(per_vertex).for_each(normalize);
        Some(Self { per_vertex, joints, weights })
    }

    /// The same from weights that [`Self::weights`] gave: they are kept to the last
    /// bit. None also when they are not within 0…1 with a sum of 1 for each vertex.
    #[must_use]
    pub fn from_normalized(per_vertex: usize, joints: Vec<u16>, weights: Vec<f32>) -> Option<Self> {
        /// More than a sum of rounded weights can be off, for any number of joints in use.
        const ROUNDING: f64 = 1e-3;
        if per_vertex == 0 || joints.len() != weights.len() || !joints.len().is_multiple_of(per_vertex) {
            return None;
        }
        let is_normalized = |weights: &[f32]| {
            let sum: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
            weights.iter().all(|weight| (0.0..=1.0).contains(weight)) && (sum - 1.0).abs() < ROUNDING
        };
        weights.chunks_exact(per_vertex).all(is_normalized).then_some(Self { per_vertex, joints, weights })
    }

    /// How many joints each vertex names, those without weight included.
    #[must_use]
    pub fn per_vertex(&self) -> usize {
        self.per_vertex
    }

    /// How many vertices there are.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.joints.len() / self.per_vertex
    }

    /// The joints of all vertices, [`Self::per_vertex`] each.
    #[must_use]
    pub fn joints(&self) -> &[u16] {
        &self.joints
    }

    /// The weights of all vertices, [`Self::per_vertex`] each.
    #[must_use]
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// The joints of a vertex and their weights, those without weight included.
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn influences(&self, vertex: usize) -> impl Iterator<Item = (u16, f32)> + '_ {
        let range = vertex * self.per_vertex..(vertex + 1) * self.per_vertex;
        self.joints[range.clone()].iter().copied().zip(self.weights[range].iter().copied())
    }

    /// The same for other vertices: new vertex `i` is as `order[i]` was.
    pub(crate) fn reordered(&self, order: impl Iterator<Item = u32>) -> Self {
        let (mut joints, mut weights) = (Vec::new(), Vec::new());
        for from in order {
            let range = from as usize * self.per_vertex..(from as usize + 1) * self.per_vertex;
            joints.extend_from_slice(&self.joints[range.clone()]);
            weights.extend_from_slice(&self.weights[range]);
        }
        Self { per_vertex: self.per_vertex, joints, weights }
    }
}

fn normalize(weights: &mut [f32]) {
    let mut sum = 0.0_f64;
    for weight in &mut *weights {
        if !(*weight > 0.0 && weight.is_finite()) {
            *weight = 0.0;
        }
        sum += f64::from(*weight);
    }
    if sum == 0.0 {
        weights[0] = 1.0;
        return;
    }
    for weight in weights {
        *weight = (f64::from(*weight) / sum) as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_whatever_was_given() {
        let weights = vec![1.0, 3.0, f32::NAN, -1.0, 0.0, f32::INFINITY, f32::MAX, f32::MAX];
        let skin = SkinWeights::new(2, vec![0, 1, 2, 3, 4, 5, 6, 7], weights).expect("two for each of four");
        assert_eq!(skin.weights(), [0.25, 0.75, 1.0, 0.0, 1.0, 0.0, 0.5, 0.5], "normalized");
        assert_eq!(skin.influences(3).collect::<Vec<_>>(), [(6, 0.5), (7, 0.5)], "of one vertex");
        let again = SkinWeights::from_normalized(2, skin.joints().to_vec(), skin.weights().to_vec());
        assert_eq!(again, Some(skin), "and stay so");
        for wrong in [vec![0.5, 0.75], vec![2.0, -1.0], vec![f32::NAN, 1.0], vec![1.0]] {
            assert_eq!(SkinWeights::from_normalized(2, vec![0; 2], wrong.clone()), None, "{wrong:?}");
        }
        assert_eq!(SkinWeights::new(2, vec![0; 3], vec![1.0; 3]), None, "half a vertex");
        assert_eq!(SkinWeights::new(0, Vec::new(), Vec::new()), None, "no joints at all");
    }
}
