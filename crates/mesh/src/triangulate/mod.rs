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

use ears::EarCutter;
use trigon_math::{AxisProjection, DVec2, DVec3, Vec3};

use self::ears::turn;

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
            [a, b, c, d] => match split([a, b, c, d]) {
                Some(cut) => triangles.extend(cut.triangles()),
                None => self.any(positions, triangles),
            },
            _ => self.any(positions, triangles),
        }
    }

    /// Appends n − 2 triangles whose common border is the polygon: those of [`Self::polygon`], and those that
    /// are not drawn because they have no area or are turned over. So nothing of a polygon's border gets lost,
    /// whatever its shape.
    ///
    /// ```
    /// use trigon_math::Vec3;
    /// use trigon_mesh::Triangulator;
    ///
    /// // The last corner is the tip of a spike.
    /// let spiked = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y, Vec3::Y * 2.0];
    /// let (mut triangulator, mut drawn, mut all) = (Triangulator::default(), Vec::new(), Vec::new());
    /// triangulator.polygon(&spiked, &mut drawn);
    /// triangulator.complete_polygon(&spiked, &mut all);
    /// assert_eq!((drawn.len(), all.len()), (2, 3));
    /// ```
    pub fn complete_polygon(&mut self, positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
        match *positions {
            [] | [_] | [_, _] => {}
            [_, _, _] => triangles.push([0, 1, 2]),
            [a, b, c, d] => match split([a, b, c, d]) {
                Some(cut) => triangles.extend(cut.all_triangles()),
                None => self.any_completely(positions, triangles),
            },
            _ => self.any_completely(positions, triangles),
        }
    }

    fn any(&mut self, positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
        if self.project(positions) {
            self.cutter.cut(&self.projected, triangles);
        } else {
            triangles.extend(fan(positions.len()));
        }
    }

    fn any_completely(&mut self, positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) {
        if self.project(positions) {
            self.cutter.cut_completely(&self.projected, triangles);
        } else {
            triangles.extend(fan(positions.len()));
        }
    }

    /// Projects a polygon into a plane; false, and nothing is known about its shape, where one of its coordinates
    /// is not finite.
    fn project(&mut self, positions: &[Vec3]) -> bool {
        if !positions.iter().all(|position| position.is_finite()) {
            return false;
        }
        let view = AxisProjection::of(positions);
        self.projected.clear();
        self.projected.extend(positions.iter().map(|p| view.project(p.as_dvec3())));
        true
    }
}

/// Triangles from the first corner of a polygon to all others.
fn fan(corners: usize) -> impl Iterator<Item = [u32; 3]> {
    (2..corners as u32).map(|i| [0, i - 1, i])
}

/// The second diagonal is taken only if its square is smaller by this factor.
/// Squares on a curved surface have diagonals that differ by rounding; without
/// this their triangles would lie this way and that.
const CLEARLY_SHORTER: f64 = 0.9999;

/// How a quad is cut into triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum QuadCut {
    /// From the first corner to the third.
    First,
    /// From the second corner to the last.
    Second,
    /// Only the triangle of this corner and the two beside it is left, of a quad that crosses itself.
    Ear(u8),
}

impl QuadCut {
    /// The triangles, as indices of corners.
    const fn triangles(self) -> &'static [[u32; 3]] {
        match self {
            Self::First => &[[0, 1, 2], [0, 2, 3]],
            Self::Second => &[[0, 1, 3], [1, 2, 3]],
            Self::Ear(0) => &[[3, 0, 1]],
            Self::Ear(1) => &[[0, 1, 2]],
            Self::Ear(2) => &[[1, 2, 3]],
            Self::Ear(_) => &[[2, 3, 0]],
        }
    }

    /// The same and, for a quad that crosses itself, the half that is turned over.
    const fn all_triangles(self) -> [[u32; 3]; 2] {
        match self {
            Self::First => [[0, 1, 2], [0, 2, 3]],
            Self::Second => [[0, 1, 3], [1, 2, 3]],
            Self::Ear(0) => [[3, 0, 1], [1, 2, 3]],
            Self::Ear(1) => [[0, 1, 2], [2, 3, 0]],
            Self::Ear(2) => [[1, 2, 3], [3, 0, 1]],
            Self::Ear(_) => [[2, 3, 0], [0, 1, 2]],
        }
    }

    /// The cut of a quad that turns left at some corners and right at the others, and whose second diagonal is clearly
    /// shorter or not. Of one that crosses itself, as many do whose vertex is dragged far, this is what the general way
    /// finds, which cuts off the first ear; what is left turns right. `None` if it turns left nowhere.
    const fn of(left: [bool; 4], is_second_shorter: bool) -> Option<Self> {
        let [at_a, at_b, at_c, at_d] = left;
        match (at_b && at_d, at_a && at_c) {
            (true, true) if is_second_shorter => Some(Self::Second),
            (true, _) => Some(Self::First),
            (false, true) => Some(Self::Second),
            _ if at_a => Some(Self::Ear(0)),
            _ if at_b => Some(Self::Ear(1)),
            _ if at_c => Some(Self::Ear(2)),
            _ if at_d => Some(Self::Ear(3)),
            _ => None,
        }
    }
}

