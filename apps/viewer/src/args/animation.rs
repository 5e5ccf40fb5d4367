//! Flags for animations and image sequences.

use std::path::PathBuf;
use std::str::FromStr;

use super::values;
use crate::moment::{Clip, Jump};

/// Flags for animations.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct AnimationArgs {
    /// Animations to show, by numbers from 0 or by names; a negative number means all of them
    #[arg(
        long,
        alias = "animation-index",
        value_name = "N,...",
        value_delimiter = ',',
        action = clap::ArgAction::Set,
        value_parser = clap::value_parser!(Clip),
        allow_negative_numbers = true,
        help_heading = "Animation"
    )]
    pub(crate) animation_indices: Option<Vec<Clip>>,

    /// The time to show, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = values::seconds, allow_negative_numbers = true, help_heading = "Animation")]
    pub(crate) animation_time: Option<f64>,

    /// Play animations this many times as fast; a negative number plays them backwards
    #[arg(long, value_name = "RATIO", default_value = "1", value_parser = values::speed, allow_negative_numbers = true, help_heading = "Animation")]
    pub(crate) animation_speed_factor: f64,

    /// Begin to play when the window opens
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "true", value_name = "BOOL", value_parser = values::switch, help_heading = "Animation")]
    pub(crate) animation_autoplay: Option<bool>,

    /// Show the animation bar in the window: none, default or advanced (with names and times) [default:
    /// advanced, if there are animations]
    #[arg(long, num_args = 0..=1, require_equals = true, default_missing_value = "default", value_name = "KIND", help_heading = "Animation")]
    pub(crate) animation_progress: Option<AnimationProgress>,

    /// Frames per second, for --output with {frame} and for animated images
    #[arg(long, value_name = "N", default_value = "30", value_parser = values::frame_rate, allow_negative_numbers = true, help_heading = "Animation")]
    pub(crate) frame_rate: f64,

    /// Draw N views once around the model: to a .gif or .apng file, or to numbered files ({frame} in the name)
    #[arg(long, value_name = "N", value_parser = values::count::<1, 3600>, allow_negative_numbers = true, requires = "output", help_heading = "Animation")]
    pub(crate) turntable: Option<u32>,

    /// Draw a view by each camera of a file: trigon's JSON, NeRF's transforms.json, or a folder with COLMAP's text
    /// model; {frame} or {camera} in the name of --output
    ///
    /// Sizes are the file's unless --resolution is given. docs/cameras.md describes the formats. What --json writes
    /// is such a file, too.
    #[arg(long, value_name = "FILE", requires = "output", help_heading = "Animation", conflicts_with_all = [
        "turntable", "view", "camera_direction", "camera_position", "camera_focal_point", "camera_view_up",
        "camera_index", "camera_exact", "camera_view_angle", "camera_zoom_factor", "camera_azimuth_angle",
        "camera_elevation_angle", "camera_orthographic", "compare", "reference",
    ])]
    pub(crate) cameras: Option<PathBuf>,

    /// A jump in time, as in command scripts.
    #[arg(long, hide = true, allow_hyphen_values = true)]
    pub(crate) animation_jump: Vec<Jump>,
}

/// How the time is displayed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum AnimationProgress {
    None,
    Default,
    Advanced,
}

impl FromStr for Clip {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(match text.trim().parse::<i64>() {
            Ok(number) => usize::try_from(number).map_or(Self::All, Self::Number),
            Err(_) => Self::Name(text.trim().to_owned()),
        })
    }
}

impl FromStr for Jump {
    type Err = String;

    /// `frame:3`, `time-by:0.5` and similar.
    fn from_str(text: &str) -> Result<Self, String> {
        let (kind, amount) = text.split_once(':').unwrap_or((text, ""));
        let seconds = || values::seconds(amount);
        let count = || amount.trim().parse::<i64>().map_err(|_| "write a whole number".to_owned());
        Ok(match kind {
            "time" => Self::Time(seconds()?),
            "time-by" => Self::TimeBy(seconds()?),
            "frame" => Self::Frame(count()?),
            "frame-by" => Self::FrameBy(count()?),
            "keyframe" => Self::Keyframe(count()?),
            "keyframe-by" => Self::KeyframeBy(count()?),
            _ => return Err("write time, frame or keyframe, a colon and a number".to_owned()),
        })
    }
}
