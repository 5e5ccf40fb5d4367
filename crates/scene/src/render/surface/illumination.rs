//! Whether a surface is lit per face, per vertex or per pixel, or shows a value instead.

use crate::display::Display;

/// Where light is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Illumination {
    /// It does not matter.
    None,
    /// At the vertices, and interpolated (H. Gouraud, "Continuous Shading of Curved
    /// Surfaces", 1971).
    AtVertices,
    /// At each pixel, for an interpolated normal (B. T. Phong, "Illumination for
    /// Computer Generated Pictures", 1975).
    InPixels,
    /// Once for each triangle, in its middle.
    OnFacets,
    /// Nowhere: surfaces show one of their values.
    Value(Display),
}
