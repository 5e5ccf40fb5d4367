//! What rays see of a scene, by brute force in f64: nothing in f32, nothing
//! snapped, nothing cut; and where the rounding that the engine states may decide
//! otherwise. For perspective cameras without a far plane, and for meshes of
//! triangles.
//!
//! Of the engine it reads data alone: the numbers of nodes and cameras, positions and
//! the vertices of faces. How nodes are placed in each other, projected and joined
//! is written again here.

use std::collections::HashSet;

use trigon_camera::{Camera, Projection};
use trigon_math::{DAffine3, DMat3, DQuat, DVec3};
use trigon_mesh::Mesh;
use trigon_scene::{Node, NodeId, Scene, Transform};

use super::flight_facet::{Candidate, Facet, Ids, STEPS, TWICE, UNIT, find_rims};

/// Half a step of the sub-pixel grid, in pixels.
const HALF_STEP: f64 = 1.0 / 512.0;

/// Beyond this many pixels from the middle the guard band cuts; half of it, to be
/// sure.
const GUARD: f64 = 16384.0;

/// What a pixel must show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Seen {
    /// This triangle, or the background.
    Only(Option<Ids>),
    /// Rounding may decide, but not for the background.
    NoBackground,
    /// Rounding may decide.
    Anything,
}

/// All triangles that face a camera.
pub(crate) struct Oracle {
    facets: Vec<Facet>,
    size: [f64; 2],
    near: f64,
}

impl Oracle {
    pub(crate) fn new(scene: &Scene, camera: &Camera, size: [u32; 2]) -> Self {
        let lens = Lens::new(camera, size);
        let mut facets = Vec::new();
        for (id, node) in scene.nodes().iter() {
            let start = facets.len();
            lens.facets(scene, (id, node), &mut facets);
            find_rims(&mut facets[start..]);
        }
        let key = |facet: &Facet| (facet.corners.map(|c| c.to_array().map(f64::to_bits)), facet.ids);
        // Of triangles in the same place the first one is seen.
        facets.sort_by_key(key);
        facets.dedup_by_key(|facet| (key(facet).0, facet.front.to_bits()));
        Self { facets, size: size.map(f64::from), near: lens.near }
    }

    /// What a pixel must show at its middle.
    pub(super) fn at(&self, x: u32, y: u32) -> Seen {
        let at = |pixel: u32, size| (2.0 * f64::from(pixel) + 1.0) / size - 1.0;
        let ray = DVec3::new(at(x, self.size[0]), -at(y, self.size[1]), 1.0);
        let candidates: Vec<_> = self.facets.iter().filter_map(|facet| facet.meets(ray, self.near)).collect();
        let Some(first) = candidates
            .iter()
            .filter(|candidate| candidate.is_sure)
            .max_by(|a, b| a.depths[0].total_cmp(&b.depths[0]))
        else {
            return match candidates.as_slice() {
                [] => Seen::Only(None),
                some if some.iter().all(|candidate| candidate.facet.has_no_rim_at(ray)) => Seen::NoBackground,
                _ => Seen::Anything,
            };
        };
        let is_behind = |other: &Candidate<'_>| {
            std::ptr::eq(other.facet, first.facet) || other.depths[1] < first.depths[0]
        };
        if candidates.iter().all(is_behind) { Seen::Only(Some(first.facet.ids)) } else { Seen::NoBackground }
    }
}

/// From a mesh to clip space.
struct Lens {
    camera: Camera,
    /// What x and y are multiplied by.
    scale: [f64; 2],
    near: f64,
    /// A pixel in clip space at w = 1.
    pixel: [f64; 2],
}

