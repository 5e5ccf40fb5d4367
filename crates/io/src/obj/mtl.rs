//! Material libraries: MTL text to materials of the scene. A malformed statement
//! is left out, with a warning, and the others stay.

use std::path::{Path, PathBuf};

use trigon_scene::Material;

use super::convert::convert;
use super::lines::{Lines, decode_name, plain_bytes, split_keyword, words};
use super::map_options::{MapStatement, parse_map};
use crate::error::Place;
use crate::warning::Warnings;

/// What a `map_…` statement is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MapKind {
    BaseColor,
    Opacity,
    Specular,
    Emissive,
    Roughness,
    Metallic,
    Normal,
    /// Heights by the format, directions by many exporters.
    Bump,
}

impl MapKind {
    fn of(keyword: &str) -> Option<Self> {
        match keyword.to_ascii_lowercase().as_str() {
            "map_kd" => Some(Self::BaseColor),
            "map_d" => Some(Self::Opacity),
            "map_ks" => Some(Self::Specular),
            "map_ke" => Some(Self::Emissive),
            "map_pr" => Some(Self::Roughness),
            "map_pm" => Some(Self::Metallic),
            "norm" | "map_norm" | "map_kn" => Some(Self::Normal),
            "bump" | "map_bump" => Some(Self::Bump),
            _ => None,
        }
    }
}

/// A texture that a material names.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Map {
    pub(crate) kind: MapKind,
    /// Of the library.
    pub(crate) line: u64,
    pub(crate) statement: MapStatement,
}

/// A material as a library describes it, its textures not yet read.
#[derive(Clone, Debug)]
pub(crate) struct MtlMaterial {
    pub(crate) material: Material,
    pub(crate) maps: Vec<Map>,
    /// The library.
    pub(crate) file: PathBuf,
}

/// What the statements of a material say; colours and all other numbers are finite.
#[derive(Clone, Debug, Default)]
pub(super) struct Fields {
    pub(super) name: String,
    /// `Kd`.
    pub(super) diffuse: Option<[f32; 3]>,
    /// `Ks`.
    pub(super) specular: Option<[f32; 3]>,
    /// `Ke`.
    pub(super) emissive: Option<[f32; 3]>,
    /// `Ns`.
    pub(super) shininess: Option<f32>,
    /// `d`.
    pub(super) dissolve: Option<f32>,
    /// `Tr`, and its line.
    pub(super) transparency: Option<(u64, f32)>,
    /// `illum`.
    pub(super) illumination_model: Option<u8>,
    /// `Pr`.
    pub(super) roughness: Option<f32>,
    /// `Pm`.
    pub(super) metallic: Option<f32>,
    /// `Ni`.
    pub(super) refraction: Option<f32>,
    pub(super) maps: Vec<Map>,
}

impl Fields {
    pub(super) fn has(&self, kind: MapKind) -> bool {
        self.maps.iter().any(|map| map.kind == kind)
    }
}

/// Reads a library. What is malformed in it becomes a warning.
pub(crate) fn parse_mtl(file: &Path, bytes: &[u8], warnings: &mut Warnings) -> Vec<MtlMaterial> {
    let text = match plain_bytes(bytes) {
        Ok(text) => text,
        Err(what) => {
            warnings.push_about(file, Place::Whole, what, "fetch the real file with `git lfs pull`");
            return Vec::new();
        }
    };
    let mut reader = Reader { file, warnings, materials: Vec::new(), skipping: true };
    for (number, line) in Lines::new(&text) {
        if let Some((keyword, rest)) = split_keyword(&line) {
            reader.statement(number, &decode_name(keyword), rest);
        }
    }
    let Reader { materials, .. } = reader;
    materials.into_iter().map(|fields| convert(file, fields, warnings)).collect()
}

struct Reader<'a> {
    file: &'a Path,
    warnings: &'a mut Warnings,
    materials: Vec<Fields>,
    /// Whether the statements belong to no material.
    skipping: bool,
}

