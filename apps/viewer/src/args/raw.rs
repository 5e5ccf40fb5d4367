//! The flags as they are typed: one field per flag, parsed but not yet put
//! together. What they mean as a whole is `Request`'s to say.
//!
//! Names and defaults follow F3D (<https://f3d.app>), so that its users and
//! their scripts feel at home.

use std::path::PathBuf;

use clap::{ArgAction, Parser, Subcommand, ValueEnum};
use regex::Regex;
use trigon_camera::Viewport;
use trigon_io::{Format, SceneChoice};
use trigon_math::{DVec3, Vec3};
use trigon_scene::{Display, SimdLevel};

use super::animation::AnimationArgs;
use super::beside::Beside;
use super::camera::ExactCamera;
use super::effects::EffectArgs;
use super::gpu::GpuOnly;
use super::material::MaterialArgs;
use super::output::{Destination, Template};
use super::quality::QualityArgs;
use super::scenery::SceneryArgs;
use super::values;
use super::window::WindowArgs;
use crate::framing::Turn;
use crate::report::Level;
use crate::study::StudyArgs;

pub(crate) const AFTER_HELP: &str = "\
Exit codes:
  0  all went well
  1  a model could not be loaded or drawn, or a picture could not be written
  2  the command line makes no sense
  3  a picture differs from the one that --reference or --replay names

Values:
  COLOR      1,0.5,0 | #f80 | #ff8800 | a CSS name or function such as orange
  DIRECTION  +X | -y+z | 1,0,-0.5
  POINT      1,2.5,-3 (metres)
  angles are degrees; colours are sRGB
  switches take --edges, --edges=false, =true, =on, =off, =1, =0

Examples:
  trigon-viewer                                   look at the built-in scene
  trigon-viewer chair.glb                         look at a model
  trigon-viewer chair.glb --output chair.png      write a picture, no display needed
  trigon-viewer *.obj --output '{model}.png'      a picture of each
  trigon-viewer chair.glb --view=top --output - | other-program";

/// Look at 3D models, or turn them into pictures, with no GPU and no display needed.
///
/// Without --output a window opens; press H in it for its keys. With --output
/// a picture is written instead. Without FILES the built-in scene is shown.
#[derive(Debug, Parser)]
#[command(name = "trigon-viewer", version, after_long_help = AFTER_HELP, disable_help_flag = true)]
#[command(args_override_self = true, max_term_width = 100)]
#[command(args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
pub(crate) struct RawArgs {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,

    /// Models to show: OBJ, glTF, GLB, PLY, STL, OFF (see --list-readers); - is standard input, if a picture is written
    #[arg(value_name = "FILES")]
    pub(crate) files: Vec<PathBuf>,

    /// A model to show, as F3D spells it; the same as naming it without the flag
    #[arg(long, value_name = "FILE", action = ArgAction::Append, hide = true)]
    pub(crate) input: Vec<PathBuf>,

    /// Write a picture instead of opening a window (PNG, JPEG, WebP, OpenEXR); - is a PNG on standard output
    ///
    /// JPEG has no alpha: what is transparent is white. OpenEXR holds linear light, premultiplied with alpha, before exposure and tone mapping. The name may hold {model} (the file's name without its ending),
    /// {model.ext} (with it), {model_ext} (the ending), {n:3} (the first number whose file does not
    /// exist yet, padded to three digits), {app}, {version}, {date} and {date:%H%M} (UTC); {{x}} stands for {x} itself.
    /// With {frame} or {frame:4} each frame of an animation becomes a picture, as many as
    /// --frame-rate says, from --animation-time on. A name that ends in .gif or .apng holds them
    /// all, and those of --turntable.
    #[arg(long, value_name = "FILE|-", help_heading = "Files")]
    pub(crate) output: Option<Destination>,

