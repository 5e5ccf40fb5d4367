//! The images of a scene that a window has, and which of them it shows.

use std::sync::Arc;
use std::time::Duration;

use trigon_camera::Camera;
use trigon_scene::Frame;

use super::{Compared, QualityReport};
use crate::pacing::Quality;
use crate::panes::Views;
use crate::shown::{DrawnNodes, Shown};

/// Images of one state of the scene: a draft, the one that the settings define, the best so far,
/// and the difference between the last two.
#[derive(Default)]
pub(crate) struct Gallery {
    /// The camera of all images.
    views: Option<Views>,
    /// The state that all images show.
    nodes: Arc<DrawnNodes>,
    draft: Option<Arc<Frame>>,
    settings: Option<Arc<Frame>>,
    best: Option<Arc<Frame>>,
    map: Option<Arc<Frame>>,
    report: QualityReport,
}

/// Which image to show.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// The one that the settings define.
    Settings,
    /// The best one.
    Best,
    /// Their difference.
    Difference,
}

impl Gallery {
    /// Adds an image. Those of other states of the scene are returned.
    pub(crate) fn add(&mut self, quality: Quality, Shown { frame, views, nodes }: Shown, took: Duration) {
        match quality {
            Quality::Draft { .. } => *self = Self { draft: Some(frame), ..Self::default() },
            Quality::Full(0) => {
                let report = QualityReport { settings: took, ..QualityReport::default() };
                let best = Some(Arc::clone(&frame));
                *self = Self { settings: Some(frame), best, report, ..Self::default() };
            }
            Quality::Full(_) => {
                self.best = Some(frame);
                self.report.best = Some(took);
            }
        }
        (self.views, self.nodes) = (Some(views), nodes);
    }

    /// Compares the image of the settings with the best one, which is the reference.
    pub(crate) fn compared(&mut self, compared: Compared) {
        self.map = Some(Arc::new(compared.map));
        self.report.difference = Some(compared.difference);
    }

    /// The images to compare.
    pub(crate) fn pair(&self) -> Option<[Arc<Frame>; 2]> {
        Some([Arc::clone(self.settings.as_ref()?), Arc::clone(self.best.as_ref()?)])
    }

    /// The displayed image, for the requested view.
    pub(crate) fn shown(&self, wanted: Wanted) -> Option<&Arc<Frame>> {
        let at_rest = match wanted {
            Wanted::Best => self.best.as_ref(),
            Wanted::Settings => self.settings.as_ref(),
            Wanted::Difference => self.map.as_ref().or(self.settings.as_ref()),
        };
        at_rest.or(self.draft.as_ref())
    }

    /// The image for picking in the displayed one: itself, or one that it was made from.
    pub(crate) fn picked(&self, wanted: Wanted) -> Option<Shown> {
        let shown = self.shown(wanted).filter(|frame| frame.object_ids.is_some());
        let frame = Arc::clone(shown.or(self.settings.as_ref())?);
        Some(Shown { frame, views: self.views.clone()?, nodes: Arc::clone(&self.nodes) })
    }

    /// The camera of the displayed image.
    pub(crate) fn camera(&self) -> Option<&Camera> {
        self.views.as_ref().map(|views| &views.main)
    }

    /// The times of images at rest; `None` for drafts.
    pub(crate) fn report(&self) -> Option<QualityReport> {
        self.settings.as_ref().map(|_| self.report)
    }
}
