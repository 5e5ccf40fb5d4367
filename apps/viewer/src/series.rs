//! Image sequences: the cameras of a file, a turntable, or an animation frame by frame.

use std::path::Path;

use trigon_camera::{Camera, FisheyeLens, Viewport};
use trigon_io::{CameraView, Limits, load_cameras};
use trigon_scene::Scene;

use crate::args::Request;
use crate::failure::Failure;
use crate::framing::Shot;
use crate::model::Model;
use crate::moment::{self, Clip};
use crate::report::Reporter;

/// An hour at 28 frames a second.
const MOST_FRAMES: u32 = 100_000;

/// What changes from frame to frame.
pub(crate) enum Series {
    /// The camera and the image's size.
    Cameras(Vec<SeriesCamera>),
    /// The camera.
    Turntable(Vec<Shot>),
    /// The pose.
    Animation(AnimationFrames),
}

/// A camera of a file.
pub(crate) struct SeriesCamera {
    name: String,
    view: SeriesView,
}

/// How one image is drawn.
#[derive(Clone, Copy)]
pub(crate) struct SeriesView {
    pub(crate) shot: Shot,
    /// In place of the camera's projection.
    pub(crate) lens: Option<FisheyeLens>,
    pub(crate) image: Viewport,
    /// Whether the clip planes are given. If not, they may have to be wider for what is shown beside the model.
    pub(crate) has_clip_planes: bool,
}

/// An animation, frame by frame.
pub(crate) struct AnimationFrames {
    shot: Shot,
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
    /// What the request asks for: its cameras, its turntable, or the animation that its file has.
    pub(crate) fn new(model: &Model, request: &Request, reporter: Reporter) -> Result<Self, Failure> {
        let aspect = request.settings.aspect();
        if let Some(file) = &request.sequence.cameras {
            return cameras(file, model, request, reporter).map(Self::Cameras);
        }
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
        let shot = model.shot(&request.framing, aspect)?;
        // At least the pose at the start.
        let frames = (frames as u32).max(1);
        Ok(Self::Animation(AnimationFrames { shot, clips, start, speed, rate, frames }))
    }

    pub(crate) fn frames(&self) -> u32 {
        match self {
            Self::Cameras(cameras) => cameras.len() as u32,
            Self::Turntable(shots) => shots.len() as u32,
            Self::Animation(playing) => playing.frames,
        }
    }

    /// The name of a frame's camera; empty if it has none.
    pub(crate) fn name(&self, frame: u32) -> &str {
        match self {
            Self::Cameras(cameras) => &cameras[frame as usize].name,
            Self::Turntable(_) | Self::Animation(_) => "",
        }
    }

    /// The size that all images have.
    pub(crate) fn common_size(&self, request: &Request) -> Result<Viewport, Failure> {
        let Self::Cameras(cameras) = self else { return Ok(size(request)) };
        let first = cameras.first().map_or(size(request), |camera| camera.view.image);
        if cameras.iter().all(|camera| camera.view.image == first) {
            return Ok(first);
        }
        Err(Failure::Usage(
            "the cameras' images have different sizes, but those of one file have the same; set --resolution, or write {frame} in the name of --output".to_owned(),
        ))
    }

    /// Puts the scene where a frame has it; returns how it is drawn.
    pub(crate) fn set(&self, scene: &mut Scene, frame: u32, request: &Request) -> SeriesView {
        let shot = match self {
            Self::Cameras(cameras) => return cameras[frame as usize].view,
            Self::Turntable(shots) => shots[frame as usize],
            Self::Animation(playing) => {
                // Divided last: k / rate in f64 rounds to the keyframe that was written for it.
                let seconds = playing.start + f64::from(frame) * playing.speed / playing.rate;
                moment::pose(scene, &playing.clips, seconds);
                playing.shot
            }
        };
        SeriesView { shot, lens: None, image: size(request), has_clip_planes: false }
    }
}

/// The size of images whose camera has none.
fn size(request: &Request) -> Viewport {
    Viewport { width: request.settings.width, height: request.settings.height }
}

/// The cameras of a file, for images of --resolution, or else of their own size.
fn cameras(
    file: &Path,
    model: &Model,
    request: &Request,
    reporter: Reporter,
) -> Result<Vec<SeriesCamera>, Failure> {
    let read = load_cameras(file, size(request), &Limits::default()).map_err(Failure::work)?;
    read.warnings.iter().for_each(|warning| reporter.warning(warning));
    if read.views.len() > MOST_FRAMES as usize {
        return Err(Failure::Usage(format!(
            "{}: it has {} cameras, more than {MOST_FRAMES}; divide it",
            file.display(),
            read.views.len()
        )));
    }
    let has_size = request.line.is_given("resolution", model.source.first_file());
    let bounds = model.scene.tight_bounds();
    let placed = read.views.into_iter().map(
        |CameraView { name, camera, lens, image, has_own_size, has_clip_planes }| {
            let camera = if has_clip_planes { camera } else { camera.with_clip_planes(&bounds) };
            let image = if has_own_size && !has_size { image } else { size(request) };
            let shot = Shot { camera, distance: distance(&camera, model) };
            SeriesCamera { name, view: SeriesView { shot, lens, image, has_clip_planes } }
        },
    );
    Ok(placed.collect())
}

/// How far ahead of a camera the middle of the model is; of one that is behind it, any distance will do.
fn distance(camera: &Camera, model: &Model) -> f64 {
    let ahead = model.center().map(|center| (center - camera.position).dot(camera.forward()));
    ahead.filter(|ahead| *ahead > 0.0).unwrap_or(1.0)
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
        let request = request(&flags);
        let series =
            Series::new(&model, &request, Reporter::new(request.level)).expect("it has an animation");
        let key = |frame| {
            series.set(&mut model.scene, frame, &request);
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
