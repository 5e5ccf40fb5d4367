//! Triangles as linear forms of the position on the screen: a quick proof that a triangle does not hide a point.
//!
//! A triangle hides a point that lies within the triangle's three sides and behind its plane. On the screen all four
//! conditions are linear forms. Here the forms are f32, of eight triangles at a time, relative to an origin near all
//! eight. Each form is larger than the exact form by more than all rounding errors. So most points, a triangle's own
//! corners above all, are told apart from hidden points without the exact test.

use trigon_math::DVec2;
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, inlined, prelude::*};

use super::occluders::Pieces;
use super::occluders::Probe;

/// Of the sum of the absolute terms of a form, more than what its factors, a place and their sum are
/// rounded by in f32: a dozen steps.
const ROUNDED: f64 = 1e-6;

/// The same of f64, for what the exact test rounds.
const ROUNDED_EXACT: f64 = 1e-14;

/// Of the products whose difference is a triangle's area, the part that it has to be: then its
/// quotients are precise enough.
const LEAST_AREA: f64 = 1e-6;

/// In pixels, how far corners may be: f32 goes far beyond.
const FARTHEST: f64 = 1e12;

/// Eight triangles, and what is counted from where.
pub(super) struct Forms<S: Simd> {
    /// The three sides, not negative within, and how much nearer than a depth the plane is.
    forms: [TriangleForm<S>; 4],
    origin: DVec2,
    depth: f64,
}

/// `x * factors[0] + y * factors[1] + constant`
struct TriangleForm<S: Simd> {
    factors: [F32<S>; 2],
    constant: F32<S>,
}

/// The same of one triangle.
type Factors = [f64; 3];

impl<S: Simd> Forms<S> {
    /// For points up to `reach` to the right of and below the origin.
    #[inline(always)]
    pub(super) fn new(simd: S, pieces: &Pieces, origin: DVec2, reach: DVec2) -> Self {
        let depth = pieces.depth[0][0];
        let mut lanes = [[[0.0_f32; LANES]; 3]; 4];
        for lane in 0..LANES {
            let corners = pieces.corners(lane, origin, depth);
            let forms = forms_of(&corners, reach, depth);
            for (form, factors) in lanes.iter_mut().zip(forms) {
                for (factor, value) in form.iter_mut().zip(factors) {
                    factor[lane] = value as f32;
                }
            }
        }
        let forms = lanes.each(
            #[inline(always)]
            |[x, y, constant]| TriangleForm {
                factors: [F32::simd_from(simd, x), F32::simd_from(simd, y)],
                constant: F32::simd_from(simd, constant),
            },
        );
        Self { forms, origin, depth }
    }

    /// The triangles that may hide a point, a bit for each: no bit is a proof that the triangle
    /// does not.
    #[inline(always)]
    pub(super) fn that_may_hide(&self, simd: S, probe: &Probe) -> u64 {
        let offset = probe.at - self.origin;
        let [x, y] = [offset.x, offset.y].each(
            #[inline(always)]
            |at| F32::splat(simd, at as f32),
        );
        let [a, b, c, nearer] = &self.forms;
        let at = inlined(
            #[inline(always)]
            |form: &TriangleForm<S>| x * form.factors[0] + y * form.factors[1] + form.constant,
        );
        let (zero, depth) =
            (F32::splat(simd, 0.0), F32::splat(simd, (probe.hiding_depth - self.depth) as f32));
        // So that what is no number proves nothing.
        let is_beside = at(a).simd_lt(zero) | at(b).simd_lt(zero) | at(c).simd_lt(zero);
        let is_clear = is_beside | at(nearer).simd_le(depth);
        !is_clear.to_bitmask() & ((1 << LANES) - 1)
    }
}

