//! From a material to its look on a mesh: which values are interpolated, which
//! textures are read, where light is found. What the material does not have, and
//! what the mesh cannot show, is left out.

use trigon_math::Vec3;

use super::{Coverage, Illumination, Layout, LightSlots, Look, Map, MicrofacetModel, Model, Rays};
use crate::effects::{Counts, Effect, Optics, Scenery};
use crate::material::{AlphaMode, Material, MetallicRoughness, Shading, TextureBinding};
use crate::render::columns::Columns;
use crate::scene::Scene;
use crate::settings::{Reflection, ShadingModel};

/// What a draw is made for.
#[derive(Clone, Copy)]
pub(crate) struct Occasion<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) scenery: &'a Scenery,
    pub(crate) rays: Rays,
    pub(crate) shading: ShadingModel,
    pub(crate) reflection: Reflection,
}

/// A material made ready for a mesh.
pub(crate) struct Dressed<'a> {
    pub(crate) look: Look<'a>,
    pub(crate) layout: Layout,
    pub(crate) illumination: Illumination,
}

impl<'a> Dressed<'a> {
    pub(crate) fn new(material: &Material, columns: &Columns, occasion: &Occasion<'a>) -> Self {
        let mut fitting = Fitting { occasion, columns, layout: Layout::default() };
        let shading = occasion.reflection.of(material);
        let illumination = illumination(&shading, occasion.shading);
        let in_pixels = illumination == Illumination::InPixels;
        let look = Look {
            base_color: material.base_color,
            base_map: fitting.map(material.base_color_texture.as_ref()),
            model: fitting.model(material, &shading, in_pixels),
            normal_map: material
                .normal_map
                .filter(|_| in_pixels && columns.tangents.is_some())
                .and_then(|normal_map| Some((fitting.map(Some(&normal_map.binding))?, normal_map.scale))),
            occlusion_map: material
                .occlusion
                .filter(|_| in_pixels)
                .and_then(|occlusion| Some((fitting.map(Some(&occlusion.binding))?, occlusion.strength))),
            optics: Optics::of(material).filter(|_| in_pixels && occasion.scenery.bounces > 0),
            emissive: material.emissive,
            emissive_map: fitting
                .map(material.emissive_texture.as_ref().filter(|_| material.emissive != Vec3::ZERO)),
            cutoff: cutoff(material.alpha_mode),
            coverage: coverage(material.alpha_mode),
        };
        fitting.add_values(&look, illumination, material.double_sided);
        Self { look, layout: fitting.layout, illumination }
    }

    /// Adds what each vertex hands on and what each pixel looks up.
    pub(crate) fn count(&self, scenery: &Scenery, masked: bool, counts: &mut Counts) {
        let Self { look, layout, .. } = self;
        let some = |there: bool, count: u64| if there { count } else { 0 };
        let light = if !scenery.lights.lamps.is_empty() {
            Effect::Lamps
        } else if scenery.surroundings.is_some() {
            Effect::Environment
        } else {
            Effect::AmbientLight
        };
        let (maps, specular) = match &look.model {
            Model::Lambert => (0, false),
            Model::BlinnPhong { map, .. } => (some(map.is_some(), 1), true),
            Model::Microfacets(model) => {
                let maps = [&model.map, &model.specular_map, &model.specular_color_map];
                (maps.iter().filter(|map| map.is_some()).count() as u64, true)
            }
        };
        let position = match () {
            () if scenery.mist.is_some() => Effect::Fog,
            () if specular && self.illumination != Illumination::None => Effect::Highlights,
            () if scenery.shadow_maps.is_some() => Effect::ShadowMaps,
            () if scenery.shadow_rays => Effect::ShadowRays,
            () if scenery.ambient_rays.is_some() => Effect::AmbientOcclusion,
            () => light,
        };
        let of_light = layout.light.map_or(0, |slots| slots.len() as u64) + some(layout.normal.is_some(), 3);
        counts.of(light).attributes += of_light;
        counts.of(position).attributes += some(layout.position.is_some(), 3);
        counts.of(Effect::NormalMaps).attributes += some(layout.tangent.is_some(), 4);
        counts.of(Effect::VertexColors).attributes += some(layout.color.is_some(), 4);
        counts.of(Effect::Textures).attributes += 2 * layout.coordinates.len() as u64;
        counts.of(Effect::Textures).look_ups += maps + some(look.base_map.is_some(), 1);
        counts.of(Effect::Masks).look_ups += some(masked && look.base_map.is_some(), 1);
        counts.of(Effect::Emission).look_ups += some(look.emissive_map.is_some(), 1);
        counts.of(Effect::NormalMaps).look_ups += some(look.normal_map.is_some(), 1);
        counts.of(Effect::OcclusionMaps).look_ups += some(look.occlusion_map.is_some(), 1);
        counts.of(Effect::Transparency).passes += some(look.coverage == Coverage::Translucent, 1);
    }

