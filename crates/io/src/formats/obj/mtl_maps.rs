//! The statements of a material library that name images.

use super::lines::decode_name;
use super::map_options::{MapStatement, parse_map};
use super::mtl::{Map, MapKind};
use super::mtl_reader::{MEND, Reader};
use super::mtl_values::Stated;

impl Reader<'_> {
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
