//! Floats counted in units in the last place.

/// The position of a number among all f32, so that neighbours differ by 1; both zeros
/// are 0.
pub(crate) fn ordinal(value: f32) -> i64 {
    let magnitude = i64::from(value.abs().to_bits());
    if value < 0.0 { -magnitude } else { magnitude }
}

/// The number so many units further on, at most the largest.
pub(crate) fn stepped(value: f32, steps: i64) -> f32 {
    let number = ordinal(value) + steps;
    let largest = i64::from(f32::MAX.to_bits());
    let value = f32::from_bits(number.abs().min(largest) as u32);
    if number < 0 { -value } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_are_one_step_apart() {
        for depth in [0.25_f32, 1.0, 1e-30, -3.5, 0.0] {
            assert_eq!(ordinal(depth.next_up()) - ordinal(depth), 1, "after {depth}");
        }
    }

    #[test]
    fn steps_are_units_in_the_last_place() {
        for depth in [0.5_f32, 1.0, 1e-30, -2.5, 0.0] {
            assert_eq!(stepped(depth, 0), depth, "no step from {depth}");
            assert_eq!(stepped(depth, 2), depth.next_up().next_up(), "two up from {depth}");
            assert_eq!(stepped(depth, -2), depth.next_down().next_down(), "two down from {depth}");
        }
    }
}
