//! Islands of texture coordinates: their scale, and their arrangement in the image.

use trigon_math::DVec2;

use super::charts::{UvChart, charts};
use super::injective::turned_over;
use super::pack::{IslandShape, PackTurns, pack};
use super::rectangle::{to_origin, turn_upright};
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::refusal::Refusal;

/// Parameters of [`EditMesh::pack_uv_islands`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PackSettings {
    /// Whether islands may be turned.
    pub rotate: bool,
    /// Whether areas of islands become proportional to their areas on the surface.
    pub average_scale: bool,
    /// The distance of islands from one another and from the border of the image, in sides of the image; at least 0.
    pub margin: f64,
}

impl Default for PackSettings {
    /// Turned and scaled, with a margin of a hundredth.
    fn default() -> Self {
        Self { rotate: true, average_scale: true, margin: 0.01 }
    }
}

/// A chart with its layout; v grows upwards in it.
pub(super) struct Island {
    pub(super) chart: UvChart,
    pub(super) layout: Vec<DVec2>,
}

impl Island {
    /// An island of which the area is that of its chart.
    pub(super) fn with_area_of(chart: UvChart, mut layout: Vec<DVec2>) -> Self {
        let double = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| layout[vertex as usize]);
            (b - a).perp_dot(c - a)
        };
        let flat: f64 = chart.triangles.iter().map(double).sum::<f64>().abs() / 2.0;
        let scale = (chart.area() / flat).sqrt();
        if scale.is_finite() && scale > 0.0 {
            layout.iter_mut().for_each(|point| *point *= scale);
        }
        Self { chart, layout }
    }

    fn shape(&self) -> IslandShape<'_> {
        IslandShape { points: &self.layout, triangles: &self.chart.triangles }
    }
}

/// The charts of faces as their texture coordinates cut them.
pub(super) fn uv_charts(mesh: &EditMesh, faces: &[FaceId], uv_set: usize) -> Vec<UvChart> {
    charts(mesh, faces, |_, [a, b]| mesh.shares_uvs(uv_set, a, b))
}

pub(super) fn check_margin(margin: f64) -> Result<(), Refusal> {
    if (0.0..1.0).contains(&margin) {
        return Ok(());
    }
    Err(Refusal::OutOfRange { parameter: "the margin", value: margin, range: "at least 0 and below 1" })
}

impl EditMesh {
    /// Arranges the islands of faces in the image, from (0, 0) to (1, 1), so that they do not overlap. Faces belong
    /// to one island where they share an edge and its texture coordinates. Islands with pinned coordinates stay where they
    /// are. Returns the number of the others.
    ///
    /// # Errors
    /// No face is given, one does not exist; there is no such set; texture coordinates or positions are not finite;
    /// or the margin is out of range.
    pub fn pack_uv_islands(
        &mut self,
        faces: &[FaceId],
        uv_set: usize,
        settings: &PackSettings,
    ) -> Result<usize, Refusal> {
        const OPERATION: &str = "packing islands";
        let not_possible = |reason| Refusal::NotPossible { operation: OPERATION, reason };
        self.check_faces(faces, OPERATION)?;
        check_margin(settings.margin)?;
        if uv_set >= self.uv_set_count() {
            return Err(not_possible("there are no such texture coordinates; unwrap the faces first"));
        }
        let uv = |corner| self.uv(uv_set, corner).expect("the set exists");
        let mut islands = Vec::new();
        for chart in uv_charts(self, faces, uv_set) {
            if chart.corners.iter().any(|at| self.is_uv_pinned(uv_set, at.corner)) {
                continue;
            }
            let mut layout = vec![DVec2::ZERO; chart.points.len()];
            for corner in &chart.corners {
                let uv = uv(corner.corner).as_dvec2();
                layout[corner.vertex as usize] = DVec2::new(uv.x, -uv.y);
            }
            if !layout.iter().all(|uv| uv.is_finite()) || !chart.points.iter().all(|point| point.is_finite())
            {
                return Err(not_possible(
                    "a texture coordinate or position is not finite; unwrap the faces first",
                ));
            }
            islands.push(match settings.average_scale {
                true => Island::with_area_of(chart, layout),
                false => Island { chart, layout },
            });
        }
        let count = islands.len();
        self.write_islands(islands, uv_set, settings)?;
        Ok(count)
    }

    /// Arranges islands in the image, and gives their corners the coordinates. Returns how many triangles are turned
    /// over.
    pub(super) fn write_islands(
        &mut self,
        mut islands: Vec<Island>,
        uv_set: usize,
        settings: &PackSettings,
    ) -> Result<usize, Refusal> {
        for island in &mut islands {
            if settings.rotate {
                turn_upright(&mut island.layout);
            } else {
                to_origin(&mut island.layout);
            }
        }
        let shapes: Vec<IslandShape<'_>> = islands.iter().map(Island::shape).collect();
        let turns = if settings.rotate { PackTurns::Quarters } else { PackTurns::None };
        let arrangement = pack(&shapes, turns, settings.margin)?;
        self.add_uv_set(uv_set)?;
        let mut wrong = 0;
        for (Island { chart, layout }, slot) in islands.iter_mut().zip(arrangement.slots) {
            for point in layout.iter_mut() {
                // The sum turns −0 into 0: which of them a comparison gives differs between machines.
                let uv = (slot.apply(*point) / arrangement.side).clamp(DVec2::ZERO, DVec2::ONE) + DVec2::ZERO;
                *point = DVec2::new(uv.x, 1.0 - uv.y).as_vec2().as_dvec2();
            }
            for &at in &chart.corners {
                self.set_uv(uv_set, at.corner, layout[at.vertex as usize].as_vec2());
            }
            // v grows downwards now.
            layout.iter_mut().for_each(|point| point.y = -point.y);
            wrong += turned_over(chart, layout);
        }
        Ok(wrong)
    }
}
