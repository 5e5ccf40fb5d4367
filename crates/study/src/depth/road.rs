//! An image drawn with a z-buffer of each format: a road that leads to the horizon, and a layer of paint just
//! above it that is drawn later.

use super::DepthFormat;
use trigon_classic::Field;

/// An image of the road.
pub struct Road {
    size: [usize; 2],
    /// The height of the eye above the road, and above the paint, in metres.
    heights: [f64; 2],
}

impl Road {
    /// Seen from a height of 1.7 metres, with paint this many metres above the road, in an image of `width`
    /// pixels and half that height.
    #[must_use]
    pub fn new(width: usize, paint: f64) -> Self {
        Self { size: [width, width / 2], heights: [1.7, 1.7 - paint] }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// One over the distance of a layer at the first pixel's centre, and its steps per column and per row.
    /// The eye is rolled a little, so that no two rows are alike.
    fn inverse_distance(&self, height: f64) -> [f64; 3] {
        const ROLL: f64 = 0.01;
        let scale = self.size[1] as f64 * height;
        [(0.5 + 0.5 * ROLL) / scale, ROLL / scale, 1.0 / scale]
    }

    /// Whether each pixel shows the paint, which is in front everywhere.
    #[must_use]
    pub fn draw(&self, format: DepthFormat) -> Field<bool> {
        let mut buffers = Buffers::new(self);
        buffers.draw(self, format);
        buffers.is_paint
    }

    /// Returns a closure that draws the image repeatedly.
    #[must_use]
    pub fn repeated(&self, format: DepthFormat) -> Box<dyn FnMut() + '_> {
        let mut buffers = Buffers::new(self);
        Box::new(move || buffers.draw(self, format))
    }

    /// Of a thousand pixels, how many show the road instead of the paint.
    #[must_use]
    pub fn wrong_per_mille(&self, format: DepthFormat) -> f64 {
        let drawn = self.draw(format);
        let wrong = drawn.values().iter().filter(|is_paint| !**is_paint).count();
        1e3 * wrong as f64 / drawn.values().len() as f64
    }
}

/// The stored depths, and the layer that each came from.
struct Buffers {
    depths: Field<u32>,
    is_paint: Field<bool>,
}

impl Buffers {
    fn new(road: &Road) -> Self {
        Self { depths: Field::new(road.size, 0), is_paint: Field::new(road.size, false) }
    }

    /// Each layer's depths are linear on the screen, and computed in `f32`.
    fn draw(&mut self, road: &Road, format: DepthFormat) {
        self.depths.clear(format.store(format.depth_at(0.0) as f32));
        self.is_paint.clear(false);
        for (height, is_paint) in road.heights.into_iter().zip([false, true]) {
            let [start, across, down] = road.inverse_distance(height);
            let offset = format.depth_at(0.0);
            let step = |step: f64| (format.depth_at(step) - offset) as f32;
            let (start, across, down) = (format.depth_at(start) as f32, step(across), step(down));
            let rows = self.depths.rows_mut().zip(self.is_paint.rows_mut());
            for (y, (depths, shown)) in rows.enumerate() {
                for (x, (depth, shown)) in depths.iter_mut().zip(shown).enumerate() {
                    let found = format.store(start + across * x as f32 + down * y as f32);
                    if format.is_nearer(found, *depth) {
                        (*depth, *shown) = (found, is_paint);
                    }
                }
            }
        }
    }
}
