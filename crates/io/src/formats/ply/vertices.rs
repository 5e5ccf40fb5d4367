//! The vertices of a PLY: positions, normals, colours and texture coordinates. Integer colours say by their
//! type what is full light; most programs write float colours from 0 to 1.

use trigon_math::{DVec3, Vec2, Vec3, Vec4};

use super::header::{Element, Kind};
use super::values::{Fault, Values};
use super::values::{cut_off, report, stopped};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::polygons::{Polygons, RawColors, light_from_srgb};
use crate::warning::Warnings;

/// The names of what is read, in the order of a row.
const NAMES: [&[&str]; 12] = [
    &["x"],
    &["y"],
    &["z"],
    &["nx", "normal_x"],
    &["ny", "normal_y"],
    &["nz", "normal_z"],
    &["red", "r", "diffuse_red"],
    &["green", "g", "diffuse_green"],
    &["blue", "b", "diffuse_blue"],
    &["alpha", "a", "diffuse_alpha"],
    &["s", "u", "texture_u", "texture_s"],
    &["t", "v", "texture_v", "texture_t"],
];
const X: usize = 0;
const NORMAL: usize = 3;
const RED: usize = 6;
const ALPHA: usize = 9;
const S: usize = 10;

/// Where the values of a row go.
struct Row {
    /// Of each property.
    slots: Vec<Option<usize>>,
    has_normal: bool,
    has_color: bool,
    has_uv: bool,
    colors: Channels,
    values: [f64; NAMES.len()],
}

impl Row {
    fn new(element: &Element) -> Self {
        let found = NAMES.map(|names| element.position(names));
        let mut slots = vec![None; element.properties.len()];
        for (slot, index) in found.iter().enumerate() {
            if let Some(index) = *index
                && matches!(element.properties[index].kind, Kind::Scalar(_))
            {
                slots[index] = Some(slot);
            }
        }
        let has = |from: usize, count: usize| (from..from + count).all(|slot| slots.contains(&Some(slot)));
        let (has_normal, has_color, has_uv) = (has(NORMAL, 3), has(RED, 3), has(S, 2));
        let colors = Channels::new(element, std::array::from_fn(|channel| found[RED + channel]));
        let mut values = [0.0; NAMES.len()];
        values[ALPHA] = colors.full()[3];
        Self { slots, has_normal, has_color, has_uv, colors, values }
    }

    fn is_placed(&self) -> bool {
        (X..X + 3).all(|slot| self.slots.contains(&Some(slot)))
    }

    fn read<V: Values>(&mut self, element: &Element, values: &mut V) -> Result<(), Fault> {
        values.begin_row()?;
        for (property, slot) in element.properties.iter().zip(&self.slots) {
            match (property.kind, *slot) {
                (Kind::Scalar(scalar), Some(slot)) => self.values[slot] = values.value(scalar)?,
                (kind, _) => values.skip(kind)?,
            }
        }
        values.end_row();
        Ok(())
    }

    fn push(&mut self, polygons: &mut Polygons) {
        let [x, y, z, nx, ny, nz, red, green, blue, alpha, s, t] = self.values;
        polygons.positions.push(DVec3::new(x, y, z));
        if self.has_normal {
            polygons.normals.push(Vec3::new(nx as f32, ny as f32, nz as f32));
        }
        if self.has_color {
            self.colors.push([red, green, blue, alpha], &mut polygons.colors);
        }
        if self.has_uv {
            // PLY counts v upwards.
            let uv = Vec2::new(s as f32, (1.0 - t) as f32);
            polygons.uvs.push(if uv.is_finite() { uv } else { Vec2::ZERO });
        }
    }
}

pub(super) fn read_vertices<V: Values>(
    import: &mut Import<'_>,
    element: &Element,
    values: &mut V,
    polygons: &mut Polygons,
) -> Result<(), LoadError> {
    let mut row = Row::new(element);
    if !row.is_placed() {
        let what = "its vertices have no properties x, y and z";
        let remedy = "export the model with positions";
        return Err(LoadError::new(LoadErrorKind::Malformed, import.path, what, remedy));
    }
    // Each row takes room: a count that does not fit is found out before memory is taken for it.
    let least = |kind: Kind| match kind {
        Kind::Scalar(scalar) => values.least_bytes(scalar),
        Kind::List { count, .. } => values.least_bytes(count),
    };
    let bytes: u64 = element.properties.iter().map(|property| least(property.kind)).sum();
    let capacity = (values.progress().1 as u64 + 1) / bytes;
    if element.count > capacity {
        return Err(cut_off(import, element, capacity, values));
    }
    let count = element.count as usize;
    polygons.positions.reserve_exact(count);
    polygons.normals.reserve_exact(if row.has_normal { count } else { 0 });
    polygons.colors.reserve_exact(if row.has_color { count } else { 0 });
    polygons.uvs.reserve_exact(if row.has_uv { count } else { 0 });
    for index in 0..element.count {
        report(import, index, values)?;
        match row.read(element, values) {
            Ok(()) => row.push(polygons),
            Err(fault) => {
                let ended = stopped(import, element, index, values, fault)?;
                return ended.map_err(|ended| cut_off(import, element, ended.rows, values));
            }
        }
    }
    row.colors.finish(&mut polygons.colors, &mut import.warnings);
    Ok(())
}

/// The colours of vertices and faces. Integers say what is full light by their type; of floats, which most
/// programs write from 0 to 1 and some from 0 to 255, the whole file tells.
///
/// The colours of an element while they are read.
pub(super) struct Channels {
    /// What stands for 1, for red, green, blue and alpha.
    full: [f64; 4],
    has_alpha: bool,
    /// Those that are floats.
    raw: Option<RawColors>,
}

impl Channels {
    /// For the properties of red, green, blue and alpha.
    pub(super) fn new(element: &Element, properties: [Option<usize>; 4]) -> Self {
        let scalar = |channel: usize| match element.properties[properties[channel]?].kind {
            Kind::Scalar(scalar) => Some(scalar),
            Kind::List { .. } => None,
        };
        let full = [0, 1, 2, 3].map(|channel| scalar(channel).map_or(255.0, |scalar| scalar.full_channel()));
        let is_float = (0..3).any(|channel| scalar(channel).is_some_and(|scalar| scalar.is_float()));
        Self { full, has_alpha: scalar(3).is_some(), raw: is_float.then(RawColors::default) }
    }

    /// The values of opaque white.
    pub(super) fn full(&self) -> [f64; 4] {
        self.full
    }

    /// Adds a colour in sRGB as linear light.
    pub(super) fn push(&mut self, channels: [f64; 4], colors: &mut Vec<Vec4>) {
        let units: [f32; 4] =
            std::array::from_fn(|channel| channels[channel] as f32 / self.full[channel] as f32);
        match &mut self.raw {
            Some(raw) => raw.push(&units.map(f64::from)[..if self.has_alpha { 4 } else { 3 }]),
            None => colors.push(light_from_srgb(units)),
        }
    }

    /// Adds those that had to wait for the others.
    pub(super) fn finish(self, colors: &mut Vec<Vec4>, warnings: &mut Warnings) {
        let Some(raw) = self.raw.filter(|raw| raw.len() > 0) else { return };
        let full = raw.full();
        if full > 1.0 {
            let what =
                format!("the colours are fractions above 1, and are taken as numbers from 0 to {full}");
            warnings.push(Location::Whole, what, "write them from 0 to 1, or as uchar");
        }
        if let Some(what) = raw.fault() {
            warnings.push(Location::Whole, what, "write them from 0 to 1, or as uchar");
        }
        colors.append(&mut raw.finish());
    }
}
