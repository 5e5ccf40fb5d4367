//! Threads that stand by for a frame.
//!
//! A thread that sleeps between two stages takes a while to wake up. On virtual machines the system was seen to wake it on
//! the core of the thread that woke it, and to leave both there for milliseconds while another core was idle. So the other
//! threads of a pool stay awake from the beginning of a frame to its end, unless there is nothing to do for long.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use rayon::{Scope, Yield};

/// How long a frame waits for the others to be there.
const ARRIVAL: Duration = Duration::from_micros(300);

/// After so long without work a thread goes to sleep.
const PATIENCE: Duration = Duration::from_millis(2);

/// Threads that stand by.
pub(super) struct Standby {
    /// How many there are; `None` when no more are admitted.
    there: Mutex<Option<usize>>,
    is_over: AtomicBool,
}

/// Ends standing by, however a frame ends.
pub(super) struct Frame<'s>(&'s Standby);

impl Standby {
    pub(super) fn new() -> Self {
        Self { there: Mutex::new(Some(0)), is_over: AtomicBool::new(false) }
    }

    /// Calls `others` threads of the pool, and waits until they stand by, but not for long. Threads that come later are not
    /// admitted: one could come in the middle of a task, which would then not end before the frame does.
    pub(super) fn call<'s>(&'s self, scope: &Scope<'s>, others: usize) -> Frame<'s> {
        (0..others).for_each(|_| scope.spawn(|_| self.stand_by()));
        let called = Instant::now();
        while self.admitted() < Some(others) && called.elapsed() < ARRIVAL {
            thread::yield_now();
        }
        *self.there.lock().unwrap_or_else(PoisonError::into_inner) = None;
        Frame(self)
    }

    fn admitted(&self) -> Option<usize> {
        *self.there.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Looks for work until the frame is over.
    fn stand_by(&self) {
        match &mut *self.there.lock().unwrap_or_else(PoisonError::into_inner) {
            Some(there) => *there += 1,
            None => return,
        }
        let mut last = Instant::now();
        while !self.is_over.load(Ordering::Acquire) && last.elapsed() < PATIENCE {
            if rayon::yield_now() == Some(Yield::Executed) {
                last = Instant::now();
            } else {
                thread::yield_now();
            }
        }
    }
}

impl Drop for Frame<'_> {
    fn drop(&mut self) {
        self.0.is_over.store(true, Ordering::Release);
    }
}
