//! Attributes: the data of a mesh besides its shape.
//!
//! Values that may be discontinuous across an edge (normals, texture coordinates, colours) are
//! stored on corners, so that the shape itself never has to be cut along a seam. Everything is
//! optional: what a mesh does not have costs nothing.

use std::collections::HashMap;

use trigon_math::{Vec2, Vec3, Vec4};

use super::MeshError;

/// Optional values on the corners, faces and vertices of a [`Mesh`](crate::Mesh).
///
/// Corners are numbered through all faces, see
/// [`Mesh::face_corners`](crate::Mesh::face_corners).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Attributes {
    /// Shading normals per corner. Normals need not be of unit length; one that is zero or not finite counts
    /// as "not given here".
    pub corner_normals: Option<Vec<Vec3>>,
    /// Tangents per corner, for normal maps: a unit vector along increasing u, and in `w` the
    /// handedness, 1 or −1, so that the bitangent `normal × tangent · w` points up in the image,
    /// against v. Zero counts as "not given here". See
    /// [`Mesh::generate_tangents`](crate::Mesh::generate_tangents).
    pub corner_tangents: Option<Vec<Vec4>>,
    /// Texture coordinates per corner, in any number of sets. (0, 0) is the upper left corner of
    /// the image and v points down, as in glTF.
    pub uv_sets: Vec<Vec<Vec2>>,
    /// Colours per corner: linear light, straight (not premultiplied) alpha.
    pub corner_colors: Option<Vec<Vec4>>,
    /// Colours per vertex, as loose edges and points show them: linear light, straight alpha. Faces
    /// show those of their corners.
    pub vertex_colors: Option<Vec<Vec4>>,
    /// The material slot of each face. The scene defines what a slot means.
    pub face_materials: Option<Vec<u32>>,
    /// Which faces are shaded smoothly if no corner normal is given. Absent: all are flat.
    pub face_smooth: Option<Vec<bool>>,
    /// The joints that each vertex follows.
    pub skin: Option<SkinWeights>,
    /// Morph targets.
    pub morph_targets: Vec<MorphTarget>,
}

impl Attributes {
    /// Whether anything has colours: corners or vertices.
    #[must_use]
    pub fn has_colors(&self) -> bool {
        self.corner_colors.is_some() || self.vertex_colors.is_some()
    }

    /// Checks that every list has one value per corner, face or vertex.
    pub(crate) fn check(&self, vertices: usize, corners: usize, faces: usize) -> Result<(), MeshError> {
        let check = |attribute, element, expected, found: Option<usize>| match found {
            Some(found) if found != expected => {
                Err(MeshError::AttributeLength { attribute, element, expected, found })
            }
            _ => Ok(()),
        };
        let normals = self.corner_normals.as_ref().map(Vec::len);
        check("corner_normals", "corners", corners, normals)?;
        let tangents = self.corner_tangents.as_ref().map(Vec::len);
        check("corner_tangents", "corners", corners, tangents)?;
        for set in &self.uv_sets {
            check("uv_sets", "corners", corners, Some(set.len()))?;
        }
        let colors = self.corner_colors.as_ref().map(Vec::len);
        check("corner_colors", "corners", corners, colors)?;
        let colors = self.vertex_colors.as_ref().map(Vec::len);
        check("vertex_colors", "vertices", vertices, colors)?;
        let materials = self.face_materials.as_ref().map(Vec::len);
        check("face_materials", "faces", faces, materials)?;
        let smooth = self.face_smooth.as_ref().map(Vec::len);
        check("face_smooth", "faces", faces, smooth)?;
        check("skin", "vertices", vertices, self.skin.as_ref().map(SkinWeights::vertex_count))?;
        for target in &self.morph_targets {
            // Deltas name only the elements that they move, so they may be shorter.
            let beyond = |bound: usize, count: usize| Some(if bound > count { bound } else { count });
            check("morph_targets", "vertices", vertices, beyond(target.positions.bound(), vertices))?;
            for deltas in [&target.normals, &target.tangents] {
                check("morph_targets", "corners", corners, beyond(deltas.bound(), corners))?;
            }
        }
        Ok(())
    }

    /// Reorders every corner value: the new corner `i` gets the value of the old corner `order[i]`.
    pub(crate) fn reorder_corners(&mut self, order: &[u32]) {
        fn reordered<T: Copy>(values: &[T], order: &[u32]) -> Vec<T> {
            order.iter().map(|&from| values[from as usize]).collect()
        }
        if let Some(normals) = &mut self.corner_normals {
            *normals = reordered(normals, order);
        }
        if let Some(tangents) = &mut self.corner_tangents {
            *tangents = reordered(tangents, order);
        }
        for set in &mut self.uv_sets {
            *set = reordered(set, order);
        }
        for target in &mut self.morph_targets {
            for deltas in [&mut target.normals, &mut target.tangents] {
                *deltas = deltas.reordered(order.len(), order.iter().copied());
            }
        }
        if let Some(colors) = &mut self.corner_colors {
            *colors = reordered(colors, order);
        }
    }
}

