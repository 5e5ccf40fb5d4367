//! Polygons to triangles.
//!
//! A face of a model may be anything: concave, with holes that are joined to the outline by bridge edges,
//! with collinear or repeated corners, not planar, crossing itself. The polygon is projected along the axis
//! in which its area vector is longest. This is exact, because a coordinate is dropped. Ears are then cut
//! off in the plane by exact orientation tests.
//!
//! For every polygon whose projection does not cross itself, there are exactly n − 2 triangles (less one for
//! each corner that repeats the one before it or ends a spike of no width). None is reversed, none lies
//! outside, and **every corner is used**, also one in the middle of a straight side, so that a neighbouring
//! face that shares this corner leaves no crack.
//!
//! The crate `earcut` is not used for two reasons: it drops collinear corners, and it searches diagonals in
//! cubic time if a polygon crosses itself, which a hostile file could exploit. The tests compare our areas
//! with its areas.

mod ears;
mod grid;
mod loops;
mod quad;

use trigon_math::{AxisProjection, DVec2, Vec3};

use ears::EarCutter;

/// Cuts a polygon into triangles: indices into `positions`, counter-clockwise
/// seen from the side from which the polygon is.
///
/// - A triangle is itself, even without area. Any other polygon without area
///   has no triangles.
/// - A quad is cut along its shorter diagonal, the first one (0–2) if there is
///   no clear difference; if one half would be turned over (a concave or
///   folded quad), along the other diagonal.
/// - A polygon that crosses itself has no triangulation over its own corners:
///   it gets at most n − 2 triangles inside its convex hull.
/// - Fewer than three positions give nothing. With a coordinate that is not
///   finite nothing is known about the shape: it becomes a fan.
///
/// ```
/// use trigon_math::Vec3;
/// use trigon_mesh::triangulate_polygon;
///
/// // An arrow head. The diagonal from 0 to 2 is inside, the other is not.
/// let outline = [(0.0, 0.0), (3.0, -1.0), (1.0, 0.0), (3.0, 1.0)];
/// let corners = outline.map(|(x, y)| Vec3::new(x, y, 0.0));
/// assert_eq!(triangulate_polygon(&corners), [[0, 1, 2], [0, 2, 3]]);
/// ```
#[must_use]
pub fn triangulate_polygon(positions: &[Vec3]) -> Vec<[u32; 3]> {
    let mut triangles = Vec::with_capacity(positions.len().saturating_sub(2));
    Triangulator::default().polygon(positions, &mut triangles);
    triangles
}

/// Cuts one polygon after another into triangles, as [`triangulate_polygon`] does, in the same memory.
///
/// ```
/// use trigon_math::Vec3;
/// use trigon_mesh::Triangulator;
///
/// let mut triangulator = Triangulator::default();
/// let mut triangles = Vec::new();
/// let square = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
/// triangulator.polygon(&square, &mut triangles);
/// triangulator.polygon(&square[1..], &mut triangles);
/// assert_eq!(triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 2]]);
/// ```
#[derive(Debug, Default)]
pub struct Triangulator {
    projected: Vec<DVec2>,
    cutter: EarCutter,
}

impl Triangulator {
    /// Appends a polygon's triangles, as indices into `positions`.
    pub fn polygon(&mut self, positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
        match *positions {
            [] | [_] | [_, _] => {}
            [_, _, _] => triangles.push([0, 1, 2]),
            [a, b, c, d] => match quad::split([a, b, c, d]) {
                Some(cut) => triangles.extend(cut.triangles()),
                None => self.any(positions, triangles),
            },
            _ => self.any(positions, triangles),
        }
    }

    fn any(&mut self, positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
        if positions.iter().all(|position| position.is_finite()) {
            let view = AxisProjection::of(positions);
            self.projected.clear();
            self.projected.extend(positions.iter().map(|p| view.project(p.as_dvec3())));
            self.cutter.cut(&self.projected, triangles);
        } else {
            triangles.extend((2..positions.len() as u32).map(|i| [0, i - 1, i]));
        }
    }
}
