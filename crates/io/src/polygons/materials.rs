//! The materials of a mesh without a library of them: its colours, whose range only the whole file tells, and
//! the images that it names.

use std::collections::HashMap;

use trigon_math::{Vec3, Vec4};
use trigon_scene::{AlphaMode, Material, MaterialId, TextureBinding, TextureId};

use super::{Polygons, light_from_srgb};
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::texture_request::Role;
use crate::texture_request::{ImageBytes, Purpose, Request};
use crate::textures::add_textures;
use crate::textures::{Mention, find_image};
use crate::warning::counted;

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

/// Colours as they are in a file: from 0 to 1, or to 255, or to 65535.
#[derive(Default)]
pub(crate) struct RawColors {
    colors: Vec<Vec4>,
    /// Whether alpha is there, in each.
    with_alpha: Vec<bool>,
    largest: f32,
    largest_alpha: f32,
}

impl RawColors {
    pub(crate) fn len(&self) -> usize {
        self.colors.len()
    }

    /// Adds what a row has of it: red, green, blue and perhaps alpha; fewer numbers are white.
    pub(crate) fn push(&mut self, numbers: &[f64]) {
        let channel = |at: usize| numbers.get(at).map(|&value| value as f32).filter(|value| !value.is_nan());
        let is_color = numbers.len() >= 3;
        let of = |at| if is_color { channel(at).unwrap_or(0.0) } else { f32::INFINITY };
        let color = Vec4::new(of(0), of(1), of(2), if is_color { channel(3).unwrap_or(0.0) } else { 0.0 });
        if is_color {
            self.largest = self.largest.max(color.truncate().max_element());
            self.largest_alpha = self.largest_alpha.max(color.w);
        }
        self.colors.push(color);
        self.with_alpha.push(is_color && numbers.len() > 3);
    }

    /// The number that stands for full light.
    pub(crate) fn full(&self) -> f32 {
        full(self.largest)
    }

    /// The alpha of what is opaque. An alpha of 1 beside colours to 255 is opaque, too.
    fn full_alpha(&self) -> f32 {
        if self.largest_alpha > 1.0 { full(self.largest_alpha).max(self.full()) } else { 1.0 }
    }

    /// The message if some are outside of their range, and are clamped.
    pub(crate) fn fault(&self) -> Option<String> {
        let (scale, alpha_scale) = (self.full(), self.full_alpha());
        let is_within = |value: f32, most: f32| (0.0..=most).contains(&value);
        let is_sound = |(color, &has_alpha): (&Vec4, &bool)| {
            let is_known = color.truncate() != Vec3::INFINITY;
            let channels = color.truncate().to_array();
            !is_known
                || channels.into_iter().all(|value| is_within(value, scale))
                    && (!has_alpha || is_within(color.w, alpha_scale))
        };
        let count = self.colors.iter().zip(&self.with_alpha).filter(|&color| !is_sound(color)).count();
        let (colors, are) = (counted(count, "colour"), if count == 1 { "is" } else { "are" });
        (count > 0).then(|| format!("{colors} {are} not between 0 and {scale}; what is outside is clamped"))
    }

    /// As linear light.
    pub(crate) fn finish(self) -> Vec<Vec4> {
        let (scale, alpha_scale) = (self.full(), self.full_alpha());
        let linear = |(color, &has_alpha): (&Vec4, &bool)| {
            let [red, green, blue] = (color.truncate() / scale).to_array();
            light_from_srgb([red, green, blue, if has_alpha { color.w / alpha_scale } else { 1.0 }])
        };
        self.colors.iter().zip(&self.with_alpha).map(linear).collect()
    }
}

/// What stands for 1, by the largest channel of a file.
fn full(largest: f32) -> f32 {
    /// Light may be somewhat brighter than white; a file whose largest byte is this dark would show nothing.
    const BRIGHTEST: f32 = 2.0;
    match largest {
        ..=BRIGHTEST => 1.0,
        ..=255.0 => 255.0,
        ..=65535.0 => 65535.0,
        // Not a colour at all; it is clamped.
        _ => 255.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finished(rows: &[&[f64]]) -> (f32, Vec<[f32; 4]>) {
        let mut colors = RawColors::default();
        rows.iter().for_each(|row| colors.push(row));
        (colors.full(), colors.finish().iter().map(|color| color.to_array()).collect())
    }

    #[test]
    fn the_largest_channel_tells_the_range() {
        let (white, black) = ([1.0; 4], [0.0, 0.0, 0.0, 1.0]);
        assert_eq!(finished(&[&[1.0, 1.0, 1.0], &[0.0; 3]]), (1.0, vec![white, black]), "to 1");
        assert_eq!(finished(&[&[255.0; 3], &[0.0; 3]]), (255.0, vec![white, black]), "bytes");
        assert_eq!(finished(&[&[65535.0; 3], &[0.0; 3]]), (65535.0, vec![white, black]), "16 bits");
        assert_eq!(finished(&[&[1.2; 3], &[0.0; 3]]), (1.0, vec![white, black]), "brighter than white");
        assert_eq!(finished(&[&[f64::INFINITY; 3], &[]]).1[1], white, "what is no colour is white");
    }

    #[test]
    fn what_is_clamped_is_told() {
        let fault = |rows: &[&[f64]]| {
            let mut colors = RawColors::default();
            rows.iter().for_each(|row| colors.push(row));
            colors.fault()
        };
        for sound in
            [&[&[1.0, 0.0, 0.5][..], &[]][..], &[&[255.0, 0.0, 0.0, 1.0], &[0.0; 3]], &[&[65535.0; 3]]]
        {
            assert_eq!(fault(sound), None, "{sound:?}");
        }
        let told = |rows: &[&[f64]], what: &str| {
            let fault = fault(rows).expect("it is outside");
            assert!(fault.contains(what), "{rows:?}: {fault}");
        };
        told(&[&[1.2, 0.0, 0.0]], "not between 0 and 1;");
        told(&[&[-0.5, 0.0, 1.0], &[0.5; 3], &[-1.0; 3]], "2 colours");
        told(&[&[9.0, -0.5, 0.0]], "not between 0 and 255;");
        told(&[&[1e9, 0.0, 0.0]], "not between 0 and 255;");
        told(&[&[0.5, 0.5, 0.5, -1.0]], "not between 0 and 1;");
    }

    #[test]
    fn alpha_has_a_range_of_its_own() {
        let alpha = |rows: &[&[f64]]| finished(rows).1.iter().map(|color| color[3]).collect::<Vec<_>>();
        assert_eq!(alpha(&[&[255.0, 0.0, 0.0, 1.0], &[0.0, 9.0, 0.0, 0.5]]), [1.0, 0.5], "to 1");
        assert_eq!(alpha(&[&[255.0, 0.0, 0.0, 51.0], &[0.0, 9.0, 0.0, 255.0]]), [0.2, 1.0], "bytes");
        assert_eq!(alpha(&[&[1.0, 0.0, 0.0, 0.2], &[0.0, 1.0, 0.0]]), [0.2, 1.0], "none is opaque");
    }
}
