//! The rule of regions by rays: its own projection, each ray against every triangle, nothing
//! cut, no pixels for points. Where a rounding could decide otherwise, the answer is open.
//!
//! A ray through the screen at (x, y) meets a triangle where three volumes have one sign: each
//! is spanned by the ray and two corners, and is linear in x and y. So what holds in a
//! little square around a point, too, is told by the value in its middle and the slopes.

use trigon_camera::{Camera, Projection};
use trigon_math::{DVec2, DVec3};
use trigon_mesh::Mesh;

use super::super::Region;
use crate::{NodeId, Scene};

/// What a rounding in f64 moves points by, in pixels: coordinates up to thousands of pixels,
/// rounded in their 53rd bit a few dozen times.
pub(super) const ROUNDING: f64 = 1e-9;

/// What the renderer moves vertices by: half a step of 1/256 pixel, and the rounding of their
/// coordinates to f32 before.
pub(super) const SNAPPING: f64 = 0.5 / 256.0 + 1e-4;

/// How much nearer one of two depths in f32 has to be for certain, as a share of the distance.
const DEPTHS: f64 = 1e-5;

/// Whether something is so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Answer {
    No,
    /// It depends on roundings.
    Open,
    Yes,
}

use Answer::{No, Open, Yes};

impl Answer {
    fn not(self) -> Self {
        [Yes, Open, No][self as usize]
    }

    /// Of a number: whether it is above 0, for sure where it is beyond a margin.
    fn of(value: f64, margin: f64) -> Self {
        if value > margin {
            Yes
        } else if value < -margin {
            No
        } else {
            Open
        }
    }
}

/// A camera by its axes.
pub(super) struct Lens {
    eye: DVec3,
    axes: [DVec3; 3],
    size: DVec2,
    /// Pixels to a metre, at a distance of one metre in a perspective.
    scale: f64,
    parallel: bool,
    near: f64,
    far: f64,
}

/// A point on the screen, and how far from the eye's plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    pub(super) at: DVec2,
    pub(super) distance: f64,
}

impl Lens {
    pub(super) fn new(camera: &Camera, size: DVec2) -> Self {
        let turned = |axis: DVec3| camera.orientation.mul_vec3(axis);
        let (half, near, far, parallel) = match camera.projection {
            Projection::Perspective { vertical_fov, near, far, .. } => {
                (trigon_math::elementary::tan(vertical_fov / 2.0), near, far.unwrap_or(f64::INFINITY), false)
            }
            Projection::Orthographic { height, near, far, .. } => (height / 2.0, near, far, true),
            _ => unreachable!("these tests make no others"),
        };
        let axes = [turned(DVec3::X), turned(DVec3::Y), turned(DVec3::NEG_Z)];
        Self { eye: camera.position, axes, size, scale: size.y / 2.0 / half, parallel, near, far }
    }

    /// Across, upwards, and along the line of sight.
    fn local(&self, world: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(world - self.eye)))
    }

    fn seen(&self, local: DVec3) -> Seen {
        let share = self.scale / if self.parallel { 1.0 } else { local.z };
        let at = DVec2::new(self.size.x / 2.0 + local.x * share, self.size.y / 2.0 - local.y * share);
        Seen { at, distance: local.z }
    }

    /// A thousandth of a pixel's width at this distance.
    fn touching(&self, distance: f64) -> f64 {
        1e-3 / self.scale * if self.parallel { 1.0 } else { distance }
    }

    /// Whether a distance lies between the planes, where points are moved by so many pixels.
    fn in_range(&self, distance: f64, reach: f64) -> Answer {
        // A tenth of that in depth: 1e-10 of the distance in f64, 2e-4 in the renderer's f32.
        let margin = 0.1 * reach * distance.abs().max(1.0);
        Answer::of(distance - self.near, margin).min(Answer::of(self.far - distance, margin))
    }
}

/// A triangle as rays meet it.
pub(super) struct Target {
    pub(super) object: usize,
    pub(super) face: u32,
    /// Whether it is drawn as seen from here.
    drawn: Answer,
    /// The same for the renderer, which may turn a sliver over by moving its corners, and
    /// draws only the first of two equal triangles.
    snapped: Answer,
    corners: [DVec3; 3],
    is_front: bool,
    /// For each corner the volume opposite to it, as (by x, by y, constant); positive within
    /// the triangle.
    volumes: [DVec3; 3],
    /// The volume that the triangle spans with the eye, or its corners' distances.
    span: Span,
}

enum Span {
    /// Distance is this by the sum of the volumes.
    Eye(f64),
    /// Distance is the mean of these by the volumes.
    Corners([f64; 3]),
}

