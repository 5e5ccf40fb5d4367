//! Scenes for other programs, in formats that hold less than a scene does.
//!
//! `gather` puts every visible mesh in its place in the file, `losses` says what the format cannot
//! hold, and the module of the format writes (`obj/write`, `ply/write`, `stl/write`, `off/write`). A GLB
//! holds nearly everything and goes its own way (`gltf/write`).

mod files;
mod gather;
mod losses;
mod number;
mod options;
mod plain_name;
mod vertex_table;

use trigon_scene::Scene;

use crate::format::Format;
use crate::registry::{Writing, endings};
use crate::write::WriteError;

pub use files::{Export, ExportedFile};
pub(crate) use gather::{Gathered, Object};
pub(crate) use losses::{HeldPoints, Holds};
pub(crate) use number::{Precision, number_text, push_number};
pub use options::{Encoding, ExportOptions, FaceExport, UpAxis};
pub(crate) use plain_name::plain_name;
pub(crate) use vertex_table::{Columns, VertexTable};

/// Makes the files of a scene in a format. `name` is that of the model's file, such as `chair.obj`:
/// what is written beside it has names that begin with `chair`.
///
/// Positions are in the world, as f32 like those of meshes; where a model lies so far from the origin
/// that f32 would not do, text and PLY have all digits of f64. What is written and read
/// again has positions with the same bits.
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
/// When the format is not written, or cannot count as much.
pub fn export(
    scene: &Scene,
    name: &str,
    format: Format,
    options: &ExportOptions<'_>,
) -> Result<Export, WriteError> {
    match &format.row().writing {
        Writing::Unwritten => Err(WriteError::Unwritten { name: name.to_owned(), writers: endings() }),
        Writing::Scene(write) => {
            let files = vec![ExportedFile { name: name.to_owned(), bytes: write(scene, options)? }];
            Ok(Export { files, losses: losses::of_whole(scene, options) })
        }
        Writing::Objects(holds, write) => {
            let mut gathered = Gathered::new(scene, options);
            losses::add(&mut gathered, holds);
            let files = write(name, &mut gathered, options)?;
            Ok(Export { files, losses: gathered.losses })
        }
    }
}