impl Reader<'_> {
    fn statement(&mut self, line: u64, keyword: &str, rest: &[u8]) {
        if keyword == "newmtl" {
            return self.start_material(line, rest);
        }
        if self.skipping {
            return;
        }
        match keyword {
            "Kd" | "Ks" | "Ke" => self.color(line, keyword, rest),
            "Ns" | "d" | "Pr" | "Pm" | "Ni" => self.number(line, keyword, rest),
            "Tr" => {
                let value = numbers(rest).first().copied();
                self.fields().transparency = value.map(|value| (line, value));
            }
            "illum" => match words(rest).next().map(decode_name).and_then(|word| word.parse().ok()) {
                Some(model) => self.fields().illumination_model = Some(model),
                None => self.warn(line, "illum has no number"),
            },
            _ => match MapKind::of(keyword) {
                Some(kind) => self.map(line, keyword, kind, rest),
                None => self.other_map(line, keyword, rest),
            },
        }
    }

    fn start_material(&mut self, line: u64, rest: &[u8]) {
        let name = decode_name(rest);
        self.skipping = name.is_empty();
        if self.skipping {
            return self.warn(line, "a material has no name and is left out");
        }
        self.materials.push(Fields { name, ..Fields::default() });
    }

    /// One grey value or three channels.
    fn color(&mut self, line: u64, keyword: &str, rest: &[u8]) {
        let color = match *numbers(rest).as_slice() {
            [red, green, blue, ..] => [red, green, blue],
            [grey] => [grey; 3],
            _ => return self.warn(line, &format!("{keyword} has no three numbers and is ignored")),
        };
        let fields = self.fields();
        match keyword {
            "Kd" => fields.diffuse = Some(color),
            "Ks" => fields.specular = Some(color),
            _ => fields.emissive = Some(color),
        }
    }

    /// The first number; words before it, as in `d -halo 0.5`, mean what trigon
    /// does not draw.
    fn number(&mut self, line: u64, keyword: &str, rest: &[u8]) {
        let Some(value) = words(rest).filter_map(number).next() else {
            return self.warn(line, &format!("{keyword} has no number and is ignored"));
        };
        let fields = self.fields();
        let field = match keyword {
            "Ns" => &mut fields.shininess,
            "d" => &mut fields.dissolve,
            "Pr" => &mut fields.roughness,
            "Pm" => &mut fields.metallic,
            _ => &mut fields.refraction,
        };
        *field = Some(value);
    }

    /// Of several for the same purpose the last counts.
    fn map(&mut self, line: u64, keyword: &str, kind: MapKind, rest: &[u8]) {
        let statement = parse_map(&decode_name(rest));
        if statement.file.is_empty() {
            return self.warn(line, &format!("{keyword} names no file and is ignored"));
        }
        if !statement.ignored.is_empty() {
            let (options, file) = (statement.ignored.join(", "), &statement.file);
            self.warn(line, &format!("the options {options} of texture \"{file}\" are not followed"));
        }
        let maps = &mut self.fields().maps;
        maps.retain(|map| map.kind != kind);
        maps.push(Map { kind, line, statement });
    }

    /// Textures that are not drawn are named; other statements are not.
    fn other_map(&mut self, line: u64, keyword: &str, rest: &[u8]) {
        let lower = keyword.to_ascii_lowercase();
        if lower.starts_with("map_") || matches!(lower.as_str(), "disp" | "decal" | "refl") {
            let file = parse_map(&decode_name(rest)).file;
            let what = format!("{keyword} \"{file}\" is not drawn");
            self.warnings.push_about(
                self.file,
                Place::Line(line),
                what,
                "bake the effect into map_Kd if it matters",
            );
        }
    }

    fn fields(&mut self) -> &mut Fields {
        self.materials.last_mut().expect("a statement is only read after newmtl")
    }

    fn warn(&mut self, line: u64, what: &str) {
        self.warnings.push_about(
            self.file,
            Place::Line(line),
            what,
            "mend the line, or export the material again",
        );
    }
}

/// The finite numbers at the start of a statement.
fn numbers(rest: &[u8]) -> Vec<f32> {
    words(rest).map_while(number).collect()
}

fn number(word: &[u8]) -> Option<f32> {
    std::str::from_utf8(word).ok()?.parse().ok().filter(|value: &f32| value.is_finite())
}

#[cfg(test)]
mod tests {
    use trigon_math::color::srgb_to_linear;
    use trigon_math::{Vec3, Vec4};
    use trigon_scene::{AlphaMode, Shading};

    use super::*;

    fn parse(text: &str) -> (Vec<MtlMaterial>, Vec<String>) {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        let materials = parse_mtl(Path::new("a.mtl"), text.as_bytes(), &mut warnings);
        (materials, warnings.into_list().iter().map(ToString::to_string).collect())
    }

