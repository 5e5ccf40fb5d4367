//! The rows that the page sums up, and the settings in their tables.

use super::super::chapter::Row;
use super::super::chapters::frames::{RMSE, Sweep, TIME};
use super::super::header::Header;
use crate::frames::FrameCase;

/// All rows that the page sums up.
pub(in crate::report) struct Recorded<'a> {
    pub(in crate::report) header: &'a Header,
    pub(in crate::report) frames: &'a [Row],
    pub(in crate::report) effects: &'a [Row],
    pub(in crate::report) line: &'a [Row],
    pub(in crate::report) rivals: &'a [Row],
}

impl Recorded<'_> {
    /// The scenes at both sizes.
    pub(super) fn sweeps(&self) -> [Sweep; 2] {
        let size = |of: &dyn Fn([u32; 2]) -> Sweep| {
            let case = of([1, 1]).case(FrameCase::Showcase);
            let row = self.frames.iter().find(|row| row.case == case);
            of(row.map_or([1, 1], |row| row.conditions.resolution.map(|side| side as u32)))
        };
        [size(&Sweep::small), size(&Sweep::large)]
    }
}

/// A setting, with its time and its error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setting {
    pub(super) name: String,
    pub(super) time: f64,
    /// Between which times half of the runs lay.
    pub(super) quartiles: Option<[f64; 2]>,
    pub(super) error: f64,
}

/// The settings of a table.
pub(super) fn settings(rows: &[Row], case: &str) -> Vec<Setting> {
    let setting = |row: &Row| {
        Some(Setting {
            name: row.variant.clone(),
            time: row.value(TIME)?,
            quartiles: row.quartiles(TIME),
            error: row.value(RMSE)?,
        })
    };
    rows.iter().filter(|row| row.case == case).filter_map(setting).collect()
}

/// The most accurate setting within a time.
pub(super) fn best_within(settings: &[Setting], milliseconds: f64) -> Option<&Setting> {
    let fits = settings.iter().filter(|setting| setting.time <= milliseconds);
    fits.min_by(|one, other| one.error.total_cmp(&other.error))
}
