//! The transforms of one node: computed once per node in f64, cast once to f32.

use trigon_camera::{Camera, Projection};
use trigon_math::glam::Affine3;
use trigon_math::{Bounds3, DAffine3, DMat3, DMat4, DVec3, Frustum, Mat3, Mat4, Vec3};
use trigon_raster::Culling;
use trigon_raster::simd::{F32, Simd};

use crate::lanes::{V3, difference, mapped, moved, splat};
use crate::scene::NodePlacement;

/// The transforms of one node, ready for the vertex stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placement {
    /// The origin of positions, in the mesh's space: zero, or the point nearest to the eye within a
    /// mesh that is large relative to its distance.
    pub(crate) anchor: Vec3,
    /// From the anchor.
    pub(crate) to_clip: Mat4,
    /// From the anchor.
    to_camera: Affine3,
    /// Transforms normals; the result has any length.
    pub(crate) normal_to_camera: Mat3,
    /// The culled side for back faces: a mirroring placement flips the winding.
    pub(crate) cull_back: Culling,
    /// The side that a triangle shows when it winds counter-clockwise on the screen.
    pub(crate) front: Side,
}

impl Placement {
    /// Positions of the mesh in clip space.
    #[inline(always)]
    pub(crate) fn clip<S: Simd>(&self, simd: S, position: V3<S>) -> [F32<S>; 4] {
        mapped(&self.to_clip, difference(position, splat(simd, self.anchor)))
    }

    /// Positions of the mesh in camera space.
    #[inline(always)]
    pub(crate) fn camera<S: Simd>(&self, simd: S, position: V3<S>) -> V3<S> {
        moved(&self.to_camera, difference(position, splat(simd, self.anchor)))
    }

    /// Transforms tangents; the result has any length.
    pub(crate) fn tangent_to_camera(&self) -> Mat3 {
        self.to_camera.matrix3
    }

    /// The factor on the handedness of the bitangent: a mirror exchanges sides.
    pub(crate) fn handedness(&self) -> f32 {
        if self.front == Side::Front { 1.0 } else { -1.0 }
    }
}

/// A side of a face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    Front,
    Back,
}

/// How view rays run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rays {
    /// Perspective.
    Meeting,
    /// Orthographic.
    Parallel,
}

/// The camera data that placements need.
pub(crate) struct Eye {
    position: DVec3,
    /// Only the rotation: the eye is subtracted before it is applied.
    turn: DMat3,
    projection: DMat4,
    /// What the camera sees, in camera space; `None` if that is no frustum, and anything may be in view.
    frustum: Option<Frustum>,
}

impl Eye {
    pub(crate) fn new(camera: &Camera, aspect: f64) -> Self {
        let turn = DMat3::from_quat(camera.orientation.conjugate());
        let projection = camera.projection.matrix(aspect);
        let frustum = Frustum::from_clip_matrix(&projection);
        Self { position: camera.position, turn, projection, frustum: Some(frustum) }
    }

    /// The eye of a lens that sees all around.
    pub(crate) fn all_around(camera: &Camera) -> Self {
        Self { frustum: None, ..Self::new(camera, 1.0) }
    }

    /// From camera space to clip space.
    pub(crate) fn projection(&self) -> &DMat4 {
        &self.projection
    }

    /// Whether a box at a placement in the world may be in view; `false` is a proof that nothing in
    /// it is.
    pub(crate) fn may_see(&self, bounds: &Bounds3, world: &DAffine3) -> bool {
        let intersects = |frustum: &Frustum| frustum.intersects(&bounds.transformed(&self.to_camera(world)));
        self.frustum.as_ref().is_none_or(intersects)
    }

    /// A world transform in camera space. Large translations cancel before anything is rounded to
    /// f32.
    pub(crate) fn to_camera(&self, world: &DAffine3) -> DAffine3 {
        DAffine3 {
            matrix3: self.turn * world.matrix3,
            translation: self.turn * (world.translation - self.position),
        }
    }

    /// `bounds` is a box around the mesh in its own space.
    pub(crate) fn placement(&self, node: &NodePlacement, bounds: &Bounds3) -> Placement {
        let to_camera = self.to_camera(&node.world);
        let anchor = anchor(&to_camera, bounds);
        let from_anchor =
            DAffine3 { translation: to_camera.transform_point3(anchor.as_dvec3()), ..to_camera };
        Placement {
            anchor,
            to_clip: (self.projection * DMat4::from(from_anchor)).as_mat4(),
            to_camera: from_anchor.as_affine3(),
            normal_to_camera: normal_matrix(&to_camera.matrix3, node.is_mirrored),
            cull_back: if node.is_mirrored { Culling::Front } else { Culling::Back },
            front: if node.is_mirrored { Side::Back } else { Side::Front },
        }
    }
}

