//! The materials of a library as it states them, and the options of their `map_…` lines: `-s 2 2 1 -clamp on
//! folder/my wood.png`. A malformed statement is left out with a warning; the others are kept.

use std::path::{Path, PathBuf};

use trigon_math::Vec2;
use trigon_scene::Material;

use super::convert::convert;
use super::lines::{Lines, decode_name, split_keyword};
use super::mtl_reader::MtlReader;
use super::mtl_reader::Stated;
use crate::rows::plain_text;
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
    /// By the keyword in lower case.
    pub(super) fn of(keyword: &str) -> Option<Self> {
        match keyword {
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

    /// Whether the image holds colours rather than numbers.
    pub(super) fn holds_colors(self) -> bool {
        matches!(self, Self::BaseColor | Self::Specular | Self::Emissive)
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
    /// Where it begins there.
    pub(crate) line: u64,
}

impl MtlMaterial {
    /// Whether another definition looks the same.
    pub(super) fn looks_like(&self, other: &Self) -> bool {
        let maps = |material: &Self| {
            material.maps.iter().map(|map| (map.kind, map.statement.clone())).collect::<Vec<_>>()
        };
        self.material == other.material && maps(self) == maps(other)
    }

    pub(super) fn map(&self, kind: MapKind) -> Option<&Map> {
        self.maps.iter().find(|map| map.kind == kind)
    }
}

/// What the statements of a material say; colours and all other numbers are finite
/// and, but for `Ka`, `Tf` and `Ni`, within the range that the format gives them.
#[derive(Clone, Debug, Default)]
pub(super) struct Fields {
    pub(super) name: String,
    /// Where it begins.
    pub(super) line: u64,
    /// `Ka`.
    pub(super) ambient: Option<Stated<[f32; 3]>>,
    /// `Kd`.
    pub(super) diffuse: Option<Stated<[f32; 3]>>,
    /// `Ks`.
    pub(super) specular: Option<Stated<[f32; 3]>>,
    /// `Ke`.
    pub(super) emissive: Option<Stated<[f32; 3]>>,
    /// `Tf`, or `Kt`.
    pub(super) filter: Option<Stated<[f32; 3]>>,
    /// `Ns`.
    pub(super) shininess: Option<Stated<f32>>,
    /// `d`.
    pub(super) dissolve: Option<Stated<f32>>,
    /// `Tr`.
    pub(super) transparency: Option<Stated<f32>>,
    /// `illum`.
    pub(super) illumination_model: Option<Stated<u8>>,
    /// `Pr`.
    pub(super) roughness: Option<Stated<f32>>,
    /// `Pm`.
    pub(super) metallic: Option<Stated<f32>>,
    /// `Ni`.
    pub(super) refraction: Option<Stated<f32>>,
    /// The image of `map_Ka`.
    pub(super) ambient_map: Option<Stated<String>>,
    pub(super) maps: Vec<Map>,
}

impl Fields {
    pub(super) fn map(&self, kind: MapKind) -> Option<&Map> {
        self.maps.iter().find(|map| map.kind == kind)
    }

    pub(super) fn has(&self, kind: MapKind) -> bool {
        self.map(kind).is_some()
    }

    /// Whether it has any field of "physically-based" MTL that is drawn.
    pub(super) fn is_physically_based(&self) -> bool {
        self.roughness.is_some()
            || self.metallic.is_some()
            || self.has(MapKind::Roughness)
            || self.has(MapKind::Metallic)
    }
}

/// Reads a library. What is malformed in it becomes a warning.
pub(crate) fn parse_mtl(file: &Path, bytes: &[u8], warnings: &mut Warnings) -> Vec<MtlMaterial> {
    let text = plain_text(bytes);
    let mut reader = MtlReader::new(file, warnings);
    for (number, line) in Lines::new(&text) {
        if let Some((keyword, rest)) = split_keyword(&line) {
            reader.statement(number, &decode_name(keyword), rest);
        }
    }
    let materials = reader.into_materials();
    materials.into_iter().map(|fields| convert(file, fields, warnings)).collect()
}

/// A texture statement, taken apart.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapStatement {
    /// The rest of the line: names may have spaces.
    pub(crate) file: String,
    /// `-s`: the texture is repeated so often.
    pub(crate) scale: Vec2,
    /// `-o`: it starts so far along.
    pub(crate) offset: Vec2,
    pub(crate) clamp: bool,
    /// `-bm`: bumps are so much steeper.
    pub(crate) bump: f32,
    /// Options that change the image and that trigon does not follow.
    pub(crate) ignored: Vec<String>,
    /// Options whose arguments are not what they should be.
    pub(crate) malformed: Vec<String>,
}

/// Takes the options off; what is left is the file name. `holds_colors` says how the
/// image is read.
pub(crate) fn parse_map(rest: &str, holds_colors: bool) -> MapStatement {
    let mut map = MapStatement {
        file: String::new(),
        scale: Vec2::ONE,
        offset: Vec2::ZERO,
        clamp: false,
        bump: 1.0,
        ignored: Vec::new(),
        malformed: Vec::new(),
    };
    let mut rest = rest.trim();
    while let Some((option, after)) = split_option(rest) {
        let mut arguments = Vec::new();
        rest = take_arguments(option.arguments, after, &mut arguments);
        map.apply(option.name, &arguments, holds_colors);
    }
    map.file = rest.trim().to_owned();
    map
}

/// An option of the format.
struct MapOption {
    name: &'static str,
    /// The number of its arguments; three stands for one to three numbers.
    arguments: usize,
}

const OPTIONS: &[MapOption] = &[
    MapOption { name: "-blendu", arguments: 1 },
    MapOption { name: "-blendv", arguments: 1 },
    MapOption { name: "-bm", arguments: 1 },
    MapOption { name: "-boost", arguments: 1 },
    MapOption { name: "-cc", arguments: 1 },
    MapOption { name: "-clamp", arguments: 1 },
    MapOption { name: "-colorspace", arguments: 1 },
    MapOption { name: "-imfchan", arguments: 1 },
    MapOption { name: "-mm", arguments: 2 },
    MapOption { name: "-o", arguments: 3 },
    MapOption { name: "-s", arguments: 3 },
    MapOption { name: "-t", arguments: 3 },
    MapOption { name: "-texres", arguments: 1 },
    MapOption { name: "-type", arguments: 1 },
];

fn split_option(rest: &str) -> Option<(&'static MapOption, &str)> {
    let (word, after) = split_word(rest);
    OPTIONS.iter().find(|option| option.name == word).map(|option| (option, after))
}

fn split_word(rest: &str) -> (&str, &str) {
    let rest = rest.trim_start();
    rest.split_at(rest.find(char::is_whitespace).unwrap_or(rest.len()))
}

fn take_arguments<'a>(count: usize, mut rest: &'a str, into: &mut Vec<&'a str>) -> &'a str {
    for _ in 0..count {
        let (word, after) = split_word(rest);
        // Two of the three numbers may be missing.
        if word.is_empty() || (count == 3 && !into.is_empty() && word.parse::<f32>().is_err()) {
            break;
        }
        into.push(word);
        rest = after;
    }
    rest
}

impl MapStatement {
    /// Whether another texture is placed in the same way.
    pub(super) fn is_placed_like(&self, other: &Self) -> bool {
        (self.scale, self.offset, self.clamp) == (other.scale, other.offset, other.clamp)
    }

    fn apply(&mut self, option: &str, arguments: &[&str], holds_colors: bool) {
        let spelled = format!("{option} {}", arguments.join(" "));
        let numbers: Option<Vec<f32>> = arguments.iter().map(|word| finite(word)).collect();
        let first = arguments.first().copied().unwrap_or_default();
        let is_followed = match (option, numbers.as_deref()) {
            // Two of the three numbers may be missing, and the third is for images of
            // three dimensions.
            ("-s", Some(&[u, ref more @ ..])) => {
                self.scale = Vec2::new(u, more.first().copied().unwrap_or(1.0));
                true
            }
            ("-o", Some(&[u, ref more @ ..])) => {
                self.offset = Vec2::new(u, more.first().copied().unwrap_or(0.0));
                true
            }
            ("-bm", Some(&[bump])) => {
                self.bump = bump;
                true
            }
            ("-mm", Some(range)) => range == [0.0, 1.0],
            ("-t", Some(turbulence)) => turbulence.iter().all(|&value| value == 0.0),
            ("-boost", Some(&[boost])) => boost == 0.0,
            // Images keep their own resolution.
            ("-texres", Some(_)) => true,
            ("-s" | "-o" | "-bm" | "-mm" | "-t" | "-boost" | "-texres", _) => {
                return self.malformed.push(spelled);
            }
            ("-clamp" | "-cc" | "-blendu" | "-blendv", _) if !matches!(first, "on" | "off") => {
                return self.malformed.push(spelled);
            }
            ("-clamp", _) => {
                self.clamp = first == "on";
                true
            }
            ("-cc", _) => first == "off",
            ("-blendu" | "-blendv", _) => first == "on",
            ("-colorspace", _) => first.eq_ignore_ascii_case(if holds_colors { "srgb" } else { "linear" }),
            _ => false,
        };
        if !is_followed {
            self.ignored.push(spelled);
        }
    }
}

fn finite(word: &str) -> Option<f32> {
    word.parse().ok().filter(|value: &f32| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::color::srgb_to_linear;
    use trigon_math::{Vec3, Vec4};
    use trigon_scene::{AlphaMode, Shading};

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
        assert_eq!(alpha("Tr 1"), 1.0, "read as opaque");
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
        let [twice, both] = &warnings[..] else { panic!("{warnings:?}") };
        assert!(twice.contains("map_Kd is given twice") && both.contains("beside norm"), "{warnings:?}");
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

    fn options_of(rest: &str) -> MapStatement {
        parse_map(rest, true)
    }

    #[test]
    fn options_come_off_and_spaces_stay() {
        let map = options_of(" -s 2 3 -bm 0.5 -clamp on -o 0.25 my wood.png ");
        assert_eq!(map.file, "my wood.png", "the name");
        assert_eq!(
            (map.scale, map.offset, map.clamp, map.bump),
            (Vec2::new(2.0, 3.0), Vec2::new(0.25, 0.0), true, 0.5),
            "the options"
        );
        assert_eq!(options_of("-foo.png").file, "-foo.png", "a name may begin with a dash");
        assert_eq!(options_of("-mm 0.1 0.9 a.png").ignored, ["-mm 0.1 0.9"], "named");
        assert_eq!(options_of("-mm 0 1 -cc off -t 0 -boost 0 a.png").ignored, [""; 0], "the defaults");
        assert_eq!(options_of("-colorspace linear -imfchan r a.png").ignored.len(), 2, "of a colour");
        assert_eq!(options_of("-s x 2 a.png").malformed, ["-s x 2"], "no number");
        assert_eq!(options_of("-o 0.5 nan 0 a.png").malformed, ["-o 0.5 nan 0"], "not finite");
        assert_eq!(options_of("-clamp yes a.png").malformed, ["-clamp yes"], "neither on nor off");
        assert_eq!(options_of("-s").file, "", "an option and nothing else");
    }
}
