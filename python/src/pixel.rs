//! Explanations of pixels as dicts.

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use trigon_scene::{FragmentExplanation, PixelExplanation, PrimitiveKind, SampleExplanation, Scene, Verdict};

/// Units of the sub-pixel grid in a pixel.
const GRID: f64 = 256.0;

/// Everything that reached a pixel, sample by sample.
pub(crate) fn explained<'py>(
    py: Python<'py>,
    pixel: &PixelExplanation,
    scene: &Scene,
) -> PyResult<Bound<'py, PyDict>> {
    let facts = PyDict::new(py);
    facts.set_item("pixel", (pixel.pixel[0], pixel.pixel[1]))?;
    facts.set_item("color", numbers(pixel.color.to_array()))?;
    facts.set_item("reported", pixel.reported)?;
    let samples = PyList::empty(py);
    for each in &pixel.samples {
        samples.append(sample(py, each, scene)?)?;
    }
    facts.set_item("samples", samples)?;
    facts.set_item("text", pixel.to_string())?;
    Ok(facts)
}

fn sample<'py>(py: Python<'py>, sample: &SampleExplanation, scene: &Scene) -> PyResult<Bound<'py, PyDict>> {
    let facts = PyDict::new(py);
    facts.set_item("cell", (sample.cell[0], sample.cell[1]))?;
    facts.set_item("number", sample.number)?;
    facts.set_item("position", point(sample.position))?;
    facts.set_item("color", numbers(sample.color.to_array()))?;
    let fragments = PyList::empty(py);
    for each in &sample.fragments {
        fragments.append(fragment(py, each, scene)?)?;
    }
    facts.set_item("fragments", fragments)?;
    Ok(facts)
}

fn fragment<'py>(
    py: Python<'py>,
    fragment: &FragmentExplanation,
    scene: &Scene,
) -> PyResult<Bound<'py, PyDict>> {
    let facts = PyDict::new(py);
    let node = scene.nodes().id_at(fragment.object as usize).and_then(|id| scene.node(id));
    facts.set_item("node", fragment.object)?;
    facts.set_item("name", node.map(|node| &node.name))?;
    facts.set_item("face", (fragment.face != u32::MAX).then_some(fragment.face))?;
    facts.set_item("kind", kind(fragment.kind))?;
    facts.set_item("primitive", fragment.primitive)?;
    facts.set_item("cut", fragment.is_cut)?;
    facts.set_item("front_facing", fragment.front_facing)?;
    facts.set_item("vertices", fragment.vertices.map(point))?;
    let edges = PyList::empty(py);
    for edge in &fragment.edges {
        let of_edge = PyDict::new(py);
        of_edge.set_item("value", edge.value)?;
        of_edge.set_item("owns_boundary", edge.owns_boundary)?;
        of_edge.set_item("distance", edge.distance)?;
        edges.append(of_edge)?;
    }
    facts.set_item("edges", edges)?;
    facts.set_item("covered", fragment.is_covered)?;
    facts.set_item("depth", fragment.depth)?;
    facts.set_item("margin", fragment.margin)?;
    facts.set_item("color", fragment.color.map(|color| numbers(color.to_array())))?;
    facts.set_item("visible", fragment.verdict == Verdict::Visible)?;
    facts.set_item("verdict", verdict(fragment.verdict))?;
    Ok(facts)
}

fn numbers([r, g, b, a]: [f32; 4]) -> (f32, f32, f32, f32) {
    (r, g, b, a)
}

/// A place on the sub-pixel grid, in pixels.
fn point([x, y]: [i32; 2]) -> (f64, f64) {
    (f64::from(x) / GRID, f64::from(y) / GRID)
}

fn kind(kind: PrimitiveKind) -> &'static str {
    match kind {
        PrimitiveKind::Triangle => "triangle",
        PrimitiveKind::Line => "line",
        PrimitiveKind::SquarePoint => "square point",
        PrimitiveKind::RoundPoint => "round point",
    }
}

/// A word for each outcome; what it means is in the documentation of `Scene.explain_pixel`.
fn verdict(verdict: Verdict) -> String {
    let word = match verdict {
        Verdict::Visible => "visible",
        Verdict::Hidden => "hidden",
        Verdict::EqualDepth => "equal depth",
        Verdict::BehindFarPlane => "behind far plane",
        Verdict::MaskedAway => "masked away",
        Verdict::Layer(number) => return format!("layer {number}"),
        Verdict::LeftToJoint => "left to joint",
        Verdict::OutsideEdge(edge) => return format!("outside edge {edge}"),
        Verdict::OutsideDisc => "outside disc",
    };
    word.to_owned()
}
