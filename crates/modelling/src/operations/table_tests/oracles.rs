//! Facts about a mesh, from lists of vertices alone.

use std::collections::{BTreeMap, BTreeSet};

use trigon_math::DVec3;

use crate::EditMesh;

/// What can be counted and measured of a mesh.
pub(super) struct Facts {
    pub(super) outlines: Vec<Vec<u32>>,
    /// Vertices − edges + faces.
    pub(super) euler: i64,
    /// Whether each edge is run along in both directions equally often.
    pub(super) is_closed: bool,
    /// Faces with the vertices of an earlier one.
    pub(super) doubled_faces: usize,
    /// The sum of the areas of all faces, each as if flat.
    pub(super) area: f64,
    /// By the divergence theorem, for what is closed.
    pub(super) volume: f64,
}

impl Facts {
    pub(super) fn of(mesh: &EditMesh) -> Self {
        let outlines: Vec<Vec<u32>> =
            mesh.faces().map(|face| mesh.face_vertices(face).map(|vertex| vertex.0).collect()).collect();
        let mut sides: BTreeMap<[u32; 2], i64> = BTreeMap::new();
        for outline in &outlines {
            for (i, &from) in outline.iter().enumerate() {
                let to = outline[(i + 1) % outline.len()];
                *sides.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
            }
        }
        let sets: BTreeSet<BTreeSet<u32>> =
            outlines.iter().map(|outline| outline.iter().copied().collect()).collect();
        let place = |vertex: u32| mesh.position(crate::VertexId(vertex)).as_dvec3();
        // Twice the area vector of a polygon, from any origin (the shoelace formula).
        let doubled = |outline: &Vec<u32>| -> DVec3 {
            let pair = |i: usize| place(outline[i]).cross(place(outline[(i + 1) % outline.len()]));
            (0..outline.len()).map(pair).sum()
        };
        let solid = |outline: &Vec<u32>| doubled(outline).dot(place(outline[0])) / 6.0;
        Self {
            euler: mesh.vertex_count() as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64,
            is_closed: sides.values().all(|count| *count == 0),
            doubled_faces: outlines.len() - sets.len(),
            area: outlines.iter().map(|outline| doubled(outline).length() / 2.0).sum(),
            volume: outlines.iter().map(solid).sum(),
            outlines,
        }
    }

    /// Each face has three vertices or more, and none twice.
    pub(super) fn check_faces(&self) -> Result<(), String> {
        for outline in &self.outlines {
            let different: BTreeSet<u32> = outline.iter().copied().collect();
            if different.len() < outline.len() || outline.len() < 3 {
                return Err(format!("the face {outline:?}"));
            }
        }
        Ok(())
    }
}
