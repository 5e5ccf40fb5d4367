//! The footprint of a pixel on a texture: its derivatives where a triangle is cut, the mip level that follows from
//! them, and the probes of anisotropic filters up to the horizon.
//!
//! The oracle inverts the map from the whole triangle to the screen in f64; it knows nothing of cuts. The texture is one
//! whose every level can be told from its neighbours, in integers.

use crate::coverage_support::{SIDE, draw, pixel};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_camera::Projection;
use trigon_math::{DMat3, DQuat, DVec2, DVec3, Vec2, Vec4, elementary};
use trigon_raster::{
    Culling, Draw, Filter, Fragment, MipFilter, Pass, Pipeline, Sampler, Texture, TextureFormat, VertexOutput,
};

/// Texels on a side, and the last level.
const TEXELS: u32 = 256;
const LAST: i32 = 8;

/// What each bit of a texel's place adds to its byte: 8 bits on either axis make 240.
const BIT: f64 = 15.0;

/// A texture whose bytes are the bits of their place, counted: a level has the mean of the bits that it has lost,
/// which is a whole number.
fn bits() -> Texture {
    let byte = |texel: u32| (BIT as u32 * texel.count_ones()) as u8;
    let texel = |i: u32| [byte(i % TEXELS) + byte(i / TEXELS), 0, 0, 255];
    let texels = (0..TEXELS * TEXELS).map(texel).collect();
    Texture::new(TEXELS, TEXELS, texels, TextureFormat::Linear).expect("a size in range")
}

/// The byte of a level at a place in textures. `None` within `margin` textures of the border of a texel.
fn level_at(level: i32, place: DVec2, margin: f64) -> Option<f64> {
    let size = f64::from(TEXELS >> level);
    let axis = |coordinate: f64| {
        let texels = (coordinate - coordinate.floor()) * size;
        let aside = texels - texels.floor();
        let is_clear = aside > margin * size && 1.0 - aside > margin * size;
        is_clear.then(|| BIT * (f64::from((texels as u32).count_ones()) + f64::from(level) / 2.0))
    };
    Some(axis(place.x)? + axis(place.y)?)
}

/// A triangle that shows the texture, or the derivatives of its coordinates.
struct Triangle<'a> {
    corners: [(Vec4, Vec2); 3],
    /// What it shows; the derivatives without it.
    texture: Option<(&'a Texture, Sampler)>,
}

impl Pipeline for Triangle<'_> {
    type Varyings = Vec2;

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec2> {
        let (position, varyings) = self.corners[index];
        VertexOutput { position, varyings }
    }

    fn fragment(&self, fragment: &Fragment<Vec2>) -> Vec4 {
        let Fragment { varyings, ddx, ddy, .. } = *fragment;
        match &self.texture {
            Some((texture, sampler)) => texture.sample(varyings, ddx, ddy, sampler),
            None => Vec4::new(ddx.x, ddx.y, ddy.x, ddy.y),
        }
    }
}

impl Triangle<'_> {
    /// The pixels that it covers, with what they show.
    fn shown(&self) -> Vec<([i32; 2], Vec4)> {
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(self, &[[0, 1, 2]]) });
        let images = draw(&pass);
        let ids = images.triangles.expect("asked for");
        let all = images.linear.expect("asked for").into_iter().enumerate();
        all.filter(|&(index, _)| ids[index] == 0).map(|(index, color)| (pixel(index), color)).collect()
    }
}

/// What a pixel covers of the texture, in f64.
struct Footprint {
    place: DVec2,
    /// For a pixel to the right, and one downwards.
    steps: [DVec2; 2],
    /// The corners' shares of the point with a w of 1.
    shares: DVec3,
    /// How far one step changes the shares of the corners at most, all together: what roundings are multiplied by.
    change: f64,
}

impl Footprint {
    /// That of a whole triangle, no matter what of it is in the view. With the corners as columns of a matrix M, a point
    /// of the screen has the shares M⁻¹ (x, y, 1), divided by their sum.
    fn new(corners: &[(Vec4, Vec2); 3], at: [i32; 2]) -> Self {
        let columns = corners.map(|(position, _)| position.as_dvec4()).map(|v| DVec3::new(v.x, v.y, v.w));
        let inverse = DMat3::from_cols(columns[0], columns[1], columns[2]).inverse();
        let unit = 2.0 / f64::from(SIDE);
        let [x, y] = at.map(|v| f64::from(v) + 0.5);
        let shares = inverse * DVec3::new(x * unit - 1.0, 1.0 - y * unit, 1.0);
        let total = shares.element_sum();
        let mixed = |shares: DVec3| (0..3).map(|i| corners[i].1.as_dvec2() * shares[i]).sum::<DVec2>();
        let place = mixed(shares) / total;
        let changes = [inverse.x_axis * unit, inverse.y_axis * -unit];
        let steps = changes.map(|change| (mixed(change) - place * change.element_sum()) / total);
        let change = changes.map(|change| change.abs().element_sum() / total.abs());
        Self { place, steps, shares, change: change[0].max(change[1]) }
    }