impl Lens {
    fn new(camera: &Camera, [width, height]: [u32; 2]) -> Self {
        let Projection::Perspective { vertical_fov, near, far: None, .. } = camera.projection else {
            panic!("not for {:?}", camera.projection)
        };
        #[expect(
            clippy::disallowed_methods,
            reason = "of the oracle's own; its last bit is far below the bounds"
        )]
        let down = 1.0 / (vertical_fov / 2.0).tan();
        let [width, height] = [width, height].map(f64::from);
        Self {
            camera: *camera,
            scale: [down * height / width, down],
            near,
            pixel: [2.0 / width, 2.0 / height],
        }
    }

    fn facets(&self, scene: &Scene, (id, node): (NodeId, &Node), facets: &mut Vec<Facet>) {
        let Some(mesh) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)).map(|asset| asset.mesh()) else {
            return;
        };
        let world = in_world(scene, id);
        let material = node.materials.first().and_then(|&material| scene.materials.get(material));
        let [x, y, z] = [0, 1, 2].map(|axis| world.matrix3.col(axis));
        let side = if x.cross(y).dot(z) < 0.0 { -1.0 } else { 1.0 };
        let front = if material.is_none_or(|material| material.double_sided) { 0.0 } else { side };
        let triangles = triangles(mesh);
        let is_closed = is_closed(&triangles);
        let from = self.origin(&world, mesh);
        for (index, vertices) in (0..).zip(&triangles) {
            let seen = vertices.map(|vertex| {
                let place = mesh.positions()[vertex as usize].as_dvec3();
                self.project(&world, place, from)
            });
            let is_cut = seen.iter().any(|vertex| self.may_cut(vertex));
            facets.push(Facet::new((id.index() as u32, index), seen, (front, is_closed, is_cut)));
        }
    }

    /// Whether a vertex may lie before the near plane or beyond the guard band.
    fn may_cut(&self, (corner, wobble): &(DVec3, DVec3)) -> bool {
        let least = corner.z - wobble.z;
        let inside = |x: f64, wobble: f64, pixel: f64| x.abs() + wobble < GUARD * pixel * least;
        let [across, down] = self.pixel;
        !(least > self.near && inside(corner.x, wobble.x, across) && inside(corner.y, wobble.y, down))
    }

    /// A vertex in clip space, and how far rounding may move it: its place is a sum of
    /// terms that are at most its coordinate and twice what its mesh adds.
    fn project(&self, world: &DAffine3, place: DVec3, from: DVec3) -> (DVec3, DVec3) {
        let seen = world.matrix3 * place + (world.translation - self.camera.position);
        let [right, up, back] = axes(self.camera.orientation).map(|axis| axis.dot(seen));
        let [across, down] = self.scale;
        let clip = DVec3::new(right * across, up * down, -back);
        let reach = lengths(world).dot((place - from).abs());
        let moved = |row: f64, coordinate: f64| STEPS * UNIT * (2.0 * row * reach + coordinate.abs());
        let snapped = clip.z.abs() * HALF_STEP;
        let wobble = DVec3::new(
            moved(across, clip.x) + snapped * self.pixel[0],
            moved(down, clip.y) + snapped * self.pixel[1],
            moved(1.0, clip.z),
        );
        (clip, wobble * TWICE)
    }

    /// What the engine says that it counts positions from: a mesh that is more than
    /// four times as large as it is far from the eye, from the eye.
    fn origin(&self, world: &DAffine3, mesh: &Mesh) -> DVec3 {
        let offset = world.translation - self.camera.position;
        let eye = world.matrix3.inverse() * -offset;
        let places = || mesh.positions().iter().map(|position| position.as_dvec3());
        let [min, max] = [
            places().fold(DVec3::INFINITY, |least, place| least.min(place)),
            places().fold(DVec3::NEG_INFINITY, |most, place| most.max(place)),
        ];
        let size = lengths(world).dot(min.abs().max(max.abs()));
        let distance = (world.matrix3 * eye.clamp(min, max) + offset).length();
        if eye.is_finite() && size > 4.0 * distance { eye } else { DVec3::ZERO }
    }
}

/// Where a node is: its own map within those of the nodes that it hangs on.
fn in_world(scene: &Scene, id: NodeId) -> DAffine3 {
    let node = scene.node(id).expect("it is there");
    let own = own_map(&node.transform);
    let Some(parent) = node.parent() else { return own };
    let outer = in_world(scene, parent);
    DAffine3 {
        matrix3: outer.matrix3 * own.matrix3,
        translation: outer.matrix3 * own.translation + outer.translation,
    }
}

/// The map of a node's own numbers.
pub(crate) fn own_map(transform: &Transform) -> DAffine3 {
    match *transform {
        Transform::Affine(affine) => affine,
        Transform::Decomposed { translation, rotation, scale } => {
            let [x, y, z] = axes(rotation);
            DAffine3 { matrix3: DMat3::from_cols(x * scale.x, y * scale.y, z * scale.z), translation }
        }
    }
}

/// Where a unit quaternion turns the three axes.
fn axes(rotation: DQuat) -> [DVec3; 3] {
    let DQuat { x, y, z, w } = rotation;
    [
        DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)),
        DVec3::new(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)),
        DVec3::new(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)),
    ]
}

/// The vertices of a mesh's faces, which have three each.
fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    let vertices = |face| <[u32; 3]>::try_from(mesh.face_vertices(face)).expect("a triangle");
    (0..mesh.face_count()).map(vertices).collect()
}

/// Whether each side of a triangle is that of exactly one other one, the other way round.
fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let sides = || triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let all: HashSet<(u32, u32)> = sides().collect();
    all.len() == sides().count() && sides().all(|(from, to)| all.contains(&(to, from)))
}

/// How long a map makes each axis.
fn lengths(world: &DAffine3) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| world.matrix3.col(axis).length()))
}
