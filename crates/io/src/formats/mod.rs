//! The model formats, one row for each: how it is read and written, and how it is recognized, by its name, or
//! by its first bytes if the name has no known extension.

pub(crate) mod gltf;
mod obj;
mod off;
mod ply;
mod stl;
mod three_mf;

use std::borrow::Cow;
use std::path::Path;

use trigon_camera::UpAxis;
use trigon_scene::Scene;

use super::error::LoadError;
use super::export::{
    Export, ExportOptions, ExportedFile, Gathered, HeldPoints, Holds, add_losses, losses_of_whole,
};
use super::format::{Format, Reader, Writer};
use super::import::Import;
use super::write::WriteError;

/// Everything that loader and exporter know about a format.
pub(crate) struct FormatRow {
    pub(crate) reader: Reader,
    /// Whether the first bytes of a file without a known extension match this format.
    sniff: fn(&[u8]) -> bool,
    pub(crate) import: fn(&mut Import<'_>, Cow<'_, [u8]>) -> Result<(), LoadError>,
    pub(crate) writing: Writing,
}

/// How a format is written.
pub(crate) enum Writing {
    /// Not written.
    Unwritten,
    /// As a whole.
    Scene(fn(&Scene, &ExportOptions<'_>) -> Result<Vec<u8>, WriteError>),
    /// Mesh by mesh, in a named file and others beside it.
    Objects(Holds, fn(&str, &mut Gathered<'_>, &ExportOptions<'_>) -> Result<Vec<ExportedFile>, WriteError>),
}

const GLTF: &str = "node tree, materials and all their textures, cameras, lights, skins, morph targets, animations, instances, meshopt and Draco compression; no KTX2";

/// The contents of a format that stores everything in a mesh.
const ALL: Holds = Holds {
    materials: true,
    normals: true,
    uvs: true,
    colors: true,
    edges: true,
    points: HeldPoints::All,
    polygons: true,
    objects: true,
};

/// The contents of a format with triangles only.
const FACES: Holds = Holds {
    materials: false,
    normals: false,
    uvs: false,
    colors: false,
    edges: false,
    points: HeldPoints::None,
    polygons: false,
    objects: false,
};

/// The formats. The first bytes of a file never match two of them.
static ROWS: &[FormatRow] = &[
    FormatRow {
        reader: Reader {
            format: Format::Obj,
            name: "Wavefront OBJ with MTL",
            extensions: &["obj"],
            up: UpAxis::Y,
            reads: "polygons, edges, points, groups, Phong and physically-based materials with their textures, vertex colours",
        },
        sniff: is_obj,
        import: obj::import_obj,
        writing: Writing::Objects(ALL, obj::write_obj),
    },
    FormatRow {
        reader: Reader {
            format: Format::Gltf,
            name: "glTF 2.0",
            extensions: &["gltf"],
            up: UpAxis::Y,
            reads: GLTF,
        },
        sniff: |bytes| first_visible(bytes) == Some(b'{'),
        import: |import, bytes| gltf::import_gltf(import, &bytes),
        writing: Writing::Unwritten,
    },
    FormatRow {
        reader: Reader {
            format: Format::Glb,
            name: "glTF 2.0 binary",
            extensions: &["glb", "vrm"],
            up: UpAxis::Y,
            reads: GLTF,
        },
        sniff: |bytes| bytes.starts_with(b"glTF"),
        import: gltf::import_glb,
        writing: Writing::Scene(gltf::encode_glb),
    },
    FormatRow {
        reader: Reader {
            format: Format::Ply,
            name: "Stanford PLY",
            extensions: &["ply"],
            up: UpAxis::Y,
            reads: "text and binary of both byte orders: polygons, strips, edges, points, normals, colours, texture coordinates, textures of TextureFile comments",
        },
        sniff: ply::is_ply,
        import: ply::import_ply,
        writing: Writing::Objects(
            Holds { materials: false, points: HeldPoints::Clouds, objects: false, ..ALL },
            ply::write_ply,
        ),
    },
    FormatRow {
        reader: Reader {
            format: Format::Stl,
            name: "STL",
            extensions: &["stl"],
            // Parts lie on the bed of a printer or a milling machine, whose z points up.
            up: UpAxis::Z,
            reads: "text and binary, several solids, colours of VisCAM, Magics and MeshLab",
        },
        sniff: stl::is_stl,
        import: stl::import_stl,
        writing: Writing::Objects(FACES, stl::write_stl),
    },
    FormatRow {
        reader: Reader {
            format: Format::Off,
            name: "Geomview OFF",
            extensions: &["off"],
            up: UpAxis::Y,
            reads: "text: polygons, edges, points, normals, colours, texture coordinates",
        },
        sniff: off::is_off,
        import: off::import_off,
        writing: Writing::Objects(
            Holds { colors: true, edges: true, points: HeldPoints::Clouds, polygons: true, ..FACES },
            off::write_off,
        ),
    },
    FormatRow {
        reader: Reader {
            format: Format::ThreeMf,
            name: "3MF",
            extensions: &["3mf"],
            // As in the build volume of its specification.
            up: UpAxis::Z,
            reads: "objects, components and items of the build in their units; base materials, colour groups; models in several parts",
        },
        sniff: three_mf::is_three_mf,
        import: three_mf::import_three_mf,
        writing: Writing::Objects(
            Holds { materials: true, colors: true, objects: true, ..FACES },
            three_mf::write_three_mf,
        ),
    },
];

/// Every model format that can be read.
#[must_use]
pub fn readers() -> impl ExactSizeIterator<Item = &'static Reader> {
    ROWS.iter().map(|row| &row.reader)
}

/// Every model format that can be written.
pub fn writers() -> impl Iterator<Item = Writer> {
    let is_written = |row: &&FormatRow| !matches!(row.writing, Writing::Unwritten);
    ROWS.iter().filter(is_written).map(|FormatRow { reader, .. }| Writer {
        format: reader.format,
        name: reader.name,
        extensions: reader.extensions,
    })
}

impl Format {
    /// The format with a file extension, in any case.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        let extension = extension.to_lowercase();
        readers().find(|reader| reader.extensions.contains(&extension.as_str())).map(|reader| reader.format)
    }

