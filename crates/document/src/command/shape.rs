//! Standard objects with their dimensions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_mesh::{Mesh, primitives};

/// A standard object. Lengths are in metres.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "shape", rename_all = "snake_case", deny_unknown_fields)]
#[schemars(extend("examples" = Shape::USUAL))]
#[expect(missing_docs, reason = "the names say it")]
pub enum Shape {
    Plane { width: f32, depth: f32 },
    Grid { width: f32, depth: f32, columns: u32, rows: u32 },
    Cube { edge: f32 },
    UvSphere { radius: f32, segments: u32, rings: u32 },
    Icosphere { radius: f32, subdivisions: u32 },
    Cylinder { radius: f32, height: f32, segments: u32 },
    Cone { radius: f32, height: f32, segments: u32 },
    Disc { radius: f32, segments: u32 },
    Torus { major_radius: f32, minor_radius: f32, major_segments: u32, minor_segments: u32 },
    Pyramid { edge: f32, height: f32 },
    Tetrahedron { edge: f32 },
    Octahedron { edge: f32 },
    Dodecahedron { edge: f32 },
    Icosahedron { edge: f32 },
    Teapot { subdivisions: u32 },
}

impl Shape {
    /// Each of them with default dimensions: about two metres in size.
    pub const USUAL: [Self; 15] = [
        Self::Plane { width: 2.0, depth: 2.0 },
        Self::Grid { width: 2.0, depth: 2.0, columns: 10, rows: 10 },
        Self::Cube { edge: 2.0 },
        Self::UvSphere { radius: 1.0, segments: 32, rings: 16 },
        Self::Icosphere { radius: 1.0, subdivisions: 2 },
        Self::Cylinder { radius: 1.0, height: 2.0, segments: 32 },
        Self::Cone { radius: 1.0, height: 2.0, segments: 32 },
        Self::Disc { radius: 1.0, segments: 32 },
        Self::Torus { major_radius: 1.0, minor_radius: 0.25, major_segments: 48, minor_segments: 12 },
        Self::Pyramid { edge: 2.0, height: 2.0 },
        Self::Tetrahedron { edge: 2.0 },
        Self::Octahedron { edge: 1.5 },
        Self::Dodecahedron { edge: 0.75 },
        Self::Icosahedron { edge: 1.0 },
        Self::Teapot { subdivisions: 4 },
    ];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Plane { .. } => "Plane",
            Self::Grid { .. } => "Grid",
            Self::Cube { .. } => "Cube",
            Self::UvSphere { .. } => "Sphere",
            Self::Icosphere { .. } => "Icosphere",
            Self::Cylinder { .. } => "Cylinder",
            Self::Cone { .. } => "Cone",
            Self::Disc { .. } => "Disc",
            Self::Torus { .. } => "Torus",
            Self::Pyramid { .. } => "Pyramid",
            Self::Tetrahedron { .. } => "Tetrahedron",
            Self::Octahedron { .. } => "Octahedron",
            Self::Dodecahedron { .. } => "Dodecahedron",
            Self::Icosahedron { .. } => "Icosahedron",
            Self::Teapot { .. } => "Teapot",
        }
    }

    pub(super) fn mesh(self) -> Mesh {
        match self {
            Self::Plane { width, depth } => primitives::plane(width, depth),
            Self::Grid { width, depth, columns, rows } => primitives::grid(width, depth, columns, rows),
            Self::Cube { edge } => primitives::cube(edge),
            Self::UvSphere { radius, segments, rings } => primitives::uv_sphere(radius, segments, rings),
            Self::Icosphere { radius, subdivisions } => primitives::icosphere(radius, subdivisions),
            Self::Cylinder { radius, height, segments } => primitives::cylinder(radius, height, segments),
            Self::Cone { radius, height, segments } => primitives::cone(radius, height, segments),
            Self::Disc { radius, segments } => primitives::disc(radius, segments),
            Self::Torus { major_radius, minor_radius, major_segments, minor_segments } => {
                primitives::torus(major_radius, minor_radius, major_segments, minor_segments)
            }
            Self::Pyramid { edge, height } => primitives::pyramid(edge, height),
            Self::Tetrahedron { edge } => primitives::tetrahedron(edge),
            Self::Octahedron { edge } => primitives::octahedron(edge),
            Self::Dodecahedron { edge } => primitives::dodecahedron(edge),
            Self::Icosahedron { edge } => primitives::icosahedron(edge),
            Self::Teapot { subdivisions } => primitives::teapot(subdivisions),
        }
    }
}
