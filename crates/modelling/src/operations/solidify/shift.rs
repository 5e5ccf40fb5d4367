//! By which vector a vertex moves so that the planes of its faces move by 1 along their normals.

use smallvec::SmallVec;
use trigon_math::{DMat3, DVec3, unit_or_zero};

use crate::edit_mesh::EditMesh;
use crate::ids::VertexId;
use crate::operations::lift::RegionCorner;
use crate::operations::region::Region;

/// Almost folded faces would need endless vectors.
const LONGEST: f64 = 20.0;

/// Normals whose difference is shorter belong to one plane: that of positions rounded to `f32`.
const SAME: f64 = 1e-6;

/// How much a vector along the mean normal weighs, against the planes' distances, where more than three planes meet: only
/// vectors that hardly change the distances are changed by it.
const REGULAR: f64 = 1e-3;

/// The planes at a vertex: unit normals, and the sums of the faces' angles.
type Planes = SmallVec<[(DVec3, f64); 4]>;

impl EditMesh {
    /// For each vertex of a region, by which vector it moves for a distance of 1; zero where faces have no normals.
    pub(in crate::operations) fn shifts(
        &self,
        region: &Region,
        vertices: &[VertexId],
        even: bool,
    ) -> Vec<DVec3> {
        let mut planes = vec![Planes::new(); vertices.len()];
        for RegionCorner { index, normal, angle } in self.region_corners(region, vertices) {
            add(&mut planes[index], normal, angle);
        }
        planes.iter().map(|planes| if even { even_shift(planes) } else { mean(planes) }).collect()
    }
}

fn add(planes: &mut Planes, normal: DVec3, weight: f64) {
    match planes.iter_mut().find(|(known, _)| known.distance_squared(normal) < SAME * SAME) {
        Some((_, sum)) => *sum += weight,
        None => planes.push((normal, weight)),
    }
}

/// The direction of the weighted mean of the normals.
fn mean(planes: &Planes) -> DVec3 {
    match planes[..] {
        [(normal, _)] => normal,
        _ => unit_or_zero(planes.iter().map(|&(normal, weight)| normal * weight).sum()),
    }
}

fn even_shift(planes: &Planes) -> DVec3 {
    let shift = match planes[..] {
        [] => DVec3::ZERO,
        [(normal, _)] => normal,
        [(a, _), (b, _)] => (a + b) / (1.0 + a.dot(b)),
        [(a, _), (b, _), (c, _)] => meeting(a, b, c).unwrap_or_else(|| least_squares(planes)),
        _ => least_squares(planes),
    };
    if shift.length() <= LONGEST { shift } else { mean(planes) * LONGEST }
}

/// Where three planes meet that are at distance 1 from the origin; `None` if that is far away.
fn meeting(a: DVec3, b: DVec3, c: DVec3) -> Option<DVec3> {
    let point = (b.cross(c) + c.cross(a) + a.cross(b)) / a.dot(b.cross(c));
    // It is NaN where the planes are parallel to one line.
    (point.length() <= LONGEST).then_some(point)
}

/// The vector that moves all planes by 1 in the weighted least squares.
fn least_squares(planes: &Planes) -> DVec3 {
    let direction = mean(planes);
    let weights: f64 = planes.iter().map(|&(_, weight)| weight).sum();
    let component: f64 =
        planes.iter().map(|&(normal, weight)| normal.dot(direction) * weight).sum::<f64>() / weights;
    let start = direction * if component > 1.0 / LONGEST { 1.0 / component } else { LONGEST };
    let mut matrix = DMat3::from_diagonal(DVec3::splat(REGULAR * weights));
    let mut right = DVec3::ZERO;
    for &(normal, weight) in planes {
        let column = |factor: f64| normal * (factor * weight);
        matrix += DMat3::from_cols(column(normal.x), column(normal.y), column(normal.z));
        right += normal * (weight * (1.0 - normal.dot(start)));
    }
    let shift = start + matrix.inverse() * right;
    if shift.is_finite() { shift } else { start }
}
