//! What does a division in each pixel buy? Texture coordinates on a wall in perspective: linear on the
//! screen, linear between divisions, divided in each pixel.

mod affine;
mod engine;
mod every16;
mod perspective;
mod wall;

#[cfg(test)]
mod tests;

pub use wall::{Texel, Wall};

use trigon_classic::Field;

/// A method of interpolation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Interpolation {
    /// Linear on the screen.
    Affine,
    /// Divided at every 16th pixel of a row, and linear between.
    Every16,
    /// Divided in each pixel.
    Perspective,
    /// The renderer.
    Engine,
}

impl Interpolation {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Affine, Self::Every16, Self::Perspective, Self::Engine];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Affine => "affine",
            Self::Every16 => "perspective every 16 pixels",
            Self::Perspective => "perspective",
            Self::Engine => "engine",
        }
    }

    /// The texel at the centre of each pixel of a wall; none outside of it.
    #[must_use]
    pub fn draw(self, wall: &Wall) -> Field<Option<Texel>> {
        if self == Self::Engine {
            let mut drawer = engine::Drawer::new(wall);
            drawer.draw();
            return drawer.image();
        }
        let mut image = Field::new(wall.size, None);
        self.draw_into(wall, &mut image);
        image
    }

    /// Returns a closure that draws a wall repeatedly and keeps everything that can be kept.
    #[must_use]
    pub fn repeated(self, wall: &Wall) -> Box<dyn FnMut() + '_> {
        if self == Self::Engine {
            let mut drawer = engine::Drawer::new(wall);
            return Box::new(move || drawer.draw());
        }
        let mut image = Field::new(wall.size, None);
        Box::new(move || {
            image.clear(None);
            self.draw_into(wall, &mut image);
        })
    }

    /// By one of the classical ways.
    fn draw_into(self, wall: &Wall, image: &mut Field<Option<Texel>>) {
        match self {
            Self::Affine => wall.draw_into(image, affine::row),
            Self::Every16 => wall.draw_into(image, every16::row),
            Self::Perspective => wall.draw_into(image, perspective::row),
            Self::Engine => {}
        }
    }

    /// The errors of the texels.
    pub fn errors(self, wall: &Wall) -> TexelErrors {
        let drawn = self.draw(wall);
        let distance = |(place, texel): ([usize; 2], &Option<Texel>)| {
            let [[u, v], [right_u, right_v]] = [texel.as_ref()?.map(f64::from), wall.texel(place)?];
            Some((u - right_u) * (u - right_u) + (v - right_v) * (v - right_v))
        };
        let squares: Vec<f64> = drawn.pixels().filter_map(distance).collect();
        TexelErrors {
            rms: (squares.iter().sum::<f64>() / squares.len() as f64).sqrt(),
            worst: squares.iter().copied().fold(0.0, f64::max).sqrt(),
        }
    }
}

/// Distances from the correct texel, in texels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TexelErrors {
    /// The root of the mean square.
    pub rms: f64,
    /// The greatest.
    pub worst: f64,
}
