//! An image that is rendered on a thread of its own, so that the window stays responsive. An abandoned one ends early.

use std::fmt;
use std::sync::Arc;

use trigon_document::scene::camera::Camera;
use trigon_document::scene::math::{Vec4, color};
use trigon_document::scene::{Cancel, Frame, RenderSettings, Renderer, Scene};
use trigon_window::egui::ColorImage;

use crate::window::background::Background;

/// The greatest side of an image on the screen, in pixels.
const SHOWN: usize = 2048;

/// What is to be rendered.
pub(crate) struct RenderOrder {
    pub(crate) scene: Scene,
    pub(crate) camera: Camera,
    pub(crate) settings: RenderSettings,
}

impl RenderOrder {
    /// Draws it; `cancel` also counts the finished tiles.
    pub(crate) fn draw(&self, cancel: &Cancel) -> Rendered {
        let mut frame = Frame::default();
        Renderer::new(self.settings.clone())
            .render_cancellable(&self.scene, &self.camera, cancel, &mut frame)
            .map_err(|error| error.to_string())?;
        Ok(RenderedImage::new(frame))
    }
}

/// A finished image.
#[derive(Clone)]
pub(crate) struct RenderedImage {
    pub(crate) frame: Arc<Frame>,
    /// The same for the screen, with sides of at most 2048 pixels.
    pub(crate) shown: Arc<ColorImage>,
}

impl fmt::Debug for RenderedImage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("RenderedImage").field("frame", &self.frame).finish_non_exhaustive()
    }
}

impl RenderedImage {
    pub(crate) fn new(frame: Frame) -> Self {
        let mut size = [frame.width as usize, frame.height as usize];
        let mut halved: Option<Vec<u8>> = None;
        while size[0].max(size[1]) > SHOWN {
            let (smaller, of) = halve(halved.as_deref().unwrap_or(&frame.color), size);
            (halved, size) = (Some(smaller), of);
        }
        let shown = ColorImage::from_rgba_unmultiplied(size, halved.as_deref().unwrap_or(&frame.color));
        Self { frame: Arc::new(frame), shown: Arc::new(shown) }
    }
}

/// An image of half the width and height, rounded up: each pixel is the mean of up to four in linear light.
fn halve(rgba: &[u8], [width, height]: [usize; 2]) -> (Vec<u8>, [usize; 2]) {
    let (pixels, _) = rgba.as_chunks::<4>();
    let size = [width.div_ceil(2), height.div_ceil(2)];
    let mean = |x: usize, y: usize| {
        let columns = 2 * x..(2 * x + 2).min(width);
        let rows = 2 * y..(2 * y + 2).min(height);
        let count = (columns.len() * rows.len()) as f32;
        let parts = rows.flat_map(|row| columns.clone().map(move |column| row * width + column));
        let sum =
            parts.fold(Vec4::ZERO, |sum, at| sum + color::premultiplied(color::srgba8_to_linear(pixels[at])));
        color::linear_to_srgba8(color::unpremultiplied(sum / count))
    };
    let halved = (0..size[1]).flat_map(|y| (0..size[0]).flat_map(move |x| mean(x, y)));
    (halved.collect(), size)
}

/// What rendering ends with, or why there is no image.
pub(crate) type Rendered = Result<RenderedImage, String>;

/// An image under way. Dropping it cancels it.
#[derive(Debug)]
pub(crate) struct Rendering {
    cancel: Cancel,
    work: Background<RenderedImage>,
}

impl Rendering {
    /// Starts to draw; `wake` is called at the end.
    pub(crate) fn start(
        draw: impl FnOnce(&Cancel) -> Rendered + Send + 'static,
        wake: impl FnOnce() + Send + 'static,
    ) -> Self {
        let cancel = Cancel::for_drawings(1);
        let theirs = cancel.clone();
        let work = Background::start(move || draw(&theirs), wake, NO_RESULT);
        Self { cancel, work }
    }

    /// How much is drawn, 0 to 1.
    pub(crate) fn progress(&self) -> f32 {
        self.cancel.progress()
    }

    /// What it ended with; `None` while it runs.
    pub(crate) fn outcome(&self) -> Option<Rendered> {
        self.work.result()
    }

    /// The same, once it is there.
    #[cfg(test)]
    pub(crate) fn wait(&self) -> Rendered {
        self.work.wait()
    }
}

impl Drop for Rendering {
    fn drop(&mut self) {
        self.cancel.cancel();
    }
}

const NO_RESULT: &str = "rendering ended without an image; try a smaller one, or close other programs";

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use super::*;

    #[test]
    fn an_image_is_shown_no_larger_than_the_screen_needs() {
        // Black and white columns: their mean in linear light is one half, which is 188 in sRGB.
        let (width, height) = (2 * SHOWN as u32 - 1, 2);
        let pixel = |index: u32| if (index % width).is_multiple_of(2) { [0, 0, 0, 255] } else { [255; 4] };
        let color = (0..width * height).flat_map(pixel).collect();
        let image = RenderedImage::new(Frame { width, height, color, ..Frame::default() });
        assert_eq!(image.shown.size, [SHOWN, 1], "half of it");
        assert_eq!(image.shown.pixels[0].to_array(), [188, 188, 188, 255], "a mean of light");
        assert_eq!(
            image.shown.pixels[SHOWN - 1].to_array(),
            [0, 0, 0, 255],
            "the last column has no partner"
        );
        assert_eq!(image.frame.width, width, "the file gets all of it");
    }

    #[test]
    fn what_is_dropped_is_cancelled() {
        let (open, gate) = channel::<()>();
        let (report, reported) = channel();
        let rendering = Rendering::start(
            move |cancel| {
                gate.recv().expect("the test opens the gate");
                report.send(cancel.is_cancelled()).expect("the test waits");
                Err("nobody sees it".into())
            },
            || {},
        );
        assert!(rendering.outcome().is_none(), "it waits at the gate");
        drop(rendering);
        open.send(()).expect("it waits");
        assert_eq!(reported.recv(), Ok(true), "the drawing learns of it");
    }
}
