//! The operations, a file each: what a user of a modeller calls by a name.
//!
//! Each is a method of [`EditMesh`](super::EditMesh) that takes ids and parameters, in time
//! proportional to what it changes, and returns what it made. Ids that are given twice count once.
//! A refusal leaves the mesh as it was.

mod bevel;
mod delete;
mod knife;
mod loop_cut;
mod slide;

pub use bevel::{BevelLeftOut, BevelSettings, Beveled};
pub use knife::{KnifeCut, KnifePoint};
pub use loop_cut::{LoopCut, LoopCutSettings};
