//! The up axis, and parameters of materials beyond the fixed list of a material, by their names in glTF.
//! Parameters follow at the end of a capture, and only where they are not the default, so that a further parameter
//! is no new version of the format.

use trigon_camera::UpAxis;
use trigon_math::Vec3;
use trigon_scene::{ExtensionParameter, Material, MetallicRoughness, ParameterField, Scene, TextureBinding};

use super::stored::{Stored, choice};
use super::stream::{Damage, Reader, Writer};

/// The extensions whose parameters are in the fixed list.
const FIXED: [&str; 2] = ["KHR_materials_specular", "KHR_materials_transmission"];

/// Stands before the list of materials' parameters, if there is one.
const LISTED: u8 = 1;

/// Stands before the direction that is up, unless it is +Y.
const UP: u8 = 2;

/// What a parameter is set to.
#[derive(Clone, Copy, PartialEq)]
enum Value {
    Number(f32),
    Color(Vec3),
    Texture(Option<TextureBinding>),
}

choice!(Value { 0 => Number(number), 1 => Color(color), 2 => Texture(binding) });

impl Value {
    /// What a material has; `None` where its shading model does not have the parameter.
    fn of(field: ParameterField, material: &mut Material) -> Option<Self> {
        match field {
            ParameterField::Share(field) | ParameterField::Amount(field) => {
                field(material).map(|number| Self::Number(*number))
            }
            ParameterField::Color(field) => field(material).map(|color| Self::Color(*color)),
            ParameterField::Texture(slot) => Some(Self::Texture(material.texture(slot))),
        }
    }

    fn set(self, field: ParameterField, material: &mut Material) -> Result<(), Damage> {
        match (field, self) {
            (ParameterField::Share(field) | ParameterField::Amount(field), Self::Number(number)) => {
                field(material).into_iter().for_each(|field| *field = number);
            }
            (ParameterField::Color(field), Self::Color(color)) => {
                field(material).into_iter().for_each(|field| *field = color);
            }
            (ParameterField::Texture(slot), Self::Texture(binding)) => material.set_texture(slot, binding),
            _ => return Err(Damage::malformed("a parameter of a material is of another kind")),
        }
        Ok(())
    }
}

fn listed() -> impl Iterator<Item = &'static ExtensionParameter> {
    Material::EXTENSION_PARAMETERS.iter().filter(|row| !FIXED.contains(&row.extension))
}

/// Writes what is not the default, if there is anything.
pub(super) fn write(scene: &Scene, to: &mut Writer<'_>) {
    if scene.up != UpAxis::default() {
        UP.write(to);
        // An axis made from its direction has the same bits.
        scene.up.direction().write(to);
    }
    write_list(scene, to);
}

fn write_list(scene: &Scene, to: &mut Writer<'_>) {
    let mut count = 0_u64;
    let mut listing = Writer { bytes: Vec::new(), scene };
    for (id, material) in scene.materials.iter() {
        let mut plain = Material { shading: material.shading, ..Material::default() };
        if let Some(model) = plain.shading.metallic_roughness_mut() {
            *model = MetallicRoughness::default();
        }
        for row in listed() {
            let value = Value::of(row.field, &mut material.clone());
            if let Some(value) =
                value.filter(|&value| Value::of(row.field, &mut plain.clone()) != Some(value))
            {
                count += 1;
                id.write(&mut listing);
                (row.extension.to_owned(), row.name.to_owned()).write(&mut listing);
                value.write(&mut listing);
            }
        }
    }
    if count > 0 {
        LISTED.write(to);
        count.write(to);
        to.bytes.extend(listing.bytes);
    }
}

/// Reads what [`write`] wrote.
pub(super) fn read(scene: &mut Scene, from: &mut Reader<'_>) -> Result<(), Damage> {
    while !from.is_at_end() {
        match u8::read(from)? {
            UP => scene.up = UpAxis::new(Stored::read(from)?),
            LISTED => read_list(scene, from)?,
            _ => return Err(Damage::malformed("more follows where it should end")),
        }
    }
    Ok(())
}

fn read_list(scene: &mut Scene, from: &mut Reader<'_>) -> Result<(), Damage> {
    for _ in 0..from.count(size_of::<Value>())? {
        let id = Stored::read(from)?;
        let (extension, name) = <(String, String)>::read(from)?;
        let value = Value::read(from)?;
        let row = listed().find(|row| (row.extension, row.name) == (&extension, &name));
        let row = row.ok_or_else(|| {
            Damage::malformed(format!("this version of trigon does not know {name} of {extension}"))
        })?;
        if let Some(material) = scene.materials.get_mut(id) {
            value.set(row.field, material)?;
        }
    }
    Ok(())
}
