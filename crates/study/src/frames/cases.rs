//! The scenes, and a flight past each.

use std::path::Path;

use trigon_math::{DQuat, DVec3, Vec3};
use trigon_mesh::primitives;
use trigon_scene::camera::Camera;
use trigon_scene::{AmbientOcclusion, RenderSettings, Scene, Shadows, SightRays, showcase};

use super::scenes;
use crate::truth::Truth;

/// A scene and its camera path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameCase {
    /// The built-in scene: some objects, many lights, fine wood.
    Showcase,
    /// Knots on a chequered floor, with shadows.
    Shadows,
    /// 36 balls of 5,120 triangles, most of which are smaller than a pixel.
    Dense,
    /// The teapot of Martin Newell, 1975, with shadows.
    Teapot,
    /// A chair that was modelled with trigon's editor (`docs/models/chair.json`), with shadows.
    Chair,
    /// A mug that was modelled likewise, with shadows.
    Mug,
    /// 625 houses of a city, with shadows.
    City,
    /// A long passage with textures and lamps, with shadows.
    Passage,
    /// 2,500 blades of grass, with shadows.
    Grass,
    /// 27 translucent balls.
    Layers,
    /// Mirrors in mirrors.
    Mirrors,
    /// The corner of a room, with ambient occlusion.
    Corner,
}

impl FrameCase {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Showcase,
        Self::Shadows,
        Self::Dense,
        Self::Teapot,
        Self::Chair,
        Self::Mug,
        Self::City,
        Self::Passage,
        Self::Grass,
        Self::Layers,
        Self::Mirrors,
        Self::Corner,
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Showcase => "the built-in scene",
            Self::Shadows => "knots and their shadows",
            Self::Dense => "184,320 triangles",
            Self::Teapot => "a teapot",
            Self::Chair => "a chair",
            Self::Mug => "a mug",
            Self::City => "a city",
            Self::Passage => "a passage with lamps",
            Self::Grass => "grass",
            Self::Layers => "translucent balls",
            Self::Mirrors => "mirrors",
            Self::Corner => "a corner, ambient occlusion",
        }
    }

    /// Whether it has shadows.
    #[must_use]
    pub fn has_shadows(self) -> bool {
        !matches!(self, Self::Showcase | Self::Dense | Self::Layers | Self::Mirrors | Self::Corner)
    }

    /// What is drawn.
    #[must_use]
    pub fn scene(self) -> Scene {
        match self {
            Self::Showcase => showcase(),
            Self::Shadows => scenes::knots(),
            Self::Dense => scenes::balls(),
            Self::Teapot => scenes::standing(&primitives::teapot(12), Vec3::new(0.75, 0.72, 0.68)),
            Self::Chair => {
                let mesh = scenes::read(include_str!("../../models/chair.obj"));
                scenes::standing(&mesh, Vec3::new(0.5, 0.3, 0.16))
            }
            Self::Mug => {
                let mesh = scenes::read(include_str!("../../models/mug.obj"));
                scenes::standing(&mesh, Vec3::new(0.25, 0.45, 0.65))
            }
            Self::City => scenes::city(),
            Self::Passage => scenes::passage(),
            Self::Grass => scenes::grass(),
            Self::Layers => scenes::layers(),
            Self::Mirrors => scenes::mirrors(),
            Self::Corner => scenes::corner(),
        }
    }

    /// An image of it, at no particular quality.
    #[must_use]
    pub fn settings(self, [width, height]: [u32; 2]) -> RenderSettings {
        let mut settings = RenderSettings::new(width, height);
        if self.has_shadows() {
            settings.effects.shadows = Shadows::Maps { resolution: 1024 };
        }
        match self {
            Self::Mirrors => settings.effects.sight = SightRays::all(4),
            Self::Corner => settings.effects.ambient_occlusion = Some(AmbientOcclusion::new(16, 1.0)),
            _ => {}
        }
        settings
    }

    /// What is right at the start of the flight, from a folder of such images if it is there.
    ///
    /// # Panics
    /// Never: all scenes have a truth.
    #[must_use]
    pub fn truth(self, size: [u32; 2], folder: &Path) -> Truth {
        let (scene, settings) = (self.scene(), self.settings(size));
        let camera = self.camera(&scene, settings.aspect(), 0.0);
        Truth::cached(&scene, &camera, &settings, folder).expect("the study's scenes have a truth")
    }

    /// The camera at a fraction of the flight, from 0 to 1: three eighths of a circle around the scene,
    /// rising, and a third nearer in the middle than at either end. No constant of the cost and error models
    /// was fitted to such a flight.
    #[must_use]
    pub fn camera(self, scene: &Scene, aspect: f64, part: f64) -> Camera {
        let start = scene.cameras().first().map_or_else(|| scene.overview(aspect), |(_, camera)| *camera);
        let turn = DQuat::from_axis_angle(DVec3::Y, -std::f64::consts::TAU * 0.375 * part)
            * DQuat::from_axis_angle(start.orientation * DVec3::X, -0.3 * part);
        let nearer = 1.0 - 4.0 / 3.0 * part * (1.0 - part);
        let position = turn * start.position * nearer;
        Camera { position, orientation: (turn * start.orientation).normalize(), ..start }
    }
}
