//! The vertices of the knot in camera space, and normals from a normal map.

use trigon_raster::simd::{F32, InlineMap, Simd};
use trigon_raster::{FragmentLanes, Sampler, Texture, VertexLanes};
use trigon_scene::camera::Camera;
use trigon_scene::math::{DMat3, DVec3, Mat3, Mat4, Vec3};
use trigon_scene::mesh::RenderMesh;

use crate::image::SIZE;
use crate::lanes::{V3, cross, normalized, scaled, splat, sum, turned};

/// The vertices as columns, and the transforms of the knot's one node, which is at the origin.
pub(super) struct Columns {
    pub(super) positions: [Vec<f32>; 3],
    pub(super) normals: [Vec<f32>; 3],
    pub(super) uv: [Vec<f32>; 2],
    /// With the sign of the bitangent; empty without a normal map.
    tangents: [Vec<f32>; 4],
    to_clip: Mat4,
    /// To camera space.
    turn: Mat3,
    shift: Vec3,
    /// To the lamp, in camera space.
    pub(super) towards: Vec3,
}

impl Columns {
    pub(super) fn new(mesh: &RenderMesh, camera: &Camera) -> Self {
        let turn = DMat3::from_quat(camera.orientation.conjugate());
        let tangents = mesh.tangents.as_deref().unwrap_or_default();
        Self {
            positions: [0, 1, 2].map(|axis| mesh.positions.iter().map(|at| at[axis]).collect()),
            normals: [0, 1, 2].map(|axis| mesh.normals.iter().map(|at| at[axis]).collect()),
            uv: [0, 1].map(|axis| mesh.uv_sets[0].iter().map(|uv| uv[axis]).collect()),
            tangents: [0, 1, 2, 3].map(|axis| tangents.iter().map(|of| of[axis]).collect()),
            to_clip: camera.view_projection(f64::from(SIZE[0]) / f64::from(SIZE[1])).as_mat4(),
            turn: turn.as_mat3(),
            shift: (turn * -camera.position).as_vec3(),
            towards: (turn * DVec3::Z).as_vec3(),
        }
    }

    /// Positions in clip space.
    #[inline(always)]
    pub(super) fn clip<S: Simd>(&self, simd: S, vertices: &VertexLanes<'_>) -> [F32<S>; 4] {
        clip(simd, vertices, &self.positions, &self.to_clip)
    }

    /// Sets two varyings.
    #[inline(always)]
    pub(super) fn set_uv<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>, at: usize) {
        for (axis, coordinates) in self.uv.iter().enumerate() {
            vertices.set(at + axis, vertices.load(simd, coordinates));
        }
    }

    /// Sets three varyings: the position in camera space.
    #[inline(always)]
    pub(super) fn set_position<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>, at: usize) {
        let [x, y, z] = &self.positions;
        let position = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
        set(vertices, at, sum(turned(&self.turn, position), splat(simd, self.shift)));
    }

    /// Sets three varyings: the normal in camera space.
    #[inline(always)]
    pub(super) fn set_normal<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>, at: usize) {
        let [x, y, z] = &self.normals;
        let normal = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
        set(vertices, at, turned(&self.turn, normal));
    }

    /// Sets four varyings: the tangent in camera space, and the sign of the bitangent.
    #[inline(always)]
    fn set_tangent<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>, at: usize) {
        let [x, y, z, sign] = &self.tangents;
        let tangent = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
        set(vertices, at, turned(&self.turn, tangent));
        vertices.set(at + 3, vertices.load(simd, sign));
    }
}

/// Positions in clip space.
#[inline(always)]
pub(super) fn clip<S: Simd>(
    simd: S,
    vertices: &VertexLanes<'_>,
    [x, y, z]: &[Vec<f32>; 3],
    to_clip: &Mat4,
) -> [F32<S>; 4] {
    let [x, y, z] = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
    to_clip.transpose().to_cols_array_2d().each(
        #[inline(always)]
        |[a, b, c, d]| x * a + y * b + z * c + d,
    )
}

#[inline(always)]
fn set<S: Simd>(vertices: &mut VertexLanes<'_>, at: usize, values: V3<S>) {
    for (index, value) in values.into_iter().enumerate() {
        vertices.set(at + index, value);
    }
}

/// RGBA at the coordinates in the first two varyings.
#[inline(always)]
pub(super) fn look_up<S: Simd>(simd: S, fragments: &FragmentLanes<'_, S>, texture: &Texture) -> [F32<S>; 4] {
    let [[ux, uy], [vx, vy]] = [fragments.gradient(0), fragments.gradient(1)];
    texture.sample_lanes(simd, fragments.varyings(0), [ux, vx], [uy, vy], &Sampler::default())
}

/// A surface with a normal map. It has 12 varyings: texture coordinates (2), position (3), normal (3), and tangent
/// with the sign of the bitangent (4).
pub(super) struct NormalMapped<'a> {
    pub(super) columns: &'a Columns,
    pub(super) bumps: &'a Texture,
}

impl NormalMapped<'_> {
    pub(super) const VARYINGS: usize = 12;
    pub(super) const POSITION: usize = 2;

    #[inline(always)]
    pub(super) fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.columns.set_uv(simd, vertices, 0);
        self.columns.set_position(simd, vertices, Self::POSITION);
        self.columns.set_normal(simd, vertices, 5);
        self.columns.set_tangent(simd, vertices, 8);
        self.columns.clip(simd, vertices)
    }

    /// Interpolated normals and those of the normal map, of unit length.
    #[inline(always)]
    pub(super) fn normals<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [V3<S>; 2] {
        let normal = fragments.varyings::<3>(5);
        let [tx, ty, tz, sign] = fragments.varyings::<4>(8);
        let tangent = [tx, ty, tz];
        let [x, y, z, _] = look_up(simd, fragments, self.bumps);
        let bitangent = scaled(cross(normal, tangent), sign);
        let across = sum(scaled(tangent, x * 2.0 - 1.0), scaled(bitangent, y * 2.0 - 1.0));
        [normalized(normal), normalized(sum(across, scaled(normal, z * 2.0 - 1.0)))]
    }
}
