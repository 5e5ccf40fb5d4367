//! Ambient occlusion that neighbours share, against rays in f64 among a floor and a box.

use trigon_math::{DVec2, DVec3};

use super::*;

/// How far surfaces occlude, in metres.
const DISTANCE: f64 = 1.0;

/// The corners of a box on a floor at height 0.
const BOX: [DVec3; 2] = [DVec3::new(-0.8, 0.0, -0.6), DVec3::new(0.6, 1.1, 0.7)];

/// Half the side of the floor.
const FLOOR: f64 = 6.0;

/// Where a ray first meets the floor or the box within a distance, and the normal there.
fn met(origin: DVec3, direction: DVec3, far: f64) -> Option<(f64, DVec3)> {
    let mut nearest: Option<(f64, DVec3)> = None;
    let mut look = |t: f64, normal: DVec3| {
        if t > 1e-9 && t < far && nearest.is_none_or(|(best, _)| t < best) {
            nearest = Some((t, normal));
        }
    };
    let t = -origin.y / direction.y;
    let at = origin + direction * t;
    if at.x.abs() <= FLOOR && at.z.abs() <= FLOOR {
        look(t, DVec3::Y);
    }
    let [low, high] = BOX.map(|corner| (corner - origin) / direction);
    let (enter, leave) = (low.min(high), low.max(high));
    let t = enter.max_element();
    if t <= leave.min_element() {
        let axis = (0..3).find(|&axis| enter[axis] == t).expect("one of them is the largest");
        look(t, -DVec3::AXES[axis] * direction[axis].signum());
    }
    nearest
}

/// The fraction of a hemisphere that is open, by cosine-weighted rays on a grid.
fn open(at: DVec3, normal: DVec3) -> f64 {
    const SIDE: u32 = 24;
    let (right, up) = normal.any_orthonormal_pair();
    let rays = (0..SIDE * SIDE).map(|ray| {
        let [square, angle] = [ray % SIDE, ray / SIDE].map(|step| (f64::from(step) + 0.5) / f64::from(SIDE));
        let angle = angle * std::f64::consts::TAU;
        let (sine, cosine) = (elementary::sin(angle), elementary::cos(angle));
        let flat = (right * cosine + up * sine) * square.sqrt();
        flat + normal * (1.0 - square).sqrt()
    });
    let leaving = rays.filter(|&ray| met(at + normal * 1e-6, ray, DISTANCE).is_none()).count();
    leaving as f64 / f64::from(SIDE * SIDE)
}

fn floor_and_box() -> Scene {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(2.0 * FLOOR as f32, 2.0 * FLOOR as f32), matt(Vec3::ONE));
    let node = scene.add_object("box", primitives::cube(1.0), matt(Vec3::ONE));
    let [low, high] = BOX;
    scene.node_mut(node).expect("just added").transform =
        Transform::from_scale_rotation_translation(high - low, DQuat::IDENTITY, (low + high) / 2.0);
    scene.add(Node::from_light(Light::ambient(1.0)));
    scene
}

fn with(rays: u32, sampling: RaySampling, [width, height]: [u32; 2]) -> RenderSettings {
    let occlusion = AmbientOcclusion { sampling, ..AmbientOcclusion::new(rays, DISTANCE as f32) };
    let effects = EffectSettings { ambient_occlusion: Some(occlusion), ..EffectSettings::default() };
    let mut settings = RenderSettings { width, height, ..settings(effects) };
    settings.outputs.radiance = true;
    settings
}

/// Three metres and a half from the box: parallel rays, or rays that meet in an eye, straight or beside the axis.
fn cameras() -> [Camera; 3] {
    let from = DVec3::new(2.0, 2.4, 2.6);
    let camera = Camera::look_at(from, DVec3::new(0.0, 0.4, 0.0), DVec3::Y);
    let parallel = Projection::orthographic(2.6, -1.0, 20.0).expect("the numbers are in range");
    let shifted = Projection::frustum(-0.04, 0.08, -0.05, 0.03, 0.1, None).expect("in range");
    [camera, Camera { projection: parallel, ..camera }, Camera { projection: shifted, ..camera }]
}

