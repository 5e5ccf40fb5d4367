//! What rays see of a scene, by brute force in f64: nothing in f32, nothing
//! snapped, nothing cut; and where the rounding that the engine states may decide
//! otherwise. For perspective cameras without a far plane.

use trigon_camera::Camera;
use trigon_math::{Bounds3, DAffine3, DMat4, DVec3, DVec4};
use trigon_scene::{Node, NodeId, Scene};

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
pub(super) struct Oracle {
    facets: Vec<Facet>,
    size: [f64; 2],
    near: f64,
}

impl Oracle {
    pub(super) fn new(scene: &Scene, camera: &Camera, size: [u32; 2]) -> Self {
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
        Self { facets, size: size.map(f64::from), near: camera.projection.near() }
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
    projection: DMat4,
    /// A pixel in clip space at w = 1.
    pixel: [f64; 2],
}

impl Lens {
    fn new(camera: &Camera, [width, height]: [u32; 2]) -> Self {
        let projection = camera.projection.matrix(f64::from(width) / f64::from(height));
        Self { camera: *camera, projection, pixel: [2.0 / f64::from(width), 2.0 / f64::from(height)] }
    }

    fn facets(&self, scene: &Scene, (id, node): (NodeId, &Node), facets: &mut Vec<Facet>) {
        let Some(mesh) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)).map(|asset| asset.mesh()) else {
            return;
        };
        let world = scene.world_transform(id);
        let material = node.materials.first().and_then(|&material| scene.materials.get(material));
        let side = if world.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        let front = if material.is_none_or(|material| material.double_sided) { 0.0 } else { side };
        let (triangulation, is_closed) = (mesh.triangulation(), mesh.is_closed());
        let from = self.origin(&world, &mesh.bounds());
        for (index, triangle) in (0..).zip(&triangulation.triangles) {
            let vertices = triangle.map(|corner| mesh.corner_vertices()[corner as usize]);
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
        !(least > self.camera.projection.near()
            && inside(corner.x, wobble.x, across)
            && inside(corner.y, wobble.y, down))
    }

    /// A vertex in clip space, and how far rounding may move it: its place is a sum of
    /// terms that are at most its coordinate and twice what its mesh adds.
    fn project(&self, world: &DAffine3, place: DVec3, from: DVec3) -> (DVec3, DVec3) {
        let seen = world.matrix3 * place + (world.translation - self.camera.position);
        let clip = self.projection * (self.camera.orientation.conjugate() * seen).extend(1.0);
        let reach = lengths(world).dot((place - from).abs());
        let rows = self.projection.transpose();
        let moved = |row: DVec4, coordinate: f64| {
            STEPS * UNIT * (2.0 * row.truncate().length() * reach + coordinate.abs())
        };
        let snapped = clip.w.abs() * HALF_STEP;
        let wobble = DVec3::new(
            moved(rows.x_axis, clip.x) + snapped * self.pixel[0],
            moved(rows.y_axis, clip.y) + snapped * self.pixel[1],
            moved(rows.w_axis, clip.w),
        );
        (DVec3::new(clip.x, clip.y, clip.w), wobble * TWICE)
    }

    /// What the engine says that it counts positions from: a mesh that is more than
    /// four times as large as it is far from the eye, from the eye.
    fn origin(&self, world: &DAffine3, bounds: &Bounds3) -> DVec3 {
        let offset = world.translation - self.camera.position;
        let eye = world.matrix3.inverse() * -offset;
        let size = lengths(world).dot(bounds.min.abs().max(bounds.max.abs()));
        let distance = (world.matrix3 * eye.clamp(bounds.min, bounds.max) + offset).length();
        if eye.is_finite() && size > 4.0 * distance { eye } else { DVec3::ZERO }
    }
}

/// How long a map makes each axis.
fn lengths(world: &DAffine3) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|axis| world.matrix3.col(axis).length()))
}
