//! 4,000 coincident triangles over 640 by 400 pixels, as faces of one object that go round 50
//! draws; and the same ones at different depths, from back to front.

use criterion::{Criterion, criterion_group, criterion_main};
use std::num::NonZeroUsize;
use trigon_math::Vec4;
use trigon_raster::{
    Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, Rasterizer, Target, VertexOutput,
};

const TRIANGLES: u32 = 4000;
const DRAWS: u32 = 50;

/// The triangles of one draw: their corners and faces.
struct Part {
    positions: Vec<Vec4>,
    triangles: Vec<[u32; 3]>,
    faces: Vec<u32>,
}

impl Part {
    /// The faces `number`, `number` + 50, …, in triangles of this width in clip space.
    fn new(number: u32, width: f32, depth: impl Fn(u32) -> f32) -> Self {
        let each = TRIANGLES / DRAWS;
        let mut positions = Vec::new();
        for order in number * each..(number + 1) * each {
            let corner = |x: f32, y: f32| Vec4::new(x * width - 1.0, y * width - 1.0, depth(order), 1.0);
            positions.extend([corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)]);
        }
        let triangles = (0..each).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Self { positions, triangles, faces: (number..TRIANGLES).step_by(DRAWS as usize).collect() }
    }
}

impl Pipeline for Part {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.positions[index], varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        Vec4::ONE
    }
}

fn ties(criterion: &mut Criterion) {
    let settings = ExecuteSettings { threads: NonZeroUsize::new(1), ..Default::default() };
    let mut rasterizer = Rasterizer::new(settings).expect("the best level is supported");
    for samples in [1, 4] {
        let target = Target::new(640, 400, &[Output::Unorm8]).expect("the size is in range");
        let mut target = target.with_samples(samples).expect("a standard pattern");
        // All of the image, and 12 by 8 pixels of it.
        for (size, width) in [("large", 4.0), ("small", 0.0375)] {
            let mut bench = |depths, depth: &dyn Fn(u32) -> f32| {
                let parts: Vec<_> = (0..DRAWS).map(|number| Part::new(number, width, depth)).collect();
                let mut pass = Pass::new();
                for part in &parts {
                    let (faces, culling) = (Some(part.faces.as_slice()), Culling::None);
                    pass.triangles(Draw { faces, culling, ..Draw::new(part, &part.triangles) });
                }
                let name = format!("{size}, {samples} samples, {depths}");
                criterion
                    .bench_function(&name, |bencher| bencher.iter(|| rasterizer.draw(&pass, &mut target)));
            };
            bench("one depth", &|_| 0.5);
            bench("from back to front", &|order| (order + 1) as f32 / (TRIANGLES + 1) as f32);
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10).warm_up_time(std::time::Duration::from_millis(200));
    targets = ties
}
criterion_main!(benches);
