//! Why a window cannot be opened.

/// A window cannot be opened, or cannot continue.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum WindowError {
    /// No display: a server, a container, or a session without graphics.
    #[error(
        "there is no display to open a window on ({reason}); on Linux, DISPLAY or WAYLAND_DISPLAY must be set"
    )]
    NoDisplay {
        /// The window system's message.
        reason: String,
    },
    /// The window system allows one event loop per process, which was already used.
    #[error("this process has already run an application; only one window can be opened per process")]
    SecondRun,
    /// The display refused to open a window.
    #[error("the window system refused to open a window: {reason}")]
    Window {
        /// The window system's message.
        reason: String,
    },
    /// The window cannot display images.
    #[error("the window cannot show images: {reason}")]
    Surface {
        /// The window system's message.
        reason: String,
    },
    /// The connection to the window system broke.
    #[error("the window system has ended the connection: {reason}")]
    Disconnected {
        /// The window system's message.
        reason: String,
    },
}

impl std::fmt::Debug for WindowError {
    /// The error message that a `main` returning this error shows to its user.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{self}")
    }
}
