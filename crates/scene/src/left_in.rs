//! Lets tests draw what cannot be seen, to compare the image with the one without it.

/// Whether what cannot be seen is drawn all the same: only in tests, which compare both images.
pub(crate) fn keeps_unseen() -> bool {
    #[cfg(test)]
    return kept::KEPT.get();
    #[cfg(not(test))]
    false
}

#[cfg(test)]
pub(crate) mod kept {
    //! Draws what cannot be seen, on the thread that asks for it.

    use std::cell::Cell;

    thread_local! {
        pub(super) static KEPT: Cell<bool> = const { Cell::new(false) };
    }

    /// Calls a function while nothing is left out.
    pub(crate) fn with_everything<T>(draw: impl FnOnce() -> T) -> T {
        KEPT.set(true);
        let drawn = draw();
        KEPT.set(false);
        drawn
    }
}
