//! The panels: functions of the document and their own state, which change nothing and return
//! requests.
//!
//! `outliner` lists the objects. `properties`, `information`, `add` and `development` are the tabs; the
//! history is part of the second. `adjust` shows it, and the parameters of the last command; their widgets
//! are generated from the schema of the commands (`form` describes them, `parameters` shows them), so a new
//! command needs no code here for its panel.

mod add;
mod adjust;
mod development;
mod form;
mod information;
mod outliner;
mod parameters;
mod properties;
mod row;
mod spatial;
#[cfg(test)]
mod testing;
mod unit;

pub(crate) use add::{AddState, add};
pub(crate) use adjust::{adjust, history};
pub(crate) use development::{DevelopmentState, DrawnView, development};
pub(crate) use information::{InformationState, information};
pub(crate) use outliner::{OutlinerState, outliner};
pub(crate) use properties::{PropertiesState, properties};
pub(crate) use row::{rejected_number, select_all_at_first, written};

use trigon_document::Document;

use crate::up::Up;

/// What panels show.
#[derive(Clone, Copy)]
pub(crate) struct ShownDocument<'d> {
    pub(crate) document: &'d Document,
    /// In which axes positions, directions and rotations are shown and typed.
    pub(crate) up: Up,
}
