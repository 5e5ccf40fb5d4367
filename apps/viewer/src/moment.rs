//! The pose in which a model is shown: animations at a time.

use trigon_scene::Scene;

use crate::failure::Failure;

/// A moment of an animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moment {
    /// Which; `None` is all of them, one after the other.
    pub(crate) animation: Option<usize>,
    /// Before its start and after its end an animation stands still.
    pub(crate) seconds: f64,
}

impl Moment {
    /// Puts the nodes of a scene where its animation has them.
    pub(crate) fn apply(&self, scene: &mut Scene) -> Result<(), Failure> {
        let count = scene.animations.len();
        let chosen = match self.animation {
            None => 0..count,
            Some(index) if index < count => index..index + 1,
            Some(index) => return Err(missing(index, count)),
        };
        for index in chosen {
            let pose = scene.pose(&scene.animations[index], self.seconds);
            scene.apply_pose(&pose);
        }
        Ok(())
    }
}

fn missing(index: usize, count: usize) -> Failure {
    Failure::work(match count {
        0 => "there is no animation in the file; leave --animation-index and --animation-time out".to_owned(),
        _ => format!("--animation-index={index} finds no animation; the file has {count}, numbered from 0"),
    })
}
