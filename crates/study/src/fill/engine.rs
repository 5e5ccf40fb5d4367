//! The renderer behind the canvas: one pass counts, another tells the winner, who is the
//! same wherever only one triangle covers a pixel.

use super::{Canvas, Painted, Triangle};
use crate::engine::{Corners, Engine};
use crate::field::Field;

pub(super) fn fill(triangles: &[Triangle], canvas: &mut Canvas) {
    let size = canvas.pixels.size();
    let shape = Corners::flat(triangles, size);
    let mut engine = Engine::default();
    let (counts, seen) = (engine.counts(&shape, size), engine.seen(&shape, size));
    canvas.pixels = Field::from_fn(size, |place| Painted { count: counts[place], last: seen[place] });
}
