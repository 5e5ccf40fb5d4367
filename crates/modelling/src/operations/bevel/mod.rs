//! Bevels: edges and vertices are replaced with flat or round faces.
//!
//! In four steps. `chosen` finds what can be beveled, and the `fans` of faces around its vertices. `nodes` (with
//! `sectors`, `miters`, `places`, `rims` and `frames`) finds the positions of the new rims. The rims move in
//! proportion to the width, so that overlaps are found before any width is fixed. `shape` lays out all new
//! vertices, faces and values (`profile` is the cross-section, `patch` the grid where three or more bevels meet).
//! `build` changes the mesh. Until then nothing is written, and an error costs nothing. `finish` marks the rims
//! and hardens normals if that is requested.
//!
//! Arrangement and names follow Blender's bevel (Howard Trickey); the positions within patches
//! are our own.

#[cfg(test)]
mod between_tests;
mod build;
mod chosen;
mod fans;
mod finish;
mod frames;
mod laid;
mod miters;
mod node_positions;
mod nodes;
mod patch;
mod profile;
mod rims;
mod sectors;
mod settings;
#[cfg(test)]
mod settings_tests;
mod shape;
#[cfg(test)]
mod tests;

use super::delete::require;
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::refusal::Refusal;
use laid::Laid;
use nodes::Nodes;
use profile::Profile;
use rims::Rims;
pub use settings::{BevelSettings, BevelWidth, InnerMiter, OuterMiter};

const OPERATION: &str = "a bevel";

/// The result of a bevel.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Beveled {
    /// The new faces: those along the edges, edge by edge, then those at the vertices.
    pub faces: Vec<FaceId>,
    /// The new vertices.
    pub vertices: Vec<VertexId>,
    /// The width used, in the unit of the settings: less than requested if overlaps were avoided.
    pub width: f64,
    /// Given elements that were not beveled.
    pub left_out: BevelLeftOut,
}

/// How many of the given elements were not beveled, and why.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct BevelLeftOut {
    /// Edges and vertices without faces.
    pub wires: usize,
    /// Edges with one face.
    pub borders: usize,
    /// Edges with more than two faces.
    pub non_manifold: usize,
    /// Edges whose two faces have opposite windings.
    pub opposite: usize,
    /// Edges and vertices where such edges end or a face runs along an edge and back: the order of
    /// the faces around a vertex is undefined there.
    pub unclear: usize,
}

impl BevelLeftOut {
    /// The number of elements of all kinds.
    #[must_use]
    pub fn count(&self) -> usize {
        let Self { wires, borders, non_manifold, opposite, unclear } = self;
        wires + borders + non_manifold + opposite + unclear
    }

    fn reason(&self) -> &'static str {
        if self.non_manifold > 0 {
            "more than two faces meet at the edges"
        } else if self.opposite > 0 {
            "faces wind in opposite ways; recalculate normals first"
        } else if self.unclear > 0 {
            "more than two faces, or faces that wind in opposite ways, meet beside them"
        } else if self.borders > 0 {
            "the edges have one face; an edge between two faces is needed"
        } else {
            "there are no faces"
        }
    }
}