    /// The axis that points up in files of the format, unless somebody knows better
    /// ([`LoadOptions::up`](crate::LoadOptions::up)): +Z in STL and 3MF, +Y in all others.
    #[must_use]
    pub fn up(self) -> UpAxis {
        self.row().reader.up
    }

    pub(crate) fn row(self) -> &'static FormatRow {
        ROWS.iter().find(|row| row.reader.format == self).expect("every format has a row")
    }
}

/// Formats that people will try: these are named instead of misread.
const UNSUPPORTED: &[&str] =
    &["fbx", "dae", "3ds", "blend", "usd", "usda", "usdc", "usdz", "x3d", "wrl", "step", "stp", "iges"];

/// The format of a file, or why it is not supported. The magic of a GLB has priority over the name;
/// then the name decides; then the contents.
pub(crate) fn detect_format(path: &Path, bytes: &[u8]) -> Result<Format, String> {
    let extension =
        path.extension().and_then(|extension| extension.to_str()).unwrap_or_default().to_lowercase();
    if let Some(format) = Format::from_extension(&extension) {
        // Many GLB files are named .gltf and vice versa. What the editor recovers is a GLB, whatever the name of the
        // model; the header of a binary STL may begin with the same four letters, but not with the version.
        return Ok(match (format, bytes.starts_with(b"glTF"), first_visible(bytes)) {
            (Format::Gltf, true, _) => Format::Glb,
            (_, true, _) if bytes[4..].starts_with(&2_u32.to_le_bytes()) => Format::Glb,
            (Format::Glb, false, Some(b'{')) => Format::Gltf,
            (format, _, _) => format,
        });
    }
    if UNSUPPORTED.contains(&extension.as_str()) {
        return Err(format!(".{extension} files are not supported yet"));
    }
    let found = ROWS.iter().find(|row| (row.sniff)(bytes)).map(|row| row.reader.format);
    found.ok_or_else(|| "its format is not recognized".to_owned())
}

/// For messages: `.obj, .glb, …`.
pub(crate) fn endings() -> String {
    let endings: Vec<String> = writers().map(|writer| format!(".{}", writer.extensions[0])).collect();
    endings.join(", ")
}

/// The formats, for a remedy: "supported are …".
pub(crate) fn supported() -> String {
    let endings: Vec<String> = readers()
        .flat_map(|reader| reader.extensions)
        .filter(|&&e| e != "vrm")
        .map(|e| format!(".{e}"))
        .collect();
    format!("supported are {}", endings.join(", "))
}

/// Whether one of the first lines is a vertex, as every OBJ has one.
fn is_obj(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1 << 16)];
    start.split(|&byte| byte == b'\n' || byte == b'\r').take(1000).any(looks_like_obj)
}

