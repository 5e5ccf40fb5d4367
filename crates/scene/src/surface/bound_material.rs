//! Binds a material to a mesh: decides which values are interpolated, which textures are read, and whether light is
//! computed per pixel or per vertex. Parts that the material lacks, or that the mesh has no data for, are left out. The
//! reflection model is the material's own, or another one for comparison.

use trigon_math::glam::Affine2;
use trigon_math::{Mat3, Vec3, Vec4};

use super::{
    Coverage, Illumination, Layout, LightSlots, Maps, MaterialParams, MicrofacetModel, Model, TextureMap,
};
use crate::display::Display;
use crate::effects::{LightingEnvironment, OpennessOf, Optics};
use crate::geometry::Columns;
use crate::material::{
    AlphaMode, DrawnIf, Material, MaterialTexture, MetallicRoughness, Shading, TextureBinding,
};
use crate::placement::Rays;
use crate::scene::Scene;
use crate::settings::{Reflection, ShadingModel};
use crate::work::keeps_unseen;

/// What a draw's material depends on.
#[derive(Clone, Copy)]
pub(crate) struct MaterialContext<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) lighting: &'a LightingEnvironment,
    pub(crate) rays: Rays,
    pub(crate) shading: ShadingModel,
    pub(crate) reflection: Reflection,
    pub(crate) display: Display,
    /// From camera space.
    pub(crate) to_world: Mat3,
}

/// A material bound to a mesh.
pub(crate) struct BoundMaterial<'a> {
    pub(crate) params: MaterialParams<'a>,
    pub(crate) layout: Layout,
    pub(crate) illumination: Illumination,
}

impl<'a> BoundMaterial<'a> {
    /// The material's alpha mode is the one that can be seen on the mesh.
    pub(crate) fn new(material: &Material, columns: &Columns, context: &MaterialContext<'a>) -> Self {
        let mut fitting = Fitting { context, columns, layout: Layout::default() };
        let is_physical = matches!(context.reflection.of(material), Shading::MetallicRoughness(_));
        let may_trace = is_physical && context.shading == ShadingModel::Phong;
        let optics = context.lighting.traced(material).filter(|_| may_trace);
        let (shading, illumination) = shown(material, context, optics.is_some());
        let mut material = Material { shading, ..material.clone() };
        if illumination == Illumination::None && shading != Shading::Unlit {
            // Without any light.
            material.base_color *= Vec4::W;
        }
        let in_pixels = illumination == Illumination::InPixels;
        let shows = |display| in_pixels || illumination == Illumination::Value(display);
        let optics = optics.filter(|_| in_pixels);
        let is_shown = |texture: MaterialTexture| {
            shown_as(texture).iter().any(|&display| illumination == Illumination::Value(display))
        };
        let is_drawn = |texture: MaterialTexture| match texture.row().drawn_if {
            DrawnIf::Always => true,
            DrawnIf::LightInPixels => in_pixels || is_shown(texture),
            DrawnIf::AmbientLightInPixels => in_pixels && context.lighting.has_ambient() || is_shown(texture),
            DrawnIf::TangentsInPixels => shows(Display::Normal) && columns.tangents.is_some(),
            DrawnIf::Refracting => matches!(optics, Some(Optics::Glass(_))),
        };
        let maps = Maps::new(|texture| {
            let binding = material.texture(texture).filter(|_| is_drawn(texture))?;
            let shows = is_shown(texture) || texture.matters(&material);
            if shows { fitting.map(texture, &binding) } else { None }
        });
        let is_plain = optics.is_none() && !matches!(illumination, Illumination::Value(_));
        let params = MaterialParams {
            model: model(&material, is_plain),
            maps,
            optics,
            cutoff: cutoff(material.alpha_mode),
            coverage: coverage(material.alpha_mode),
            material,
        };
        fitting.add_values(&params, illumination);
        Self { params, layout: fitting.layout, illumination }
    }

    /// Tells glass what is beneath it, as the rays of the frame know it of a slot of a node. Blended
    /// glass, which these do not meet, remains without.
    pub(crate) fn place_glass(&mut self, lighting: &LightingEnvironment, node: u32, slot: u32) {
        if let Some(Optics::Glass(glass)) = &mut self.params.optics
            && let Some(placed) = lighting.rays.as_ref().and_then(|rays| rays.glass(node, slot))
        {
            *glass = placed;
        }
    }

    /// Whether a triangle has a single colour.
    pub(crate) fn is_flat(&self) -> bool {
        let is_even = self.params.maps.slots().next().is_none();
        let per_triangle = matches!(self.illumination, Illumination::None | Illumination::OnFacets);
        per_triangle && is_even && self.layout.count == 0
    }

    /// Leaves the openness of the surface in place of colours. Of its material alone the mask remains.
    pub(crate) fn measure_openness(&mut self, columns: &Columns, of: OpennessOf) {
        let layout = &mut self.layout;
        self.illumination = Illumination::Openness(of);
        layout.position = Some(layout.add(3));
        layout.normal = columns.face_normals.is_none().then(|| layout.add(3));
    }

