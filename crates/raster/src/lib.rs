//! trigon-raster
