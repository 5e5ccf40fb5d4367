//! Reducing the number of triangles, with as little change of the surface as possible.
//!
//! Edges collapse in the order of the error that this causes (`candidates`, from `quadric` and `wedges`). `surface` is a
//! copy of what is needed for that, as lists; `collapse` works on it, and `rebuild` changes the mesh once at the end.

mod candidates;
mod collapse;
mod quadric;
mod rebuild;
mod surface;
#[cfg(test)]
mod tests;
mod wedges;

use self::collapse::{Goal, reduce};
use self::surface::Surface;
use super::region::Region;
use crate::edit_mesh::EditMesh;
use crate::ids::{FaceId, VertexId};
use crate::modifier::{DecimateGoal, DecimateSettings};
use crate::refusal::Refusal;
use crate::vertex_groups::VertexGroup;

/// What was left.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct Decimated {
    /// The triangles that are left of the given faces.
    pub faces: Vec<FaceId>,
    /// How many triangles were removed.
    pub removed: usize,
    /// Whether more triangles are left than a ratio or a number says, as features hold them.
    pub is_held: bool,
    /// The largest error of a collapse, in metres, as for [`DecimateSettings::error`].
    pub error: f64,
}

impl DecimateSettings {
    fn goal(&self, triangles: usize) -> Goal {
        let (triangles, error) = match self.goal {
            DecimateGoal::Ratio => ((triangles as f64 * self.ratio) as usize, f64::INFINITY),
            DecimateGoal::Faces => (self.faces as usize, f64::INFINITY),
            DecimateGoal::Error => (0, self.error * self.error),
        };
        Goal { triangles, error }
    }
}

impl EditMesh {
    /// Reduces the number of triangles of faces by collapsing edges, those first that change the surface least: the error is
    /// the sum of squared distances from the planes of all triangles that a vertex stands for (M. Garland and P. Heckbert,
    /// "Surface Simplification Using Quadric Error Metrics", 1997), with texture coordinates and colours as in H. Hoppe,
    /// "New Quadric Metric for Simplifying Meshes with Appearance Attributes", 1999. Other faces are cut into triangles
    /// first, and numbers are those of triangles.
    ///
    /// Features are borders, edges that are sharp, creased or seams, and those where material, shading, texture coordinates
    /// or colours end. They only collapse along themselves, and vertices where they end or branch stay, as do those of other
    /// faces and of loose edges. No triangle turns by more than about 78° in a step, a closed surface stays closed, and
    /// nothing that is manifold becomes non-manifold; so more triangles may be left than were asked for. Borders of values
    /// that hold vertices never make others go that the shape needs. Vertices and faces
    /// that are left keep their ids. Values are interpolated along collapsed edges; normals that were given are interpolated,
    /// too, but cleared where the corners of a collapsed vertex had different ones. With [`DecimateSettings::group`], the
    /// triangles' number counts all, and edges at a vertex of weight 0 never collapse.
    ///
    /// # Errors
    /// No face is given, or one does not exist; a parameter is out of range; there is no such group; there is no room for
    /// the triangles.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{DecimateGoal, DecimateSettings, EditMesh, FaceId};
    ///
    /// let (mut sphere, _) = EditMesh::from_mesh(&primitives::icosphere(1.0, 4));
    /// let faces: Vec<FaceId> = sphere.faces().collect();
    /// let settings = DecimateSettings { goal: DecimateGoal::Faces, faces: 500, ..Default::default() };
    /// let made = sphere.decimate(&faces, &settings)?;
    /// assert_eq!((sphere.face_count(), made.removed), (500, 4620));
    /// assert!(sphere.is_watertight());
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn decimate(&mut self, faces: &[FaceId], settings: &DecimateSettings) -> Result<Decimated, Refusal> {
        settings.check()?;
        self.limiting_group(&settings.group)?;
        let triangles = self.triangulate_faces(faces)?.faces;
        let region = Region::new(self, &triangles, "decimating")?;
        let goal = settings.goal(region.faces.len());
        let mut surface = Surface::of(self, &region, settings.hold_values);
        surface.allowances = self.allowances(&surface.vertices, settings)?;
        let allowances = &surface.allowances;
        let limit = if surface.has_value_borders {
            self.error_of_shape(&region, goal, allowances)
        } else {
            goal.error
        };
        let error = reduce(self, &mut surface, Goal { error: limit.min(goal.error), ..goal });
        let faces = self.rebuild(&region, &surface);
        let is_held = settings.goal != DecimateGoal::Error && faces.len() > goal.triangles;
        Ok(Decimated { removed: region.faces.len() - faces.len(), faces, is_held, error: error.sqrt() })
    }

    /// By vertices, how much of an error each allows; empty without a group.
    fn allowances(&self, vertices: &[VertexId], settings: &DecimateSettings) -> Result<Vec<f64>, Refusal> {
        let group = self.limiting_group(&settings.group)?;
        let of_group = |group: VertexGroup<'_>| {
            vertices.iter().map(|&vertex| group.factor(vertex, settings.invert_group)).collect()
        };
        Ok(group.map_or_else(Vec::new, of_group))
    }

    /// The greatest error that is allowed for the sake of values: a few times the one with which the shape alone would
    /// reach the goal. Where values hold what could go at no error, nothing else goes in its place.
    fn error_of_shape(&self, region: &Region, goal: Goal, allowances: &[f64]) -> f64 {
        /// Of the square of a length.
        const TIMES: f64 = 4.0;
        /// Of the extent: less is not visible.
        const LEAST: f64 = 1e-4;
        let mut shape = Surface::of(self, region, false);
        shape.allowances = allowances.to_vec();
        let extent = self.bounds_of(shape.vertices.iter().copied()).size().max_element();
        let least = LEAST * extent;
        (TIMES * reduce(self, &mut shape, goal)).max(least * least)
    }
}
