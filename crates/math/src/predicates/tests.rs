//! Both predicates against wide integers.

use glam::DVec2;
use proptest::prelude::*;

use super::*;
use crate::Fixed;

fn point((x, y): (i32, i32)) -> FixedPoint {
    FixedPoint::new(Fixed::from_raw(x), Fixed::from_raw(y))
}

fn wide(a: (i32, i32), b: (i32, i32), c: (i32, i32)) -> i128 {
    let difference = |p: i32, q: i32| i128::from(p) - i128::from(q);
    difference(b.0, a.0) * difference(c.1, a.1) - difference(b.1, a.1) * difference(c.0, a.0)
}

/// Raw coordinates: anywhere, or at the corners of the proven range.
fn raw() -> impl Strategy<Value = i32> {
    const LIMIT: i32 = 1 << 30;
    prop_oneof![
        -LIMIT..=LIMIT,
        -300..300_i32,
        Just(LIMIT),
        Just(-LIMIT),
        Just(LIMIT - 1),
        // The guard band's corners.
        Just(32_768 << 8),
        Just(-32_768 << 8),
    ]
}

#[test]
fn clockwise_on_the_screen_is_positive() {
    let turn = |c| orientation_fixed(point((0, 0)), point((256, 0)), point(c));
    assert!(turn((256, 256)) > 0, "right, then down");
    assert!(turn((256, -256)) < 0, "right, then up");
    assert_eq!(turn((1024, 0)), 0, "straight on");
}

#[test]
fn the_mathematical_plane_turns_counter_clockwise() {
    let turn = |c| orientation(DVec2::ZERO, DVec2::X, c);
    assert_eq!(turn(DVec2::new(1.0, 1.0)), Orientation::CounterClockwise, "right, then up");
    assert_eq!(turn(DVec2::new(1.0, -1.0)), Orientation::Clockwise, "right, then down");
    assert_eq!(turn(DVec2::new(7.0, 0.0)), Orientation::Collinear, "straight on");
    assert_eq!(turn(DVec2::NAN), Orientation::Collinear, "no turn is proven");
    assert_eq!(turn(DVec2::INFINITY), Orientation::Collinear, "no turn is proven");
}

