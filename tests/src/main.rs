//! The workspace tests, one module per subject.

mod camera;
mod clipping;
