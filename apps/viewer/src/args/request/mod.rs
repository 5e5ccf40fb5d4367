//! The meaning of the command line as a whole, checked.

mod checks;
mod ignored;
#[cfg(test)]
mod tests;

use std::path::{Path, PathBuf};

use clap::CommandFactory;
use clap::error::ErrorKind;
use trigon_camera::{AxisView, UpAxis};
use trigon_io::{Format, SceneChoice};
use trigon_math::Vec3;
use trigon_scene::{Background, Display, RenderSettings, Style};

use self::checks::{check_frames, check_output, check_outputs, check_stdin};
use super::animation::{AnimationArgs, AnimationProgress};
use super::beside::Beside;
use super::effects::Explanation;
use super::line::{CommandLine, plain};
use super::material::PointSprites;
use super::output::{Destination, Template};
use super::placed_node::PlacedNode;
use super::quality::{Insisted, Limit};
use super::raw::{AntiAliasing, BackfaceType, CheckPurpose, DrawStyle, MultiFileMode, RawArgs, View};
use super::scenery::SceneryArgs;
use super::window::WindowArgs;
use crate::failure::Failure;
use crate::folders;
use crate::framing::{Eye, Framing};
use crate::look::{Backfaces, Look, Textures};
use crate::moment::{Clip, Moment};
use crate::report::Level;
use crate::scenery::{Grid, Scenery, Sprites};
use crate::source::{Grouping, Source};

/// A checked request.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    /// The task.
    pub(crate) mode: Mode,
    /// The models; none means the built-in scene.
    pub(crate) files: Vec<PathBuf>,
    /// Whether the models of a folder are also those of the folders in it.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "there is no window"))]
    pub(crate) goes_deep: bool,
    /// How several models are shown.
    pub(crate) grouping: Grouping,
    /// Larger files are refused.
    pub(crate) max_bytes: Option<u64>,
    /// The format of all files, if it overrides their names.
    pub(crate) format: Option<Format>,
    /// The axis that points up, if it is not that of the format.
    pub(crate) up: Option<UpAxis>,
    /// The scene of files with several.
    pub(crate) scene: Option<SceneChoice>,
    /// The variant of the materials.
    pub(crate) variant: Option<String>,
    /// The moment of an animation to show.
    pub(crate) moment: Option<Moment>,
    /// Image sequences.
    pub(crate) sequence: Frames,
    /// The environment image.
    pub(crate) environment: Option<PathBuf>,
    /// Additional objects shown with the model.
    pub(crate) scenery: Scenery,
    /// What is drawn and written over the image.
    pub(crate) overlay: Overlay,
    /// The image to compare with.
    pub(crate) reference: Option<Reference>,
    /// The model that the window shows beside the first.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "there is no window"))]
    pub(crate) compared: Option<PathBuf>,
    /// Commands to be done one after the other.
    pub(crate) script: Option<PathBuf>,
    /// Whether facts are written as JSON.
    pub(crate) json: bool,
    /// Whether files with nothing to draw are skipped.
    pub(crate) skip_empty: bool,
    /// Whether a progress bar is shown at once.
    pub(crate) shows_progress: bool,
    /// The name of screenshots.
    pub(crate) screenshot: Template,
    /// The name of state files.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "there is no window"))]
    pub(crate) state_file: Template,
    /// Nodes that are hidden, by number or name.
    pub(crate) hidden: Vec<String>,
    /// Nodes that are not where their file has them.
    pub(crate) placed: Vec<PlacedNode>,
    /// What all of this was read from.
    pub(crate) line: CommandLine,
    /// The camera.
    pub(crate) framing: Framing,
    /// Changes to the model.
    pub(crate) look: Look,
    /// Additional outputs.
    pub(crate) outputs: Vec<Beside>,
    /// The render settings.
    pub(crate) settings: RenderSettings,
    /// The time budget.
    pub(crate) limit: Option<Limit>,
    /// Options of the window.
    pub(crate) window: WindowArgs,
    /// Whether the window shows the frame time.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "there is no window"))]
    pub(crate) shows_frame_time: bool,
    /// Whether the window shows messages about keys.
    #[cfg_attr(not(feature = "window"), expect(dead_code, reason = "there is no window"))]
    pub(crate) notifies: bool,
    /// How much is printed.
    pub(crate) level: Level,
    /// Flags that were accepted without effect.
    pub(crate) ignored: Vec<String>,
}

