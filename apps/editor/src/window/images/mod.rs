//! Images of the scene: what is rendered, and files that are written. `image_requests` works them.
//!
//! | file | what it does |
//! |---|---|
//! | `mod` | what is under way and what is finished |
//! | `choices` | size, quality and viewpoint of an image |
//! | `rendering` | draws on a thread of its own |
//! | `file` | writes on a thread of its own, in the format of the file's ending |

mod choices;
mod file;
mod rendering;

use std::path::PathBuf;
use std::sync::Arc;

use trigon_window::egui::TextureHandle;

pub(crate) use choices::{LARGEST, RenderChoices, RenderFrom, SIZES, has_lamps};
pub(crate) use file::{IMAGE_FORMATS, Writing, check_ending, show_formats, with_ending};
pub(crate) use rendering::{RenderOrder, Rendered, RenderedImage, Rendering};

/// The window of the rendered image, and the files that are written.
#[derive(Default)]
pub(crate) struct Images {
    /// Whether the window is shown.
    pub(crate) is_open: bool,
    pub(crate) choices: RenderChoices,
    /// The image that is rendered now.
    pub(crate) rendering: Option<Rendering>,
    /// The last image.
    pub(crate) rendered: Option<Arc<RenderedImage>>,
    /// The same on the screen.
    pub(crate) texture: Option<TextureHandle>,
    /// Why there is no image.
    pub(crate) note: String,
    /// Where the image that the view was asked for is written.
    pub(crate) screenshot: Option<PathBuf>,
    pub(crate) writing: Vec<Writing>,
}

impl Images {
    /// Begins an image; the one under way is abandoned.
    pub(crate) fn begin(&mut self, rendering: Rendering) {
        (self.is_open, self.rendering) = (true, Some(rendering));
        self.note.clear();
    }

    /// Abandons what is rendered, or else closes the window. Returns whether there was anything to leave.
    pub(crate) fn leave(&mut self) -> bool {
        if self.rendering.take().is_some() {
            self.note = CANCELLED.into();
            return true;
        }
        std::mem::take(&mut self.is_open)
    }

    /// Another document is open: the window is closed, and what was rendered of the one before is gone.
    pub(crate) fn forget(&mut self) {
        (self.is_open, self.rendering, self.rendered, self.texture) = (false, None, None, None);
        self.note.clear();
    }

    /// Rendering has ended.
    pub(crate) fn rendered(&mut self, outcome: Rendered) {
        self.rendering = None;
        match outcome {
            Ok(image) => (self.rendered, self.texture) = (Some(Arc::new(image)), None),
            Err(error) => self.note = error,
        }
    }

    /// What is being written, for people.
    pub(crate) fn under_way(&self) -> Option<String> {
        self.writing.first().map(|writing| format!("Writing {}", writing.path.display()))
    }

    /// Waits for what is rendered.
    #[cfg(test)]
    pub(crate) fn finish(&mut self) {
        let outcome = self.rendering.as_ref().expect("it was begun").wait();
        self.rendered(outcome);
    }

    /// Waits for what is written.
    #[cfg(test)]
    pub(crate) fn finish_writing(&mut self) -> Result<(), String> {
        self.writing.pop().expect("it was begun").wait()
    }
}

const CANCELLED: &str = "Rendering was cancelled.";