/// The three sides, and the depth, of a triangle with corners of x, y and depth; depths are counted
/// from `depth`.
#[inline(always)]
fn forms_of([a, b, c]: &[[f64; 3]; 3], reach: DVec2, depth: f64) -> [Factors; 4] {
    let (along, across) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
    let products = [along[0] * across[1], along[1] * across[0]];
    let (area, terms) = (products[0] - products[1], products[0].abs() + products[1].abs());
    let side = if area > 0.0 { 1.0 } else { -1.0 };
    let far = a[0].abs() + a[1].abs() + b[0].abs() + b[1].abs() + c[0].abs() + c[1].abs();
    let is_precise = (area.abs() > LEAST_AREA * terms) & (far < FARTHEST);
    let all = f64::INFINITY;
    let sides = [[a, b], [b, c], [c, a]].each(
        #[inline(always)]
        |[from, to]| {
            let (x, y) = ((from[1] - to[1]) * side, (to[0] - from[0]) * side);
            let terms = x.abs() * (reach.x + from[0].abs()) + y.abs() * (reach.y + from[1].abs());
            let constant = ROUNDED * terms - (x * from[0] + y * from[1]);
            [x, y, if is_precise { constant } else { all }]
        },
    );
    let slope = inlined(
        #[inline(always)]
        |axis: usize| (along[2] * across[axis], across[2] * along[axis]),
    );
    let ((x, less_x), (less_y, y)) = (slope(1), slope(0));
    let scale = 1.0 / area;
    let [steep_x, steep_y] = [(x.abs() + less_x.abs()), (y.abs() + less_y.abs())].each(
        #[inline(always)]
        |steep| steep * scale.abs(),
    );
    let (x, y) = ((x - less_x) * scale, (y - less_y) * scale);
    let terms = steep_x * (reach.x + a[0].abs()) + steep_y * (reach.y + a[1].abs()) + a[2].abs();
    let margin = ROUNDED * terms + ROUNDED_EXACT * depth.abs() + f64::from(f32::MIN_POSITIVE);
    let constant = a[2] - (x * a[0] + y * a[1]) + margin;
    let [a, b, c] = sides;
    [a, b, c, [x, y, if is_precise { constant } else { all }]]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::at_level;
    use trigon_math::simd::Token;

    use super::*;
    use crate::pick::hiding::depth_at;
    use crate::pick::occluders::{Extent, Group};
    use crate::pick::screen::Spot;

    type Corners = [[f64; 3]; 3];

    fn piece(corners: &Corners) -> [Spot; 3] {
        corners.map(|[x, y, depth]| Spot { at: DVec2::new(x, y), depth })
    }

    /// The triangles that may hide each point, a bit for each.
    fn asked(triangles: &[Corners], reach: DVec2, probes: &[Probe]) -> Vec<u64> {
        let mut group = Group::new();
        for corners in triangles {
            let (piece, all) = (piece(corners), 0..u32::MAX);
            let extent = Extent::new(&piece);
            let pixels = extent.pixels(&all, &all).expect("in the image");
            group.push(&piece, 0, extent, pixels);
        }
        at_level!(Token::best(), simd => {
            let forms = Forms::new(simd, &group.pieces, DVec2::ZERO, reach);
            probes.iter().map(|probe| forms.that_may_hide(simd, probe) & group.bits()).collect()
        })
    }

    /// A corner: mostly of a triangle of a few pixels, and sometimes of a sliver or a huge one.
    fn corner() -> impl Strategy<Value = [f64; 3]> {
        let near = (30.0..34.0_f64, 20.0..24.0_f64, 0.01..0.012_f64);
        let far = (0.0..4000.0_f64, 0.0..3000.0_f64, 1e-6..1.0_f64);
        let level = (Just(31.0_f64), 20.0..21.0_f64, Just(0.5_f64));
        prop_oneof![6 => near, 1 => far, 1 => level].prop_map(|(x, y, depth)| [x, y, depth])
    }

    /// Shares of corners: inside, on a side, at a corner, or a little beyond.
    fn shares() -> impl Strategy<Value = [f64; 3]> {
        let share = prop_oneof![Just(0.0), Just(1.0), 0.0..1.0_f64, -1e-9..1e-9_f64];
        prop::array::uniform3(share).prop_filter_map("no point", |[a, b, c]| {
            let sum = a + b + c;
            (sum > 0.1).then(|| [a / sum, b / sum, c / sum])
        })
    }

    proptest! {
        /// The quick proof passes over no triangle of which the exact test finds that it hides a point.
        #[test]
        fn what_hides_a_point_may_hide_it(
            triangles in prop::collection::vec(prop::array::uniform3(corner()), 1..=LANES),
            points in prop::collection::vec((0..LANES, shares(), -1e-7..1e-7_f64), 1..40),
        ) {
            let at = |(number, [a, b, c], nearer): &(usize, [f64; 3], f64)| {
                let of = &triangles[number % triangles.len()];
                let mean = |axis: usize| of[0][axis] * a + of[1][axis] * b + of[2][axis] * c;
                Probe { at: DVec2::new(mean(0), mean(1)), hiding_depth: mean(2) * (1.0 - nearer) }
            };
            let probes: Vec<Probe> = points.iter().map(at).collect();
            let asked = asked(&triangles, DVec2::new(4000.0, 3000.0), &probes);
            for (probe, bits) in probes.iter().zip(asked) {
                for (number, corners) in triangles.iter().enumerate() {
                    let depth = depth_at(&piece(corners), probe.at);
                    let hides = depth.is_some_and(|depth| depth > probe.hiding_depth);
                    prop_assert!(!hides || bits >> number & 1 == 1, "{corners:?} hides {:?}", probe.at);
                }
            }
        }
    }

    #[test]
    fn of_a_dense_mesh_nothing_is_left_for_the_exact_test() {
        // Quads of 1.3 pixels on a slope.
        let grid_point = |x: u32, y: u32| {
            let [x, y] = [x, y].map(|at| f64::from(at) * 1.3);
            [x + 0.2 * y + 7.1, y + 5.3, 0.02 + 1e-5 * x - 2e-5 * y]
        };
        let quads =
            (0..4).map(|x| [grid_point(x, 1), grid_point(x + 1, 1), grid_point(x + 1, 2), grid_point(x, 2)]);
        let triangles: Vec<Corners> = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let vertices = (0..4).flat_map(|y| (0..6).map(move |x| grid_point(x, y)));
        let probe = |[x, y, depth]: [f64; 3], nearer: f64| Probe {
            at: DVec2::new(x, y),
            hiding_depth: depth * nearer,
        };
        let probes = |nearer: f64| vertices.clone().map(|at| probe(at, nearer)).collect::<Vec<_>>();
        let asked = |nearer: f64| asked(&triangles, DVec2::new(20.0, 20.0), &probes(nearer));
        // A thousandth of a pixel's width at its distance.
        assert!(asked(1.0 + 7e-7).iter().all(|&bits| bits == 0), "their own corners are told apart");
        let behind: u32 = asked(1.0 - 7e-7).iter().map(|bits| bits.count_ones()).sum();
        assert!(behind >= 24, "points behind their corners are left: {behind}");
    }
}
