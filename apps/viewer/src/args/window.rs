//! Flags of the window alone.

use std::path::PathBuf;

use clap::Args;

use super::values;

/// What the window does beside showing models.
#[derive(Args, Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct WindowArgs {
    /// Load the model again whenever one of its files changes
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) watch: Option<bool>,

    /// Go on drawing at rest, better and better up to what --preset=reference gives (not in F3D) [default: true, unless --shading says otherwise]
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) refine: Option<bool>,

    /// Write what is done to the window to a file when it is closed
    #[arg(long, value_name = "FILE", conflicts_with = "output", help_heading = "Window")]
    pub(crate) interaction_record: Option<PathBuf>,

    /// Do to the window what --interaction-record wrote
    #[arg(long, value_name = "FILE", conflicts_with = "output", help_heading = "Window")]
    pub(crate) interaction_play: Option<PathBuf>,
}
