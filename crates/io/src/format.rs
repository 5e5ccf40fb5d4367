//! Which format a file has: by its name, and by its first bytes when the name
//! says nothing.

use std::path::Path;

/// A model format that can be read.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Wavefront OBJ with its MTL.
    Obj,
    /// glTF 2.0: JSON with buffers and pictures beside it or in it.
    Gltf,
    /// glTF 2.0 in one binary file.
    Glb,
}

/// What `--list-readers` prints of one format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reader {
    /// The format.
    pub format: Format,
    /// For people.
    pub name: &'static str,
    /// The endings of file names, in lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// What is read of it.
    pub reads: &'static str,
}

/// Every model format that can be read.
pub fn readers() -> &'static [Reader] {
    const GLTF: &str = "node tree, materials and all their textures, cameras, lights, skins, morph targets, animations, instances, meshopt compression; no Draco, no KTX2";
    const OBJ: &str = "polygons, edges, points, groups, Phong and physically-based materials with their textures, vertex colours";
    const READERS: &[Reader] = &[
        Reader { format: Format::Obj, name: "Wavefront OBJ with MTL", extensions: &["obj"], reads: OBJ },
        Reader { format: Format::Gltf, name: "glTF 2.0", extensions: &["gltf"], reads: GLTF },
        Reader { format: Format::Glb, name: "glTF 2.0 binary", extensions: &["glb", "vrm"], reads: GLTF },
    ];
    READERS
}

/// Formats that people will try, and that are named instead of misread.
const UNSUPPORTED: &[&str] = &[
    "ply", "stl", "off", "fbx", "dae", "3ds", "blend", "usd", "usda", "usdc", "usdz", "x3d", "wrl", "step",
    "stp", "iges", "3mf",
];

/// The format of a file, or why it is none of ours. The magic of a GLB beats
/// the name; then the name decides; then the contents.
pub(crate) fn detect_format(path: &Path, bytes: &[u8]) -> Result<Format, String> {
    let extension =
        path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_lowercase();
    let by_name = readers().iter().find(|reader| reader.extensions.contains(&extension.as_str()));
    if let Some(reader) = by_name {
        // Many a GLB is called .gltf and the other way round.
        return Ok(match (reader.format, bytes.starts_with(b"glTF"), first_visible(bytes)) {
            (Format::Gltf, true, _) => Format::Glb,
            (Format::Glb, false, Some(b'{')) => Format::Gltf,
            (format, _, _) => format,
        });
    }
    if UNSUPPORTED.contains(&extension.as_str()) {
        return Err(format!(".{extension} files are not supported yet"));
    }
    sniff(bytes).ok_or_else(|| "it is of no known model format".to_owned())
}

/// The formats for a remedy: "convert it to …".
pub(crate) fn supported() -> String {
    let endings: Vec<String> = readers()
        .iter()
        .flat_map(|reader| reader.extensions)
        .filter(|&&e| e != "vrm")
        .map(|e| format!(".{e}"))
        .collect();
    format!("supported are {}", endings.join(", "))
}

fn sniff(bytes: &[u8]) -> Option<Format> {
    if bytes.starts_with(b"glTF") {
        return Some(Format::Glb);
    }
    if first_visible(bytes) == Some(b'{') {
        return Some(Format::Gltf);
    }
    let start = &bytes[..bytes.len().min(1 << 16)];
    start.split(|&byte| byte == b'\n' || byte == b'\r').take(1000).any(looks_like_obj).then_some(Format::Obj)
}

/// Whether a line is a vertex, as every OBJ has one: `v`, three numbers.
fn looks_like_obj(line: &[u8]) -> bool {
    let line = String::from_utf8_lossy(line);
    let mut words = line.trim_start_matches('\u{feff}').split_ascii_whitespace();
    words.next() == Some("v") && words.take(3).filter(|word| word.parse::<f64>().is_ok()).count() == 3
}

/// The first byte that is no space and no byte order mark.
fn first_visible(bytes: &[u8]) -> Option<u8> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.iter().copied().find(|byte| !byte.is_ascii_whitespace())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_found_by_name_and_by_contents() {
        let detect = |name: &str, bytes: &[u8]| detect_format(Path::new(name), bytes).ok();
        assert_eq!(detect("a.OBJ", b""), Some(Format::Obj), "the name, in any case");
        assert_eq!(detect("a.gltf", b"glTF\x02"), Some(Format::Glb), "a GLB by another name");
        assert_eq!(detect("a.glb", b"\xef\xbb\xbf {"), Some(Format::Gltf), "and the other way round");
        assert_eq!(detect("", b"# x\nv 1 2 3\n"), Some(Format::Obj), "a stream of OBJ");
        assert_eq!(detect("", b" {\"asset\""), Some(Format::Gltf), "a stream of JSON");
        assert_eq!(detect("a.txt", b"hello"), None, "text");
        assert_eq!(detect("a.stl", b"v 1 2 3"), None, "later");
    }
}
