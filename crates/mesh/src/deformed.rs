//! A mesh in a pose: morph targets first, then the skin, as glTF orders them (glTF 2.0 specification,
//! sections 3.7.2.2 and 3.7.3).
//!
//! A mesh stores the joints and weights of each vertex ([`SkinWeights`]) and how its vertices move for each
//! morph target ([`MorphTarget`]). The scene decides which pose it is in. Here a pose becomes positions,
//! normals and tangents; renderers that compute the same in vectors are tested against it.

use trigon_math::glam::Affine3;
use trigon_math::{Mat3, Vec3, Vec4};

use crate::{Deltas, Mesh, MorphTarget, RenderMesh, SkinWeights};

/// The vertices of a [`RenderMesh`] in a pose. Keep it to use its memory again.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Deformed {
    /// Metres, in the space that the palette leads to.
    pub positions: Vec<Vec3>,
    /// Of unit length.
    pub normals: Vec<Vec3>,
    /// Unit vectors with their handedness; empty when the mesh has none.
    pub tangents: Vec<Vec4>,
}

impl RenderMesh {
    /// Whether a pose can change it.
    #[must_use]
    pub fn is_deformable(&self) -> bool {
        self.skin.is_some() || !self.morph_targets.is_empty()
    }

    /// The vertices with each morph target added `weights[i]` times and then
    /// moved by the palette, one map for each joint.
    ///
    /// A target beyond the weights, or with one that is not finite, adds nothing. A joint beyond the palette
    /// stays where it is, and without a palette the skin is not followed. At rest every bit is the mesh's
    /// own. Normals turn by the inverse transpose of the blended map; those of faces that are shaded flat are
    /// found anew from their vertices. Where a normal or tangent vanishes, it is as before.
    pub fn deform(&self, weights: &[f32], palette: &[Affine3], into: &mut Deformed) {
        into.positions.clone_from(&self.positions);
        into.normals.clone_from(&self.normals);
        into.tangents.clear();
        into.tangents.extend(self.tangents.iter().flatten());
        let skin = self.skin.as_ref().filter(|_| !palette.is_empty());
        if skin.is_none() && weighted(&self.morph_targets, weights).next().is_none() {
            return;
        }
        for (target, weight) in weighted(&self.morph_targets, weights) {
            add(&target.positions, weight, &mut into.positions);
            add(&target.normals, weight, &mut into.normals);
            if !into.tangents.is_empty() {
                for (vertex, delta) in target.tangents.iter() {
                    into.tangents[vertex as usize] += (delta * weight).extend(0.0);
                }
            }
        }
        for vertex in 0..into.positions.len() {
            let map = skin.map_or(Affine3::IDENTITY, |skin| blended(skin, vertex, palette));
            if skin.is_some() {
                into.positions[vertex] = map.transform_point3(into.positions[vertex]);
            }
            let normal = inverse_transpose(&map.matrix3) * into.normals[vertex];
            into.normals[vertex] = unit_or(normal, self.normals[vertex]);
            if let (Some(tangent), Some(rest)) =
                (into.tangents.get_mut(vertex), self.tangents.as_ref().map(|list| list[vertex]))
            {
                let direction = map.matrix3 * unit_of(&map.matrix3) * tangent.truncate();
                let direction = unit_or(direction, rest.truncate());
                *tangent = direction.extend(if is_mirroring(&map.matrix3) { -rest.w } else { rest.w });
            }
        }
        let is_mirrored =
            |vertex: usize| skin.is_some_and(|skin| is_mirroring(&blended(skin, vertex, palette).matrix3));
        self.flat_faces.set_normals(&into.positions, &mut into.normals, is_mirrored);
    }
}

impl Mesh {
    /// The positions of all vertices in a pose; see [`RenderMesh::deform`].
    pub fn deformed_positions(&self, weights: &[f32], palette: &[Affine3]) -> Vec<Vec3> {
        let attributes = self.attributes();
        let mut positions = self.positions().to_vec();
        for (target, weight) in weighted(&attributes.morph_targets, weights) {
            add(&target.positions, weight, &mut positions);
        }
        if let Some(skin) = attributes.skin.as_ref().filter(|_| !palette.is_empty()) {
            for (vertex, position) in positions.iter_mut().enumerate() {
                *position = blended(skin, vertex, palette).transform_point3(*position);
            }
        }
        positions
    }
}

fn weighted<'t>(
    targets: &'t [MorphTarget],
    weights: &'t [f32],
) -> impl Iterator<Item = (&'t MorphTarget, f32)> {
    targets.iter().zip(weights.iter().copied()).filter(|(_, weight)| weight.is_finite() && *weight != 0.0)
}

fn add(deltas: &Deltas, weight: f32, to: &mut [Vec3]) {
    for (index, delta) in deltas.iter() {
        to[index as usize] += delta * weight;
    }
}

/// The weighted sum of the maps of a vertex's joints.
fn blended(skin: &SkinWeights, vertex: usize, palette: &[Affine3]) -> Affine3 {
    let mut sum = Affine3 { matrix3: Mat3::ZERO, translation: Vec3::ZERO };
    for (joint, weight) in skin.influences(vertex).filter(|&(_, weight)| weight != 0.0) {
        let map = palette.get(usize::from(joint)).copied().unwrap_or(Affine3::IDENTITY);
        sum.matrix3 += map.matrix3 * weight;
        sum.translation += map.translation * weight;
    }
    sum
}

/// A matrix that turns normals as the inverse transpose does, and exists for
/// flattened shapes, too: cofactors with the sign of the determinant.
///
/// Scaled by a power of two first, so that neither tiny nor huge joints leave the range
/// of f32 when entries are multiplied and lengths squared; that keeps all digits.
fn inverse_transpose(matrix: &Mat3) -> Mat3 {
    let matrix = *matrix * unit_of(matrix);
    let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
    let cofactors = Mat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if matrix.determinant() < 0.0 { -cofactors } else { cofactors }
}

fn is_mirroring(matrix: &Mat3) -> bool {
    (*matrix * unit_of(matrix)).determinant() < 0.0
}

/// A power of two that brings a matrix' largest entry near 1; 1 where there is none.
fn unit_of(matrix: &Mat3) -> f32 {
    const BIAS: i32 = 127;
    let largest = matrix
        .to_cols_array()
        .iter()
        .fold(0.0_f32, |most, entry| if entry.abs() > most { entry.abs() } else { most });
    let exponent = (largest.to_bits() >> 23) as i32 - BIAS;
    // The greatest and the least power of two that are normal numbers.
    if largest == 0.0 { 1.0 } else { f32::from_bits(((BIAS - exponent.clamp(-126, 126)) as u32) << 23) }
}

fn unit_or(vector: Vec3, otherwise: Vec3) -> Vec3 {
    let length = vector.length();
    if length > 0.0 && length.is_finite() { vector / length } else { otherwise }
}