impl Target {
    fn new(lens: &Lens, corners: [DVec3; 3], (object, face): (usize, u32), double_sided: bool) -> Self {
        // As rays see them: in a parallel projection all at one distance.
        let [a, b, c] =
            corners.map(|corner| if lens.parallel { corner.truncate().extend(1.0) } else { corner });
        let volume = a.dot(b.cross(c));
        let size = (b - a).length() * (c - a).length() * a.length().max(1.0);
        // Across, upwards and forwards are left-handed axes: the volumes of fronts are positive.
        let faces = Answer::of(volume, 1e-12 * size);
        let drawn = if double_sided { Answer::of(volume.abs(), 1e-12 * size).max(Open) } else { faces };
        // The ray through (x, y): across (x - w/2)/scale, upwards (h/2 - y)/scale, forwards 1.
        let linear = |normal: DVec3| {
            let (x, y) = (normal.x / lens.scale, -normal.y / lens.scale);
            DVec3::new(x, y, normal.z - x * lens.size.x / 2.0 - y * lens.size.y / 2.0) * volume.signum()
        };
        let span = if lens.parallel {
            Span::Corners(corners.map(|corner| corner.z))
        } else {
            Span::Eye(volume.abs())
        };
        let snapped = if is_sliver(lens, corners) { Open } else { drawn };
        let is_front = volume > 0.0;
        Self {
            object,
            face,
            drawn,
            snapped,
            corners,
            is_front,
            volumes: [b.cross(c), c.cross(a), a.cross(b)].map(linear),
            span,
        }
    }

    /// Whether the ray meets it beyond the near and before the far plane, wherever in a square
    /// of twice this side it is, and between which distances.
    pub(super) fn meets(&self, lens: &Lens, at: DVec2, reach: f64) -> (Answer, [f64; 2]) {
        let value = |volume: DVec3| volume.x * at.x + volume.y * at.y + volume.z;
        let slope = |volume: DVec3| reach * (volume.x.abs() + volume.y.abs());
        let covered = self.volumes.map(|volume| self.covered(volume, at, reach));
        let covered = covered.into_iter().min().expect("three");
        if covered == No {
            return (No, [0.0; 2]);
        }
        let sum = self.volumes.iter().sum::<DVec3>();
        let distances = match self.span {
            Span::Eye(volume) => {
                let (sum, slope) = (value(sum), slope(sum));
                [volume / (sum + slope), if sum > slope { volume / (sum - slope) } else { f64::INFINITY }]
            }
            Span::Corners(corners) => {
                // The distance is linear, too.
                let weighted: DVec3 =
                    self.volumes.iter().zip(corners).map(|(&volume, corner)| volume * corner).sum();
                let (middle, change) = (value(weighted) / value(sum), slope(weighted) / value(sum));
                [middle - change, middle + change]
            }
        };
        let range = distances.map(|distance| lens.in_range(distance, reach));
        let in_range = match range {
            [Yes, Yes] => Yes,
            [No, No] if (distances[0] < lens.near) == (distances[1] < lens.near) => No,
            _ => Open,
        };
        (covered.min(in_range), distances)
    }
}

/// Whether the renderer's steps may turn a triangle over that lies before the eye.
fn is_sliver(lens: &Lens, corners: [DVec3; 3]) -> bool {
    if corners.iter().any(|corner| corner.z < lens.near) {
        return false;
    }
    let [a, b, c] = corners.map(|corner| lens.seen(corner).at);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).perp_dot(c - a).abs() <= 4.0 * SNAPPING * longest
}

/// A point of a vertex or an edge, whether it is where it seems to be, and whether no other
/// face hides it.
pub(super) struct OwnPoint {
    pub(super) seen: Seen,
    pub(super) exists: Answer,
    pub(super) visible: Answer,
}

/// An element, by the index of its object.
pub(super) struct Element {
    pub(super) node: NodeId,
    pub(super) index: u32,
    pub(super) points: Vec<OwnPoint>,
}

/// All that may be asked of a scene.
pub(super) struct Oracle {
    pub(super) lens: Lens,
    pub(super) nodes: Vec<NodeId>,
    pub(super) face_counts: Vec<usize>,
    pub(super) targets: Vec<Target>,
    pub(super) vertices: Vec<Element>,
    pub(super) edges: Vec<Element>,
}