/// Cuts a quad. `None` where three corners of one that may cross itself are in one line, or where rounding makes it
/// doubtful from which side that is seen: then the general way decides.
fn split(corners: [Vec3; 4]) -> Option<QuadCut> {
    let [a, b, c, d] = corners.map(|p| p.as_dvec3());
    let view = AxisProjection::against((c - a).cross(d - b));
    let [pa, pb, pc, pd] = [a, b, c, d].map(|p| view.project(p));
    // At a, b, c and d.
    let turns = [turn(pd, pa, pb), turn(pa, pb, pc), turn(pb, pc, pd), turn(pc, pd, pa)];
    let cut = QuadCut::of(turns.map(|turn| turn > 0), is_clearly_shorter(d - b, c - a))?;
    let is_certain = || !turns.contains(&0) && corners.iter().all(|corner| corner.is_finite());
    let is_sure = !matches!(cut, QuadCut::Ear(_)) || is_certain() && AxisProjection::of(&corners) == view;
    is_sure.then_some(cut)
}

fn is_clearly_shorter(one: DVec3, other: DVec3) -> bool {
    one.length_squared() < CLEARLY_SHORTER * other.length_squared()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::Triangulator;
    use super::*;

    /// Many coordinates are equal, so that corners lie in one line or in one place.
    fn corner() -> impl Strategy<Value = Vec3> {
        let coordinate = prop_oneof![
            4 => (-3..=3_i8).prop_map(f32::from),
            2 => -3.0_f32..3.0,
            1 => (-3..=3_i8).prop_map(|value| f32::from(value) * 1e-20),
        ];
        [coordinate.clone(), coordinate.clone(), coordinate].prop_map(Vec3::from_array)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4 * ProptestConfig::default().cases))]

        #[test]
        fn quads_that_cross_themselves_are_cut_as_the_general_way_does(
            corners in [corner(), corner(), corner(), corner()],
            is_flat: bool,
        ) {
            let corners = corners.map(|corner| if is_flat { corner.with_z(0.0) } else { corner });
            let Some(cut @ QuadCut::Ear(_)) = split(corners) else { return Ok(()) };
            let mut expected = Vec::new();
            Triangulator::default().any(&corners, &mut expected);
            prop_assert_eq!(cut.triangles(), expected);
        }
    }

    /// The directed sides of some outlines; those that run both ways cancel.
    fn border(outlines: &[Vec<u32>]) -> std::collections::BTreeMap<[u32; 2], i32> {
        let mut sides = std::collections::BTreeMap::new();
        for outline in outlines {
            for (i, &from) in outline.iter().enumerate() {
                let to = outline[(i + 1) % outline.len()];
                *sides.entry([from.min(to), from.max(to)]).or_default() += if from < to { 1 } else { -1 };
            }
        }
        sides.retain(|_, count| *count != 0);
        sides
    }

    proptest! {
        #[test]
        fn all_triangles_have_the_border_of_the_polygon_and_contain_those_that_are_drawn(
            corners in prop::collection::vec(corner(), 3..14), is_flat: bool,
        ) {
            let flat = |corner: &Vec3| if is_flat { corner.with_z(0.0) } else { *corner };
            let corners: Vec<Vec3> = corners.iter().map(flat).collect();
            let (mut triangulator, mut all) = (Triangulator::default(), Vec::new());
            triangulator.complete_polygon(&corners, &mut all);
            prop_assert_eq!(all.len(), corners.len() - 2);
            let outlines: Vec<Vec<u32>> = all.iter().map(|triangle| triangle.to_vec()).collect();
            prop_assert_eq!(border(&outlines), border(&[(0..corners.len() as u32).collect()]));
            prop_assert!(triangulate_polygon(&corners).iter().all(|triangle| all.contains(triangle)));
        }
    }

    #[test]
    fn a_bow_tie_keeps_its_first_ear() {
        let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
        let tie = [corner(0.0, 0.0), corner(3.0, 1.0), corner(3.0, 0.0), corner(0.0, 2.0)];
        for start in 0..4 {
            let mut corners = tie;
            corners.rotate_left(start);
            let cut = split(corners).expect("no three corners are in one line");
            assert_eq!(cut.triangles().len(), 1, "starting at corner {start}");
        }
    }
}
