//! What does a shadow's edge cost? A ball of triangles above a floor, lit from one direction: shadow maps of
//! several sizes and filters, rays, and the engine's own of both kinds, compared with the exact shadow of the
//! same triangles.

mod ball_on_floor;
mod engine;
mod map;
mod rays;

#[cfg(test)]
mod tests;

use crate::metric::Difference;
use trigon_classic::Field;

pub use engine::Drawer;
pub use map::ShadowMap;
pub use rays::ShadowRays;

/// How the four texels about a point are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MapFilter {
    /// The nearest.
    Nearest,
    /// All four, weighted.
    Linear,
}

/// A way to find shadows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shadow {
    /// A depth map of so many texels a side.
    Map(usize, MapFilter),
    /// A ray to the light from each pixel, against a ball of triangles.
    Rays,
}

impl Shadow {
    /// All methods that are compared.
    pub const ALL: [Self; 9] = [
        Self::Map(64, MapFilter::Nearest),
        Self::Map(64, MapFilter::Linear),
        Self::Map(256, MapFilter::Nearest),
        Self::Map(256, MapFilter::Linear),
        Self::Map(1024, MapFilter::Nearest),
        Self::Map(1024, MapFilter::Linear),
        Self::Map(4096, MapFilter::Nearest),
        Self::Map(4096, MapFilter::Linear),
        Self::Rays,
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Map(side, MapFilter::Nearest) => format!("map {side}"),
            Self::Map(side, MapFilter::Linear) => format!("map {side}, filtered"),
            Self::Rays => "rays".to_owned(),
        }
    }

    /// What says how much light a point of the floor gets, made ready.
    #[must_use]
    pub fn ready(self) -> Box<dyn Fn([f64; 2]) -> f64> {
        match self {
            Self::Map(side, filter) => {
                let map = ShadowMap::new(side);
                Box::new(move |point| map.light(point, filter))
            }
            Self::Rays => {
                let rays = ShadowRays::new();
                Box::new(move |point| rays.light(point))
            }
        }
    }
}

/// The light on a floor of `side` by `side` pixels as something says it.
pub fn draw(side: usize, light: &dyn Fn([f64; 2]) -> f64) -> Field<f64> {
    let mut image = Field::new([side; 2], 0.0);
    draw_into(&mut image, light);
    image
}

/// The same into a square image.
pub fn draw_into(image: &mut Field<f64>, light: &dyn Fn([f64; 2]) -> f64) {
    let [side, _] = image.size();
    for (y, row) in image.rows_mut().enumerate() {
        for (x, pixel) in row.iter_mut().enumerate() {
            *pixel = light(ball_on_floor::point([x, y], side));
        }
    }
}

/// The light as it is: 0 where a triangle of the ball is between a pixel's centre and the light,
/// else 1.
#[must_use]
pub fn exact(side: usize) -> Field<f64> {
    ball_on_floor::exact(side)
}

/// How far an image is from right, in the pixels that lie within two of the shadow's edge.
#[must_use]
pub fn error(drawn: &Field<f64>, right: &Field<f64>) -> Difference {
    let is_near_edge = |[x, y]: [usize; 2]| {
        let around =
            (y.saturating_sub(2)..=y + 2).flat_map(|y| (x.saturating_sub(2)..=x + 2).map(move |x| [x, y]));
        let mut lights = around.filter_map(|place| right.get(place.map(|part| part as i32)));
        lights.any(|light| *light != right[[x, y]])
    };
    let near = drawn.pixels().filter(|(place, _)| is_near_edge(*place));
    Difference::of(near.map(|(place, &light)| [light, right[place]]))
}
