//! Threads: pools by size, made once per process, and ordered parallel maps.

use crate::ExecuteSettings;
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Who works on a frame: the calling thread alone, or a pool.
pub(crate) struct Workers {
    pool: Option<Arc<ThreadPool>>,
}

impl Workers {
    /// The calling thread alone.
    pub(crate) fn alone() -> Self {
        Self { pool: None }
    }

    /// As many threads as the settings allow; one if no more can be had.
    pub(crate) fn new(settings: &ExecuteSettings) -> Self {
        let available = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
        let threads = settings.threads.unwrap_or_else(available);
        if threads == NonZeroUsize::MIN {
            return Self::alone();
        }
        Self { pool: pool_of(threads) }
    }

    /// `f` of each chunk of `0..length`, in order.
    pub(crate) fn map_chunks<R: Send>(
        &self,
        length: usize,
        chunk: usize,
        f: impl Fn(Range<usize>) -> R + Sync,
    ) -> Vec<R> {
        let range = |index: usize| index * chunk..((index + 1) * chunk).min(length);
        let chunks = length.div_ceil(chunk);
        match &self.pool {
            Some(pool) if chunks > 1 => {
                pool.install(|| (0..chunks).into_par_iter().map(|index| f(range(index))).collect())
            }
            _ => (0..chunks).map(|index| f(range(index))).collect(),
        }
    }

    /// Fills `a` and `b` with `f` of each index of `range`.
    pub(crate) fn unzip<A: Send, B: Send>(
        &self,
        range: Range<usize>,
        f: impl Fn(usize) -> (A, B) + Sync,
    ) -> (Vec<A>, Vec<B>) {
        // Below this, handing vertices over costs more than it saves.
        const LEAST: usize = 2048;
        let (mut a, mut b) = (Vec::new(), Vec::new());
        match &self.pool {
            Some(pool) if range.len() > LEAST => pool.install(|| {
                let items = range.into_par_iter().with_min_len(LEAST);
                items.map(&f).unzip_into_vecs(&mut a, &mut b);
            }),
            _ => (a, b) = range.map(&f).unzip(),
        }
        (a, b)
    }

    /// Works `items` off, each taken by whichever worker is free; every worker
    /// keeps a scratch of its own. Returns the scratches.
    pub(crate) fn consume<T: Send, S: Send>(
        &self,
        items: Vec<T>,
        scratch: impl Fn() -> S + Sync,
        f: impl Fn(&mut S, T) + Sync,
    ) -> Vec<S> {
        let Some(pool) = &self.pool else {
            let mut own = scratch();
            items.into_iter().for_each(|item| f(&mut own, item));
            return vec![own];
        };
        let queue = Mutex::new(items.into_iter());
        // A worker that panics takes the frame with it; until then the queue
        // itself is whole.
        let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
        pool.broadcast(|_| {
            let mut own = scratch();
            while let Some(item) = next() {
                f(&mut own, item);
            }
            own
        })
    }
}

/// The pool of this many threads; made at the first call, then kept.
fn pool_of(threads: NonZeroUsize) -> Option<Arc<ThreadPool>> {
    static POOLS: OnceLock<Mutex<HashMap<usize, Arc<ThreadPool>>>> = OnceLock::new();
    let pools = POOLS.get_or_init(Mutex::default);
    let mut pools = pools.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(pool) = pools.get(&threads.get()) {
        return Some(Arc::clone(pool));
    }
    // No threads to be had is no reason to draw nothing.
    let pool = ThreadPoolBuilder::new().num_threads(threads.get()).build().ok()?;
    let pool = Arc::new(pool);
    pools.insert(threads.get(), Arc::clone(&pool));
    Some(pool)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_does_not_depend_on_the_workers() {
        let three = ExecuteSettings { threads: NonZeroUsize::new(3), ..Default::default() };
        for workers in [Workers::alone(), Workers::new(&three)] {
            let sums = workers.map_chunks(10, 4, |range| range.sum::<usize>());
            assert_eq!(sums, [6, 22, 17], "chunks in order");
            let (a, b) = workers.unzip(0..5000, |i| (i, 2 * i));
            assert!(a.iter().zip(&b).enumerate().all(|(i, (&a, &b))| a == i && b == 2 * i), "all in order");
            let counts = workers.consume(vec![1_u32; 100], || 0, |sum, item| *sum += item);
            assert_eq!(counts.iter().sum::<u32>(), 100, "each item once");
        }
    }
}
