//! The arguments of a rendering as the engine's settings.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use pyo3::prelude::*;
use pyo3::types::PyDict;
use trigon_math::color;
use trigon_scene::quality::Preset;
use trigon_scene::{
    Background, Exposure, Lighting, MAX_SIZE, Outputs, RenderSettings, ShadingModel, Shadows,
};

use crate::arrays;
use crate::errors::value_error;

/// Threads of every rendering; 0 is as many as the machine has cores.
static THREADS: AtomicUsize = AtomicUsize::new(0);

/// Sets how many threads each rendering uses; 0, the default, is one for each core.
///
/// The images are the same bytes for any number. Processes that share a machine are fastest with one thread each.
///
/// >>> import trigon3d
/// >>> trigon3d.set_threads(1)
/// >>> trigon3d.set_threads(0)
#[pyfunction]
pub(crate) fn set_threads(count: usize) -> PyResult<()> {
    THREADS.store(some_threads(count)?, Ordering::Relaxed);
    Ok(())
}

/// More threads than any machine has cores.
const MOST_THREADS: usize = 4096;

/// A number of threads that can be started.
fn some_threads(count: usize) -> PyResult<usize> {
    if count <= MOST_THREADS {
        return Ok(count);
    }
    Err(value_error(format!("{count} threads; the limit is {MOST_THREADS}")))
}

/// The widest points and lines in pixels: the longest side of an image.
fn pixels(value: &Bound<'_, PyAny>, name: &str) -> PyResult<f32> {
    let width: f32 = value.extract()?;
    if (0.0..=MAX_SIZE as f32).contains(&width) {
        return Ok(width);
    }
    Err(value_error(format!("{name} is {width}, but goes from 0 to {MAX_SIZE} pixels")))
}

/// What an image is drawn with.
pub(crate) struct Options {
    pub(crate) settings: RenderSettings,
    pub(crate) time_budget: Option<Duration>,
}

/// The names of outputs, as `Frame` has them.
pub(crate) const OUTPUTS: [&str; 13] = [
    "color",
    "radiance",
    "depth",
    "object_ids",
    "face_ids",
    "material_ids",
    "triangle_ids",
    "barycentrics",
    "positions",
    "normals",
    "geometric_normals",
    "uvs",
    "albedo",
];

