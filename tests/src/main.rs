//! The workspace tests, one module per subject.

mod camera;
mod clipping;
mod corpus;
mod coverage;
mod coverage_lines;
mod coverage_support;
mod depth;
mod effort;
mod goldens;
mod interpolation;
mod same_bytes;
mod scene;
mod triangulation;
