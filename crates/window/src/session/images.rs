//! Which images are drawn beside the one in the window, and what happens to them.

use std::sync::Arc;
use std::time::Duration;

use trigon_camera::Viewport;
use trigon_math::Bounds3;
use trigon_scene::RenderSettings;

use super::Session;
use crate::canvas::Placed;
use crate::pacing::{Change, Quality};
use crate::panes::Views;
use crate::shown::{DrawnNodes, Shown};
use crate::stage::FrameReport;
use crate::worker::{Finished, Job, Product, Purpose, Task, Unfinished};

/// No image is expected in less than this.
const SHORTEST_BUDGET: Duration = Duration::from_millis(1);

impl Session<'_> {
    /// Takes over what the worker has finished.
    pub(crate) fn collect(&mut self, now: Duration) {
        let Some(finished) = self.worker.collect() else { return };
        self.pacing.occupy(None);
        match finished.purpose {
            Purpose::Window(quality) => self.window_finished(quality, finished),
            Purpose::Image => self.image_finished(finished, now),
        }
        self.offer_moves(now);
        self.begin_requested(now);
        self.plan(now);
    }

    fn window_finished(&mut self, quality: Quality, finished: Finished) {
        let Finished { views, took, pixels, stages, product, is_coarse, redrawn, .. } = finished;
        match product {
            Ok(Product::Frame(frame)) => {
                self.redrawn = redrawn;
                self.pacing.finished(took, pixels);
                let nodes = self.nodes.as_ref().map_or_else(Arc::default, |(_, nodes)| Arc::clone(nodes));
                self.gallery.add(quality, Shown { frame, views, nodes }, took);
                self.drawn_subject.clone_from(&self.subject);
                if !matches!(quality, Quality::Full(1..)) {
                    self.stage.set_report(FrameReport {
                        render: took,
                        stages,
                        is_coarse,
                        ..self.stage.report()
                    });
                }
            }
            Ok(Product::Comparison(compared)) => {
                self.pacing.finished(took, pixels);
                self.gallery.compared(*compared);
            }
            Err(Unfinished::Cancelled) => self.pacing.cancelled(),
            Err(Unfinished::Impossible(reason)) => {
                self.pacing.failed();
                self.stage.overlay.notify(reason);
            }
        }
    }

    fn image_finished(&mut self, finished: Finished, now: Duration) {
        match finished.product {
            Ok(Product::Frame(frame)) => {
                self.handler.image(&mut self.stage, Arc::unwrap_or_clone(frame));
                self.after_handler(now);
            }
            Err(Unfinished::Impossible(reason)) => self.stage.overlay.notify(reason),
            // Nobody cancels images that were asked for, and they are no comparisons.
            Ok(Product::Comparison(_)) | Err(Unfinished::Cancelled) => {}
        }
    }

    /// What is wanted at rest may be something else now, and so may be what is shown.
    pub(super) fn plan(&mut self, now: Duration) {
        self.pacing.want(self.stage.wanted_steps());
        self.pacing.allow(self.stage.frame_budget.max(SHORTEST_BUDGET));
        let is_current = self.drawn_subject.as_ref() == Some(&self.stage.subject());
        let report = self.gallery.report().filter(|_| is_current);
        let progress = self.pacing.progress(now);
        let is_long = progress.is_some_and(|progress| progress.seconds() > 0);
        let percent = is_long.then(|| self.worker.percent());
        let before = (self.stage.quality_report(), self.stage.progress(), self.stage.percent());
        if (report, progress, percent) != before {
            self.stage.set_quality_report(report);
            self.stage.set_progress(progress, percent);
            self.pacing.changed(Change::Overlay, now);
        }
        let wanted = self.gallery.shown(self.stage.wanted_image()).cloned();
        let is_same = match (&wanted, &self.shown) {
            (Some(wanted), Some(shown)) => Arc::ptr_eq(wanted, shown),
            _ => wanted.is_none(),
        };
        if !is_same {
            self.shown = wanted;
            self.stale = true;
            self.stage.show(self.gallery.picked(self.stage.wanted_image()));
        }
    }

    /// Brings the image under the interface, at the window's size, unless it is there.
    pub(super) fn show_image(&mut self) {
        if !std::mem::take(&mut self.stale) {
            return;
        }
        let (Viewport { width, height }, area) = (self.stage.viewport(), self.stage.image_area());
        let painter = &mut self.interface.painter;
        let (shown, redrawn) = (self.shown.as_ref(), self.redrawn.as_ref());
        let placed = Placed { frame: shown, redrawn, area };
        self.canvas.show(placed, [width, height], |changed| painter.invalidate_part(changed));
    }

    /// Begins an image that was asked for, if the worker has time. It need not wait for
    /// one that is only better than what is shown.
    pub(super) fn begin_requested(&mut self, now: Duration) {
        if self.images.is_empty() {
            return;
        }
        if self.worker.is_busy() {
            if self.pacing.is_refining() {
                self.worker.cancel();
                self.collect(now);
            }
            return;
        }
        let settings = self.images.remove(0);
        self.pacing.occupy(Some(now));
        let task = self.drawing(Purpose::Image, settings);
        self.begin(Purpose::Image, task);
        self.collect(now);
    }

    /// Begins the window's image.
    pub(super) fn begin_image(&mut self, quality: Quality) {
        self.subject = Some(self.stage.subject());
        let revision = self.stage.scene.revision();
        if self.nodes.as_ref().is_none_or(|(known, _)| *known != revision) {
            self.nodes = Some((revision, Arc::new(DrawnNodes::of(&self.stage.scene))));
        }
        match self.task(quality) {
            Some(task) => self.begin(Purpose::Window(quality), task),
            None => self.pacing.failed(),
        }
    }

    /// What is to be done for the window; `None` if there is nothing to be compared or previewed.
    fn task(&mut self, quality: Quality) -> Option<Task> {
        let purpose = Purpose::Window(quality);
        let step = match quality {
            Quality::Draft { shrink } => {
                let mut task = self.drawing(purpose, self.stage.draft_settings(shrink));
                if let Task::Draw { drawer, .. } = &mut task {
                    *drawer = self.stage.drawer.clone().filter(|drawer| drawer.draws_drafts());
                }
                return Some(task);
            }
            Quality::Preview => {
                return self.stage.preview_settings().map(|settings| self.drawing(purpose, settings));
            }
            Quality::Full(step) => step,
        };
        let Some(settings) = self.stage.ladder().into_iter().nth(step) else {
            return self.gallery.pair().map(Task::Compare);
        };
        let other = self.stage.drawer.clone().filter(|_| step == 0);
        let mut task = self.drawing(purpose, settings);
        if let Task::Draw { drawer, .. } = &mut task {
            *drawer = other;
        }
        Some(task)
    }

    /// An image by the renderer.
    fn drawing(&mut self, purpose: Purpose, settings: RenderSettings) -> Task {
        let scene = self.stage.scene.update(self.worker.held(purpose));
        Task::Draw { scene, settings: Box::new(settings), drawer: None }
    }

    fn begin(&mut self, purpose: Purpose, task: Task) {
        let revision = self.stage.scene.revision();
        let known = self.bounds.filter(|(known, _)| *known == revision);
        let (_, bounds) = *self.bounds.insert(known.unwrap_or_else(|| (revision, self.stage.scene.bounds())));
        let views = match purpose {
            Purpose::Window(_) => Views::new(&self.stage.panes(), self.stage.viewport(), &steady(&bounds)),
            Purpose::Image => self.stage.orbit.camera(&bounds).into(),
        };
        self.worker.begin(Job { purpose, views, task });
    }
}

