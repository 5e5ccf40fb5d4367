//! The thread pool: workers that persist between frames and share each stage.
//!
//! A frame is drawn on this pool from beginning to end, while the caller sleeps: if the caller drew too, there would
//! be more threads than cores. No stage waits for a late thread; the others do its share.
//!
//! Between stages, threads stand by ([`Standby`]). A thread that sleeps between two stages takes a while to wake up. On virtual machines the system was seen to wake it on
//! the core of the thread that woke it, and to leave both there for milliseconds while another core was idle. So the other
//! threads of a pool stay awake from the beginning of a frame to its end, unless there is nothing to do for long.

use rayon::{Scope, ThreadPool, ThreadPoolBuilder, Yield};
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// Who works on a frame: the threads of a pool, or the calling thread alone.
pub(crate) struct Workers {
    pool: Option<ThreadPool>,
    count: usize,
    /// How many others stay awake during a frame: no more than have a core.
    awake: usize,
}

/// More threads than this are never of use to a frame.
const MOST: usize = 256;

impl Workers {
    /// The calling thread.
    pub(crate) const ALONE: Self = Self { pool: None, count: 1, awake: 0 };

    /// As many threads as requested, or as the machine runs at once; fewer if the system refuses more.
    pub(crate) fn new(threads: Option<NonZeroUsize>) -> Self {
        let cores = thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let count = threads.unwrap_or(cores).get().min(MOST);
        let build = |count: usize| ThreadPoolBuilder::new().num_threads(count).build().ok();
        let pool = if count > 1 { build(count) } else { None };
        // If threads cannot be started, the frame is drawn with fewer.
        let count = pool.as_ref().map_or(1, ThreadPool::current_num_threads);
        Self { pool, count, awake: count.min(cores.get()) - 1 }
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Runs `work` on one of the threads, unless the calling thread is one already, or works alone.
    ///
    /// A thread of another pool runs it itself: while it waited, rayon would give it other work of its own pool, such as
    /// the next image of a list, which it would have to finish first.
    pub(crate) fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.pool {
            Some(pool) if rayon::current_thread_index().is_none() => {
                let standby = Standby::new();
                pool.scope(|scope| {
                    let _frame = standby.call(scope, self.awake);
                    work()
                })
            }
            _ => work(),
        }
    }

    /// Runs `work` once for every worker, at once if all of them are free, or on the calling thread alone if
    /// it is not `shared`, and waits for all. The calling thread is one of them.
    ///
    /// If it is a thread of the pool, it waits for no other that comes late, but does its work, too. Between the stages
    /// of a frame workers look for work for a while before they go to sleep, so that a stage mostly starts without
    /// waking anybody.
    pub(crate) fn run(&self, shared: bool, work: impl Fn(usize) + Sync) {
        match &self.pool {
            Some(pool) if shared => pool.in_place_scope(|scope| {
                let work = &work;
                (1..self.count).for_each(|worker| scope.spawn(move |_| work(worker)));
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

/// How long a frame waits for the others to be there.
const ARRIVAL: Duration = Duration::from_micros(300);

/// After so long without work a thread goes to sleep.
const PATIENCE: Duration = Duration::from_millis(2);

/// Threads that stand by.
struct Standby {
    /// How many there are; `None` when no more are admitted.
    there: Mutex<Option<usize>>,
    is_over: AtomicBool,
}

/// Ends standing by, however a frame ends.
struct Frame<'s>(&'s Standby);

impl Standby {
    fn new() -> Self {
        Self { there: Mutex::new(Some(0)), is_over: AtomicBool::new(false) }
    }

    /// Calls `others` threads of the pool, and waits until they stand by, but not for long. Threads that come later are not
    /// admitted: one could come in the middle of a task, which would then not end before the frame does.
    fn call<'s>(&'s self, scope: &Scope<'s>, others: usize) -> Frame<'s> {
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

    /// Stages, what rayon shares out in them and between them, and one frame after the other.
    #[test]
    fn whatever_a_frame_shares_out_is_done() {
        use rayon::prelude::*;
        for threads in [1, 2, 3] {
            let workers = Workers::new(NonZeroUsize::new(threads));
            for frame in 0..300_u64 {
                let sum = workers.install(|| {
                    let between: u64 = (0..50_u64).into_par_iter().map(|number| number * frame).sum();
                    let total = AtomicUsize::new(0);
                    workers.share(0..40_usize, |number| {
                        let within: usize = (0..number).into_par_iter().sum();
                        total.fetch_add(within, Ordering::Relaxed);
                    });
                    between + total.into_inner() as u64
                });
                let within: u64 = (0..40_u64).map(|number| (0..number).sum::<u64>()).sum();
                assert_eq!(sum, 1225 * frame + within, "frame {frame}, {threads} threads");
            }
        }
    }

    #[test]
    fn after_a_frame_that_panics_nobody_stands_by() {
        for threads in [1, 2, 3] {
            let workers = Workers::new(NonZeroUsize::new(threads));
            let panic = std::panic::AssertUnwindSafe(|| workers.install(|| panic!("as a pipeline might")));
            assert!(std::panic::catch_unwind(panic).is_err(), "the caller learns of it");
            assert_eq!(workers.install(|| 7), 7, "and can draw the next one");
        }
    }

    /// Otherwise all images of a long list would be begun, each while the one before it waits, and overflow the stack.
    #[test]
    fn threads_of_other_pools_finish_one_image_before_the_next() {
        let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
        let (under_way, most) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let image = || {
            most.fetch_max(under_way.fetch_add(1, Ordering::Relaxed) + 1, Ordering::Relaxed);
            Workers::new(NonZeroUsize::new(2)).install(thread::yield_now);
            under_way.fetch_sub(1, Ordering::Relaxed);
        };
        pool.scope(|scope| (0..20).for_each(|_| scope.spawn(|_| image())));
        assert_eq!(most.into_inner(), 1, "at a time");
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
