//! Whether a surface is lit per face, per vertex or per pixel, or shows a value instead.

use crate::display::Display;

/// Where light is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Illumination {
    /// There is no light.
    None,
    /// At the vertices, and interpolated (H. Gouraud, "Continuous Shading of Curved
    /// Surfaces", 1971).
    AtVertices,
    /// In each pixel, for an interpolated normal (B. T. Phong, "Illumination for Computer Generated
    /// Pictures", 1975).
    InPixels,
    /// Once for each triangle, at its centre.
    OnFacets,
    /// Nowhere: surfaces show one of their values.
    Value(Display),
}
