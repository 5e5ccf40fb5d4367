//! Camera and settings: everything that the colours depend on.

use trigon_camera::{Camera, CameraError, PixelCenters, Projection, Viewport};
use trigon_math::{DQuat, DVec2, DVec3};
use trigon_scene::{
    AmbientOcclusion, Background, Display, EffectSettings, Environment, Exposure, Fog, Lighting,
    MetalReflection, Outline, Outputs, RaySampling, Reflection, RenderSettings, ShadingModel, Shadows,
    SightRays, Sky, SoftShadows, Style, ToneMapping,
};

use super::stored::{CaptureReader, CaptureWriter, Damage};
use super::stored::{Stored, choice, record};

/// With soft shadows since version 8.
impl Stored for EffectSettings {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let Self { shadows, soft_shadows, ambient_occlusion, environment, metal_reflection, .. } = self;
        shadows.write(to);
        soft_shadows.write(to);
        ambient_occlusion.write(to);
        environment.write(to);
        metal_reflection.write(to);
        let Self { sight, fog, exposure, tone_mapping, outline, .. } = self;
        sight.write(to);
        fog.write(to);
        exposure.write(to);
        tone_mapping.write(to);
        outline.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        Ok(Self {
            shadows: Stored::read(from)?,
            soft_shadows: if from.version < 8 { SoftShadows::default() } else { Stored::read(from)? },
            ambient_occlusion: Stored::read(from)?,
            environment: Stored::read(from)?,
            metal_reflection: Stored::read(from)?,
            sight: Stored::read(from)?,
            fog: Stored::read(from)?,
            exposure: Stored::read(from)?,
            tone_mapping: Stored::read(from)?,
            outline: Stored::read(from)?,
        })
    }
}

/// As a number of bounces, of which the largest bit says that glass alone has them.
impl Stored for SightRays {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        match *self {
            Self::Off => 0,
            Self::Glass { bounces } => bounces | GLASS_ALONE,
            Self::All { bounces } => bounces & !GLASS_ALONE,
        }
        .write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let number = u32::read(from)?;
        let bounces = number & !GLASS_ALONE;
        Ok(if number == bounces { Self::all(bounces) } else { Self::Glass { bounces } })
    }
}

const GLASS_ALONE: u32 = 1 << 31;

/// The number of rays, of which the largest bit says that pixels share them; and the distance.
impl Stored for AmbientOcclusion {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let rays = self.rays & !SHARED_RAYS;
        match self.sampling {
            RaySampling::Full => rays,
            RaySampling::Shared => rays | SHARED_RAYS,
        }
        .write(to);
        self.distance.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let (number, distance) = (u32::read(from)?, f32::read(from)?);
        let rays = number & !SHARED_RAYS;
        let sampling = if rays == number { RaySampling::Full } else { RaySampling::Shared };
        Ok(Self { sampling, ..Self::new(rays, distance) })
    }
}

const SHARED_RAYS: u32 = 1 << 31;

record!(SoftShadows { radius, rays, sampling });
choice!(RaySampling { 0 => Full, 1 => Shared });
choice!(Shadows { 0 => Off, 1 => Maps { resolution }, 2 => Rays });
choice!(MetalReflection { 0 => Studio, 1 => Ambient });
record!(Fog { color, density });
choice!(Exposure { 0 => Metered, 1 => Stops(stops) });
choice!(ToneMapping { 0 => None, 1 => KhronosPbrNeutral });
record!(Outline { nodes, color, width });

choice!(Background { 0 => Color(color), 1 => Gradient { top, bottom }, 2 => Transparent, 3 => Environment });
choice!(Style { 0 => Surface, 1 => SurfaceWithEdges, 2 => Wireframe, 3 => HiddenLine });
choice!(Display {
    0 => Shaded,
    1 => Matcap,
    2 => BaseColor,
    3 => Normal,
    4 => GeometricNormal,
    5 => TextureCoordinates,
    6 => Metallic,
    7 => Roughness,
    8 => Occlusion,
    9 => Emission,
    10 => Alpha,
    11 => Depth,
});
choice!(Lighting { 0 => Automatic, 1 => Scene, 2 => Studio });
choice!(ShadingModel { 0 => Flat, 1 => Gouraud, 2 => Phong });
choice!(Reflection { 0 => Material, 1 => Lambert, 2 => BlinnPhong, 3 => MetallicRoughness });

/// A sky's colours after a side of 0, or the map of directions. What follows from them is
/// recomputed.
impl Stored for Environment {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        if let Some(Sky { zenith, horizon, ground }) = self.sky() {
            0_u32.write(to);
            return [*zenith, *horizon, *ground].iter().for_each(|color| color.write(to));
        }
        let (side, texels) = self.texels();
        (side as u32).write(to);
        texels.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let side = u32::read(from)?;
        if side == 0 {
            let [zenith, horizon, ground] = [Stored::read(from)?, Stored::read(from)?, Stored::read(from)?];
            return Ok(Self::from_sky(&Sky { zenith, horizon, ground }));
        }
        let texels: Vec<[f32; 3]> = Stored::read(from)?;
        Self::from_texels(side as usize, &texels).map_err(|error| Damage::malformed(error.to_string()))
    }
}

