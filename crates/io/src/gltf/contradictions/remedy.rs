//! What helps against most contradictions.

pub(super) const REMEDY: &str = "export the model again";
