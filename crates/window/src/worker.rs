//! Drawing the scene beside the window's thread, so that the window never waits for
//! a picture.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, RenderError, RenderSettings, Renderer, Scene};

use crate::drawer::Drawer;
use crate::pacing::Quality;
use crate::refinement::{Compared, compare};

/// What a picture is for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Purpose {
    /// The window.
    Window(Quality),
    /// Somebody asked for it.
    Picture,
}

/// What is to be done.
pub(crate) struct Job {
    pub(crate) purpose: Purpose,
    /// What pictures are drawn with.
    pub(crate) camera: Camera,
    pub(crate) task: Task,
}

/// A picture to be drawn, or two to be compared.
pub(crate) enum Task {
    Draw {
        scene: Arc<Scene>,
        settings: Box<RenderSettings>,
        /// Instead of the renderer.
        drawer: Option<Arc<dyn Drawer>>,
    },
    /// What was found, and what is right.
    Compare([Arc<Frame>; 2]),
}

/// What a job ends with.
pub(crate) enum Product {
    Picture(Frame),
    Comparison(Compared),
}

/// Why a job has no product.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Unfinished {
    Cancelled,
    /// What a user should be told.
    Impossible(String),
}

/// What became of a job.
pub(crate) struct Finished {
    pub(crate) purpose: Purpose,
    pub(crate) camera: Camera,
    pub(crate) took: Duration,
    pub(crate) product: Result<Product, Unfinished>,
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
                if done.send(job.run(&mut renderer, &cancel)).is_err() {
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
                let done = job.run(renderer, &cancel);
                *finished = Some(Box::new(Finished { took: Duration::ZERO, ..done }));
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
    fn run(self, renderer: &mut Renderer, cancel: &Cancel) -> Finished {
        let begun = Instant::now();
        let product = match self.task {
            Task::Draw { scene, settings, drawer } => {
                let drawn = match drawer {
                    None => render((&scene, &self.camera), *settings, renderer, cancel),
                    Some(drawer) => draw_otherwise(&*drawer, (&scene, &self.camera), &settings, cancel),
                };
                drawn.map(Product::Picture)
            }
            Task::Compare([found, right]) => {
                compare(&found, &right, cancel).map(Product::Comparison).ok_or(Unfinished::Cancelled)
            }
        };
        Finished { purpose: self.purpose, camera: self.camera, took: begun.elapsed(), product }
    }
}

fn render(
    (scene, camera): (&Scene, &Camera),
    settings: RenderSettings,
    renderer: &mut Renderer,
    cancel: &Cancel,
) -> Result<Frame, Unfinished> {
    *renderer.settings_mut() = settings;
    renderer.render_cancellable(scene, camera, cancel).map_err(|error| match error {
        RenderError::Cancelled => Unfinished::Cancelled,
        error => Unfinished::Impossible(error.to_string()),
    })
}

/// A picture of another size or without colours is none.
fn draw_otherwise(
    drawer: &dyn Drawer,
    (scene, camera): (&Scene, &Camera),
    settings: &RenderSettings,
    cancel: &Cancel,
) -> Result<Frame, Unfinished> {
    let drawn = drawer.draw(scene, camera, settings, cancel);
    if cancel.is_cancelled() {
        return Err(Unfinished::Cancelled);
    }
    let frame = drawn.map_err(Unfinished::Impossible)?;
    let RenderSettings { width, height, .. } = *settings;
    if [frame.width, frame.height] == [width, height]
        && frame.color.len() == 4 * width as usize * height as usize
    {
        return Ok(frame);
    }
    Err(Unfinished::Impossible(format!(
        "a picture of {}x{} was drawn for one of {width}x{height}",
        frame.width, frame.height
    )))
}

#[cfg(test)]
mod tests {
    use super::{
        Cancel, Drawer, Finished, Frame, Job, Product, Purpose, RenderSettings, Scene, Task, Unfinished,
        Worker,
    };
    use std::sync::Arc;
    use std::sync::mpsc::channel;
    use std::time::Duration;
    use trigon_camera::Camera;
    use trigon_scene::{render, showcase};

    fn job(side: u32, samples: u32) -> Job {
        let scene = showcase();
        let camera = scene.overview(1.0);
        let settings = RenderSettings { samples_per_axis: samples, ..RenderSettings::new(side, side) };
        let task = Task::Draw { scene: Arc::new(scene), settings: Box::new(settings), drawer: None };
        Job { purpose: Purpose::Picture, camera, task }
    }

    /// The picture of a job that was finished.
    fn picture(worker: &mut Worker) -> Option<Frame> {
        match worker.collect()?.product {
            Ok(Product::Picture(frame)) => Some(frame),
            _ => None,
        }
    }

    #[test]
    fn a_thread_draws_what_the_caller_would() {
        let scene = showcase();
        let settings = RenderSettings { samples_per_axis: 2, ..RenderSettings::new(40, 40) };
        let expected = render(&scene, &scene.overview(1.0), &settings).expect("drawn");
        let (ring, rung) = channel();
        let mut worker = Worker::of_thread(move || {
            let _ = ring.send(());
        });
        worker.begin(job(40, 2));
        rung.recv_timeout(Duration::from_secs(60)).expect("it rings when it is done");
        assert!(picture(&mut worker).as_ref() == Some(&expected), "the same bytes");
        assert!(!worker.is_busy(), "ready for the next one");
        let mut caller = Worker::of_caller();
        caller.begin(job(40, 2));
        assert!(picture(&mut caller) == Some(expected), "the same bytes here");
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
        assert_eq!(finished.product.err(), Some(Unfinished::Cancelled), "without a picture");
        worker.begin(job(8, 1));
        rung.recv_timeout(Duration::from_secs(60)).expect("it goes on");
        assert!(picture(&mut worker).is_some(), "with the next one");
    }

    /// Draws a picture of some size, or refuses.
    struct Other(Result<u32, String>);

    impl Drawer for Other {
        fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
            let side = self.0.clone()?;
            let color = vec![7; 4 * side as usize * side as usize];
            Ok(Frame { width: side, height: side, color, ..Frame::default() })
        }
    }

    #[test]
    fn other_drawers_are_heard_and_not_trusted() {
        let product = |drawer: Other| {
            let mut job = job(8, 1);
            if let Task::Draw { drawer: used, .. } = &mut job.task {
                *used = Some(Arc::new(drawer));
            }
            let mut worker = Worker::of_caller();
            worker.begin(job);
            worker.collect().map(|Finished { product, .. }| product)
        };
        let drawn = product(Other(Ok(8)));
        assert!(matches!(drawn, Some(Ok(Product::Picture(frame))) if frame.color[0] == 7), "its picture");
        let reason = |product| match product {
            Some(Err(Unfinished::Impossible(reason))) => reason,
            _ => String::new(),
        };
        assert_eq!(reason(product(Other(Err("not convex".into())))), "not convex", "its reason");
        assert!(reason(product(Other(Ok(3)))).contains("3x3"), "a picture of the wrong size is none");
    }
}
