//! Charts with pins: some of their texture coordinates are given, and stay as they are to the bit.
//!
//! From two pins on they take the part of the two vertices that a conformal layout otherwise chooses itself. A layout
//! with one pin is turned, scaled and moved to where the chart was before.

use trigon_math::{DVec2, Vec2};

use super::charts::UvChart;
use super::conformal;
use super::factor::{NoFactor, conjugate, times};
use super::injective::is_injective;
use super::stretch::minimize_stretch;
use crate::edit_mesh::EditMesh;
use crate::refusal::Refusal;

/// A vertex of a chart with given texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pin {
    pub(super) vertex: u32,
    uv: Vec2,
}

impl Pin {
    /// With v upwards, as in layouts.
    pub(super) fn point(&self) -> DVec2 {
        upright(self.uv)
    }
}

fn upright(uv: Vec2) -> DVec2 {
    let uv = uv.as_dvec2();
    DVec2::new(uv.x, -uv.y)
}

/// A chart with pins, and its layout.
pub(super) struct PinnedIsland {
    chart: UvChart,
    pins: Vec<Pin>,
    /// By vertex of the chart.
    uvs: Vec<Vec2>,
}

/// The pins of a chart, in the order of its vertices.
pub(super) fn pins(mesh: &EditMesh, chart: &UvChart, uv_set: usize) -> Result<Vec<Pin>, Refusal> {
    let not_possible = |reason| Err(Refusal::NotPossible { operation: super::OPERATION, reason });
    let mut by_vertex: Vec<Option<Vec2>> = vec![None; chart.points.len()];
    for at in chart.corners.iter().filter(|at| mesh.is_uv_pinned(uv_set, at.corner)) {
        let Some(uv) = mesh.uv(uv_set, at.corner) else { continue };
        if !uv.is_finite() {
            return not_possible("pinned texture coordinates are not finite; clear the pin");
        }
        let known = by_vertex[at.vertex as usize].get_or_insert(uv);
        if *known != uv {
            return not_possible(
                "a vertex is pinned at two positions, and no seam separates them; mark one, or clear a pin",
            );
        }
    }
    let pin = |(vertex, uv): (u32, &Option<Vec2>)| uv.map(|uv| Pin { vertex, uv });
    Ok((0..).zip(&by_vertex).filter_map(pin).collect())
}

/// The layout of a chart with at least two pins.
pub(super) fn lay_between(
    chart: &mut UvChart,
    pins: &[Pin],
    steps: u32,
    memory: u64,
) -> Result<Vec<DVec2>, NoFactor> {
    let mut layout = conformal::between(chart, pins, memory)?;
    if steps > 0 && is_injective(chart, &layout) {
        chart.held = pins.iter().map(|pin| pin.vertex).collect();
        // The shapes of triangles are compared with those on the surface: sizes have to agree.
        let scale = (surface_area(chart) / chart.layout_area(&layout)).sqrt();
        if scale.is_finite() && scale > 0.0 {
            layout.iter_mut().for_each(|point| *point *= scale);
            minimize_stretch(chart, &mut layout, steps, memory)?;
            layout.iter_mut().for_each(|point| *point /= scale);
        }
    }
    Ok(layout)
}

/// Turns, scales and moves a layout so that one vertex is at its pin, and the others are as close to where they were
/// as a similarity allows.
pub(super) fn move_to_pin(mesh: &EditMesh, chart: &UvChart, pin: &Pin, uv_set: usize, layout: &mut [DVec2]) {
    let mut before = vec![DVec2::ZERO; chart.points.len()];
    for at in &chart.corners {
        before[at.vertex as usize] = upright(mesh.uv(uv_set, at.corner).unwrap_or_default());
    }
    let (to, from) = (pin.point(), layout[pin.vertex as usize]);
    before[pin.vertex as usize] = to;
    let turned: DVec2 =
        layout.iter().zip(&before).map(|(new, old)| times(*old - to, conjugate(*new - from))).sum();
    let ratio = (chart.layout_area(&before) / chart.layout_area(layout)).sqrt();
    // Without a size of its own it is as large as the image.
    let scale = if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 / extent(layout) };
    let similarity = turned.normalize_or(DVec2::X) * scale;
    for point in layout {
        *point = to + times(similarity, *point - from);
    }
}

/// The greater side of the box around points; 1 without one.
fn extent(points: &[DVec2]) -> f64 {
    let low = points.iter().fold(DVec2::INFINITY, |low, point| low.min(*point));
    let high = points.iter().fold(DVec2::NEG_INFINITY, |high, point| high.max(*point));
    let extent = (high - low).max_element();
    if extent.is_finite() && extent > 0.0 { extent } else { 1.0 }
}

/// The area of a chart in the units of its points.
fn surface_area(chart: &UvChart) -> f64 {
    chart.area() / (chart.size * chart.size)
}

impl PinnedIsland {
    /// Rounds a layout to texture coordinates; those of pins are what they were.
    pub(super) fn new(chart: UvChart, pins: Vec<Pin>, layout: &[DVec2]) -> Result<Self, Refusal> {
        // The sums turn −0 into 0.
        let rounded = |point: &DVec2| (DVec2::new(point.x, -point.y) + DVec2::ZERO).as_vec2();
        let mut uvs: Vec<Vec2> = layout.iter().map(rounded).collect();
        if !uvs.iter().all(|uv| uv.is_finite()) {
            let reason = "texture coordinates would not be finite; move the pins closer to the image";
            return Err(Refusal::NotPossible { operation: super::OPERATION, reason });
        }
        pins.iter().for_each(|pin| uvs[pin.vertex as usize] = pin.uv);
        Ok(Self { chart, pins, uvs })
    }

    fn layout(&self) -> Vec<DVec2> {
        self.uvs.iter().map(|&uv| upright(uv)).collect()
    }

    /// How many of its triangles are turned over or have no area.
    pub(super) fn turned_over(&self) -> usize {
        super::injective::turned_over(&self.chart, &self.layout())
    }

    /// Whether pins make it overlap itself: a single one never does.
    pub(super) fn overlaps(&self) -> bool {
        self.pins.len() > 1 && !is_injective(&self.chart, &self.layout())
    }

    /// Gives its corners their coordinates.
    pub(super) fn write(&self, mesh: &mut EditMesh, uv_set: usize) {
        for at in &self.chart.corners {
            mesh.set_uv(uv_set, at.corner, self.uvs[at.vertex as usize]);
        }
    }
}
