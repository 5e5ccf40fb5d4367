//! What is found out about an image before its draws are put together: the camera, the background, the shapes and
//! the lights.

mod lamp_reach;

use std::collections::BTreeMap;
use std::sync::Arc;

use trigon_camera::{Camera, FisheyeLens, PixelCenters, Projector, UpAxis};
use trigon_math::{DAffine3, DMat3, DVec2, DVec3, Mat3, UVec2, Vec3, Vec4};

use crate::effect_settings::{Shadows, SightRays};
use crate::effects::{LampPose, MetalStudio, Optics};
use crate::environment::{Environment, Surroundings};
use crate::light::{Light, LightKind};
use crate::lighting::{Lamp, LampSource, Lights};
use crate::placement::Eye;
use crate::scene::{NodePlacement, Scene};
use crate::settings::Background;
use crate::settings::RenderSettings;
use crate::shapes::{Onlookers, Shape, Shapes};

/// Whether sight rays may be needed, which also see what the camera does not.
fn has_sight_rays(scene: &Scene, sight: SightRays) -> bool {
    let is_glass = |material| matches!(Optics::of(material), Some(Optics::Glass(_)));
    match sight {
        SightRays::Off => false,
        SightRays::Glass { .. } => scene.materials.iter().any(|(_, material)| is_glass(material)),
        SightRays::All { .. } => sight.bounces() > 0,
    }
}

/// Whether lamps or rays look at the scene, too.
pub(crate) fn is_visible_from_elsewhere(scene: &Scene, settings: &RenderSettings) -> bool {
    let effects = &settings.effects;
    let rays = effects.ambient_occlusion.is_some() || has_sight_rays(scene, effects.sight);
    rays || effects.shadows != Shadows::Off
}

/// The meshes of an image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum MeshDetail {
    /// The scene's.
    Whole,
    /// The coarser ones of those that have one.
    Coarse,
}

/// The scene as one frame sees it: the camera, the settings, the shapes and the lights.
pub(crate) struct PreparedScene<'s> {
    pub(crate) scene: &'s Scene,
    pub(crate) camera: &'s Camera,
    /// What takes the place of the camera's projection, for an image of this size.
    pub(crate) lens: Option<FisheyeLens>,
    pub(crate) settings: &'s RenderSettings,
    /// Where the visible nodes with lights are, by their indices.
    light_transforms: BTreeMap<u32, DAffine3>,
    pub(crate) camera_to_world: DAffine3,
    pub(crate) eye: Eye,
    pub(crate) backdrop: Backdrop,
    pub(crate) shapes: Shapes,
    pub(crate) lights: Lights,
}

impl<'s> PreparedScene<'s> {
    pub(crate) fn new(scene: &'s Scene, camera: &'s Camera, settings: &'s RenderSettings) -> Self {
        Self::with_detail(MeshDetail::Whole, scene, camera, settings)
    }

    /// With coarser meshes, perhaps.
    pub(crate) fn with_detail(
        detail: MeshDetail,
        scene: &'s Scene,
        camera: &'s Camera,
        settings: &'s RenderSettings,
    ) -> Self {
        Self::looking_through(None, detail, scene, camera, settings)
    }

    /// The scene as a lens in place of the camera's projection sees it, if there is one.
    pub(crate) fn through(
        lens: Option<&FisheyeLens>,
        scene: &'s Scene,
        camera: &'s Camera,
        settings: &'s RenderSettings,
    ) -> Self {
        let lens = lens.map(|lens| lens.for_image(settings.viewport()));
        Self::looking_through(lens, MeshDetail::Whole, scene, camera, settings)
    }

    fn looking_through(
        lens: Option<FisheyeLens>,
        detail: MeshDetail,
        scene: &'s Scene,
        camera: &'s Camera,
        settings: &'s RenderSettings,
    ) -> Self {
        let placements = scene.visible_placements();
        let eye = match lens {
            None => Eye::new(camera, settings.aspect()),
            Some(_) => Eye::all_around(camera),
        };
        let onlookers = match detail {
            _ if lens.is_some() || is_visible_from_elsewhere(scene, settings) => Onlookers::All,
            MeshDetail::Whole => Onlookers::Camera(&eye),
            MeshDetail::Coarse => Onlookers::Draft(&eye),
        };
        let shapes = Shapes::new(scene, &placements, onlookers);
        let light_transforms = light_transforms(scene, &placements);
        let lights = Lights::gather(scene, &light_transforms, &eye, settings);
        let turn = DMat3::from_quat(camera.orientation);
        let camera_to_world = DAffine3::from_mat3_translation(turn, camera.position);
        let backdrop = Backdrop::new(camera, lens.as_ref(), settings, scene.up);
        let mut prepared = Self {
            scene,
            camera,
            lens,
            settings,
            light_transforms,
            camera_to_world,
            eye,
            backdrop,
            shapes,
            lights,
        };
        prepared.leave_out_idle_lamps();
        prepared
    }

    /// Whether some of a shape's faces may be in view.
    pub(crate) fn may_show(&self, shape: &Shape) -> bool {
        self.eye.may_see(&shape.geometry.bounds(), &shape.world)
    }