impl Stored for RenderSettings {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let Self { width, height, samples_per_axis, samples, background, style, line_width, .. } = self;
        [*width, *height, *samples_per_axis, *samples].write(to);
        background.write(to);
        style.write(to);
        line_width.write(to);
        self.point_size.write(to);
        let Self { display, edge_color, edge_opacity, lighting, light_intensity, .. } = self;
        display.write(to);
        edge_color.write(to);
        edge_opacity.write(to);
        let Self { x_ray, marks, vertices, .. } = self;
        x_ray.write(to);
        marks.write(to);
        vertices.write(to);
        lighting.write(to);
        light_intensity.write(to);
        let Self { shading, reflection, effects, .. } = self;
        shading.write(to);
        reflection.write(to);
        effects.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let [width, height, samples_per_axis, samples] = Stored::read(from)?;
        Ok(Self {
            width,
            height,
            samples_per_axis,
            samples,
            background: Stored::read(from)?,
            style: Stored::read(from)?,
            line_width: Stored::read(from)?,
            point_size: Stored::read(from)?,
            display: Stored::read(from)?,
            edge_color: Stored::read(from)?,
            edge_opacity: Stored::read(from)?,
            x_ray: Stored::read(from)?,
            marks: Stored::read(from)?,
            vertices: Stored::read(from)?,
            lighting: Stored::read(from)?,
            light_intensity: Stored::read(from)?,
            shading: Stored::read(from)?,
            reflection: Stored::read(from)?,
            effects: Stored::read(from)?,
            // The colours depend on none of these.
            outputs: Outputs::default(),
            threads: None,
            simd: None,
        })
    }
}

impl Stored for Camera {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let Self { position, orientation, projection } = self;
        position.write(to);
        orientation.write(to);
        projection.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let (position, orientation): (DVec3, DQuat) = (Stored::read(from)?, Stored::read(from)?);
        if !position.is_finite() || !orientation.is_normalized() {
            return Err(Damage::malformed("the camera has no valid position or rotation"));
        }
        Ok(Self { position, orientation, projection: Stored::read(from)? })
    }
}

/// Distances of planes: near, and far if it is not infinitely far.
struct Planes {
    near: f64,
    far: Option<f64>,
}

impl Stored for Projection {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let (kind, shape): (u8, Vec<f64>) = match *self {
            Self::Perspective { vertical_fov, .. } => (0, vec![vertical_fov]),
            Self::Orthographic { height, .. } => (1, vec![height]),
            Self::Frustum { left, right, bottom, top, .. } => (2, vec![left, right, bottom, top]),
            Self::Pinhole { focal, center, size, .. } => {
                (3, vec![focal.x, focal.y, center.x, center.y, size.x, size.y])
            }
        };
        kind.write(to);
        shape.iter().for_each(|number| number.write(to));
        self.near().write(to);
        self.far().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let kind = u8::read(from)?;
        let made = match kind {
            0 => {
                let ([vertical_fov], Planes { near, far }) = parts(from)?;
                Self::perspective(vertical_fov, near, far)
            }
            1 => {
                let ([height], Planes { near, far }) = parts(from)?;
                Self::orthographic(height, near, far.unwrap_or(f64::INFINITY))
            }
            2 => {
                let ([left, right, bottom, top], Planes { near, far }) = parts(from)?;
                Self::frustum(left, right, bottom, top, near, far)
            }
            3 => {
                let (shape, planes) = parts(from)?;
                pinhole(shape, planes)
            }
            _ => return Err(Damage::malformed(format!("there is no projection of number {kind}"))),
        };
        made.map_err(|error| Damage::malformed(error.to_string()))
    }
}

fn parts<const N: usize>(from: &mut CaptureReader<'_>) -> Result<([f64; N], Planes), Damage> {
    Ok((Stored::read(from)?, Planes { near: Stored::read(from)?, far: Stored::read(from)? }))
}

fn pinhole(shape: [f64; 6], Planes { near, far }: Planes) -> Result<Projection, CameraError> {
    let [fx, fy, cx, cy, width, height] = shape;
    // A size in pixels is an integer; anything else becomes 0, which is rejected.
    let image = Viewport { width: width as u32, height: height as u32 };
    let (focal, center) = (DVec2::new(fx, fy), DVec2::new(cx, cy));
    Projection::pinhole(focal, center, image, PixelCenters::AtHalves, near)?.with_planes(near, far)
}
