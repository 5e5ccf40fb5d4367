//! Textures far from their ordinary scale: a texel as large as a thousand images,
//! coordinates of 10⁵, and planes to the horizon.

use crate::coverage_support::{SIDE, clip_position, draw, pixel};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::{Vec2, Vec4};
use trigon_raster::{
    Culling, Draw, Filter, Fragment, MipFilter, Pass, Pipeline, Sampler, Texture, TextureFormat, VertexOutput,
};

/// Triangles with texture coordinates.
struct Textured<'a> {
    texture: &'a Texture,
    sampler: Sampler,
    vertices: Vec<(Vec4, Vec2)>,
}

impl Pipeline for Textured<'_> {
    type Varyings = Vec2;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec2> {
        let (position, varyings) = self.vertices[index];
        VertexOutput { position, varyings }
    }

    fn fragment(&self, fragment: &Fragment<Vec2>) -> Vec4 {
        self.texture.sample(fragment.varyings, fragment.ddx, fragment.ddy, &self.sampler)
    }
}

/// The colours of the pixels that are covered.
fn seen(pipeline: &Textured<'_>, triangles: &[[u32; 3]]) -> Vec<([i32; 2], Vec4)> {
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(pipeline, triangles) });
    let images = draw(&pass);
    let ids = images.triangles.expect("asked for");
    let all = images.linear.expect("asked for").into_iter().enumerate();
    all.filter(|(index, _)| ids[*index] != u32::MAX).map(|(index, color)| (pixel(index), color)).collect()
}

/// So many texels, alternately black and white.
fn stripes(width: u32, height: u32) -> Texture {
    let texels = (0..width * height).map(|i| if i % 2 == 0 { [0, 0, 0, 255] } else { [255; 4] }).collect();
    Texture::new(width, height, texels, TextureFormat::Linear).expect("a size in range")
}

/// White in one quarter, black elsewhere: no level but the last is of one colour.
fn quarter(width: u32, height: u32) -> Texture {
    let is_white = |x: u32, y: u32| 2 * x < width && 2 * y < height;
    let texel = |i: u32| if is_white(i % width, i / width) { [255; 4] } else { [0, 0, 0, 255] };
    let texels = (0..width * height).map(texel).collect();
    Texture::new(width, height, texels, TextureFormat::Linear).expect("a size in range")
}