    /// Whether a triangle has one colour all over.
    pub(crate) fn is_flat(&self) -> bool {
        let uneven = self.look.base_map.is_some() || self.look.emissive_map.is_some();
        let per_triangle = matches!(self.illumination, Illumination::None | Illumination::OnFacets);
        per_triangle && !uneven && self.layout.count == 0
    }

    /// Leaves nothing but the shape.
    pub(crate) fn strip(&mut self) {
        self.layout = Layout::default();
        (self.look.base_map, self.look.emissive_map) = (None, None);
    }
}

/// A look while it is put together.
struct Fitting<'o, 'a> {
    occasion: &'o Occasion<'a>,
    columns: &'o Columns,
    layout: Layout,
}

impl<'a> Fitting<'_, 'a> {
    /// A texture that exists, on coordinates that the mesh has.
    fn map(&mut self, binding: Option<&TextureBinding>) -> Option<Map<'a>> {
        let binding = binding?;
        let texture = &self.occasion.scene.textures.get(binding.texture)?.texture;
        self.columns.uv_sets.get(binding.uv_set)?;
        let at = self.layout.add_coordinates(binding.uv_set, binding.transform);
        Some(Map { texture, sampler: binding.sampler, at })
    }

    fn model(&mut self, material: &Material, shading: &Shading, in_pixels: bool) -> Model<'a> {
        let textures = |binding: &Option<TextureBinding>| binding.filter(|_| in_pixels);
        match shading {
            Shading::Unlit | Shading::Lambert => Model::Lambert,
            Shading::BlinnPhong { specular, .. } if *specular == Vec3::ZERO => Model::Lambert,
            Shading::BlinnPhong { specular, shininess, specular_texture } => Model::BlinnPhong {
                specular: *specular,
                shininess: *shininess,
                map: self.map(textures(specular_texture).as_ref()),
            },
            Shading::MetallicRoughness(model) => Model::Microfacets(Box::new(MicrofacetModel {
                metallic: model.metallic,
                roughness: model.roughness,
                map: self.map(textures(&model.texture).as_ref()),
                head_on: head_on(material.ior) * model.specular_color,
                specular: model.specular,
                specular_map: self.map(textures(&model.specular_texture).as_ref()),
                specular_color_map: self.map(textures(&model.specular_color_texture).as_ref()),
            })),
        }
    }

    /// What the look and its light have to know at each pixel.
    fn add_values(&mut self, look: &Look<'_>, illumination: Illumination, double_sided: bool) {
        let Self { occasion, columns, layout } = self;
        if columns.colors.is_some() {
            layout.color = Some(layout.add(4));
        }
        let highlights = !matches!(look.model, Model::Lambert);
        if occasion.scenery.mist.is_some() {
            layout.position = Some(layout.add(3));
        }
        match illumination {
            Illumination::None | Illumination::OnFacets => {}
            Illumination::AtVertices => {
                let grey = occasion.scenery.are_grey() && !matches!(look.model, Model::Microfacets(_));
                let grey = grey && has_grey_highlights(&look.model);
                let channels = if grey { 1 } else { 3 };
                let mut slots = LightSlots { at: 0, channels, specular: highlights, two_sided: double_sided };
                slots.at = layout.add(slots.len());
                layout.light = Some(slots);
            }
            Illumination::InPixels => {
                layout.normal = Some(layout.add(3));
                let towards_eye = highlights && occasion.rays == Rays::Meeting;
                let needed = towards_eye || occasion.scenery.needs_position();
                if needed && layout.position.is_none() {
                    layout.position = Some(layout.add(3));
                }
                if look.normal_map.is_some() {
                    layout.tangent = Some(layout.add(4));
                }
            }
        }
    }
}

