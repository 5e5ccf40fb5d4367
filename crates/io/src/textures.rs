//! Converts images of a model to textures of the scene: found as files beside it under any spelling, and decoded in
//! parallel, only those that a material uses.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use trigon_raster::Texture;
use trigon_scene::TextureId;

use super::error::{LoadError, Location};
use super::folder::{Found, Lookup};
use super::import::Import;
use super::options::{Limits, LoadStage};
use super::refusal::Refusal;
use super::rgba_image::{RgbaImage, decode_image, image_size, placeholder};
use super::texture_request::{HeightMap, Role, merge};
use super::texture_request::{ImageBytes, Purpose, Request};

/// Decodes images and adds them to the scene, in order. A broken one becomes a warning, and a
/// checkerboard if it is the colour of a surface.
pub(crate) fn add_textures(
    import: &mut Import<'_>,
    requests: &[Request],
) -> Result<Vec<Option<TextureId>>, LoadError> {
    let done = AtomicUsize::new(0);
    let (path, options) = (import.path, import.options);
    let fits = within_budget(requests, &options.limits);
    let make = |(request, fits): (&Request, Result<(), ImageFault>)| {
        options.report(
            path,
            LoadStage::Textures,
            done.fetch_add(1, Ordering::Relaxed) as f32 / requests.len() as f32,
        )?;
        let image = fits.and_then(|()| decode(request, &options.limits));
        Ok(image.and_then(|image| to_texture(image, request.purpose).map_err(broken)))
    };
    let decoded: Vec<Result<Texture, ImageFault>> =
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

fn decode(request: &Request, limits: &Limits) -> Result<RgbaImage, ImageFault> {
    let layer = |(role, bytes): &(Role, ImageBytes)| Ok((*role, decode_image(bytes.get(), limits)?));
    let layers = request.layers.iter().map(layer).collect::<Result<_, String>>().map_err(broken)?;
    merge(layers).map_err(|HeightMap| {
        let why = "it is a height map, which is not drawn; only normal maps are";
        (why.to_owned(), "bake it into a normal map, and name that with norm")
    })
}

/// Why an image is not shown, and a remedy.
type ImageFault = (String, &'static str);

fn broken(why: String) -> ImageFault {
    (why, "save it as PNG, JPEG or WebP")
}

/// Which images are decoded, based on the sizes in their headers: in order, until the total would
/// be too many pixels.
fn within_budget(requests: &[Request], limits: &Limits) -> Vec<Result<(), ImageFault>> {
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

/// Where a file names another.
#[derive(Clone, Copy)]
pub(crate) struct Mention<'a> {
    /// The file that does.
    pub(crate) file: &'a Path,
    pub(crate) line: u64,
    /// The name.
    pub(crate) name: &'a str,
}

/// Warns if a file was found under a different spelling of its name. `what` is the file and its name.
pub(crate) fn note_respelled(import: &mut Import<'_>, what: &str, found: &Found, from: Mention<'_>) {
    if found.respelled {
        let what = format!("{what} was not found; \"{}\" is used instead", found.path.display());
        import.warnings.push_about(from.file, Location::Line(from.line), what, "correct the name there");
    }
}

/// Reads an image that a file names: beside that file, or else beside the model.
pub(crate) fn find_image(import: &mut Import<'_>, from: Mention<'_>) -> Option<Found> {
    let (here, name) = (Path::new(""), from.name);
    let beside = import.folder.relative_folder(from.file);
    let mut result = import.folder.read(&beside, name, Lookup::Forgiving);
    if matches!(result, Err(Refusal::Missing)) && !beside.as_os_str().is_empty() {
        result = import.folder.read(here, name, Lookup::Forgiving);
    }
    match result {
        Ok(found) => {
            note_respelled(import, &format!("texture \"{name}\""), &found, from);
            Some(found)
        }
        Err(refusal) => {
            let what = format!("texture \"{name}\" is not drawn: {refusal}");
            let mut tried = import.folder.tried(&beside, name);
            if !beside.as_os_str().is_empty() {
                tried.extend(import.folder.tried(here, name));
            }
            let location = Location::Line(from.line);
            import.warnings.push_unusable(from.file, location, what, refusal.remedy(), tried);
            None
        }
    }
}
