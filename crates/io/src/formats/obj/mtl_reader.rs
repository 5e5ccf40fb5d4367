//! Reads the statements of a material library one by one: numbers, colours and the names of images. Keywords may
//! be upper or lower case: exporters write `map_kd`, `map_Kd` and `map_KD`.

use std::ops::RangeInclusive;
use std::path::Path;

use super::lines::{decode_name, words};
use super::mtl::{Fields, Map, MapKind, MapStatement, parse_map};
use crate::error::Location;
use crate::warning::Warnings;

/// Reads the statements of a library.
pub(super) struct MtlReader<'a> {
    file: &'a Path,
    warnings: &'a mut Warnings,
    materials: Vec<Fields>,
    /// Which material the statements belong to.
    state: State,
}

/// Where a statement stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    BeforeFirst,
    InMaterial,
    /// In a material that is left out.
    InNameless,
}

/// A field of a material.
type Field<T> = fn(&mut Fields) -> &mut Option<Stated<T>>;

/// No number is outside.
const ANY: RangeInclusive<f32> = f32::MIN..=f32::MAX;

pub(super) const MEND: &str = "fix the line, or export the material again";

impl<'a> MtlReader<'a> {
    pub(super) fn new(file: &'a Path, warnings: &'a mut Warnings) -> Self {
        Self { file, warnings, materials: Vec::new(), state: State::BeforeFirst }
    }

    /// What was read, in order.
    pub(super) fn into_materials(self) -> Vec<Fields> {
        self.materials
    }

    pub(super) fn statement(&mut self, line: u64, keyword: &str, rest: &[u8]) {
        let lower = keyword.to_ascii_lowercase();
        if lower == "newmtl" {
            return self.start_material(line, rest);
        }
        match self.state {
            State::InMaterial => {}
            State::InNameless => return,
            State::BeforeFirst => {
                let what = "a statement stands before the first newmtl and is ignored";
                return self.warn(line, what, "move it below the newmtl of its material");
            }
        }
        match lower.as_str() {
            // What is not drawn may have any value.
            "ka" => self.color(line, keyword, rest, ANY, |fields| &mut fields.ambient),
            "kd" => self.color(line, keyword, rest, 0.0..=1.0, |fields| &mut fields.diffuse),
            "ks" => self.color(line, keyword, rest, 0.0..=1.0, |fields| &mut fields.specular),
            "ke" => self.color(line, keyword, rest, 0.0..=1.0, |fields| &mut fields.emissive),
            // tinyobjloader and others write the second.
            "tf" | "kt" => self.color(line, keyword, rest, ANY, |fields| &mut fields.filter),
            "ns" => self.number(line, keyword, rest, 0.0..=1000.0, |fields| &mut fields.shininess),
            "d" => self.dissolve(line, keyword, rest),
            // What is above 1 has a warning of its own.
            "tr" => self.number(line, keyword, rest, 0.0..=f32::MAX, |fields| &mut fields.transparency),
            "pr" => self.number(line, keyword, rest, 0.0..=1.0, |fields| &mut fields.roughness),
            "pm" => self.number(line, keyword, rest, 0.0..=1.0, |fields| &mut fields.metallic),
            "ni" => self.number(line, keyword, rest, ANY, |fields| &mut fields.refraction),
            "illum" => self.illumination_model(line, rest),
            "ps" => self.undrawn_layer(line, keyword, "sheen", rest),
            "pc" => self.undrawn_layer(line, keyword, "clear coat", rest),
            "aniso" => self.undrawn_layer(line, keyword, "brushed metal", rest),
            // They matter only with `Pc`, with `aniso`, with `refl`, and where
            // textures are not filtered anyway.
            "pcr" | "anisor" | "sharpness" | "map_aat" => {}
            _ => match MapKind::of(&lower) {
                Some(kind) => self.map(line, keyword, kind, rest),
                None => self.other(line, keyword, &lower, rest),
            },
        }
    }

    fn start_material(&mut self, line: u64, rest: &[u8]) {
        let name = decode_name(rest);
        if name.is_empty() {
            self.state = State::InNameless;
            return self.warn(line, "a material has no name and is left out", MEND);
        }
        self.state = State::InMaterial;
        self.materials.push(Fields { name, line, ..Fields::default() });
    }

