//! Addresses that stand for the specifications.

/// The namespace of the core specification.
pub(super) const CORE: &str = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
/// The namespace of materials and properties.
pub(super) const MATERIAL: &str = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
/// The namespace of the production extension.
pub(super) const PRODUCTION: &str = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
/// The type of the relationship that leads to the model.
pub(super) const MODEL_TYPE: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
