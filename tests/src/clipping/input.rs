//! Triangles and volumes to clip: ordinary, on a grid that meets the planes
//! exactly, and at both ends of the range of `f32`.

use proptest::prelude::*;
use trigon_math::{Band, ClipVolume, HalfSpace, Vec4};

/// Everything that may clip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planes {
    pub(super) minimal_w: f32,
    pub(super) near: bool,
    pub(super) far: bool,
    pub(super) horizontal: Option<f32>,
    pub(super) vertical: Option<f32>,
}

impl Planes {
    pub(super) const VIEW: Self =
        Self { minimal_w: 1e-6, near: true, far: true, horizontal: Some(1.0), vertical: Some(1.0) };

    pub(super) fn volume(&self) -> ClipVolume {
        let mut volume = ClipVolume::before_the_eye(self.minimal_w).expect("a normal number");
        if self.near {
            volume = volume.with(HalfSpace::NEAR);
        }
        if self.far {
            volume = volume.with(HalfSpace::FAR);
        }
        let band = |factor| Band::at_most(factor).expect("at least 1");
        if let Some(factor) = self.horizontal {
            volume = volume.with(HalfSpace::left(band(factor))).with(HalfSpace::right(band(factor)));
        }
        if let Some(factor) = self.vertical {
            volume = volume.with(HalfSpace::bottom(band(factor))).with(HalfSpace::top(band(factor)));
        }
        volume
    }

    /// The planes in clipping order as linear functions `c · (x, y, z, w) + e`,
    /// not negative inside: written out here once more, for the oracle.
    pub(super) fn equations(&self) -> Vec<[f64; 5]> {
        let mut equations = vec![[0.0, 0.0, 0.0, 1.0, -f64::from(self.minimal_w)]];
        if self.near {
            equations.push([0.0, 0.0, -1.0, 1.0, 0.0]);
        }
        if self.far {
            equations.push([0.0, 0.0, 1.0, 0.0, 0.0]);
        }
        if let Some(factor) = self.horizontal.map(f64::from) {
            equations.push([1.0, 0.0, 0.0, factor, 0.0]);
            equations.push([-1.0, 0.0, 0.0, factor, 0.0]);
        }
        if let Some(factor) = self.vertical.map(f64::from) {
            equations.push([0.0, 1.0, 0.0, factor, 0.0]);
            equations.push([0.0, -1.0, 0.0, factor, 0.0]);
        }
        equations
    }
}

/// Planes in every combination. Bands are powers of two, so that the equations
/// are those of the volume.
pub(super) fn planes() -> impl Strategy<Value = Planes> {
    let band = || {
        prop_oneof![
            Just(None),
            (0..=16_u8).prop_map(|exponent| Some(f32::from_bits(u32::from(127 + exponent) << 23))),
            Just(Some(1.0)),
        ]
    };
    let minimal_w = prop_oneof![Just(1e-6_f32), Just(f32::MIN_POSITIVE), Just(0.5), Just(0.1)];
    (minimal_w, any::<bool>(), any::<bool>(), band(), band()).prop_map(
        |(minimal_w, near, far, horizontal, vertical)| Planes { minimal_w, near, far, horizontal, vertical },
    )
}

/// The values at which something happens.
const SPECIAL: [f32; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-6,
    1e-38,
    -1e-38,
    f32::MIN_POSITIVE,
    -f32::MIN_POSITIVE,
    1e-45,
    -1e-45,
    8_388_608.0,
    1e22,
    f32::MAX,
    -f32::MAX,
];

/// Any finite number, small and large ones alike.
fn wild() -> impl Strategy<Value = f32> {
    any::<f32>().prop_filter("finite", |value| value.is_finite())
}

pub(super) fn ordinary_triangle() -> impl Strategy<Value = [Vec4; 3]> {
    triangle_of(|| (-4.0..4.0_f32).boxed())
}

/// A mixture of all kinds, within and across triangles.
pub(super) fn triangle() -> impl Strategy<Value = [Vec4; 3]> {
    prop_oneof![
        3 => ordinary_triangle(),
        3 => triangle_of(|| (-4..=4_i8).prop_map(f32::from).boxed()),
        1 => triangle_of(|| wild().boxed()),
        2 => triangle_of(|| prop_oneof![
            2 => prop::sample::select(&SPECIAL[..]),
            2 => -4.0..4.0_f32,
            1 => wild(),
        ].boxed()),
        1 => nearly_in_a_plane(),
    ]
}

fn triangle_of(coordinate: impl Fn() -> BoxedStrategy<f32>) -> impl Strategy<Value = [Vec4; 3]> {
    let position = || [coordinate(), coordinate(), coordinate(), coordinate()].prop_map(Vec4::from_array);
    [position(), position(), position()]
}

/// All three corners within a unit or two in the last place of planes: here
/// rounding decides the sides.
pub(super) fn nearly_in_a_plane() -> impl Strategy<Value = [Vec4; 3]> {
    let ulps = |value: f32, steps: i32| {
        (0..steps.abs()).fold(value, |value, _| if steps < 0 { value.next_down() } else { value.next_up() })
    };
    let position = move || {
        let steps = || -2..=2_i32;
        (-3.0..3.0_f32, steps(), steps(), steps())
            .prop_map(move |(w, x, y, z)| Vec4::new(ulps(w, x), ulps(-w, y), ulps(w, z), w))
    };
    [position(), position(), position()]
}
