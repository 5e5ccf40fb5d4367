//! What all standard objects are made with: a builder that keeps texture
//! coordinates and normals beside the faces.

use trigon_math::{Vec2, Vec3, area_vector};

use crate::{Attributes, Mesh, MeshBuilder};

/// The highest number of pieces along one direction of a surface: four
/// million faces for the largest grid.
pub(super) const MOST_PIECES: u32 = 2048;

/// The image's corners, counter-clockwise from the lower left one.
pub(super) const SQUARE: [Vec2; 4] =
    [Vec2::new(0.0, 1.0), Vec2::new(1.0, 1.0), Vec2::new(1.0, 0.0), Vec2::new(0.0, 0.0)];

/// A length in metres as the functions of this module take it.
pub(super) fn length(length: f32) -> f32 {
    if length.is_finite() && length > 0.0 { length } else { 1.0 }
}

/// A corner of a face of a curved surface, with the surface's normal there.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) vertex: u32,
    pub(super) uv: Vec2,
    pub(super) normal: Vec3,
}

/// A mesh in the making.
pub(super) struct Solid {
    builder: MeshBuilder,
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    smooth: Vec<bool>,
}

impl Solid {
    pub(super) fn with_capacity(vertices: usize, faces: usize, corners: usize) -> Self {
        Self {
            builder: MeshBuilder::with_capacity(vertices, faces, corners),
            positions: Vec::with_capacity(vertices),
            uvs: Vec::with_capacity(corners),
            normals: Vec::with_capacity(corners),
            smooth: Vec::with_capacity(faces),
        }
    }

    pub(super) fn vertex(&mut self, position: Vec3) -> u32 {
        self.positions.push(position);
        self.builder.push_vertex(position)
    }

    /// A flat face.
    pub(super) fn face(&mut self, vertices: &[u32], uvs: &[Vec2]) {
        let corners = vertices.iter().map(|&v| self.positions[v as usize].as_dvec3());
        let normal = area_vector(corners).normalize_or_zero().as_vec3();
        self.push(vertices, uvs);
        self.normals.extend(vertices.iter().map(|_| normal));
        self.smooth.push(false);
    }

    /// A face of a curved surface.
    pub(super) fn curved_face<const N: usize>(&mut self, corners: [Corner; N]) {
        self.push(&corners.map(|corner| corner.vertex), &corners.map(|corner| corner.uv));
        self.normals.extend(corners.map(|corner| corner.normal));
        self.smooth.push(true);
    }

    fn push(&mut self, vertices: &[u32], uvs: &[Vec2]) {
        let pushed = self.builder.push_face(vertices);
        pushed.expect("the faces of a standard object are polygons over its own vertices");
        self.uvs.extend_from_slice(uvs);
    }

    pub(super) fn build(self) -> Mesh {
        let curved = self.smooth.contains(&true);
        let mut mesh = self.builder.build();
        let set = mesh.set_attributes(Attributes {
            corner_normals: curved.then_some(self.normals),
            uv_sets: vec![self.uvs],
            face_smooth: curved.then_some(self.smooth),
            ..Attributes::default()
        });
        set.expect("every face brought one value for each of its corners");
        mesh
    }
}
