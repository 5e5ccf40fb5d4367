//! What a scene contains, and what of it the camera can see.

use trigon_math::{Vec3, Vec4};

use super::{Invisible, Named};
use crate::effect::Effect;
use crate::effects::Optics;
use crate::geometry::Run;
use crate::material::{AlphaMode, DrawnIf, Material, MaterialTexture, Shading};
use crate::mesh_asset::MeshAsset;
use crate::node::Node;
use crate::prepare::PreparedScene;
use crate::settings::ShadingModel;
use crate::shapes::Shape;
use crate::unseen::Canvas;

/// What a scene contains, and what of it the camera can see.
#[derive(Debug, Default)]
pub(super) struct Survey {
    /// For each effect by its number: the objects that have it, in view and elsewhere.
    found: [[Named; 2]; Effect::ALL.len()],
    /// For each effect by its number, whether lines or points in view have it, which every style shows.
    of_wires: [bool; Effect::ALL.len()],
    /// For each effect: objects that have it only in ways that nobody could see, and the first of these ways.
    invisible: [Option<(Invisible, Named)>; Effect::ALL.len()],
    /// Objects in view that light reaches.
    pub(super) lit: usize,
    /// Shadow casters, in view or not.
    pub(super) casters: usize,
}

/// Whether a material on a mesh has an effect.
#[derive(Clone, Copy, PartialEq)]
enum Presence {
    Absent,
    /// It has it, and nobody could see it.
    Invisible(Invisible),
    Visible,
}

/// An object as far as it matters for all effects alike.
struct SurveyedObject<'a> {
    name: &'a str,
    looks: Vec<SurveyedMaterial<'a>>,
    /// Whether faces may be in view.
    sees_faces: bool,
    /// Whether lines or points may be in view.
    sees_wires: bool,
}

/// A material on a mesh.
struct SurveyedMaterial<'a> {
    shape: &'a Shape,
    prepared: &'a PreparedScene<'a>,
    material: &'a Material,
    /// The same as it is drawn: in the reflection model of the settings, with the alpha mode that can be seen, and black
    /// where no light is.
    drawn: Material,
}

impl Survey {
    pub(super) fn new(prepared: &PreparedScene<'_>) -> Self {
        let mut survey = Self::default();
        let default = Material::default();
        for (id, node) in prepared.scene.nodes().iter() {
            let Some(shape) = prepared.shapes.get(id.index()) else { continue };
            let sees_faces = prepared.may_show(shape);
            let name = if node.name.is_empty() { "an unnamed object" } else { &node.name };
            let runs = shape.geometry.runs.iter();
            let looks: Vec<SurveyedMaterial<'_>> = runs
                .map(|run| SurveyedMaterial::new(material_of(prepared, node, run, &default), shape, prepared))
                .collect();
            let wires = Wires::of(node, prepared);
            let sees_wires = wires.as_ref().is_some_and(|wires| wires.may_show(shape, prepared));
            let object = SurveyedObject { name, looks, sees_faces, sees_wires };
            for effect in Effect::ALL {
                let of_wires = wires.as_ref().is_some_and(|wires| wires.have(effect));
                survey.add(effect, &object, of_wires);
            }
            let lit = |look: &SurveyedMaterial<'_>| look.material.shading != Shading::Unlit;
            survey.lit += usize::from(sees_faces && object.looks.iter().any(lit));
            let opaque = |look: &SurveyedMaterial<'_>| look.material.alpha_mode != AlphaMode::Blend;
            survey.casters += usize::from(object.looks.iter().any(opaque));
        }
        survey
    }

    /// Notes whether an object has an effect: its faces, and its lines and points; and which of both are in view.
    fn add(&mut self, effect: Effect, object: &SurveyedObject<'_>, of_wires: bool) {
        let &SurveyedObject { name, ref looks, sees_faces, sees_wires } = object;
        self.of_wires[effect as usize] |= of_wires && sees_wires;
        let mut invisible = None;
        let mut of_faces = false;
        for look in looks {
            match look.presence(effect) {
                Presence::Absent => {}
                Presence::Invisible(why) => invisible = invisible.or(Some(why)),
                Presence::Visible => of_faces = true,
            }
        }
        if of_faces || of_wires {
            let is_in_view = of_faces && sees_faces || of_wires && sees_wires;
            return self.found[effect as usize][usize::from(!is_in_view)].add(name);
        }
        let Some(why) = invisible else { return };
        let (first, objects) = self.invisible[effect as usize].get_or_insert_with(|| (why, Named::default()));
        if *first == why {
            objects.add(name);
        }
    }

