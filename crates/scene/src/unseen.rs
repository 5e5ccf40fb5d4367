//! Parts of materials that nobody can see on a mesh: planner and renderer leave them out, and no byte changes.
//!
//! A texture that a factor of 0 multiplies is told by its [row](crate::material::MaterialTexture::matters), white vertex
//! colours by [`Columns::show_colors`], and lamps that reach nothing are left out by
//! [`PreparedScene`](crate::prepare::PreparedScene). Here it is told whether alpha shows.

use trigon_math::Vec4;

use crate::geometry::Columns;
use crate::material::{AlphaMode, Material};
use crate::scene::Scene;
use crate::settings::{RenderSettings, Style};
use crate::work::keeps_unseen;

/// A mesh of a scene, on which materials lie.
#[derive(Clone, Copy)]
pub(crate) struct Canvas<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) columns: &'a Columns,
}

impl Canvas<'_> {
    /// The alpha mode of a material as far as it can be seen: a mask that hides nothing and blending with an alpha of 1
    /// everywhere are opaque.
    pub(crate) fn visible_alpha(&self, material: &Material) -> AlphaMode {
        let is_visible = match material.alpha_mode {
            AlphaMode::Opaque => false,
            AlphaMode::Mask { cutoff } => !self.reaches(material, cutoff),
            AlphaMode::Blend => !self.reaches(material, 1.0),
        };
        if is_visible || keeps_unseen() { material.alpha_mode } else { AlphaMode::Opaque }
    }

    /// Whether alpha is at least so large everywhere. It is the product of the factor, the texture and the vertex colour.
    fn reaches(&self, material: &Material, least: f32) -> bool {
        let Vec4 { w: factor, .. } = material.base_color;
        let is_whole = || self.is_texture_opaque(material) && self.columns.are_colors_opaque();
        // No texture has less than 0.
        let is_positive = || factor >= 0.0 && self.columns.are_colors_positive();
        least <= 0.0 && is_positive() || factor >= least && is_whole()
    }

    fn is_texture_opaque(&self, material: &Material) -> bool {
        material.base_color_texture.is_none_or(|binding| {
            let texture = self.scene.textures.get(binding.texture);
            // Without coordinates it is not drawn.
            let is_drawn = self.columns.uv_sets.get(binding.uv_set).is_some();
            !is_drawn || texture.is_none_or(|asset| asset.texture.is_opaque())
        })
    }
}

impl RenderSettings {
    /// [`Canvas::visible_alpha`] in an image with these settings: edges of other faces are not painted over blended
    /// surfaces, and outlines do not see them, so there they are told from opaque ones.
    pub(crate) fn visible_alpha(&self, canvas: Canvas<'_>, material: &Material) -> AlphaMode {
        let paints_over = self.style == Style::SurfaceWithEdges || !self.marks.is_plain();
        let tells_apart = paints_over || self.effects.outline.is_some();
        match material.alpha_mode {
            AlphaMode::Blend if tells_apart => AlphaMode::Blend,
            _ => canvas.visible_alpha(material),
        }
    }
}
