//! Looking up a texture of 1024 by 1024 texels for 589,824 samples (768 by 768), as a surface seen at a changing
//! distance does it. There are one to three texels per sample, so mip levels 0.5 to 1.5, in tiles of 64 by 64
//! samples. The throughput is in samples.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use fearless_simd::{Level, dispatch};
use std::hint::black_box;
use trigon_math::{Vec2, Vec4};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, LANES, Simd};
use trigon_raster::{Filter, MipFilter, Sampler, Texture, TextureFormat};

const SIDE: u32 = 1024;
const SAMPLES: u32 = 768;
const TILE: u32 = 64;

fn texture(format: TextureFormat) -> Texture {
    // The bits of a linear congruential generator: every texel differs.
    let texels = (0..SIDE * SIDE).map(|i| i.wrapping_mul(2_654_435_761).to_be_bytes()).collect();
    Texture::new(SIDE, SIDE, texels, format).expect("the size is within the limits")
}

/// Texture coordinates and their gradients at the middle of a row of a tile.
fn run(x: u32, y: u32, stretch: f32) -> Run {
    // 2^0.5 to 2^1.5 texels from one sample to the next.
    let texels = 1.414 + 1.414 * y as f32 / SAMPLES as f32;
    let ddx = Vec2::new(0.96, 0.28) * (texels / SIDE as f32);
    let ddy = Vec2::new(-0.28, 0.96) * (texels / SIDE as f32 / stretch);
    (ddx * x as f32 + ddy * y as f32 + Vec2::splat(3.3), ddx, ddy)
}

/// A run of eight samples: the coordinates of the first and the gradients.
type Run = (Vec2, Vec2, Vec2);

/// All runs, tile by tile.
fn runs(stretch: f32) -> Vec<Run> {
    let tiles = || (0..SAMPLES).step_by(TILE as usize);
    let starts = tiles().flat_map(move |top| {
        tiles().flat_map(move |left| {
            (top..top + TILE).flat_map(move |y| (left..left + TILE).step_by(LANES).map(move |x| (x, y)))
        })
    });
    starts.map(|(x, y)| run(x, y, stretch)).collect()
}

#[inline(always)]
fn in_lanes<S: Simd>(simd: S, texture: &Texture, sampler: &Sampler, runs: &[Run]) -> [f32; LANES] {
    let steps = F32::from_fn(simd, |lane| lane as f32);
    let mut sum = F32::splat(simd, 0.0);
    for &(uv, ddx, ddy) in runs {
        let uv = [steps * ddx.x + uv.x, steps * ddx.y + uv.y];
        let splat = |d: Vec2| [F32::splat(simd, d.x), F32::splat(simd, d.y)];
        let [r, g, b, a] = texture.sample_lanes(simd, uv, splat(ddx), splat(ddy), sampler);
        sum = sum + (r + g) + (b + a);
    }
    sum.to_array()
}

fn one_by_one(texture: &Texture, sampler: &Sampler, runs: &[Run]) -> Vec4 {
    let mut sum = Vec4::ZERO;
    for &(uv, ddx, ddy) in runs {
        for lane in 0..LANES {
            sum += texture.sample(uv + ddx * lane as f32, ddx, ddy, sampler);
        }
    }
    sum
}

fn samplers() -> [(&'static str, Sampler); 4] {
    let trilinear = Sampler::default();
    let with = |mip| Sampler { mip, ..trilinear };
    let nearest = Sampler { magnification: Filter::Nearest, minification: Filter::Nearest, ..trilinear };
    [
        ("nearest", Sampler { mip: MipFilter::None, ..nearest }),
        ("bilinear", with(MipFilter::Nearest)),
        ("trilinear", trilinear),
        ("anisotropic 4", with(MipFilter::Anisotropic(4))),
    ]
}

fn look_ups(criterion: &mut Criterion) {
    for (kind, format) in [("linear", TextureFormat::Linear), ("srgb", TextureFormat::Srgb)] {
        let texture = texture(format);
        for (name, sampler) in samplers() {
            // Four times as long as wide where there are probes for it.
            let stretch = if matches!(sampler.mip, MipFilter::Anisotropic(_)) { 4.0 } else { 1.0 };
            at_each_level(criterion, &format!("texture/{name}, {kind}"), &texture, &sampler, &runs(stretch));
        }
    }
}

fn at_each_level(criterion: &mut Criterion, name: &str, texture: &Texture, sampler: &Sampler, runs: &[Run]) {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(20).throughput(Throughput::Elements(u64::from(SAMPLES * SAMPLES)));
    group.bench_function("one by one", |bencher| {
        bencher.iter(|| black_box(one_by_one(texture, sampler, runs)));
    });
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = Level::new().as_sse2() {
        group.bench_function("sse2", |bencher| {
            bencher.iter(|| {
                black_box(simd.vectorize(
                    #[inline(always)]
                    || in_lanes(simd, texture, sampler, runs),
                ))
            });
        });
    }
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = Level::new().as_avx2() {
        group.bench_function("avx2", |bencher| {
            bencher.iter(|| {
                black_box(simd.vectorize(
                    #[inline(always)]
                    || in_lanes(simd, texture, sampler, runs),
                ))
            });
        });
    }
    group.bench_function("best", |bencher| {
        bencher.iter(|| black_box(dispatch!(Level::new(), simd => in_lanes(simd, texture, sampler, runs))));
    });
    group.finish();
}

criterion_group!(benches, look_ups);
criterion_main!(benches);
