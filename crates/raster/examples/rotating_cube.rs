//! A rotating cube with a colour in each corner, in the terminal: a pipeline of
//! one's own, and no scene.
//!
//! `cargo run --release -p trigon-raster --example rotating_cube [frames]`

#![allow(clippy::print_stdout, reason = "the terminal is the screen here")]

use std::{env, thread, time::Duration};
use trigon_math::{Mat4, Vec3, Vec4, elementary, look_at_mat4, perspective_infinite_reverse};
use trigon_raster::{
    Draw, EdgeFlags, Fragment, Output, Pass, Pipeline, Rasterizer, Target, TargetError, VertexOutput,
};

const WIDTH: u32 = 80;
const HEIGHT: u32 = 40;

/// Four corners for each side, counter-clockwise from outside; bit 0 of a
/// corner's number is its x, bit 1 its y, bit 2 its z.
const SIDES: [[u32; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

struct Cube {
    to_clip_space: Mat4,
}

impl Pipeline for Cube {
    /// The colour.
    type Varyings = Vec3;

    fn vertex_count(&self) -> usize {
        8
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec3> {
        let corner = Vec3::new((index & 1) as f32, (index >> 1 & 1) as f32, (index >> 2) as f32);
        let position = self.to_clip_space * (corner * 2.0 - 1.0).extend(1.0);
        VertexOutput { position, varyings: corner }
    }

    fn fragment(&self, fragment: &Fragment<Vec3>) -> Vec4 {
        // The twelve edges are drawn by the sides themselves.
        let edge = if fragment.nearest_edge() < 0.7 { 1.0 } else { 0.0 };
        fragment.varyings.lerp(Vec3::ONE, edge).extend(1.0)
    }
}

/// From the cube to clip space: two units wide, turned by `angle` radians and
/// seen from a little above.
fn camera(angle: f64) -> Mat4 {
    let (sine, cosine) = elementary::sin_cos(angle);
    let eye = Vec3::new(sine as f32 * 4.0, 2.0, cosine as f32 * 4.0);
    // Characters are about twice as high as wide.
    let aspect = WIDTH as f32 / HEIGHT as f32 / 2.0;
    perspective_infinite_reverse(0.8, aspect, 0.1) * look_at_mat4(eye, Vec3::ZERO, Vec3::Y)
}

/// One character for each pixel, coloured in terminals that know 24-bit colour.
fn print(target: &Target) {
    let rows = target.srgb8().unwrap_or_default().chunks(WIDTH as usize);
    for row in rows {
        let cell = |&[r, g, b, a]: &[u8; 4]| match a {
            0 => " ".to_owned(),
            _ => format!("\x1b[48;2;{r};{g};{b}m \x1b[0m"),
        };
        println!("{}", row.iter().map(cell).collect::<String>());
    }
}

fn main() -> Result<(), TargetError> {
    let frames = env::args().nth(1).and_then(|count| count.parse().ok()).unwrap_or(60);
    let triangles: Vec<_> = SIDES.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    // The diagonal of a side is the last edge of its first triangle and the
    // first of its second.
    let halves = [EdgeFlags::new([true, true, false]), EdgeFlags::new([false, true, true])];
    let edges = halves.repeat(SIDES.len());
    let mut rasterizer = Rasterizer::default();
    let mut target = Target::new(WIDTH, HEIGHT, &[Output::Srgb8])?.with_samples_per_axis(3)?;
    for frame in 0..frames {
        let cube = Cube { to_clip_space: camera(f64::from(frame) * 0.1) };
        let mut pass = Pass::new();
        pass.triangles(Draw { edge_flags: Some(&edges), ..Draw::new(&cube, &triangles) });
        rasterizer.draw(&pass, &mut target);
        // Back to the top left of the terminal.
        print!("\x1b[H");
        print(&target);
        thread::sleep(Duration::from_millis(30));
    }
    Ok(())
}
