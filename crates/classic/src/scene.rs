//! Bodies projected to the screen, for all algorithms alike.

use thiserror::Error;
use trigon_math::{DMat3, DVec3, elementary};
use trigon_mesh::Mesh;

/// A point in 1/256 pixel: right and down from the top left corner, and towards the eye.
pub type Corner = [i32; 3];

/// One body: triangles between corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Where the corners lie.
    pub corners: Vec<Corner>,
    /// Indices of corners, in either winding.
    pub triangles: Vec<[usize; 3]>,
}

impl Body {
    /// A mesh, turned, scaled and moved; all in pixels, z towards the eye.
    pub fn of_mesh(mesh: &Mesh, pose: Pose) -> Self {
        let project = |position: &trigon_math::Vec3| {
            let turned = pose.turn * position.as_dvec3() * pose.scale;
            let point = DVec3::new(turned.x, -turned.y, turned.z) + pose.middle;
            (point * f64::from(STEPS_PER_PIXEL)).round().as_ivec3().to_array()
        };
        let corners = mesh.positions().iter().map(project).collect();
        let vertices = mesh.corner_vertices();
        let triangles = mesh.triangulation().triangles.into_iter();
        let triangles = triangles.map(|t| t.map(|corner| vertices[corner as usize] as usize)).collect();
        Self { corners, triangles }
    }

    /// A tetrahedron.
    #[must_use]
    pub fn tetrahedron(corners: [Corner; 4]) -> Self {
        let triangles = vec![[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]];
        Self { corners: corners.to_vec(), triangles }
    }
}

/// How a mesh stands in an image.
#[derive(Clone, Copy, Debug)]
pub struct Pose {
    /// How it is turned.
    pub turn: DMat3,
    /// Pixels for a metre.
    pub scale: f64,
    /// Where its origin lies, in pixels; z is at least its depth, so that none is
    /// negative.
    pub middle: DVec3,
}

impl Pose {
    /// Turned about the upright axis, then tilted towards the eye, in radians.
    #[must_use]
    pub fn new(angle: f64, tilt: f64, scale: f64, middle: DVec3) -> Self {
        let ((s, c), (u, v)) = (elementary::sin_cos(angle), elementary::sin_cos(tilt));
        let about = DMat3::from_cols_array(&[c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c]);
        let tilted = DMat3::from_cols_array(&[1.0, 0.0, 0.0, 0.0, v, u, 0.0, -u, v]);
        Self { turn: tilted * about, scale, middle }
    }
}

/// How many steps of the grid make a pixel: as many as the engine's.
pub const STEPS_PER_PIXEL: i32 = 256;

/// The depth below which all corners lie, in the same steps.
pub const DEPTH_LIMIT: i32 = 1 << 18;

/// One triangle of a body.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Its corners, in either winding.
    pub corners: [Corner; 3],
    /// The number of its body in the scene.
    pub body: usize,
}

/// Bodies before the eye, which looks along parallel rays: what is left after any
/// projection.
#[derive(Clone, Debug)]
pub struct Scene {
    size: [usize; 2],
    bodies: Vec<Body>,
    faces: Vec<Face>,
}

impl Scene {
    /// An image of bodies.
    #[must_use]
    pub fn new(size: [usize; 2], bodies: Vec<Body>) -> Self {
        let of_body = |(number, body): (usize, &Body)| -> Vec<Face> {
            let face =
                |triangle: &[usize; 3]| Face { corners: triangle.map(|i| body.corners[i]), body: number };
            body.triangles.iter().map(face).collect()
        };
        let faces = bodies.iter().enumerate().flat_map(of_body).collect();
        Self { size, bodies, faces }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// The bodies.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// How many triangles all bodies have; they are numbered body by body.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.faces.len()
    }

    /// The faces in the order of their numbers.
    pub fn faces(&self) -> impl Iterator<Item = (u32, &Face)> {
        (0..).zip(&self.faces)
    }

    /// The face of a number.
    ///
    /// # Panics
    /// If the scene has fewer faces.
    #[must_use]
    pub fn face(&self, number: u32) -> &Face {
        &self.faces[number as usize]
    }

    /// Width and height, in the type of coordinates.
    #[must_use]
    pub fn limits(&self) -> [i32; 2] {
        self.size.map(|side| side as i32)
    }
}

/// Why Roberts' algorithm refuses a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "body {body} is not convex: its corner {corner} lies outside of its triangle {triangle}; cut it into convex parts, or draw it with another algorithm"
)]
pub struct NotConvex {
    /// The number of the body in the scene.
    pub body: usize,
    /// The number of a triangle in the body.
    pub triangle: usize,
    /// A corner that lies on the other side of it than the body does.
    pub corner: usize,
}
