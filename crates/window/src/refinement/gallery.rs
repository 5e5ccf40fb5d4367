//! The pictures that a window has of its scene, and which of them it shows.

use std::sync::Arc;
use std::time::Duration;

use trigon_camera::Camera;
use trigon_scene::Frame;

use super::{Compared, QualityReport};
use crate::pacing::Quality;
use crate::panes::Views;
use crate::shown::{DrawnNodes, Shown};

/// Pictures of one state of the scene: a draft, the one that the settings give, the best
/// so far, and what lies between the last two.
#[derive(Default)]
pub(crate) struct Gallery {
    /// From where all were drawn.
    views: Option<Views>,
    /// What all are of.
    nodes: Arc<DrawnNodes>,
    draft: Option<Arc<Frame>>,
    settings: Option<Arc<Frame>>,
    best: Option<Arc<Frame>>,
    map: Option<Arc<Frame>>,
    report: QualityReport,
}

/// Which picture is to be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// The one that the settings give.
    Settings,
    /// The best there is.
    Best,
    /// How far they are apart.
    Difference,
}

impl Gallery {
    /// A new picture. Those of other states of the scene are given back.
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

    /// The picture of the settings and the best one, which is the reference, are compared.
    pub(crate) fn compared(&mut self, compared: Compared) {
        self.map = Some(Arc::new(compared.map));
        self.report.difference = Some(compared.difference);
    }

    /// What is to be compared.
    pub(crate) fn pair(&self) -> Option<[Arc<Frame>; 2]> {
        Some([Arc::clone(self.settings.as_ref()?), Arc::clone(self.best.as_ref()?)])
    }

    /// What is shown, if that is wanted.
    pub(crate) fn shown(&self, wanted: Wanted) -> Option<&Arc<Frame>> {
        let at_rest = match wanted {
            Wanted::Best => self.best.as_ref(),
            Wanted::Settings => self.settings.as_ref(),
            Wanted::Difference => self.map.as_ref().or(self.settings.as_ref()),
        };
        at_rest.or(self.draft.as_ref())
    }

    /// What tells what is seen where that is shown: the picture itself, or one that it was
    /// made of.
    pub(crate) fn picked(&self, wanted: Wanted) -> Option<Shown> {
        let shown = self.shown(wanted).filter(|frame| frame.object_ids.is_some());
        let frame = Arc::clone(shown.or(self.settings.as_ref())?);
        Some(Shown { frame, views: self.views.clone()?, nodes: Arc::clone(&self.nodes) })
    }

    /// The camera of what is shown.
    pub(crate) fn camera(&self) -> Option<&Camera> {
        self.views.as_ref().map(|views| &views.main)
    }

    /// What was measured of pictures at rest; `None` for drafts.
    pub(crate) fn report(&self) -> Option<QualityReport> {
        self.settings.as_ref().map(|_| self.report)
    }
}