    /// The transform of a lamp.
    pub(crate) fn pose(&self, lamp: &Lamp) -> LampPose {
        let world = lamp.node.and_then(|node| self.light_transforms.get(&node));
        let along = world.map_or_else(
            || match lamp.source {
                LampSource::Directional(towards) => {
                    -self.camera_to_world.transform_vector3(towards.as_dvec3())
                }
                LampSource::Point { .. } => DVec3::NEG_Z,
            },
            |world| world.transform_vector3(DVec3::NEG_Z).normalize_or_zero(),
        );
        match lamp.source {
            LampSource::Directional(_) => LampPose::Directional(along),
            LampSource::Point { .. } => {
                let position = world.map_or(DVec3::ZERO, |world| world.translation);
                LampPose::Point { position, cone: self.cone(lamp).map(|half| (along, half)) }
            }
        }
    }

    pub(crate) fn surroundings(&self) -> Option<Surroundings> {
        Some(Surroundings {
            environment: self.settings.effects.environment.clone()?,
            from_camera: self.camera_to_sky(),
            intensity: self.settings.light_factor(),
        })
    }

    pub(crate) fn metal_studio(&self) -> MetalStudio {
        MetalStudio::new(&self.camera_to_sky(), self.settings.light_factor())
    }

    /// The rotation from world space to that of environments and of the studio that metals mirror, in which +Y
    /// is up.
    pub(crate) fn world_to_sky(&self) -> DMat3 {
        self.scene.up.turn_to(UpAxis::Y)
    }

    fn camera_to_sky(&self) -> Mat3 {
        (self.world_to_sky() * self.camera_to_world.matrix3).as_mat3()
    }

    /// Half the angle of a spot light's cone.
    fn cone(&self, lamp: &Lamp) -> Option<f64> {
        match self.light(lamp)?.kind {
            LightKind::Spot { outer, .. } => Some(f64::from(outer)),
            LightKind::Ambient | LightKind::Directional | LightKind::Point => None,
        }
    }

    /// The scene's light that a lamp is; `None` for a lamp of the studio.
    fn light(&self, lamp: &Lamp) -> Option<&Light> {
        let node = self.scene.nodes().id_at(lamp.node? as usize)?;
        self.scene.node(node)?.light.as_deref()
    }
}

/// Where the nodes with lights are; `placements` is the scene's table of visible nodes.
fn light_transforms(scene: &Scene, placements: &[Option<NodePlacement>]) -> BTreeMap<u32, DAffine3> {
    let holders = scene.nodes().iter().filter(|(_, node)| node.light.is_some());
    holders.filter_map(|(id, _)| Some((id.index() as u32, placements[id.index()]?.world))).collect()
}

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
    rays: PanoramaRays,
    /// The angular size of the middle pixel, in radians.
    pixel: f32,
}

/// Where pixels look, in the environment.
#[derive(Clone, Debug)]
enum PanoramaRays {
    /// With length 1 along the line of sight: at the corner of the image, and the steps to the next pixel to the right
    /// and below.
    Plane { corner: Vec3, steps: [Vec3; 2] },
    /// Through a lens, and from camera space to the environment.
    Lens(FisheyeLens, DMat3),
}

impl Backdrop {
    /// If tone mapping follows, a background colour, which is a colour of the display, is added afterwards:
    /// the pass draws on a transparent background.
    pub(crate) fn new(
        camera: &Camera,
        lens: Option<&FisheyeLens>,
        settings: &RenderSettings,
        up: UpAxis,
    ) -> Self {
        match settings.background {
            Background::Environment => match &settings.effects.environment {
                Some(environment) => {
                    let panorama = match lens {
                        Some(lens) => Some(Panorama::through(lens, camera, settings, environment, up)),
                        None => Panorama::new(camera, settings, environment, up),
                    };
                    panorama.map_or(Self::Color(Vec4::ZERO), Self::Environment)
                }
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
        let viewport = settings.viewport();
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
            rays: PanoramaRays::Plane { corner: corner.as_vec3(), steps: [right.as_vec3(), below.as_vec3()] },
            pixel,
        })
    }

    /// As a lens sees it.
    fn through(
        lens: &FisheyeLens,
        camera: &Camera,
        settings: &RenderSettings,
        environment: &Arc<Environment>,
        up: UpAxis,
    ) -> Self {
        let focal = lens.intrinsics(settings.viewport(), PixelCenters::AtHalves).focal;
        let to_sky = up.turn_to(UpAxis::Y) * DMat3::from_quat(camera.orientation);
        Self {
            environment: Arc::clone(environment),
            intensity: settings.light_factor(),
            rays: PanoramaRays::Lens(*lens, to_sky),
            // In the middle.
            pixel: (1.0 / focal.min_element()) as f32,
        }
    }

    /// Linear RGB. Black beyond the lens.
    fn at(&self, pixel: UVec2) -> Vec3 {
        let towards = match &self.rays {
            PanoramaRays::Plane { corner, steps: [right, below] } => {
                *corner + *right * (pixel.x as f32 + 0.5) + *below * (pixel.y as f32 + 0.5)
            }
            PanoramaRays::Lens(lens, to_sky) => {
                let Some(ray) = lens.ray(pixel.as_dvec2() + 0.5) else { return Vec3::ZERO };
                (*to_sky * ray).as_vec3()
            }
        };
        self.environment.filtered_radiance(towards, self.pixel) * self.intensity
    }
}
