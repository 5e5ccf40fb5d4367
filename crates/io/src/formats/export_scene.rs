//! Export of a scene: the format's row says what writes it.

use trigon_scene::Scene;

use super::{Writing, endings};
use crate::export::{Export, ExportOptions, ExportedFile, Gathered, add_losses, losses_of_whole};
use crate::format::Format;
use crate::write::WriteError;

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
