//! Changes to a model by flags: materials, textures, back faces.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use trigon_io::Limits;
use trigon_math::Vec3;
use trigon_math::glam::Affine2;
use trigon_scene::{
    AlphaMode, Filter, Material, MaterialId, MetallicRoughness, NormalMap, Occlusion, Scene, Shading,
    Texture, TextureBinding, TextureFormat, TextureId,
};

use crate::failure::Failure;

/// What the flags change about a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Look {
    /// Linear RGB of every material.
    pub(crate) color: Option<Vec3>,
    /// Alpha of every material.
    pub(crate) opacity: Option<f32>,
    pub(crate) roughness: Option<f32>,
    pub(crate) metallic: Option<f32>,
    /// Index of refraction.
    pub(crate) ior: Option<f32>,
    /// Linear RGB.
    pub(crate) emissive: Option<Vec3>,
    pub(crate) normal_scale: Option<f32>,
    pub(crate) textures: Textures,
    /// Comes after each texture's own.
    pub(crate) texture_transform: Option<Affine2>,
    /// Whether a checkerboard takes the place of the model's colours.
    pub(crate) checkerboard: bool,
    /// Whether light does not matter.
    pub(crate) unlit: bool,
    /// Back faces, if not as the file has them.
    pub(crate) backfaces: Option<Backfaces>,
}

/// Images in place of the model's own; an empty name takes its own off.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Textures {
    pub(crate) base_color: Option<PathBuf>,
    /// Occlusion, roughness and metal.
    pub(crate) material: Option<PathBuf>,
    pub(crate) emissive: Option<PathBuf>,
    pub(crate) normal: Option<PathBuf>,
}

impl Textures {
    /// Those that are named.
    pub(crate) fn files(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.base_color, &self.material, &self.emissive, &self.normal].into_iter().flatten()
    }
}

/// What happens to faces seen from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Backfaces {
    Visible,
    Hidden,
}

/// A change of one kind of texture: another one, or none.
type Exchange = Option<Option<TextureBinding>>;

/// The same of all kinds.
#[derive(Default)]
struct Exchanges {
    base_color: Exchange,
    material: Exchange,
    emissive: Exchange,
    normal: Exchange,
}

impl Look {
    /// Changes the scene's materials.
    ///
    /// # Errors
    /// When an image cannot be read.
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        if *self == Self::default() {
            return Ok(());
        }
        give_every_slot_a_material(scene);
        let exchanges = self.exchanges(scene)?;
        for (_, material) in scene.materials.iter_mut() {
            self.apply_to(material);
            exchanges.apply_to(material);
            self.apply_to_textures(material);
        }
        Ok(())
    }

    fn apply_to(&self, material: &mut Material) {
        if let Some(color) = self.color {
            material.base_color = color.extend(material.base_color.w);
        }
        if let Some(opacity) = self.opacity {
            material.base_color.w = opacity;
            material.alpha_mode = if opacity < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
        }
        if self.roughness.is_some() || self.metallic.is_some() {
            let surface = microfacets(material);
            surface.roughness = self.roughness.unwrap_or(surface.roughness);
            surface.metallic = self.metallic.unwrap_or(surface.metallic);
        }
        if let Some(ior) = self.ior {
            microfacets(material);
            material.ior = ior;
        }
        material.emissive = self.emissive.unwrap_or(material.emissive);
        if self.unlit {
            material.shading = Shading::Unlit;
        }
        if let Some(backfaces) = self.backfaces {
            material.double_sided = backfaces == Backfaces::Visible;
        }
    }

    fn apply_to_textures(&self, material: &mut Material) {
        if let (Some(scale), Some(map)) = (self.normal_scale, &mut material.normal_map) {
            map.scale = scale;
        }
        let Some(transform) = self.texture_transform else { return };
        let mut bindings: Vec<&mut TextureBinding> = Vec::new();
        bindings.extend(&mut material.base_color_texture);
        bindings.extend(&mut material.emissive_texture);
        bindings.extend(material.normal_map.as_mut().map(|map| &mut map.binding));
        bindings.extend(material.occlusion.as_mut().map(|map| &mut map.binding));
        match &mut material.shading {
            Shading::MetallicRoughness(surface) => bindings.extend(&mut surface.texture),
            Shading::BlinnPhong { specular_texture, .. } => bindings.extend(specular_texture),
            Shading::Unlit | Shading::Lambert => {}
        }
        for binding in bindings {
            binding.transform = transform * binding.transform;
        }
    }

    /// Loads the images that take the place of the model's.
    fn exchanges(&self, scene: &mut Scene) -> Result<Exchanges, Failure> {
        let textures = &self.textures;
        let mut exchanges = Exchanges {
            base_color: exchange(scene, textures.base_color.as_deref(), TextureFormat::Srgb)?,
            material: exchange(scene, textures.material.as_deref(), TextureFormat::Linear)?,
            emissive: exchange(scene, textures.emissive.as_deref(), TextureFormat::Srgb)?,
            normal: exchange(scene, textures.normal.as_deref(), TextureFormat::Linear)?,
        };
        if self.checkerboard {
            exchanges.base_color = Some(Some(checkerboard(scene)));
        }
        Ok(exchanges)
    }
}

