//! Tests of trigon-mesh by its public face, one module per subject.

mod building;
mod changes;
mod deform;
mod normals;
mod outlines;
mod primitives;
mod rendering;
mod tangents;
mod teapot;
mod transform;
mod triangulation;
