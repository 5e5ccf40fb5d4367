//! Materials that a display mode shows instead of the scene's own. The clay of matcap is the renderer's.

use trigon_document::scene::{Material, Scene};
use trigon_window::scene::math::Vec3;

use crate::request::{DisplayMode, SolidColor};

/// In what surfaces are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Surfaces {
    /// Their own materials.
    #[default]
    Own,
    /// The same without images.
    Plain,
    /// The same with the images of their base colours alone.
    BaseColor,
}

impl Surfaces {
    pub(super) fn of(mode: DisplayMode, solid: SolidColor) -> Self {
        match (mode, solid) {
            (DisplayMode::Solid, SolidColor::Material) => Self::Plain,
            (DisplayMode::Solid, SolidColor::Texture) => Self::BaseColor,
            _ => Self::Own,
        }
    }

    /// Gives a scene that is shown these materials.
    pub(super) fn dress(self, scene: &mut Scene) {
        match self {
            Self::Own => {}
            Self::Plain => scene.materials.iter_mut().for_each(|(_, material)| take_images_off(material)),
            Self::BaseColor => scene.materials.iter_mut().for_each(|(_, material)| {
                let base_color = material.base_color_texture;
                take_images_off(material);
                material.base_color_texture = base_color;
            }),
        }
    }
}

fn take_images_off(material: &mut Material) {
    // The factor of an image that is off would make all of the surface shine.
    if material.emissive_texture.take().is_some() {
        material.emissive = Vec3::ZERO;
    }
    material.base_color_texture = None;
    (material.transmission_texture, material.thickness_texture) = (None, None);
    (material.normal_map, material.occlusion) = (None, None);
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::mesh::primitives;
    use trigon_document::scene::{Texture, TextureBinding, TextureFormat};

    use super::*;

    fn scene() -> Scene {
        let mut scene = Scene::new();
        let image = Texture::new(1, 1, vec![[255, 0, 0, 255]], TextureFormat::Srgb).expect("one texel");
        let texture = scene.add_texture("red", image);
        let material = Material { emissive: Vec3::ONE, ..Material::from_texture(texture) };
        let material = Material { emissive_texture: Some(TextureBinding::new(texture)), ..material };
        scene.add_object("cube", primitives::cube(2.0), material);
        scene
    }

    #[test]
    fn solid_shows_no_images() {
        let mut plain = scene();
        Surfaces::of(DisplayMode::Solid, SolidColor::Material).dress(&mut plain);
        let (_, material) = plain.materials.iter().next().expect("one");
        assert!(material.base_color_texture.is_none() && material.emissive_texture.is_none(), "no images");
        assert_eq!(material.emissive, Vec3::ZERO, "and no light in their place");
        let mut own = scene();
        Surfaces::of(DisplayMode::Textured, SolidColor::Material).dress(&mut own);
        assert!(own.materials.iter().all(|(_, material)| material.base_color_texture.is_some()), "as it is");
    }

    #[test]
    fn solid_shows_images_of_base_colours_on_request() {
        let mut textured = scene();
        Surfaces::of(DisplayMode::Solid, SolidColor::Texture).dress(&mut textured);
        let (_, material) = textured.materials.iter().next().expect("one");
        assert!(material.base_color_texture.is_some(), "the image");
        assert!(material.emissive_texture.is_none() && material.emissive == Vec3::ZERO, "and no other");
    }
}
