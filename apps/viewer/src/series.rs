//! Image sequences: a turntable, or an animation frame by frame.

use trigon_camera::Camera;
use trigon_scene::Scene;

use crate::args::Request;
use crate::failure::Failure;
use crate::model::Model;
use crate::moment::{self, Clip};

/// An hour at 28 frames a second.
const MOST_FRAMES: u32 = 100_000;

/// What changes from frame to frame.
pub(crate) enum Series {
    /// The camera.
    Turntable(Vec<Camera>),
    /// The pose.
    Animation(Playing),
}

/// An animation, frame by frame.
pub(crate) struct Playing {
    camera: Camera,
    clips: Vec<usize>,
    /// Of the first frame.
    start: f64,
    /// From one frame to the next.
    step: f64,
    frames: u32,
}

impl Series {
    /// What the request asks for: its turntable, or the animation that its file has.
    pub(crate) fn new(model: &Model, request: &Request) -> Result<Self, Failure> {
        let aspect = request.settings.aspect();
        if let Some(views) = request.sequence.turntable {
            return model.turntable(&request.framing, aspect, views).map(Self::Turntable);
        }
        let clips = request.moment.as_ref().map_or(vec![Clip::Number(0)], |moment| moment.clips.clone());
        let clips = moment::chosen(&model.scene, &clips)?;
        let end = moment::duration(&model.scene, &clips);
        let (rate, speed) = (request.sequence.rate, request.sequence.speed);
        let asked = request.moment.as_ref().map(|moment| moment.seconds).filter(|seconds| *seconds != 0.0);
        let start = asked.unwrap_or(if speed < 0.0 { end } else { 0.0 });
        let left = if speed < 0.0 { start } else { end - start };
        // A frame that would lie at the end but for rounding is one.
        let frames = (left / speed.abs() * rate + 1e-9).floor() + 1.0;
        if frames > f64::from(MOST_FRAMES) {
            return Err(Failure::Usage(format!(
                "the animation has {frames} frames, more than {MOST_FRAMES}; write a smaller --frame-rate or a larger --animation-speed-factor"
            )));
        }
        let camera = model.shot(&request.framing, aspect)?.camera;
        // At least the pose at the start.
        let frames = (frames as u32).max(1);
        Ok(Self::Animation(Playing { camera, clips, start, step: speed / rate, frames }))
    }

    pub(crate) fn frames(&self) -> u32 {
        match self {
            Self::Turntable(cameras) => cameras.len() as u32,
            Self::Animation(playing) => playing.frames,
        }
    }

    /// Puts the scene where a frame has it; returns its camera.
    pub(crate) fn set(&self, scene: &mut Scene, frame: u32) -> Camera {
        match self {
            Self::Turntable(cameras) => cameras[frame as usize],
            Self::Animation(playing) => {
                let seconds = playing.start + playing.step * f64::from(frame);
                moment::pose(scene, &playing.clips, seconds);
                playing.camera
            }
        }
    }
}