    /// Its sides in texels, the longer one first, and the step along that.
    fn sides(&self) -> ([f64; 2], DVec2) {
        let [right, down] = self.steps;
        let lengths = [right.length(), down.length()].map(|length| length * f64::from(TEXELS));
        if lengths[0] < lengths[1] { ([lengths[1], lengths[0]], down) } else { (lengths, right) }
    }
}

/// A corner of a tilted wall through a point ahead of the eye that reaches far beyond it on all sides.
fn wall() -> impl Strategy<Value = [(Vec4, Vec2); 3]> {
    let power = |range: std::ops::Range<f64>| range.prop_map(|power| elementary::pow(10.0, power));
    let turn = prop::array::uniform4(-1.0..1.0_f64)
        .prop_filter("has a length", |q| q.iter().map(|v| v * v).sum::<f64>() > 0.01)
        .prop_map(|q| DQuat::from_array(q).normalize());
    // The texture repeats so often in a metre that a pixel covers a tenth of a texel to ten.
    (turn, power(0.5..2.5), power(-2.5..-0.5), power(-3.0..-0.5), any::<bool>()).prop_map(
        |(turn, reach, repetitions, near, other)| {
            let projection = Projection::perspective(1.0, near, None).expect("in range").matrix(1.0);
            let corner = |x: f64, y: f64| {
                let place = DVec3::NEG_Z + turn * DVec3::new(x, y, 0.0) * reach;
                let uv = DVec2::new(x, y) * reach * repetitions;
                ((projection * place.extend(1.0)).as_vec4(), uv.as_vec2())
            };
            [corner(-1.0, -1.0), corner(1.0, 1.0), if other { corner(1.0, -1.0) } else { corner(-1.0, 1.0) }]
        },
    )
}

/// How far derivatives on what is left of a triangle may be off, relative to the longer one: cut corners are up to 1/120
/// pixel off (see `near_plane`), which stretches what lies between them by twice that over its least height; pieces that
/// are less than three pixels high are left out by [`is_large`].
const STRETCHED: f64 = 2.0 / 120.0 / 3.0;

/// A pixel and its eight neighbours.
fn block([x, y]: [i32; 2]) -> impl Iterator<Item = [i32; 2]> {
    (-1..=1).flat_map(move |dy| (-1..=1).map(move |dx| [x + dx, y + dy]))
}

fn is_shown(shown: &[([i32; 2], Vec4)], [x, y]: [i32; 2]) -> bool {
    shown.binary_search_by_key(&[y, x], |(at, _)| [at[1], at[0]]).is_ok()
}

/// Whether a pixel lies within a block of 3 by 3 pixels that the triangle covers as a whole.
fn is_large(shown: &[([i32; 2], Vec4)], at: [i32; 2]) -> bool {
    block(at).all(|near| is_shown(shown, near))
}

/// Whether the block around a pixel is within the whole triangle, and behind the near plane.
fn is_covered(corners: &[(Vec4, Vec2); 3], at: [i32; 2]) -> bool {
    block(at).all(|near| {
        let shares = Footprint::new(corners, near).shares;
        let depth: f64 = (0..3).map(|i| shares[i] * f64::from(corners[i].0.z)).sum();
        shares.min_element() > 0.0 && depth < 1.0
    })
}

