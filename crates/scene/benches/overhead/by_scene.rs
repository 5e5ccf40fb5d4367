//! The image by the scene renderer.

use std::error::Error;
use std::num::NonZeroUsize;

use trigon_raster::Texture;
use trigon_scene::camera::Camera;
use trigon_scene::math::Vec4;
use trigon_scene::{
    Background, EffectSettings, Frame, Light, Lighting, Material, MetallicRoughness, Node, NormalMap,
    RenderSettings, Renderer, Scene, Shading, ShadingModel, Shadows, TextureBinding,
};

use crate::image::{
    AMBIENT, BEHIND, COLOR, Class, LIGHT, SHADOW_TEXELS, SIZE, bumps, camera, checker, knot,
    metal_and_roughness,
};

/// A scene that was drawn once.
pub(crate) struct Drawing {
    scene: Scene,
    camera: Camera,
    renderer: Renderer,
    frame: Frame,
}

impl Drawing {
    pub(crate) fn new(class: Class) -> Result<Self, Box<dyn Error>> {
        let mut scene = Scene::new();
        let material = material(class, &mut scene);
        scene.add_object("knot", knot(class), material);
        if class != Class::Metal {
            scene.add(Node::from_light(Light::ambient(AMBIENT)));
        }
        scene.add(Node::from_light(Light::directional(LIGHT)));
        let renderer = Renderer::new(settings(class));
        let mut drawing = Self { scene, camera: camera(), renderer, frame: Frame::default() };
        drawing.draw()?;
        Ok(drawing)
    }

    pub(crate) fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        self.renderer.render_into(&self.scene, &self.camera, &mut self.frame)?;
        Ok(())
    }

    /// RGBA, row by row.
    pub(crate) fn pixels(&self) -> &[u8] {
        &self.frame.color
    }
}

fn material(class: Class, scene: &mut Scene) -> Material {
    let mut bind = |name: &str, texture: Texture| TextureBinding::new(scene.add_texture(name, texture));
    let one_color = Material { base_color: COLOR.extend(1.0), double_sided: false, ..Material::default() };
    let white = Material { base_color: Vec4::ONE, shading: Shading::Lambert, ..one_color.clone() };
    match class {
        Class::Plain => Material { shading: Shading::Unlit, ..one_color },
        Class::Lit => Material { shading: Shading::Lambert, ..one_color },
        Class::Textured => Material { base_color_texture: Some(bind("checker", checker())), ..white },
        Class::Mapped => Material {
            base_color_texture: Some(bind("checker", checker())),
            normal_map: Some(NormalMap { binding: bind("bumps", bumps()), scale: 1.0 }),
            ..white
        },
        Class::Metal => Material {
            base_color_texture: Some(bind("checker", checker())),
            normal_map: Some(NormalMap { binding: bind("bumps", bumps()), scale: 1.0 }),
            shading: Shading::MetallicRoughness(MetallicRoughness {
                metallic: 1.0,
                roughness: 1.0,
                texture: Some(bind("metal and roughness", metal_and_roughness())),
                ..MetallicRoughness::default()
            }),
            ..white
        },
    }
}

fn settings(class: Class) -> RenderSettings {
    let at_vertices = matches!(class, Class::Plain | Class::Textured);
    let has_shadows = class == Class::Mapped;
    let shadows = if has_shadows { Shadows::Maps { resolution: SHADOW_TEXELS } } else { Shadows::Off };
    RenderSettings {
        samples_per_axis: 1,
        background: Background::Color(BEHIND),
        lighting: Lighting::Scene,
        shading: if at_vertices { ShadingModel::Gouraud } else { ShadingModel::Phong },
        effects: EffectSettings { shadows, ..EffectSettings::default() },
        threads: NonZeroUsize::new(1),
        ..RenderSettings::new(SIZE[0], SIZE[1])
    }
}
