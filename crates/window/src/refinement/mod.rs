//! Refinement at rest: first the image that the settings define, then better ones up to the
//! reference, and their difference.

mod difference;
mod gallery;
mod heat;
mod ladder;

use std::time::Duration;

pub use difference::Difference;
pub(crate) use difference::{Compared, compare, over_black};
pub(crate) use gallery::{Gallery, Wanted};
pub(crate) use heat::{CLASSES, Class};
pub(crate) use ladder::{ladder, wanted};

/// How far an image is refined at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Refinement {
    /// Only the image that the settings define.
    #[default]
    Settings,
    /// The image that the settings define, and then better ones up to the reference,
    /// [`Preset::Reference`](trigon_scene::quality::Preset::Reference) applied to these settings:
    /// the bytes of an image file with those. Each is shown when it is ready.
    Reference,
}

/// Whether the image that the settings define is compared with the reference at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Comparison {
    /// It is not compared.
    #[default]
    Off,
    /// [`Stage::quality_report`](crate::Stage::quality_report) has the figures.
    Measured,
    /// Their difference is shown instead, as a heat map with a legend.
    Shown,
}

/// The times of the scene's images at rest, and their difference.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct QualityReport {
    /// The time of the image that the settings define.
    pub settings: Duration,
    /// The time of the best image, if there is a better one yet.
    pub best: Option<Duration>,
    /// Between that of the settings and the reference, once they were compared.
    pub difference: Option<Difference>,
}
