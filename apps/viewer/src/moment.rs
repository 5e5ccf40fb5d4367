//! The pose of a model: animations at a time.

use trigon_scene::{Animation, Scene};

use crate::failure::Failure;

/// Which animation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Clip {
    /// By its number in the file.
    Number(usize),
    /// By its name.
    Name(String),
    /// All that there are.
    All,
}

/// A step in time, as command scripts take it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Jump {
    /// To a time in seconds.
    Time(f64),
    /// By so many seconds.
    TimeBy(f64),
    /// To a frame; negative ones count from the end.
    Frame(i64),
    /// By so many frames.
    FrameBy(i64),
    /// To a keyframe, or to the last one.
    Keyframe(i64),
    /// By so many keyframes.
    KeyframeBy(i64),
}

/// A moment of some animations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Moment {
    /// Which.
    pub(crate) clips: Vec<Clip>,
    /// Before its start and after its end an animation stands still.
    pub(crate) seconds: f64,
    /// Then these.
    pub(crate) jumps: Vec<Jump>,
    /// What a frame of a jump is.
    pub(crate) frame_rate: f64,
}

impl Moment {
    /// Puts the nodes of a scene where its animations have them. Returns what is odd about
    /// the time.
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<Option<String>, Failure> {
        let chosen = chosen(scene, &self.clips)?;
        let duration = duration(scene, &chosen);
        let seconds = self.time(scene, &chosen);
        pose(scene, &chosen, seconds);
        let beyond = !(0.0..=duration).contains(&seconds);
        Ok(beyond.then(|| {
            let (stays, end) = if seconds < 0.0 { ("start", 0.0) } else { ("end", duration) };
            format!("there is no animation at {seconds} s; the pose of the {stays}, at {end} s, is shown")
        }))
    }

    /// The time after all jumps.
    fn time(&self, scene: &Scene, chosen: &[usize]) -> f64 {
        self.jumps.iter().fold(self.seconds, |now, &jump| jump.from(now, scene, chosen, self.frame_rate))
    }
}

impl Jump {
    /// The time after a jump from another one; a frame is a part of a second.
    pub(crate) fn from(self, now: f64, scene: &Scene, chosen: &[usize], frame_rate: f64) -> f64 {
        let (duration, keyframes) = (duration(scene, chosen), keyframes(scene, chosen));
        let last_frame = last_frame(duration, frame_rate) as i64;
        match self {
            Self::Time(to) => to,
            Self::TimeBy(by) => now + by,
            Self::Frame(frame) if frame < 0 => (last_frame + 1 + frame).max(0) as f64 / frame_rate,
            Self::Frame(frame) => frame as f64 / frame_rate,
            Self::FrameBy(by) => now + by as f64 / frame_rate,
            Self::Keyframe(to) => keyframe(&keyframes, to).unwrap_or(now),
            Self::KeyframeBy(by) => {
                // A frame's time may lie before its keyframe by what f32 rounds.
                let now = f64::from(now as f32);
                let here = keyframes.partition_point(|&time| time <= now) as i64 - 1;
                keyframe(&keyframes, here + by).unwrap_or(now)
            }
        }
    }
}

/// The numbers of animations, each once.
pub(crate) fn chosen(scene: &Scene, clips: &[Clip]) -> Result<Vec<usize>, Failure> {
    let animations = &scene.animations;
    let mut chosen = Vec::new();
    for clip in clips {
        let found = match clip {
            Clip::All => 0..animations.len(),
            Clip::Number(number) if *number < animations.len() => *number..number + 1,
            Clip::Number(number) => return Err(missing(&number.to_string(), animations)),
            Clip::Name(name) => match animations.iter().position(|animation| animation.name == *name) {
                Some(index) => index..index + 1,
                None => return Err(missing(name, animations)),
            },
        };
        chosen.extend(found.filter(|index| !chosen.contains(index)).collect::<Vec<_>>());
    }
    if animations.is_empty() {
        return Err(missing("0", animations));
    }
    Ok(chosen)
}

/// Seconds until the last of them ends.
pub(crate) fn duration(scene: &Scene, chosen: &[usize]) -> f64 {
    let ends = chosen.iter().filter_map(|&index| scene.animations.get(index)).map(Animation::duration);
    ends.fold(0.0, |longest, end| if end > longest { end } else { longest })
}

/// The number of the last frame that begins within so many seconds. The last keyframe is a number of f32: a
/// frame that would begin there but for that rounding does.
pub(crate) fn last_frame(seconds: f64, rate: f64) -> f64 {
    let (before, nearest) = ((seconds * rate).floor(), (seconds * rate).round());
    if is_at_frame(nearest, seconds, rate) { nearest } else { before }
}

/// A time, or that of the frame that has it but for what f32 rounds: frames counted from there, also
/// backwards, are frames counted from 0.
pub(crate) fn on_frame(seconds: f64, rate: f64) -> f64 {
    let nearest = (seconds * rate).round();
    if is_at_frame(nearest, seconds, rate) { nearest / rate } else { seconds }
}

fn is_at_frame(frame: f64, seconds: f64, rate: f64) -> bool {
    (frame / rate) as f32 == seconds as f32
}

/// Puts nodes where animations have them at a time, one after the other.
pub(crate) fn pose(scene: &mut Scene, chosen: &[usize], seconds: f64) {
    for &index in chosen {
        let pose = scene.pose(&scene.animations[index], seconds);
        scene.apply_pose(&pose);
    }
}

