//! The points of a mesh: its vertices, split wherever any attribute has a seam.

use super::corners::{CornerTable, NONE};
use super::shape::Tables;
use crate::formats::gltf::broken::Broken;

/// The triangles in points.
pub(super) struct Numbered {
    pub(super) points: usize,
    /// Three points each.
    pub(super) triangles: Vec<u32>,
}

/// Numbers the points. `is_closed` tells of each vertex whether its triangles close around it.
pub(super) fn number_points(tables: &Tables, is_closed: &[bool]) -> Result<Numbered, Broken> {
    let positions = &tables.positions;
    if tables.attributes.is_empty() {
        return Ok(Numbered { points: positions.first.len(), triangles: positions.vertices.clone() });
    }
    let mut triangles = vec![NONE; positions.vertices.len()];
    let mut points = 0;
    for (&corner, &is_closed) in positions.first.iter().zip(is_closed) {
        if corner == NONE {
            continue;
        }
        let start = if is_closed { after_seam(tables, corner)? } else { corner };
        triangles[start as usize] = points;
        let mut before = start;
        loop {
            let corner = positions.swing_right(before);
            if corner == NONE || corner == start {
                break;
            }
            let differs = |table: &CornerTable| table.vertex(corner) != table.vertex(before);
            points += u32::from(tables.attributes.iter().any(differs));
            triangles[corner as usize] = points;
            before = corner;
        }
        points += 1;
    }
    if triangles.contains(&NONE) {
        return Err("some of its triangles hang together wrongly");
    }
    Ok(Numbered { points: points as usize, triangles })
}

/// The first corner to the right of a seam around a closed vertex; the corner itself if no
/// attribute has one there.
fn after_seam(tables: &Tables, corner: u32) -> Result<u32, Broken> {
    for table in &tables.attributes {
        let mut right = tables.positions.swing_right(corner);
        while right != corner {
            if right == NONE {
                return Err("a vertex that should be closed is on a boundary");
            }
            if table.vertex(right) != table.vertex(corner) {
                return Ok(right);
            }
            right = tables.positions.swing_right(right);
        }
    }
    Ok(corner)
}