impl Oracle {
    pub(super) fn new(scene: &Scene, camera: &Camera, size: DVec2) -> Self {
        let lens = Lens::new(camera, size);
        let (vertices, edges) = (Vec::new(), Vec::new());
        let mut oracle =
            Self { lens, nodes: Vec::new(), face_counts: Vec::new(), targets: Vec::new(), vertices, edges };
        let objects: Vec<_> = scene
            .nodes()
            .iter()
            .map(|(id, node)| {
                let mesh = scene.meshes().get(node.mesh.expect("an object")).expect("its mesh").mesh();
                let material = scene.materials.get(node.materials[0]).expect("its material");
                let world = scene.world_transform(id);
                let points: Vec<DVec3> = mesh
                    .positions()
                    .iter()
                    .map(|point| oracle.lens.local(world.transform_point3(point.as_dvec3())))
                    .collect();
                let mirrored = world.matrix3.determinant() < 0.0;
                (id, mesh, points, material.double_sided, mirrored)
            })
            .collect();
        for (object, (id, mesh, points, double_sided, mirrored)) in objects.iter().enumerate() {
            oracle.nodes.push(*id);
            oracle.face_counts.push(mesh.face_count());
            let triangulation = mesh.triangulation();
            for (triangle, &face) in triangulation.triangles.iter().zip(&triangulation.triangle_faces) {
                let mut corners =
                    triangle.map(|corner| points[mesh.corner_vertices()[corner as usize] as usize]);
                if *mirrored {
                    corners.swap(1, 2);
                }
                oracle.targets.push(Target::new(&oracle.lens, corners, (object, face), *double_sided));
            }
        }
        for later in 1..oracle.targets.len() {
            let (before, rest) = oracle.targets.split_at_mut(later);
            let of = |target: &Target| (target.object, target.corners.map(|corner| corner.to_array()));
            if before.iter().any(|earlier| of(earlier) == of(&rest[0])) {
                rest[0].snapped = No;
            }
        }
        for (object, (node, mesh, points, ..)) in objects.iter().enumerate() {
            let used = mesh.used_vertices();
            for (vertex, &local) in points.iter().enumerate().filter(|&(vertex, _)| used[vertex]) {
                let own = |face: u32| mesh.face_vertices(face as usize).contains(&(vertex as u32));
                let seen = oracle.lens.seen(local);
                let point = oracle.own_point(seen, Yes, (object, &own));
                oracle.vertices.push(Element { node: *node, index: vertex as u32, points: vec![point] });
            }
            for (edge, ends) in mesh.edges().iter().enumerate() {
                let own = |face: u32| has_side(mesh, face, *ends);
                let line = oracle.line(ends.map(|end| points[end as usize]));
                let points =
                    line.into_iter().map(|(seen, exists)| oracle.own_point(seen, exists, (object, &own)));
                let points = points.collect();
                oracle.edges.push(Element { node: *node, index: edge as u32, points });
            }
        }
        oracle
    }

    fn own_point(
        &self,
        seen: Seen,
        exists: Answer,
        (object, own): (usize, &dyn Fn(u32) -> bool),
    ) -> OwnPoint {
        let exists = exists.min(self.lens.in_range(seen.distance, ROUNDING));
        let others = self.targets.iter().filter(|target| target.object != object || !own(target.face));
        let hidden = others.map(|target| {
            let (met, [near, far]) = target.meets(&self.lens, seen.at, ROUNDING);
            let nearer = |distance: f64| {
                let touching = self.lens.touching(seen.distance);
                Answer::of(seen.distance - touching - distance, 1e-3 * touching)
            };
            // Yes where the farthest is near enough, no where the nearest is not.
            let nearer = match (nearer(far), nearer(near)) {
                (Yes, _) => Yes,
                (_, No) => No,
                _ => Open,
            };
            met.min(target.drawn).min(nearer)
        });
        let visible = hidden.max().unwrap_or(No).not();
        OwnPoint { seen, exists, visible }
    }