/// Image sequences.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Frames {
    /// The number of views around the model, for a turntable.
    pub(crate) turntable: Option<u32>,
    /// The file of the cameras.
    pub(crate) cameras: Option<PathBuf>,
    /// Frames per second.
    pub(crate) rate: f64,
    /// The speed factor of animations; negative plays backwards.
    pub(crate) speed: f64,
    /// Whether they play when the window opens.
    pub(crate) autoplay: bool,
    /// How the window displays the time.
    pub(crate) progress: Option<AnimationProgress>,
}

/// What is drawn and written over the image.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Overlay {
    /// Colours of arrows for X, Y and Z: linear RGB.
    pub(crate) axes: [Vec3; 3],
    pub(crate) shows_axes: bool,
    /// The nodes of the scene as a tree.
    pub(crate) tree: bool,
    pub(crate) name: bool,
    pub(crate) metadata: bool,
    pub(crate) environment_name: bool,
    /// Text size.
    pub(crate) text_scale: f32,
}

/// The reference image for a comparison.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Reference {
    pub(crate) file: PathBuf,
    /// A larger error counts as a difference.
    pub(crate) threshold: f64,
}

/// The task.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Mode {
    /// Write images, and capture what they were drawn from.
    Image {
        /// The destination of each, if any.
        output: Option<Destination>,
        /// The file of the capture.
        capture: Option<PathBuf>,
    },
    /// Draw a capture again.
    Replay {
        /// The file of the capture.
        capture: PathBuf,
        /// The destination of the new image, if any.
        output: Option<Destination>,
    },
    /// Open a window.
    Window,
    /// Load the models and print what is in them.
    Inspect,
    /// List the effects that the models need.
    Explain(Explanation),
    /// Draw two models, and where they differ.
    Compare {
        /// The second one.
        other: PathBuf,
        /// Where the image goes.
        output: Destination,
    },
    /// Measure what their images cost and how wrong they are; the plot or the table goes to this file.
    Frontier(Template),
    /// Explain this pixel of their images.
    ExplainPixel([u32; 2]),
    /// Say what is wrong with the models.
    Check(CheckPurpose),
    /// List the rendering backends.
    ListBackends,
    /// List the formats that can be read.
    ListReaders,
    /// List the keys of the window.
    ListBindings,
}

/// The name that stands for standard input.
pub(crate) const STDIN: &str = "-";

impl Request {
    /// The request of a command line for a file, `None` for the built-in scene.
    ///
    /// # Errors
    /// Flags are invalid, or contradict each other.
    pub(crate) fn from_line(line: &CommandLine, file: Option<&Path>) -> Result<Self, clap::Error> {
        let raw = line.raw(file)?;
        let request = Self::new(raw)
            .map_err(|message| RawArgs::command().error(ErrorKind::ArgumentConflict, message))?;
        let mut ignored = line.warnings().to_vec();
        ignored.extend(request.ignored);
        Ok(Self { line: line.clone(), ignored, ..request })
    }

    /// The request for one of several sources, for which configuration files may have their own
    /// flags.
    ///
    /// # Errors
    /// The flags are invalid.
    pub(crate) fn for_source(&self, source: &Source) -> Result<Self, Failure> {
        if !self.line.differs_by_file() {
            return Ok(self.clone());
        }
        let of_file = Self::from_line(&self.line, source.first_file());
        of_file.map_err(|error| Failure::Usage(plain(&error)))
    }

