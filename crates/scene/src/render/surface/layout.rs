//! The layout of a draw's varyings: only values that its material and its lighting need are interpolated.

use trigon_math::glam::Affine2;

/// Where a draw's varyings lie. Nothing that is `None` is interpolated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layout {
    /// How many f32 there are.
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
    /// Where those lie that the surface shows as colours: two.
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

/// Light that is interpolated instead of found at each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LightSlots {
    /// The first varying.
    pub(crate) at: usize,
    /// 1 where all light is grey, else 3.
    pub(crate) channels: usize,
    /// Whether highlights follow the diffuse light.
    pub(crate) specular: bool,
    /// Whether the light of the back follows that of the front.
    pub(crate) two_sided: bool,
}

impl LightSlots {
    /// Varyings of one side.
    pub(crate) fn per_side(&self) -> usize {
        self.channels * if self.specular { 2 } else { 1 }
    }

    /// All varyings.
    pub(crate) fn len(&self) -> usize {
        self.per_side() * if self.two_sided { 2 } else { 1 }
    }
}

impl Layout {
    /// Makes room for some varyings.
    pub(crate) fn add(&mut self, count: usize) -> usize {
        let at = self.count;
        self.count += count;
        at
    }

    /// Where the coordinates of a UV set lie under a transform. Textures that
    /// agree in both share them.
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
