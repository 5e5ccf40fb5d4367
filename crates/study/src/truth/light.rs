//! What rays show: the light of surfaces by the formulas of their sources, in f64.
//!
//! - Lambert: base colour × N·L. Blinn, "Models of Light Reflection for Computer Synthesized Pictures", 1977: a highlight
//!   `specular · (N·H)^shininess · N·L`.
//! - glTF 2.0, appendix B: microfacets with the GGX distribution. Lamps have no size, so α is at least 0.001.
//! - KHR_lights_punctual: how light fades with the distance and in a cone.
//! - Light is hidden where the way to the lamp crosses a triangle (A. Appel, "Some techniques for shading machine renderings of
//!   solids", 1968). Ambient light arrives from the open part of the hemisphere, weighted by its cosine.
//! - A mirror shows what is visible in it, times Schlick's law (1994).

use trigon_math::{DVec2, DVec3, elementary};
use trigon_scene::{MetallicRoughness, Shading};

use super::samples::Samples;
use super::tree::{Crossing, RaySegment};
use super::world::{Lamp, Look, Source, World};

/// The smallest α of lamps' highlights.
const LEAST_ALPHA: f64 = 1e-3;

/// Rays of the hemisphere from each point.
const DIRECTIONS: u32 = 16;

/// The most translucent surfaces in front of each other.
const MOST_LAYERS: usize = 16;

/// A point of a surface, as a ray sees it.
struct Spot<'a> {
    look: &'a Look,
    triangle: u32,
    at: DVec3,
    /// Of length 1, towards the viewer's side.
    normal: DVec3,
    /// Back along the ray.
    view: DVec3,
    albedo: DVec3,
    alpha: f64,
}

/// A ray that looks at the world.
#[derive(Clone, Copy)]
struct Gaze {
    origin: DVec3,
    direction: DVec3,
    passed: u32,
    bounces: u32,
}

impl World {
    /// The light through a point of the image, red, green and blue. `sample` numbers the ray among those of its pixel.
    pub(super) fn light(&self, pixel: DVec2, samples: &Samples, sample: u32) -> DVec3 {
        let [origin, direction] = self.eye.ray(pixel);
        let gaze = Gaze { origin, direction, passed: u32::MAX, bounces: self.effects.bounces };
        let [top, bottom] = self.background;
        let behind = top + (bottom - top) * self.eye.down(pixel);
        self.radiance(gaze, behind, &|spot| self.openness(spot, samples, sample))
    }

    /// The light that arrives against a ray, with what lies behind everything.
    fn radiance(&self, gaze: Gaze, behind: DVec3, open: &dyn Fn(&Spot<'_>) -> f64) -> DVec3 {
        let (mut light, mut passes, mut ray) = (DVec3::ZERO, 1.0, segment(&gaze));
        for _ in 0..MOST_LAYERS {
            let Some(crossing) = self.tree.first(&ray) else { break };
            let spot = self.spot(&ray, &crossing);
            light += self.reflected(&spot, gaze.bounces, open) * (passes * spot.alpha);
            passes *= 1.0 - spot.alpha;
            if passes == 0.0 {
                return light;
            }
            ray = RaySegment { origin: spot.at, passed: spot.triangle, ..ray };
        }
        light + behind * passes
    }

    fn spot(&self, ray: &RaySegment, crossing: &Crossing) -> Spot<'_> {
        let triangle = &self.triangles[crossing.triangle as usize];
        let [second, third] = crossing.weights;
        let first = 1.0 - second - third;
        let [a, b, c] = triangle.normals;
        let normal = (a * first + b * second + c * third).normalize_or_zero();
        let [a, b, c] = triangle.corners;
        let is_front = (b - a).cross(c - a).dot(ray.direction) < 0.0;
        let at = a * first + b * second + c * third;
        let [a, b, c] = triangle.uvs;
        let look = &self.looks[triangle.look];
        let albedo = look.albedo(a * first + b * second + c * third);
        Spot {
            look,
            triangle: crossing.triangle,
            at,
            normal: if is_front { normal } else { -normal },
            view: -ray.direction,
            albedo: albedo.truncate(),
            alpha: albedo.w.clamp(0.0, 1.0),
        }
    }