    /// The objects that have an effect, in view and elsewhere.
    pub(super) fn of(&self, effect: Effect) -> &[Named; 2] {
        &self.found[effect as usize]
    }

    /// Whether lines or points in view have an effect.
    pub(super) fn is_of_wires(&self, effect: Effect) -> bool {
        self.of_wires[effect as usize]
    }

    /// Objects that have an effect in a way that nobody could see.
    pub(super) fn invisible(&self, effect: Effect) -> Option<&(Invisible, Named)> {
        self.invisible[effect as usize].as_ref()
    }
}

/// The loose edges and points of a node. They are unlit.
struct Wires<'s> {
    asset: &'s MeshAsset,
    /// That of all of them.
    material: Option<&'s Material>,
}

impl<'s> Wires<'s> {
    fn of(node: &Node, prepared: &PreparedScene<'s>) -> Option<Self> {
        let asset = prepared.scene.meshes().get(node.mesh?).filter(|asset| !asset.has_nothing_loose())?;
        let material = node.materials.first().and_then(|&id| prepared.scene.materials.get(id));
        Some(Self { asset, material })
    }

    fn may_show(&self, shape: &Shape, prepared: &PreparedScene<'_>) -> bool {
        prepared.eye.may_see(&self.asset.bounds(), &shape.world)
    }

    fn have(&self, effect: Effect) -> bool {
        let mode = self.material.map_or(AlphaMode::Opaque, |material| material.alpha_mode);
        match effect {
            Effect::VertexColors => self.asset.mesh().attributes().vertex_colors.is_some(),
            Effect::Emission => self.material.is_some_and(|material| material.emissive != Vec3::ZERO),
            Effect::Masks => matches!(mode, AlphaMode::Mask { .. }),
            Effect::Transparency => mode == AlphaMode::Blend,
            _ => false,
        }
    }
}

fn material_of<'a>(
    prepared: &'a PreparedScene<'_>,
    node: &Node,
    run: &Run,
    default: &'a Material,
) -> &'a Material {
    let id = node.materials.get(run.slot as usize);
    id.and_then(|&id| prepared.scene.materials.get(id)).unwrap_or(default)
}

impl<'a> SurveyedMaterial<'a> {
    fn new(material: &'a Material, shape: &'a Shape, prepared: &'a PreparedScene<'_>) -> Self {
        let canvas = Canvas { scene: prepared.scene, columns: &shape.geometry.columns };
        let mut drawn = Material {
            shading: prepared.settings.reflection.of(material),
            alpha_mode: prepared.settings.visible_alpha(canvas, material),
            ..material.clone()
        };
        let is_dark = prepared.lights.lamps.is_empty() && !has_ambient(prepared);
        if is_dark && drawn.shading != Shading::Unlit && Optics::of(material).is_none() {
            drawn.base_color *= Vec4::W;
        }
        Self { shape, prepared, material, drawn }
    }

    fn presence(&self, effect: Effect) -> Presence {
        let Self { shape, material, drawn, .. } = self;
        let visible_if = |is_visible: bool, why: Invisible| {
            if is_visible { Presence::Visible } else { Presence::Invisible(why) }
        };
        let absent_unless = |is_there: bool| if is_there { Presence::Visible } else { Presence::Absent };
        match effect {
            Effect::Highlights => self.highlights(),
            Effect::Textures => self.textures(),
            Effect::NormalMaps => self.map_of_light(MaterialTexture::Normal),
            Effect::OcclusionMaps => self.map_of_light(MaterialTexture::Occlusion),
            Effect::Emission if material.emissive_texture.is_some() => {
                visible_if(material.emissive != Vec3::ZERO, Invisible::Zero)
            }
            Effect::Emission => absent_unless(material.emissive != Vec3::ZERO),
            Effect::VertexColors => self.vertex_colors(),
            Effect::Masks if matches!(material.alpha_mode, AlphaMode::Mask { .. }) => {
                visible_if(matches!(drawn.alpha_mode, AlphaMode::Mask { .. }), Invisible::NoHole)
            }
            Effect::Transparency if material.alpha_mode == AlphaMode::Blend => {
                visible_if(drawn.alpha_mode == AlphaMode::Blend, Invisible::Opaque)
            }
            Effect::Poses => absent_unless(shape.is_posed),
            Effect::MetalStudio => absent_unless(is_metal(drawn)),
            Effect::Reflection => absent_unless(is_traced(material, false)),
            Effect::Refraction => absent_unless(is_traced(material, true)),
            Effect::Masks | Effect::Transparency => Presence::Absent,
            // Those that depend on lights and settings, not on materials.
            Effect::Lamps
            | Effect::AmbientLight
            | Effect::LightMeter
            | Effect::Environment
            | Effect::ShadowMaps
            | Effect::ShadowRays
            | Effect::SoftShadows
            | Effect::AmbientOcclusion
            | Effect::Fog
            | Effect::ToneMapping
            | Effect::Outline
            | Effect::Edges => Presence::Absent,
        }
    }

