//! The images of a scene that a window has, and which of them it shows.

use std::sync::Arc;
use std::time::Duration;

use trigon_camera::Camera;
use trigon_scene::Frame;

use super::{Compared, QualityReport};
use crate::pacing::Quality;
use crate::panes::Views;
use crate::shown::{DrawnNodes, Shown};

/// Images of one state of the scene: a draft or a preview, the one that the settings define, the best so far,
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
            Quality::Draft { .. } | Quality::Preview => {
                *self = Self { draft: Some(frame), ..Self::default() }
            }
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
        // Drafts with coarser meshes have depths, but no ids.
        let shown = self.shown(wanted).filter(|frame| frame.depth.is_some());
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

#[cfg(test)]
mod tests {
    use super::*;

    const DRAFT: Quality = Quality::Draft { shrink: 2.0 };

    /// Adds an image of that width, which took as many milliseconds.
    fn add(gallery: &mut Gallery, quality: Quality, width: u32) {
        let frame = Arc::new(Frame { width, ..Frame::default() });
        let shown = Shown { frame, views: Camera::default().into(), nodes: Arc::default() };
        gallery.add(quality, shown, Duration::from_millis(width.into()));
    }

    /// The widths of what is shown instead of the settings' image, the best one and the difference.
    fn widths(gallery: &Gallery) -> [Option<u32>; 3] {
        [Wanted::Settings, Wanted::Best, Wanted::Difference]
            .map(|wanted| gallery.shown(wanted).map(|frame| frame.width))
    }

    #[test]
    fn the_report_has_the_times_of_both_images() {
        let (ms, mut gallery) = (Duration::from_millis, Gallery::default());
        assert_eq!((gallery.report(), widths(&gallery)), (None, [None; 3]), "there is no image");
        add(&mut gallery, DRAFT, 3);
        assert_eq!((gallery.report(), widths(&gallery)), (None, [Some(3); 3]), "a draft is not timed");
        for settings in [20, 30] {
            add(&mut gallery, Quality::Full(0), settings);
            let report = QualityReport { settings: ms(settings.into()), ..QualityReport::default() };
            assert_eq!(gallery.report(), Some(report), "without a better one");
            assert_eq!(widths(&gallery), [Some(settings); 3], "it is the best there is");
            for best in [70, 900] {
                add(&mut gallery, Quality::Full(2), best);
                let report = QualityReport { best: Some(ms(best.into())), ..report };
                assert_eq!(gallery.report(), Some(report), "the last one's time");
                assert_eq!(widths(&gallery), [settings, best, settings].map(Some), "each where it is wanted");
            }
            let pair = gallery.pair().expect("there are both").map(|frame| frame.width);
            assert_eq!(pair, [settings, 900], "to be compared");
        }
        add(&mut gallery, DRAFT, 4);
        assert_eq!((gallery.report(), widths(&gallery)), (None, [Some(4); 3]), "of another state");
        assert!(gallery.pair().is_none(), "nothing to compare");
    }
}
