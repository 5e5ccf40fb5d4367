//! trigon-io