    fn color(
        &mut self,
        line: u64,
        keyword: &str,
        rest: &[u8],
        range: RangeInclusive<f32>,
        field: Field<[f32; 3]>,
    ) {
        match read_color(rest) {
            Ok((color, surplus)) => {
                self.note_surplus(line, keyword, surplus, "more than 3 numbers, and the first 3 count");
                let value = color.map(|channel| channel.clamp(*range.start(), *range.end()));
                self.note_clamped(line, keyword, value != color, &range);
                self.set(line, keyword, value, field);
            }
            Err(what) => self.warn(line, &format!("{keyword} {what}, and is ignored"), MEND),
        }
    }

    fn number(
        &mut self,
        line: u64,
        keyword: &str,
        rest: &[u8],
        range: RangeInclusive<f32>,
        field: Field<f32>,
    ) {
        match read_number(rest) {
            Ok((number, surplus)) => {
                self.note_surplus(line, keyword, surplus, "more than 1 number, and the first counts");
                let value = number.clamp(*range.start(), *range.end());
                self.note_clamped(line, keyword, value != number, &range);
                self.set(line, keyword, value, field);
            }
            Err(what) => self.warn(line, &format!("{keyword} {what}, and is ignored"), MEND),
        }
    }

    /// `d 0.5`, or `d -halo 0.5`, which is clearer where the surface faces the eye.
    fn dissolve(&mut self, line: u64, keyword: &str, rest: &[u8]) {
        let (first, after) = rest.trim_ascii().split_at_checked(5).unwrap_or((rest, b""));
        let rest = if first == b"-halo" {
            let what = "d -halo is drawn as d: the same all over";
            self.warn(line, what, "remove -halo if that will do");
            after
        } else {
            rest
        };
        self.number(line, keyword, rest, 0.0..=1.0, |fields| &mut fields.dissolve);
    }

    fn illumination_model(&mut self, line: u64, rest: &[u8]) {
        /// The last that the format has.
        const LAST: u8 = 10;
        let mut words = words(rest);
        let word = words.next().map(decode_name).unwrap_or_default();
        match word.parse() {
            Ok(model @ 0..=LAST) => {
                let surplus = words.next().is_some();
                self.note_surplus(line, "illum", surplus, "more than 1 number, and the first counts");
                self.set(line, "illum", model, |fields| &mut fields.illumination_model);
            }
            _ if word.is_empty() => self.warn(line, "illum has no number, and is ignored", MEND),
            _ => {
                let what = format!("illum {word} is not an illumination model (0 to {LAST}), and is ignored");
                self.warn(line, &what, MEND);
            }
        }
    }

    /// What physically-based MTL lays over a surface.
    fn undrawn_layer(&mut self, line: u64, keyword: &str, name: &str, rest: &[u8]) {
        match read_color(rest) {
            Ok(([0.0, 0.0, 0.0], _)) => {}
            Ok(_) => self.warn(
                line,
                &format!("{keyword} ({name}) is not drawn"),
                "set it to 0 if it matters little",
            ),
            Err(what) => self.warn(line, &format!("{keyword} {what}, and is ignored"), MEND),
        }
    }

    /// Of several statements of the same kind the last counts.
    fn set<T>(&mut self, line: u64, keyword: &str, value: T, field: Field<T>) {
        if field(self.fields()).is_some() {
            self.note_repeated(line, keyword);
        }
        *field(self.fields()) = Some(Stated { line, value });
    }

    pub(super) fn note_repeated(&mut self, line: u64, keyword: &str) {
        let what = format!("{keyword} is given twice in a material, and the last counts");
        self.warn(line, &what, "remove one of them");
    }

    fn note_surplus(&mut self, line: u64, keyword: &str, surplus: bool, what: &str) {
        if surplus {
            self.warn(line, &format!("{keyword} has {what}"), MEND);
        }
    }

    fn note_clamped(&mut self, line: u64, keyword: &str, clamped: bool, range: &RangeInclusive<f32>) {
        if clamped {
            let (low, high) = (range.start(), range.end());
            let what = match *high < f32::MAX {
                true => format!("{keyword} is outside of {low} to {high} and is clamped"),
                false => format!("{keyword} is below {low} and is clamped"),
            };
            self.warn(line, &what, "write a number within that range");
        }
    }

