//! Another model beside the one that is shown, seen by the same camera: side by side, in turn, or where they differ.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use trigon_camera::{Camera, UpAxis};
use trigon_scene::{Cancel, Frame, RenderSettings, Renderer, Scene};
use trigon_window::{Drawer, Stage};

use super::background::Loading;
use crate::args::Request;
use crate::compare;
use crate::failure::Failure;
use crate::source::Source;

/// What of both is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pair {
    Beside,
    First,
    Second,
    Heat,
}

/// The other model.
pub(super) struct Comparing {
    source: Source,
    loading: Option<Loading>,
    other: Option<Arc<Scene>>,
    pair: Pair,
    drawer: Option<Arc<PairDrawer>>,
}

impl Comparing {
    pub(super) fn new(other: PathBuf) -> Self {
        let source = Source::Files(vec![other]);
        Self { source, loading: None, other: None, pair: Pair::Beside, drawer: None }
    }

    /// Begins to load the other model.
    pub(super) fn load(&mut self, stage: &Stage, request: &Request) {
        self.loading = Some(Loading::start(self.source.clone(), request.clone(), stage.waker()));
    }

    /// Takes over the other model once it is loaded, turned to the up axis of the model beside it, if there is one.
    /// Returns whether that was now.
    pub(super) fn woken(&mut self, stage: &mut Stage, up: Option<UpAxis>) -> Result<bool, Failure> {
        let Some(outcome) = self.loading.as_ref().and_then(Loading::outcome) else { return Ok(false) };
        self.loading = None;
        let (mut model, _) = outcome?;
        up.map(|up| model.scene.turn_to(up));
        self.other = Some(Arc::new(model.scene));
        self.show_pair(stage, Pair::Beside);
        Ok(true)
    }

    /// The other model, once it is loaded.
    pub(super) fn other(&self) -> Option<&Scene> {
        self.other.as_deref()
    }

    /// Turns the other model so that this axis is up in it, too.
    pub(super) fn stand_beside(&mut self, stage: &mut Stage, up: UpAxis) {
        if let Some(other) = self.other.as_mut().filter(|other| other.up != up) {
            Arc::make_mut(other).turn_to(up);
            self.show_pair(stage, self.pair);
        }
    }

    /// Another axis is up in both models; neither is turned.
    pub(super) fn set_up(&mut self, stage: &mut Stage, up: UpAxis) {
        if let Some(other) = &mut self.other {
            Arc::make_mut(other).up = up;
            self.show_pair(stage, self.pair);
        }
    }

    /// One model, and then the other in its place.
    pub(super) fn blink(&mut self, stage: &mut Stage) {
        let pair = if self.pair == Pair::First { Pair::Second } else { Pair::First };
        self.show_pair(stage, pair);
    }

    /// Where they differ, or both side by side again.
    pub(super) fn toggle_heat(&mut self, stage: &mut Stage) {
        let pair = if self.pair == Pair::Heat { Pair::Beside } else { Pair::Heat };
        self.show_pair(stage, pair);
    }

    fn show_pair(&mut self, stage: &mut Stage, pair: Pair) {
        let Some(other) = &self.other else { return };
        self.pair = pair;
        let renderers = Mutex::new([(); 2].map(|()| Renderer::builder().build()));
        let drawer = PairDrawer { other: Arc::clone(other), pair, renderers, said: Mutex::default() };
        self.drawer = Some(Arc::new(drawer));
        stage.drawer = self.drawer.clone().map(|drawer| drawer as Arc<dyn Drawer>);
    }

    /// What is shown, in words.
    pub(super) fn text(&self, first: &str) -> String {
        let other = self.source.title();
        match self.pair {
            _ if self.other.is_none() => format!("loading {other}"),
            Pair::Beside => format!("{first} | {other}  (B: in turn, Shift+B: where they differ)"),
            Pair::First => format!("{first}  (B: {other})"),
            Pair::Second => format!("{other}  (B: {first})"),
            Pair::Heat => self.drawer.as_ref().map(|drawer| drawer.said()).unwrap_or_default(),
        }
    }
}

/// Draws both models.
struct PairDrawer {
    other: Arc<Scene>,
    pair: Pair,
    renderers: Mutex<[Renderer; 2]>,
    /// How far the last two images were apart.
    said: Mutex<String>,
}

impl PairDrawer {
    fn said(&self) -> String {
        self.said.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Drawer for PairDrawer {
    fn draw(
        &self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        cancel: &Cancel,
    ) -> Result<Frame, String> {
        let mut renderers = self.renderers.lock().unwrap_or_else(PoisonError::into_inner);
        let [first, second] = &mut *renderers;
        let camera = camera.with_wider_clip_planes(&self.other.bounds());
        let draw = |renderer: &mut Renderer, scene: &Scene, settings: RenderSettings| {
            *renderer.settings_mut() = settings;
            let mut frame = Frame::default();
            let drawn = renderer.render_cancellable(scene, &camera, cancel, &mut frame);
            drawn.map(|()| frame).map_err(|error| error.to_string())
        };
        match self.pair {
            Pair::First => draw(first, scene, settings.clone()),
            Pair::Second => draw(second, &self.other, settings.clone()),
            Pair::Beside => {
                // One column for each at least.
                let left = (settings.width / 2).max(1);
                let right = (settings.width - left).max(1);
                let sized = |width| RenderSettings { width, ..settings.clone() };
                let one = draw(first, scene, sized(left))?;
                let other = draw(second, &self.other, sized(right))?;
                Ok(compare::beside(&[&one, &other]))
            }
            Pair::Heat => {
                let one = draw(first, scene, settings.clone())?;
                let other = draw(second, &self.other, settings.clone())?;
                let difference = compare::difference(&one, &other);
                *self.said.lock().unwrap_or_else(PoisonError::into_inner) =
                    format!("how much each channel differs: {}", compare::said(&difference));
                Ok(compare::frame_of(&difference.image))
            }
        }
    }

    fn draws_drafts(&self) -> bool {
        true
    }

    fn drawings(&self) -> u32 {
        match self.pair {
            Pair::First | Pair::Second => 1,
            Pair::Beside | Pair::Heat => 2,
        }
    }

    fn shows_scene(&self) -> bool {
        self.pair == Pair::First
    }
}
