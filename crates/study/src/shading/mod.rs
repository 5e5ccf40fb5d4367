//! What do normals in each pixel buy? Flat, Gouraud and Phong shading (source row D6) of a ball of triangles,
//! compared with the closed form for a sphere.

use trigon_classic::{Body, Edges, Field, Pose, weighted};
use trigon_math::DVec3;
use trigon_mesh::primitives;

use super::metric::Difference;

/// Where light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BallShading {
    /// Once for each face.
    Flat,
    /// At the corners, and interpolated.
    Gouraud,
    /// In each pixel, from interpolated normals.
    Phong,
}

impl BallShading {
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
            Self::Flat => draw_flat,
            Self::Gouraud => draw_gouraud,
            Self::Phong => draw_phong,
        };
        ball.faces().iter().for_each(|face| shade(face, image));
    }

    /// How far that is from a ball without triangles, where both are.
    #[must_use]
    pub fn error(self, ball: &Ball) -> Difference {
        let drawn = self.draw(ball);
        let pairs =
            drawn.pixels().filter_map(|(pixel, light)| Some([(*light)?, light_of(ball.normal(pixel)?)]));
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
pub fn error_at(ball: &Ball, drawn: &Field<Option<f64>>, pixel: [usize; 2]) -> f64 {
    drawn[pixel].zip(ball.normal(pixel)).map_or(0.0, |(light, normal)| (light - light_of(normal)).abs())
}

/// The light in each pixel; none where the ball is not.
type BallImage = Field<Option<f64>>;

/// A ball that fills the image.
pub struct Ball {
    side: usize,
    faces: Vec<BallFacet>,
}

/// A face that is turned to the eye.
struct BallFacet {
    edges: Edges,
    /// Unit normals of the ball at the corners.
    normals: [DVec3; 3],
}

impl BallFacet {
    /// Values at the corners made ready for pixels.
    fn shares(&self, values: [f64; 3]) -> [f64; 3] {
        self.edges.shares(values)
    }

    /// Paints the light of each pixel, by the weights of the corners there.
    fn paint(&self, image: &mut BallImage, light: impl Fn([i64; 3]) -> f64) {
        let pixels = self.edges.bounding_box(image.size().map(|side| side as i32));
        self.edges.each_covered(&pixels, |[x, y], weights| {
            image[[x as usize, y as usize]] = Some(light(weights));
        });
    }
}

impl Ball {
    /// An icosahedron, each triangle cut in four `subdivisions` times, in a square
    /// image.
    #[must_use]
    pub fn new(side: usize, subdivisions: u32) -> Self {
        let radius = side as f64 / 2.0;
        let mesh = primitives::icosphere(1.0, subdivisions);
        let pose = Pose::new(0.3, 0.4, radius, DVec3::splat(radius));
        let body = Body::of_mesh(&mesh, pose);
        let normals: Vec<DVec3> =
            mesh.positions().iter().map(|position| pose.turn * position.as_dvec3()).collect();
        let face = |corners: &[usize; 3]| {
            let normals = corners.map(|corner| normals[corner]);
            let [a, b, c] = normals;
            let is_turned_away = (b - a).cross(c - a).z <= 0.0;
            let corners = corners.map(|corner| {
                let [x, y, _] = body.corners[corner];
                [x, y].map(i64::from)
            });
            let edges = Edges::new(corners, 256).filter(|_| !is_turned_away)?;
            Some(BallFacet { edges, normals })
        };
        Self { side, faces: body.triangles.iter().filter_map(face).collect() }
    }

    /// How many faces are turned to the eye.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// An empty image of it.
    fn image(&self) -> BallImage {
        Field::new([self.side; 2], None)
    }

    /// The faces that are turned to the eye.
    fn faces(&self) -> &[BallFacet] {
        &self.faces
    }

    /// The unit normal of the ball itself at the centre of a pixel, if it is there.
    fn normal(&self, [x, y]: [usize; 2]) -> Option<DVec3> {
        let radius = self.side as f64 / 2.0;
        let [x, y] = [(x as f64 + 0.5) / radius - 1.0, 1.0 - (y as f64 + 0.5) / radius];
        let height = 1.0 - x * x - y * y;
        (height > 0.0).then(|| DVec3::new(x, y, height.sqrt()))
    }
}

/// Flat shading (W. J. Bouknight, "A procedure for generation of three-dimensional half-toned computer
/// graphics presentations", 1970): one light value per face.
fn draw_flat(face: &BallFacet, image: &mut BallImage) {
    let [a, b, c] = face.normals;
    let light = light_of((b - a).cross(c - a).normalize());
    face.paint(image, |_| light);
}

/// H. Gouraud, "Continuous shading of curved surfaces", IEEE Transactions on Computers, 1971: light is
/// computed at the corners and interpolated.
fn draw_gouraud(face: &BallFacet, image: &mut BallImage) {
    let lights = face.shares(face.normals.map(light_of));
    face.paint(image, |weights| weighted(&lights, weights));
}

/// B. T. Phong, "Illumination for computer generated pictures", CACM 18(6), 1975: normals are interpolated,
/// and light is computed in each pixel.
fn draw_phong(face: &BallFacet, image: &mut BallImage) {
    let normals = [0, 1, 2].map(|axis| face.shares(face.normals.map(|normal| normal[axis])));
    face.paint(image, |weights| {
        let normal = DVec3::from(normals.map(|shares| weighted(&shares, weights)));
        light_of(normal.normalize())
    });
}

#[cfg(test)]
mod tests;
