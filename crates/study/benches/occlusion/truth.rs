//! The truth: 1,024 rays in f64 at every pixel, cosine-weighted ones or those to a lamp, through a tree of boxes that shares
//! nothing with the engine's.

use trigon_math::{DVec2, DVec3, elementary};
use trigon_scene::Frame;

use crate::scenes::Subject;

/// The root of the number of rays.
const SIDE: u32 = 32;

type Triangle = [DVec3; 3];

/// Boxes around triangles, halved at the median.
struct Boxes {
    nodes: Vec<Node>,
    triangles: Vec<Triangle>,
}

struct Node {
    low: DVec3,
    high: DVec3,
    /// The first triangle or the first of two nodes.
    first: usize,
    /// Triangles; 0 for two nodes.
    count: usize,
}

/// The open fraction of the hemisphere of each pixel; `None` where nothing is seen.
pub(crate) fn openness(surfaces: &Frame, subject: &Subject) -> Vec<Option<f64>> {
    of_rays(surfaces, subject, subject.distance, |normal, flat| {
        let (right, up) = normal.any_orthonormal_pair();
        right * flat.x + up * flat.y + normal * (1.0 - flat.length_squared()).sqrt()
    })
}

/// The fraction that each pixel sees of a disc of some radius at a distance of one metre; `None` where nothing is seen.
pub(crate) fn visibility(
    surfaces: &Frame,
    subject: &Subject,
    towards: DVec3,
    radius: f64,
) -> Vec<Option<f64>> {
    let (right, up) = towards.any_orthonormal_pair();
    of_rays(surfaces, subject, f64::INFINITY, |_, flat| towards + (right * flat.x + up * flat.y) * radius)
}

/// The fraction of the rays from each pixel that hit nothing, by its normal and points on a disc of radius 1.
fn of_rays(
    surfaces: &Frame,
    subject: &Subject,
    far: f64,
    ray: impl Fn(DVec3, DVec2) -> DVec3,
) -> Vec<Option<f64>> {
    let boxes = Boxes::new(subject.triangles());
    let off = 1e-5 * subject.scene.bounds().size().length();
    let (eye, along) = (subject.camera.position, subject.camera.orientation * DVec3::NEG_Z);
    let is_parallel = subject.camera.projection.is_orthographic();
    let points = surfaces.positions.iter().flatten().zip(surfaces.normals.iter().flatten());
    let of = |(number, (position, normal)): (usize, (&_, &_))| {
        let (position, normal): (trigon_math::Vec3, trigon_math::Vec3) = (*position, *normal);
        let normal = normal.as_dvec3().try_normalize()?;
        let position = position.as_dvec3();
        let away = if is_parallel { along } else { position - eye };
        let normal = if normal.dot(away) > 0.0 { -normal } else { normal };
        let mut random = number as u64 | 1 << 40;
        let rays = (0..SIDE * SIDE).map(|number| ray(normal, on_disc(number, &mut random)));
        let leaving = rays.filter(|&ray| !boxes.stop(position + normal * off, ray, far));
        Some(leaving.count() as f64 / f64::from(SIDE * SIDE))
    };
    points.enumerate().map(of).collect()
}

/// A point somewhere in its cell of a grid over the disc.
fn on_disc(number: u32, random: &mut u64) -> DVec2 {
    let mut fraction = || {
        // Xorshift (G. Marsaglia, 2003).
        *random ^= *random << 13;
        *random ^= *random >> 7;
        *random ^= *random << 17;
        (*random >> 11) as f64 / (1_u64 << 53) as f64
    };
    let [square, turn] =
        [number % SIDE, number / SIDE].map(|cell| (f64::from(cell) + fraction()) / f64::from(SIDE));
    let angle = turn * std::f64::consts::TAU;
    DVec2::new(elementary::cos(angle), elementary::sin(angle)) * square.sqrt()
}

impl Boxes {
    fn new(mut triangles: Vec<Triangle>) -> Self {
        let count = triangles.len();
        let mut nodes = vec![Node { low: DVec3::ZERO, high: DVec3::ZERO, first: 0, count }];
        let mut left = vec![0];
        while let Some(number) = left.pop() {
            let Node { first, count, .. } = nodes[number];
            let own = &mut triangles[first..first + count];
            let corners = || own.iter().flatten();
            let low = corners().fold(DVec3::INFINITY, |low, corner| low.min(*corner));
            let high = corners().fold(DVec3::NEG_INFINITY, |high, corner| high.max(*corner));
            (nodes[number].low, nodes[number].high) = (low, high);
            if count > 4 {
                let axis = (high - low).max_position();
                let middle = |triangle: &Triangle| triangle.iter().map(|corner| corner[axis]).sum::<f64>();
                let half = count / 2;
                own.select_nth_unstable_by(half, |one, other| middle(one).total_cmp(&middle(other)));
                let pair = [(first, half), (first + half, count - half)];
                (nodes[number].first, nodes[number].count) = (nodes.len(), 0);
                for (first, count) in pair {
                    left.push(nodes.len());
                    nodes.push(Node { low, high, first, count });
                }
            }
        }
        Self { nodes, triangles }
    }

    /// Whether a ray hits a triangle within a distance.
    fn stop(&self, origin: DVec3, direction: DVec3, far: f64) -> bool {
        let inverse = direction.recip();
        let mut left = vec![0];
        while let Some(number) = left.pop() {
            let Node { low, high, first, count } = self.nodes[number];
            let (one, other) = ((low - origin) * inverse, (high - origin) * inverse);
            let enters = one.min(other).max_element().max(0.0);
            let leaves = one.max(other).min_element().min(far);
            if enters > leaves * (1.0 + 1e-12) {
                continue;
            }
            if count == 0 {
                left.extend([first, first + 1]);
            } else if self.triangles[first..first + count].iter().any(|it| hits(it, origin, direction, far)) {
                return true;
            }
        }
        false
    }
}

/// T. Möller and B. Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
fn hits(&[a, b, c]: &Triangle, origin: DVec3, direction: DVec3, far: f64) -> bool {
    let (right, up) = (b - a, c - a);
    let across = direction.cross(up);
    let volume = right.dot(across);
    let from = origin - a;
    let one = from.dot(across) / volume;
    let normal = from.cross(right);
    let other = direction.dot(normal) / volume;
    let distance = up.dot(normal) / volume;
    volume != 0.0 && one >= 0.0 && other >= 0.0 && one + other <= 1.0 && distance > 0.0 && distance < far
}