    fn highlights(&self) -> Presence {
        let is_visible = match &self.drawn.shading {
            Shading::Unlit | Shading::Lambert => return Presence::Absent,
            Shading::BlinnPhong { specular, .. } => *specular != Vec3::ZERO,
            Shading::MetallicRoughness(model) => !model.is_matt() || Optics::of(self.material).is_some(),
        };
        if is_visible { Presence::Visible } else { Presence::Invisible(Invisible::Zero) }
    }

    /// Textures of any kind: all of them need coordinates.
    fn textures(&self) -> Presence {
        let textures = || self.drawn.textures().map(|(slot, _)| slot);
        let Some(first) = textures().next() else { return Presence::Absent };
        if textures().any(|slot| self.draws(slot)) {
            return Presence::Visible;
        }
        Presence::Invisible(match self.drawn.shading {
            _ if !first.matters(&self.drawn) => Invisible::Zero,
            Shading::Unlit => Invisible::Unlit,
            _ => Invisible::Light,
        })
    }

    /// A texture that changes nothing but light.
    fn map_of_light(&self, slot: MaterialTexture) -> Presence {
        match self.material.texture(slot) {
            None => Presence::Absent,
            Some(_) if self.material.shading == Shading::Unlit => Presence::Invisible(Invisible::Unlit),
            Some(_) if !slot.matters(self.material) => Presence::Invisible(Invisible::Zero),
            Some(_) => Presence::Visible,
        }
    }

    fn vertex_colors(&self) -> Presence {
        let columns = &self.shape.geometry.columns;
        match columns.colors {
            None => Presence::Absent,
            Some(_) if columns.show_colors(&self.drawn, self.prepared.settings.display) => Presence::Visible,
            Some(_) if columns.are_colors_white() => Presence::Invisible(Invisible::White),
            Some(_) => Presence::Invisible(Invisible::Zero),
        }
    }

    /// Whether a texture has an effect on what is shown.
    fn draws(&self, slot: MaterialTexture) -> bool {
        let (material, prepared) = (&self.drawn, self.prepared);
        let settings = prepared.settings;
        let in_pixels = material.shading != Shading::Unlit && settings.shading == ShadingModel::Phong;
        let has_what_it_needs = match slot.row().drawn_if {
            DrawnIf::Always => true,
            DrawnIf::LightInPixels | DrawnIf::TangentsInPixels => in_pixels,
            DrawnIf::AmbientLightInPixels => in_pixels && has_ambient(prepared),
            DrawnIf::Refracting => {
                in_pixels && settings.effects.sight.bounces() > 0 && is_traced(material, true)
            }
        };
        has_what_it_needs && slot.matters(material)
    }
}

/// Whether light comes from everywhere.
pub(super) fn has_ambient(prepared: &PreparedScene<'_>) -> bool {
    prepared.settings.effects.environment.is_some() || prepared.lights.ambient != Vec3::ZERO
}

/// Whether a material may be metallic somewhere: textures are not searched.
fn is_metal(material: &Material) -> bool {
    material.shading.metallic_roughness().is_some_and(|model| model.metallic > 0.0)
}

/// Whether sight rays continue at a material, and through it.
fn is_traced(material: &Material, through: bool) -> bool {
    match Optics::of(material) {
        None => false,
        Some(Optics::Mirror) => !through,
        Some(Optics::Glass(_)) => through,
    }
}
