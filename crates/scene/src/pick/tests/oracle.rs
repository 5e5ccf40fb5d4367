//! The rule of regions by rays: its own projection, each ray against every triangle, nothing
//! cut, no pixels for points. Where a rounding could decide otherwise, the answer is open.

use trigon_camera::{Camera, Projection};
use trigon_math::{DAffine3, DMat3, DVec2, DVec3};
use trigon_mesh::Mesh;

use super::super::Region;
use super::grid::Vertex;
use super::target::Target;
use crate::{NodeId, Scene, Transform};

/// What a rounding in f64 moves points by, in pixels: coordinates up to thousands of pixels,
/// rounded in their 53rd bit a few dozen times.
pub(super) const ROUNDING: f64 = 1e-9;

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
    pub(super) fn of(value: f64, margin: f64) -> Self {
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
    pub(super) size: DVec2,
    /// Pixels to a metre, at a distance of one metre in a perspective.
    pub(super) scale: f64,
    pub(super) parallel: bool,
    pub(super) near: f64,
    pub(super) far: f64,
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

    /// Where the ray through a point of the image of a perspective begins, and a vector along it.
    pub(super) fn ray(&self, at: DVec2) -> (DVec3, DVec3) {
        let [right, up, ahead] = self.axes;
        let (across, down) = (at.x - self.size.x / 2.0, at.y - self.size.y / 2.0);
        (self.eye, right * (across / self.scale) - up * (down / self.scale) + ahead)
    }

    /// Across, upwards, and along the line of sight.
    fn local(&self, world: DVec3) -> DVec3 {
        DVec3::from_array(self.axes.map(|axis| axis.dot(world - self.eye)))
    }

    /// A vertex of an object that is placed so.
    fn vertex(&self, world: &DAffine3, position: DVec3) -> Vertex {
        let magnitudes = |axis: DVec3| {
            let map = world.matrix3.transpose() * axis;
            (map * position).abs().element_sum() + axis.dot(world.translation - self.eye).abs()
        };
        let terms = DVec3::from_array(self.axes.map(magnitudes));
        Vertex { local: self.local(world.transform_point3(position)), terms }
    }

    pub(super) fn seen(&self, local: DVec3) -> Seen {
        let share = self.scale / if self.parallel { 1.0 } else { local.z };
        let at = DVec2::new(self.size.x / 2.0 + local.x * share, self.size.y / 2.0 - local.y * share);
        Seen { at, distance: local.z }
    }

    /// A thousandth of a pixel's width at this distance.
    fn touching(&self, distance: f64) -> f64 {
        1e-3 / self.scale * if self.parallel { 1.0 } else { distance }
    }

    /// Whether a distance lies between the planes, where points are moved by so many pixels.
    pub(super) fn in_range(&self, distance: f64, reach: f64) -> Answer {
        // A tenth of that in depth: 1e-10 of the distance in f64, 2e-4 in the renderer's f32.
        let margin = 0.1 * reach * distance.abs().max(1.0);
        Answer::of(distance - self.near, margin).min(Answer::of(self.far - distance, margin))
    }
}

/// Where a node is: its own map within those of the nodes that it hangs on.
pub(super) fn in_world(scene: &Scene, id: NodeId) -> DAffine3 {
    let node = scene.node(id).expect("it is there");
    let own = match node.transform {
        Transform::Affine(affine) => affine,
        Transform::Decomposed { translation, rotation, scale } => {
            let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| rotation.mul_vec3(axis * scale));
            DAffine3 { matrix3: DMat3::from_cols(columns[0], columns[1], columns[2]), translation }
        }
    };
    match node.parent() {
        None => own,
        Some(parent) => {
            let outer = in_world(scene, parent);
            let translation = outer.matrix3 * own.translation + outer.translation;
            DAffine3 { matrix3: outer.matrix3 * own.matrix3, translation }
        }
    }
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
                let world = in_world(scene, id);
                let positions = mesh.positions().iter();
                let points: Vec<Vertex> =
                    positions.map(|point| oracle.lens.vertex(&world, point.as_dvec3())).collect();
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
                oracle.targets.push(Target::new(&oracle.lens, &corners, (object, face), *double_sided));
            }
        }
        for later in 1..oracle.targets.len() {
            let (before, rest) = oracle.targets.split_at_mut(later);
            let of = |target: &Target| (target.object, target.corners.map(|corner| corner.to_array()));
            if before.iter().any(|earlier| of(earlier) == of(&rest[0])) {
                rest[0].is_repeated = true;
            }
        }
        for (object, (node, mesh, points, ..)) in objects.iter().enumerate() {
            let used = mesh.used_vertices();
            for (vertex, point) in points.iter().enumerate().filter(|&(vertex, _)| used[vertex]) {
                let own = |face: u32| mesh.face_vertices(face as usize).contains(&(vertex as u32));
                let seen = oracle.lens.seen(point.local);
                let point = oracle.own_point(seen, Yes, (object, &own));
                oracle.vertices.push(Element { node: *node, index: vertex as u32, points: vec![point] });
            }
            for (edge, ends) in mesh.edges().iter().enumerate() {
                let own = |face: u32| has_side(mesh, face, *ends);
                let line = oracle.line(ends.map(|end| points[end as usize].local));
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

/// Whether a point of the image lies in a region.
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
    inside.min(within_image(size, point))
}

fn within_image(size: DVec2, point: DVec2) -> Answer {
    Answer::of(point.min(size - point).min_element(), ROUNDING)
}
