//! Thin opaque triangles over 1920 by 1080 pixels, as in a mesh of which single vertices are dragged far: some share
//! a tile's size, some cross several tiles.

use criterion::{Criterion, criterion_group, criterion_main};
use std::num::NonZeroUsize;
use trigon_raster::simd::{F32, Simd, prelude::*};
use trigon_raster::{
    Culling, Draw, ExecuteSettings, FragmentLanes, LanePipeline, Output, Pass, Rasterizer, Target,
    VertexLanes,
};

const SIZE: [f32; 2] = [1920.0, 1080.0];

const COUNT: u32 = 60_000;

/// Positions in clip space, column by column.
#[derive(Default)]
struct Slivers([Vec<f32>; 4]);

impl Slivers {
    fn push(&mut self, [x, y]: [f32; 2], depth: f32) {
        let place = [2.0 * x / SIZE[0] - 1.0, 2.0 * y / SIZE[1] - 1.0, depth, 1.0];
        self.0.iter_mut().zip(place).for_each(|(column, value)| column.push(value));
    }
}

impl LanePipeline for Slivers {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z, w] = &self.0;
        [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z), vertices.load(simd, w)]
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        [0.2, 0.5, 0.7, 1.0].map(|value| F32::splat(simd, value))
    }
}

/// The same numbers every time, 0 to 1: a linear congruential generator.
struct Random(u32);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 24) as f32
    }
}

/// Triangles with two corners 1.5 pixels apart and one at this distance, within a part of the image.
fn slivers([dx, dy]: [f32; 2]) -> Slivers {
    let mut random = Random(7);
    let mut slivers = Slivers::default();
    for _ in 0..COUNT {
        let (x, y, depth) = (600.0 + 600.0 * random.next(), 300.0 + 300.0 * random.next(), random.next());
        slivers.push([x, y], depth);
        slivers.push([x, y + 1.5], depth);
        slivers.push([x + dx, y + dy], depth);
    }
    slivers
}

fn cover(criterion: &mut Criterion) {
    let mut target = Target::new(SIZE[0] as u32, SIZE[1] as u32, &[Output::Unorm8]).expect("in range");
    let settings = ExecuteSettings { threads: NonZeroUsize::new(1), ..Default::default() };
    let mut rasterizer = Rasterizer::new(settings).expect("the best level is supported");
    let triangles: Vec<[u32; 3]> = (0..COUNT).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    for (name, reach) in [("50 by 4", [50.0, 4.0]), ("40 by 30", [40.0, 30.0]), ("90 by 30", [90.0, 30.0])] {
        let slivers = slivers(reach);
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&slivers, &triangles) });
        criterion.bench_function(&format!("slivers of {name} pixels"), |bencher| {
            bencher.iter(|| rasterizer.draw(&pass, &mut target));
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).warm_up_time(std::time::Duration::from_millis(200));
    targets = cover
}
criterion_main!(benches);
