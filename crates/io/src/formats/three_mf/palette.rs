//! The materials and colours of all objects: base materials with their colours, and a group of the colours of corners.

use std::collections::{BTreeMap, BTreeSet};

use trigon_math::Vec4;
use trigon_math::color::linear_to_srgba8;
use trigon_scene::{AlphaMode, Material, MaterialId, Scene};

use super::resources::WrittenTriangle;
use super::text::{Escaped, push};
use crate::error::Location;
use crate::export::{Loss, Object};

/// What a triangle shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ShownItems {
    /// An item of the base materials.
    Base(usize),
    /// Items of the colours.
    Colors([usize; 3]),
}

/// What all triangles show.
pub(super) struct Palette<'s> {
    scene: &'s Scene,
    /// None for the default one.
    bases: Vec<Option<MaterialId>>,
    base_numbers: BTreeMap<Option<MaterialId>, usize>,
    /// As sRGB bytes.
    colors: Vec<[u8; 4]>,
    color_numbers: BTreeMap<[u8; 4], usize>,
    /// Materials that give way to the colours of corners.
    colored: BTreeSet<Option<MaterialId>>,
}

impl<'s> Palette<'s> {
    pub(super) fn new(scene: &'s Scene) -> Self {
        Self {
            scene,
            bases: Vec::new(),
            base_numbers: BTreeMap::new(),
            colors: Vec::new(),
            color_numbers: BTreeMap::new(),
            colored: BTreeSet::new(),
        }
    }

    /// What a triangle shows: its material, unless it has colours at its corners.
    pub(super) fn shown(&mut self, object: &Object<'_>, face: &WrittenTriangle) -> ShownItems {
        let id = object.material(face.source);
        let material = id.and_then(|id| self.scene.materials.get(id));
        let id = id.filter(|_| material.is_some());
        let colors = object.mesh.attributes().corner_colors.as_deref();
        let colors = colors.map(|colors| face.corners.map(|corner| colors[corner as usize]));
        match colors.filter(|colors| colors.iter().any(|&color| color != Vec4::ONE)) {
            None => ShownItems::Base(self.base(id)),
            Some(colors) => {
                self.colored.insert(id);
                let of_material = material.map_or(Material::default().base_color, color_of);
                ShownItems::Colors(colors.map(|color| self.color(color * of_material)))
            }
        }
    }

    fn base(&mut self, id: Option<MaterialId>) -> usize {
        let next = self.bases.len();
        let number = *self.base_numbers.entry(id).or_insert(next);
        if number == next {
            self.bases.push(id);
        }
        number
    }

    fn color(&mut self, color: Vec4) -> usize {
        let (bytes, next) = (linear_to_srgba8(color), self.colors.len());
        let number = *self.color_numbers.entry(bytes).or_insert(next);
        if number == next {
            self.colors.push(bytes);
        }
        number
    }

    pub(super) fn has_colors(&self) -> bool {
        !self.colors.is_empty()
    }

    /// The group of base materials, if there are any.
    pub(super) fn push_bases(&self, text: &mut String, number: usize) {
        if self.bases.is_empty() {
            return;
        }
        push(text, format_args!("  <basematerials id=\"{number}\">\n"));
        let default = Material::default().with_name("default");
        for id in &self.bases {
            let material = id.and_then(|id| self.scene.materials.get(id)).unwrap_or(&default);
            let color = hex(linear_to_srgba8(color_of(material)));
            let name = Escaped(&material.name);
            push(text, format_args!("   <base name=\"{name}\" displaycolor=\"{color}\"/>\n"));
        }
        *text += "  </basematerials>\n";
    }

    /// The group of colours, if there are any.
    pub(super) fn push_colors(&self, text: &mut String, number: usize) {
        if self.colors.is_empty() {
            return;
        }
        push(text, format_args!("  <m:colorgroup id=\"{number}\">\n"));
        for &color in &self.colors {
            push(text, format_args!("   <m:color color=\"{}\"/>\n", hex(color)));
        }
        *text += "  </m:colorgroup>\n";
    }

    /// What of the materials is not in the file.
    pub(super) fn losses(&self) -> Vec<Loss> {
        let used = self.bases.iter().chain(&self.colored).flatten();
        let materials = || used.clone().filter_map(|&id| self.scene.materials.get(id));
        let mut losses = Vec::new();
        if materials().any(|material| material.textures().next().is_some()) {
            losses.push("textures of materials: their colours alone are written");
        }
        if materials().any(|material| material.shading != Material::default().shading) {
            losses.push("how materials shine: their names and colours alone are written");
        }
        if !self.colored.is_empty() {
            losses.push("materials of faces with vertex colours: the colours alone are written");
        }
        losses.into_iter().map(|what| Loss { location: Location::Whole, what: what.to_owned() }).collect()
    }
}

/// The colour of a material as it is seen.
fn color_of(material: &Material) -> Vec4 {
    match material.alpha_mode {
        AlphaMode::Opaque => material.base_color.with_w(1.0),
        AlphaMode::Mask { .. } | AlphaMode::Blend => material.base_color,
    }
}

/// `#RRGGBB`, with alpha if it is not opaque.
fn hex([red, green, blue, alpha]: [u8; 4]) -> String {
    match alpha {
        255 => format!("#{red:02X}{green:02X}{blue:02X}"),
        alpha => format!("#{red:02X}{green:02X}{blue:02X}{alpha:02X}"),
    }
}
