//! Flags of the window alone.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::values;

/// What the window does beside showing models.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct WindowArgs {
    /// Load the model again whenever one of its files changes
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) watch: Option<bool>,

    /// Go on drawing at rest, better and better up to what --preset=reference gives [default: true, unless --shading says otherwise]
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) refine: Option<bool>,

    /// How drags turn the model: default keeps it upright, trackball tips it over
    #[arg(long, short = 'k', value_name = "STYLE", help_heading = "Window")]
    pub(crate) interaction_style: Option<InteractionStyle>,

    /// Text and widgets follow the display's scale; they always do.
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch)]
    pub(crate) dpi_aware: Option<bool>,

    /// Write what is done to the window to a file when it is closed
    #[arg(
        long,
        alias = "interaction-test-record",
        value_name = "FILE",
        conflicts_with = "output",
        help_heading = "Window"
    )]
    pub(crate) interaction_record: Option<PathBuf>,

    /// Do to the window what --interaction-record wrote
    #[arg(
        long,
        alias = "interaction-test-play",
        value_name = "FILE",
        conflicts_with = "output",
        help_heading = "Window"
    )]
    pub(crate) interaction_play: Option<PathBuf>,
}

/// How drags turn the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum InteractionStyle {
    Default,
    /// Tips it over, too
    Trackball,
}
