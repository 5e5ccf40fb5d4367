//! The background of the colour pass.

use std::sync::Arc;

use trigon_camera::{Camera, Projector, UpAxis, Viewport};
use trigon_math::{DVec2, DVec3, UVec2, Vec3, Vec4};

use crate::background::Background;
use crate::environment::Environment;
use crate::settings::RenderSettings;

/// The background of the colour pass.
#[derive(Clone, Debug)]
pub(crate) enum Backdrop {
    /// The same everywhere, premultiplied.
    Color(Vec4),
    /// A colour for each row of an image of this height.
    Rows(Background, u32),
    /// Light from far away.
    Environment(Panorama),
}

/// The environment as seen by a camera.
#[derive(Clone, Debug)]
pub(crate) struct Panorama {
    environment: Arc<Environment>,
    intensity: f32,
    /// Directions of the environment with length 1 along the line of sight: at the corner of the image, and the
    /// steps to the next pixel to the right and below.
    corner: Vec3,
    steps: [Vec3; 2],
    /// The angular size of the middle pixel, in radians.
    pixel: f32,
}

impl Backdrop {
    /// If tone mapping follows, a background colour, which is a colour of the display, is added afterwards:
    /// the pass draws on a transparent background.
    pub(crate) fn new(camera: &Camera, settings: &RenderSettings, up: UpAxis) -> Self {
        match settings.background {
            Background::Environment => match &settings.effects.environment {
                Some(environment) => Panorama::new(camera, settings, environment, up)
                    .map_or(Self::Color(Vec4::ZERO), Self::Environment),
                None => Self::Color(Vec3::ZERO.extend(1.0)),
            },
            _ if settings.effects.maps_tones() => Self::Color(Vec4::ZERO),
            Background::Gradient { .. } => Self::Rows(settings.background, settings.height),
            Background::Color(_) | Background::Transparent => {
                Self::Color(settings.background.row(0, settings.height))
            }
        }
    }

    /// The colour of a pixel, premultiplied linear RGB.
    pub(crate) fn at(&self, pixel: UVec2) -> Vec4 {
        match self {
            Self::Color(color) => *color,
            Self::Rows(background, height) => background.row(pixel.y, *height),
            Self::Environment(panorama) => panorama.at(pixel).extend(1.0),
        }
    }
}

impl Panorama {
    /// `None` if the image has no area.
    fn new(
        camera: &Camera,
        settings: &RenderSettings,
        environment: &Arc<Environment>,
        up: UpAxis,
    ) -> Option<Self> {
        let to_sky = up.turn_to(UpAxis::Y);
        let viewport = Viewport { width: settings.width, height: settings.height };
        let (projector, DVec2 { x: width, y: height }) = (Projector::new(camera, viewport), viewport.size());
        let ray = |x: f64, y: f64| {
            let direction = projector.ray(DVec2::new(x, y))?.direction;
            Some(to_sky * direction / direction.dot(camera.forward()))
        };
        let corner: DVec3 = ray(0.0, 0.0)?;
        let [right, below] = [(ray(width, 0.0)? - corner) / width, (ray(0.0, height)? - corner) / height];
        // In the middle a step of the directions is an angle: they have a length of 1.
        let pixel = right.length().max(below.length()) as f32;
        Some(Self {
            environment: Arc::clone(environment),
            intensity: settings.light_factor(),
            corner: corner.as_vec3(),
            steps: [right.as_vec3(), below.as_vec3()],
            pixel,
        })
    }

    /// Linear RGB.
    fn at(&self, pixel: UVec2) -> Vec3 {
        let [right, below] = self.steps;
        let towards = self.corner + right * (pixel.x as f32 + 0.5) + below * (pixel.y as f32 + 0.5);
        self.environment.filtered_radiance(towards, self.pixel) * self.intensity
    }
}
