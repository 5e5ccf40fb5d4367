//! The flags as typed: one field per flag, parsed but not yet combined. `Request` is their combined
//! meaning.
//!
//! Names and defaults follow F3D (<https://f3d.app>), so that its users and
//! their scripts feel at home.

use std::path::PathBuf;

use clap::{ArgAction, Parser, ValueEnum};
use regex_lite::Regex;
use trigon_camera::{UpAxis, Viewport};
use trigon_io::{Format, SceneChoice};
use trigon_math::{DVec3, Vec3};
use trigon_scene::{Display, SimdLevel};

use super::animation::AnimationArgs;
use super::beside::Beside;
use super::effects::EffectArgs;
use super::gpu::GpuOnly;
use super::material::MaterialArgs;
use super::output::{Destination, Template};
use super::placed_node::PlacedNode;
use super::quality::QualityArgs;
use super::scenery::SceneryArgs;
use super::values;
use super::window::WindowArgs;
use crate::exact_camera::ExactCamera;
use crate::framing::Turn;
use crate::report::Level;

pub(crate) const AFTER_HELP: &str = "\
Exit codes:
  0  success
  1  a model could not be loaded or drawn, or an image could not be written
  2  the command line is invalid
  3  an image differs from the one that --reference or --replay names

Values:
  COLOR      1,0.5,0 | #f80 | #ff8800 | a CSS name or function such as orange
  DIRECTION  +X | -y+z | 1,0,-0.5
  POINT      1,2.5,-3 (metres)
  angles are degrees; colours are sRGB
  switches take --edges, --edges=false, =true, =on, =off, =1, =0

Examples:
  trigon-viewer                                   show the built-in scene
  trigon-viewer chair.glb                         show a model
  trigon-viewer chair.glb --output chair.png      write an image, no display needed
  trigon-viewer *.obj --output '{model}.png'      an image of each
  trigon-viewer batch jobs.jsonl --resume         draw a list of jobs; see trigon-viewer batch --help
  trigon-viewer chair.glb --view=top --output - | other-program";

/// What a model is checked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CheckPurpose {
    /// To be looked at.
    Show,
    /// To be printed: it has to enclose a volume.
    Print,
}

/// What `--check` asks for; `None` is `--check=false`.
pub(crate) type Check = Option<CheckPurpose>;

/// Show 3D models, or render them to image files. No GPU is needed, and no display for image files.
///
/// Without --output a window opens; press H for its keys. With --output an image is written
/// instead. Without FILES the built-in scene is shown.
#[derive(Debug, Parser)]
#[command(name = "trigon-viewer", version, after_long_help = AFTER_HELP, disable_help_flag = true)]
#[command(args_override_self = true, max_term_width = 100)]
pub(crate) struct RawArgs {
    /// Models to show: OBJ, glTF, GLB, PLY, STL, OFF, 3MF (see --list-readers); - is standard input, if an image
    /// is written
    #[arg(value_name = "FILES")]
    pub(crate) files: Vec<PathBuf>,

    /// A model to show, in F3D's spelling; the same as naming it without the flag
    #[arg(long, value_name = "FILE", action = ArgAction::Append, hide = true)]
    pub(crate) input: Vec<PathBuf>,

    /// Write an image instead of opening a window (PNG, JPEG, WebP, OpenEXR); - is a PNG on standard output
    ///
    /// A file is complete or not written at all. Symbolic links are followed, and a write-protected file is refused.
    /// JPEG has no alpha: transparent areas become white. OpenEXR holds linear light, premultiplied with
    /// alpha, before exposure and tone mapping. The name may contain {model} (the file's name without its
    /// extension), {model.ext} (with it), {model_ext} (the extension), {n:3} (the first number whose file
    /// does not exist yet, padded to three digits), {app}, {version}, {date} and {date:%H%M} (UTC); {{x}}
    /// stands for {x} itself. With {frame} or {frame:4} each frame of an animation becomes an image, at
    /// --frame-rate, from --animation-time on. A name that ends in .gif or .apng holds them all, and those of
    /// --turntable.
    #[arg(long, value_name = "FILE|-", help_heading = "Files")]
    pub(crate) output: Option<Destination>,