    /// Combines the flags, or explains why they conflict.
    pub(crate) fn new(raw: RawArgs) -> Result<Self, String> {
        let typed: Vec<PathBuf> = raw.files.iter().chain(&raw.input).cloned().collect();
        let files = folders::expanded(&typed, raw.recursive_dir_add == Some(true))?;
        let grouping = grouping(&raw);
        let mode = mode(&raw);
        let mut ignored = raw.gpu_only.warnings();
        ignored.extend(ignored::warnings(&raw, &mode));
        check_stdin(&mode, &files)?;
        let images = Source::group(&files, &grouping).len();
        check_output(&mode, images)?;
        check_outputs(&mode, &raw.outputs)?;
        check_frames(&raw, &mode)?;
        if raw.json == Some(true) && raw.output == Some(Destination::Stdout) {
            return Err(
                "--json and --output - both write to standard output; name a file for the image".to_owned()
            );
        }
        Ok(Self {
            limit: limit(&raw, &mode)?,
            mode,
            files,
            goes_deep: raw.recursive_dir_add == Some(true),
            grouping,
            max_bytes: raw.max_size,
            format: raw.force_reader,
            up: raw.up,
            scene: raw.scene.clone(),
            variant: raw.variant.clone(),
            moment: moment(&raw),
            sequence: sequence(&raw.animation),
            environment: raw.effects.environment(),
            framing: framing(&raw)?,
            look: look(&raw),
            scenery: scenery(&raw),
            overlay: overlay(&raw.scenery),
            reference: reference(&raw),
            compared: raw.compare.clone(),
            script: raw.command_script.clone(),
            json: raw.json == Some(true),
            skip_empty: raw.remove_empty_file_groups == Some(true),
            shows_progress: raw.loading_progress == Some(true),
            screenshot: raw.screenshot_filename.clone(),
            state_file: raw.statefile_filename.clone(),
            hidden: raw.hide_nodes.clone(),
            placed: raw.place_node.clone(),
            settings: settings(&raw)?,
            outputs: raw.outputs.clone(),
            window: raw.window.clone(),
            shows_frame_time: raw.scenery.fps == Some(true),
            notifies: raw.scenery.notifications != Some(false),
            level: raw.verbose,
            ignored,
            line: CommandLine::default(),
        })
    }
}

fn grouping(raw: &RawArgs) -> Grouping {
    if let Some(names) = &raw.multi_file_regex {
        return Grouping::ByName(names.clone());
    }
    match raw.multi_file_mode {
        MultiFileMode::Single => Grouping::OneByOne,
        MultiFileMode::All => Grouping::Together,
        MultiFileMode::Dir => Grouping::ByFolder,
    }
}

fn mode(raw: &RawArgs) -> Mode {
    let (output, capture) = (raw.output.clone(), raw.capture.clone());
    if let (Some(other), Some(output)) = (&raw.compare, &output) {
        return Mode::Compare { other: other.clone(), output: output.clone() };
    }
    match (&raw.replay, raw.effects.explain) {
        _ if raw.list_readers => Mode::ListReaders,
        _ if raw.list_bindings => Mode::ListBindings,
        _ if raw.list_rendering_backends => Mode::ListBackends,
        _ if let Some(Some(purpose)) = raw.check => Mode::Check(purpose),
        _ if raw.no_render == Some(true) => Mode::Inspect,
        _ if let Some(output) = &raw.quality.frontier => Mode::Frontier(output.clone()),
        _ if let Some(pixel) = raw.explain_pixel => Mode::ExplainPixel(pixel),
        (_, Some(explanation)) => Mode::Explain(explanation),
        (Some(replay), None) => Mode::Replay { capture: replay.clone(), output },
        (None, None) if output.is_some() || capture.is_some() || raw.reference.is_some() => {
            Mode::Image { output, capture }
        }
        (None, None) => Mode::Window,
    }
}

fn moment(raw: &RawArgs) -> Option<Moment> {
    let animation = &raw.animation;
    if animation.animation_indices.is_none()
        && animation.animation_time.is_none()
        && animation.animation_jump.is_empty()
    {
        return None;
    }
    Some(Moment {
        clips: animation.animation_indices.clone().unwrap_or_else(|| vec![Clip::Number(0)]),
        seconds: animation.animation_time.unwrap_or(0.0),
        jumps: animation.animation_jump.clone(),
        frame_rate: animation.frame_rate,
    })
}

fn sequence(animation: &AnimationArgs) -> Frames {
    Frames {
        turntable: animation.turntable,
        cameras: animation.cameras.clone(),
        rate: animation.frame_rate,
        speed: animation.animation_speed_factor,
        autoplay: animation.animation_autoplay == Some(true),
        progress: animation.animation_progress,
    }
}