impl Options {
    /// Of the named arguments of `render`.
    pub(crate) fn new(width: u32, height: u32, named: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        sound([width, height])?;
        let mut options = Self { settings: RenderSettings::new(width, height), time_budget: None };
        options.settings.threads = NonZeroUsize::new(THREADS.load(Ordering::Relaxed));
        // A preset first: what is given besides overrides it.
        let named: Vec<(String, Bound<'_, PyAny>)> = named
            .into_iter()
            .flatten()
            .map(|(name, value)| Ok((name.extract()?, value)))
            .collect::<PyResult<_>>()?;
        let order = |name: &str| usize::from(name != "quality");
        for pass in 0..2 {
            for (name, value) in named.iter().filter(|(name, value)| order(name) == pass && !value.is_none())
            {
                options.set(name, value)?;
            }
        }
        Ok(options)
    }

    /// Asks for images of another size.
    pub(crate) fn resize(&mut self, size: [u32; 2]) -> PyResult<()> {
        [self.settings.width, self.settings.height] = sound(size)?;
        Ok(())
    }

    /// Asks for other outputs.
    pub(crate) fn ask_for(&mut self, names: &[&str]) -> PyResult<()> {
        self.settings.outputs = outputs(names)?;
        Ok(())
    }

    fn set(&mut self, name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
        let settings = &mut self.settings;
        match name {
            "outputs" => {
                let names = match value.extract::<String>() {
                    Ok(name) => vec![name],
                    // One more than there are.
                    Err(_) => arrays::items(value, "outputs", OUTPUTS.len() + 1)?,
                };
                settings.outputs = outputs(&names)?;
            }
            "samples" => settings.samples_per_axis = value.extract()?,
            "quality" => {
                let preset: Preset = value.extract::<String>()?.parse().map_err(value_error)?;
                preset.quality().apply(settings);
            }
            "time_budget" => {
                let seconds: f64 = value.extract()?;
                let time = Duration::try_from_secs_f64(seconds).map_err(value_error)?;
                self.time_budget = Some(time);
            }
            "background" => settings.background = background(value)?,
            "lighting" => settings.lighting = lighting(&value.extract::<String>()?)?,
            "shadows" => {
                settings.effects.shadows = if value.extract()? { Shadows::Rays } else { Shadows::Off }
            }
            "exposure" => settings.effects.exposure = exposure(value)?,
            "flat" => {
                settings.shading = if value.extract()? { ShadingModel::Flat } else { ShadingModel::Phong }
            }
            "point_size" => settings.point_size = Some(pixels(value, name)?),
            "line_width" => settings.line_width = pixels(value, name)?,
            "threads" => settings.threads = NonZeroUsize::new(some_threads(value.extract()?)?),
            "simd" => settings.simd = Some(value.extract::<String>()?.parse().map_err(value_error)?),
            other => {
                return Err(pyo3::exceptions::PyTypeError::new_err(format!(
                    "render() has no argument {other:?}; there are outputs, samples, quality, time_budget, background, lighting, exposure, shadows, flat, point_size, line_width, threads and simd"
                )));
            }
        }
        Ok(())
    }
}

/// A size of an image, if it is within the limits.
fn sound([width, height]: [u32; 2]) -> PyResult<[u32; 2]> {
    if (1..=MAX_SIZE).contains(&width) && (1..=MAX_SIZE).contains(&height) {
        return Ok([width, height]);
    }
    Err(value_error(format!("an image has 1 to {MAX_SIZE} pixels on a side, not {width} × {height}")))
}

fn outputs(names: &[impl AsRef<str>]) -> PyResult<Outputs> {
    let mut outputs = Outputs::NONE;
    for name in names {
        match name.as_ref() {
            "color" => outputs.color = true,
            "radiance" => outputs.radiance = true,
            "depth" => outputs.depth = true,
            "object_ids" | "face_ids" => outputs.ids = true,
            "material_ids" => outputs.material_ids = true,
            "triangle_ids" => outputs.triangle_ids = true,
            "barycentrics" => outputs.barycentrics = true,
            "positions" => outputs.positions = true,
            "normals" => outputs.normals = true,
            "geometric_normals" => outputs.geometric_normals = true,
            "uvs" => outputs.uvs = true,
            "albedo" => outputs.albedo = true,
            other => {
                return Err(value_error(format!(
                    "there is no output {other:?}; there are {}",
                    OUTPUTS.join(", ")
                )));
            }
        }
    }
    Ok(outputs)
}

/// A colour, "transparent", or "default".
fn background(value: &Bound<'_, PyAny>) -> PyResult<Background> {
    match value.extract::<String>().as_deref() {
        Ok("transparent") => Ok(Background::Transparent),
        Ok("default") => Ok(Background::default()),
        Ok(other) => {
            Err(value_error(format!("background is {other:?}, not a colour, \"transparent\" or \"default\"")))
        }
        Err(_) => {
            let color: arrays::Channels = value.extract()?;
            Ok(Background::Color(color.linear("background")?.truncate()))
        }
    }
}

fn lighting(name: &str) -> PyResult<Lighting> {
    match name {
        "auto" => Ok(Lighting::Automatic),
        "scene" => Ok(Lighting::Scene),
        "studio" => Ok(Lighting::Studio),
        other => Err(value_error(format!("lighting is {other:?}, not \"auto\", \"scene\" or \"studio\""))),
    }
}

/// Stops, or "auto".
fn exposure(value: &Bound<'_, PyAny>) -> PyResult<Exposure> {
    match (value.extract::<String>().as_deref(), value.extract::<f32>()) {
        (Ok("auto"), _) => Ok(Exposure::Metered),
        (Err(_), Ok(stops)) if stops.abs() <= MOST_STOPS => Ok(Exposure::Stops(stops)),
        _ => Err(value_error(format!(
            "exposure is {value}, not \"auto\" or a number of stops up to {MOST_STOPS}"
        ))),
    }
}

/// More than any image needs, and few enough that no light is infinite.
const MOST_STOPS: f32 = 60.0;

/// Linear light as sRGB, for what is told of materials.
pub(crate) fn srgb(linear: [f32; 3]) -> [f32; 3] {
    linear.map(color::linear_to_srgb)
}
