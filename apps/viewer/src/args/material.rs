//! Flags that change the model's materials and geometry.

use std::path::PathBuf;

use trigon_math::Vec3;
use trigon_math::glam::Affine2;

use super::values;

/// Flags for materials.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct MaterialArgs {
    /// Colour of the model; tints its textures
    #[arg(long, value_name = "COLOR", value_parser = values::color, help_heading = "Material")]
    pub(crate) color: Option<Vec3>,

    /// Opacity of the model, 0 to 1 or 0% to 100%
    #[arg(long, value_name = "RATIO", value_parser = values::unit_ratio, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) opacity: Option<f32>,

    /// Roughness of the model, 0 (a mirror) to 1 (matt); multiplies its textures
    #[arg(long, value_name = "RATIO", value_parser = values::unit_ratio, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) roughness: Option<f32>,

    /// Metalness of the model, 0 to 1; multiplies its textures
    #[arg(long, value_name = "RATIO", value_parser = values::unit_ratio, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) metallic: Option<f32>,

    /// Index of refraction of the model, 1 to 2.5; determines its reflectance
    #[arg(long, value_name = "INDEX", value_parser = values::refraction, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) base_ior: Option<f32>,

    /// Colour of the light that the model emits; multiplies its emissive texture
    #[arg(long, value_name = "COLOR", value_parser = values::bright_color, help_heading = "Material")]
    pub(crate) emissive_factor: Option<Vec3>,

    /// Strength of normal maps
    #[arg(long, value_name = "FACTOR", value_parser = values::factor, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) normal_scale: Option<f32>,

    /// A texture for the colours of the model; an empty name removes the model's own
    #[arg(long, value_name = "FILE", help_heading = "Material")]
    pub(crate) texture_base_color: Option<PathBuf>,

    /// A texture for occlusion (red), roughness (green) and metalness (blue)
    #[arg(long, value_name = "FILE", help_heading = "Material")]
    pub(crate) texture_material: Option<PathBuf>,

    /// A texture for the light that the model emits
    #[arg(long, value_name = "FILE", help_heading = "Material")]
    pub(crate) texture_emissive: Option<PathBuf>,

    /// A normal map
    #[arg(long, value_name = "FILE", help_heading = "Material")]
    pub(crate) texture_normal: Option<PathBuf>,

    /// Transform all textures: scale:S,T;translation:S,T;angle:DEGREES in any order, or nine
    /// numbers
    #[arg(long, value_name = "TRANSFORM", value_parser = values::transform, allow_hyphen_values = true, help_heading = "Material")]
    pub(crate) textures_transform: Option<Affine2>,

    /// Show a checkerboard instead of the model's colours
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Material")]
    pub(crate) checkerboard: Option<bool>,

    /// Show the model's colours without lighting
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Material")]
    pub(crate) unlit: Option<bool>,

    /// Show the model's vertices instead of its faces
    #[arg(long, short = 'o', num_args = 0..=1, require_equals = true, default_missing_value = "sphere", value_name = "KIND", help_heading = "Material")]
    pub(crate) point_sprites: Option<PointSprites>,

    /// Diameter of these points in thousandths of the model's size
    #[arg(long, value_name = "SIZE", default_value = "10", value_parser = values::line_width, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) point_sprites_size: f32,

    /// Measure this diameter in the model's own unit
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Material")]
    pub(crate) point_sprites_absolute_size: Option<bool>,

    /// Diameter in pixels of points in the file (3, and less in dense clouds)
    #[arg(long, value_name = "PIXELS", value_parser = values::line_width, allow_negative_numbers = true, help_heading = "Material")]
    pub(crate) point_size: Option<f32>,
}

/// How vertices are shown instead of faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum PointSprites {
    None,
    /// Balls
    Sphere,
}
