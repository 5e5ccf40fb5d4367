//! From a material to its look on a mesh: which values are interpolated, which
//! textures are read, where light is found. What the material does not have, and
//! what the mesh cannot show, is left out.

use trigon_math::glam::Affine2;
use trigon_math::{Mat3, Vec3};

use super::reflection::head_on;
use super::{Coverage, Illumination, Layout, LightSlots, Look, Map, MicrofacetModel, Model};
use crate::display::Display;
use crate::effects::{Optics, Scenery};
use crate::material::{AlphaMode, Material, Shading, TextureBinding};
use crate::render::columns::Columns;
use crate::render::placement::Rays;
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
    pub(crate) display: Display,
    /// From camera space.
    pub(crate) to_world: Mat3,
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
        let (shading, illumination) = shown(material, occasion);
        let in_pixels = illumination == Illumination::InPixels;
        let shows = |display| in_pixels || illumination == Illumination::Value(display);
        let shows_model = shows(Display::Metallic) || shows(Display::Roughness);
        let optics = Optics::of(material).filter(|_| in_pixels && occasion.scenery.bounces > 0);
        let is_glass = matches!(optics, Some(Optics::Glass { .. }));
        let look = Look {
            base_color: material.base_color,
            base_map: fitting.map(material.base_color_texture.as_ref()),
            model: fitting.model(material, &shading, shows_model),
            normal_map: material
                .normal_map
                .filter(|_| shows(Display::Normal) && columns.tangents.is_some())
                .and_then(|normal_map| Some((fitting.map(Some(&normal_map.binding))?, normal_map.scale))),
            occlusion_map: material
                .occlusion
                .filter(|_| shows(Display::Occlusion))
                .and_then(|occlusion| Some((fitting.map(Some(&occlusion.binding))?, occlusion.strength))),
            transmission_map: fitting.map(material.transmission_texture.as_ref().filter(|_| is_glass)),
            optics,
            emissive: material.emissive,
            emissive_map: fitting
                .map(material.emissive_texture.as_ref().filter(|_| material.emissive != Vec3::ZERO)),
            cutoff: cutoff(material.alpha_mode),
            coverage: coverage(material.alpha_mode),
        };
        fitting.add_values(&look, illumination, material.double_sided);
        Self { look, layout: fitting.layout, illumination }
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
            Illumination::Value(Display::Normal) => {
                layout.normal = Some(layout.add(3));
                layout.tangent = look.normal_map.map(|_| layout.add(4));
            }
            Illumination::Value(Display::TextureCoordinates) if !columns.uv_sets.is_empty() => {
                layout.shown_uv = Some(layout.add_coordinates(0, Affine2::IDENTITY));
            }
            Illumination::Value(_) => {}
        }
    }
}

fn has_grey_highlights(model: &Model<'_>) -> bool {
    match model {
        Model::BlinnPhong { specular, .. } => specular.x == specular.y && specular.y == specular.z,
        Model::Lambert | Model::Microfacets(_) => true,
    }
}

/// How a material answers to light, and where that is found. Of surfaces that show how metallic and how rough they
/// are the answer is one that knows both.
fn shown(material: &Material, occasion: &Occasion<'_>) -> (Shading, Illumination) {
    let shading = occasion.reflection.of(material);
    match occasion.display {
        Display::Shaded | Display::Matcap => (shading, illumination(&shading, occasion.shading)),
        Display::Metallic | Display::Roughness => {
            (Reflection::MetallicRoughness.of(material), Illumination::Value(occasion.display))
        }
        display => (shading, Illumination::Value(display)),
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
