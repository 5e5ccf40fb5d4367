//! The command line, in two steps: [`RawArgs`] holds the flags as typed; [`Request`] is their
//! combined meaning.

mod animation;
mod batch;
mod beside;
mod change;
mod config;
mod effects;
#[cfg(feature = "window")]
mod flags;
mod gpu;
mod help;
mod job;
mod line;
mod material;
mod names;
mod output;
mod placed_node;
mod quality;
mod raw;
mod request;
mod scenery;
mod script;
mod values;
mod window;
mod words;

#[cfg(feature = "window")]
pub(crate) use animation::AnimationProgress;
pub(crate) use batch::{BatchArgs, Shard};
pub(crate) use beside::{Beside, Format};
#[cfg(feature = "window")]
pub(crate) use config::KeyBinding;
pub(crate) use effects::Explanation;
#[cfg(feature = "window")]
pub(crate) use flags::{DECIDED, of_settings};
pub(crate) use help::short as short_help;
pub(crate) use job::Job;
pub(crate) use line::{CommandLine, plain};
#[cfg(feature = "window")]
pub(crate) use names::flag as flag_named;
pub(crate) use output::{Destination, Subject, Template};
pub(crate) use placed_node::PlacedNode;
pub(crate) use quality::Limit;
pub(crate) use raw::{CheckPurpose, HelpLength, RawArgs};
pub(crate) use request::{Mode, Reference, Request, STDIN};
pub(crate) use script::{Step, steps};
#[cfg(feature = "window")]
pub(crate) use script::{split, step};
#[cfg(feature = "window")]
pub(crate) use window::InteractionStyle;
