//! What is stored for vertex groups: the weight of each vertex, and names. The rest is in `vertex_groups`.

/// The weight of a vertex in a group; negative for one that is not in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GroupWeight(f32);

impl GroupWeight {
    pub(super) const NONE: Self = Self(-1.0);

    /// A weight from 0 to 1, or none.
    pub(super) fn new(weight: Option<f32>) -> Self {
        weight.map_or(Self::NONE, Self)
    }

    pub(super) fn get(self) -> Option<f32> {
        (self.0 >= 0.0).then_some(self.0)
    }

    /// Whether it is none, or in its range.
    pub(super) fn is_valid(self) -> bool {
        self == Self::NONE || (0.0..=1.0).contains(&self.0)
    }

    /// Between a vertex in a group and one outside, a vertex is in it: the other one counts as 0.
    pub(super) fn blended(parts: &[(Self, f64)]) -> Self {
        let counted = || parts.iter().filter(|(_, part)| *part != 0.0);
        if counted().all(|(weight, _)| weight.get().is_none()) {
            return Self::NONE;
        }
        let sum: f64 = counted().map(|(weight, part)| f64::from(weight.get().unwrap_or(0.0)) * part).sum();
        // Beyond all vertices it is as at the nearest; a sum that is not a number is 0.
        Self(if sum > 0.0 { sum.min(1.0) as f32 } else { 0.0 })
    }
}

impl Default for GroupWeight {
    fn default() -> Self {
        Self::NONE
    }
}

/// The name of a group, and the number of its layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct GroupName {
    pub(super) name: String,
    pub(super) layer: u16,
}

/// The numbers of the layers of one group in two meshes.
#[derive(Debug, Clone, Copy)]
pub(super) struct GroupLayers {
    pub(super) own: u16,
    pub(super) theirs: u16,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_a_vertex_in_a_group_and_one_outside_is_half_the_weight() {
        let of = |weight| GroupWeight::new(Some(weight));
        let blend = |parts: &[(GroupWeight, f64)]| GroupWeight::blended(parts).get();
        assert_eq!(blend(&[(of(0.5), 0.5), (GroupWeight::NONE, 0.5)]), Some(0.25));
        assert_eq!(blend(&[(GroupWeight::NONE, 0.5), (GroupWeight::NONE, 0.5)]), None, "outside");
        assert_eq!(blend(&[(GroupWeight::NONE, 1.0), (of(1.0), 0.0)]), None, "at the vertex outside");
        assert_eq!(blend(&[(of(0.3), 1.0)]), Some(0.3), "to the bit");
        assert_eq!(blend(&[(of(1.0), 1.5), (of(0.25), -0.5)]), Some(1.0), "beyond");
        assert_eq!(blend(&[(of(0.0), 1.5), (of(1.0), -0.5)]), Some(0.0), "beyond the other");
    }
}
