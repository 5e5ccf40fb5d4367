//! Materials that a display mode shows instead of the scene's own.

use trigon_edit::scene::{AlphaMode, Material, Scene, Shading};
use trigon_window::scene::math::{Vec3, Vec4};

use crate::request::DisplayMode;

/// In what surfaces are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Surfaces {
    /// Their own materials.
    #[default]
    Own,
    /// The same without pictures.
    Plain,
    /// One clay for all. The studio's lights go with the camera, so that what it looks like depends on the
    /// direction of the surface in the view alone.
    Clay,
}

/// Linear, of the clay.
const CLAY: Vec4 = Vec4::new(0.5, 0.2, 0.12, 1.0);

impl Surfaces {
    pub(super) fn of(mode: DisplayMode) -> Self {
        match mode {
            DisplayMode::Solid => Self::Plain,
            DisplayMode::Matcap => Self::Clay,
            DisplayMode::Wireframe | DisplayMode::Textured | DisplayMode::Rendered => Self::Own,
        }
    }

    /// Gives a scene that is shown these materials.
    pub(super) fn dress(self, scene: &mut Scene) {
        match self {
            Self::Own => {}
            Self::Plain => scene.materials.iter_mut().for_each(|(_, material)| take_pictures_off(material)),
            Self::Clay => {
                let clay = Material {
                    base_color: CLAY,
                    shading: Shading::blinn_phong(Vec3::splat(0.3), 20.0),
                    alpha_mode: AlphaMode::Opaque,
                    ..Material::default()
                };
                let clay = scene.materials.insert(clay);
                for (_, node) in scene.nodes_mut() {
                    node.materials = vec![clay; node.materials.len().max(1)];
                }
            }
        }
    }
}

fn take_pictures_off(material: &mut Material) {
    // The factor of a picture that is off would make all of the surface shine.
    if material.emissive_texture.take().is_some() {
        material.emissive = Vec3::ZERO;
    }
    (material.base_color_texture, material.transmission_texture) = (None, None);
    (material.normal_map, material.occlusion) = (None, None);
}

#[cfg(test)]
mod tests {
    use trigon_edit::scene::mesh::primitives;
    use trigon_edit::scene::{Texture, TextureBinding, TextureFormat};

    use super::*;

    fn scene() -> Scene {
        let mut scene = Scene::new();
        let picture = Texture::new(1, 1, vec![[255, 0, 0, 255]], TextureFormat::Srgb).expect("one texel");
        let texture = scene.add_texture("red", picture);
        let material = Material { emissive: Vec3::ONE, ..Material::from_texture(texture) };
        let material = Material { emissive_texture: Some(TextureBinding::new(texture)), ..material };
        scene.add_object("cube", primitives::cube(2.0), material);
        scene
    }

    #[test]
    fn solid_shows_no_pictures_and_matcap_one_clay() {
        let mut plain = scene();
        Surfaces::of(DisplayMode::Solid).dress(&mut plain);
        let (_, material) = plain.materials.iter().next().expect("one");
        assert!(material.base_color_texture.is_none() && material.emissive_texture.is_none(), "no pictures");
        assert_eq!(material.emissive, Vec3::ZERO, "and no light in their place");
        let mut clay = scene();
        Surfaces::of(DisplayMode::Matcap).dress(&mut clay);
        let (_, node) = clay.nodes().iter().next().expect("the cube");
        let shown = clay.materials.get(node.materials[0]).expect("it is there");
        assert_eq!(shown.base_color, CLAY, "clay");
        let mut own = scene();
        Surfaces::of(DisplayMode::Textured).dress(&mut own);
        assert!(own.materials.iter().all(|(_, material)| material.base_color_texture.is_some()), "as it is");
    }
}
