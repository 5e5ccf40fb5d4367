//! Thin opaque triangles within a part of an image of 1920 by 1080 pixels, as in a mesh of which single vertices are
//! dragged far: most of them cross several tiles.

mod one_color;

use criterion::{Criterion, criterion_group, criterion_main};
use one_color::{OneColor, SIZE, Vertex, numbers};
use std::num::NonZeroUsize;
use trigon_raster::{Culling, Draw, ExecuteSettings, Output, Pass, Rasterizer, Target};

const COUNT: u32 = 60_000;

/// Triangles with two corners 1.5 pixels apart and one at this distance.
fn slivers([dx, dy]: [f32; 2]) -> OneColor {
    let mut number = numbers();
    let sliver = |_| {
        let ([x, y], depth) = ([600.0 + 600.0 * number(), 300.0 + 300.0 * number()], number());
        [[x, y], [x, y + 1.5], [x + dx, y + dy]].map(|place| Vertex { place, depth })
    };
    OneColor::new(&(0..COUNT).flat_map(sliver).collect::<Vec<_>>())
}

fn cover(criterion: &mut Criterion) {
    let mut target = Target::new(SIZE[0] as u32, SIZE[1] as u32, &[Output::Unorm8]).expect("in range");
    let settings = ExecuteSettings { threads: NonZeroUsize::new(1), ..Default::default() };
    let mut rasterizer = Rasterizer::new(settings).expect("the best level is supported");
    let triangles: Vec<[u32; 3]> = (0..COUNT).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    for [width, height] in [[50, 4], [40, 30], [90, 30]] {
        let slivers = slivers([width, height].map(|side| side as f32));
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&slivers, &triangles) });
        criterion.bench_function(&format!("slivers of {width} by {height} pixels"), |bencher| {
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
