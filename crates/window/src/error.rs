//! Why there is no window.

/// A window cannot be opened, or cannot go on.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum WindowError {
    /// No display: a server, a container, or a session without graphics.
    #[error(
        "there is no display to open a window on ({reason}); on Linux, DISPLAY or WAYLAND_DISPLAY must be set"
    )]
    NoDisplay {
        /// What the window system said.
        reason: String,
    },
    /// The window system allows one event loop per process, and it was used.
    #[error("this process has already run an application; only one window can be opened per process")]
    SecondRun,
    /// The display refused a window.
    #[error("the window system refused to open a window: {reason}")]
    Window {
        /// What the window system said.
        reason: String,
    },
    /// The window refused pictures.
    #[error("the window cannot show images: {reason}")]
    Surface {
        /// What the window system said.
        reason: String,
    },
    /// The connection to the window system broke.
    #[error("the window system has ended the connection: {reason}")]
    Disconnected {
        /// What the window system said.
        reason: String,
    },
}

impl std::fmt::Debug for WindowError {
    /// The message: what a `main` that returns this error shows its user.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")
    }
}
