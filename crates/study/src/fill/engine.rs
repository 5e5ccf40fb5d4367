//! The engine behind the canvas: one pass counts how many triangles cover each pixel, another stores which
//! one is visible. The two agree wherever only one triangle covers a pixel.

use super::{Canvas, Painted, Triangle};
use crate::engine::{Corners, Engine};
use trigon_classic::Field;

pub(super) fn fill(triangles: &[Triangle], canvas: &mut Canvas) {
    let size = canvas.pixels.size();
    let shape = Corners::flat(triangles, size);
    let mut engine = Engine::default();
    let (counts, seen) = (engine.counts(&shape, size), engine.seen(&shape, size));
    canvas.pixels = Field::from_fn(size, |place| Painted { count: counts[place], last: seen[place] });
}
