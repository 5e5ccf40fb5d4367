//! The layout of a draw's varyings: only values that the material and the lighting need are interpolated. A surface is lit
//! per face, per vertex or per pixel, or shows a value instead.

use trigon_math::glam::Affine2;

use crate::display::Display;
use crate::effects::OpennessOf;

/// The varyings of a draw. What is `None` is not interpolated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    /// The number of f32.
    pub(crate) count: usize,
    /// In camera space: three.
    pub(crate) position: Option<usize>,
    /// In camera space: three.
    pub(crate) normal: Option<usize>,
    /// In camera space, and the handedness: four.
    pub(crate) tangent: Option<usize>,
    /// RGBA of the mesh: four.
    pub(crate) color: Option<usize>,
    /// Texture coordinates: two for each.
    pub(crate) coordinates: Vec<Coordinates>,
    /// Texture coordinates that the surface shows as colours: two.
    pub(crate) shown_uv: Option<usize>,
    /// Light at the vertices.
    pub(crate) light: Option<LightSlots>,
}

/// Coordinates of a UV set, transformed for the textures that share them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Coordinates {
    pub(crate) uv_set: usize,
    pub(crate) transform: Affine2,
    /// The varying that holds u; v is the next.
    pub(crate) at: usize,
}

/// Light that is computed at the vertices and interpolated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LightSlots {
    /// The first varying.
    pub(crate) at: usize,
    /// 1 if all light is grey, else 3.
    pub(crate) channels: usize,
    /// Whether highlights are interpolated separately, after the diffuse light.
    pub(crate) specular: bool,
    /// Whether the light of the back side follows that of the front side.
    pub(crate) two_sided: bool,
}

impl LightSlots {
    /// The varyings of one side.
    pub(crate) fn per_side(&self) -> usize {
        self.channels * if self.specular { 2 } else { 1 }
    }

    /// The varyings of all sides.
    pub(crate) fn len(&self) -> usize {
        self.per_side() * if self.two_sided { 2 } else { 1 }
    }
}

impl Layout {
    /// Adds some varyings.
    pub(crate) fn add(&mut self, count: usize) -> usize {
        let at = self.count;
        self.count += count;
        at
    }

    /// The varyings of a UV set under a transform. Textures with the same set and transform share them.
    pub(crate) fn add_coordinates(&mut self, uv_set: usize, transform: Affine2) -> usize {
        let shared = self.coordinates.iter().find(|of| of.uv_set == uv_set && of.transform == transform);
        if let Some(shared) = shared {
            return shared.at;
        }
        let at = self.add(2);
        self.coordinates.push(Coordinates { uv_set, transform, at });
        at
    }
}

/// Where light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Illumination {
    /// There is no light.
    None,
    /// At the vertices, and interpolated (H. Gouraud, "Continuous Shading of Curved
    /// Surfaces", 1971).
    AtVertices,
    /// In each pixel, for an interpolated normal (B. T. Phong, "Illumination for Computer Generated
    /// Pictures", 1975).
    InPixels,
    /// Once for each triangle, at its centre.
    OnFacets,
    /// Nowhere: surfaces show one of their values.
    Value(Display),
    /// Nowhere: surfaces leave their normals, and how much is visible from them, in an image of their own.
    Openness(OpennessOf),
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::Vec2;

    #[test]
    fn textures_that_agree_share_their_coordinates() {
        let mut layout = Layout::default();
        let moved = Affine2::from_translation(Vec2::X);
        let places: Vec<usize> =
            [(0, Affine2::IDENTITY), (1, Affine2::IDENTITY), (0, moved), (0, Affine2::IDENTITY)]
                .into_iter()
                .map(|(uv_set, transform)| layout.add_coordinates(uv_set, transform))
                .collect();
        assert_eq!((places, layout.count), (vec![0, 2, 4, 0], 6), "three pairs, the first one twice");
    }
}
