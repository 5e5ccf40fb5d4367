//! trigon-camera