/// Checks that the pixels that the triangle covers are there.
fn check_coverage(corners: &[(Vec4, Vec2); 3], shown: &[([i32; 2], Vec4)]) -> Result<(), TestCaseError> {
    for at in (0..(SIDE * SIDE) as usize).step_by(5).map(pixel) {
        prop_assert!(is_shown(shown, at) || !is_covered(corners, at), "nothing is shown at {at:?}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(100))]

    /// Walls through the near plane and the guard band: what is left has the derivatives of the whole.
    #[test]
    fn derivatives_on_cut_triangles_are_those_of_the_whole_one(corners in wall()) {
        let shown = Triangle { corners, texture: None }.shown();
        check_coverage(&corners, &shown)?;
        for &(at, found) in shown.iter().filter(|(at, _)| is_large(&shown, *at)) {
            let Footprint { steps, .. } = Footprint::new(&corners, at);
            let longer = steps[0].length().max(steps[1].length());
            let found = [DVec2::new(found.x.into(), found.y.into()), DVec2::new(found.z.into(), found.w.into())];
            for (found, expected) in found.into_iter().zip(steps) {
                let error = (found - expected).length() / longer;
                prop_assert!(error < STRETCHED, "{} instead of {} at {:?}: {}", found, expected, at, error);
            }
        }
    }

    /// So the texture has the same level on it as on the whole one.
    #[test]
    fn mip_levels_on_cut_triangles_are_those_of_the_whole_one(corners in wall()) {
        let texture = bits();
        let nearest = Sampler {
            magnification: Filter::Nearest, minification: Filter::Nearest, mip: MipFilter::Nearest, ..Sampler::default()
        };
        let shown = Triangle { corners, texture: Some((&texture, nearest)) }.shown();
        check_coverage(&corners, &shown)?;
        for &(at, found) in shown.iter().filter(|(at, _)| is_large(&shown, *at)) {
            let footprint = Footprint::new(&corners, at);
            let ([longer, _], _) = footprint.sides();
            let level = elementary::log2(longer);
            // A half is the border of a level; and a place may be off by a 120th of the footprint.
            let aside = (level - level.floor() - 0.5).abs();
            let margin = longer / f64::from(TEXELS) / 60.0 + 1e-5 * footprint.place.abs().max_element();
            let nearest = (level.round() as i32).clamp(0, LAST);
            let Some(expected) = level_at(nearest, footprint.place, margin).filter(|_| aside > 0.02) else { continue };
            let found = f64::from(found.x) * 255.0;
            prop_assert!((found - expected).abs() < 0.01, "{found} instead of {expected} at {at:?}, level {level}");
        }
    }
}

/// A floor that ends at the horizon, as one triangle with corners on the grid: the near edge and a corner far away.
fn floor() -> impl Strategy<Value = [(Vec4, Vec2); 3]> {
    let far = (1.0_f64..4.0).prop_map(|power| elementary::pow(10.0, power) as f32);
    let horizon = [0..SIDE * 256, 4 * 256..30 * 256_i32];
    (far, horizon, 1.0_f32..200.0, 0.2_f32..2.0).prop_map(|(far, horizon, repetitions, width)| {
        let repetitions = repetitions / far;
        let corner = |[x, y]: [i32; 2], w: f32, uv: Vec2| {
            let unit = f64::from(SIDE * 128);
            let at = |ndc: f64| (ndc * f64::from(w)) as f32;
            let position =
                Vec4::new(at(f64::from(x) / unit - 1.0), at(1.0 - f64::from(y) / unit), 0.5 * w, w);
            (position, uv * repetitions)
        };
        [
            corner([-300 * 256, 70 * 256], 1.0, Vec2::new(-width, 1.0)),
            corner([364 * 256, 70 * 256], 1.0, Vec2::new(width, 1.0)),
            corner(horizon, far, Vec2::new(0.0, far)),
        ]
    })
}

/// One rounding to f32, relative.
const UNIT: f64 = 1.0 / (1 << 24) as f64;

/// The value of an anisotropic look-up by EXT_texture_filter_anisotropic: probes along the longer side, as many as it is
/// longer than the other, rounded up and at most so many; each in the two levels about the logarithm of its part. `None`
/// where rounding may decide.
fn anisotropic(footprint: &Footprint, largest: f64, most: u8) -> Option<(f64, f64)> {
    let ([longer, shorter], along) = footprint.sides();
    let most = f64::from(most.clamp(1, 16));
    let ratio = (longer / shorter).min(most);
    if ratio < most && (ratio - ratio.round()).abs() < 1e-2 {
        return None;
    }
    let probes = ratio.ceil();
    let level = elementary::log2(longer / probes).clamp(0.0, f64::from(LAST));
    let finer = level.floor().min(f64::from(LAST - 1));
    // Roundings of a coordinate and of a derivative, see `interpolation`; half of that at the ends.
    let margin = 16.0 * UNIT * largest + 56.0 * UNIT * largest * footprint.change;
    let mut sum = 0.0;
    for index in 1..=probes as u32 {
        let shift = if probes == 1.0 { 0.0 } else { f64::from(index) / (probes + 1.0) - 0.5 };
        let place = footprint.place + along * shift;
        let at = |level: f64| level_at(level as i32, place, margin);
        let share = level - finer;
        sum += if share == 0.0 { at(finer)? } else { at(finer)? * (1.0 - share) + at(finer + 1.0)? * share };
    }
    Some((sum / probes, probes))
}

proptest! {
    #![proptest_config(cases(60))]

    /// From square footprints to those that are thousands of times longer than wide: as many probes as the sides ask for,
    /// where they ask for more than there may be that many, and each as long as its part of the longer side.
    #[test]
    fn a_grazing_floor_has_the_probes_and_levels_of_its_footprints(
        corners in floor(), most in prop::sample::select(vec![0_u8, 1, 2, 3, 4, 8, 16, 17, 255]),
    ) {
        let texture = bits();
        let sampler = Sampler {
            magnification: Filter::Nearest, minification: Filter::Nearest, mip: MipFilter::Anisotropic(most),
            ..Sampler::default()
        };
        let largest = corners.iter().fold(0.0, |most: f64, (_, uv)| most.max(uv.abs().max_element().into()));
        let (mut decided, mut all) = (0, 0);
        for (at, found) in (Triangle { corners, texture: Some((&texture, sampler)) }).shown() {
            all += 1;
            let Some((expected, probes)) = anisotropic(&Footprint::new(&corners, at), largest, most) else { continue };
            decided += 1;
            let found = f64::from(found.x) * 255.0;
            // The logarithm is off by 2.5e-5, times two bits on either axis, and a derivative by 1e-4 of itself.
            prop_assert!((found - expected).abs() < 0.05, "{found} instead of {expected} at {at:?}, {probes} probes");
        }
        // Up to 32 look-ups a pixel may each be at the border of a texel: floors of which rounding decides nearly all
        // are drawn again, and proptest fails when most floors are.
        prop_assume!(decided * 10 > all, "rounding decides most pixels");
    }
}
