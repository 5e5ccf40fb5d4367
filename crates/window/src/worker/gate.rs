//! For tests: jobs wait at a gate until the test opens it. So a job is certainly still running when the test
//! needs it to be, on a machine of any speed.

use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

use super::{CoarseMeshMaker, Drawing, Job, Purpose, Worker};
use trigon_scene::Cancel;

/// Shut at first, and open for good once it is opened. Clones are the same gate.
#[derive(Clone, Default)]
pub(crate) struct Gate(Arc<(Mutex<bool>, Condvar)>);

impl Gate {
    /// Lets everything through, now and later.
    pub(crate) fn open(&self) {
        let (is_open, changed) = &*self.0;
        *is_open.lock().unwrap_or_else(PoisonError::into_inner) = true;
        changed.notify_all();
    }

    /// Returns once the gate is open.
    pub(crate) fn pass(&self) {
        let (is_open, changed) = &*self.0;
        let is_open = is_open.lock().unwrap_or_else(PoisonError::into_inner);
        drop(changed.wait_while(is_open, |is_open| !*is_open));
    }

    /// A worker with threads whose jobs for some purposes wait at this gate before they
    /// are done, and what is told once for each job that is finished. By its clock jobs
    /// take no time.
    pub(crate) fn worker(&self, holds: fn(Purpose) -> bool) -> (Worker, Receiver<()>) {
        let (ring, rung) = channel();
        let ring = move || {
            // Fails when the test is over.
            let _ = ring.send(());
        };
        let worker = Worker::of_runs(ring, || {
            let (mut drawing, gate) =
                (Drawing::new(CoarseMeshMaker::Thread(None), || Duration::ZERO), self.clone());
            move |job: Job, cancel: &Cancel| {
                if holds(job.purpose) {
                    gate.pass();
                }
                drawing.run(job, cancel)
            }
        });
        (worker, rung)
    }
}
