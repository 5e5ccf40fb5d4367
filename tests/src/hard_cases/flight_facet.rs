//! A triangle as rays in f64 meet it, with how far rounding may move its corners.

use trigon_math::{DVec2, DVec3};

/// Everything that may move a corner is taken twice: what cutting rounds is less
/// than snapping moves, and a sample that is clear of an edge by twice what may
/// move it lies in a triangle that snapping cannot turn over.
pub(super) const TWICE: f64 = 2.0;

/// Half of the unit in the last place of f32, relative.
pub(super) const UNIT: f64 = 1.0 / 16_777_216.0;

/// Roundings of a coordinate in clip space: a matrix entry's, that of the position
/// to the anchor, a product's, three sums'. One more for those in f64 before.
pub(super) const STEPS: f64 = 7.0;

/// How depths are rounded, relative: z, w and their quotient, each corner's and the
/// sample's; twice, as all else.
const DEPTH: f64 = TWICE * (2.0 * STEPS + 4.0) * UNIT;

/// Which triangle a pixel shows: its node and its index in the triangulation.
pub(super) type Ids = (u32, u32);

/// A triangle in clip space without depth: x, y and w.
pub(super) struct Facet {
    pub(super) ids: Ids,
    pub(super) corners: [DVec3; 3],
    /// How far each corner may be from where it should be.
    wobble: [DVec3; 3],
    /// Products of the corners opposite to each.
    shares: [DVec3; 3],
    volume: f64,
    /// 1 if the front runs counter-clockwise on the screen, -1 in a mirror, 0 if both
    /// sides are seen.
    pub(super) front: f64,
    is_closed: bool,
    /// Whether the near plane or the guard band may cut it.
    is_cut: bool,
    /// The box around what is seen of it; unbounded if it is cut.
    bounds: [DVec2; 2],
    /// Edges opposite to each corner beyond which the mesh may turn away.
    rims: [bool; 3],
}

/// A triangle that a ray may meet.
pub(super) struct Candidate<'o> {
    pub(super) facet: &'o Facet,
    /// Whether it surely meets it.
    pub(super) is_sure: bool,
    /// The least and the greatest depth.
    pub(super) depths: [f64; 2],
}

impl Facet {
    pub(super) fn new(
        ids: Ids,
        seen: [(DVec3, DVec3); 3],
        (front, is_closed, is_cut): (f64, bool, bool),
    ) -> Self {
        let corners @ [a, b, c] = seen.map(|(corner, _)| corner);
        let wobble = seen.map(|(_, wobble)| wobble);
        let shares = [b.cross(c), c.cross(a), a.cross(b)];
        let volume = a.dot(shares[0]);
        let everything = [DVec2::NEG_INFINITY, DVec2::INFINITY];
        let bounds = if is_cut { everything } else { bounds(&seen) };
        Self { ids, corners, wobble, shares, volume, front, is_closed, is_cut, bounds, rims: [false; 3] }
    }

    /// How far the edge function opposite to a corner may be off at a ray.
    fn slack(&self, corner: usize, ray: DVec3) -> f64 {
        let [next, last] = [(corner + 1) % 3, (corner + 2) % 3];
        let (b, c, db, dc) = (self.corners[next], self.corners[last], self.wobble[next], self.wobble[last]);
        let both =
            DVec3::new(db.y * dc.z + db.z * dc.y, db.z * dc.x + db.x * dc.z, db.x * dc.y + db.y * dc.x);
        db.dot(c.cross(ray).abs()) + dc.dot(ray.cross(b).abs()) + both.dot(ray.abs())
    }

    /// Whether the facet surely shows its front (1) or its back (-1).
    fn facing(&self) -> f64 {
        let doubt: f64 = (0..3).map(|corner| self.wobble[corner].dot(self.shares[corner].abs())).sum();
        let side = if self.front == 0.0 { 1.0 } else { self.front };
        // What two or three corners do together is less than what each does alone.
        if self.volume.abs() > TWICE * doubt { side * self.volume.signum() } else { 0.0 }
    }