fn has_grey_highlights(model: &Model<'_>) -> bool {
    match model {
        Model::BlinnPhong { specular, .. } => specular.x == specular.y && specular.y == specular.z,
        Model::Lambert | Model::Microfacets(_) => true,
    }
}

fn illumination(shading: &Shading, model: ShadingModel) -> Illumination {
    match (shading, model) {
        (Shading::Unlit, _) => Illumination::None,
        (_, ShadingModel::Flat) => Illumination::OnFacets,
        (_, ShadingModel::Gouraud) => Illumination::AtVertices,
        (_, ShadingModel::Phong) => Illumination::InPixels,
    }
}

/// What a dielectric reflects head-on: ((n − 1) / (n + 1))².
fn head_on(ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    root * root
}

fn cutoff(mode: AlphaMode) -> f32 {
    match mode {
        AlphaMode::Mask { cutoff } => cutoff,
        AlphaMode::Opaque | AlphaMode::Blend => 0.0,
    }
}

fn coverage(mode: AlphaMode) -> Coverage {
    match mode {
        AlphaMode::Opaque | AlphaMode::Mask { .. } => Coverage::Opaque,
        AlphaMode::Blend => Coverage::Translucent,
    }
}

impl Reflection {
    /// What a material's answer to light becomes.
    pub(crate) fn of(self, material: &Material) -> Shading {
        let shading = material.shading;
        match self {
            _ if shading == Shading::Unlit => shading,
            Self::Material => shading,
            Self::Lambert => Shading::Lambert,
            Self::BlinnPhong => blinn_phong(material),
            Self::MetallicRoughness => Shading::MetallicRoughness(metallic_roughness(&shading)),
        }
    }
}

/// The exponent of Blinn's highlight that is as wide as GGX's with this
/// roughness: 2 / α² − 2 (B. Walter et al. 2007, section 5.2, for Beckmann's,
/// which is near to it).
fn blinn_phong(material: &Material) -> Shading {
    /// Beyond, highlights are smaller than pixels.
    const SHARPEST: f32 = 2000.0;
    match material.shading {
        Shading::MetallicRoughness(model) => {
            let square = model.roughness * model.roughness * model.roughness * model.roughness;
            let exponent = 2.0 / square - 2.0;
            let shininess = if exponent < SHARPEST { exponent } else { SHARPEST };
            let dielectric = head_on(material.ior) * model.specular_color * model.specular;
            let reflected = dielectric.lerp(material.base_color.truncate(), model.metallic);
            // As bright as one that sends out as much light as it reflects.
            Shading::blinn_phong(reflected * ((shininess + 8.0) / 8.0), shininess)
        }
        Shading::BlinnPhong { .. } => material.shading,
        Shading::Unlit | Shading::Lambert => Material::default().shading,
    }
}

fn metallic_roughness(shading: &Shading) -> MetallicRoughness {
    match shading {
        Shading::MetallicRoughness(model) => *model,
        Shading::BlinnPhong { shininess, .. } => {
            let square = (2.0 / (shininess + 2.0)).sqrt();
            MetallicRoughness { roughness: square.sqrt(), ..MetallicRoughness::default() }
        }
        Shading::Unlit | Shading::Lambert => MetallicRoughness::default(),
    }
}
