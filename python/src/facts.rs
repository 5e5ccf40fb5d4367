//! What a scene tells of itself: nodes, materials, cameras, faults, and what an image needs.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use trigon_scene::{Effect, EffectPlan, NodeId};

use crate::arrays::matrix;
use crate::camera::PyCamera;
use crate::errors::value_error;
use crate::options::{Options, srgb};
use crate::scene::PyScene;

/// The most cameras of a list that is made at once.
const MOST_CAMERAS: usize = 1_000_000;

#[pymethods]
impl PyScene {
    /// The nodes, each after its parent, as dicts: id, name, parent, visible, pose (to the world), mesh.
    #[getter]
    fn nodes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for (id, _) in self.scene.tree() {
            let Some(node) = self.scene.node(id) else { continue };
            let facts = PyDict::new(py);
            facts.set_item("id", id.index())?;
            facts.set_item("name", &node.name)?;
            facts.set_item("parent", node.parent().map(NodeId::index))?;
            facts.set_item("visible", node.visible)?;
            facts.set_item("pose", matrix(py, &self.scene.world_transform(id))?)?;
            facts.set_item(
                "mesh",
                node.mesh.and_then(|mesh| self.scene.meshes().get(mesh)).map(|mesh| &mesh.name),
            )?;
            list.append(facts)?;
        }
        Ok(list)
    }

    /// The materials as dicts: id, name, color (sRGB with alpha), double_sided.
    #[getter]
    fn materials<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let list = PyList::empty(py);
        for (id, material) in self.scene.materials.iter() {
            let facts = PyDict::new(py);
            let [r, g, b] = srgb(material.base_color.truncate().to_array());
            facts.set_item("id", id.index())?;
            facts.set_item("name", &material.name)?;
            facts.set_item("color", (r, g, b, material.base_color.w))?;
            facts.set_item("double_sided", material.double_sided)?;
            list.append(facts)?;
        }
        Ok(list)
    }

    /// The cameras of the file, in the order of its nodes.
    #[getter]
    fn cameras(&self) -> Vec<PyCamera> {
        let cameras = self.scene.cameras().into_iter();
        cameras.map(|(_, camera)| camera.into()).collect()
    }

    /// The smallest box around everything visible, as a list of its lowest and highest corner; `None` if there is nothing.
    #[getter]
    fn bounds(&self) -> Option<[(f64, f64, f64); 2]> {
        let bounds = self.visible_bounds();
        (!bounds.is_empty()).then(|| [bounds.min.into(), bounds.max.into()])
    }

    /// A camera that sees everything from the upper right in front; `aspect` is width over height.
    #[pyo3(signature = (aspect=4.0 / 3.0))]
    fn overview(&self, aspect: f64) -> PyResult<PyCamera> {
        Ok(self.scene.overview(sound_aspect(aspect)?).into())
    }

    /// `count` cameras all around, evenly spread and the same for the same seed.
    #[pyo3(signature = (count, *, seed=0, aspect=1.0))]
    fn surround(&self, count: usize, seed: u64, aspect: f64) -> PyResult<Vec<PyCamera>> {
        if count > MOST_CAMERAS {
            return Err(value_error(format!("{count} cameras; the limit is {MOST_CAMERAS}")));
        }
        let cameras = self.scene.surround(trigon_scene::views::sphere(count, seed), sound_aspect(aspect)?);
        Ok(cameras.map(PyCamera::from).collect())
    }

    /// What faults the scene has, as dicts: severity, fault, location, what, remedy.
    fn check<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let findings = py.detach(|| self.scene.check());
        let list = PyList::empty(py);
        for finding in findings {
            let facts = PyDict::new(py);
            facts.set_item("severity", format!("{:?}", finding.severity).to_lowercase())?;
            facts.set_item("fault", finding.fault)?;
            facts.set_item("location", finding.location)?;
            facts.set_item("what", finding.what)?;
            facts.set_item("remedy", finding.remedy)?;
            list.append(facts)?;
        }
        Ok(list)
    }

    /// Which effects an image needs and why, as a dict of texts.
    #[pyo3(signature = (width, height, camera=None, **named))]
    fn plan<'py>(
        &self,
        py: Python<'py>,
        width: u32,
        height: u32,
        camera: Option<PyRef<'_, PyCamera>>,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let options = Options::new(width, height, named)?;
        let plan = match camera.as_deref().and_then(PyCamera::as_fisheye) {
            Some(fisheye) => EffectPlan::of_fisheye(&self.scene, &fisheye, &options.settings),
            None => {
                let camera = self.camera(camera.as_deref(), options.settings.aspect())?;
                EffectPlan::new(&self.scene, &camera, &options.settings)
            }
        };
        let texts = PyDict::new(py);
        for (effect, decision) in plan.iter() {
            let effect: Effect = effect;
            texts.set_item(effect.to_string(), decision.to_string())?;
        }
        Ok(texts)
    }
}

/// Width over height.
fn sound_aspect(aspect: f64) -> PyResult<f64> {
    // Of the longest image.
    let longest = f64::from(trigon_scene::MAX_SIZE);
    if (1.0 / longest..=longest).contains(&aspect) {
        return Ok(aspect);
    }
    Err(value_error(format!("aspect is {aspect}, not width over height of an image")))
}
