//! The flags as they are typed: one field per flag, parsed but not yet put
//! together. What they mean as a whole is `Request`'s to say.
//!
//! Names and defaults follow F3D (<https://f3d.app>), so that its users and
//! their scripts feel at home; what F3D does not have says so.

use std::path::PathBuf;

use clap::{ArgAction, Parser, Subcommand, ValueEnum};
use trigon_camera::Viewport;
use trigon_io::{Format, SceneChoice};
use trigon_math::{DVec3, Vec3};
use trigon_scene::SimdLevel;

use super::beside::Beside;
use super::effects::EffectArgs;
use super::output::Destination;
use super::quality::QualityArgs;
use super::values;
use super::window::WindowArgs;
use crate::report::Level;
use crate::study::StudyArgs;

const AFTER_HELP: &str = "\
Exit codes:
  0  all went well
  1  a model could not be loaded or drawn, or a picture could not be written
  2  the command line makes no sense
  3  a captured picture was drawn again, and differs

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
#[command(name = "trigon-viewer", version, after_long_help = AFTER_HELP, after_help = "More with --help: every flag in full, exit codes, examples.")]
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

    /// Write a PNG or an OpenEXR picture instead of opening a window; - is a PNG on standard output
    ///
    /// OpenEXR holds linear light, premultiplied with alpha, before exposure and tone mapping. The name may hold {model} (the file's name without its ending),
    /// {model.ext} (with it), {model_ext} (the ending), {n:3} (the first number whose file does not
    /// exist yet, padded to three digits), {app} and {version}; {{x}} stands for {x} itself.
    #[arg(long, value_name = "FILE.png|FILE.exr|-", help_heading = "Files")]
    pub(crate) output: Option<Destination>,

    /// Write this, too: depth, normals and other outputs, with a comma between them (not in F3D)
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

    /// Write scene, camera, settings and picture to one file, to draw it again elsewhere (not in F3D)
    ///
    /// Nothing else is needed to draw it again: a bug report, or a test. With
    /// --output the picture is written, too.
    #[arg(long, value_name = "FILE.trigon", help_heading = "Files")]
    pub(crate) capture: Option<PathBuf>,

    /// Draw what --capture wrote and tell whether the picture is the same, by exit code 3 if not (not in F3D)
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

    /// Refuse files larger than this many MiB
    #[arg(long, value_name = "MIB", value_parser = values::mebibytes, allow_negative_numbers = true, help_heading = "Files")]
    pub(crate) max_size: Option<u64>,

    /// Load the files and say what is in them, but draw nothing
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Files")]
    pub(crate) no_render: Option<bool>,

    /// The scene to show of a file that has several, by its number from 0 or its name (not in F3D) [default: the file's own choice]
    #[arg(long, value_name = "N|NAME", value_parser = values::scene, help_heading = "Files")]
    pub(crate) scene: Option<SceneChoice>,

    /// The animation whose pose is shown, counted from 0; a negative one means all of them [default: 0 with --animation-time, else none]
    #[arg(
        long,
        alias = "animation-indices",
        value_name = "N",
        allow_negative_numbers = true,
        help_heading = "Files"
    )]
    pub(crate) animation_index: Option<i64>,

    /// The time of that pose in seconds [default: 0 with --animation-index]
    #[arg(long, value_name = "SECONDS", value_parser = values::seconds, allow_negative_numbers = true, help_heading = "Files")]
    pub(crate) animation_time: Option<f64>,

    /// Which axis of the model points up
    #[arg(long, value_name = "DIRECTION", default_value = "+Y", value_parser = values::direction, allow_hyphen_values = true, help_heading = "Camera")]
    pub(crate) up: DVec3,

    /// Look from a named side (not in F3D)
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

    /// Draw the edges of the model's polygons on it
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Look", conflicts_with = "style")]
    pub(crate) edges: Option<bool>,

    /// What is drawn of the model's polygons (not in F3D)
    #[arg(long, value_name = "STYLE", help_heading = "Look")]
    pub(crate) style: Option<DrawStyle>,

    /// Width of edges and lines in pixels
    #[arg(long, value_name = "PIXELS", default_value = "1", value_parser = values::line_width, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) line_width: f32,

    /// Smooth outlines by drawing several samples per pixel [default: ssaa, or as --preset says]
    #[arg(long, short, num_args = 0..=1, require_equals = true, default_missing_value = "ssaa", value_name = "METHOD", help_heading = "Look")]
    pub(crate) anti_aliasing: Option<AntiAliasing>,

    /// Samples: along each side of a pixel with ssaa, 1 to 4, so 3 means 9; in all with msaa, 1, 2, 4, 8 or 16 (not in F3D) [default: 3, or 4 with msaa]
    #[arg(long, value_name = "1-16", value_parser = clap::value_parser!(u32).range(1..=16), allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) samples: Option<u32>,

    /// Colour of the model; textures are tinted by it
    #[arg(long, value_name = "COLOR", value_parser = values::color, help_heading = "Look")]
    pub(crate) color: Option<Vec3>,

    /// Opacity of the model, 0 to 1 or 0% to 100%
    #[arg(long, value_name = "RATIO", value_parser = values::unit_ratio, allow_negative_numbers = true, help_heading = "Look")]
    pub(crate) opacity: Option<f32>,

    /// Show the model's colours as they are, without light
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Look")]
    pub(crate) unlit: Option<bool>,

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

    /// How much to say on standard error
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "debug", default_value = "info", value_name = "LEVEL", help_heading = "Program")]
    pub(crate) verbose: Level,

    /// Read all files as this format, whatever their names say: obj, gltf, glb, ply, stl or off
    #[arg(long, value_name = "FORMAT", value_parser = values::reader, help_heading = "Files")]
    pub(crate) force_reader: Option<Format>,

    /// List the formats that can be read
    #[arg(long, help_heading = "Program")]
    pub(crate) list_readers: bool,

    /// List the window's keys and mouse buttons
    #[arg(long, help_heading = "Program")]
    pub(crate) list_bindings: bool,

    #[command(flatten)]
    pub(crate) window: WindowArgs,

    #[command(flatten)]
    pub(crate) effects: EffectArgs,

    #[command(flatten)]
    pub(crate) quality: QualityArgs,

    #[command(flatten)]
    pub(crate) gpu_only: GpuOnly,
}