/// Vectors to be added to some elements of a list.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Deltas {
    indices: Vec<u32>,
    values: Vec<Vec3>,
}

impl Deltas {
    /// From one vector for each element. Vectors that are zero or not finite add nothing.
    pub fn from_dense(values: impl IntoIterator<Item = Vec3>) -> Self {
        Self::from_pairs((0u32..).zip(values))
    }

    /// From elements and what each gets; of several for one element the last.
    /// Vectors that are zero or not finite add nothing.
    #[must_use]
    pub fn new(mut pairs: Vec<(u32, Vec3)>) -> Self {
        pairs.reverse();
        pairs.sort_by_key(|&(index, _)| index);
        pairs.dedup_by_key(|&mut (index, _)| index);
        Self::from_pairs(pairs.into_iter())
    }

    /// The elements increase.
    fn from_pairs(pairs: impl Iterator<Item = (u32, Vec3)>) -> Self {
        let (indices, values) = pairs.filter(|(_, value)| value.is_finite() && *value != Vec3::ZERO).unzip();
        Self { indices, values }
    }

    /// The elements that get something, and what; the elements increase.
    #[must_use]
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, Vec3)> + '_ {
        self.indices.iter().copied().zip(self.values.iter().copied())
    }

    /// How many elements get something.
    #[must_use]
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// Whether nothing is added anywhere.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// One more than the last element that gets something.
    pub(crate) fn bound(&self) -> usize {
        self.indices.last().map_or(0, |&last| last as usize + 1)
    }

    /// The same for other elements: new element `i` is as `order[i]` was, one
    /// of `count` old ones.
    pub(crate) fn reordered(&self, count: usize, order: impl Iterator<Item = u32>) -> Self {
        if self.is_empty() {
            return Self::default();
        }
        let mut dense = vec![Vec3::ZERO; count];
        for (index, value) in self.iter() {
            dense[index as usize] = value;
        }
        Self::from_dense(order.map(|from| dense[from as usize]))
    }

    /// Changes each value by its element.
    pub(crate) fn map(&mut self, change: impl Fn(u32, Vec3) -> Vec3) {
        for (&index, value) in self.indices.iter().zip(&mut self.values) {
            *value = change(index, *value);
        }
    }
}

/// A shape that a mesh can move towards, as differences from its own.
///
/// In a [`Mesh`](crate::Mesh), `positions` counts vertices, `normals` and
/// `tangents` count corners; in a [`RenderMesh`](crate::RenderMesh) all count
/// its vertices.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MorphTarget {
    /// For people; need not be unique.
    pub name: String,
    /// Metres.
    pub positions: Deltas,
    /// To unit normals; the sum is made a unit vector again.
    pub normals: Deltas,
    /// To the x, y and z of unit tangents, likewise.
    pub tangents: Deltas,
}

/// For each corner a number that corners share exactly when all targets add
/// the same to their normals and tangents.
pub(crate) fn classes(targets: &[MorphTarget], corners: usize) -> Vec<u32> {
    let mut classes = vec![0; corners];
    let mut known = HashMap::new();
    for (number, deltas) in targets.iter().flat_map(|target| [&target.normals, &target.tangents]).enumerate()
    {
        for (corner, value) in deltas.iter() {
            let class = &mut classes[corner as usize];
            let next = known.len() as u32 + 1;
            let key = (*class, number, value.to_array().map(|channel| (channel + 0.0).to_bits()));
            *class = *known.entry(key).or_insert(next);
        }
    }
    classes
}

/// For each vertex the same number of joints with their weights.
///
/// Guaranteed: every weight is within 0…1 and those of a vertex sum to 1 (but
/// for rounding).
#[derive(Debug, Clone, PartialEq)]
pub struct SkinWeights {
    per_vertex: usize,
    joints: Vec<u16>,
    weights: Vec<f32>,
}

impl SkinWeights {
    /// Joints and weights, `per_vertex` of each for every vertex in turn; none
    /// when the lists are not that long, or `per_vertex` is 0.
    ///
    /// Weights are divided by their sum. One that is negative or not finite
    /// counts as 0, and a vertex without any weight follows its first joint.
    pub fn new(per_vertex: usize, joints: Vec<u16>, mut weights: Vec<f32>) -> Option<Self> {
        if per_vertex == 0 || joints.len() != weights.len() || !joints.len().is_multiple_of(per_vertex) {
            return None;
        }
        weights.chunks_exact_mut(per_vertex).for_each(normalize);
        Some(Self { per_vertex, joints, weights })
    }

    /// The same from weights that [`Self::weights`] gave: they are kept to the last
    /// bit. None also when they are not within 0…1 with a sum of 1 for each vertex.
    #[must_use]
    pub fn from_normalized(per_vertex: usize, joints: Vec<u16>, weights: Vec<f32>) -> Option<Self> {
        /// More than a sum of rounded weights can be off, for any number of joints in use.
        const ROUNDING: f64 = 1e-3;
        if per_vertex == 0 || joints.len() != weights.len() || !joints.len().is_multiple_of(per_vertex) {
            return None;
        }
        let is_normalized = |weights: &[f32]| {
            let sum: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
            weights.iter().all(|weight| (0.0..=1.0).contains(weight)) && (sum - 1.0).abs() < ROUNDING
        };
        weights.chunks_exact(per_vertex).all(is_normalized).then_some(Self { per_vertex, joints, weights })
    }

