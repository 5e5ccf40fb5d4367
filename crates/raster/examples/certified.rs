//! Which pixels of an image are proven to stay as they are if everything is a little off. Prints a map of a torus,
//! `.` where a pixel may come to see something else and `o` where one of its bytes may change.
//!
//! `cargo run --release -p trigon-raster --example certified [COLUMNS ROWS] [STEPS]`

#![allow(clippy::print_stdout, reason = "the terminal is the screen here")]

use std::error::Error;
use std::time::Instant;
use trigon_raster::math::{Vec4, elementary};
use trigon_raster::{
    Certainty, Draw, Fragment, Output, Pass, Pipeline, Rasterizer, Target, Tolerance, VertexOutput,
};

/// A torus of `2 * steps` by `steps` quads, shaded by its normals.
struct Torus {
    steps: u32,
}

impl Torus {
    fn triangles(&self) -> Vec<[u32; 3]> {
        let (around, along) = (2 * self.steps, self.steps);
        let at = |i: u32, j: u32| i % around * along + j % along;
        let quads = (0..around).flat_map(|i| (0..along).map(move |j| [i, j]));
        let corners = quads.map(|[i, j]| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
        corners.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
    }
}

impl Pipeline for Torus {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        (2 * self.steps * self.steps) as usize
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        let turn = |part: f64| elementary::sin_cos(part * std::f64::consts::TAU);
        let steps = self.steps as usize;
        let (sine, cosine) = turn((index / steps) as f64 / (2 * steps) as f64);
        let (up, out) = turn((index % steps) as f64 / steps as f64);
        let radius = 1.0 + 0.45 * out;
        // Seen from above at a slant, the near plane at 1.
        let (x, y, z) = (radius * cosine, 0.45 * up, radius * sine);
        let (height, distance) = (0.8 * y + 0.6 * -z, 3.2 - 0.6 * y - 0.8 * z);
        let position = [1.3 * x, 1.7 * height, 1.0, distance].map(|v| v as f32);
        VertexOutput { position: Vec4::from_array(position), varyings: (0.5 + 0.4 * up) as f32 }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        Vec4::new(fragment.varyings, 0.3 * fragment.varyings, 0.05, 1.0)
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Result<Vec<u32>, _> = std::env::args().skip(1).map(|argument| argument.parse()).collect();
    let numbers = numbers?;
    let number = |index: usize, usual: u32| numbers.get(index).copied().unwrap_or(usual);
    let (width, height, steps) = (number(0, 100), number(1, 50), number(2, 24));
    let torus = Torus { steps };
    let triangles = torus.triangles();
    let mut pass = Pass::new();
    pass.triangles(Draw::new(&torus, &triangles));
    let target = Target::new(width, height, &[Output::Srgb8])?;
    let start = Instant::now();
    let certificate = Rasterizer::default().certify(&pass, &target, Tolerance::default())?;
    let elapsed = start.elapsed();
    if width <= 200 {
        for row in certificate.pixels().chunks(width as usize) {
            let symbol = |certainty: &Certainty| match certainty {
                Certainty::Certified => ' ',
                Certainty::Visibility => '.',
                Certainty::Color => 'o',
            };
            println!("{}", row.iter().map(symbol).collect::<String>());
        }
    }
    let share = |certainty| 100.0 * certificate.count(certainty) as f64 / certificate.pixels().len() as f64;
    println!(
        "{} triangles: {:.2} % certified, {:.2} % may see something else, {:.2} % may change a byte; {:.0} ms",
        triangles.len(),
        share(Certainty::Certified),
        share(Certainty::Visibility),
        share(Certainty::Color),
        elapsed.as_secs_f64() * 1e3,
    );
    Ok(())
}
