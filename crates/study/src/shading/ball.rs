//! A ball of triangles in parallel projection.

use trigon_classic::{Body, Edges, Field, Pose};
use trigon_math::DVec3;
use trigon_mesh::primitives;

/// The light in each pixel; none where the ball is not.
pub(super) type BallImage = Field<Option<f64>>;

/// A ball that fills the image.
pub struct Ball {
    side: usize,
    faces: Vec<Facet>,
}

/// A face that is turned to the eye.
pub(super) struct Facet {
    edges: Edges,
    /// Unit normals of the ball at the corners.
    pub(super) normals: [DVec3; 3],
}

impl Facet {
    /// Values at the corners made ready for pixels.
    pub(super) fn shares(&self, values: [f64; 3]) -> [f64; 3] {
        self.edges.shares(values)
    }

    /// Paints the light of each pixel, by the weights of the corners there.
    pub(super) fn paint(&self, image: &mut BallImage, light: impl Fn([i64; 3]) -> f64) {
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
            Some(Facet { edges, normals })
        };
        Self { side, faces: body.triangles.iter().filter_map(face).collect() }
    }

    /// How many faces are turned to the eye.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// An empty image of it.
    pub(super) fn image(&self) -> BallImage {
        Field::new([self.side; 2], None)
    }

    /// The faces that are turned to the eye.
    pub(super) fn faces(&self) -> &[Facet] {
        &self.faces
    }

    /// The unit normal of the ball itself at the centre of a pixel, if it is there.
    pub(super) fn normal(&self, [x, y]: [usize; 2]) -> Option<DVec3> {
        let radius = self.side as f64 / 2.0;
        let [x, y] = [(x as f64 + 0.5) / radius - 1.0, 1.0 - (y as f64 + 0.5) / radius];
        let height = 1.0 - x * x - y * y;
        (height > 0.0).then(|| DVec3::new(x, y, height.sqrt()))
    }
}
