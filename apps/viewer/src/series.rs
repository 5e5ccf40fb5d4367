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
    Animation(AnimationFrames),
}

/// An animation, frame by frame.
pub(crate) struct AnimationFrames {
    camera: Camera,
    clips: Vec<usize>,
    /// Of the first frame.
    start: f64,
    /// How many times as fast; negative is backwards.
    speed: f64,
    /// Frames in a second.
    rate: f64,
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
        let (rate, speed) = (request.sequence.rate, request.sequence.speed);
        // Of frames in the animation's own time.
        let own_rate = rate / speed.abs();
        let end = moment::on_frame(moment::duration(&model.scene, &clips), own_rate);
        let requested =
            request.moment.as_ref().map(|moment| moment.seconds).filter(|seconds| *seconds != 0.0);
        let start = requested.unwrap_or(if speed < 0.0 { end } else { 0.0 });
        let left = if speed < 0.0 { start } else { end - start };
        let frames = moment::last_frame(left, own_rate) + 1.0;
        if frames > f64::from(MOST_FRAMES) {
            return Err(Failure::Usage(format!(
                "the animation has {frames} frames, more than {MOST_FRAMES}; write a smaller --frame-rate or a larger --animation-speed-factor"
            )));
        }
        let camera = model.shot(&request.framing, aspect)?.camera;
        // At least the pose at the start.
        let frames = (frames as u32).max(1);
        Ok(Self::Animation(AnimationFrames { camera, clips, start, speed, rate, frames }))
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
                // Divided last: k / rate in f64 rounds to the keyframe that was written for it.
                let seconds = playing.start + f64::from(frame) * playing.speed / playing.rate;
                moment::pose(scene, &playing.clips, seconds);
                playing.camera
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use trigon_mesh::primitives;
    use trigon_scene::{Animation, Channel, Curve, Interpolation, Material, NodeId, Property};

    use super::*;
    use crate::args::RawArgs;
    use crate::source::Source;

    /// A cube with steps along X, one keyframe for each frame at a rate, as exporters write them: frame k at f32(k / fps).
    fn model(keys: u32, fps: u32) -> (Model, NodeId) {
        let mut scene = Scene::new();
        let node = scene.add_object("cube", primitives::cube(1.0), Material::default());
        let times = (0..keys).map(|key| (f64::from(key) / f64::from(fps)) as f32).collect();
        let values = (0..keys).flat_map(|key| [key as f32, 0.0, 0.0]).collect();
        let curve = Curve::new(Interpolation::Step, 3, times, values).expect("a curve");
        let channels = vec![Channel { node, property: Property::Translation, curve }];
        scene.animations.push(Animation { name: "steps".to_owned(), channels });
        (Model::new(scene, Source::Files(vec!["steps.glb".into()]), &request("")).expect("a cube"), node)
    }

    fn request(flags: &str) -> Request {
        let words = ["trigon-viewer"].into_iter().chain(flags.split_whitespace());
        Request::new(RawArgs::parse_from(words)).expect("consistent flags")
    }

    /// Which keyframe each frame of a series shows.
    fn shown(keys: u32, fps: u32, flags: &str) -> Vec<u32> {
        let (mut model, node) = model(keys, fps);
        let flags = format!("--output f.gif --frame-rate={fps} {flags}");
        let series = Series::new(&model, &request(&flags)).expect("it has an animation");
        let key = |frame| {
            series.set(&mut model.scene, frame);
            model.scene.world_transform(node).translation.x as u32
        };
        (0..series.frames()).map(key).collect()
    }

    /// At their own rate 9 of 25 frames showed the keyframe before, and the last frame was lost where f32 rounds its
    /// time down.
    #[test]
    fn steps_written_at_their_own_rate_show_one_keyframe_a_frame() {
        for (keys, fps) in [(25, 24), (31, 30), (24, 30), (100, 25), (500, 60), (700, 7), (250, 240)] {
            let all: Vec<u32> = (0..keys).collect();
            assert_eq!(shown(keys, fps, ""), all, "{keys} at {fps} per second");
            let backwards: Vec<u32> = all.iter().rev().copied().collect();
            assert_eq!(
                shown(keys, fps, "--animation-speed-factor=-100%"),
                backwards,
                "{keys} at {fps}, backwards"
            );
            let halves: Vec<u32> = (0..2 * keys - 1).map(|frame| frame / 2).collect();
            assert_eq!(shown(keys, fps, "--animation-speed-factor=50%"), halves, "{keys} at {fps}, slowly");
        }
    }
}
