//! trigon-math