/// A box around bounds that mostly stays while they change a little: the clip planes follow
/// from it, and with other planes nothing of the last image can be kept. Whoever drags the
/// outermost vertex changes the bounds with every movement.
fn steady(bounds: &Bounds3) -> Bounds3 {
    /// Of the bounds' size, the part that the box is rounded to, up to a factor of two.
    const PART: f64 = 8.0;
    let size = bounds.size().max_element() / PART;
    if !(size.is_normal() && size > 0.0) {
        return *bounds;
    }
    // A power of two: its logarithm is in the exponent's bits, alike on all machines.
    let step = f64::from_bits(size.to_bits() & f64::INFINITY.to_bits());
    let (min, max) = ((bounds.min / step).floor() * step, (bounds.max / step).ceil() * step);
    if min.is_finite() && max.is_finite() { Bounds3 { min, max } } else { *bounds }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::DVec3;

    use super::*;

    proptest! {
        #[test]
        fn steady_bounds_hold_the_bounds_and_are_hardly_larger(
            corner in prop::array::uniform3(-1e6..1e6_f64),
            size in prop::array::uniform3(0.0..1e5_f64),
        ) {
            let min = DVec3::from_array(corner);
            let bounds = Bounds3 { min, max: min + DVec3::from_array(size) };
            let box_around = steady(&bounds);
            prop_assert!(box_around.min.cmple(bounds.min).all() && box_around.max.cmpge(bounds.max).all());
            let largest = bounds.size().max_element();
            prop_assert!((box_around.size() - bounds.size()).max_element() <= largest / 4.0);
        }
    }

    #[test]
    fn dragging_the_outermost_vertex_moved_the_clip_planes() {
        let bounds = |x: f64| Bounds3 { min: DVec3::splat(-1.0), max: DVec3::new(x, 1.0, 1.0) };
        let mut boxes: Vec<_> =
            (0..200).map(|step| steady(&bounds(1.01 + 0.001 * f64::from(step)))).collect();
        boxes.dedup();
        assert!(boxes.len() <= 2, "200 movements: {boxes:?}");
        for odd in [Bounds3::EMPTY, Bounds3 { min: DVec3::ZERO, max: DVec3::ZERO }, bounds(f64::INFINITY)] {
            assert_eq!(steady(&odd), odd, "nothing to be rounded to");
        }
    }
}
