//! Tests: a look-up in lanes gives the bits of one for a single sample, at every
//! SIMD level, whatever the texture, the sampler and the coordinates.

use crate::simd::prelude::*;
use crate::simd::{F32, LANES, Simd, SimdLevel, at_level};
use crate::{Filter, MipFilter, Sampler, Texture, TextureFormat, Wrap};
use proptest::prelude::*;

const WRAPS: [Wrap; 3] = [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge];
const FILTERS: [Filter; 2] = [Filter::Nearest, Filter::Linear];
const MIPS: [MipFilter; 5] = [
    MipFilter::None,
    MipFilter::Nearest,
    MipFilter::Linear,
    MipFilter::Anisotropic(3),
    MipFilter::Anisotropic(16),
];

/// uv, ddx, ddy of each lane.
type Inputs = [[[f32; 2]; 3]; LANES];

fn look_up<S: Simd>(simd: S, texture: &Texture, inputs: &Inputs, sampler: &Sampler) -> [[u32; 4]; LANES] {
    let lanes = |which: usize, axis: usize| F32::from_fn(simd, |lane| inputs[lane][which][axis]);
    let [uv, ddx, ddy] = [0, 1, 2].map(|which| [lanes(which, 0), lanes(which, 1)]);
    let channels = texture.sample_lanes(simd, uv, ddx, ddy, sampler);
    std::array::from_fn(|lane| channels.map(|channel| channel.to_array()[lane].to_bits()))
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -3.0_f32..3.0,
        1 => -2e5_f32..2e5,
        1 => any::<f32>(),
        1 => prop::sample::select(vec![
            0.0, -0.0, 0.5, 1.0, -1.0, 2.0, -1e-30, 1e-40, 8_388_607.5, 1e7, -3e38, f32::NAN,
            f32::INFINITY, f32::NEG_INFINITY,
        ]),
    ]
}

/// A gradient of about so many texels of a texture of 1 to 40 texels.
fn gradient() -> impl Strategy<Value = f32> {
    prop_oneof![4 => -0.5_f32..0.5, 2 => -0.03_f32..0.03, 1 => number()]
}

fn inputs() -> impl Strategy<Value = Inputs> {
    let lane = (
        prop::array::uniform2(number()),
        prop::array::uniform2(gradient()),
        prop::array::uniform2(gradient()),
    );
    prop::array::uniform8(lane.prop_map(|(uv, ddx, ddy)| [uv, ddx, ddy]))
}

fn any_sampler() -> impl Strategy<Value = Sampler> {
    (0_usize..3, 0_usize..3, 0_usize..2, 0_usize..2, 0_usize..5).prop_map(|(u, v, large, small, mip)| {
        Sampler {
            wrap_u: WRAPS[u],
            wrap_v: WRAPS[v],
            magnification: FILTERS[large],
            minification: FILTERS[small],
            mip: MIPS[mip],
        }
    })
}

fn any_texture() -> impl Strategy<Value = Texture> {
    let side = || prop_oneof![Just(1_u32), Just(8), Just(32), 1_u32..40];
    (side(), side(), any::<u32>(), any::<[bool; 2]>()).prop_map(|(width, height, seed, [srgb, opaque])| {
        let texel = |i: u32| {
            let [r, g, b, a] = (seed ^ i).wrapping_mul(2_654_435_761).to_be_bytes();
            [r, g, b, if opaque { 255 } else { a }]
        };
        let format = if srgb { TextureFormat::Srgb } else { TextureFormat::Linear };
        Texture::new(width, height, (0..width * height).map(texel).collect(), format)
            .expect("the sides and the texels agree")
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn every_lane_has_the_bits_of_one_sample(
        texture in any_texture(),
        inputs in inputs(),
        sampler in any_sampler(),
    ) {
        let expected = inputs.map(|[uv, ddx, ddy]| {
            texture.sample(uv.into(), ddx.into(), ddy.into(), &sampler).to_array().map(f32::to_bits)
        });
        for level in SimdLevel::ALL {
            let Some(token) = level.token() else { continue };
            let got = at_level!(token, simd => look_up(simd, &texture, &inputs, &sampler));
            prop_assert_eq!(got, expected, "{} with {:?}", level, sampler);
        }
    }
}

#[test]
fn the_largest_texture_is_addressed_to_its_last_texel() {
    let side = crate::MAX_TEXTURE_SIZE;
    let mut texels = vec![[0; 4]; side as usize];
    texels[side as usize - 1] = [255; 4];
    let texture = Texture::new(side, 1, texels, TextureFormat::Linear).expect("as long as one may be");
    let sampler = Sampler { wrap_u: Wrap::ClampToEdge, ..Sampler::default() };
    let inputs = [[[1.0, 0.5], [0.0; 2], [0.0; 2]]; LANES];
    let white = 1.0_f32.to_bits();
    for level in SimdLevel::ALL {
        let Some(token) = level.token() else { continue };
        let got = at_level!(token, simd => look_up(simd, &texture, &inputs, &sampler));
        assert_eq!(got, [[white; 4]; LANES], "{level}");
    }
}
