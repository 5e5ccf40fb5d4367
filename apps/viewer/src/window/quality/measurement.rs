//! Measures on its own thread what the view costs at many settings, while the window rests: the window neither waits for
//! it, nor draws at the same time as a frame whose time counts.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use trigon_scene::quality::{Frontier, Sweep, SweepProgress};
use trigon_scene::{Cancel, RenderError};

/// How often the window hears of progress.
const NEWS: Duration = Duration::from_millis(250);

/// How long the window takes to draw its interface, at most.
const PASS: Duration = Duration::from_millis(30);

/// Compared with frames that take longer, the interface takes little.
const LONG: Duration = Duration::from_millis(200);

/// A measurement under way, or done. Dropping it cancels it.
pub(super) struct Measurement {
    shared: Arc<MeasurementLink>,
}

/// What is known so far.
#[derive(Clone, Debug)]
pub(super) struct Results {
    pub(super) progress: SweepProgress,
    pub(super) frontier: Frontier,
    /// Why there will be no more.
    pub(super) failure: Option<String>,
}

/// What the two threads share.
struct MeasurementLink {
    state: Mutex<MeasurementState>,
    changed: Condvar,
}

struct MeasurementState {
    is_cancelled: bool,
    /// Whether the window draws, or will.
    is_paused: bool,
    /// No frame is begun before.
    quiet_until: Instant,
    /// When the frame that is being drawn was begun.
    frame: Option<(Instant, Cancel)>,
    results: Results,
}

impl Measurement {
    /// Starts to measure, once the window says that it rests; `wake` is called a few times a second, and at the end.
    pub(super) fn start(sweep: Sweep, wake: impl Fn() + Send + 'static) -> Self {
        let results = Results { progress: sweep.progress(), frontier: sweep.frontier(), failure: None };
        let state = MeasurementState {
            is_cancelled: false,
            is_paused: true,
            quiet_until: Instant::now(),
            frame: None,
            results,
        };
        let shared = Arc::new(MeasurementLink { state: Mutex::new(state), changed: Condvar::new() });
        let theirs = Arc::clone(&shared);
        let spawned =
            thread::Builder::new().name("trigon-measure".into()).spawn(move || theirs.measure(sweep, wake));
        if let Err(error) = spawned {
            shared.state().results.failure = Some(format!("no thread could be started ({error}); try again"));
        }
        Self { shared }
    }

    /// What is known so far.
    pub(super) fn results(&self) -> Results {
        self.shared.state().results.clone()
    }

    /// Whether it has ended.
    pub(super) fn is_over(&self) -> bool {
        let state = self.shared.state();
        state.results.progress.is_done() || state.results.failure.is_some()
    }

    /// The window draws its interface, and rests afterwards or not. A frame whose time that would change is drawn
    /// again.
    pub(super) fn interface_is_drawn(&self, window_rests: bool) {
        let mut state = self.shared.state();
        state.is_paused = !window_rests;
        state.quiet_until = Instant::now() + PASS;
        if let Some((begun, cancel)) = &state.frame
            && (state.is_paused || begun.elapsed() < LONG)
        {
            cancel.cancel();
        }
        self.shared.changed.notify_all();
    }
}

impl Drop for Measurement {
    fn drop(&mut self) {
        let mut state = self.shared.state();
        state.is_cancelled = true;
        if let Some((_, cancel)) = &state.frame {
            cancel.cancel();
        }
        self.shared.changed.notify_all();
    }
}

impl MeasurementLink {
    fn state(&self) -> MutexGuard<'_, MeasurementState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn measure(&self, mut sweep: Sweep, wake: impl Fn()) {
        let start = Instant::now();
        let mut reported = start;
        while let Some(cancel) = self.begin_frame() {
            let stepped = sweep.step(&mut || start.elapsed(), &cancel);
            let mut state = self.state();
            state.frame = None;
            match stepped {
                Ok(progress) => state.results.progress = progress,
                Err(RenderError::Cancelled) => continue,
                Err(error) => state.results.failure = Some(error.to_string()),
            }
            let is_over = state.results.failure.is_some() || state.results.progress.is_done();
            if is_over || reported.elapsed() >= NEWS {
                reported = Instant::now();
                state.results.frontier = sweep.frontier();
                // The window draws the news.
                state.quiet_until = reported + PASS;
                drop(state);
                wake();
            }
            if is_over {
                return;
            }
        }
    }

    /// Waits until a frame may be drawn; `None` if none is wanted any more.
    fn begin_frame(&self) -> Option<Cancel> {
        let mut state = self.state();
        loop {
            let wait = state.quiet_until.saturating_duration_since(Instant::now());
            state = match (state.is_cancelled, state.is_paused) {
                (true, _) => return None,
                (_, true) => self.changed.wait(state).unwrap_or_else(PoisonError::into_inner),
                _ if wait.is_zero() => break,
                _ => self.changed.wait_timeout(state, wait).unwrap_or_else(PoisonError::into_inner).0,
            };
        }
        let cancel = Cancel::default();
        state.frame = Some((Instant::now(), cancel.clone()));
        Some(cancel)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    use trigon_scene::quality::{Preset, SweepOptions};
    use trigon_scene::{RenderSettings, showcase};

    use super::*;

    fn sweep(width: u32) -> Sweep {
        let (scene, settings) = (showcase(), RenderSettings { width, ..RenderSettings::new(8, 6) });
        let camera = scene.overview(1.0);
        let qualities = vec![Preset::Draft.quality()];
        Sweep::new(scene, camera, &settings, SweepOptions { qualities, rounds: 2, seed: 1 })
    }

    /// Starts one, and waits for its end.
    fn measured(sweep: Sweep, meanwhile: impl FnOnce(&Measurement)) -> Results {
        let (sender, woken) = channel();
        let measurement = Measurement::start(sweep, move || sender.send(()).expect("somebody waits"));
        meanwhile(&measurement);
        measurement.interface_is_drawn(true);
        while !measurement.is_over() {
            woken.recv().expect("it wakes the window at its end");
        }
        measurement.results()
    }

    #[test]
    fn all_settings_are_measured_however_often_the_window_draws() {
        let results = measured(sweep(8), |measurement| {
            measurement.interface_is_drawn(false);
            assert_eq!(measurement.results().progress.done, 0, "it waits for the window");
        });
        assert_eq!(results.failure, None);
        let frames: Vec<usize> = results.frontier.dots.iter().map(|dot| dot.frames).collect();
        assert_eq!(frames, [2, 2, 2], "the draft, the settings and the reference");
    }

    #[test]
    fn a_size_that_cannot_be_drawn_is_named() {
        let failure = measured(sweep(0), |_| {}).failure.expect("it cannot be drawn");
        assert!(failure.contains("0x6 pixels"), "{failure}");
    }

    #[test]
    fn a_dropped_measurement_ends() {
        let (sender, woken) = channel();
        let measurement = Measurement::start(sweep(8), move || {
            // Nobody waits for it.
            let _ = sender.send(());
        });
        measurement.interface_is_drawn(false);
        drop(measurement);
        // The thread drops the sender.
        while woken.recv().is_ok() {}
    }
}