fn scenery(raw: &RawArgs) -> Scenery {
    /// The length of normals, as a fraction of the model's diagonal.
    const NORMALS: f64 = 0.02;
    let (flags, material) = (&raw.scenery, &raw.material);
    let grid = Grid {
        unit: flags.grid_unit,
        subdivisions: flags.grid_subdivisions,
        color: flags.grid_color,
        absolute: flags.grid_absolute == Some(true),
    };
    let sprites = Sprites {
        size: f64::from(material.point_sprites_size),
        absolute: material.point_sprites_absolute_size == Some(true),
    };
    Scenery {
        grid,
        shows_grid: flags.grid == Some(true),
        normals: (flags.normal_glyphs == Some(true)).then(|| NORMALS * f64::from(flags.normal_glyphs_scale)),
        bones: flags.armature == Some(true),
        sprites: matches!(material.point_sprites, Some(PointSprites::Sphere)).then_some(sprites),
    }
}

fn overlay(flags: &SceneryArgs) -> Overlay {
    Overlay {
        axes: [flags.x_color, flags.y_color, flags.z_color],
        shows_axes: flags.axis == Some(true),
        name: flags.filename == Some(true),
        metadata: flags.metadata == Some(true),
        tree: flags.scene_hierarchy == Some(true),
        environment_name: flags.hdri_filename == Some(true),
        text_scale: flags.font_scale,
    }
}

fn reference(raw: &RawArgs) -> Option<Reference> {
    let threshold = raw.reference_threshold;
    raw.reference.clone().map(|file| Reference { file, threshold })
}

fn framing(raw: &RawArgs) -> Result<Framing, String> {
    if raw.camera_position.is_some() && raw.camera_position == raw.camera_focal_point {
        return Err(
            "--camera-position and --camera-focal-point are the same point, so the view direction is undefined; move one of them".to_owned()
        );
    }
    let scene_camera = raw.camera_index.and_then(|index| usize::try_from(index).ok());
    let exact = raw.camera_exact.map(Eye::Exact);
    let eye = match (raw.camera_position, raw.camera_direction, raw.view, scene_camera) {
        (Some(position), ..) => Eye::Position(position),
        (None, Some(direction), ..) => Eye::Direction(direction),
        (None, None, Some(view), _) => Eye::Side(axis_view(view)),
        (None, None, None, Some(index)) => Eye::SceneCamera(index),
        (None, None, None, None) => Eye::Default,
    };
    Ok(Framing {
        eye: exact.unwrap_or(eye),
        view_up: raw.camera_view_up,
        focal_point: raw.camera_focal_point,
        view_angle: raw.camera_view_angle,
        zoom: raw.camera_zoom_factor,
        azimuth: raw.camera_azimuth_angle,
        elevation: raw.camera_elevation_angle,
        orthographic: raw.camera_orthographic.unwrap_or(false),
        turns: raw.camera_turn.clone(),
    })
}

fn axis_view(view: View) -> AxisView {
    match view {
        View::Front => AxisView::Front,
        View::Back => AxisView::Back,
        View::Left => AxisView::Left,
        View::Right => AxisView::Right,
        View::Top => AxisView::Top,
        View::Bottom => AxisView::Bottom,
        View::Iso => AxisView::Isometric,
    }
}

fn look(raw: &RawArgs) -> Look {
    let material = &raw.material;
    Look {
        color: material.color,
        opacity: material.opacity,
        roughness: material.roughness,
        metallic: material.metallic,
        ior: material.base_ior,
        emissive: material.emissive_factor,
        normal_scale: material.normal_scale,
        textures: Textures {
            base_color: material.texture_base_color.clone(),
            material: material.texture_material.clone(),
            emissive: material.texture_emissive.clone(),
            normal: material.texture_normal.clone(),
        },
        texture_transform: material.textures_transform,
        checkerboard: material.checkerboard == Some(true),
        unlit: material.unlit.unwrap_or(false),
        backfaces: match raw.backface_type {
            BackfaceType::Default => None,
            BackfaceType::Visible => Some(Backfaces::Visible),
            BackfaceType::Hidden => Some(Backfaces::Hidden),
        },
    }
}

