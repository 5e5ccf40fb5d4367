//! Requests for images: rendering through the camera, screenshots, and saving both.

use std::path::PathBuf;
use std::sync::Arc;

use trigon_document::scene::{Frame, Outputs, RenderSettings};
use trigon_window::Stage;
use trigon_window::scene::camera::Viewport;

use super::dialog::Purpose;
use super::editor::{Editor, Message};
use super::images::{RenderFrom, RenderOrder, Rendering, Writing, check_ending, with_ending};
use super::navigation;
use crate::request::ImageKind;
use crate::uv::layout;

const NO_CAMERA: &str = "The scene has no camera, so there is nothing to render through. \
                         Render what the view shows instead, or put a camera into the scene: Add, Camera.";

const NO_COORDINATES: &str = "nothing with texture coordinates is edited: unwrap it first (U)";

impl Editor {
    /// Renders through the scene's camera; without one the window offers the view instead.
    pub(super) fn render_camera(&mut self, stage: &Stage) {
        self.images.choices.from = RenderFrom::Camera;
        if navigation::camera(&self.document).is_some() {
            return self.render(stage);
        }
        (self.images.is_open, self.images.note) = (true, NO_CAMERA.into());
    }

    /// Renders as chosen.
    pub(super) fn render(&mut self, stage: &Stage) {
        let camera = match self.images.choices.from {
            RenderFrom::View => Some(stage.camera()),
            RenderFrom::Camera => navigation::camera(&self.document).map(|(_, camera)| camera),
        };
        let Some(camera) = camera else { return self.images.note = NO_CAMERA.into() };
        let scene = self.document.scene_to_render();
        let settings = self.images.choices.settings(&scene);
        let order = RenderOrder { scene, camera, settings };
        let waker = stage.waker();
        self.images.begin(Rendering::start(move |cancel| order.draw(cancel), move || waker.wake()));
    }

    /// Asks where to write an image.
    pub(super) fn ask_for_image(&mut self, kind: ImageKind) {
        let purpose = Purpose::Image(kind);
        let suggestion = self.suggestion(&purpose);
        self.dialog.ask(purpose, &suggestion);
    }

    /// Writes an image; what the view shows is drawn first, without what the interface draws over it.
    pub(super) fn save_image(&mut self, stage: &mut Stage, kind: ImageKind, path: PathBuf) {
        let path = with_ending(path);
        if let Err(error) = check_ending(&path) {
            return self.message = Message::Refusal(error);
        }
        match (kind, &self.images.rendered) {
            (ImageKind::Screenshot, _) => {
                stage.request_image(screenshot_settings(stage));
                self.images.screenshot = Some(path);
            }
            (ImageKind::UvLayout, _) => match layout(&self.document) {
                Some(frame) => self.write(stage, Arc::new(frame), path),
                None => self.message = Message::Refusal(NO_COORDINATES.into()),
            },
            (ImageKind::Render, Some(image)) => {
                let frame = Arc::clone(&image.frame);
                self.write(stage, frame, path);
            }
            (ImageKind::Render, None) => {
                self.message = Message::Refusal("there is no rendered image yet: press F12 first".into());
            }
        }
    }

    /// The view's image is there.
    pub(super) fn screenshot_taken(&mut self, stage: &Stage, frame: Frame) {
        if let Some(path) = self.images.screenshot.take() {
            self.write(stage, Arc::new(frame), path);
        }
    }

    fn write(&mut self, stage: &Stage, frame: Arc<Frame>, path: PathBuf) {
        let waker = stage.waker();
        self.message = Message::Info(format!("Writing {}", path.display()));
        self.images.writing.push(Writing::start(frame, path, move || waker.wake()));
    }

    /// Takes over what other threads have rendered and written.
    pub(super) fn collect_images(&mut self) {
        let images = &mut self.images;
        if let Some(outcome) = images.rendering.as_ref().and_then(Rendering::outcome) {
            images.rendered(outcome);
        }
        for writing in std::mem::take(&mut images.writing) {
            match writing.outcome() {
                None => images.writing.push(writing),
                Some(Ok(())) => self.message = Message::Info(format!("Saved {}", writing.path.display())),
                Some(Err(error)) => self.message = Message::Refusal(error),
            }
        }
    }
}

/// What draws the camera's own view again, with all that a file may hold of it.
fn screenshot_settings(stage: &Stage) -> RenderSettings {
    let own = stage.panes().into_iter().find(|pane| pane.side.is_none());
    let Viewport { width, height } = own.map_or(stage.viewport(), |pane| pane.area.size);
    let outputs = Outputs { radiance: true, ..Outputs::default() };
    RenderSettings { width: width.max(1), height: height.max(1), outputs, ..stage.image_settings() }
}
