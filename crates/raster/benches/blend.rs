//! Translucent layers over 1920 by 1080 pixels: few and many, as sheets of large
//! triangles that cut through each other and as a cloud of small ones.

use criterion::{Criterion, criterion_group, criterion_main};
use std::num::NonZeroUsize;
use trigon_math::Vec4;
use trigon_raster::simd::{F32, InlineMap, Simd};
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, FragmentLanes, LanePipeline, Output, Pass, Rasterizer, Target,
    VertexLanes,
};

/// Positions and straight colours, column by column.
#[derive(Default)]
struct Sheets([Vec<f32>; 8]);

impl Sheets {
    fn push(&mut self, position: Vec4, color: Vec4) {
        let values = position.to_array().into_iter().chain(color.to_array());
        for (column, value) in self.0.iter_mut().zip(values) {
            column.push(value);
        }
    }
}

impl LanePipeline for Sheets {
    const VARYINGS: usize = 4;

    fn vertex_count(&self) -> usize {
        self.0[0].len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        for index in 0..4 {
            vertices.set(index, vertices.load(simd, &self.0[4 + index]));
        }
        [0, 1, 2, 3].each(
            #[inline(always)]
            |index| vertices.load(simd, &self.0[index]),
        )
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, _: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [r, g, b, a] = fragments.varyings(0);
        [r * a, g * a, b * a, a]
    }
}

/// The same numbers every time, 0 to 1: a linear congruential generator, kept because published times are of its quads.
struct Random(u32);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 24) as f32
    }
}

/// Quads of a size in clip space, at random places and depths.
fn quads(count: u32, size: f32, shift: f32) -> (Sheets, Vec<[u32; 3]>) {
    let mut random = Random(7);
    let mut sheets = Sheets::default();
    for _ in 0..count {
        let (x, y) = (shift * (2.0 * random.next() - 1.0), shift * (2.0 * random.next() - 1.0));
        let color = Vec4::new(random.next(), random.next(), random.next(), 0.3);
        for [dx, dy] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            let depth = 0.1 + 0.8 * random.next();
            sheets.push(Vec4::new(x + dx * size, y + dy * size, depth, 1.0), color);
        }
    }
    let triangles = (0..count).map(|i| 4 * i).flat_map(|i| [[i, i + 1, i + 2], [i, i + 2, i + 3]]);
    (sheets, triangles.collect())
}

fn layers(criterion: &mut Criterion) {
    let mut target = Target::new(1920, 1080, &[Output::Unorm8]).expect("the size is in range");
    let settings = ExecuteSettings { threads: NonZeroUsize::new(1), ..Default::default() };
    let mut rasterizer = Rasterizer::new(settings).expect("the best level is supported");
    // Each cloud covers the image as often as the sheets.
    for (name, (sheets, triangles)) in [
        ("4 sheets", quads(4, 1.1, 0.0)),
        ("200 sheets", quads(200, 1.1, 0.0)),
        ("4 layers of small quads", quads(40_000, 0.01, 1.0)),
        ("200 layers of small quads", quads(500_000, 0.02, 1.0)),
    ] {
        let mut pass = Pass::new();
        let (blend_mode, culling) = (BlendMode::Translucent, Culling::None);
        pass.triangles(Draw { blend_mode, culling, ..Draw::new(&sheets, &triangles) });
        criterion.bench_function(name, |bencher| bencher.iter(|| rasterizer.draw(&pass, &mut target)));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(std::time::Duration::from_millis(200));
    targets = layers
}
criterion_main!(benches);
