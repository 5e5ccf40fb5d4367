//! Homogeneous clipping: what `trigon_math::clip` promises, on random, hostile
//! and exhaustive input, against exact rationals.
//!
//! Hard cases 15 to 20. `input` makes the triangles, `check` states properties
//! once; the other modules apply them.

mod area;
mod check;
mod edges;
mod input;
mod near_zero;
mod outcodes;
mod vertices;
