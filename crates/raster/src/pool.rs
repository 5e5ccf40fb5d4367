//! The thread pool: workers that persist between frames and share each stage.

use rayon::{ThreadPool, ThreadPoolBuilder};
use std::num::NonZeroUsize;
use std::sync::{Mutex, PoisonError};

/// Who works on a frame: the calling thread, and perhaps others beside it.
pub(crate) struct Workers {
    others: Option<ThreadPool>,
    count: usize,
}

/// More threads than this are never of use to a frame.
const MOST: usize = 256;

impl Workers {
    /// The calling thread.
    pub(crate) const ALONE: Self = Self { others: None, count: 1 };

    /// As many threads as requested, or as the machine runs at once; fewer if the system refuses more.
    pub(crate) fn new(threads: Option<NonZeroUsize>) -> Self {
        let available = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let count = threads.unwrap_or_else(available).get().min(MOST);
        let build = |others: usize| ThreadPoolBuilder::new().num_threads(others).build().ok();
        let others = if count > 1 { build(count - 1) } else { None };
        // If threads cannot be started, the frame is drawn with fewer.
        let count = others.as_ref().map_or(1, |pool| pool.current_num_threads() + 1);
        Self { others, count }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Runs `work` on every worker at once, or on the calling thread alone if
    /// it is not `shared`, and waits for all.
    ///
    /// Between the stages of a frame the others look for work for a while before
    /// they go to sleep, so that a stage starts without waking anybody.
    pub(crate) fn run(&self, shared: bool, work: impl Fn(usize) + Sync) {
        match &self.others {
            Some(pool) if shared => pool.in_place_scope(|scope| {
                scope.spawn_broadcast(|_, context| work(context.index() + 1));
                work(0);
            }),
            _ => work(0),
        }
    }

    /// Works through items, each taken by the worker that is free first.
    pub(crate) fn share<I>(&self, items: I, work: impl Fn(I::Item) + Sync)
    where
        I: Iterator + Send,
    {
        let items = Mutex::new(items);
        self.run(true, |_| {
            // An item whose processing panicked is lost; the others remain.
            while let Some(item) = take(&items) {
                work(item);
            }
        });
    }
}

/// Unlocks before the item is worked on.
fn take<I: Iterator>(items: &Mutex<I>) -> Option<I::Item> {
    items.lock().unwrap_or_else(PoisonError::into_inner).next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn every_item_is_taken_once() {
        for threads in [1, 2, 3] {
            let mut numbers = vec![0; 1000];
            Workers::new(NonZeroUsize::new(threads)).share(
                numbers.chunks_mut(7).enumerate(),
                |(at, chunk)| {
                    chunk.iter_mut().for_each(|number| *number += at + 1);
                },
            );
            let expected: Vec<_> = (0..1000).map(|i| i / 7 + 1).collect();
            assert_eq!(numbers, expected, "{threads} threads");
        }
    }

    #[test]
    fn every_worker_takes_part_once() {
        for threads in [1, 2, 3] {
            let workers = Workers::new(NonZeroUsize::new(threads));
            let calls = AtomicUsize::new(0);
            workers.run(true, |_| {
                calls.fetch_add(1, Ordering::Relaxed);
            });
            assert_eq!(calls.into_inner(), threads, "one call for each worker");
            let calls = AtomicUsize::new(0);
            workers.run(false, |_| {
                calls.fetch_add(1, Ordering::Relaxed);
            });
            assert_eq!(calls.into_inner(), 1, "alone");
        }
    }
}
