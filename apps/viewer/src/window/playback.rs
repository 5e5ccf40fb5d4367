//! Playing animations: a clock advanced by ticks, and the bar under the image with a scrubber, the
//! clips' names, speed and loop.

use std::time::Duration;

use trigon_scene::Scene;
use trigon_window::{Stage, choose, egui};

use crate::args::AnimationProgress;
use crate::args::Request;
use crate::moment::{self, Clip, Jump};

/// Speeds that can be chosen, forwards.
const SPEEDS: [f64; 5] = [0.25, 0.5, 1.0, 2.0, 4.0];

/// Which animations move the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Playing {
    /// All at once.
    All,
    /// The one of this number.
    One(usize),
    /// Some that the command line names.
    Named,
    /// None: the model stays as the file has it.
    None,
}

/// The animations of the model that is shown.
pub(super) struct Playback {
    names: Vec<String>,
    choice: Playing,
    named: Vec<usize>,
    is_playing: bool,
    loops: bool,
    /// How many times as fast; negative is backwards.
    speed: f64,
    seconds: f64,
    duration: f64,
    progress: AnimationProgress,
    /// Whether the model is in the pose of this time, and not as the file has it.
    is_posed: bool,
    /// The nodes as they are without animation.
    at_rest: Scene,
}

impl Playback {
    /// The animations of a scene, in the pose in which it is; `None` if it has none.
    pub(super) fn new(scene: &Scene, request: &Request) -> Option<Self> {
        if scene.animations.is_empty() {
            return None;
        }
        let moment = request.moment.as_ref();
        // What finds none was refused when the file was loaded.
        let named =
            moment.and_then(|moment| moment::chosen(scene, &moment.clips).ok()).unwrap_or_else(|| vec![0]);
        let all = moment.is_some_and(|moment| moment.clips.contains(&Clip::All));
        let choice = match named.as_slice() {
            _ if all => Playing::All,
            [one] => Playing::One(*one),
            _ => Playing::Named,
        };
        let mut playback = Self {
            names: scene.animations.iter().map(|animation| animation.name.clone()).collect(),
            choice,
            named,
            is_playing: request.sequence.autoplay,
            loops: true,
            speed: request.sequence.speed,
            seconds: moment.map_or(0.0, |moment| moment.seconds),
            duration: 0.0,
            is_posed: moment.is_some(),
            progress: request.sequence.progress.unwrap_or(AnimationProgress::Advanced),
            at_rest: scene.clone(),
        };
        playback.duration = moment::duration(scene, &playback.clips());
        Some(playback)
    }

    /// The numbers of the animations that are played.
    fn clips(&self) -> Vec<usize> {
        match self.choice {
            Playing::All => (0..self.names.len()).collect(),
            Playing::One(index) => vec![index],
            Playing::Named => self.named.clone(),
            Playing::None => Vec::new(),
        }
    }

    /// The flags that show the pose of this moment.
    pub(super) fn flags(&self) -> Vec<String> {
        let clips = self.clips();
        if clips.is_empty() || !self.is_posed {
            return Vec::new();
        }
        let clips: Vec<String> = clips.iter().map(usize::to_string).collect();
        vec![format!("--animation-indices={}", clips.join(",")), format!("--animation-time={}", self.seconds)]
    }

    /// Of the bar, in points: about, before it is laid out.
    pub(super) fn height(&self) -> f32 {
        const BAR: f32 = 26.0;
        if self.progress == AnimationProgress::None { 0.0 } else { BAR }
    }

    pub(super) fn is_playing(&self) -> bool {
        self.is_playing
    }

    /// Plays or stops; from the other end where the animation has come to its end.
    pub(super) fn toggle(&mut self, stage: &mut Stage) {
        self.is_playing = !self.is_playing;
        if self.is_playing && self.is_over() {
            self.seconds = if self.speed < 0.0 { self.duration } else { 0.0 };
        }
        if self.is_playing {
            stage.animate();
        }
    }

    /// Plays in the other direction, or stops.
    pub(super) fn toggle_backward(&mut self, stage: &mut Stage) {
        self.speed = -self.speed;
        self.toggle(stage);
    }

    fn is_over(&self) -> bool {
        if self.speed < 0.0 { self.seconds <= 0.0 } else { self.seconds >= self.duration }
    }

    /// So much time has passed. Returns whether more of it is wanted.
    pub(super) fn advance(&mut self, stage: &mut Stage, delta: Duration) -> bool {
        if !self.is_playing {
            return false;
        }
        self.seconds += delta.as_secs_f64() * self.speed;
        if self.loops && self.duration > 0.0 {
            self.seconds = self.seconds.rem_euclid(self.duration);
        } else if self.is_over() {
            self.seconds = self.seconds.clamp(0.0, self.duration);
            self.is_playing = false;
        }
        self.pose(stage);
        self.is_playing
    }