/// The times of all keyframes in their order, each once.
fn keyframes(scene: &Scene, chosen: &[usize]) -> Vec<f64> {
    let animations = chosen.iter().filter_map(|&index| scene.animations.get(index));
    let channels = animations.flat_map(|animation| &animation.channels);
    let mut times: Vec<f64> =
        channels.flat_map(|channel| channel.curve.times()).map(|&time| f64::from(time)).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// The time of a keyframe, held to those that there are.
fn keyframe(times: &[f64], number: i64) -> Option<f64> {
    let last = times.len().checked_sub(1)?;
    times.get(usize::try_from(number).unwrap_or(0).min(last)).copied()
}

fn missing(wanted: &str, animations: &[Animation]) -> Failure {
    Failure::work(match animations.len() {
        0 => {
            "there is no animation in the file; leave --animation-indices and --animation-time out".to_owned()
        }
        _ => {
            let names =
                animations.iter().enumerate().map(|(index, animation)| format!("{index} {}", animation.name));
            let names = names.collect::<Vec<_>>().join(", ");
            format!(
                "--animation-indices={wanted} finds no animation; write a number or a name: this file has {names}"
            )
        }
    })
}

#[cfg(test)]
mod tests {
    use trigon_scene::{Channel, Curve, Interpolation, Node, Property};

    use super::*;

    /// A node that moves to the right, with keyframes at 0, 1 and 2.5 s.
    fn scene() -> Scene {
        let mut scene = Scene::new();
        let node = scene.add(Node::default());
        let values = vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0];
        let curve = Curve::new(Interpolation::Linear, 3, vec![0.0, 1.0, 2.5], values).expect("a curve");
        let channels = vec![Channel { node, property: Property::Translation, curve }];
        scene.animations.push(Animation { name: "Walk".to_owned(), channels });
        scene.animations.push(Animation { name: "Run".to_owned(), channels: Vec::new() });
        scene
    }

    fn moment(jumps: &[Jump]) -> Moment {
        Moment { clips: vec![Clip::Number(0)], seconds: 0.5, jumps: jumps.to_vec(), frame_rate: 10.0 }
    }

    #[test]
    fn jumps_follow_each_other() {
        let scene = scene();
        for (jumps, expected) in [
            (&[][..], 0.5),
            (&[Jump::Time(2.0), Jump::TimeBy(-0.5)], 1.5),
            (&[Jump::Frame(10)], 1.0),
            (&[Jump::Frame(-1)], 2.5),
            (&[Jump::Frame(-2)], 2.4),
            (&[Jump::Frame(3), Jump::FrameBy(1)], 0.4),
            (&[Jump::Keyframe(1)], 1.0),
            (&[Jump::Keyframe(10)], 2.5),
            (&[Jump::KeyframeBy(1)], 1.0),
            (&[Jump::KeyframeBy(0)], 0.0),
            (&[Jump::Time(2.0), Jump::KeyframeBy(-1)], 0.0),
        ] {
            assert!((moment(jumps).time(&scene, &[0]) - expected).abs() < 1e-12, "{jumps:?}");
        }
    }

    /// From a frame's time, which f32 rounds up in its keyframe, the next keyframe was the same one again.
    #[test]
    fn keyframes_follow_each_other_also_from_the_time_of_a_frame() {
        let mut scene = Scene::new();
        let node = scene.add(Node::default());
        let times: Vec<f32> = (0..25).map(|key| (f64::from(key) / 24.0) as f32).collect();
        let curve = Curve::new(Interpolation::Step, 3, times.clone(), vec![0.0; 75]).expect("a curve");
        let channels = vec![Channel { node, property: Property::Translation, curve }];
        scene.animations.push(Animation { name: String::new(), channels });
        for frame in 0..24 {
            let jumps = [Jump::Frame(frame), Jump::KeyframeBy(1)];
            let moment = Moment { frame_rate: 24.0, ..moment(&jumps) };
            assert_eq!(
                moment.time(&scene, &[0]),
                f64::from(times[frame as usize + 1]),
                "after frame {frame}"
            );
        }
        for keys in [24, 25] {
            let end = f64::from((f64::from(keys - 1) / 30.0) as f32);
            assert_eq!(last_frame(end, 30.0), f64::from(keys - 1), "frames at 30 per second until {end} s");
        }
    }

    /// "invalid digit found in string" was said of a name.
    #[test]
    fn clips_have_names_and_messages_list_them() {
        let scene = scene();
        let names = [Clip::Name("Run".to_owned()), Clip::Number(1), Clip::All];
        assert_eq!(chosen(&scene, &names).expect("both"), [1, 0], "each once");
        let message = chosen(&scene, &[Clip::Name("Fly".to_owned())]).expect_err("none").to_string();
        assert!(message.contains("Fly") && message.contains("0 Walk, 1 Run"), "{message}");
    }

    #[test]
    fn a_time_beyond_the_end_is_said() {
        let mut scene = scene();
        let said = moment(&[Jump::Time(7.0)]).apply(&mut scene).expect("fine");
        assert!(said.expect("odd").contains("the pose of the end, at 2.5 s"), "where it ends");
        assert_eq!(moment(&[]).apply(&mut scene).expect("fine"), None, "nothing to say");
    }
}