    #[test]
    fn values_arrive() {
        let (materials, warnings) =
            parse("newmtl my wood\nKd 1 0 0\nKs 1 1 1\nNs 50\nd 0.5\nillum 2\nmap_Kd -s 2 2 1 a b.png\n");
        assert_eq!(warnings, [""; 0], "nothing to warn of");
        let MtlMaterial { material, maps, .. } = &materials[0];
        assert_eq!(material.name, "my wood", "spaces stay");
        assert_eq!(material.base_color, Vec4::new(1.0, 0.0, 0.0, 0.5), "colour and alpha");
        assert_eq!(material.alpha_mode, AlphaMode::Blend, "d below 1");
        assert_eq!(material.shading, Shading::blinn_phong(Vec3::ONE, 50.0), "highlight");
        let [map] = &maps[..] else { panic!("one texture: {maps:?}") };
        assert_eq!((map.kind, map.statement.file.as_str()), (MapKind::BaseColor, "a b.png"), "the texture");
    }

    #[test]
    fn malformed_statements_are_warnings_with_lines() {
        let (materials, warnings) = parse("newmtl \nKs 0\nnewmtl a\nKd 0.5\nKs x\nNs\nillum two\nKd 1 2\n");
        assert_eq!(materials.len(), 1, "the named one");
        for line in [1, 5, 6, 7, 8] {
            assert!(
                warnings.iter().any(|warning| warning.starts_with(&format!("a.mtl, line {line}: "))),
                "line {line}: {warnings:?}"
            );
        }
        assert_eq!(materials[0].material.base_color.x, srgb_to_linear(0.5), "one number is grey");
    }

    #[test]
    fn transparency_has_two_spellings() {
        let alpha = |text: &str| parse(&format!("newmtl a\n{text}\n")).0[0].material.base_color.w;
        assert_eq!(alpha("Tr 0.25"), 0.75, "Tr");
        assert_eq!(alpha("Tr 1"), 1.0, "taken as opaque");
        assert_eq!(alpha("d 0.5\nTr 0.9"), 0.5, "d wins");
        assert_eq!(alpha("d -halo 0.5"), 0.5, "options are skipped");
        assert_eq!(alpha("d nan"), 1.0, "not finite");
    }

    #[test]
    fn physically_based_fields_make_a_metallic_rough_material() {
        let model = |text: &str| match parse(&format!("newmtl a\nKs 1 1 1\n{text}\n")).0[0].material.shading {
            Shading::MetallicRoughness(model) => (model.roughness, model.metallic),
            other => panic!("{text:?} made {other:?}"),
        };
        assert_eq!(model("Pr 0.25\nPm 0.75"), (0.25, 0.75), "the numbers");
        assert_eq!(model("Pm 3"), (0.5, 1.0), "within their range, and a default");
        assert_eq!(model("map_Pr a.png\nPm 0"), (1.0, 0.0), "a texture as it is");
        assert_eq!(model("map_Pm a.png\nPm 0"), (0.5, 1.0), "0 beside a texture means nothing");
    }

    #[test]
    fn every_map_that_is_drawn_arrives_and_others_are_named() {
        let text = "newmtl a\nmap_Ks s\nmap_Ke e\nmap_d d\nmap_Bump -bm 1 b\nnorm n\nNi 1.3\nmap_Kd old\nmap_Kd new\n";
        let (materials, warnings) = parse(text);
        assert_eq!(warnings, [""; 0], "nothing to warn of");
        let files: Vec<&str> = materials[0].maps.iter().map(|map| map.statement.file.as_str()).collect();
        assert_eq!(files, ["s", "e", "d", "b", "n", "new"], "the last of each kind");
        let material = &materials[0].material;
        assert_eq!((material.emissive, material.ior), (Vec3::ONE, 1.3), "as the textures are; Ni");
        assert_eq!(material.alpha_mode, AlphaMode::Mask { cutoff: 0.5 }, "holes");
        let (_, warnings) = parse("newmtl a\nmap_Ns -bm 1 n.png\ndisp d.png\nmap_Kd\nPr x\n");
        for name in ["n.png", "d.png", "map_Kd", "Pr"] {
            assert!(warnings.iter().any(|warning| warning.contains(name)), "{name}: {warnings:?}");
        }
    }

    #[test]
    fn a_black_colour_beside_a_texture_is_white() {
        let (materials, _) = parse("newmtl a\nKd 0 0 0\nmap_Kd a.png\nnewmtl b\nKd 0 0 0\n");
        assert_eq!(materials[0].material.base_color, Vec4::ONE, "the texture as it is");
        assert_eq!(materials[1].material.base_color, Vec4::new(0.0, 0.0, 0.0, 1.0), "black");
    }
}