    pub(super) fn fields(&mut self) -> &mut Fields {
        self.materials.last_mut().expect("a statement is only read after newmtl")
    }

    pub(super) fn warn(&mut self, line: u64, what: &str, remedy: &str) {
        self.warnings.push_about(self.file, Location::Line(line), what, remedy);
    }
}

impl MtlReader<'_> {
    pub(super) fn map(&mut self, line: u64, keyword: &str, kind: MapKind, rest: &[u8]) {
        let statement = parse_map(&decode_name(rest), kind.holds_colors());
        let file = &statement.file;
        if file.is_empty() {
            return self.warn(line, &format!("{keyword} names no file, and is ignored"), MEND);
        }
        self.note_options(line, &statement);
        if self.fields().has(kind) {
            self.note_repeated(line, keyword);
        }
        let maps = &mut self.fields().maps;
        maps.retain(|map| map.kind != kind);
        maps.push(Map { kind, line, statement });
    }

    fn note_options(&mut self, line: u64, MapStatement { file, malformed, ignored, .. }: &MapStatement) {
        if !malformed.is_empty() {
            let options = malformed.join(", ");
            let what = format!("the options {options} of texture \"{file}\" are malformed and not followed");
            self.warn(line, &what, MEND);
        }
        if !ignored.is_empty() {
            let options = ignored.join(", ");
            let what = format!("the options {options} of texture \"{file}\" are not followed");
            self.warn(line, &what, "apply them to the image, and remove them here");
        }
    }

    /// Textures that are not drawn, and what is no statement.
    pub(super) fn other(&mut self, line: u64, keyword: &str, lower: &str, rest: &[u8]) {
        let remedy = match lower {
            "map_ka" => {
                let value = parse_map(&decode_name(rest), true).file;
                self.fields().ambient_map = Some(Stated { line, value });
                return;
            }
            "refl" | "map_refl" => "light the model with an environment image instead",
            "disp" | "map_disp" => "displace the mesh before exporting it",
            "map_tr" => "write map_d, with the image inverted if it shows transparency",
            "map_ns" => "write Ns, or map_Pr with an image of roughness",
            "map_rma" | "map_orm" => "split the image into map_Pr and map_Pm",
            _ if lower.starts_with("map_") || lower == "decal" => "bake the effect into map_Kd if it matters",
            _ => {
                let what = format!("the statement \"{keyword}\" is unknown and is ignored");
                return self.warn(line, &what, "check its spelling, or remove it");
            }
        };
        let file = parse_map(&decode_name(rest), false).file;
        self.warn(line, &format!("{keyword} \"{file}\" is not drawn"), remedy);
    }
}

/// What a statement says, and the line that says it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stated<T> {
    pub(super) line: u64,
    pub(super) value: T,
}

/// Three channels, or one for all of them: `Kd 1 0 0`, `Kd 0.5`. Says whether there
/// are more numbers, which were not read.
pub(super) fn read_color(rest: &[u8]) -> Result<([f32; 3], bool), String> {
    match words(rest).next() {
        Some(b"spectral") => return Err("names a spectral curve, which is not read".to_owned()),
        Some(b"xyz") => return Err("is in CIE XYZ, which is not read".to_owned()),
        _ => {}
    }
    match *finite_numbers(rest)?.as_slice() {
        [] => Err("has no number".to_owned()),
        [grey] => Ok(([grey; 3], false)),
        [_, _] => Err("has 2 numbers and needs 1 or 3".to_owned()),
        [red, green, blue, ref more @ ..] => Ok(([red, green, blue], !more.is_empty())),
    }
}

/// One number. Says whether there are more, which were not read.
pub(super) fn read_number(rest: &[u8]) -> Result<(f32, bool), String> {
    match *finite_numbers(rest)?.as_slice() {
        [] => Err("has no number".to_owned()),
        [value, ref more @ ..] => Ok((value, !more.is_empty())),
    }
}

/// All words up to a comment, which must be finite numbers.
fn finite_numbers(rest: &[u8]) -> Result<Vec<f32>, String> {
    let number = |word: &[u8]| {
        let text = decode_name(word);
        let value = text.parse().ok().filter(|value: &f32| value.is_finite());
        value.ok_or_else(|| format!("has \"{text}\", which is not a finite number"))
    };
    words(rest).map(number).collect()
}