    /// The next of: each animation, all, none. Returns what is said about it.
    pub(super) fn cycle(&mut self, stage: &mut Stage) -> String {
        self.choice = match self.choice {
            Playing::One(index) if index + 1 < self.names.len() => Playing::One(index + 1),
            Playing::One(_) if self.names.len() > 1 => Playing::All,
            Playing::One(_) | Playing::All => Playing::None,
            Playing::Named | Playing::None => Playing::One(0),
        };
        self.rewind(stage);
        format!("animation: {}", self.label(self.choice))
    }

    /// Goes to another time, held to those that there are.
    pub(super) fn jump(&mut self, stage: &mut Stage, jump: Jump, frame_rate: f64) {
        let to = jump.from(self.seconds, &stage.scene, &self.clips(), frame_rate);
        self.seconds = to.clamp(0.0, self.duration);
        self.pose(stage);
    }

    fn rewind(&mut self, stage: &mut Stage) {
        self.duration = moment::duration(&stage.scene, &self.clips());
        self.seconds = 0.0;
        // What the animations before have moved goes back.
        let moved: Vec<_> = self.at_rest.nodes().iter().map(|(id, node)| (id, node.clone())).collect();
        for (id, node) in moved {
            if let Some(shown) = stage.scene.node_mut(id) {
                shown.transform = node.transform;
                shown.morph_weights = node.morph_weights;
            }
        }
        self.pose(stage);
    }

    fn pose(&mut self, stage: &mut Stage) {
        self.is_posed = true;
        moment::pose(&mut stage.scene, &self.clips(), self.seconds);
    }

    fn label(&self, choice: Playing) -> String {
        match choice {
            Playing::All => "all".to_owned(),
            Playing::Named => "as on the command line".to_owned(),
            Playing::None => "none".to_owned(),
            Playing::One(index) => match self.names[index].as_str() {
                "" => index.to_string(),
                name => name.to_owned(),
            },
        }
    }

    /// Shows the bar at the bottom, if it is to be seen.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, stage: &mut Stage) {
        if self.progress == AnimationProgress::None {
            return;
        }
        egui::Panel::bottom("animation").resizable(false).show(ui, |ui| {
            ui.horizontal_wrapped(|ui| self.controls(ui, stage));
        });
    }

    fn controls(&mut self, ui: &mut egui::Ui, stage: &mut Stage) {
        if ui.button(if self.is_playing { "Pause" } else { "Play" }).clicked() {
            self.toggle(stage);
        }
        /// What stands beside the scrubber, in points, with and without the choices, and the least of it.
        const BESIDE: f32 = 430.0;
        const PLAY: f32 = 80.0;
        const LEAST: f32 = 100.0;
        let is_advanced = self.progress == AnimationProgress::Advanced;
        let free_width = ui.available_width() - if is_advanced { BESIDE } else { PLAY };
        ui.spacing_mut().slider_width = free_width.max(LEAST);
        let slider = egui::Slider::new(&mut self.seconds, 0.0..=self.duration.max(1e-3));
        let slider = slider.show_value(is_advanced).fixed_decimals(2).suffix(" s");
        if ui.add(slider).changed() {
            self.pose(stage);
        }
        if is_advanced {
            self.choices(ui, stage);
        }
    }

    /// Clip, speed and loop.
    fn choices(&mut self, ui: &mut egui::Ui, stage: &mut Stage) {
        let clips = (0..self.names.len()).map(Playing::One).chain([Playing::All, Playing::None]);
        let clips: Vec<_> = clips.map(|clip| (self.label(clip), clip)).collect();
        let shown = self.label(self.choice);
        let list = egui::ComboBox::from_id_salt("clip").selected_text(&shown).width(120.0).truncate();
        let (list, choice) = choose(ui, list, &clips, &self.choice);
        label(&list, "clip", &shown);
        if let Some(choice) = choice {
            self.choice = choice;
            self.rewind(stage);
        }
        let (sign, speed) = (self.speed.signum(), self.speed.abs());
        let speeds = SPEEDS.map(|speed| (format!("{speed}×"), speed));
        let shown = format!("{speed}×");
        let list = egui::ComboBox::from_id_salt("speed").selected_text(&shown).width(60.0);
        let (list, chosen) = choose(ui, list, &speeds, &speed);
        label(&list, "speed", &shown);
        self.speed = chosen.map_or(self.speed, |speed| sign * speed);
        ui.checkbox(&mut self.loops, "Loop");
    }
}

