//! Flags for the window alone.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::values;

/// Options of the window.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct WindowArgs {
    /// Reload the model when one of its files changes
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) watch: Option<bool>,

    /// Refine the image at rest, up to that of --preset=reference [default: true, unless --shading is given]
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) refine: Option<bool>,

    /// How drags rotate the model: default keeps it upright, trackball rotates freely
    #[arg(long, short = 'k', value_name = "STYLE", help_heading = "Window")]
    pub(crate) interaction_style: Option<InteractionStyle>,

    /// Scale text and widgets with the display; they always do
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch)]
    pub(crate) dpi_aware: Option<bool>,

    /// Record the window's input to a file, written when it is closed
    #[arg(
        long,
        alias = "interaction-test-record",
        value_name = "FILE",
        conflicts_with = "output",
        help_heading = "Window"
    )]
    pub(crate) interaction_record: Option<PathBuf>,

    /// Replay in the window what --interaction-record wrote
    #[arg(
        long,
        alias = "interaction-test-play",
        value_name = "FILE",
        conflicts_with = "output",
        help_heading = "Window"
    )]
    pub(crate) interaction_play: Option<PathBuf>,
}

/// How drags rotate the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum InteractionStyle {
    Default,
    /// Rotates freely
    Trackball,
}
