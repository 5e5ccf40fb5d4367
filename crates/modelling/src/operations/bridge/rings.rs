//! Where the rings of a bridge are.

use trigon_math::{DMat3, DVec3, area_vector, unit_or_zero};

use super::{BridgePath, BridgeSettings};
use crate::edit_mesh::EditMesh;
use crate::operations::outlines::Chain;
use crate::operations::sweep_frame::SweepFrame;

/// An end of the path along which a bridge goes.
struct PathEnd {
    center: DVec3,
    /// The direction of the path there, of unit length.
    tangent: DVec3,
}

/// A ring of a bridge: which part of the way it is from the first end, and how both ends are moved there.
pub(super) struct BridgeRing {
    part: f64,
    size: f64,
    center: DVec3,
    /// From the first end, and from the second one.
    moves: [RingMove; 2],
}

struct RingMove {
    from: DVec3,
    rotation: DMat3,
    to: DVec3,
}

impl RingMove {
    fn of(&self, point: DVec3) -> DVec3 {
        self.to + self.rotation * (point - self.from)
    }
}

impl BridgeRing {
    /// Which part of the way it is from the first end: 0 to 1.
    pub(super) fn part(&self) -> f64 {
        self.part
    }

    /// The position between a vertex of the first end and one of the second.
    pub(super) fn position(&self, ends: [DVec3; 2]) -> DVec3 {
        let [a, b] = ends;
        let between = self.moves[0].of(a).lerp(self.moves[1].of(b), self.part);
        between + (between - self.center) * (self.size - 1.0)
    }
}

impl EditMesh {
    /// The rings between two chains.
    pub(super) fn bridge_rings(&self, chains: [&Chain; 2], settings: &BridgeSettings) -> Vec<BridgeRing> {
        let [from, to] = chains.map(|chain| self.middle_of(chain));
        let parts: Vec<f64> =
            (0..=settings.cuts + 1).map(|k| f64::from(k) / f64::from(settings.cuts + 1)).collect();
        let (centers, rotations) = match settings.interpolation {
            BridgePath::Linear => {
                let centers: Vec<DVec3> = parts.iter().map(|&part| from.lerp(to, part)).collect();
                (centers, vec![DMat3::IDENTITY; parts.len()])
            }
            BridgePath::Path => path(&self.path_ends(chains, [from, to]), settings.smoothness, &parts),
        };
        let back = rotations.last().map_or(DMat3::IDENTITY, DMat3::transpose);
        let ring = |k: usize| BridgeRing {
            part: parts[k],
            size: settings.size(parts[k]),
            center: centers[k],
            moves: [
                RingMove { from, rotation: rotations[k], to: centers[k] },
                RingMove { from: to, rotation: rotations[k] * back, to: centers[k] },
            ],
        };
        (1..=settings.cuts as usize).map(ring).collect()
    }

    fn middle_of(&self, chain: &Chain) -> DVec3 {
        chain.vertices.iter().map(|&vertex| self.point(vertex)).sum::<DVec3>() / chain.vertices.len() as f64
    }

    fn path_ends(&self, [first, second]: [&Chain; 2], [from, to]: [DVec3; 2]) -> [PathEnd; 2] {
        let way = unit_or_zero(to - from);
        // The second end is entered where a path to the first one would leave it.
        let tangents = [self.way_out(first, way), -self.way_out(second, -way)];
        let [out, into] = tangents.map(|tangent| if tangent.length_squared() == 0.0 { way } else { tangent });
        [PathEnd { center: from, tangent: out }, PathEnd { center: to, tangent: into }]
    }

    /// The direction in which a path leaves a chain towards another one; zero if there is none.
    fn way_out(&self, chain: &Chain, way: DVec3) -> DVec3 {
        if chain.is_closed { self.normal_towards(chain, way) } else { unit_or_zero(self.continuation(chain)) }
    }

    /// The normal of a loop, on the side of the other end; if both loops are side by side, on the side to which a face
    /// that fills the loop would look.
    fn normal_towards(&self, chain: &Chain, way: DVec3) -> DVec3 {
        /// A path that is steeper against the plane of a loop than that (its sine) has a side of its own.
        const STEEP: f64 = 1e-3;
        let normal = unit_or_zero(area_vector(chain.vertices.iter().map(|&vertex| self.point(vertex))));
        let towards = normal.dot(way);
        if towards.abs() > STEEP {
            return normal * towards.signum();
        }
        normal * self.winding_votes(chain.steps()).signum() as f64
    }

    /// The direction in which the faces beside a chain would continue across it.
    fn continuation(&self, chain: &Chain) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for (from, to) in chain.steps() {
            let Some(edge) = self.find_edge(from, to) else { continue };
            for corner in self.edge_corners(edge) {
                let start = self.point(self.corner_vertex(corner));
                let end = self.point(self.corner_vertex(self.next_corner(corner)));
                // The face is to the left of its side.
                sum += (end - start).cross(unit_or_zero(self.face_normal(self.corner_face(corner))));
            }
        }
        sum
    }
}

/// The points of a path at some parts of it, and the rotations from its beginning to each of them.
fn path(ends: &[PathEnd; 2], smoothness: f64, parts: &[f64]) -> (Vec<DVec3>, Vec<DMat3>) {
    let [first, last] = ends;
    let way = last.center - first.center;
    // Handles of a cubic curve that is nearly an arc of a circle, if both ends lie on one: with a bend by θ and a chord
    // c they are 4/3 tan(θ/4) times the radius c / (2 sin(θ/2)), which is 2/3 c / (1 + cos(θ/2)).
    let cos_half = (0.5 * (1.0 + first.tangent.dot(last.tangent))).max(0.0).sqrt();
    let handle = smoothness * way.length() * (2.0 / 3.0) / (1.0 + cos_half);
    let (p, q) = (first.center, last.center);
    let (a, b) = (p + first.tangent * handle, q - last.tangent * handle);
    let mut centers = Vec::with_capacity(parts.len());
    let mut rotations = Vec::with_capacity(parts.len());
    let start = SweepFrame::new(first.tangent, DVec3::ZERO);
    let mut frame = start;
    for (k, &t) in parts.iter().enumerate() {
        let s = 1.0 - t;
        let center = p * (s * s * s) + (a * (s * s * t) + b * (s * t * t)) * 3.0 + q * (t * t * t);
        let tangent = match k {
            0 => first.tangent,
            k if k + 1 == parts.len() => last.tangent,
            _ => (a - p) * (s * s) + (b - a) * (2.0 * s * t) + (q - b) * (t * t),
        };
        if let Some(&before) = centers.last() {
            frame = frame.after(center - before, tangent);
        }
        centers.push(center);
        rotations.push(frame.axes() * start.axes().transpose());
    }
    (centers, rotations)
}
