//! What images cost: times in turns, and instructions.

use std::error::Error;
use std::time::Instant;

use trigon_camera::Camera;
use trigon_scene::{Effect, Frame, RenderSettings, Renderer, Scene};

use crate::callgrind::switch_counting;

/// How often each image is timed.
const ROUNDS: usize = 15;

/// An image, drawn over and over.
pub(crate) struct Shot {
    /// What the scene lacks; none if it is the subject's own.
    lacks: Option<Effect>,
    scene: Scene,
    settings: RenderSettings,
}

/// The shots of a subject; two effects whose images without them are the same share one.
#[derive(Default)]
pub(crate) struct Shots(Vec<Shot>);

impl Shots {
    /// The number of a shot, which is new if there is no such one yet.
    pub(crate) fn number(
        &mut self,
        lacks: Option<Effect>,
        scene: &Scene,
        settings: &RenderSettings,
    ) -> usize {
        let is_it = |shot: &Shot| shot.lacks == lacks && shot.settings == *settings;
        self.0.iter().position(is_it).unwrap_or_else(|| {
            self.0.push(Shot { lacks, scene: scene.clone(), settings: settings.clone() });
            self.0.len() - 1
        })
    }

    /// The milliseconds of all shots: a list of rounds, in each of which every shot has its turn, so that whatever else the
    /// machine does meets all. A round before the first fills caches.
    pub(crate) fn rounds(&self, camera: &Camera) -> Result<Vec<Vec<f64>>, Box<dyn Error>> {
        let renderer = |shot: &Shot| (Renderer::new(shot.settings.clone()), Frame::default());
        let mut kept: Vec<(Renderer, Frame)> = self.0.iter().map(renderer).collect();
        let mut rounds = Vec::new();
        for round in 0..=ROUNDS {
            let mut times = Vec::new();
            for ((renderer, frame), shot) in kept.iter_mut().zip(&self.0) {
                let start = Instant::now();
                renderer.render_into(&shot.scene, camera, frame)?;
                times.push(start.elapsed().as_secs_f64() * 1e3);
            }
            if round > 0 {
                rounds.push(times);
            }
        }
        Ok(rounds)
    }

    /// Draws one of them twice: a frame that fills caches, and one that callgrind counts.
    pub(crate) fn draw_counted(&self, number: usize, camera: &Camera) -> Result<(), Box<dyn Error>> {
        let shot = self.0.get(number).ok_or("there is no such shot")?;
        let (mut renderer, mut frame) = (Renderer::new(shot.settings.clone()), Frame::default());
        renderer.render_into(&shot.scene, camera, &mut frame)?;
        switch_counting("on")?;
        renderer.render_into(&shot.scene, camera, &mut frame)?;
        switch_counting("off")
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.0.len()
    }
}

/// The quarters of some numbers: the lower one, the middle, the upper one.
pub(crate) fn quarters(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    [1, 2, 3].map(|quarter| values[(values.len() - 1) * quarter / 4])
}
