//! What is drawn while nothing moves: first the picture as the settings say, then better
//! ones up to the reference, and what lies between the two.

mod difference;
mod gallery;
mod heat;
mod ladder;

use std::time::Duration;

pub use difference::Difference;
pub(crate) use difference::{Compared, compare, over_black};
pub(crate) use gallery::{Gallery, Wanted};
pub(crate) use heat::CLASSES;
pub(crate) use ladder::{ladder, wanted};

/// How far a picture is refined at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Refinement {
    /// It is drawn as the settings say.
    #[default]
    Settings,
    /// It is drawn as the settings say, and then better and better up to the reference,
    /// [`Preset::Reference`](trigon_scene::quality::Preset::Reference) on top of these settings: the
    /// bytes of a picture file with those. Each is shown when it is ready.
    Reference,
}

/// Whether the picture that the settings give is compared with the reference at rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Comparison {
    /// It is not.
    #[default]
    Off,
    /// [`Stage::quality_report`](crate::Stage::quality_report) has the figures.
    Measured,
    /// Their difference is shown in place of either, as a heat map with a legend.
    Shown,
}

/// What the pictures of the scene at rest took, and how far they are apart.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct QualityReport {
    /// What the picture took that the settings give.
    pub settings: Duration,
    /// What the best one took that is better, if there is one yet.
    pub best: Option<Duration>,
    /// Between that of the settings and the reference, once they were compared.
    pub difference: Option<Difference>,
}