    /// The light of a surface.
    fn reflected(&self, spot: &Spot<'_>, bounces: u32, open: &dyn Fn(&Spot<'_>) -> f64) -> DVec3 {
        let emitted = spot.look.material.emissive.as_dvec3();
        if spot.look.material.shading == Shading::Unlit {
            return spot.albedo + emitted;
        }
        let lit = self.lamps.iter().map(|lamp| self.lit_by(spot, lamp)).sum::<DVec3>();
        let around = if spot.look.is_mirror() {
            let direction = spot.normal * (2.0 * spot.normal.dot(spot.view)) - spot.view;
            let gaze = Gaze {
                origin: spot.at,
                direction,
                passed: spot.triangle,
                bounces: bounces.saturating_sub(1),
            };
            let far = self.ambient;
            let mirrored = if bounces == 0 { far } else { self.radiance(gaze, far, &|_| 1.0) };
            schlick(spot.albedo, spot.normal.dot(spot.view).abs()) * mirrored
        } else {
            spot.albedo * self.ambient * open(spot)
        };
        lit + around + emitted
    }

    /// A lamp's light that a surface reflects to the viewer.
    fn lit_by(&self, spot: &Spot<'_>, lamp: &Lamp) -> DVec3 {
        let (towards, distance, share) = arriving(lamp, spot.at);
        let cosine = spot.normal.dot(towards);
        if cosine <= 0.0 || share <= 0.0 || (self.effects.shadows && self.is_hidden(spot, towards, distance))
        {
            return DVec3::ZERO;
        }
        let half = (towards + spot.view).normalize_or_zero();
        let toward_half = spot.normal.dot(half).max(0.0);
        let reflected = match &spot.look.material.shading {
            Shading::Unlit => DVec3::ZERO,
            Shading::Lambert => spot.albedo,
            Shading::BlinnPhong { specular, shininess, .. } => {
                let highlight = elementary::pow(toward_half, f64::from(*shininess));
                spot.albedo + specular.as_dvec3() * highlight
            }
            Shading::MetallicRoughness(model) => microfacets(spot, model, [towards, half]),
        };
        reflected * lamp.radiance * (share * cosine)
    }

    /// Whether a triangle that casts shadows lies between a surface and a lamp.
    fn is_hidden(&self, spot: &Spot<'_>, towards: DVec3, distance: f64) -> bool {
        let ray = RaySegment { origin: spot.at, direction: towards, end: distance, passed: spot.triangle };
        self.is_stopped(ray)
    }

    /// Translucent triangles stop nothing.
    fn is_stopped(&self, mut ray: RaySegment) -> bool {
        if self.looks.iter().all(Look::casts_shadow) {
            return self.tree.is_blocked(&ray);
        }
        for _ in 0..MOST_LAYERS {
            let Some(crossing) = self.tree.first(&ray) else { return false };
            if self.looks[self.triangles[crossing.triangle as usize].look].casts_shadow() {
                return true;
            }
            ray.origin += ray.direction * crossing.distance;
            ray.end -= crossing.distance;
            ray.passed = crossing.triangle;
        }
        false
    }

    /// The share of the hemisphere from which ambient light arrives, by [`DIRECTIONS`] rays; those of a pixel complete each other.
    fn openness(&self, spot: &Spot<'_>, samples: &Samples, sample: u32) -> f64 {
        let Some(distance) = self.effects.occlusion else { return 1.0 };
        let (right, up) = spot.normal.any_orthonormal_pair();
        let is_open = |direction: u32| {
            let [square, turn] = samples.direction(sample * DIRECTIONS + direction);
            let angle = turn * std::f64::consts::TAU;
            let flat = right * elementary::cos(angle) + up * elementary::sin(angle);
            let direction = flat * square.sqrt() + spot.normal * (1.0 - square).sqrt();
            !self.is_stopped(RaySegment { origin: spot.at, direction, end: distance, passed: spot.triangle })
        };
        (0..DIRECTIONS).filter(|&direction| is_open(direction)).count() as f64 / f64::from(DIRECTIONS)
    }
}

fn segment(gaze: &Gaze) -> RaySegment {
    let Gaze { origin, direction, passed, .. } = *gaze;
    RaySegment { origin, direction, end: f64::INFINITY, passed }
}

/// The direction to a lamp, its distance, and the part of its light that arrives.
fn arriving(lamp: &Lamp, at: DVec3) -> (DVec3, f64, f64) {
    match lamp.source {
        Source::Parallel(towards) => (towards, f64::INFINITY, 1.0),
        Source::Point { at: lamp, range, axis, cone } => {
            let distance = lamp.distance(at);
            let towards = (lamp - at).normalize_or_zero();
            let part = distance / range;
            let window = (1.0 - part * part * part * part).clamp(0.0, 1.0);
            let within = cone.map_or(1.0, |[inner, outer]| {
                let linear = ((axis.dot(towards) - outer) / (inner - outer).max(1e-4)).clamp(0.0, 1.0);
                linear * linear
            });
            (towards, distance, window * within / (distance * distance))
        }
    }
}

/// C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
fn schlick(f0: DVec3, cosine: f64) -> DVec3 {
    let rest = 1.0 - cosine.clamp(0.0, 1.0);
    f0 + (DVec3::ONE - f0) * (rest * rest * rest * rest * rest)
}

/// glTF 2.0, appendix B.3: times π, and without N·L.
fn microfacets(spot: &Spot<'_>, model: &MetallicRoughness, [towards, half]: [DVec3; 2]) -> DVec3 {
    let metallic = f64::from(model.metallic);
    let alpha = f64::from(model.roughness * model.roughness).max(LEAST_ALPHA);
    let square = alpha * alpha;
    let ior = f64::from(spot.look.material.ior);
    let dielectric = (ior - 1.0) / (ior + 1.0) * ((ior - 1.0) / (ior + 1.0));
    let f0 = DVec3::splat(dielectric).lerp(spot.albedo, metallic);
    let [n_dot_l, n_dot_v, n_dot_h] = [towards, spot.view, half].map(|along| spot.normal.dot(along).abs());
    let fresnel = schlick(f0, spot.view.dot(half));
    let width = n_dot_h * n_dot_h * (square - 1.0) + 1.0;
    let distribution = square / (width * width);
    let shadowed = |one: f64, other: f64| one * (other * other * (1.0 - square) + square).sqrt();
    let visibility = 0.5 / (shadowed(n_dot_l, n_dot_v) + shadowed(n_dot_v, n_dot_l)).max(1e-12);
    (DVec3::ONE - fresnel) * spot.albedo * (1.0 - metallic) + fresnel * distribution * visibility
}
