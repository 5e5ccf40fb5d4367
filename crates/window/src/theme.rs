//! Whether the interface is light or dark.

use serde::{Deserialize, Serialize};

/// Whether panels are light or dark.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Theme {
    /// As the system has it; dark where it does not say.
    #[default]
    System,
    /// Light text on dark panels.
    Dark,
    /// Dark text on light panels.
    Light,
}
