//! The distance of rims from the old edges, and of new vertices from old ones, for a width of 1: what
//! [`BevelWidth`] measures.

use trigon_math::DVec3;

use super::node_positions::STRAIGHT;
use super::nodes::{Layout, Nodes};
use super::settings::{BevelSettings, BevelWidth, InnerMiter, OuterMiter};
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId};
use crate::measure::FaceNormals;

/// A percentage as a part of a length.
const PERCENT: f64 = 0.01;
/// By what the width is divided at least: rims are at most 20 times as far away.
const LEAST_DIVISOR: f64 = 0.05;

/// What the settings say about rims.
pub(super) struct Rims {
    width_type: BevelWidth,
    /// For each beveled edge, the distance of its rims where that depends on nothing else.
    of_edges: Vec<f64>,
    pub(super) outer_miter: OuterMiter,
    pub(super) inner_miter: InnerMiter,
}

impl Rims {
    pub(super) fn of_edges(mesh: &EditMesh, edges: &[EdgeId], settings: &BevelSettings) -> Self {
        let width_type = settings.width_type;
        let mut normals = FaceNormals::default();
        let of_edges = edges.iter().map(|&edge| of_edge(mesh, edge, width_type, &mut normals)).collect();
        let BevelSettings { outer_miter, inner_miter, .. } = *settings;
        Self { width_type, of_edges, outer_miter, inner_miter }
    }

    /// Whether the width is measured along the edges beside a beveled one, instead of from that.
    pub(super) fn measures_along_edges(&self) -> bool {
        matches!(self.width_type, BevelWidth::Percent | BevelWidth::Absolute)
    }

    /// How many edges are beveled.
    pub(super) fn count(&self) -> usize {
        self.of_edges.len()
    }
}

/// The distance of an edge's rims from it.
fn of_edge(mesh: &EditMesh, edge: EdgeId, width_type: BevelWidth, normals: &mut FaceNormals) -> f64 {
    // The cosine of the angle between the normals; the faces enclose the rest of half a turn.
    let mut cosine =
        || mesh.edge_normals(edge, normals).map_or(0.0, |[one, two]| one.dot(two).clamp(-1.0, 1.0));
    match width_type {
        // Two rims at distance 1 are 2 sin(a/2) apart, where the faces enclose the angle a.
        BevelWidth::Width => 1.0 / (2.0 * (0.5 + 0.5 * cosine()).sqrt().max(LEAST_DIVISOR)),
        // And the edge is cos(a/2) above their plane.
        BevelWidth::Depth => 1.0 / (0.5 - 0.5 * cosine()).sqrt().max(LEAST_DIVISOR),
        BevelWidth::Offset | BevelWidth::Percent | BevelWidth::Absolute => 1.0,
    }
}

impl Nodes<'_> {
    /// How far from one edge of a corner, which is beveled, its rim is in the corner's face.
    pub(super) fn rim(&self, corner: CornerId, is_out: bool) -> f64 {
        let edge = if is_out { corner } else { self.mesh.previous_corner(corner) };
        let number = self.number(self.mesh.corner_edge(edge));
        match self.rims.width_type {
            BevelWidth::Percent | BevelWidth::Absolute => {
                let (here, other) = (self.way(corner, is_out), self.way(corner, !is_out));
                let sine = here.0.cross(other.0).length();
                if sine > STRAIGHT {
                    return self.along_edge(other.1) * sine;
                }
                // Both edges are one line: there is no edge beside them.
                self.along_edge(0.5 * (here.1 + other.1))
            }
            _ => self.rims.of_edges.get(number as usize).copied().unwrap_or(1.0),
        }
    }

    /// How far the rim of one edge of a corner, which is beveled, is along the other one.
    pub(super) fn rim_distance(&self, corner: CornerId, is_out: bool) -> f64 {
        let other = self.way(corner, !is_out);
        if let BevelWidth::Percent | BevelWidth::Absolute = self.rims.width_type {
            return self.along_edge(other.1);
        }
        let sine = self.way(corner, is_out).0.cross(other.0).length();
        let rim = self.rim(corner, is_out);
        if sine > STRAIGHT { rim / sine } else { rim }
    }

    /// How far the node of an edge between two others that are not beveled is from the vertex. `rim` is that
    /// of the beveled edge at the same vertex.
    pub(super) fn free_distance(&self, length: f64, rim: f64) -> f64 {
        match self.rims.width_type {
            BevelWidth::Percent | BevelWidth::Absolute => self.along_edge(length),
            _ => rim,
        }
    }

    /// A width along an edge of some length: percent of it, or metres.
    fn along_edge(&self, length: f64) -> f64 {
        if self.rims.width_type == BevelWidth::Percent { PERCENT * length } else { 1.0 }
    }

    /// How far along its edge a new vertex is from a beveled vertex.
    pub(super) fn vertex_distance(&self, layout: &Layout, stop: usize, axis: DVec3) -> f64 {
        let (corner, is_out) = layout.corner_at(stop);
        let (direction, length) = self.way(corner, is_out);
        let cosine = direction.dot(axis);
        match self.rims.width_type {
            BevelWidth::Width => 0.5 / (1.0 - cosine * cosine).max(0.0).sqrt().max(LEAST_DIVISOR),
            BevelWidth::Depth => 1.0 / cosine.abs().max(LEAST_DIVISOR),
            _ => self.along_edge(length),
        }
    }

    /// The mean direction of the edges of a fan.
    pub(super) fn axis(&self, layout: &Layout, count: usize) -> DVec3 {
        let direction = |stop| {
            let (corner, is_out) = layout.corner_at(stop);
            self.way(corner, is_out).0
        };
        (0..count).map(direction).sum::<DVec3>().normalize_or_zero()
    }
}
