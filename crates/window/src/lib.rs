//! trigon-window
