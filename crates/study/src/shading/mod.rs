//! What do normals in each pixel buy? Flat, Gouraud and Phong shading (source row D6) of a ball of triangles,
//! compared with the closed form for a sphere.

mod ball;
mod flat;
mod gouraud;
mod phong;

#[cfg(test)]
mod tests;

pub use ball::Ball;

use crate::metric::Difference;
use trigon_classic::Field;
use trigon_math::DVec3;

/// Where light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shading {
    /// Once for each face.
    Flat,
    /// At the corners, and interpolated.
    Gouraud,
    /// In each pixel, from interpolated normals.
    Phong,
}

impl Shading {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Flat, Self::Gouraud, Self::Phong];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Gouraud => "Gouraud",
            Self::Phong => "Phong",
        }
    }

    /// The light in each pixel of a ball; none where it is not.
    #[must_use]
    pub fn draw(self, ball: &Ball) -> Field<Option<f64>> {
        let mut image = ball.image();
        self.draw_into(ball, &mut image);
        image
    }

    /// What draws a ball again and again into the same memory.
    #[must_use]
    pub fn repeated(self, ball: &Ball) -> Box<dyn FnMut() + '_> {
        let mut image = ball.image();
        Box::new(move || {
            image.clear(None);
            self.draw_into(ball, &mut image);
        })
    }

    fn draw_into(self, ball: &Ball, image: &mut Field<Option<f64>>) {
        let shade = match self {
            Self::Flat => flat::draw,
            Self::Gouraud => gouraud::draw,
            Self::Phong => phong::draw,
        };
        ball.faces().iter().for_each(|face| shade(face, image));
    }

    /// How far that is from a ball without triangles, where both are.
    #[must_use]
    pub fn error(self, ball: &Ball) -> Difference {
        let drawn = self.draw(ball);
        let pairs =
            drawn.pixels().filter_map(|(place, light)| Some([(*light)?, light_of(ball.normal(place)?)]));
        Difference::of(pairs)
    }
}

/// What a surface sends to an eye on the z axis: Lambert's law with a highlight (J. F.
/// Blinn, "Models of light reflection for computer synthesized pictures", SIGGRAPH 1977),
/// for a unit normal.
#[must_use]
pub fn light_of(normal: DVec3) -> f64 {
    /// Towards the light, and half way from it to the eye; of length 1.
    const LIGHT: DVec3 = DVec3::new(2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0);
    const HALF: DVec3 = DVec3::new(0.148_249_863, 0.222_374_795, 0.963_624_112);
    let mut highlight = normal.dot(HALF).max(0.0);
    // The exponent is 32.
    for _ in 0..5 {
        highlight *= highlight;
    }
    0.1 + 0.5 * normal.dot(LIGHT).max(0.0) + 0.4 * highlight
}

/// How far the light of an image is from that of the ball in a pixel; 0 beside it.
#[must_use]
pub fn error_at(ball: &Ball, drawn: &Field<Option<f64>>, place: [usize; 2]) -> f64 {
    drawn[place].zip(ball.normal(place)).map_or(0.0, |(light, normal)| (light - light_of(normal)).abs())
}