/// For those who use a screen reader, and for tests.
fn label(widget: &egui::Response, name: &str, value: &str) {
    widget.ctx.accesskit_node_builder(widget.id, |node| {
        node.set_label(name);
        node.set_value(value);
    });
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use trigon_mesh::primitives;
    use trigon_scene::{Animation, Channel, Curve, Interpolation, Material, NodeId, Property};

    use super::*;
    use crate::args::RawArgs;

    /// A cube with two animations: 4 m along X in 2 s, and 1 m along Y in 1 s.
    fn stage() -> (Stage, NodeId) {
        let mut scene = Scene::new();
        let node = scene.add_object("cube", primitives::cube(1.0), Material::default());
        for (name, end, to) in [("Walk", 2.0, [4.0, 0.0, 0.0]), ("Jump", 1.0, [0.0, 1.0, 0.0])] {
            let values = [[0.0; 3], to].concat();
            let curve = Curve::new(Interpolation::Linear, 3, vec![0.0, end], values).expect("a curve");
            let channels = vec![Channel { node, property: Property::Translation, curve }];
            scene.animations.push(Animation { name: name.to_owned(), channels });
        }
        let mut stage = Stage::new("test");
        stage.scene = scene.into();
        (stage, node)
    }

    fn playback(stage: &Stage, flags: &str) -> Playback {
        let words = ["trigon-viewer"].into_iter().chain(flags.split_whitespace());
        let request = Request::new(RawArgs::parse_from(words)).expect("consistent flags");
        Playback::new(&stage.scene, &request).expect("it has animations")
    }

    fn at(stage: &Stage, node: NodeId) -> [f64; 3] {
        stage.scene.world_transform(node).translation.to_array()
    }

    #[test]
    fn space_plays_and_stops_and_the_end_is_the_start() {
        let (mut stage, node) = stage();
        let mut playback = playback(&stage, "");
        assert!(!playback.advance(&mut stage, Duration::from_secs(1)), "at rest time does not pass");
        assert_eq!(at(&stage, node), [0.0; 3], "and nothing moves");
        playback.toggle(&mut stage);
        assert!(playback.advance(&mut stage, Duration::from_millis(500)), "it goes on");
        assert_eq!(at(&stage, node), [1.0, 0.0, 0.0], "2 m a second");
        assert!(playback.advance(&mut stage, Duration::from_secs(2)), "around the end");
        assert_eq!(at(&stage, node), [1.0, 0.0, 0.0], "one round later");
        playback.loops = false;
        assert!(!playback.advance(&mut stage, Duration::from_secs(9)), "it ends");
        assert_eq!(at(&stage, node), [4.0, 0.0, 0.0], "at the end");
        playback.toggle(&mut stage);
        playback.advance(&mut stage, Duration::from_millis(250));
        assert_eq!(at(&stage, node), [0.5, 0.0, 0.0], "from the start again");
    }

    #[test]
    fn speed_and_direction_are_those_of_the_flags() {
        let (mut stage, node) = stage();
        let mut playback =
            playback(&stage, "--animation-speed-factor=-200% --animation-autoplay --animation-time=2");
        assert!(playback.is_playing(), "at once");
        playback.advance(&mut stage, Duration::from_millis(500));
        assert_eq!(at(&stage, node), [2.0, 0.0, 0.0], "a second back");
        playback.is_playing = false;
        playback.toggle_backward(&mut stage);
        playback.advance(&mut stage, Duration::from_millis(250));
        assert_eq!(at(&stage, node), [3.0, 0.0, 0.0], "the other way");
    }

    #[test]
    fn w_goes_through_clips_all_and_none() {
        let (mut stage, node) = stage();
        let mut playback = playback(&stage, "--animation-indices=Walk");
        playback.toggle(&mut stage);
        playback.advance(&mut stage, Duration::from_millis(500));
        for expected in ["Jump", "all", "none", "Walk"] {
            let said = playback.cycle(&mut stage);
            assert_eq!(said, format!("animation: {expected}"), "in this order");
            assert_eq!(at(&stage, node), [0.0; 3], "{expected}: what moved goes back");
        }
        playback.cycle(&mut stage);
        playback.advance(&mut stage, Duration::from_millis(500));
        assert_eq!(at(&stage, node), [0.0, 0.5, 0.0], "the second clip alone");
    }

    #[test]
    fn a_model_without_animations_has_no_bar() {
        let request = Request::new(RawArgs::parse_from(["trigon-viewer"])).expect("no flags");
        assert!(Playback::new(&Scene::new(), &request).is_none(), "nothing to play");
    }
}