    /// How many joints each vertex names, those without weight included.
    #[must_use]
    pub fn per_vertex(&self) -> usize {
        self.per_vertex
    }

    /// How many vertices there are.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.joints.len() / self.per_vertex
    }

    /// The joints of all vertices, [`Self::per_vertex`] each.
    #[must_use]
    pub fn joints(&self) -> &[u16] {
        &self.joints
    }

    /// The weights of all vertices, [`Self::per_vertex`] each.
    #[must_use]
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// The joints of a vertex and their weights, those without weight included.
    ///
    /// # Panics
    /// When there is no such vertex.
    pub fn influences(&self, vertex: usize) -> impl Iterator<Item = (u16, f32)> + '_ {
        let range = vertex * self.per_vertex..(vertex + 1) * self.per_vertex;
        self.joints[range.clone()].iter().copied().zip(self.weights[range].iter().copied())
    }

    /// The same for other vertices: new vertex `i` is as `order[i]` was.
    pub(crate) fn reordered(&self, order: impl Iterator<Item = u32>) -> Self {
        let (mut joints, mut weights) = (Vec::new(), Vec::new());
        for from in order {
            let range = from as usize * self.per_vertex..(from as usize + 1) * self.per_vertex;
            joints.extend_from_slice(&self.joints[range.clone()]);
            weights.extend_from_slice(&self.weights[range]);
        }
        Self { per_vertex: self.per_vertex, joints, weights }
    }
}

fn normalize(weights: &mut [f32]) {
    let mut sum = 0.0_f64;
    for weight in &mut *weights {
        if !(*weight > 0.0 && weight.is_finite()) {
            *weight = 0.0;
        }
        sum += f64::from(*weight);
    }
    if sum == 0.0 {
        weights[0] = 1.0;
        return;
    }
    for weight in weights {
        *weight = (f64::from(*weight) / sum) as f32;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_moves_is_kept() {
        let deltas = Deltas::from_dense([Vec3::ZERO, Vec3::X, Vec3::splat(f32::NAN), Vec3::Y, -Vec3::ZERO]);
        assert_eq!(deltas.iter().collect::<Vec<_>>(), [(1, Vec3::X), (3, Vec3::Y)], "two of five");
        assert_eq!(deltas.bound(), 4, "one more than the last");
        assert_eq!(Deltas::new(vec![(3, Vec3::X), (1, Vec3::X), (3, Vec3::Y)]), deltas, "the last counts");
        let turned = deltas.reordered(5, [3, 3, 0, 1].into_iter());
        assert_eq!(
            turned.iter().collect::<Vec<_>>(),
            [(0, Vec3::Y), (1, Vec3::Y), (3, Vec3::X)],
            "by the old elements"
        );
    }

    #[test]
    fn corners_with_the_same_deltas_are_in_one_class() {
        let target = |normals: [Vec3; 4]| MorphTarget {
            normals: Deltas::from_dense(normals),
            ..MorphTarget::default()
        };
        let targets = [
            target([Vec3::X, Vec3::X, Vec3::ZERO, Vec3::X]),
            target([Vec3::Y, Vec3::ZERO, Vec3::ZERO, Vec3::Y]),
        ];
        let classes = classes(&targets, 4);
        assert_eq!(classes[0], classes[3], "the same from both");
        assert!(classes[0] != classes[1] && classes[1] != classes[2], "others differ: {classes:?}");
        assert_eq!(classes[2], 0, "moved by none");
    }

    #[test]
    fn weights_sum_to_one_whatever_was_given() {
        let weights = vec![1.0, 3.0, f32::NAN, -1.0, 0.0, f32::INFINITY, f32::MAX, f32::MAX];
        let skin = SkinWeights::new(2, vec![0, 1, 2, 3, 4, 5, 6, 7], weights).expect("two for each of four");
        assert_eq!(skin.weights(), [0.25, 0.75, 1.0, 0.0, 1.0, 0.0, 0.5, 0.5], "normalized");
        assert_eq!(skin.influences(3).collect::<Vec<_>>(), [(6, 0.5), (7, 0.5)], "of one vertex");
        let again = SkinWeights::from_normalized(2, skin.joints().to_vec(), skin.weights().to_vec());
        assert_eq!(again, Some(skin), "and stay so");
        for wrong in [vec![0.5, 0.75], vec![2.0, -1.0], vec![f32::NAN, 1.0], vec![1.0]] {
            assert_eq!(SkinWeights::from_normalized(2, vec![0; 2], wrong.clone()), None, "{wrong:?}");
        }
        assert_eq!(SkinWeights::new(2, vec![0; 3], vec![1.0; 3]), None, "half a vertex");
        assert_eq!(SkinWeights::new(0, Vec::new(), Vec::new()), None, "no joints at all");
    }
}