    /// Write this, too: depth, normals and other outputs, with a comma between them
    ///
    /// There are color, radiance (linear light, premultiplied), depth (metres along the view axis), object-ids, face-ids, material-ids,
    /// triangle-ids, barycentrics, positions, normals, geometric-normals, uvs and albedo. With
    /// --output chair.exr they are channels of that file. With --output chair.png each becomes a
    /// NumPy array beside it: depth goes to chair.depth.npy. Depth, ids and normals can be PNG
    /// files of 16 bits instead: depth.png goes to chair.depth.png, in millimetres.
    #[arg(
        long,
        value_name = "NAME,...",
        value_delimiter = ',',
        requires = "output",
        conflicts_with = "replay",
        help_heading = "Files"
    )]
    pub(crate) outputs: Vec<Beside>,

    /// Write scene, camera, settings and picture to one file, to draw it again elsewhere
    ///
    /// Nothing else is needed to draw it again: a bug report, or a test. With
    /// --output the picture is written, too.
    #[arg(long, value_name = "FILE.trigon", help_heading = "Files")]
    pub(crate) capture: Option<PathBuf>,

    /// Draw what --capture wrote and tell whether the picture is the same, by exit code 3 if not
    ///
    /// With --output the new picture is written. --threads and --simd may be
    /// given; all else is as it was captured.
    #[arg(long, value_name = "FILE.trigon", help_heading = "Files", conflicts_with_all = ["files", "input", "capture"])]
    pub(crate) replay: Option<PathBuf>,

    /// Width and height of the picture or window in pixels; 1000x600 works too
    #[arg(long, value_name = "W,H", default_value = "1000,600", value_parser = values::size, help_heading = "Files")]
    pub(crate) resolution: Viewport,

    /// With several files: one at a time, or all in one scene
    ///
    /// In a window, single starts with the first; the arrow keys go through
    /// them. With --output, single writes one picture per file and needs
    /// {model} or a number such as {n:1} in the name.
    #[arg(long, value_name = "MODE", default_value = "single", help_heading = "Files")]
    pub(crate) multi_file_mode: MultiFileMode,

    /// Files whose names differ only in what the groups of this regular expression match are shown together
    #[arg(long, value_name = "REGEX", value_parser = values::regex, conflicts_with = "multi_file_mode", help_heading = "Files")]
    pub(crate) multi_file_regex: Option<Regex>,

    /// Take the models of folders in folders, too
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) recursive_dir_add: Option<bool>,

    /// Pass over files with nothing to draw
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) remove_empty_file_groups: Option<bool>,

    /// Refuse files larger than this many MiB; a negative number refuses none
    #[arg(long, value_name = "MIB", value_parser = values::mebibytes, allow_negative_numbers = true, help_heading = "Files")]
    pub(crate) max_size: Option<u64>,

    /// Compare the picture with this one: exit code 3 if they differ too much
    ///
    /// With --output the picture is written only then, and where they differ to a file
    /// beside it (chair.diff.png). Without the file to compare with, the picture is
    /// written, to become it, and the exit code is 3, too.
    #[arg(long, value_name = "FILE.png", conflicts_with_all = ["replay", "turntable"], help_heading = "Files")]
    pub(crate) reference: Option<PathBuf>,

    /// Show this model beside the other one, with one camera for both: side by side, in turn (B), or where they differ (Shift+B)
    ///
    /// With --output both are written beside each other, and beside a map of their differences; the exit code is 3 if
    /// any pixel differs. docs/viewer.md has the two lines that make it a tool for git difftool.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["replay", "capture", "reference", "turntable", "outputs"], help_heading = "Files")]
    pub(crate) compare: Option<PathBuf>,

    /// How much is too much: 0 only for the same look, 0.04 for what is hardly seen
    #[arg(long, value_name = "ERROR", default_value = "0.04", value_parser = values::share, allow_negative_numbers = true, help_heading = "Files")]
    pub(crate) reference_threshold: f64,

    /// Say what is wrong with the files instead of drawing them: exit code 1 if anything is
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, conflicts_with_all = ["output", "capture", "replay"], help_heading = "Files")]
    pub(crate) check: Option<bool>,

    /// Say why this pixel looks as it does: all triangles that touch it, and which of them is seen; columns and rows count from 0
    ///
    /// For each sample of the pixel: the triangles whose bounding box holds it, the exact values of their edge
    /// functions (in 1/65536 square pixels, twice the area), their depths, and which of them is seen and why.
    #[arg(long, value_name = "X,Y", value_parser = values::pixel, conflicts_with_all = ["output", "capture", "replay", "check", "explain"], help_heading = "Files")]
    pub(crate) explain_pixel: Option<[u32; 2]>,

    /// The name of the window's screenshots; as for --output
    #[arg(long, value_name = "FILE", value_parser = super::output::picture_name, default_value = "{model}_{n}.png", help_heading = "Window")]
    pub(crate) screenshot_filename: Template,

    /// Load the files and say what is in them, but draw nothing
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) no_render: Option<bool>,

    /// The scene to show of a file that has several, by its number from 0 or its name [default: the file's own choice]
    #[arg(long, value_name = "N|NAME", value_parser = values::scene, help_heading = "Files")]
    pub(crate) scene: Option<SceneChoice>,

    /// Which axis of the model points up
    #[arg(long, value_name = "DIRECTION", default_value = "+Y", value_parser = values::direction, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) up: DVec3,

    /// Look from a named side
    #[arg(long, value_name = "SIDE", help_heading = "Camera", conflicts_with_all = ["camera_direction", "camera_position"])]
    pub(crate) view: Option<View>,

    /// Direction in which the camera looks; the model is fitted into the picture [default: -1,-0.5,-1 for +Y up]
    #[arg(long, value_name = "DIRECTION", value_parser = values::direction, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_direction: Option<DVec3>,

    /// Where the camera stands; overrides direction and zoom
    #[arg(long, value_name = "POINT", value_parser = values::point, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_position: Option<DVec3>,

    /// The point that the camera looks at [default: the middle of the model]
    #[arg(long, value_name = "POINT", value_parser = values::point, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_focal_point: Option<DVec3>,

    /// What is up in the picture [default: --up]
    #[arg(long, value_name = "DIRECTION", value_parser = values::direction, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_view_up: Option<DVec3>,

    /// Angle between the lower and the upper edge of the picture, in degrees
    #[arg(long, value_name = "DEGREES", default_value = "30", value_parser = values::view_angle, allow_negative_numbers = true, help_heading = "Camera")]
    pub(crate) camera_view_angle: f64,

    /// How much of the picture the model fills: 0.9 leaves a margin of a tenth
    #[arg(long, value_name = "FACTOR", default_value = "0.9", value_parser = values::zoom, allow_negative_numbers = true, help_heading = "Camera")]
    pub(crate) camera_zoom_factor: f64,

    /// Then turn the camera this far to the right around the model, in degrees
    #[arg(long, value_name = "DEGREES", default_value = "0", value_parser = values::angle, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_azimuth_angle: f64,

    /// Then turn the camera this far up over the model, in degrees
    #[arg(long, value_name = "DEGREES", default_value = "0", value_parser = values::angle, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_elevation_angle: f64,

    /// Draw without perspective
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Camera")]
    pub(crate) camera_orthographic: Option<bool>,

    /// Look through the file's own camera of this number, counted from 0; a negative one means none of them
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = "Camera", conflicts_with_all = ["view", "camera_direction", "camera_position", "camera_focal_point", "camera_view_up"])]
    pub(crate) camera_index: Option<i64>,

    /// Exactly this camera, as the window copies it (Ctrl+C) and keeps it in state files; overrides all others
    #[arg(long, value_name = "CAMERA", allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) camera_exact: Option<ExactCamera>,

    /// Hide these nodes: numbers in the order of --scene-hierarchy, from 0, or names
    #[arg(long, value_name = "NODE,...", value_delimiter = ',', help_heading = "Scenery")]
    pub(crate) hide_nodes: Vec<String>,

    /// Show what the window kept in this file (Ctrl+S): its files, camera and settings; flags that are typed win
    #[arg(long, alias = "load-statefile", value_name = "FILE.json", help_heading = "Files")]
    pub(crate) statefile: Option<PathBuf>,

    /// Where the window keeps its state with Ctrl+S, and loads it from with Ctrl+L; as for --output
    #[arg(long, value_name = "FILE.json", default_value = "{model}.state.json", value_parser = Template::parse, help_heading = "Window")]
    pub(crate) statefile_filename: Template,

    /// Draw the edges of the model's polygons on it
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Look", conflicts_with = "style")]
    pub(crate) edges: Option<bool>,

    /// What is drawn of the model's polygons
    #[arg(long, value_name = "STYLE", help_heading = "Look")]
    pub(crate) style: Option<DrawStyle>,

    /// Width of edges and lines in pixels
    #[arg(long, value_name = "PIXELS", default_value = "1", value_parser = values::line_width, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) line_width: f32,

    /// Smooth outlines by drawing several samples per pixel [default: ssaa, or as --preset says]
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "ssaa", value_name = "METHOD", help_heading = "Look")]
    pub(crate) anti_aliasing: Option<AntiAliasing>,

    /// Samples: along each side of a pixel with ssaa, 1 to 4, so 3 means 9; in all with msaa, 1, 2, 4, 8 or 16 [default: 3, or 4 with msaa]
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

    /// Show how far everything is, in grey: near is dark; the same as --display=depth
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, conflicts_with_all = ["replay", "display"], help_heading = "Look")]
    pub(crate) display_depth: Option<bool>,

    /// Make every light this many times as bright
    #[arg(long, value_name = "FACTOR", default_value = "1", value_parser = values::intensity, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) light_intensity: f32,

    /// Whether the back sides of faces are drawn; default is what the file says
    #[arg(long, value_name = "TYPE", default_value = "default", help_heading = "Look")]
    pub(crate) backface_type: BackfaceType,

    /// Colour behind the model [default: a grey gradient]
    #[arg(long, value_name = "COLOR", value_parser = values::color, help_heading = "Look")]
    pub(crate) background_color: Option<Vec3>,

    /// Leave the picture transparent where there is no model
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Look")]
    pub(crate) no_background: Option<bool>,

    /// Use at most this many threads; the picture is the same with any number [default: one per core]
    #[arg(long, value_name = "N", value_parser = values::threads, allow_negative_numbers = true, help_heading = "Program")]
    pub(crate) threads: Option<std::num::NonZeroUsize>,

    /// Use these vector instructions; the picture is the same with any [default: the best that the processor has]
    #[arg(long, value_name = "LEVEL", value_parser = values::simd, help_heading = "Program")]
    pub(crate) simd: Option<SimdLevel>,

    /// Read flags from this JSON file: a path, or a name in the folder of the user's own
    ///
    /// A list of blocks such as {"match": ".*stl", "options": {"up": "+Z"}}, as F3D has it. The
    /// folder is $XDG_CONFIG_HOME/trigon; config.json and config.d/*.json in it are read without
    /// this flag. What the command line says wins, unless a name in the file begins with !.
    #[arg(long, value_name = "FILE", help_heading = "Program")]
    pub(crate) config: Option<PathBuf>,

    /// Read no configuration file
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Program")]
    pub(crate) no_config: Option<bool>,

    /// Do what is written in this file, line by line: set, toggle, set_camera, take_screenshot and others
    #[arg(long, value_name = "FILE", help_heading = "Program")]
    pub(crate) command_script: Option<PathBuf>,

    /// Set an option by the name that it has in F3D's library
    #[arg(short = 'D', long, value_name = "NAME=VALUE", help_heading = "Program")]
    pub(crate) define: Vec<String>,

    /// Leave an option of the configuration file out, by that name
    #[arg(short = 'R', long, value_name = "NAME", help_heading = "Program")]
    pub(crate) reset: Vec<String>,

    /// A flag that a configuration file does not set.
    #[arg(long, hide = true)]
    pub(crate) unset: Vec<String>,

    /// A turn of the camera, as command scripts say it.
    #[arg(long, hide = true, allow_hyphen_values = true)]
    pub(crate) camera_turn: Vec<Turn>,

    /// Show a bar of progress at once when a file is loaded, not after a second
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Program")]
    pub(crate) loading_progress: Option<bool>,

    /// Write facts about what was drawn, loaded or checked to standard output, one JSON object a line
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Program")]
    pub(crate) json: Option<bool>,

    /// Show the help, or all of it with --help=all
    #[arg(long, short = 'h', num_args = 0..=1, require_equals = true, default_missing_value = "short", value_name = "HOW", help_heading = "Program")]
    pub(crate) help: Option<HelpLength>,

    /// How much to say on standard error
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "debug", default_value = "info", value_name = "LEVEL", help_heading = "Program")]
    pub(crate) verbose: Level,

    /// Read all files as this format, whatever their names say: obj, gltf, glb, ply, stl or off
    #[arg(long, value_name = "FORMAT", value_parser = values::reader, help_heading = "Files")]
    pub(crate) force_reader: Option<Format>,

    /// List the formats that can be read
    #[arg(long, help_heading = "Program")]
    pub(crate) list_readers: bool,

    /// List what draws: the processor, whatever --rendering-backend says
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
    /// Those of a folder in one scene
    Dir,
}

/// How much help.
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

/// What to do instead of showing models.
#[derive(Clone, Debug, Subcommand)]
pub(crate) enum Command {
    /// Measure what accuracy costs in time on this machine, and write a report
    #[cfg_attr(not(feature = "study"), command(hide = true))]
    Study(StudyArgs),
}

/// What is drawn of polygons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DrawStyle {
    /// Filled faces
    Surface,
    /// Filled faces with their edges; the same as --edges
    Edges,
    /// Edges only, hidden ones too
    Wireframe,
    /// Edges only, without those that a face hides
    HiddenLine,
}

/// How outlines are smoothed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AntiAliasing {
    /// One sample per pixel
    None,
    /// Several samples per pixel, each with a colour of its own, see --samples
    #[value(aliases = ["fxaa", "taa"])]
    Ssaa,
    /// Several samples per pixel, one colour for those of a triangle: quicker
    Msaa,
}

/// F3D's ways of drawing translucent surfaces. All give what its best one gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Blending {
    None,
    Ddp,
    Sort,
    #[value(name = "sort_cpu")]
    SortCpu,
    Stochastic,
}

/// What happens to faces seen from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackfaceType {
    Default,
    Visible,
    Hidden,
}
