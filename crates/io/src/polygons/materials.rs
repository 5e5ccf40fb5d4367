//! The materials of a mesh without a library of them: its colours, and the images that it names.

use std::collections::HashMap;

use trigon_math::Vec4;
use trigon_scene::{AlphaMode, Material, MaterialId, TextureBinding, TextureId};

use super::Polygons;
use crate::error::{LoadError, Location};
use crate::image_file::{Mention, find_image};
use crate::import::Import;
use crate::layers::Role;
use crate::texture_request::{ImageBytes, Purpose, Request};
use crate::textures::add_textures;

/// The images that a mesh shows.
#[derive(Debug, Default)]
pub(crate) struct NamedTextures {
    /// Their names, beside the model, with the lines that name them.
    pub(crate) names: Vec<(u64, String)>,
    /// Of faces: the number of its image, or any other where it has none. Empty, or one each.
    pub(crate) of_faces: Vec<u32>,
}

/// Adds the materials of a mesh, those of its slots in order.
pub(super) fn add_materials(
    import: &mut Import<'_>,
    polygons: &mut Polygons,
) -> Result<Vec<MaterialId>, LoadError> {
    let textures = read_textures(import, polygons)?;
    if textures.iter().any(Option::is_some) {
        leave_colors(import, polygons);
        return Ok(add_textured(import, polygons, &textures));
    }
    polygons.textures.of_faces.clear();
    Ok(vec![import.scene.add_material(plain_material(polygons))])
}

/// Colours of vertices are to be seen as they are. An alpha of 0 everywhere is what programs
/// write that have none.
fn plain_material(polygons: &Polygons) -> Material {
    let mut material = Material::default().with_name("default");
    let colors = || polygons.colors.iter().chain(&polygons.face_colors).chain(&polygons.color);
    if colors().next().is_some() {
        material.base_color = polygons.color.unwrap_or(Vec4::ONE);
    }
    if colors().any(|color| color.w < 1.0) && colors().any(|color| color.w > 0.0) {
        material.alpha_mode = AlphaMode::Blend;
    }
    material
}

/// Colours and an image show the same twice, as scanners write them.
fn leave_colors(import: &mut Import<'_>, polygons: &mut Polygons) {
    if !polygons.colors.is_empty() || !polygons.face_colors.is_empty() {
        let what = "colours of vertices or faces are not drawn beside a texture";
        import.warnings.push(Location::Whole, what, "remove the name of the texture to see them");
    }
    (polygons.colors, polygons.face_colors) = Default::default();
}

/// A material for each image, and one for faces without any.
fn add_textured(
    import: &mut Import<'_>,
    polygons: &mut Polygons,
    textures: &[Option<TextureId>],
) -> Vec<MaterialId> {
    let mut slots = Vec::new();
    for (texture, (_, name)) in textures.iter().zip(&polygons.textures.names) {
        let material = Material::default().with_name(name.clone());
        let base_color_texture = texture.map(TextureBinding::new);
        let base_color = if texture.is_some() { Vec4::ONE } else { material.base_color };
        slots.push(import.scene.add_material(Material { base_color_texture, base_color, ..material }));
    }
    let count = slots.len() as u32;
    let of_faces = &mut polygons.textures.of_faces;
    if of_faces.iter().any(|&number| number >= count) {
        slots.push(import.scene.add_material(Material::default().with_name("default")));
        of_faces.iter_mut().for_each(|number| *number = (*number).min(count));
    }
    slots
}

/// The textures by their numbers; none where the image cannot be read or nothing can show it.
fn read_textures(
    import: &mut Import<'_>,
    polygons: &mut Polygons,
) -> Result<Vec<Option<TextureId>>, LoadError> {
    let NamedTextures { names, of_faces } = &mut polygons.textures;
    let Some((line, first)) = names.first() else { return Ok(Vec::new()) };
    if polygons.uvs.is_empty() && polygons.corner_uvs.is_empty() {
        let what = format!("texture \"{first}\" is not drawn: there are no texture coordinates");
        import.warnings.push(Location::Line(*line), what, "export the texture coordinates, too");
        return Ok(Vec::new());
    }
    if names.len() > 1 && of_faces.is_empty() {
        let what = format!("no face says which of {} textures it has, and all have the first", names.len());
        import.warnings.push(Location::Line(*line), what, "export the model again, with texnumber");
        names.truncate(1);
    }
    let mut is_used = vec![of_faces.is_empty(); names.len()];
    for &number in of_faces.iter() {
        is_used.get_mut(number as usize).into_iter().for_each(|is_used| *is_used = true);
    }
    let (mut requests, mut known) = (Vec::new(), HashMap::new());
    let mut numbers = Vec::with_capacity(names.len());
    for ((line, name), is_used) in names.iter().zip(is_used) {
        let mut find = || {
            requests.push(request(import, *line, name)?);
            Some(requests.len() - 1)
        };
        numbers.push(is_used.then(|| *known.entry(name).or_insert_with(&mut find)));
    }
    let ids = add_textures(import, &requests)?;
    Ok(numbers.into_iter().map(|request| ids[request.flatten()?]).collect())
}

/// Reads an image beside the model.
fn request(import: &mut Import<'_>, line: u64, name: &str) -> Option<Request> {
    let file = import.path;
    let found = find_image(import, Mention { file, line, name })?;
    let layers = vec![(Role::Whole, ImageBytes::Own(found.bytes))];
    let (name, file, location) = (name.to_owned(), file.to_owned(), Location::Line(line));
    Some(Request { name, file, location, layers, purpose: Purpose::BaseColor })
}
