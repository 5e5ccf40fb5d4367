//! Parameters of materials that glTF keeps in extensions.

use trigon_math::Vec3;

use super::{Material, MaterialTexture};

/// A parameter of a material that glTF keeps in an extension: its name there, and its field here.
#[derive(Clone, Copy, Debug)]
pub struct ExtensionParameter {
    /// As `KHR_materials_transmission`.
    pub extension: &'static str,
    /// The member of the extension's object, as `transmissionFactor`.
    pub name: &'static str,
    /// Where it is in a material.
    pub field: ParameterField,
}

/// The field that a parameter is. It is `None` where the shading model does not have it.
#[derive(Clone, Copy, Debug)]
pub enum ParameterField {
    /// A number from 0 to 1.
    Share(fn(&mut Material) -> Option<&mut f32>),
    /// A number of at least 0; one that is infinite has no member.
    Amount(fn(&mut Material) -> Option<&mut f32>),
    /// Linear RGB, at least 0.
    Color(fn(&mut Material) -> Option<&mut Vec3>),
    /// A texture.
    Texture(MaterialTexture),
}

impl ExtensionParameter {
    pub(super) const fn share(
        extension: &'static str,
        name: &'static str,
        field: fn(&mut Material) -> Option<&mut f32>,
    ) -> Self {
        Self { extension, name, field: ParameterField::Share(field) }
    }

    pub(super) const fn amount(
        extension: &'static str,
        name: &'static str,
        field: fn(&mut Material) -> Option<&mut f32>,
    ) -> Self {
        Self { extension, name, field: ParameterField::Amount(field) }
    }

    pub(super) const fn color(
        extension: &'static str,
        name: &'static str,
        field: fn(&mut Material) -> Option<&mut Vec3>,
    ) -> Self {
        Self { extension, name, field: ParameterField::Color(field) }
    }

    pub(super) const fn texture(extension: &'static str, name: &'static str, slot: MaterialTexture) -> Self {
        Self { extension, name, field: ParameterField::Texture(slot) }
    }
}
