//! Shadows where maps and meshes have edges: between the six maps of a point light, and where a smooth surface of flat
//! faces turns away from the light.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::{DQuat, DVec3, Vec3};
use trigon_mesh::primitives;
use trigon_scene::{
    Background, EffectSettings, Exposure, Frame, Light, Lighting, Material, Node, RenderSettings, Scene,
    Shading, Shadows, Transform, render,
};

use super::flight::settings;
use crate::effort::cases;

const SIDE: u32 = 49;

/// From the left edge of the image to the right one, in metres.
const WIDE: f64 = 6.0;

fn matt() -> Material {
    Material { shading: Shading::Lambert, double_sided: true, ..Material::from_color(Vec3::ONE) }
}

fn lit(shadows: Shadows) -> RenderSettings {
    let effects = EffectSettings { shadows, exposure: Exposure::Stops(0.0), ..EffectSettings::default() };
    let background = Background::Color(Vec3::ZERO);
    RenderSettings { lighting: Lighting::Scene, background, effects, ..settings([SIDE; 2]) }
}

/// A level rectangle that stands between the lamp and the floor.
#[derive(Clone, Copy, Debug)]
struct Plate {
    center: DVec3,
    half: [f64; 2],
}

impl Plate {
    /// Whether it is hit on the straight way between a lamp above it and a point below.
    fn hides(&self, lamp: DVec3, point: DVec3) -> bool {
        let share = (lamp.y - self.center.y) / (lamp.y - point.y);
        let offset = lamp + (point - lamp) * share - self.center;
        offset.x.abs() < self.half[0] && offset.z.abs() < self.half[1]
    }
}

/// Plates a little below the lamp, which throw their shadows over the whole floor.
fn plates() -> impl Strategy<Value = Vec<Plate>> {
    let plate = ([-0.8..0.8_f64, -0.6..-0.25, -0.8..0.8], [0.05..0.4_f64, 0.05..0.4])
        .prop_map(|(center, half)| Plate { center: DVec3::from_array(center), half });
    // One of them where three of the maps meet.
    let at_corner = Plate { center: DVec3::new(0.4, -0.4, -0.4), half: [0.1, 0.15] };
    prop::collection::vec(plate, 0..4).prop_map(move |plates| [vec![at_corner], plates].concat())
}

/// The floor's middle is a metre below the origin; it is seen from straight above.
fn room(lamp: DVec3, plates: &[Plate]) -> (Scene, Camera) {
    let mut scene = Scene::new();
    let mut add = |mesh, center| {
        let node = scene.add_object("", mesh, matt());
        scene.node_mut(node).expect("just added").transform = Transform::from_translation(center);
    };
    add(primitives::plane(8.0, 8.0), DVec3::NEG_Y);
    for Plate { center, half } in plates {
        add(primitives::plane(2.0 * half[0] as f32, 2.0 * half[1] as f32), *center);
    }
    scene.add(Node::from_light(Light::point(2.0)).at(lamp));
    let projection = Projection::orthographic(WIDE, 0.1, 20.0).expect("in range");
    (scene, Camera::look_at(DVec3::Y * 10.0, DVec3::ZERO, DVec3::NEG_Z).with_projection(projection))
}

fn draw((scene, camera): &(Scene, Camera), shadows: Shadows) -> Frame {
    render(scene, camera, &lit(shadows)).expect("in range")
}

fn shadows() -> impl Strategy<Value = Shadows> {
    prop_oneof![Just(Shadows::Rays), (256..600_u32).prop_map(|resolution| Shadows::Maps { resolution })]
}

/// How far a shadow may be off on the floor, beside the lamp by so much: it begins 1.7 texels away from what throws it
/// (`effects/shadow`); a texel is 2 w/resolution wide, w at most the distance from the lamp; and grazing light stretches
/// both by as much again.
fn blur(shadows: Shadows, distance: f64) -> f64 {
    match shadows {
        Shadows::Maps { resolution } => {
            1e-3 + 1.7 * 2.0 * distance * (1.0 + distance) / f64::from(resolution)
        }
        Shadows::Rays | Shadows::Off => 1e-4,
    }
}