/// The best origin for positions, so that a position in f32 is a sum of terms no larger than 9
/// times its distance from the eye. (A shearing map may add its shear.)
///
/// Relative to the mesh's origin, terms are as large as the mesh and its distance. In a terrain of
/// kilometres that leaves millimetres of rounding near the eye, which change with every step.
/// Relative to the point of the box nearest to the eye, no coordinate is larger than its distance
/// from the eye.
fn anchor(to_camera: &DAffine3, bounds: &Bounds3) -> Vec3 {
    /// Meshes up to this many times as large as their distance keep their origin.
    const LARGE: f64 = 4.0;
    let eye = to_camera.inverse().translation;
    if !eye.is_finite() || !bounds.min.cmple(bounds.max).all() {
        return Vec3::ZERO;
    }
    let nearest = eye.clamp(bounds.min, bounds.max);
    let farthest = bounds.min.abs().max(bounds.max.abs());
    let sizes = [0, 1, 2].map(|axis| to_camera.matrix3.col(axis).length() * farthest[axis]);
    let distance = to_camera.transform_point3(nearest).length();
    let anchor = if sizes.iter().sum::<f64>() > LARGE * distance { nearest.as_vec3() } else { Vec3::ZERO };
    // Of a mesh with infinite positions.
    if anchor.is_finite() { anchor } else { Vec3::ZERO }
}

/// The cofactor matrix, with the sign that keeps normals pointing outwards
/// under mirroring, scaled so that its largest entry is 1: then neither tiny
/// nor huge objects leave the range of f32. Unlike the inverse transpose it
/// exists for flattened objects, too.
pub(crate) fn normal_matrix(matrix: &DMat3, is_mirrored: bool) -> Mat3 {
    let largest = largest_entry(matrix);
    // Made safe to multiply first: entries of 1e200 would overflow when squared.
    let safe = if largest > 0.0 && largest.is_finite() { *matrix * (1.0 / largest) } else { DMat3::IDENTITY };
    let cofactor = DMat3::from_cols(
        safe.y_axis.cross(safe.z_axis),
        safe.z_axis.cross(safe.x_axis),
        safe.x_axis.cross(safe.y_axis),
    );
    let sign = if is_mirrored { -1.0 } else { 1.0 };
    let largest = largest_entry(&cofactor);
    let scale = if largest > 0.0 { sign / largest } else { sign };
    (cofactor * scale).as_mat3()
}

fn largest_entry(matrix: &DMat3) -> f64 {
    let entries = matrix.to_cols_array();
    entries.iter().fold(0.0, |largest, entry| if entry.abs() > largest { entry.abs() } else { largest })
}

/// Converts the depth that the rasterizer stores back to metres.
pub(crate) struct DepthToDistance {
    /// z_clip = a·z + b and w_clip = c·z + d for a point at z in camera space.
    a: f64,
    b: f64,
    c: f64,
    d: f64,
}

impl DepthToDistance {
    pub(crate) fn new(projection: &Projection, aspect: f64) -> Self {
        let matrix = projection.matrix(aspect);
        Self { a: matrix.z_axis.z, b: matrix.w_axis.z, c: matrix.z_axis.w, d: matrix.w_axis.w }
    }

    /// Metres along the view axis; infinite for depth 0, the background.
    #[inline]
    pub(crate) fn at(&self, depth: f32) -> f32 {
        let reversed = f64::from(depth);
        // depth = (a·z + b) / (c·z + d), solved for z; the camera looks along −z. Computed for the background, too, without
        // a branch, so that the compiler makes vectors of a loop.
        let distance = (-((self.b - reversed * self.d) / (reversed * self.c - self.a))) as f32;
        if depth == 0.0 { f32::INFINITY } else { distance }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::Vec3;

    #[test]
    fn normals_of_a_flattened_object_point_along_the_flattened_axis() {
        let flat = DMat3::from_diagonal(DVec3::new(2.0, 0.0, 2.0));
        let normal = normal_matrix(&flat, false) * Vec3::new(1.0, 1.0, 0.0);
        assert_eq!(normal.normalize(), Vec3::Y, "only the flattened axis is left");
    }

    #[test]
    fn normals_survive_mirroring_and_extreme_scales() {
        for scale in [1e-150, 1e-9, 1.0, 1e9, 1e150] {
            for mirror in [1.0, -1.0] {
                let matrix = DMat3::from_diagonal(DVec3::new(mirror * scale, scale, 2.0 * scale));
                let normal = normal_matrix(&matrix, mirror < 0.0) * Vec3::Y;
                assert_eq!(normal.normalize(), Vec3::Y, "scale {scale}, mirror {mirror}");
            }
        }
    }

    #[test]
    fn depth_goes_back_to_metres() {
        let (near, far) = (0.1, 100.0);
        // How many metres a unit of depth is worth at a distance z.
        type MetresPerDepth = fn(f64) -> f64;
        let cases: [(_, MetresPerDepth); 3] = [
            (Projection::perspective(1.0, near, Some(far)), |z| z * z * 99.9 / (0.1 * 100.0)),
            (Projection::perspective(1.0, near, None), |z| z * z / 0.1),
            (Projection::orthographic(2.0, near, far), |_| 99.9),
        ];
        for (projection, metres_per_depth) in cases {
            let projection = projection.expect("valid");
            let matrix = projection.matrix(1.5);
            for distance in [0.2, 1.0, 50.0] {
                let clip = matrix * DVec3::new(0.0, 0.0, -distance).extend(1.0);
                let depth = clip.z / clip.w;
                let back = f64::from(DepthToDistance::new(&projection, 1.5).at(depth as f32));
                // Depth and result are rounded to f32, each by at most 2⁻²⁴ of itself;
                // 1 % more for the curvature and the roundings in f64.
                let half_ulp = f64::from(f32::EPSILON) / 2.0;
                let bound = 1.01 * half_ulp * (metres_per_depth(distance) * depth + distance);
                assert!((back - distance).abs() <= bound, "{distance} came back as {back}");
            }
        }
    }
}