    /// Also write these outputs: depth, normals and others, separated by commas
    ///
    /// The outputs are color, radiance (linear light, premultiplied), depth (metres along the view axis),
    /// object-ids, face-ids, material-ids, triangle-ids, barycentrics, positions, normals, geometric-normals,
    /// uvs and albedo. With --output chair.exr they are channels of that file. With --output chair.png each
    /// becomes a NumPy array next to it: depth goes to chair.depth.npy. Depth, ids and normals can be 16-bit
    /// PNG files instead: depth.png goes to chair.depth.png, in millimetres. Positions are relative to what
    /// chair.positions-origin.npy holds, the attribute P.origin of an OpenEXR file and positions_origin of
    /// --json: zero, but for models far away from the origin.
    #[arg(
        long,
        value_name = "NAME,...",
        value_delimiter = ',',
        requires = "output",
        conflicts_with = "replay",
        help_heading = "Files"
    )]
    pub(crate) outputs: Vec<Beside>,

    /// Write scene, camera, settings and image to one file, to draw it again elsewhere
    ///
    /// Nothing else is needed to draw it again, which makes it useful for bug reports and tests.
    /// With --output the image is written, too.
    #[arg(long, value_name = "FILE.trigon", help_heading = "Files")]
    pub(crate) capture: Option<PathBuf>,

    /// Draw what --capture wrote and check that the image is identical; exit code 3 if not
    ///
    /// With --output the new image is written. --threads and --simd may be given; everything else
    /// is as captured.
    #[arg(long, value_name = "FILE.trigon", help_heading = "Files", conflicts_with_all = ["files", "input", "capture"])]
    pub(crate) replay: Option<PathBuf>,

    /// Width and height of the image or window in pixels; 1000x600 works too
    #[arg(long, value_name = "W,H", default_value = "1000,600", value_parser = values::size, help_heading = "Files")]
    pub(crate) resolution: Viewport,

    /// With several files: one at a time, or all in one scene
    ///
    /// In a window, single starts with the first; the arrow keys switch files. With --output,
    /// single writes one image per file and needs {model} or a number such as {n:1} in the name.
    #[arg(long, value_name = "MODE", default_value = "single", help_heading = "Files")]
    pub(crate) multi_file_mode: MultiFileMode,

    /// Show files together whose names differ only in the groups of this regular expression
    #[arg(long, value_name = "REGEX", value_parser = values::regex, conflicts_with = "multi_file_mode", help_heading = "Files")]
    pub(crate) multi_file_regex: Option<Regex>,

    /// Include models in subfolders
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) recursive_dir_add: Option<bool>,

    /// Skip files with nothing to draw
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) remove_empty_file_groups: Option<bool>,

    /// Refuse files larger than this many MiB; a negative number means no limit
    #[arg(long, value_name = "MIB", value_parser = values::mebibytes, allow_negative_numbers = true, help_heading = "Files")]
    pub(crate) max_size: Option<u64>,

    /// Compare the image with this one: exit code 3 if they differ too much
    ///
    /// With --output the image is written only in that case, and a map of the differences next to
    /// it (chair.diff.png). If the file to compare with does not exist, the image is written, so
    /// that it can become the reference, and the exit code is 3, too.
    #[arg(long, value_name = "FILE.png", conflicts_with_all = ["replay", "turntable"], help_heading = "Files")]
    pub(crate) reference: Option<PathBuf>,

    /// Show this model beside the other one, with one camera for both: side by side, in turn (B), or where they differ (Shift+B)
    ///
    /// With --output both are written beside each other, and beside a map of their differences; the exit code is 3 if
    /// any pixel differs. docs/viewer.md has the two lines that make it a tool for git difftool.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["replay", "capture", "reference", "turntable", "outputs"], help_heading = "Files")]
    pub(crate) compare: Option<PathBuf>,

    /// The largest error allowed: 0 for identical images, 0.04 for hardly visible differences
    #[arg(long, value_name = "ERROR", default_value = "0.04", value_parser = values::share, allow_negative_numbers = true, help_heading = "Files")]
    pub(crate) reference_threshold: f64,

    /// List faults of the files instead of drawing them: exit code 1 if there are any errors; =print also takes for an error what keeps a model from being printed
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "WHAT", value_parser = values::check, conflicts_with_all = ["output", "capture", "replay"], help_heading = "Files")]
    pub(crate) check: Option<Check>,

    /// Say why this pixel looks as it does: all triangles that touch it, and which of them is visible; columns and rows count from 0
    ///
    /// For each sample of the pixel: the triangles whose bounding box holds it, the exact values of their edge
    /// functions (in 1/65536 square pixels, twice the area), their depths, and which of them is visible and why.
    #[arg(long, value_name = "X,Y", value_parser = values::pixel, conflicts_with_all = ["output", "capture", "replay", "check", "explain"], help_heading = "Files")]
    pub(crate) explain_pixel: Option<[u32; 2]>,

    /// The name of the window's screenshots, with the variables of --output
    #[arg(long, value_name = "FILE", value_parser = super::output::image_name, default_value = "{model}_{n}.png", help_heading = "Window")]
    pub(crate) screenshot_filename: Template,

    /// Load the files and print what is in them, but draw nothing
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) no_render: Option<bool>,

    /// The scene to show from a file with several, by number from 0 or by name [default: the file's own
    /// choice]
    #[arg(long, value_name = "N|NAME", value_parser = values::scene, help_heading = "Files")]
    pub(crate) scene: Option<SceneChoice>,

    /// The variant of the materials to show from a file with several, by name [default: the file's own choice]
    #[arg(long, value_name = "NAME", help_heading = "Files")]
    pub(crate) variant: Option<String>,

    /// The axis of the model that points up; sky, grid and view follow it [default: +Z for STL and 3MF, +Y for others]
    ///
    /// So do the environment and what metals mirror; coordinates and the
    /// file's own lamps and cameras stay as they are. Files shown together have the axis of the first: a file
    /// whose format has another one is turned, unless this flag is given.
    #[arg(long, value_name = "DIRECTION", value_parser = values::up, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) up: Option<UpAxis>,

    /// Look from a named side
    #[arg(long, value_name = "SIDE", help_heading = "Camera", conflicts_with_all = ["camera_direction", "camera_position"])]
    pub(crate) view: Option<View>,

    /// Direction in which the camera looks; the model is fitted into the image [default: -1,-0.5,-1 for +Y
    /// up]
    #[arg(long, value_name = "DIRECTION", value_parser = values::direction, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_direction: Option<DVec3>,

    /// Position of the camera; overrides direction and zoom
    #[arg(long, value_name = "POINT", value_parser = values::point, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_position: Option<DVec3>,

    /// The point that the camera looks at [default: the middle of the model]
    #[arg(long, value_name = "POINT", value_parser = values::point, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_focal_point: Option<DVec3>,

    /// The upward direction in the image [default: --up]
    #[arg(long, value_name = "DIRECTION", value_parser = values::direction, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_view_up: Option<DVec3>,

    /// Vertical field of view, in degrees
    #[arg(long, value_name = "DEGREES", default_value = "30", value_parser = values::view_angle, allow_negative_numbers = true, help_heading = "Camera")]
    pub(crate) camera_view_angle: f64,

    /// The fraction of the image that the model fills: 0.9 leaves a margin of a tenth
    #[arg(long, value_name = "FACTOR", default_value = "0.9", value_parser = values::zoom, allow_negative_numbers = true, help_heading = "Camera")]
    pub(crate) camera_zoom_factor: f64,

    /// Then rotate the camera this far to the right around the model, in degrees
    #[arg(long, value_name = "DEGREES", default_value = "0", value_parser = values::angle, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_azimuth_angle: f64,

    /// Then rotate the camera this far up over the model, in degrees
    #[arg(long, value_name = "DEGREES", default_value = "0", value_parser = values::angle, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_elevation_angle: f64,

    /// Draw without perspective
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Camera")]
    pub(crate) camera_orthographic: Option<bool>,

    /// Use the file's own camera of this number, from 0; a negative number uses none
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Camera", conflicts_with_all = ["view", "camera_direction", "camera_position", "camera_focal_point", "camera_view_up"])]
    pub(crate) camera_index: Option<i64>,

    /// Exactly this camera, as the window writes it into copied commands (Ctrl+C) and state files; overrides all others
    #[arg(long, value_name = "CAMERA", allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_exact: Option<ExactCamera>,

    /// Hide these nodes: numbers in the order of --scene-hierarchy, from 0, or names
    #[arg(long, value_name = "NODE,...", value_delimiter = ',', help_heading = "Scenery")]
    pub(crate) hide_nodes: Vec<String>,

    /// Move a node from its place in the file; the window writes this into copied commands (Ctrl+C) and state
    /// files, once for each node
    #[arg(long, value_name = "PLACE", help_heading = "Scenery")]
    pub(crate) place_node: Vec<PlacedNode>,

    /// Show what the window saved to this file (Ctrl+S): files, camera and settings; other flags take precedence
    #[arg(long, alias = "load-statefile", value_name = "FILE.json", help_heading = "Files")]
    pub(crate) statefile: Option<PathBuf>,

    /// The file to which Ctrl+S saves the window's state, and from which Ctrl+L loads it; with the variables of --output
    #[arg(long, value_name = "FILE.json", default_value = "{model}.state.json", value_parser = Template::parse, help_heading = "Window")]
    pub(crate) statefile_filename: Template,

    /// Draw the edges of the model's polygons on it
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Look", conflicts_with = "style")]
    pub(crate) edges: Option<bool>,

    /// How the model's polygons are drawn
    #[arg(long, value_name = "STYLE", help_heading = "Look")]
    pub(crate) style: Option<DrawStyle>,

    /// Width of edges and lines in pixels
    #[arg(long, value_name = "PIXELS", default_value = "1", value_parser = values::line_width, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) line_width: f32,

    /// Smooth outlines with several samples per pixel [default: ssaa, or from --preset]
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "ssaa", value_name = "METHOD", help_heading = "Look")]
    pub(crate) anti_aliasing: Option<AntiAliasing>,

    /// Samples: along each side of a pixel with ssaa, 1 to 4, so 3 means 9; in total with msaa, 1, 2, 4, 8 or
    /// 16 [default: 3, or 4 with msaa]
    #[arg(long, value_name = "1-16", value_parser = values::count::<1, 16>, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) samples: Option<u32>,

    /// How translucent surfaces are drawn: always exactly, in any order
    #[arg(long, short = 'p', num_args = 0..=1, require_equals = true, default_missing_value = "ddp", value_name = "METHOD", hide = true, help_heading = "Look")]
    pub(crate) blending: Option<Blending>,

    /// What faces show: shaded, matcap, base-color, normal, geometric-normal, uv, metallic, roughness, occlusion, emission, alpha or depth
    ///
    /// matcap is one clay for all. Normals are along the world's axes, with -1 to 1 as 0 to 1; all values but colours
    /// are shown as they are stored: the byte of a pixel is 255 times the value.
    #[arg(long, value_name = "MODE", default_value = "shaded", value_parser = values::display, help_heading = "Look")]
    pub(crate) display: Display,

    /// Show the distance of everything in grey: near is dark; the same as --display=depth
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, conflicts_with_all = ["replay", "display"], help_heading = "Look")]
    pub(crate) display_depth: Option<bool>,

    /// Multiply the intensity of all lights
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) light_intensity: f32,

    /// Whether the back sides of faces are drawn; default follows the file
    #[arg(long, value_name = "TYPE", default_value = "default", help_heading = "Look")]
    pub(crate) backface_type: BackfaceType,

    /// Colour behind the model [default: a grey gradient]
    #[arg(long, value_name = "COLOR", value_parser = values::color, help_heading = "Look")]
    pub(crate) background_color: Option<Vec3>,

    /// Leave the image transparent where there is no model
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Look")]
    pub(crate) no_background: Option<bool>,

    /// Use at most this many threads; the image does not depend on it [default: one per core]
    #[arg(long, value_name = "N", value_parser = values::threads, allow_negative_numbers = true, help_heading = "Program")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,

    /// Use these vector instructions; the image does not depend on them [default: the best of the processor]
    #[arg(long, value_name = "LEVEL", value_parser = values::simd, help_heading = "Program")]
    pub(crate) simd: Option<SimdLevel>,

    /// Read flags from this JSON file: a path, or a name in the user's configuration folder
    ///
    /// A list of blocks such as {"match": ".*stl", "options": {"up": "+Z"}}, in F3D's format. The
    /// folder is $XDG_CONFIG_HOME/trigon; config.json and config.d/*.json in it are read without
    /// this flag. The command line overrides them, except names that begin with !.
    #[arg(long, value_name = "FILE", help_heading = "Program")]
    pub(crate) config: Option<PathBuf>,

    /// Read no configuration file
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Program")]
    pub(crate) no_config: Option<bool>,

    /// Run the commands in this file, line by line: set, toggle, set_camera, take_screenshot and others
    #[arg(long, value_name = "FILE", help_heading = "Program")]
    pub(crate) command_script: Option<PathBuf>,

    /// Set an option by its name in F3D's library
    #[arg(short = 'D', long, value_name = "NAME=VALUE", help_heading = "Program")]
    pub(crate) define: Vec<String>,

    /// Ignore an option of the configuration file, by that name
    #[arg(short = 'R', long, value_name = "NAME", help_heading = "Program")]
    pub(crate) reset: Vec<String>,

    /// A flag that a configuration file cannot set.
    #[arg(long, hide = true)]
    pub(crate) unset: Vec<String>,

    /// A rotation of the camera, as in command scripts.
    #[arg(long, hide = true, allow_hyphen_values = true)]
    pub(crate) camera_turn: Vec<Turn>,

    /// Show a progress bar at once while a file is loaded, not after a second
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Program")]
    pub(crate) loading_progress: Option<bool>,

    /// Print facts about what was drawn, loaded or checked to standard output, one JSON object per line
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Program")]
    pub(crate) json: Option<bool>,

    /// Show the help, or all of it with --help=all
    #[arg(long, short = 'h', num_args = 0..=1, require_equals = true, default_missing_value = "short", value_name = "HOW", help_heading = "Program")]
    pub(crate) help: Option<HelpLength>,

    /// How much to print on standard error
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "debug", default_value = "info", value_name = "LEVEL", help_heading = "Program")]
    pub(crate) verbose: Level,

    /// Read all files as this format, whatever their names: obj, gltf, glb, ply, stl, off or 3mf
    #[arg(long, value_name = "FORMAT", value_parser = values::reader, help_heading = "Files")]
    pub(crate) force_reader: Option<Format>,

    /// List the formats that can be read
    #[arg(long, help_heading = "Program")]
    pub(crate) list_readers: bool,

    /// List the rendering backends: the processor, whatever --rendering-backend says
    #[arg(long, help_heading = "Program")]
    pub(crate) list_rendering_backends: bool,

    /// List the window's keys and mouse buttons
    #[arg(long, help_heading = "Program")]
    pub(crate) list_bindings: bool,

    #[command(flatten)]
    pub(crate) animation: AnimationArgs,

    #[command(flatten)]
    pub(crate) material: MaterialArgs,

    #[command(flatten)]
    pub(crate) scenery: SceneryArgs,

    #[command(flatten)]
    pub(crate) window: WindowArgs,

    #[command(flatten)]
    pub(crate) effects: EffectArgs,

    #[command(flatten)]
    pub(crate) quality: QualityArgs,

    #[command(flatten)]
    pub(crate) gpu_only: GpuOnly,
}

/// What to do with several files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MultiFileMode {
    Single,
    All,
    /// All files of a folder in one scene
    Dir,
}

/// How much help to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum HelpLength {
    Short,
    All,
}

/// A named side of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum View {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
    Iso,
}

/// How polygons are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DrawStyle {
    /// Filled faces
    Surface,
    /// Filled faces with their edges; the same as --edges
    Edges,
    /// Edges only, including hidden ones
    Wireframe,
    /// Edges only, without those that faces hide
    HiddenLine,
}

/// How outlines are smoothed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AntiAliasing {
    /// One sample per pixel
    None,
    /// Several samples per pixel, each with its own colour, see --samples
    #[value(aliases = ["fxaa", "taa"])]
    Ssaa,
    /// Several samples per pixel, one colour per triangle: faster
    Msaa,
}

/// F3D's methods for translucent surfaces. All give the result of its best one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Blending {
    None,
    Ddp,
    Sort,
    #[value(name = "sort_cpu")]
    SortCpu,
    Stochastic,
}

/// How faces seen from behind are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackfaceType {
    Default,
    Visible,
    Hidden,
}
