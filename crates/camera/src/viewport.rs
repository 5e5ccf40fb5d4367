//! The size of an image in pixels.

use trigon_math::DVec2;

/// An image of `width` by `height` pixels. On the screen the origin is the top-left corner, y
/// points down, and pixel `(i, j)` has its centre at `(i + 0.5, j + 0.5)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Viewport {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
}

impl Viewport {
    /// Width over height. An image without area counts as square, so that a minimized window causes
    /// no division by zero.
    #[must_use]
    pub fn aspect(self) -> f64 {
        if self.width == 0 || self.height == 0 {
            return 1.0;
        }
        f64::from(self.width) / f64::from(self.height)
    }

    /// Width and height as a vector.
    #[must_use]
    pub fn size(self) -> DVec2 {
        DVec2::new(f64::from(self.width), f64::from(self.height))
    }

    /// From normalized device coordinates (x right, y up, the image is `[-1, 1]²`) to the screen.
    #[must_use]
    pub fn to_screen(self, ndc: DVec2) -> DVec2 {
        let size = self.size();
        DVec2::new((1.0 + ndc.x) * 0.5 * size.x, (1.0 - ndc.y) * 0.5 * size.y)
    }

    /// From the screen to normalized device coordinates. Not finite if the image has no area.
    #[must_use]
    pub fn to_ndc(self, screen: DVec2) -> DVec2 {
        let size = self.size();
        DVec2::new(2.0 * screen.x / size.x - 1.0, 1.0 - 2.0 * screen.y / size.y)
    }
}
