//! Writes scenes as GLB: for other programs, and as trigon's native file.
//!
//! `draft` (lists of objects, and the bytes of the buffer) is filled by `scene`, part by part:
//! `nodes`, `meshes` with `geometry`, `materials` with `textures`, `movement`. If the scene came
//! from a glTF, the draft starts as that file, and each part changes only the differences,
//! as text (`raw`), so unchanged parts are written as they were read. `freed` removes what
//! rewritten meshes leave behind.

mod draft;
mod freed;
mod geometry;
mod materials;
mod meshes;
mod movement;
mod nodes;
mod raw;
mod scene;
mod textures;

use std::path::Path;

use trigon_scene::Scene;

pub(crate) use draft::GlbFile;
pub(crate) use raw::RetainedFile;
pub(crate) use scene::{Input, write_scene};
pub(crate) use textures::mime_type;

use crate::export::ExportOptions;
use crate::write::{WriteError, write_atomically};

/// The scene as one self-contained GLB, for other programs: nodes, meshes as triangles (loose edges
/// as lines, loose points as points), materials with their textures, lights, cameras, skins, morph
/// targets and animations.
///
/// glTF has no Lambert and no Blinn-Phong: the nearest equivalent is written, with the exact model
/// in `extras`. It has no ambient light and no off-centre cameras. Transforms keep all digits of
/// their f64; most programs round them to f32.
///
/// ```
/// use trigon_io::{ExportOptions, LoadOptions, encode_glb, load_from_slice};
/// use trigon_scene::showcase;
///
/// let scene = showcase();
/// let glb = encode_glb(&scene, &ExportOptions::default())?;
/// let again = load_from_slice("showcase.glb", &glb, &LoadOptions::default())?;
/// assert_eq!(again.scene.nodes().len(), scene.nodes().len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The file would have 4 GiB or more, or a node lies too far away for its numbers.
pub fn encode_glb(scene: &Scene, options: &ExportOptions<'_>) -> Result<Vec<u8>, WriteError> {
    Ok(write_scene(&export(scene, options)?)?.file.to_bytes())
}

/// Writes a file with the contents of [`encode_glb`] atomically.
///
/// # Errors
/// That of [`encode_glb`], or the file cannot be written.
pub fn write_glb(
    path: impl AsRef<Path>,
    scene: &Scene,
    options: &ExportOptions<'_>,
) -> Result<(), WriteError> {
    let written = write_scene(&export(scene, options)?)?;
    write_atomically(path.as_ref(), |file| written.file.write_to(file))
}

fn export<'a>(scene: &'a Scene, options: &'a ExportOptions<'a>) -> Result<Input<'a>, WriteError> {
    if let Some((_, node)) = scene.nodes().iter().find(|(_, node)| !node.transform.fits_f32()) {
        return Err(WriteError::Overflow { node: node.name.clone() });
    }
    Ok(Input {
        scene,
        edit_data: None,
        retained: None,
        images: options.images,
        nodes: options.nodes.as_deref(),
        root: options.root(scene),
    })
}