impl Exchanges {
    fn apply_to(&self, material: &mut Material) {
        if let Some(binding) = self.base_color {
            material.base_color_texture = binding;
        }
        if let Some(binding) = self.emissive {
            material.emissive_texture = binding;
            if binding.is_some() && material.emissive == Vec3::ZERO {
                material.emissive = Vec3::ONE;
            }
        }
        if let Some(binding) = self.normal {
            material.normal_map = binding.map(|binding| NormalMap { binding, scale: 1.0 });
        }
        if let Some(binding) = self.material {
            microfacets(material).texture = binding;
            material.occlusion = binding.map(|binding| Occlusion { binding, strength: 1.0 });
        }
    }
}

/// The material as one of microfacets, which has roughness and metal.
fn microfacets(material: &mut Material) -> &mut MetallicRoughness {
    if !matches!(material.shading, Shading::MetallicRoughness(_)) {
        // F3D's for surfaces that say nothing of it.
        let usual = MetallicRoughness { roughness: 0.3, ..MetallicRoughness::default() };
        material.shading = Shading::MetallicRoughness(usual);
    }
    match &mut material.shading {
        Shading::MetallicRoughness(surface) => surface,
        _ => unreachable!("it was just made one"),
    }
}

/// An image as a texture; an empty name stands for none.
fn exchange(scene: &mut Scene, file: Option<&Path>, format: TextureFormat) -> Result<Exchange, Failure> {
    let Some(file) = file else { return Ok(None) };
    if file.as_os_str().is_empty() {
        return Ok(Some(None));
    }
    let image = trigon_io::load_image(file, &Limits::default()).map_err(Failure::work)?;
    let texels = image.rgba.as_chunks::<4>().0.to_vec();
    let texture = Texture::new(image.width, image.height, texels, format)
        .map_err(|error| Failure::work(format!("{}: {error}", file.display())))?;
    let id = scene.add_texture(file.to_string_lossy(), texture);
    Ok(Some(Some(TextureBinding::new(id))))
}

/// Eight by eight squares, light and dark.
fn checkerboard(scene: &mut Scene) -> TextureBinding {
    const SIDE: u32 = 8;
    let texel = |index: u32| {
        if (index + index / SIDE).is_multiple_of(2) { [230, 230, 230, 255] } else { [60, 60, 60, 255] }
    };
    let texels = (0..SIDE * SIDE).map(texel).collect();
    let texture = Texture::new(SIDE, SIDE, texels, TextureFormat::Srgb).expect("the size fits");
    let id: TextureId = scene.add_texture("checkerboard", texture);
    let mut binding = TextureBinding::new(id);
    // Squares have edges.
    binding.sampler.magnification = Filter::Nearest;
    binding
}

/// Slots without a material are drawn with the default one, which cannot be
/// changed: they get one that can.
fn give_every_slot_a_material(scene: &mut Scene) {
    let default = scene.add_material(Material::default());
    let slots: Vec<usize> = slots_by_mesh(scene);
    let known: HashSet<MaterialId> = scene.materials.iter().map(|(id, _)| id).collect();
    for (_, node) in scene.nodes_mut() {
        let Some(mesh) = node.mesh else { continue };
        let wanted = slots.get(mesh.index()).copied().unwrap_or(0);
        for material in &mut node.materials {
            if !known.contains(material) {
                *material = default;
            }
        }
        let length = node.materials.len().max(wanted);
        node.materials.resize(length, default);
    }
}

/// How many material slots each mesh uses, by the index of its id.
fn slots_by_mesh(scene: &Scene) -> Vec<usize> {
    let mut slots = vec![0; scene.meshes().index_bound()];
    for (id, asset) in scene.meshes().iter() {
        let last = asset.mesh().attributes().face_materials.iter().flatten().max();
        slots[id.index()] = last.map_or(0, |&last| last as usize) + 1;
    }
    slots
}