    /// Removes everything but the shape.
    pub(crate) fn strip(&mut self) {
        self.layout = Layout::default();
        self.params.maps = Maps::default();
    }
}

/// A material that is being bound.
struct Fitting<'o, 'a> {
    context: &'o MaterialContext<'a>,
    columns: &'o Columns,
    layout: Layout,
}

impl<'a> Fitting<'_, 'a> {
    /// A texture that exists, with texture coordinates that the mesh has.
    fn map(&mut self, slot: MaterialTexture, binding: &TextureBinding) -> Option<TextureMap<'a>> {
        let texture = &self.context.scene.textures.get(binding.texture)?.texture;
        self.columns.uv_sets.get(binding.uv_set)?;
        let at = self.layout.add_coordinates(binding.uv_set, binding.transform);
        Some(TextureMap { texture, sampler: binding.sampler, at, slot })
    }

    /// Adds the varyings that the material and its lighting need in each pixel.
    fn add_values(&mut self, params: &MaterialParams<'_>, illumination: Illumination) {
        let Self { context, columns, layout } = self;
        if columns.show_colors(&params.material, context.display) {
            layout.color = Some(layout.add(4));
        }
        let highlights = !matches!(params.model, Model::Lambert);
        if context.lighting.fog.is_some() {
            layout.position = Some(layout.add(3));
        }
        match illumination {
            Illumination::None | Illumination::OnFacets => {}
            Illumination::AtVertices => {
                let grey = context.lighting.are_grey() && !matches!(params.model, Model::Microfacets(_));
                let grey = grey && has_grey_highlights(&params.model);
                let channels = if grey { 1 } else { 3 };
                let two_sided = params.material.double_sided;
                let mut slots = LightSlots { at: 0, channels, specular: highlights, two_sided };
                slots.at = layout.add(slots.len());
                layout.light = Some(slots);
            }
            Illumination::InPixels => {
                layout.normal = columns.face_normals.is_none().then(|| layout.add(3));
                let towards_eye = highlights && context.rays == Rays::Meeting;
                let needed = towards_eye || params.optics.is_some() || context.lighting.needs_position();
                if needed && layout.position.is_none() {
                    layout.position = Some(layout.add(3));
                }
                if params.maps.get(MaterialTexture::Normal).is_some() {
                    layout.tangent = Some(layout.add(4));
                }
            }
            Illumination::Value(Display::Normal) => {
                layout.normal = columns.face_normals.is_none().then(|| layout.add(3));
                layout.tangent = params.maps.get(MaterialTexture::Normal).map(|_| layout.add(4));
            }
            Illumination::Value(Display::TextureCoordinates) if !columns.uv_sets.is_empty() => {
                layout.shown_uv = Some(layout.add_coordinates(0, Affine2::IDENTITY));
            }
            Illumination::Value(_) | Illumination::Openness(_) => {}
        }
    }
}

/// The texture that a displayed value needs.
fn shown_as(texture: MaterialTexture) -> &'static [Display] {
    match texture {
        MaterialTexture::MetallicRoughness => &[Display::Metallic, Display::Roughness],
        MaterialTexture::Occlusion => &[Display::Occlusion],
        MaterialTexture::BaseColor => &[Display::Alpha],
        _ => &[],
    }
}

/// The reflection model of a material, and where its light is computed: nowhere if there is no light, unless
/// sight rays continue from it. Surfaces that show their metalness or roughness get the model that has them.
fn shown(material: &Material, context: &MaterialContext<'_>, is_traced: bool) -> (Shading, Illumination) {
    let shading = context.reflection.of(material);
    match context.display {
        Display::Shaded | Display::Matcap if context.lighting.is_dark() && !is_traced => {
            (shading, Illumination::None)
        }
        Display::Shaded | Display::Matcap => (shading, illumination(&shading, context.shading)),
        Display::Metallic | Display::Roughness => {
            (Reflection::MetallicRoughness.of(material), Illumination::Value(context.display))
        }
        display => (shading, Illumination::Value(display)),
    }
}

fn has_grey_highlights(model: &Model) -> bool {
    match model {
        Model::BlinnPhong { specular, .. } => specular.x == specular.y && specular.y == specular.z,
        Model::Lambert | Model::Microfacets(_) => true,
    }
}

