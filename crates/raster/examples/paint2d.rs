//! A panel with a title, drawn as a user interface toolkit would: triangles with
//! feathered edges, and glyphs as quads with texels one to one.
//!
//! `cargo run --release -p trigon-raster --example paint2d [panel.ppm]` writes a
//! PPM image, or letters to the terminal.

#![allow(clippy::print_stdout, reason = "the terminal is the screen here")]

use std::error::Error;
use std::{env, fs};
use trigon_raster::paint2d::{Canvas, Image, Mesh, Painter, Rect, Vertex};

const WIDTH: u32 = 96;
const HEIGHT: u32 = 40;

/// Letters of 5 by 7 texels, a row of bits for each line.
const LETTERS: [(char, [u8; 7]); 6] = [
    ('T', [0b11111, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100]),
    ('R', [0b11110, 0b10001, 0b10001, 0b11110, 0b10100, 0b10010, 0b10001]),
    ('I', [0b01110, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110]),
    ('G', [0b01110, 0b10001, 0b10000, 0b10111, 0b10001, 0b10001, 0b01110]),
    ('O', [0b01110, 0b10001, 0b10001, 0b10001, 0b10001, 0b10001, 0b01110]),
    ('N', [0b10001, 0b11001, 0b10101, 0b10011, 0b10001, 0b10001, 0b10001]),
];
/// Texels from one letter to the next, the gap included.
const ADVANCE: u32 = 6;

/// All letters in a row, white where there is ink.
fn atlas() -> Result<Image, Box<dyn Error>> {
    let width = ADVANCE * LETTERS.len() as u32;
    let texel = |x: u32, y: u32| {
        let bits = LETTERS[(x / ADVANCE) as usize].1[y as usize];
        let ink = x % ADVANCE < 5 && bits >> (4 - x % ADVANCE) & 1 == 1;
        if ink { [255; 4] } else { [0; 4] }
    };
    let texels = (0..7).flat_map(|y| (0..width).map(move |x| texel(x, y))).collect();
    Ok(Image::new(width, 7, texels)?)
}

/// Vertices and triangles to be.
#[derive(Default)]
struct Shape {
    vertices: Vec<Vertex>,
    indices: Vec<u32>,
}

impl Shape {
    /// A rectangle with rounded corners; its edge fades within a pixel.
    fn panel(&mut self, [min, max]: [[f32; 2]; 2], radius: f32, color: [u8; 4]) {
        const STEPS: u32 = 8;
        let first = self.vertices.len() as u32;
        for step in 0..4 * STEPS {
            let quarter = step / STEPS;
            let angle = f64::from(quarter) * 90.0 + f64::from(step % STEPS) * 90.0 / f64::from(STEPS - 1);
            let (sine, cosine) = trigon_raster::math::elementary::sin_cos(angle.to_radians());
            let outward = [cosine as f32, sine as f32];
            let side = |axis: usize, far: bool| if far { max[axis] - radius } else { min[axis] + radius };
            let corner = [side(0, matches!(quarter, 0 | 3)), side(1, quarter < 2)];
            for (by, color) in [(radius - 0.5, color), (radius + 0.5, [0; 4])] {
                let position = [0, 1].map(|axis| corner[axis] + outward[axis] * by);
                self.vertices.push(Vertex { position, uv: [0.0; 2], color });
            }
            let [inner, next] = [step, (step + 1) % (4 * STEPS)].map(|step| first + 2 * step);
            self.indices.extend([first, inner, next]);
            self.indices.extend([inner, inner + 1, next + 1, next + 1, next, inner]);
        }
    }

    /// A line of text from its upper left corner; unknown letters are blanks.
    fn text(&mut self, text: &str, [x, y]: [f32; 2], color: [u8; 4]) {
        for (place, letter) in text.chars().enumerate() {
            let Some(index) = LETTERS.iter().position(|(known, _)| *known == letter) else { continue };
            let first = self.vertices.len() as u32;
            for corner in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0_f32]] {
                let position = [x + place as f32 * ADVANCE as f32 + 5.0 * corner[0], y + 7.0 * corner[1]];
                let texel = index as f32 * ADVANCE as f32 + 5.0 * corner[0];
                let uv = [texel / (ADVANCE as f32 * LETTERS.len() as f32), corner[1]];
                self.vertices.push(Vertex { position, uv, color });
            }
            self.indices.extend([0, 1, 2, 2, 3, 0].map(|i| first + i));
        }
    }

    fn mesh<'a>(&'a self, image: Option<&'a Image>) -> Mesh<'a> {
        let scissor = Rect::new([0, 0], [WIDTH as i32, HEIGHT as i32]);
        Mesh { scissor, vertices: &self.vertices, indices: &self.indices, image }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut panels = Shape::default();
    // Colours are multiplied by their alpha.
    panels.panel([[6.0, 5.0], [92.0, 37.0]], 8.0, [0, 0, 0, 110]);
    panels.panel([[4.0, 3.0], [90.0, 35.0]], 8.0, [40, 70, 120, 235]);
    panels.panel([[10.0, 22.0], [84.0, 30.0]], 4.0, [90, 90, 90, 90]);
    let mut text = Shape::default();
    text.text("TRIGON", [29.0, 9.0], [255, 220, 120, 255]);

    let mut pixels = vec![[230, 230, 225, 255]; (WIDTH * HEIGHT) as usize];
    let mut canvas = Canvas::new(WIDTH, HEIGHT, &mut pixels)?;
    let atlas = atlas()?;
    Painter::new().paint(&mut canvas, &[panels.mesh(None), text.mesh(Some(&atlas))]);

    if let Some(path) = env::args().nth(1) {
        let header = format!("P6 {WIDTH} {HEIGHT} 255\n").into_bytes();
        let colors = pixels.iter().flat_map(|&[r, g, b, _]| [r, g, b]);
        fs::write(path, header.into_iter().chain(colors).collect::<Vec<u8>>())?;
    } else {
        let symbol = |[_, green, ..]: &[u8; 4]| char::from(b"@#*+-. "[usize::from(*green) * 7 / 256]);
        for row in pixels.chunks(WIDTH as usize).step_by(2) {
            println!("{}", row.iter().map(symbol).collect::<String>());
        }
    }
    Ok(())
}
