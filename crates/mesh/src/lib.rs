//! trigon-mesh
