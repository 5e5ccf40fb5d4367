//! Wakes a window from other threads, for example when a file was loaded or has changed.

use std::sync::{Arc, Mutex, PoisonError};

type WakeFunction = Box<dyn Fn() + Send>;

#[derive(Default)]
struct State {
    ring: Option<WakeFunction>,
    /// Woken before there was a loop to notify.
    early: bool,
}

/// Wakes a window from anywhere; [`crate::Handler::woken`] is then called on
/// the window's thread. Clones wake the same window.
#[derive(Clone, Default)]
pub struct Waker(Arc<Mutex<State>>);

impl Waker {
    /// Wakes the window. Before it is open this is remembered; after it has closed it does nothing.
    pub fn wake(&self) {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        match &state.ring {
            Some(ring) => ring(),
            None => state.early = true,
        }
    }

    /// Sets what waking does from now on.
    pub(crate) fn connect(&self, ring: impl Fn() + Send + 'static) {
        let mut state = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if std::mem::take(&mut state.early) {
            ring();
        }
        state.ring = Some(Box::new(ring));
    }
}

impl std::fmt::Debug for Waker {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Waker").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn a_wake_before_the_window_is_open_is_not_lost() {
        let waker = Waker::default();
        let clone = waker.clone();
        std::thread::spawn(move || clone.wake()).join().expect("the thread only wakes");
        let rings = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&rings);
        waker.connect(move || {
            counted.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(rings.load(Ordering::Relaxed), 1, "rung when the window opened");
        waker.wake();
        assert_eq!(rings.load(Ordering::Relaxed), 2, "and at every wake from then on");
    }

    /// Whatever holds a waker may be printed at any time, also from within what the waking does.
    #[test]
    fn a_waker_is_printed_by_its_name_while_it_wakes() {
        let (waker, text) = (Waker::default(), Arc::new(Mutex::new(String::new())));
        let (own, written) = (waker.clone(), Arc::clone(&text));
        waker.connect(move || *written.lock().expect("nobody panics with it") = format!("{own:?}"));
        waker.wake();
        assert_eq!(*text.lock().expect("nobody panics with it"), "Waker { .. }");
    }
}
