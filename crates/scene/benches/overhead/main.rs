//! What the scene renderer costs above a pipeline written by hand for the same image: a torus knot of 70,000
//! triangles, in the classes of material that [`Class`] names.
//!
//! Times, or instructions of one warm frame:
//!
//! ```sh
//! cargo bench -p trigon-scene --bench overhead -- scene plain 50
//! program=$(ls -t target/release/deps/overhead-* | grep -v '\.d$' | head -n 1)
//! valgrind --tool=callgrind --demangle=no --toggle-collect='*shortest*' "$program" hand plain 1
//! ```
//!
//! The first word is `scene` or `hand`, the second a class. Before a time by hand is printed, the image is compared with
//! that of the scene renderer: see [`check`].

#![expect(clippy::print_stdout, reason = "a number is what this is for")]

mod by_hand;
mod by_scene;
mod image;
mod lanes;

use std::error::Error;
use std::time::Instant;

use crate::image::Class;

const USAGE: &str = "write: scene|hand plain|textured|lit|mapped|metal FRAMES";

fn main() -> Result<(), Box<dyn Error>> {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| word != "--bench").collect();
    let [by, class, frames] = words.as_slice() else {
        return Err(USAGE.into());
    };
    let frames: u32 = frames.parse()?;
    let class = Class::ALL.into_iter().find(|of| of.name() == class).ok_or(USAGE)?;
    let time = match by.as_str() {
        "scene" => {
            let mut drawing = by_scene::Drawing::new(class)?;
            shortest(frames, || drawing.draw())?
        }
        "hand" => by_hand::time(class, frames)?,
        _ => return Err(USAGE.into()),
    };
    println!("{by} {}: {time:.3} ms (the shortest of {frames})", class.name());
    Ok(())
}

/// Refuses images that differ: by more than one of 255 in more than one pixel of 100,000. Coordinates that are
/// rounded otherwise may lie on the other side of a texel of the shadow map.
fn check(drawn: &[u8], expected: &[u8]) -> Result<(), Box<dyn Error>> {
    let differ = |(a, b): (&[u8], &[u8])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 1);
    let pixels = || drawn.chunks(4).zip(expected.chunks(4));
    let [unequal, wrong] =
        [pixels().filter(|(a, b)| a != b).count(), pixels().filter(|&of| differ(of)).count()];
    println!("{unequal} pixels are not equal, {wrong} differ by more than one");
    if drawn.len() != expected.len() || wrong * 100_000 > drawn.len() / 4 {
        return Err("the images differ".into());
    }
    Ok(())
}

/// The shortest time of a frame in milliseconds.
fn shortest(
    frames: u32,
    mut frame: impl FnMut() -> Result<(), Box<dyn Error>>,
) -> Result<f64, Box<dyn Error>> {
    let mut shortest = f64::INFINITY;
    for _ in 0..frames {
        let start = Instant::now();
        frame()?;
        shortest = shortest.min(start.elapsed().as_secs_f64() * 1e3);
    }
    Ok(shortest)
}