impl EditMesh {
    /// Replaces edges with faces: flat ones, or round ones with several segments.
    ///
    /// Each face next to an edge retreats by the width, or as [`BevelWidth`] says. Where one beveled edge ends, its rims end on the
    /// adjacent edges; if there are more, each gets a vertex and a polygon fills the middle. Where two meet,
    /// their bevels meet in one curve. Where three or more meet, a polygon fills the middle, or with several
    /// segments a grid, as on a cube with all edges beveled: part of a sphere. (Also a polygon if the faces
    /// do not close around the vertex, or more than 32 meet.) Edges between two beveled ones end at the
    /// position between these.
    ///
    /// Faces keep their ids, and so do edges that were not beveled; the old edge becomes the rim on the side
    /// of its first face. New faces have the material of the face on their side, for an odd number of
    /// segments the middle one that of the first side. Both rims take over sharp and crease, and the line
    /// where the material changes takes over the seam. Values are interpolated; where texture coordinates are
    /// cut, each side continues its own. Hidden faces are beveled like others.
    ///
    /// Edges that cannot be beveled are skipped and counted: a border, an edge with more than two
    /// faces, and edges that end at these. Unlike in Blender, overlaps are avoided by default, and
    /// marks are always kept.
    ///
    /// # Errors
    /// No edge is given, or one does not exist; none of them can be beveled; a setting is out of
    /// range; there would be too many elements.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{BevelSettings, EditMesh};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// let edges: Vec<_> = cube.edges().collect();
    /// let settings = BevelSettings { width: 0.25, segments: 4, ..BevelSettings::default() };
    /// let beveled = cube.bevel_edges(&edges, &settings)?;
    /// // Four faces along each of twelve edges, a grid of twelve at each of eight corners.
    /// assert_eq!(beveled.faces.len(), 12 * 4 + 8 * 12);
    /// # Ok::<(), trigon_modelling::Refusal>(())
    /// ```
    pub fn bevel_edges(&mut self, edges: &[EdgeId], settings: &BevelSettings) -> Result<Beveled, Refusal> {
        require(edges, OPERATION, "at least one edge")?;
        edges.iter().try_for_each(|&edge| self.check_edge(edge))?;
        settings.check()?;
        let mut left_out = BevelLeftOut::default();
        let (chosen, fans, marks) = self.beveled_edges(edges, &mut left_out);
        if chosen.is_empty() {
            return Err(Refusal::NotPossible { operation: OPERATION, reason: left_out.reason() });
        }
        let rims = Rims::of_edges(self, &chosen, settings);
        let mut nodes = Nodes::new(self, marks, fans.fans.len(), rims);
        for &fan in &fans.fans {
            nodes.add_edge_fan(fan, &fans.corners[fan.start..fan.end]);
        }
        self.run_bevel(nodes.finish(&chosen), &chosen, settings, left_out)
    }

    /// Replaces vertices with faces: the corner is cut off, flat or round.
    ///
    /// Each edge at a vertex ends at the width from it. Between them, the faces there end in straight lines,
    /// or with several segments in curves of the profile; a polygon or a grid fills the middle. At a border
    /// the polygon's last side is straight. Otherwise as [`Self::bevel_edges`].
    ///
    /// # Errors
    /// No vertex is given, or one does not exist; none of them can be beveled; a setting is out of
    /// range; there would be too many elements.
    pub fn bevel_vertices(
        &mut self,
        vertices: &[VertexId],
        settings: &BevelSettings,
    ) -> Result<Beveled, Refusal> {
        require(vertices, OPERATION, "at least one vertex")?;
        vertices.iter().try_for_each(|&vertex| self.check_vertex(vertex))?;
        settings.check()?;
        let mut left_out = BevelLeftOut::default();
        let fans = self.bevel_fans_of_vertices(vertices, &mut left_out);
        if fans.fans.is_empty() {
            return Err(Refusal::NotPossible { operation: OPERATION, reason: left_out.reason() });
        }
        // The zeros cost nothing until they are touched.
        let rims = Rims::of_edges(self, &[], settings);
        let mut nodes = Nodes::new(self, vec![0; self.edge_capacity()], fans.fans.len(), rims);
        for &fan in &fans.fans {
            nodes.add_vertex_fan(fan, &fans.corners[fan.start..fan.end]);
        }
        self.run_bevel(nodes.finish(&[]), &[], settings, left_out)
    }

    fn run_bevel(
        &mut self,
        laid: Laid,
        edges: &[EdgeId],
        settings: &BevelSettings,
        left_out: BevelLeftOut,
    ) -> Result<Beveled, Refusal> {
        let limit = if settings.clamp_overlap { laid.limit } else { f64::INFINITY };
        let width = if limit < settings.width { limit } else { settings.width };
        let profile = Profile::new(settings.segments, settings.profile);
        shape::check_size(self, &laid, settings.segments)?;
        let finish = self.plan_bevel_finish(&laid, edges, settings);
        let plan = shape::Plan::draw(self, laid, &profile, width);
        let (faces, vertices) = self.build_bevel(plan, edges, &finish);
        Ok(Beveled { faces, vertices, width, left_out })
    }
}
