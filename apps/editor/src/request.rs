//! What panels, keys and tools ask the editor to do. They change nothing by themselves.

use trigon_edit::{Command, MaterialName, TextureSlot};
use trigon_window::{Comparison, Refinement};

/// One thing to be done. The editor does them in order, after the interface was laid out.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Request {
    /// Run a command.
    Run(Command),
    /// Run a command in place of the last one.
    Adjust(Command),
    /// Ask for a picture file and assign it to a material.
    ChooseTexture {
        /// Which material.
        material: MaterialName,
        /// What the picture says.
        slot: TextureSlot,
    },
    /// Compare the picture at rest with the reference, or stop it.
    Compare(Comparison),
    /// Refine the picture at rest so far.
    Refine(Refinement),
}
