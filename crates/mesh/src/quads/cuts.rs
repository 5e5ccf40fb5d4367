//! Cuts several quads at a time, where rounding leaves no doubt.

use trigon_math::AxisProjection;

use super::Quads;
use super::vectors::{Vectors, cross, difference, dot, each, lanes};
use crate::triangulate::{CLEARLY_SHORTER, QuadCut};

/// An area of a parallelogram in a plane is off by at most this share of the sum of the two products whose difference
/// it is: `ccwerrboundA` of J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates", 1997. Coordinates were f32, so no product underflows.
const ERROR: f64 = (3.0 + 8.0 * f64::EPSILON) * (f64::EPSILON / 2.0);

/// Bits that say at which corners a quad turns left, from the first corner on, and whether the second diagonal is clearly
/// shorter.
const BITS: usize = 5;

/// The cut for each pattern of these bits.
const CUTS: [Option<QuadCut>; 1 << BITS] = {
    let mut cuts = [None; 1 << BITS];
    let mut bits = 0;
    while bits < cuts.len() {
        let left = [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0, bits & 8 != 0];
        cuts[bits] = QuadCut::of(left, bits & 16 != 0);
        bits += 1;
    }
    cuts
};

/// From where each quad is seen: along which axis, and with 1 or −1 from which of its ends.
#[derive(Clone, Copy, PartialEq)]
struct Views<const N: usize> {
    axes: [u64; N],
    ends: [f64; N],
}

impl<const N: usize> Quads<N> {
    /// How each quad is cut, as by [`triangulate_polygon`](crate::triangulate_polygon). `None` where that takes a closer
    /// look: where three corners are nearly in one line, or not finite, or where it is doubtful from which side a quad
    /// that crosses itself is seen.
    #[must_use]
    #[inline(always)]
    pub fn cuts(&self) -> [Option<QuadCut>; N] {
        let places = self.wide();
        let [a, b, c, d] = &places;
        let (first, second) = (difference(c, a), difference(d, b));
        let normals = cross(&first, &second);
        let views = Views::along(&longest(&normals), &normals);
        let (areas, errors) = views.turns(&places);
        let (first, second) = (dot(&first, &first), dot(&second, &second));
        let mut bits = [0_u64; N];
        // Of finite corners the sum is finite, too.
        let mut is_certain: [bool; N] = lanes(|lane| first[lane] + second[lane] < f64::INFINITY);
        for lane in 0..N {
            bits[lane] = u64::from(second[lane] < CLEARLY_SHORTER * first[lane]) << 4;
            for corner in 0..4 {
                bits[lane] |= u64::from(areas[corner][lane] > 0.0) << corner;
                is_certain[lane] &= areas[corner][lane].abs() > errors[corner][lane];
            }
        }
        let cuts: [Option<QuadCut>; N] = lanes(|lane| CUTS[bits[lane] as usize].filter(|_| is_certain[lane]));
        let crosses = |cut: &Option<QuadCut>| matches!(cut, Some(QuadCut::Ear(_)));
        if !cuts.iter().any(crosses) {
            return cuts;
        }
        let general = Views::general(&places);
        lanes(|lane| {
            let is_same = (views.axes[lane], views.ends[lane]) == (general.axes[lane], general.ends[lane]);
            cuts[lane].filter(|_| is_same || !crosses(&cuts[lane]))
        })
    }
}

impl<const N: usize> Views<N> {
    /// Along these axes, against normals.
    #[inline(always)]
    fn along(axes: &[u64; N], normals: &Vectors<N>) -> Self {
        let along = chosen(axes, normals);
        Self { axes: *axes, ends: lanes(|lane| if along[lane] < 0.0 { -1.0 } else { 1.0 }) }
    }

    /// From where polygons are seen that are cut in the general way.
    #[inline(always)]
    fn general([a, b, c, d]: &[Vectors<N>; 4]) -> Self {
        let [b, c, d] = [difference(b, a), difference(c, a), difference(d, a)];
        let parts = [cross(&b, &c), cross(&c, &d)];
        let sum: Vectors<N> = each(|axis, lane| parts[0][axis][lane] + parts[1][axis][lane]);
        let magnitude: Vectors<N> =
            each(|axis, lane| parts[0][axis][lane].abs() + parts[1][axis][lane].abs());
        let (of_sum, of_magnitude) = (longest(&sum), longest(&magnitude));
        let axes = lanes(|lane| {
            let [longest, largest] = [sum, magnitude]
                .map(|vectors| vectors.iter().fold(0.0, |most: f64, axis| most.max(axis[lane].abs())));
            if longest > AxisProjection::CANCELLED * largest { of_sum[lane] } else { of_magnitude[lane] }
        });
        Self::along(&axes, &sum)
    }