    /// The own points of an edge.
    fn line(&self, [mut from, mut to]: [DVec3; 2]) -> Vec<(Seen, Answer)> {
        let lens = &self.lens;
        if from.z < lens.near && to.z < lens.near {
            return Vec::new();
        }
        let cut = |behind: DVec3, before: DVec3| {
            behind + (before - behind) * ((lens.near - behind.z) / (before.z - behind.z))
        };
        if from.z < lens.near {
            from = cut(from, to);
        } else if to.z < lens.near {
            to = cut(to, from);
        }
        let [start, end] = [from, to].map(|end| lens.seen(end));
        let way = end.at - start.at;
        let axis = usize::from(way.x.abs() < way.y.abs());
        // Which axis it is, and whether the ends lie on a middle, may be a rounding.
        let mut exists = if (way.x.abs() - way.y.abs()).abs() < ROUNDING { Open } else { Yes };
        let between = |share: f64| {
            let at = start.at + way * share;
            let distance = if lens.parallel {
                start.distance + (end.distance - start.distance) * share
            } else {
                1.0 / (1.0 / start.distance + (1.0 / end.distance - 1.0 / start.distance) * share)
            };
            Seen { at, distance }
        };
        let (low, high) = (start.at[axis].min(end.at[axis]), start.at[axis].max(end.at[axis]));
        for end in [low, high] {
            if (end - 0.5 - (end - 0.5).round()).abs() < ROUNDING {
                exists = Open;
            }
        }
        let middles = ((low - 0.5).ceil().max(-2.0) as i64..=(high - 0.5).floor().min(1e4) as i64)
            .map(|pixel| between((pixel as f64 + 0.5 - start.at[axis]) / way[axis]));
        let mut points: Vec<_> = middles.map(|seen| (seen, exists)).collect();
        if (low - 0.5).ceil() > (high - 0.5).floor() {
            points.push((between(0.5), exists));
        }
        points
    }
}

/// Whether a face has a side between two vertices.
fn has_side(mesh: &Mesh, face: u32, ends: [u32; 2]) -> bool {
    let around = mesh.face_vertices(face as usize);
    (0..around.len()).any(|i| {
        let side = [around[i], around[(i + 1) % around.len()]];
        side == ends || [side[1], side[0]] == ends
    })
}

/// Whether a point of the picture lies in a region.
pub(super) fn contains(region: &Region, size: DVec2, point: DVec2) -> Answer {
    let within = |low: DVec2, high: DVec2| {
        let inside = (point - low).min(high - point).min_element();
        Answer::of(inside, ROUNDING)
    };
    let inside = match region {
        Region::Point(target) => within(target.floor(), target.floor() + 1.0),
        Region::Rectangle { min, max } => within(*min, *max),
        Region::Circle { center, radius } => Answer::of(radius - point.distance(*center), ROUNDING),
        Region::Lasso(corners) => {
            let sides = || (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]);
            let beside = |[from, to]: [DVec2; 2]| {
                let share = ((point - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
                point.distance(from + (to - from) * share)
            };
            let angle = |[from, to]: [DVec2; 2]| {
                let (a, b) = (from - point, to - point);
                trigon_math::elementary::atan2(a.perp_dot(b), a.dot(b))
            };
            // How often it goes round the point.
            let turns = (sides().map(angle).sum::<f64>() / std::f64::consts::TAU).round() as i64;
            if sides().map(beside).fold(f64::INFINITY, f64::min) < ROUNDING {
                Open
            } else if turns % 2 == 0 {
                No
            } else {
                Yes
            }
        }
    };
    inside.min(within_picture(size, point))
}

fn within_picture(size: DVec2, point: DVec2) -> Answer {
    Answer::of(point.min(size - point).min_element(), ROUNDING)
}

impl Target {
    /// Its side, counter-clockwise on the screen, if nothing but that leaves open whether the
    /// renderer finds it at a pixel's centre: then a triangle on the other side of it is there
    /// if this one is not, since both have the same corners after those were moved.
    pub(super) fn open_side(&self, lens: &Lens, at: DVec2) -> Option<[DVec3; 2]> {
        let covered = self.volumes.map(|volume| self.covered(volume, at, SNAPPING));
        let (met, distances) = self.meets(lens, at, SNAPPING);
        let in_range = distances.iter().all(|&distance| lens.in_range(distance, SNAPPING) == Yes);
        let open = covered.iter().position(|&answer| answer == Open)?;
        let alone = covered.iter().filter(|&&answer| answer == Open).count() == 1;
        if met == No || self.snapped != Yes || !in_range || !alone {
            return None;
        }
        let [from, to] = [self.corners[(open + 1) % 3], self.corners[(open + 2) % 3]];
        Some(if self.is_front { [from, to] } else { [to, from] })
    }

    /// Whether the ray passes a side of it on the inside.
    fn covered(&self, volume: DVec3, at: DVec2, reach: f64) -> Answer {
        let value = volume.x * at.x + volume.y * at.y + volume.z;
        Answer::of(value, reach * (volume.x.abs() + volume.y.abs()))
    }

    /// How it is met at a pixel's centre after the renderer has moved its vertices, and
    /// whether it is drawn; `None` where it is nowhere near.
    pub(super) fn snapped(&self, lens: &Lens, at: DVec2) -> Option<(Answer, [f64; 2])> {
        let (met, [near, far]) = self.meets(lens, at, SNAPPING);
        let depths = [near - DEPTHS * near.abs(), far + DEPTHS * far.abs()];
        (met != No).then_some((met.min(self.snapped), depths))
    }
}
