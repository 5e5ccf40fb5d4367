//! What an image costs at many settings, and how wrong it then is, as dicts.

use std::time::Instant;

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use trigon_scene::quality::{Frontier, FrontierDot, Preset, Sweep, SweepOptions, SweepProgress};
use trigon_scene::{Cancel, RenderError, Shadows};

use crate::camera::PyCamera;
use crate::errors::{render_error, value_error};
use crate::options::Options;
use crate::scene::PyScene;

/// More would take days.
const MOST_ROUNDS: u32 = 1000;

#[pymethods]
impl PyScene {
    /// Measures what an image costs at many settings, and how wrong it then is.
    ///
    /// Each setting is drawn `rounds` times, in a random order that `seed` determines, after one frame that is not timed.
    /// The other arguments are those of `render`. Returns a dict: `reference`, in words, is the setting that errors are
    /// relative to, at this size (so they are not errors against the exact image); `floor` is the error of rounding to
    /// bytes; `settings` is a list of dicts with `name`, `preset` (or None), `samples` along each side of a pixel,
    /// `multisamples`, `shadows` ("off", "maps", "rays"), `description`, `seconds` (the lower quartile, the median and the
    /// upper quartile), `error` (RMSE in linear light) and `standing`: "best" if no other setting is faster and more
    /// accurate, "uncertain" if one is, within the spread of times, and "dominated" if one certainly is.
    ///
    /// >>> import trigon3d
    /// >>> scene = trigon3d.Scene()
    /// >>> _ = scene.add_mesh([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], [[0, 1, 2]])
    /// >>> frontier = scene.frontier(16, 12, rounds=2)
    /// >>> draft = next(each for each in frontier["settings"] if each["preset"] == "draft")
    /// >>> draft["samples"], draft["error"] > frontier["floor"] > 0, len(draft["seconds"])
    /// (1, True, 3)
    #[pyo3(signature = (width, height, camera=None, *, rounds=5, seed=0, **named))]
    fn frontier<'py>(
        &self,
        py: Python<'py>,
        width: u32,
        height: u32,
        camera: Option<PyRef<'_, PyCamera>>,
        rounds: u32,
        seed: u64,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let options = Options::new(width, height, named)?;
        if !(1..=MOST_ROUNDS).contains(&rounds) {
            return Err(value_error(format!("{rounds} rounds; there are 1 to {MOST_ROUNDS}")));
        }
        if options.time_budget.is_some() {
            return Err(value_error("frontier measures all settings; leave time_budget away"));
        }
        let camera = self.camera(camera.as_deref(), options.settings.aspect())?;
        let sweep = SweepOptions { rounds, seed, ..SweepOptions::default() };
        let mut sweep = Sweep::new(self.scene.clone(), camera, &options.settings, sweep);
        let started = Instant::now();
        let mut step = || -> Result<SweepProgress, RenderError> {
            sweep.step(&mut || started.elapsed(), &Cancel::default())
        };
        while !py.detach(&mut step).map_err(render_error)?.is_done() {
            // Ctrl+C ends it.
            py.check_signals()?;
        }
        dict(py, &sweep.frontier())
    }
}

fn dict<'py>(py: Python<'py>, frontier: &Frontier) -> PyResult<Bound<'py, PyDict>> {
    let settings = PyList::empty(py);
    for dot in &frontier.dots {
        settings.append(setting(py, dot)?)?;
    }
    let facts = PyDict::new(py);
    facts.set_item("reference", frontier.reference.to_string())?;
    facts.set_item("floor", frontier.floor)?;
    facts.set_item("settings", settings)?;
    Ok(facts)
}

fn setting<'py>(py: Python<'py>, dot: &FrontierDot) -> PyResult<Bound<'py, PyDict>> {
    let facts = PyDict::new(py);
    facts.set_item("name", dot.name())?;
    facts.set_item("preset", dot.preset.map(Preset::name))?;
    facts.set_item("samples", dot.quality.samples_per_axis)?;
    facts.set_item("multisamples", dot.quality.samples)?;
    let shadows = match dot.quality.shadows {
        Shadows::Off => "off",
        Shadows::Maps { .. } => "maps",
        Shadows::Rays => "rays",
    };
    facts.set_item("shadows", shadows)?;
    facts.set_item("description", dot.quality.to_string())?;
    let [low, median, high] =
        [dot.time.low, dot.time.median, dot.time.high].map(|time| time.as_secs_f64());
    facts.set_item("seconds", (low, median, high))?;
    facts.set_item("error", dot.error)?;
    facts.set_item("standing", dot.standing.name())?;
    Ok(facts)
}
