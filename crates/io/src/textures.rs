//! Pictures of a model to textures of the scene: decoded in parallel, and only
//! those that a material uses.

use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use trigon_raster::{Texture, TextureFormat};
use trigon_scene::TextureId;

use crate::error::{LoadError, Place};
use crate::import::Import;
use crate::options::Stage;
use crate::picture::{Picture, decode_picture, placeholder};

/// A picture to decode, and where its name was found.
pub(crate) struct Request {
    /// For people: the picture's file name, or its name in the model.
    pub(crate) name: String,
    /// The file that is to blame when it is broken.
    pub(crate) file: PathBuf,
    pub(crate) place: Place,
    pub(crate) bytes: Vec<u8>,
}

/// Decodes pictures and adds them to the scene, in order. A broken one becomes
/// a warning and a checkerboard that nobody overlooks.
pub(crate) fn add_textures(
    import: &mut Import<'_>,
    requests: &[Request],
) -> Result<Vec<TextureId>, LoadError> {
    let done = AtomicUsize::new(0);
    let (path, options) = (import.path, import.options);
    let decode = |request: &Request| {
        options.report(
            path,
            Stage::Textures,
            done.fetch_add(1, Ordering::Relaxed) as f32 / requests.len() as f32,
        )?;
        Ok(decode_picture(&request.bytes, &options.limits).and_then(to_texture))
    };
    let decoded: Vec<Result<Texture, String>> =
        requests.par_iter().map(decode).collect::<Result<_, LoadError>>()?;
    let mut ids = Vec::with_capacity(requests.len());
    let mut stand_in = None;
    for (request, result) in requests.iter().zip(decoded) {
        ids.push(match result {
            Ok(texture) => import.scene.add_texture(request.name.clone(), texture),
            Err(why) => {
                let what = format!("picture \"{}\" is shown as a checkerboard: {why}", request.name);
                import.warnings.push_about(
                    &request.file,
                    request.place.clone(),
                    what,
                    "save it as PNG or JPEG",
                );
                *stand_in.get_or_insert_with(|| {
                    let texture = to_texture(placeholder()).expect("the placeholder is a small picture");
                    import.scene.add_texture("placeholder", texture)
                })
            }
        });
    }
    Ok(ids)
}

fn to_texture(picture: Picture) -> Result<Texture, String> {
    let texels = picture.rgba.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2], texel[3]]).collect();
    Texture::new(picture.width, picture.height, texels, TextureFormat::Srgb)
        .map_err(|error| error.to_string())
}