    pub(super) fn meets(&self, ray: DVec3, near: f64) -> Option<Candidate<'_>> {
        let [least, most] = self.bounds;
        if ray.truncate().cmplt(least).any() || ray.truncate().cmpgt(most).any() {
            return None;
        }
        match self.front {
            0.0 => self.side_meets(1.0, ray, near).or_else(|| self.side_meets(-1.0, ray, near)),
            side => self.side_meets(side, ray, near),
        }
    }

    fn side_meets(&self, side: f64, ray: DVec3, near: f64) -> Option<Candidate<'_>> {
        let mut is_sure = true;
        let mut sum = 0.0;
        for corner in 0..3 {
            let edge = side * self.shares[corner].dot(ray);
            let slack = self.slack(corner, ray);
            if edge < -slack {
                return None;
            }
            is_sure &= edge > slack;
            sum += edge;
        }
        let [nearest, farthest] = self.depths(near)?;
        let distance = side * self.volume / sum;
        let error = self.depth_error();
        if is_sure && error < 0.5 && distance > 0.0 {
            let [low, high] = [1.0 - error - DEPTH, 1.0 + error + DEPTH];
            if !self.is_cut {
                let depth = near / distance;
                let plane = self.plane_error(near);
                return Some(Candidate {
                    facet: self,
                    is_sure,
                    depths: [depth * low - plane, depth * high + plane],
                });
            }
            if distance * high < near {
                return None;
            }
            is_sure = distance * low > near;
        } else {
            is_sure = false;
        }
        Some(Candidate { facet: self, is_sure, depths: [farthest, nearest] })
    }

    /// The depth of the nearest and of the farthest corner; none behind the near plane.
    fn depths(&self, near: f64) -> Option<[f64; 2]> {
        let reach = |sign: f64| (0..3).map(move |i| self.corners[i].z + sign * self.wobble[i].z);
        let nearest = reach(-1.0).fold(f64::INFINITY, f64::min).max(near);
        let farthest = reach(1.0).fold(f64::NEG_INFINITY, f64::max);
        (farthest * (1.0 + DEPTH) > near)
            .then(|| [near / nearest * (1.0 + DEPTH), near / farthest * (1.0 - DEPTH)])
    }

    /// How far the distance at which a ray meets the facet may be off, relative: if
    /// the corners move, the facet's point at the ray moves by a mean of that.
    fn depth_error(&self) -> f64 {
        let normal = (self.shares[0] + self.shares[1] + self.shares[2]).abs();
        self.wobble.iter().map(|wobble| normal.dot(*wobble) / self.volume.abs()).fold(0.0, f64::max)
    }

    /// What the plane of depths adds, by its documentation: 9/8 · 2⁻⁵⁰ · Δz · XY/A,
    /// and two roundings of f64. Snapping leaves a quarter of the area where a sample
    /// is clear of all edges.
    fn plane_error(&self, near: f64) -> f64 {
        const ROUNDING: f64 = 1.0 / (1_u64 << 50) as f64;
        let [a, b, c] = self.corners.map(|corner| corner.truncate() / corner.z);
        let extent = a.max(b).max(c) - a.min(b).min(c);
        let area = (b - a).perp_dot(c - a).abs() / 2.0;
        let depths = self.corners.map(|corner| near / corner.z);
        let range = depths.iter().fold(0.0_f64, |high, &z| high.max(z))
            - depths.iter().fold(1.0_f64, |low, &z| low.min(z));
        1.125 * ROUNDING * range * 4.0 * extent.x * extent.y / area + ROUNDING
    }

    /// Whether no edge that the ray may pass on either side of is a rim of its mesh.
    pub(super) fn has_no_rim_at(&self, ray: DVec3) -> bool {
        let is_rim = |corner: usize| {
            self.rims[corner] && self.shares[corner].dot(ray).abs() <= self.slack(corner, ray)
        };
        self.is_closed && !self.is_cut && !(0..3).any(is_rim)
    }
}

/// The box around corners before the eye: needles that are seen along their plane
/// would be met anywhere on their line.
fn bounds(seen: &[(DVec3, DVec3); 3]) -> [DVec2; 2] {
    let on_screen = |(corner, wobble): (DVec3, DVec3), side: f64| {
        let place = corner.truncate() / corner.z;
        place + (wobble.truncate() + place.abs() * wobble.z) * side / (corner.z - wobble.z)
    };
    let [low, high] = [-1.0, 1.0].map(|side| seen.map(|vertex| on_screen(vertex, side)));
    [low[0].min(low[1]).min(low[2]), high[0].max(high[1]).max(high[2])]
}

/// Finds the edges of a closed mesh beyond which it may turn away.
pub(super) fn find_rims(facets: &mut [Facet]) {
    let key = |corner: DVec3| corner.to_array().map(f64::to_bits);
    let mut facing = std::collections::HashMap::new();
    for facet in &*facets {
        for corner in 0..3 {
            let [from, to] = [facet.corners[(corner + 1) % 3], facet.corners[(corner + 2) % 3]];
            facing.insert((key(from), key(to)), facet.facing());
        }
    }
    for facet in facets.iter_mut() {
        for corner in 0..3 {
            let [from, to] = [facet.corners[(corner + 1) % 3], facet.corners[(corner + 2) % 3]];
            let beyond = facing.get(&(key(to), key(from))).copied();
            facet.rims[corner] = beyond.is_none_or(|beyond| match facet.front {
                // Seen from both sides it turns away where it turns over.
                0.0 => beyond == 0.0 || beyond != facet.facing(),
                // One that is nearly edge-on may be turned over by snapping.
                _ => beyond <= 0.0,
            });
        }
    }
}