fn settings(raw: &RawArgs) -> Result<RenderSettings, String> {
    let mut settings = RenderSettings::new(raw.resolution.width, raw.resolution.height);
    (settings.samples_per_axis, settings.samples) = samples(raw)?;
    if raw.no_background == Some(true) {
        settings.background = Background::Transparent;
    } else if let Some(skybox) = raw.effects.skybox()? {
        settings.background = skybox;
    } else if let Some(color) = raw.background_color {
        settings.background = Background::Color(color);
    }
    if let Some(color) = raw.background_color.filter(|_| raw.no_background != Some(true)) {
        settings.edge_color = edges_before(color, settings.edge_color);
    }
    settings.style = match (raw.style, raw.edges) {
        (Some(DrawStyle::Edges), _) | (None, Some(true)) => Style::SurfaceWithEdges,
        (Some(DrawStyle::Wireframe), _) => Style::Wireframe,
        (Some(DrawStyle::HiddenLine), _) => Style::HiddenLine,
        (Some(DrawStyle::Surface), _) | (None, _) => Style::Surface,
    };
    settings.display = if raw.display_depth == Some(true) { Display::Depth } else { raw.display };
    settings.line_width = raw.line_width;
    settings.point_size = raw.material.point_size;
    settings.light_intensity = raw.light_intensity;
    raw.effects.apply(&mut settings);
    if let Some(preset) = raw.quality.preset {
        insisted(raw)?.change(preset.quality()).apply(&mut settings);
    }
    raw.outputs.iter().for_each(|beside| beside.output.ask_for(&mut settings.outputs));
    // OpenEXR is for light: bytes would hold it to the display's range.
    settings.outputs.radiance |=
        matches!(&raw.output, Some(Destination::File(template)) if template.is_exr());
    settings.threads = raw.threads;
    settings.simd = raw.simd;
    Ok(settings)
}

/// Samples along each side of a pixel by supersampling, and in each of those by
/// multisampling.
fn samples(raw: &RawArgs) -> Result<(u32, u32), String> {
    match (raw.anti_aliasing.unwrap_or(AntiAliasing::Ssaa), raw.samples) {
        (AntiAliasing::None, None | Some(1)) => Ok((1, 1)),
        (AntiAliasing::None, Some(samples)) => Err(format!(
            "--anti-aliasing=none means one sample per pixel, but --samples={samples} is more; leave one of them out"
        )),
        (AntiAliasing::Ssaa, None) => Ok((3, 1)),
        (AntiAliasing::Ssaa, Some(samples @ 1..=4)) => Ok((samples, 1)),
        (AntiAliasing::Ssaa, Some(samples)) => Err(format!(
            "--samples={samples} along each side of a pixel is too many: write 1 to 4, or --anti-aliasing=msaa for so many in all"
        )),
        (AntiAliasing::Msaa, None) => Ok((1, 4)),
        (AntiAliasing::Msaa, Some(samples @ (1 | 2 | 4 | 8 | 16))) => Ok((1, samples)),
        (AntiAliasing::Msaa, Some(samples)) => {
            Err(format!("--anti-aliasing=msaa takes --samples=1, 2, 4, 8 or 16, not {samples}"))
        }
    }
}

/// Quality settings from individual flags.
fn insisted(raw: &RawArgs) -> Result<Insisted, String> {
    let says_samples = raw.anti_aliasing.is_some() || raw.samples.is_some();
    let samples = if says_samples { Some(samples(raw)?) } else { None };
    Ok(Insisted { samples, ..raw.effects.insisted() })
}

/// The time budget for an image.
fn limit(raw: &RawArgs, mode: &Mode) -> Result<Option<Limit>, String> {
    let Some(time) = raw.quality.time_budget else { return Ok(None) };
    if !matches!(mode, Mode::Image { .. } | Mode::Frontier(_)) {
        return Err("--time-budget needs an image, and none is drawn; name one (--output image.png), or choose a --preset".to_owned());
    }
    Ok(Some(Limit::new(time, insisted(raw)?)))
}

/// The colour of edges for a background: dark by default, or light if dark would not be visible.
/// Linear RGB.
fn edges_before(background: Vec3, usual: Vec3) -> Vec3 {
    /// Rec. 709: the contribution of each channel to luminance.
    const BRIGHTNESS: Vec3 = Vec3::new(0.2126, 0.7152, 0.0722);
    /// Here dark and light edges have the same contrast: the root of 0.05 × 1.05, less 0.05, as WCAG 2 has it.
    const EQUALLY_FAR: f32 = 0.18;
    const LIGHT: Vec3 = Vec3::splat(0.8);
    if background.dot(BRIGHTNESS) < EQUALLY_FAR { LIGHT } else { usual }
}
