//! The workspace tests, one module per subject.

mod camera;
mod goldens;
mod scene;
mod clipping;
mod triangulation;
mod coverage;
mod coverage_support;
mod depth;
mod interpolation;
mod same_bytes;
mod corpus;
