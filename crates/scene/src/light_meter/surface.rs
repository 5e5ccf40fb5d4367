//! Where light is measured: points on the faces of a model, in a fixed order, and the light of the scene's lamps that
//! arrives there: in f64, by the formulas of [`Light`](crate::Light).

use std::borrow::Cow;

use trigon_math::{DAffine3, DVec3};

use crate::light::{Light, LightKind};
use crate::node::NodeId;
use crate::scene::{PlacedMesh, Scene};

/// Of a scene with more objects than this, as many are measured, spread evenly over the list of nodes.
const MOST_OBJECTS: usize = 512;

/// Points in all, if there are fewer objects.
const POINTS: usize = 512;

/// Points on an object, at most.
const MOST_POINTS: usize = 128;

/// The light on a part of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LitPart {
    /// The value of a white matt surface there.
    pub(super) white: f64,
    /// The part's fraction of the model; all together are 1.
    pub(super) share: f64,
}

/// The light on all parts of a scene's model; none without lamps or faces.
pub(super) fn lit_parts(scene: &Scene) -> Vec<LitPart> {
    let scene = &*at_the_beginning(scene);
    let transforms = scene.visible_transforms();
    let Some(lamps) = Lamps::of(scene, &transforms) else { return Vec::new() };
    let objects = with_faces(scene, &transforms);
    let points = (POINTS / objects.len().max(1)).clamp(1, MOST_POINTS);
    let mut parts = Vec::new();
    for index in spread(objects.len(), MOST_OBJECTS) {
        let (id, world) = objects[index];
        let Some(mesh) = scene.placed_mesh(id, world) else { continue };
        add_parts(&mesh, points, &lamps, &mut parts);
    }
    let sum = parts.iter().map(|part| part.share).sum::<f64>();
    parts.iter_mut().for_each(|part| part.share /= sum);
    parts
}

/// The scene as its animations begin.
fn at_the_beginning(scene: &Scene) -> Cow<'_, Scene> {
    if scene.animations.is_empty() {
        return Cow::Borrowed(scene);
    }
    let mut begun = scene.clone();
    for animation in &scene.animations {
        let pose = begun.pose(animation, 0.0);
        begun.apply_pose(&pose);
    }
    Cow::Owned(begun)
}

/// The visible nodes whose meshes have faces.
fn with_faces(scene: &Scene, transforms: &[Option<DAffine3>]) -> Vec<(NodeId, DAffine3)> {
    let has_faces = |mesh| scene.meshes().get(mesh).is_some_and(|asset| asset.mesh().face_count() > 0);
    let nodes = scene.nodes().iter().filter(|(_, node)| node.mesh.is_some_and(has_faces));
    nodes.filter_map(|(id, _)| Some((id, transforms[id.index()]?))).collect()
}

/// Adds the parts of an object, which together have a share of 1.
fn add_parts(mesh: &PlacedMesh<'_>, points: usize, lamps: &Lamps, parts: &mut Vec<LitPart>) {
    let (faces, first) = (mesh.mesh().face_count(), parts.len());
    let on_each = (points / faces).max(1);
    for face in spread(faces, points) {
        let face = Face::new(mesh, face);
        for number in 0..on_each {
            let Some((position, normal)) = face.point(number, on_each) else { break };
            parts.push(LitPart { white: lamps.white(position, normal), share: face.area / on_each as f64 });
        }
    }
    let area = parts[first..].iter().map(|part| part.share).sum::<f64>();
    parts[first..].iter_mut().for_each(|part| part.share /= area);
}

/// As many numbers below `count` as there are, or `most` that are spread evenly.
fn spread(count: usize, most: usize) -> impl Iterator<Item = usize> {
    (0..count.min(most))
        .map(move |index| if count <= most { index } else { (2 * index + 1) * count / (2 * most) })
}

/// A face of a placed mesh as a fan of triangles around its first corner.
struct Face {
    corners: Vec<DVec3>,
    /// Of the fan up to and with each of its triangles.
    areas: Vec<f64>,
    area: f64,
}