#[test]
fn no_turn_is_proven_with_a_coordinate_that_is_not_finite() {
    let values = [0.0, 1.0, -3.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for number in 0..values.len().pow(6) {
        let value = |digit: u32| values[number / values.len().pow(digit) % values.len()];
        let [a, b, c] = [0, 2, 4].map(|first| DVec2::new(value(first), value(first + 1)));
        if (0..6).any(|digit| !value(digit).is_finite()) {
            assert_eq!(orientation(a, b, c), Orientation::Collinear, "{a} {b} {c}");
        }
    }
}

/// The nearest neighbours of a point on a line: a rounded cross product gets
/// many of them wrong (Kettner et al., "Classroom examples of robustness
/// problems in geometric computations", 2008).
#[test]
fn a_grid_of_neighbours_is_decided_exactly() {
    let unit = f64::EPSILON / 2.0;
    let (b, c) = (DVec2::splat(12.0), DVec2::splat(24.0));
    let mut rounded_wrongly = 0;
    for i in 0..64_i32 {
        for j in 0..64_i32 {
            let a = DVec2::new(0.5 + f64::from(i) * unit, 0.5 + f64::from(j) * unit);
            // a is right of the diagonal if i > j; b to c runs up the diagonal.
            let expected = match i.cmp(&j) {
                Ordering::Less => Orientation::CounterClockwise,
                Ordering::Equal => Orientation::Collinear,
                Ordering::Greater => Orientation::Clockwise,
            };
            assert_eq!(orientation(a, b, c), expected.reversed().reversed(), "({i}, {j})");
            let rounded = (b - a).perp_dot(c - a);
            rounded_wrongly += i32::from((rounded > 0.0) != (expected == Orientation::CounterClockwise));
        }
    }
    assert!(rounded_wrongly > 100, "the case is hard: only {rounded_wrongly} wrong");
}

proptest! {
    #[test]
    fn fixed_orientation_equals_128_bits(
        a in (raw(), raw()), b in (raw(), raw()), c in (raw(), raw()),
    ) {
        let area = orientation_fixed(point(a), point(b), point(c));
        prop_assert_eq!(i128::from(area), wide(a, b, c));
        prop_assert_eq!(orientation_fixed(point(b), point(c), point(a)), area);
        prop_assert_eq!(orientation_fixed(point(b), point(a), point(c)), -area);
    }

    #[test]
    fn float_orientation_equals_128_bits(
        a in (raw(), raw()), b in (raw(), raw()), c in (raw(), raw()),
        exponent in -300..300_i32,
    ) {
        let scale = crate::elementary::exp2(f64::from(exponent));
        let vector = |(x, y): (i32, i32)| DVec2::new(f64::from(x), f64::from(y)) * scale;
        let expected = match wide(a, b, c).signum() {
            1 => Orientation::CounterClockwise,
            -1 => Orientation::Clockwise,
            _ => Orientation::Collinear,
        };
        prop_assert_eq!(orientation(vector(a), vector(b), vector(c)), expected);
        prop_assert_eq!(orientation(vector(b), vector(a), vector(c)), expected.reversed());
    }

    /// Points that are collinear up to the last bit of f64.
    #[test]
    fn almost_collinear_points_are_decided(
        x in -(1_i64 << 52)..(1_i64 << 52), y in -(1_i64 << 52)..(1_i64 << 52),
        k in -3..4_i64, nudge in -1..=1_i64,
    ) {
        // Coordinates below 2^53 in f64, so the cast is exact.
        let (a, b, c) = ((0, 0), (x / 4, y / 4), (x / 4 * k, y / 4 * k + nudge));
        let exact = i128::from(b.0) * i128::from(c.1) - i128::from(b.1) * i128::from(c.0);
        let vector = |(x, y): (i64, i64)| DVec2::new(x as f64, y as f64);
        let expected = match exact.signum() {
            1 => Orientation::CounterClockwise,
            -1 => Orientation::Clockwise,
            _ => Orientation::Collinear,
        };
        prop_assert_eq!(orientation(vector(a), vector(b), vector(c)), expected);
    }

    /// The determinant in wide integers, for every order of magnitude of each column.
    #[test]
    fn mirrors_are_told_by_exact_determinants(
        entries in prop::array::uniform9(-(1_i64 << 30)..(1_i64 << 30)),
        nearly_flat in any::<bool>(), nudge in -1..=1_i64,
        exponents in prop::array::uniform3(-900..900_i32),
    ) {
        let [a, b, c, d, e, f, mut g, mut h, mut i] = entries.map(i128::from);
        if nearly_flat {
            // The third column is the sum of the others but for one unit.
            (g, h, i) = (a + d, b + e, c + f + i128::from(nudge));
        }
        let exact = a * (e * i - f * h) - d * (b * i - c * h) + g * (b * f - c * e);
        let column = |entries: [i128; 3], exponent: i32| {
            let power = f64::from_bits(((1023 + exponent) as u64) << 52);
            DVec3::from_array(entries.map(|entry| entry as f64)) * power
        };
        let [x, y, z] = exponents;
        let matrix = DMat3::from_cols(column([a, b, c], x), column([d, e, f], y), column([g, h, i], z));
        prop_assert_eq!(is_mirroring(&matrix), exact < 0);
    }
}

proptest! {
    /// The volume of a tetrahedron in wide integers; the last point is in the plane of the others, or one unit off.
    #[test]
    fn sides_of_triangles_are_exact(
        points in prop::array::uniform3(prop::array::uniform3(-(1_i64 << 30)..(1_i64 << 30))),
        nudge in prop::array::uniform3(-1..=1_i64), is_far in any::<bool>(),
    ) {
        let [a, b, c] = points;
        let sum = |axis: usize| a[axis] + b[axis] - c[axis] + nudge[axis];
        let d = if is_far { [c[1], a[2], b[0]] } else { [sum(0), sum(1), sum(2)] };
        let from_a = |point: [i64; 3]| [0, 1, 2].map(|axis| i128::from(point[axis] - a[axis]));
        let [[bx, by, bz], [cx, cy, cz], [dx, dy, dz]] = [b, c, d].map(from_a);
        let volume =
            dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx);
        let vector = |point: [i64; 3]| DVec3::from_array(point.map(|value| value as f64));
        prop_assert_eq!(side_of_triangle([a, b, c].map(vector), vector(d)), volume.cmp(&0));
    }
}
