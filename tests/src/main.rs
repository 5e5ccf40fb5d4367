//! The workspace tests, one module per subject.

mod blending;
mod camera;
mod certify;
mod clipping;
mod corpus;
mod coverage;
mod coverage_lines;
mod coverage_support;
mod depth;
mod effort;
mod explain;
mod goldens;
mod interpolation;
mod manifest;
mod masks;
mod multisampling;
mod paint2d;
mod pipelines;
mod programs;
mod same_bytes;
mod scene;
mod scissor;
mod simd_levels;
mod smooth_lines;
mod targets;
mod triangulation;
