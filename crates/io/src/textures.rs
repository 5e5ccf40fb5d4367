//! Converts images of a model to textures of the scene: decoded in parallel, and only those that a
//! material uses.
//!
//! Images whose files are missing or cannot be read never get here: the readers report them
//! (`formats/gltf/images.rs`, `formats/obj/textures.rs`), and the material has no texture.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use trigon_raster::Texture;
use trigon_scene::TextureId;

use crate::error::LoadError;
use crate::import::Import;
use crate::layers::{HeightMap, Role, merge};
use crate::limits::Limits;
use crate::options::LoadStage;
use crate::rgba_image::{RgbaImage, decode_image, image_size, placeholder};
use crate::texture_request::{ImageBytes, Purpose, Request};

/// Decodes images and adds them to the scene, in order. A broken one becomes a warning, and a
/// checkerboard if it is the colour of a surface.
pub(crate) fn add_textures(
    import: &mut Import<'_>,
    requests: &[Request],
) -> Result<Vec<Option<TextureId>>, LoadError> {
    let done = AtomicUsize::new(0);
    let (path, options) = (import.path, import.options);
    let fits = within_budget(requests, &options.limits);
    let make = |(request, fits): (&Request, Result<(), Fault>)| {
        options.report(
            path,
            LoadStage::Textures,
            done.fetch_add(1, Ordering::Relaxed) as f32 / requests.len() as f32,
        )?;
        let image = fits.and_then(|()| decode(request, &options.limits));
        Ok(image.and_then(|image| to_texture(image, request.purpose).map_err(broken)))
    };
    let decoded: Vec<Result<Texture, Fault>> =
        requests.par_iter().zip(fits).map(make).collect::<Result<_, LoadError>>()?;
    let mut ids = Vec::with_capacity(requests.len());
    let mut stand_in = None;
    for (request, result) in requests.iter().zip(decoded) {
        let (why, remedy) = match result {
            Ok(texture) => {
                ids.push(Some(import.scene.add_texture(request.name.clone(), texture)));
                continue;
            }
            Err(fault) => fault,
        };
        let must_show = request.purpose == Purpose::BaseColor;
        let instead = if must_show { "shown as a checkerboard" } else { "left out" };
        let what = format!("image \"{}\" is {instead}: {why}", request.name);
        import.warnings.push_about(&request.file, request.location.clone(), what, remedy);
        ids.push(must_show.then(|| {
            *stand_in.get_or_insert_with(|| {
                let texture = to_texture(placeholder(), Purpose::BaseColor);
                let texture = texture.expect("the placeholder is a small image");
                import.scene.add_texture("placeholder", texture)
            })
        }));
    }
    Ok(ids)
}

fn decode(request: &Request, limits: &Limits) -> Result<RgbaImage, Fault> {
    let layer = |(role, bytes): &(Role, ImageBytes)| Ok((*role, decode_image(bytes.get(), limits)?));
    let layers = request.layers.iter().map(layer).collect::<Result<_, String>>().map_err(broken)?;
    merge(layers).map_err(|HeightMap| {
        let why = "it is a height map, which is not drawn; only normal maps are";
        (why.to_owned(), "bake it into a normal map, and name that with norm")
    })
}

/// Why an image is not shown, and a remedy.
type Fault = (String, &'static str);

fn broken(why: String) -> Fault {
    (why, "save it as PNG, JPEG or WebP")
}

/// Which images are decoded, based on the sizes in their headers: in order, until the total would
/// be too many pixels.
fn within_budget(requests: &[Request], limits: &Limits) -> Vec<Result<(), Fault>> {
    let mut left = limits.total_pixels;
    let mut admit = |request: &Request| {
        for (_, bytes) in &request.layers {
            let (width, height) = image_size(bytes.get(), limits).map_err(broken)?;
            let pixels = u64::from(width) * u64::from(height);
            left = left.checked_sub(pixels).ok_or_else(|| {
                let most = limits.total_pixels;
                let why = format!("with it, the model's images have more than {most} pixels");
                (why, "make the images smaller")
            })?;
        }
        Ok(())
    };
    requests.iter().map(&mut admit).collect()
}

fn to_texture(image: RgbaImage, purpose: Purpose) -> Result<Texture, String> {
    let texels = image.rgba.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2], texel[3]]).collect();
    Texture::new(image.width, image.height, texels, purpose.format()).map_err(|error| error.to_string())
}