/// Flags of F3D that steer a GPU or a ray tracer. Scripts that use them keep
/// running; a warning says that they do nothing.
#[derive(Debug, clap::Args)]
pub(crate) struct GpuOnly {
    #[arg(long, hide = true)]
    rendering_backend: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    raytracing: Option<String>,
    #[arg(long, hide = true)]
    raytracing_samples: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    raytracing_denoise: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    volume: Option<String>,
    #[arg(long, hide = true, num_args = 0..=1, require_equals = true, default_missing_value = "true")]
    volume_inverse: Option<String>,
}

impl GpuOnly {
    /// The flags that were given, as they are spelled.
    pub(crate) fn given(&self) -> Vec<&'static str> {
        let flags = [
            ("--rendering-backend", &self.rendering_backend),
            ("--raytracing", &self.raytracing),
            ("--raytracing-samples", &self.raytracing_samples),
            ("--raytracing-denoise", &self.raytracing_denoise),
            ("--volume", &self.volume),
            ("--volume-inverse", &self.volume_inverse),
        ];
        flags.into_iter().filter(|(_, value)| value.is_some()).map(|(flag, _)| flag).collect()
    }
}

/// What to do with several files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MultiFileMode {
    Single,
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
    /// Measure what accuracy costs in time on this machine, and write a report (not in F3D)
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
    Ssaa,
    /// Several samples per pixel, one colour for those of a triangle: quicker (not in F3D)
    Msaa,
}

/// What happens to faces seen from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BackfaceType {
    Default,
    Visible,
    Hidden,
}
