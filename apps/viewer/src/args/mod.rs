//! The command line, in two steps: [`RawArgs`] is what was typed, flag by flag;
//! [`Request`] is what it means as a whole.

mod beside;
mod effects;
mod output;
mod quality;
mod raw;
mod request;
mod values;
mod window;

pub(crate) use beside::{Beside, Format};
pub(crate) use effects::Explanation;
pub(crate) use output::Destination;
#[cfg(feature = "window")]
pub(crate) use output::Template;
pub(crate) use quality::Limit;
pub(crate) use raw::{Command, RawArgs};
pub(crate) use request::{Grouping, Mode, Request, STDIN};