    /// For each corner twice the area between its sides, positive where it turns left, and how much that may be off.
    #[inline(always)]
    fn turns(&self, places: &[Vectors<N>; 4]) -> ([[f64; N]; 4], [[f64; N]; 4]) {
        let flat =
            [self.plane(&places[0]), self.plane(&places[1]), self.plane(&places[2]), self.plane(&places[3])];
        let (mut areas, mut errors) = ([[0.0; N]; 4], [[0.0; N]; 4]);
        for corner in 0..4 {
            let [before, own, after] = [&flat[(corner + 3) % 4], &flat[corner], &flat[(corner + 1) % 4]];
            for lane in 0..N {
                let from = |[x, y]: &[[f64; N]; 2]| [x[lane] - after[0][lane], y[lane] - after[1][lane]];
                let ([ax, ay], [bx, by]) = (from(before), from(own));
                let (left, right) = (ax * by, ay * bx);
                areas[corner][lane] = self.ends[lane] * (left - right);
                errors[corner][lane] = ERROR * (left.abs() + right.abs());
            }
        }
        (areas, errors)
    }

    /// The other two coordinates of a point of each quad, as seen from the positive end of the axis.
    #[inline(always)]
    fn plane(&self, [x, y, z]: &Vectors<N>) -> [[f64; N]; 2] {
        [chosen(&self.axes, &[*y, *z, *x]), chosen(&self.axes, &[*z, *x, *y])]
    }
}

/// The coordinates along these axes.
#[inline(always)]
fn chosen<const N: usize>(axes: &[u64; N], [x, y, z]: &Vectors<N>) -> [f64; N] {
    lanes(|lane| match axes[lane] {
        0 => x[lane],
        1 => y[lane],
        _ => z[lane],
    })
}

/// The first of the longest coordinates.
#[inline(always)]
fn longest<const N: usize>([x, y, z]: &Vectors<N>) -> [u64; N] {
    lanes(|lane| {
        let [x, y, z] = [x[lane].abs(), y[lane].abs(), z[lane].abs()];
        if x >= y && x >= z {
            0
        } else if x < y && y >= z {
            1
        } else {
            2
        }
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;

    use super::*;
    use crate::triangulate_polygon;

    /// Many coordinates are equal or tiny, so that corners lie in one line, nearly in one, or in one place.
    fn corner() -> impl Strategy<Value = Vec3> {
        let coordinate = prop_oneof![
            6 => -3.0_f32..3.0,
            3 => (-2..=2_i8).prop_map(f32::from),
            1 => (-2..=2_i8).prop_map(|value| f32::from(value) * 1e-20),
            1 => prop::sample::select(vec![-0.0, 1e-40, 1.0 + f32::EPSILON, 1e30, f32::NAN, f32::INFINITY]),
        ];
        prop::array::uniform3(coordinate).prop_map(Vec3::from_array)
    }

    fn placed<const N: usize>(corners: [[Vec3; 4]; N]) -> Quads<N> {
        let mut quads = Quads::NONE;
        corners.into_iter().enumerate().for_each(|(quad, corners)| quads.place(quad, corners));
        quads
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(8 * ProptestConfig::default().cases))]

        #[test]
        fn quads_side_by_side_are_cut_as_each(
            corners in prop::array::uniform3(prop::array::uniform4(corner())),
            is_flat: bool,
        ) {
            let flat = |corner: Vec3| if is_flat { corner.with_y(1.0) } else { corner };
            let corners = corners.map(|corners| corners.map(flat));
            for (cut, corners) in placed(corners).cuts().into_iter().zip(corners) {
                if let Some(cut) = cut {
                    prop_assert_eq!(cut.triangles(), triangulate_polygon(&corners), "{:?}", corners);
                }
            }
        }
    }

    #[test]
    fn only_doubtful_quads_take_a_closer_look() {
        let corner = |(x, y): (f32, f32)| Vec3::new(x, y, 0.25 * x * y);
        let [square, dart, tie, straight] = [
            [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.1)],
            [(0.0, 0.0), (3.0, -1.0), (1.0, 0.1), (3.0, 1.0)],
            [(0.0, 0.0), (3.0, 1.0), (3.0, 0.0), (0.0, 2.0)],
            [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 2.0)],
        ]
        .map(|quad| quad.map(corner));
        let cuts = placed([square, dart, tie, straight]).cuts();
        assert_eq!(cuts[0], Some(QuadCut::Second), "a convex one, along the shorter diagonal");
        assert_eq!(cuts[1], Some(QuadCut::First), "a concave one");
        assert!(matches!(cuts[2], Some(QuadCut::Ear(_))), "one that crosses itself: {:?}", cuts[2]);
        assert_eq!(cuts[3], None, "one with three corners in a line");
    }
}
