//! A user interface painted anew, 1920 by 1080 pixels: what it is made of, one
//! after the other, and all of it.

use criterion::{Criterion, criterion_group, criterion_main};
use std::f64::consts::TAU;
use std::hint::black_box;
use trigon_raster::math::elementary;
use trigon_raster::paint2d::{Canvas, Image, Mesh, Painter, Rect, Vertex};

const WIDTH: u32 = 1920;
const HEIGHT: u32 = 1080;

/// A mesh to be, in the style of egui: all textured by one atlas, whose first
/// texel is white.
#[derive(Default)]
struct Layer {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Layer {
    fn quad(&mut self, [min, max]: [[f32; 2]; 2], [uv_min, uv_max]: [[f32; 2]; 2], color: [u8; 4]) {
        let first = self.vertices.len() as u32;
        for [right, lower] in [[false, false], [true, false], [false, true], [true, true]] {
            let pick = |min: [f32; 2], max: [f32; 2]| {
                [if right { max[0] } else { min[0] }, if lower { max[1] } else { min[1] }]
            };
            self.vertices.push(Vertex { position: pick(min, max), uv: pick(uv_min, uv_max), color });
        }
        self.indices.extend([0, 1, 2, 2, 1, 3].map(|i| first + i));
    }

    /// A rounded rectangle with an edge that fades within a pixel, as a fan.
    fn panel(&mut self, [min, max]: [[f32; 2]; 2], radius: f32, color: [u8; 4]) {
        const STEPS: u32 = 32;
        let first = self.vertices.len() as u32;
        for step in 0..STEPS {
            let (sine, cosine) = elementary::sin_cos(TAU * f64::from(step) / f64::from(STEPS) + 0.02);
            let outward = [cosine as f32, sine as f32];
            for (by, color) in [(radius - 0.5, color), (radius + 0.5, [0; 4])] {
                let side = |axis: usize| {
                    if outward[axis] > 0.0 { max[axis] - radius } else { min[axis] + radius }
                };
                let position = [side(0) + outward[0] * by, side(1) + outward[1] * by];
                self.vertices.push(Vertex { position, uv: [0.0; 2], color });
            }
            let [inner, next] = [step, (step + 1) % STEPS].map(|step| first + 2 * step);
            self.indices.extend([first, inner, next, inner, next, next + 1, inner, inner + 1, next + 1]);
        }
    }

    fn mesh<'a>(&'a self, image: &'a Image) -> Mesh<'a> {
        let scissor = Rect::new([0, 0], [WIDTH as i32, HEIGHT as i32]);
        Mesh { scissor, vertices: &self.vertices, indices: &self.indices, image: Some(image) }
    }
}

/// 60 panels, every other one translucent.
fn panels() -> Layer {
    let mut layer = Layer::default();
    for i in 0..60_u16 {
        let [x, y] = [f32::from(i % 10) * 190.0 + 12.3, f32::from(i / 10) * 178.0 + 9.6];
        let color = if i % 2 == 0 { [40, 44, 52, 255] } else { [30, 36, 48, 180] };
        layer.panel([[x, y], [x + 178.0, y + 166.0]], 6.0, color);
    }
    layer
}

/// 4,000 glyphs of 7 by 11 pixels.
fn glyphs() -> Layer {
    let mut layer = Layer::default();
    for i in 0..4000_u16 {
        let [x, y] = [f32::from(i % 200) * 9.0 + 40.0, f32::from(i / 200) * 50.0 + 30.0];
        let texel = [f32::from(i % 26) * 8.0 + 8.0, 8.0];
        let uv = |texel: [f32; 2]| texel.map(|v| v / ATLAS as f32);
        layer.quad(
            [[x, y], [x + 7.0, y + 11.0]],
            [uv(texel), uv([texel[0] + 7.0, texel[1] + 11.0])],
            [220, 224, 230, 255],
        );
    }
    layer
}

/// Six translucent sheets of a third of the screen each.
fn sheets() -> Layer {
    let mut layer = Layer::default();
    for i in 0..6_u16 {
        let x = f32::from(i) * 240.0 + 0.5;
        layer.quad([[x, 20.0], [x + 700.0, 1060.0]], [[0.0; 2]; 2], [10, 20, 30, 90]);
    }
    layer
}

const ATLAS: u32 = 256;

/// White at the first texel; elsewhere dots and holes, as in letters.
fn atlas() -> Image {
    let texel = |i: u32| {
        let ink = if i == 0 { 255 } else { i.wrapping_mul(2_654_435_761) >> 24 };
        [if ink > 100 { ink as u8 } else { 0 }; 4]
    };
    Image::new(ATLAS, ATLAS, (0..ATLAS * ATLAS).map(texel).collect()).expect("the sides and the texels agree")
}

fn interface(criterion: &mut Criterion) {
    let atlas = atlas();
    let layers = [("panels", panels()), ("glyphs", glyphs()), ("sheets", sheets())];
    let mut pixels = vec![[20, 20, 20, 255]; (WIDTH * HEIGHT) as usize];
    let mut canvas = Canvas::new(WIDTH, HEIGHT, &mut pixels).expect("the sides and the pixels agree");
    let mut painter = Painter::new();
    let mut group = criterion.benchmark_group("paint2d");
    for (name, layer) in &layers {
        group.bench_function(*name, |b| {
            b.iter(|| painter.paint(black_box(&mut canvas), &[layer.mesh(&atlas)]));
        });
    }
    let all: Vec<Mesh<'_>> = layers.iter().map(|(_, layer)| layer.mesh(&atlas)).collect();
    group.bench_function("interface", |b| b.iter(|| painter.paint(black_box(&mut canvas), &all)));
    group.finish();
}

criterion_group!(benches, interface);
criterion_main!(benches);
