//! Solidifying: faces get a second layer at a distance, so that a surface becomes a wall.

mod shift;
#[cfg(test)]
mod tests;

use trigon_math::DVec3;

use super::region::{BorderEdge, Region, SplitVertices};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::modifier::SolidifySettings;
use crate::refusal::Refusal;
use crate::slots::NewElements;

impl SolidifySettings {
    /// How far both layers are from the old surface along its normal: the given faces, and the new ones.
    fn distances(&self) -> [f64; 2] {
        [1.0, -1.0].map(|side| self.thickness * (self.offset + side) / 2.0)
    }
}

/// The new elements.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Solidified {
    /// The second layer: one face for each given one, in the order of ids, looking the other way.
    pub inner: Vec<FaceId>,
    /// The quads along the border.
    pub rim: Vec<FaceId>,
    /// The vertices of the second layer.
    pub vertices: Vec<VertexId>,
}

impl EditMesh {
    /// Gives faces a second layer behind them, and joins both along the border, so that a sheet becomes a closed solid and
    /// a closed surface a hollow one.
    ///
    /// The given faces keep their ids and are the layer in front. The border consists of the edges with one side of these
    /// faces; other faces there stay joined to the given ones. Values and marks of the second layer are those of the
    /// first; the rim has the texture coordinates and colours of the corners beside it, and no given normals.
    ///
    /// With [`SolidifySettings::even`], a vertex whose faces lie in up to three planes moves so that each plane moves by
    /// exactly the distance, up to rounding to `f32`; with more planes, the distance is right in the least squares. No
    /// vertex moves farther than 20 times the distance, which almost folded faces would need. A vertex without a normal
    /// stays. Thick walls of small details may cross each other. With [`SolidifySettings::group`], the distance at a vertex
    /// is times its weight; where that is 0 both layers meet.
    ///
    /// # Errors
    /// No face is given, or one does not exist; a parameter is out of range; there is no such group; there would be too
    /// many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, FaceId, SolidifySettings};
    ///
    /// let (mut grid, _) = EditMesh::from_mesh(&primitives::grid(2.0, 3.0, 4, 4));
    /// let faces: Vec<FaceId> = grid.faces().collect();
    /// grid.solidify_faces(&faces, &SolidifySettings { thickness: 0.5, ..SolidifySettings::default() })?;
    /// assert!(grid.is_watertight());
    /// assert!((grid.volume() - 3.0).abs() < 1e-6, "area times thickness");
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn solidify_faces(
        &mut self,
        faces: &[FaceId],
        settings: &SolidifySettings,
    ) -> Result<Solidified, Refusal> {
        let region = Region::new(self, faces, "solidifying")?;
        settings.check()?;
        let vertices = region.vertices(self);
        let border = if settings.rim { self.single_sides(&region) } else { Vec::new() };
        let (corners, rim) = (region.corner_count(self) as u64, border.len() as u64);
        self.check_capacity_for(NewElements {
            vertices: vertices.len() as u64,
            edges: corners + 2 * rim,
            corners: corners + 4 * rim,
            faces: (region.faces.len() + border.len()) as u64,
        })?;
        let mut shifts = self.shifts(&region, &vertices, settings.even);
        if let Some(group) = self.limiting_group(&settings.group)? {
            for (shift, &vertex) in shifts.iter_mut().zip(&vertices) {
                *shift *= group.factor(vertex, settings.invert_group);
            }
        }
        let made = self.add_layer(&region, &vertices, &border);
        for (&inner, material) in made.inner.iter().zip(std::iter::repeat(settings.inner_material)) {
            material.into_iter().for_each(|material| self.set_material(inner, material));
        }
        for (&wall, material) in made.rim.iter().zip(std::iter::repeat(settings.rim_material)) {
            material.into_iter().for_each(|material| self.set_material(wall, material));
        }
        let [front, behind] = settings.distances();
        for ((&vertex, &copy), &shift) in vertices.iter().zip(&made.vertices).zip(&shifts) {
            let point = self.point(vertex);
            self.move_to(vertex, point + shift * front);
            self.move_to(copy, point + shift * behind);
        }
        Ok(made)
    }

    fn move_to(&mut self, vertex: VertexId, point: DVec3) {
        if point != self.point(vertex) {
            self.set_position(vertex, point.as_vec3());
        }
    }

    /// The edges with one side of a region's faces.
    pub(super) fn single_sides(&self, region: &Region) -> Vec<BorderEdge> {
        let mut border = region.border(self);
        border.retain(|border| {
            let sides = self.edge_corners(border.edge).filter(|&side| region.has_corner(self, side));
            sides.take(2).count() == 1
        });
        border
    }

    /// Adds the copies of a region's faces, at the same positions, and the rim.
    fn add_layer(&mut self, region: &Region, vertices: &[VertexId], border: &[BorderEdge]) -> Solidified {
        let mut splits = SplitVertices::new(self, vertices.len());
        let copies = vertices.iter().map(|&vertex| splits.split(self, vertex)).collect();
        let base_edges: Vec<EdgeId> = border
            .iter()
            .map(|border| {
                let ends = self.edge_vertices(border.edge);
                let [a, b] = ends.map(|vertex| splits.base(vertex).expect("all were split"));
                let base = self.fresh_edge(a, b);
                self.copy_edge(border.edge, base);
                base
            })
            .collect();
        let inner = self.add_bottoms(&region.faces, border, &base_edges, &splits);
        let mut hinges = vec![None; splits.list.len()];
        let sides = border.iter().zip(&base_edges);
        let rim = sides.map(|(border, &base)| self.add_wall(border, base, &splits, &mut hinges)).collect();
        Solidified { inner, rim, vertices: copies }
    }
}