impl Face {
    fn new(mesh: &PlacedMesh<'_>, face: usize) -> Self {
        let vertices = mesh.mesh().face_vertices(face);
        let corners: Vec<DVec3> = vertices.iter().map(|&vertex| mesh.position(vertex)).collect();
        let mut area = 0.0;
        let areas = corners[1..].windows(2).map(|pair| {
            area += cross(corners[0], pair).length() * 0.5;
            area
        });
        let areas = areas.collect();
        Self { corners, areas, area }
    }

    /// One of several points that are spread evenly over the face, with the normal there; `None` if the face has
    /// no area.
    fn point(&self, number: usize, count: usize) -> Option<(DVec3, DVec3)> {
        if !(self.area > 0.0 && self.area.is_finite()) {
            return None;
        }
        let cumulative = (number as f64 + 0.5) / count as f64 * self.area;
        let triangle = self.areas.partition_point(|&area| area < cumulative).min(self.areas.len() - 1);
        let before = if triangle == 0 { 0.0 } else { self.areas[triangle - 1] };
        let (first, pair) = (self.corners[0], &self.corners[triangle + 1..triangle + 3]);
        // A uniform distribution over a triangle, of two uniform numbers; the second one is van der Corput's.
        let outwards = ((cumulative - before) / (self.areas[triangle] - before)).sqrt();
        let along = f64::from((number as u32).reverse_bits()) / 4_294_967_296.0 + 0.5 / count as f64;
        let position = first + (pair[0] - first).lerp(pair[1] - first, along.min(1.0)) * outwards;
        Some((position, cross(first, pair).try_normalize()?))
    }
}

/// Twice the area of a triangle, along its normal.
fn cross(first: DVec3, pair: &[DVec3]) -> DVec3 {
    (pair[0] - first).cross(pair[1] - first)
}

/// All lights of a scene.
pub(super) struct Lamps {
    ambient: DVec3,
    lamps: Vec<MeteredLamp>,
}

struct MeteredLamp {
    light: Light,
    position: DVec3,
    /// The unit vector against the direction in which it shines.
    backwards: DVec3,
    /// See [`Light::cone`].
    cone: (f64, f64),
}

impl Lamps {
    /// Those at visible nodes; `None` if there are none but ambient lights.
    pub(super) fn of(scene: &Scene, transforms: &[Option<DAffine3>]) -> Option<Self> {
        let mut all = Self { ambient: DVec3::ZERO, lamps: Vec::new() };
        for (id, node) in scene.nodes().iter() {
            let (Some(light), Some(world)) = (&node.light, &transforms[id.index()]) else { continue };
            if light.kind == LightKind::Ambient {
                all.ambient += light.radiance().as_dvec3();
            } else {
                all.lamps.push(MeteredLamp::new(**light, world));
            }
        }
        (!all.lamps.is_empty()).then_some(all)
    }

    /// The value of a white matt surface with a unit normal: that of the side that is lit more, by its
    /// brightest channel.
    pub(super) fn white(&self, position: DVec3, normal: DVec3) -> f64 {
        let [mut front, mut back] = [self.ambient; 2];
        for lamp in &self.lamps {
            let (towards, share) = lamp.arriving(position);
            let cosine = normal.dot(towards);
            let light = lamp.light.radiance().as_dvec3() * (share * cosine.abs());
            if cosine > 0.0 { front += light } else { back += light }
        }
        let [front, back] = [front.max_element(), back.max_element()];
        if front > back { front } else { back }
    }
}

impl MeteredLamp {
    fn new(light: Light, world: &DAffine3) -> Self {
        let backwards = world.transform_vector3(DVec3::Z).normalize_or_zero();
        let (scale, offset) = light.cone();
        let cone = (f64::from(scale), f64::from(offset));
        Self { light, position: world.translation, backwards, cone }
    }

    /// The unit vector towards the lamp, and the fraction of its light that arrives.
    fn arriving(&self, position: DVec3) -> (DVec3, f64) {
        if self.light.kind == LightKind::Directional {
            return (self.backwards, 1.0);
        }
        let offset = self.position - position;
        let towards = offset.normalize_or_zero();
        let (scale, end) = self.cone;
        let linear = (self.backwards.dot(towards) * scale + end).clamp(0.0, 1.0);
        (towards, f64::from(self.light.falloff(offset.length_squared() as f32)) * (linear * linear))
    }
}