proptest! {
    #![proptest_config(cases(30))]

    /// The floor below a point light lies in five of its maps, whose edges meet at a metre to each side and along the
    /// diagonals. A pixel is dark exactly where the way to the lamp meets a plate, in f64.
    #[test]
    fn shadows_of_a_point_light_go_on_from_map_to_map(
        lamp in prop_oneof![Just(DVec3::ZERO), prop::array::uniform3(-0.1..0.1_f64).prop_map(DVec3::from_array)],
        plates in plates(), shadows in shadows(),
    ) {
        let room = room(lamp, &plates);
        let [off, shown] = [Shadows::Off, shadows].map(|shadows| draw(&room, shadows));
        let ids = off.object_ids.as_ref().expect("asked for");
        let (mut decided, mut dark, mut floor) = (0, 0, 0);
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            if ids[(y * SIDE + x) as usize] != 0 {
                continue;
            }
            floor += 1;
            let at = |pixel: u32| (f64::from(pixel) + 0.5) / f64::from(SIDE) * WIDE - WIDE / 2.0;
            let point = DVec3::new(at(x), -1.0, at(y));
            let aside = blur(shadows, (point - lamp).length());
            let is_hidden = |[dx, dz]: [i32; 2]| {
                let near = point + DVec3::new(f64::from(dx), 0.0, f64::from(dz)) * (aside / 2.0);
                plates.iter().any(|plate| plate.hides(lamp, near))
            };
            let around = (-2..=2).flat_map(|dz| (-2..=2).map(move |dx| [dx, dz]));
            let count = around.filter(|&by| is_hidden(by)).count();
            if count == 0 || count == 25 {
                let expected = if count == 0 { off.pixel(x, y) } else { [0, 0, 0, 255] };
                prop_assert_eq!(shown.pixel(x, y), expected, "at {}, hidden: {}", point, count > 0);
                decided += 1;
                dark += usize::from(count > 0);
            }
        }
        prop_assert!(2 * decided > floor && dark > 0, "{} of {} decided, {} dark", decided, floor, dark);
    }

    /// A ball of few flat faces with smooth normals, in the sun. What faces the lamp is lit as without shadows up to the
    /// last face, without bands; and faces that look away are dark, although their normals still have light: the shadow
    /// ends where the faces do. (Rays start on faces, not on the ball that they stand for.)
    #[test]
    fn a_coarse_smooth_ball_is_lit_up_to_the_last_face_that_looks_at_the_lamp(
        sun in prop::array::uniform4(-1.0..1.0_f64).prop_filter("has a length", |q| q.iter().map(|v| v * v).sum::<f64>() > 0.01),
        parts in 0..3_u32, shadows in shadows(),
    ) {
        let sun = DQuat::from_array(sun).normalize();
        let mut scene = Scene::new();
        let ball = primitives::icosphere(2.5, parts);
        scene.add_object("ball", ball.clone(), matt());
        let lamp = Transform::from_scale_rotation_translation(DVec3::ONE, sun, DVec3::ZERO);
        scene.add(Node::from_light(Light::directional(1.0)).with_transform(lamp));
        let projection = Projection::orthographic(WIDE, 0.1, 20.0).expect("in range");
        let camera = Camera::look_at(DVec3::new(3.0, 5.0, 8.0), DVec3::ZERO, DVec3::Y).with_projection(projection);
        let room = (scene, camera);
        let [off, shown] = [Shadows::Off, shadows].map(|shadows| draw(&room, shadows));
        let faces = off.face_ids.as_ref().expect("asked for");
        let towards = sun * DVec3::Z;
        let mut judged = 0;
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let face = faces[(y * SIDE + x) as usize];
            // Where rounding may decide which face it is, the one beside it is as right.
            let is_inside = |by: u32| faces.get((y * SIDE + x + by) as usize) == Some(&face);
            if face == u32::MAX || y == 0 || ![1, SIDE].into_iter().all(is_inside) {
                continue;
            }
            let is_inside = [1, SIDE].into_iter().all(|by| faces[(y * SIDE + x - by) as usize] == face);
            let [a, b, c] = [0, 1, 2].map(|i| ball.positions()[ball.face_vertices(face as usize)[i] as usize].as_dvec3());
            let cosine = (b - a).cross(c - a).normalize().dot(towards);
            judged += 1;
            // A smooth normal leans by up to 37° from its face's on the coarsest ball: with 25° that is no right angle.
            prop_assert!(cosine < 0.91 || off.pixel(x, y)[0] > 0, "face {} is dark without shadows", face);
            if cosine > 1e-3 {
                prop_assert_eq!(shown.pixel(x, y), off.pixel(x, y), "face {} has {} of the light", face, cosine);
            } else if cosine < -1e-3 && is_inside && shadows == Shadows::Rays {
                prop_assert_eq!(shown.pixel(x, y), [0, 0, 0, 255], "face {} looks away: {}", face, cosine);
            }
        }
        // The ball covers half of the image; pixels on outlines of its faces are left out.
        prop_assert!(10 * judged > SIDE * SIDE, "the ball has {} of {} pixels", judged, SIDE * SIDE);
    }
}