/// The root mean square error of an image, and the rays that it took. What is far from the box is nothing but open.
fn error(scene: &Scene, camera: &Camera, settings: RenderSettings) -> (f64, u64) {
    let size = DVec2::new(f64::from(settings.width), f64::from(settings.height));
    let mut renderer = Renderer::new(settings);
    let frame = renderer.render(scene, camera).expect("drawn");
    let radiance = frame.radiance.expect("requested");
    let rows = (0..frame.height).flat_map(|y| (0..frame.width).map(move |x| (x, y)));
    let (mut sum, mut count) = (0.0, 0);
    for ((x, y), light) in rows.zip(radiance) {
        let pixel = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let (origin, direction) = ray_through(camera, pixel, size);
        let Some((t, normal)) = met(origin, direction, f64::INFINITY) else { continue };
        let difference = f64::from(light.x) - open(origin + direction * t, normal);
        sum += difference * difference;
        count += 1;
    }
    assert!(count > 1000, "{count} pixels show something");
    ((sum / f64::from(count)).sqrt(), renderer.effect_counts(Effect::AmbientOcclusion).rays)
}

/// By the fields of the projection.
fn ray_through(camera: &Camera, pixel: DVec2, size: DVec2) -> (DVec3, DVec3) {
    let [x, y] = [2.0 * pixel.x / size.x - 1.0, 1.0 - 2.0 * pixel.y / size.y];
    let wide = x * size.x / size.y;
    let (from, along) = match camera.projection {
        Projection::Perspective { vertical_fov, .. } => {
            let half = elementary::tan(vertical_fov / 2.0);
            (DVec3::ZERO, DVec3::new(wide * half, y * half, -1.0))
        }
        Projection::Orthographic { height, .. } => (DVec3::new(wide, y, 0.0) * height / 2.0, DVec3::NEG_Z),
        Projection::Frustum { left, right, bottom, top, near, .. } => {
            let window = DVec2::new(right - left, top - bottom) * DVec2::new(x, y);
            (DVec3::ZERO, ((DVec2::new(left + right, bottom + top) + window) / 2.0).extend(-near))
        }
        other => panic!("not for {other:?}"),
    };
    let direction = (camera.orientation * along).normalize();
    // From behind the eye, where parallel rays begin, and where nothing is.
    (camera.position + camera.orientation * from - direction * 10.0, direction)
}

/// Sixteen rays at every sample err by chance, 64 shared ones where occlusion is narrower than a few pixels.
#[test]
fn shared_rays_err_little_more_than_rays_at_every_sample_and_are_few() {
    let scene = floor_and_box();
    for camera in cameras() {
        let size = [101, 63];
        let (all, many) = error(&scene, &camera, with(16, RaySampling::Full, size));
        let (shared, few) = error(&scene, &camera, with(64, RaySampling::Shared, size));
        assert!(shared <= 1.5 * all, "{:?}: {shared}, not {all}", camera.projection);
        assert!(10 * few < many, "{:?}: {few} rays, not {many}", camera.projection);
        assert!(few > 0, "there are rays");
    }
}

/// A rod of a pixel's width, which an image of half the size need not show.
#[test]
fn samples_that_the_small_image_does_not_show_cast_rays_themselves() {
    let mut scene = floor_and_box();
    let rod = scene.add_object("rod", primitives::cube(1.0), matt(Vec3::ONE));
    scene.node_mut(rod).expect("just added").transform = Transform::from_scale_rotation_translation(
        DVec3::new(2.0, 0.02, 0.02),
        DQuat::IDENTITY,
        DVec3::new(0.0, 1.5, 1.2),
    );
    let of = |sampling| {
        let mut settings = with(64, sampling, [128, 80]);
        settings.outputs.ids = true;
        let frame = render(&scene, &cameras()[0], &settings).expect("drawn");
        (frame.radiance.expect("requested"), frame.object_ids.expect("requested"))
    };
    let ((full, ids), (shared, _)) = (of(RaySampling::Full), of(RaySampling::Shared));
    let is_rod = |id: &u32| *id == rod.index() as u32;
    let pixels: Vec<usize> = ids.iter().enumerate().filter(|(_, id)| is_rod(id)).map(|(at, _)| at).collect();
    assert!(pixels.len() > 40, "{} pixels show the rod", pixels.len());
    for at in pixels {
        let (full, shared) = (full[at].x, shared[at].x);
        assert!((full - shared).abs() < 0.2, "pixel {at}: {shared}, not {full}");
    }
}
