//! Triangles, lines and points on the sub-pixel grid: their records, and what coverage and depth follow from.
//!
//! | file | what it holds |
//! |---|---|
//! | `triangle` | the record of a triangle; eight triangles in lanes, their vertices sorted; the limit of small triangles |
//! | `quad` | the record of a line or a point: a quadrilateral of two triangles; how much of a pixel it covers if it is anti-aliased |
//! | `planes` | edge functions in i64, and **the top-left rule** (`Edge::bias`, `owns_boundary`); the plane of a triangle's depths |
//!
//! `triangle` sorts the vertices of a triangle by (y, x) before anything is
//! computed from them. So no result depends on the order in which corners are listed.

mod planes;
mod quad;
mod triangle;

pub(crate) use planes::{DepthPlane, Edge, owns_boundary};
pub(crate) use quad::{DetailIndex, Ends, Form, Quad, QuadDetail, Stroke};
pub(crate) use triangle::{
    Column, Corners, CutWeights, Kind, SMALL, SetupTriangle, small_lanes, sorted, sorted_columns,
};
