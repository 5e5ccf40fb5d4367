//! The remedy for most contradictions.

pub(super) const REMEDY: &str = "export the model again";
