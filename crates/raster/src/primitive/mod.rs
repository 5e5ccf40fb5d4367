//! Triangles, lines and points on the sub-pixel grid: their records, and what coverage and depth follow from.
//!
//! | file | what it holds |
//! |---|---|
//! | `triangle` | the record of a triangle |
//! | `quad` | the record of a line or a point: a quadrilateral of two triangles |
//! | `columns` | eight triangles in lanes, their vertices sorted; the limit of small triangles |
//! | `stroke` | how much of a pixel an anti-aliased line or point covers |
//! | `edge` | edge functions in i64, and **the top-left rule** (`Edge::bias`, `owns_boundary`) |
//! | `depth` | the plane of a triangle's depths |
//!
//! `triangle`, and `columns` for eight at a time, sort the vertices of a triangle by (y, x) before anything is
//! computed from them. So no result depends on the order in which corners are listed.

mod columns;
mod depth;
mod edge;
mod quad;
mod stroke;
mod triangle;

pub(crate) use columns::{Column, SMALL, small_lanes, sorted_columns};
pub(crate) use depth::DepthPlane;
pub(crate) use edge::{Edge, owns_boundary};
pub(crate) use quad::{DetailIndex, Ends, Quad, QuadDetail};
pub(crate) use stroke::{Form, Stroke};
pub(crate) use triangle::{Corners, CutWeights, Kind, SetupTriangle, sorted};
