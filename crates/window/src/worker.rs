//! Drawing the scene beside the window's thread, so that the window never waits for
//! a picture.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, RenderError, RenderSettings, Renderer, Scene};

use crate::pacing::Quality;

/// What a picture is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Purpose {
    /// The window.
    Window(Quality),
    /// Somebody asked for it.
    Picture,
}

/// A picture to be drawn.
pub(crate) struct Job {
    pub(crate) purpose: Purpose,
    pub(crate) scene: Arc<Scene>,
    pub(crate) camera: Camera,
    pub(crate) settings: RenderSettings,
}

/// What became of a job.
pub(crate) struct Finished {
    pub(crate) purpose: Purpose,
    pub(crate) camera: Camera,
    pub(crate) took: Duration,
    pub(crate) frame: Result<Frame, RenderError>,
}

/// Draws one job at a time.
pub(crate) struct Worker {
    hands: Hands,
    /// Of the job under way.
    cancel: Option<Cancel>,
}

enum Hands {
    /// A thread, and what it has finished.
    Thread { jobs: Sender<(Job, Cancel)>, finished: Receiver<Finished> },
    /// The thread that asks. It takes no time, as far as others can tell: so what is
    /// drawn, and how well, does not depend on the machine.
    Caller { renderer: Box<Renderer>, finished: Option<Box<Finished>> },
}

impl Worker {
    /// A worker that draws where it is asked to, at once.
    pub(crate) fn of_caller() -> Self {
        let renderer = Box::new(Renderer::builder().build());
        Self { hands: Hands::Caller { renderer, finished: None }, cancel: None }
    }

    /// A worker with a thread of its own, which calls `ring` whenever a job is
    /// finished. Where there are no threads to be had, the caller's.
    pub(crate) fn of_thread(ring: impl Fn() + Send + 'static) -> Self {
        let (jobs, to_do) = channel::<(Job, Cancel)>();
        let (done, finished) = channel();
        let work = move || {
            let mut renderer = Renderer::builder().build();
            while let Ok((job, cancel)) = to_do.recv() {
                if done.send(job.draw(&mut renderer, &cancel)).is_err() {
                    return;
                }
                ring();
            }
        };
        match thread::Builder::new().name("trigon-render".into()).spawn(work) {
            Ok(_) => Self { hands: Hands::Thread { jobs, finished }, cancel: None },
            Err(_) => Self::of_caller(),
        }
    }

    /// Whether a job is under way.
    pub(crate) fn is_busy(&self) -> bool {
        self.cancel.is_some()
    }

    /// Begins a job; the last one is finished.
    pub(crate) fn begin(&mut self, job: Job) {
        let cancel = Cancel::default();
        self.cancel = Some(cancel.clone());
        match &mut self.hands {
            // The thread lives for as long as this does.
            Hands::Thread { jobs, .. } => drop(jobs.send((job, cancel))),
            Hands::Caller { renderer, finished } => {
                let drawn = job.draw(renderer, &cancel);
                *finished = Some(Box::new(Finished { took: Duration::ZERO, ..drawn }));
            }
        }
    }

    /// Nobody will look at the job under way. It still has to be collected.
    pub(crate) fn cancel(&self) {
        if let Some(cancel) = &self.cancel {
            cancel.cancel();
        }
    }

    /// The job that was under way, if it is finished.
    pub(crate) fn collect(&mut self) -> Option<Finished> {
        let finished = match &mut self.hands {
            Hands::Thread { finished, .. } => finished.try_recv().ok(),
            Hands::Caller { finished, .. } => finished.take().map(|finished| *finished),
        }?;
        self.cancel = None;
        Some(finished)
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.cancel();
    }
}

impl Job {
    fn draw(self, renderer: &mut Renderer, cancel: &Cancel) -> Finished {
        let begun = Instant::now();
        *renderer.settings_mut() = self.settings;
        let frame = renderer.render_cancellable(&self.scene, &self.camera, cancel);
        Finished { purpose: self.purpose, camera: self.camera, took: begun.elapsed(), frame }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_scene::{render, showcase};

    fn job(side: u32, samples: u32) -> Job {
        let scene = showcase();
        let camera = scene.overview(1.0);
        let settings = RenderSettings { samples_per_axis: samples, ..RenderSettings::new(side, side) };
        Job { purpose: Purpose::Picture, scene: Arc::new(scene), camera, settings }
    }

    #[test]
    fn a_thread_draws_what_the_caller_would() {
        let expected = render(&job(40, 2).scene, &job(40, 2).camera, &job(40, 2).settings).expect("drawn");
        let (ring, rung) = channel();
        let mut worker = Worker::of_thread(move || {
            let _ = ring.send(());
        });
        worker.begin(job(40, 2));
        rung.recv_timeout(Duration::from_secs(60)).expect("it rings when it is done");
        let finished = worker.collect().expect("it is done");
        assert!(finished.frame == Ok(expected.clone()), "the same bytes");
        assert!(!worker.is_busy(), "ready for the next one");
        let mut caller = Worker::of_caller();
        caller.begin(job(40, 2));
        assert!(caller.collect().expect("done at once").frame == Ok(expected), "the same bytes here");
    }

    #[test]
    fn a_cancelled_job_makes_room_for_the_next() {
        let (ring, rung) = channel();
        let mut worker = Worker::of_thread(move || {
            let _ = ring.send(());
        });
        // Hundreds of tiles with sixteen samples a pixel: minutes.
        worker.begin(job(8192, 4));
        worker.cancel();
        rung.recv_timeout(Duration::from_secs(60)).expect("it ends");
        let finished = worker.collect().expect("it has ended");
        assert_eq!(finished.frame.err(), Some(RenderError::Cancelled), "without a picture");
        worker.begin(job(8, 1));
        rung.recv_timeout(Duration::from_secs(60)).expect("it goes on");
        assert!(worker.collect().is_some_and(|finished| finished.frame.is_ok()), "with the next one");
    }
}