/// `is_plain` where nothing but light is shown, and no ray goes on.
fn model(material: &Material, is_plain: bool) -> Model {
    match &material.shading {
        Shading::Unlit | Shading::Lambert => Model::Lambert,
        Shading::BlinnPhong { specular, .. } if *specular == Vec3::ZERO => Model::Lambert,
        Shading::BlinnPhong { specular, shininess, .. } => {
            Model::BlinnPhong { specular: *specular, shininess: *shininess }
        }
        // The highlights of microfacets times 0, and all other light for the diffuse part.
        Shading::MetallicRoughness(model) if is_plain && model.is_matt() && !keeps_unseen() => Model::Lambert,
        Shading::MetallicRoughness(model) => Model::Microfacets(MicrofacetModel {
            metallic: model.metallic,
            roughness: model.roughness,
            f0: f0(material.ior) * model.specular_color,
            specular: model.specular,
        }),
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

/// The reflectance of a dielectric at normal incidence: ((n − 1) / (n + 1))².
pub(super) fn f0(ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    root * root
}

impl Reflection {
    /// The shading model that replaces a material's own.
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

/// The exponent for which Blinn's highlight is as wide as that of GGX with this roughness: 2 / α² − 2 (B.
/// Walter et al. 2007, section 5.2, for Beckmann's, which is close to it).
fn blinn_phong(material: &Material) -> Shading {
    /// Above it, highlights are smaller than a pixel.
    const SHARPEST: f32 = 2000.0;
    match material.shading {
        Shading::MetallicRoughness(model) => {
            let square = model.roughness * model.roughness * model.roughness * model.roughness;
            let exponent = 2.0 / square - 2.0;
            let shininess = if exponent < SHARPEST { exponent } else { SHARPEST };
            let dielectric = f0(material.ior) * model.specular_color * model.specular;
            let reflected = dielectric.lerp(material.base_color.truncate(), model.metallic);
            // (n + 8) / 8 normalizes the highlight, so that its total light does not depend on the exponent.
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

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::Vec3;

    fn rough(model: MetallicRoughness, base_color: Vec3) -> Material {
        let shading = Shading::MetallicRoughness(model);
        Material { base_color: base_color.extend(1.0), ior: 1.5, shading, ..Material::default() }
    }

    fn highlight(material: &Material) -> (Vec3, f32) {
        match Reflection::BlinnPhong.of(material) {
            Shading::BlinnPhong { specular, shininess, .. } => (specular, shininess),
            other => panic!("{other:?} is not by Blinn and Phong"),
        }
    }

    /// α is the square of the roughness, the exponent 2 / α² − 2.
    #[test]
    fn highlights_are_as_wide_as_those_of_microfacets() {
        let base_color = Vec3::new(0.5, 0.25, 0.125);
        let plastic = MetallicRoughness { metallic: 0.0, ..MetallicRoughness::default() };
        for (roughness, exponent) in [(0.5, 30.0), (1.0, 0.0), (0.75, 4.32098), (0.01, 2000.0)] {
            let model = MetallicRoughness { roughness, ..plastic };
            let (specular, shininess) = highlight(&rough(model, base_color));
            assert!((shininess - exponent).abs() < 1e-3, "{shininess} of {roughness}");
            // Glass reflects 4 % head-on.
            let expected = Vec3::splat(0.04 * (exponent + 8.0) / 8.0);
            assert!((specular - expected).abs().max_element() < 1e-4, "{specular} of {roughness}");
            let metal = MetallicRoughness { roughness, metallic: 1.0, ..plastic };
            let (specular, _) = highlight(&rough(metal, base_color));
            let expected = base_color * ((exponent + 8.0) / 8.0);
            assert!((specular / expected - Vec3::ONE).abs().max_element() < 1e-4, "{specular} of metal");
        }
    }

    #[test]
    fn a_model_keeps_the_width_of_a_highlight() {
        for shininess in [0.5, 3.0, 30.0, 900.0] {
            let glossy =
                Material { shading: Shading::blinn_phong(Vec3::ONE, shininess), ..Material::default() };
            assert_eq!(Reflection::BlinnPhong.of(&glossy), glossy.shading, "its own");
            let Shading::MetallicRoughness(model) = Reflection::MetallicRoughness.of(&glossy) else {
                panic!("another model");
            };
            let (_, found) = highlight(&rough(model, Vec3::ONE));
            assert!((found / shininess - 1.0).abs() < 1e-3, "{found} of {shininess}");
        }
    }

    #[test]
    fn what_has_no_highlight_gets_the_usual_one() {
        let lambert = Material { shading: Shading::Lambert, ..Material::default() };
        assert_eq!(Reflection::BlinnPhong.of(&lambert), Material::default().shading);
        let usual = Shading::MetallicRoughness(MetallicRoughness::default());
        assert_eq!(Reflection::MetallicRoughness.of(&lambert), usual);
        let unlit = Material { shading: Shading::Unlit, ..Material::default() };
        for reflection in
            [Reflection::Material, Reflection::Lambert, Reflection::BlinnPhong, Reflection::MetallicRoughness]
        {
            assert_eq!(reflection.of(&unlit), Shading::Unlit, "what has no light stays so");
        }
        assert_eq!(Reflection::Material.of(&lambert), Shading::Lambert);
        assert_eq!(Reflection::Lambert.of(&Material::default()), Shading::Lambert);
    }
}