/// Whether a line is `v` and three numbers.
fn looks_like_obj(line: &[u8]) -> bool {
    let line = String::from_utf8_lossy(line);
    let mut words = line.trim_start_matches('\u{feff}').split_ascii_whitespace();
    words.next() == Some("v") && words.take(3).filter(|word| word.parse::<f64>().is_ok()).count() == 3
}

/// The first byte that is not a space or part of a byte order mark.
fn first_visible(bytes: &[u8]) -> Option<u8> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.iter().copied().find(|byte| !byte.is_ascii_whitespace())
}

/// Creates the files of a scene in a format. `name` is that of the model's file, such as
/// `chair.obj`: the names of its other files begin with `chair`.
///
/// Positions are in world space, as f32 like those of meshes; if a model lies so far from the origin that f32
/// is not enough, text and PLY have all digits of f64. Positions that are written and read again have the
/// same bits.
///
/// ```
/// use trigon_io::{ExportOptions, Format, LoadOptions, export, load_from_slice};
/// use trigon_mesh::primitives;
/// use trigon_scene::{Material, Scene};
///
/// let mut scene = Scene::new();
/// scene.add_object("cube", primitives::cube(2.0), Material::default());
/// let written = export(&scene, "cube.off", Format::Off, &ExportOptions::default())?;
/// assert_eq!(written.what_would_be_lost()[0].to_string(), "materials and their textures");
///
/// let again = load_from_slice("cube.off", &written.files[0].bytes, &LoadOptions::default())?;
/// let (_, cube) = again.scene.meshes().iter().next().expect("it was written");
/// assert_eq!((cube.mesh().vertex_count(), cube.mesh().face_count()), (8, 6), "polygons stay polygons");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The format is not written, the file would be too large for it, or an object lies too far away for its numbers.
pub fn export(
    scene: &Scene,
    name: &str,
    format: Format,
    options: &ExportOptions<'_>,
) -> Result<Export, WriteError> {
    let options = &options.for_format(format);
    match &format.row().writing {
        Writing::Unwritten => Err(WriteError::Unwritten { name: name.to_owned(), writers: endings() }),
        Writing::Scene(write) => {
            let files = vec![ExportedFile { name: name.to_owned(), bytes: write(scene, options)? }];
            Ok(Export { files, losses: losses_of_whole(scene, options) })
        }
        Writing::Objects(holds, write) => {
            let mut gathered = Gathered::new(scene, options)?;
            add_losses(&mut gathered, holds);
            let files = write(name, &mut gathered, options)?;
            Ok(Export { files, losses: gathered.losses })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_found_by_name_and_by_contents() {
        let detect = |name: &str, bytes: &[u8]| detect_format(Path::new(name), bytes).ok();
        assert_eq!(detect("a.OBJ", b""), Some(Format::Obj), "the name, in any case");
        assert_eq!(detect("a.gltf", b"glTF\x02"), Some(Format::Glb), "a GLB by another name");
        assert_eq!(
            detect("a.stl", b"glTF\x02\0\0\0"),
            Some(Format::Glb),
            "what the editor recovers of an STL"
        );
        assert_eq!(detect("a.stl", b"glTF to STL"), Some(Format::Stl), "a header");
        assert_eq!(detect("a.glb", b"\xef\xbb\xbf {"), Some(Format::Gltf), "and the other way round");
        assert_eq!(detect("", b"# x\nv 1 2 3\n"), Some(Format::Obj), "a stream of OBJ");
        assert_eq!(detect("", b" {\"asset\""), Some(Format::Gltf), "a stream of JSON");
        assert_eq!(detect("a.txt", b"hello"), None, "text");
        assert_eq!(detect("a.stl", b"v 1 2 3"), Some(Format::Stl), "the name");
        assert_eq!(detect("", b"ply\r\nformat ascii 1.0"), Some(Format::Ply), "a stream of PLY");
        assert_eq!(detect("", b" solid x\n facet normal 0 0 1"), Some(Format::Stl), "a stream of STL");
        assert_eq!(
            detect("", &[[0; 80].as_slice(), &[1, 0, 0, 0], &[0; 50]].concat()),
            Some(Format::Stl),
            "binary"
        );
        assert_eq!(detect("", b"# x\nCOFF 8 6 0"), Some(Format::Off), "a stream of OFF");
        assert_eq!(detect("a.txt", b"solid advice"), None, "text");
    }
}
