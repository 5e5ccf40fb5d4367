//! Files of images: their formats, and writing them on a thread of their own.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use trigon_document::scene::Frame;
use trigon_io::{Pixels, write_exr, write_jpeg, write_png, write_webp};
use trigon_window::egui::Ui;

use crate::window::background::Background;

/// The formats that are written, with the endings of their files.
pub(crate) const IMAGE_FORMATS: [(&str, &[&str]); 4] =
    [("PNG", &["png"]), ("JPEG", &["jpg", "jpeg"]), ("WebP", &["webp"]), ("OpenEXR", &["exr"])];

/// The ending of a file's name in lower case.
fn ending(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_lowercase()
}

/// A name without an ending gets that of PNG.
pub(crate) fn with_ending(path: PathBuf) -> PathBuf {
    if path.extension().is_none() { path.with_extension("png") } else { path }
}

/// Whether a format has the ending of this name; otherwise what can be done.
pub(crate) fn check_ending(path: &Path) -> Result<(), String> {
    let ending = ending(path);
    if IMAGE_FORMATS.iter().any(|(_, endings)| endings.contains(&ending.as_str())) {
        return Ok(());
    }
    Err(format!(
        "{}: no image is written with this ending; name a file that ends in .png, .jpg, .webp or .exr",
        path.display()
    ))
}

/// The formats, of which one gives a file's name its ending.
pub(crate) fn show_formats(ui: &mut Ui, name: &mut String) {
    let current = ending(&with_ending(PathBuf::from(&*name)));
    ui.horizontal_wrapped(|ui| {
        ui.label("Format");
        for (format, endings) in IMAGE_FORMATS {
            let is_current = endings.contains(&current.as_str());
            if ui.selectable_label(is_current, format).clicked() {
                *name = Path::new(&*name).with_extension(endings[0]).to_string_lossy().into_owned();
            }
        }
    });
    let held = match current.as_str() {
        "jpg" | "jpeg" => "Small, with slight losses; what is transparent becomes white.",
        "webp" => "Smaller than PNG, without losses.",
        "exr" => "The light itself in floating point, for grading: brighter than white stays so.",
        _ => "Every program opens it, without losses.",
    };
    ui.weak(held);
}

fn write(path: &Path, frame: &Frame) -> Result<(), String> {
    check_ending(path)?;
    let (width, height, color) = (frame.width, frame.height, &frame.color);
    let written = match ending(path).as_str() {
        "exr" => write_exr(path, frame),
        "jpg" | "jpeg" => write_jpeg(path, width, height, color),
        "webp" => write_webp(path, width, height, color),
        _ => write_png(path, width, height, Pixels::Rgba8(color)),
    };
    written.map_err(|error| error.to_string())
}

/// A file that is being written: the old one or the whole new one is there at any time.
#[derive(Debug)]
pub(crate) struct Writing {
    pub(crate) path: PathBuf,
    work: Background<()>,
}

impl Writing {
    /// Starts to write; `wake` is called at the end.
    pub(crate) fn start(frame: Arc<Frame>, path: PathBuf, wake: impl FnOnce() + Send + 'static) -> Self {
        let file = path.clone();
        let work = Background::start(move || write(&file, &frame), wake, NO_RESULT);
        Self { path, work }
    }

    /// What it ended with; `None` while it runs.
    pub(crate) fn outcome(&self) -> Option<Result<(), String>> {
        self.work.result()
    }

    /// The same, once it is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Result<(), String> {
        self.work.wait()
    }
}

const NO_RESULT: &str = "writing the image ended without a result; save it again";
