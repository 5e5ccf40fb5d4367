//! Flags for objects shown with the model: grid, axes, normals, bones, and text.

use trigon_math::Vec3;

use super::values;

/// Flags for objects shown with the model.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct SceneryArgs {
    /// Show the axis directions in a corner
    #[arg(long, short = 'x', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) axis: Option<bool>,

    /// Colour of the X axis
    #[arg(long, value_name = "COLOR", default_value = "#f94306", value_parser = values::color, help_heading = "Scenery")]
    pub(crate) x_color: Vec3,

    /// Colour of the Y axis
    #[arg(long, value_name = "COLOR", default_value = "#4db34d", value_parser = values::color, help_heading = "Scenery")]
    pub(crate) y_color: Vec3,

    /// Colour of the Z axis
    #[arg(long, value_name = "COLOR", default_value = "#3b7dd8", value_parser = values::color, help_heading = "Scenery")]
    pub(crate) z_color: Vec3,

    /// Show a grid below the model
    #[arg(long, short = 'g', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) grid: Option<bool>,

    /// Side of the grid's squares in metres [default: a power of ten that suits the model]
    #[arg(long, value_name = "LENGTH", value_parser = values::length, allow_negative_numbers = true, help_heading = "Scenery")]
    pub(crate) grid_unit: Option<f64>,

    /// Subdivisions of each of those squares; 1 for none
    #[arg(long, value_name = "N", default_value = "10", value_parser = values::count::<1, 100>, allow_negative_numbers = true, help_heading = "Scenery")]
    pub(crate) grid_subdivisions: u32,

    /// Colour of the grid
    #[arg(long, value_name = "COLOR", default_value = "0,0,0", value_parser = values::color, help_heading = "Scenery")]
    pub(crate) grid_color: Vec3,

    /// Put the grid at the origin instead of below the model
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) grid_absolute: Option<bool>,

    /// Show vertex normals as lines
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) normal_glyphs: Option<bool>,

    /// Length of those lines; 1 is a fiftieth of the model
    #[arg(long, value_name = "RATIO", default_value = "1", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Scenery")]
    pub(crate) normal_glyphs_scale: f32,

    /// Show the bones of the model
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) armature: Option<bool>,

    /// Write the file's name over the image
    #[arg(long, short = 'n', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) filename: Option<bool>,

    /// Write counts and sizes over the image
    #[arg(long, short = 'm', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) metadata: Option<bool>,

    /// Show the scene as a tree: in the window a panel to hide, show and select nodes, in images their names
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) scene_hierarchy: Option<bool>,

    /// Write the name of the --hdri-file over the image
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Scenery")]
    pub(crate) hdri_filename: Option<bool>,

    /// Show the frame time in the window
    #[arg(long, short = 'z', num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) fps: Option<bool>,

    /// Show messages about keys in the window [default: true]
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Window")]
    pub(crate) notifications: Option<bool>,

    /// Text size
    #[arg(long, value_name = "RATIO", default_value = "1", value_parser = values::text_scale, allow_negative_numbers = true, help_heading = "Scenery")]
    pub(crate) font_scale: f32,
}