proptest! {
    #![proptest_config(cases(100))]

    /// A texel is 10⁴ images wide: the colour is still the straight line between the
    /// two texels that an image lies between.
    ///
    /// A coordinate below 1 is off by 10.5 + 3 roundings of 2^-24 (see
    /// `interpolation`), of which a texel holds 64, and by one for the product with 64;
    /// then come the difference of two bytes, a product, a sum and a quotient.
    #[test]
    fn a_texel_magnified_ten_thousand_times_is_a_straight_line(
        texel in 0..63_u32,
        start in 0.01_f32..0.98,
        turned in any::<bool>(),
    ) {
        let texture = stripes(64, 1);
        let span = 1.0e-4_f32 / 64.0;
        let first = (texel as f32 + 0.5 + start) / 64.0;
        let at = |x: i32, y: i32| {
            let along = if turned { y } else { x } as f32 / (SIDE * 256) as f32;
            (clip_position([x, y], 0.5), Vec2::new(first + span * along, 0.5))
        };
        let side = SIDE * 256;
        let vertices = vec![at(0, 0), at(2 * side, 0), at(0, 2 * side)];
        let ends = [vertices[0].1.x, if turned { vertices[2].1.x } else { vertices[1].1.x }].map(f64::from);
        let pipeline = Textured { texture: &texture, sampler: Sampler::default(), vertices };
        let colors = seen(&pipeline, &[[0, 1, 2]]);
        prop_assert_eq!(colors.len(), (SIDE * SIDE) as usize, "all pixels");
        for ([x, y], color) in colors {
            let along = (f64::from(if turned { y } else { x }) + 0.5) / f64::from(2 * SIDE);
            let position = (ends[0] + (ends[1] - ends[0]) * along) * 64.0 - 0.5 - f64::from(texel);
            let exact = if texel % 2 == 0 { position } else { 1.0 - position };
            let bound = (13.5 * 64.0 + 64.0 + 4.0) / f64::from(1 << 24);
            let error = (f64::from(color.x) - exact).abs();
            prop_assert!(error <= bound, "{} instead of {exact} at {x}, {y}", color.x);
        }
    }

    /// Coordinates that are moved by 10⁵ textures show the same texel: 17 bits for the
    /// repetitions and 7 for the middle of one of 64 texels are what f32 has.
    #[test]
    fn whole_repetitions_change_nothing(
        repetitions in [-100_000..100_000_i32, -100_000..100_000],
        flat in [0..64_u8, 0..64],
    ) {
        let texture = stripes(64, 64);
        let sampler = Sampler { magnification: Filter::Nearest, minification: Filter::Nearest, mip: MipFilter::None, ..Sampler::default() };
        let uv = Vec2::from(flat.map(|texel| (f32::from(texel) + 0.5) / 64.0));
        let image = |moved: Vec2| {
            let corners = [[0, 0], [SIDE * 512, 0], [0, SIDE * 512]];
            let vertices = corners.map(|corner| (clip_position(corner, 0.5), uv + moved)).to_vec();
            seen(&Textured { texture: &texture, sampler, vertices }, &[[0, 1, 2]])
        };
        let moved = image(Vec2::from(repetitions.map(|v| v as f32)));
        prop_assert!(image(Vec2::ZERO) == moved, "by {repetitions:?}");
        // Columns are black and white in turns.
        let light = if flat[0] % 2 == 0 { 0.0 } else { 1.0 };
        prop_assert!(moved.iter().all(|(_, color)| color.x == light), "texel {flat:?} is {light}");
    }

    /// Hard case 41: a textured ground to the horizon, and beyond behind the eye. Every
    /// colour is one between the texels', and where a pixel's footprint is wider than
    /// all of the texture (here twice as wide, to be clear of rounding) it is exactly
    /// its mean, the last level.
    #[test]
    fn a_ground_to_the_horizon_ends_in_the_mean_of_its_texture(
        size in prop::sample::select(&[[64_u32, 64], [1, 4096], [4096, 1], [1, 1], [37, 5]][..]),
        repetitions in prop_oneof![Just(1.0_f32), 0.01_f32..1e4],
        mip in prop::sample::select(&[MipFilter::Linear, MipFilter::Nearest, MipFilter::Anisotropic(16), MipFilter::None][..]),
        height in 0.01_f32..2.0,
    ) {
        let texture = quarter(size[0], size[1]);
        let reach = 1e6_f32;
        // One texture for `repetitions` metres; the horizon is in the middle.
        let corner = |x: f32, ahead: f32| {
            (Vec4::new(x, -height, 0.01, ahead), Vec2::new(x, ahead) / repetitions)
        };
        let vertices = vec![corner(-reach, -reach), corner(reach, -reach), corner(reach, reach), corner(-reach, reach)];
        let pipeline = Textured { texture: &texture, sampler: Sampler { mip, ..Sampler::default() }, vertices };
        let colors = seen(&pipeline, &[[0, 1, 2], [0, 2, 3]]);
        prop_assert!(!colors.is_empty(), "the ground is seen");
        let mean = texture.sample(Vec2::ZERO, Vec2::INFINITY, Vec2::INFINITY, &Sampler::default());
        let white: f64 = size.iter().map(|&side| f64::from(side.div_ceil(2)) / f64::from(side)).product();
        // Each level is rounded to bytes once.
        let rounding = 0.5 / 255.0 * f64::from(size[0].max(size[1]).ilog2()) + f64::from(f32::EPSILON);
        prop_assert!((f64::from(mean.x) - white).abs() <= rounding, "{mean} is not {white} of white");
        prop_assert!(mean.x == mean.y && mean.x == mean.z && mean.w == 1.0, "{mean}");
        for ([x, y], color) in colors {
            prop_assert!(color.is_finite() && color.min_element() >= 0.0 && color.max_element() <= 1.0, "{color}");
            // How far ahead the ground changes by a pixel's step here, in textures.
            let below = f64::from(y) + 0.5 - f64::from(SIDE) / 2.0;
            let step = f64::from(height) * f64::from(SIDE) / 2.0 / (below * below) / f64::from(repetitions);
            let texels = step * f64::from(size[1]);
            let all = f64::from(size[0].max(size[1]));
            if texels > 2.0 * all && matches!(mip, MipFilter::Linear | MipFilter::Nearest) {
                prop_assert_eq!(color, mean, "at {} {}", x, y);
            }
        }
    }
}
