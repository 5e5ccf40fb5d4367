//! A camera flies over hard scenes. In every frame nothing is NaN, no closed mesh
//! has a crack, and every pixel shows the triangle that a ray in f64 meets first: so
//! nothing flickers beyond what rounding explains.

use trigon_scene::{Frame, Outputs, RenderSettings, Renderer};

use super::flight_oracle::{Oracle, Seen};
use super::flight_scenes::{self, Hard};
use crate::effort::scaled;

const SIZE: [u32; 2] = [48, 36];

/// Frames of all scenes together: ten thousand when the properties are asked to run
/// longer than usual.
fn frames() -> u32 {
    const USUAL: u32 = 48;
    const LONG: u32 = 10_000;
    if scaled(USUAL) > USUAL { LONG } else { USUAL }
}

pub(super) fn settings(size: [u32; 2]) -> RenderSettings {
    let outputs = Outputs {
        depth: true,
        ids: true,
        triangle_ids: true,
        positions: true,
        normals: true,
        barycentrics: true,
        ..Outputs::default()
    };
    RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(size[0], size[1]) }
}

/// No number of a frame is NaN.
pub(super) fn check_numbers(frame: &Frame) {
    let depth = frame.depth.iter().flatten();
    assert!(depth.clone().all(|depth| !depth.is_nan()), "a depth is NaN");
    assert!(frame.radiance.iter().flatten().all(|light| !light.is_nan()), "a pixel's light is NaN");
    let vectors =
        [&frame.barycentrics, &frame.positions, &frame.normals, &frame.geometric_normals, &frame.albedo];
    for (name, list) in ["weights", "positions", "normals", "plane normals", "albedo"].iter().zip(vectors) {
        assert!(list.iter().flatten().all(|vector| !vector.is_nan()), "one of {name} is NaN");
    }
    assert!(frame.uvs.iter().flatten().all(|uv| !uv.is_nan()), "a texture coordinate is NaN");
}

/// Holds every pixel against the oracle; which share of them it could decide.
pub(crate) fn check_ids(frame: &Frame, oracle: &Oracle, context: &str) -> f64 {
    let objects = frame.object_ids.as_ref().expect("asked for");
    let triangles = frame.triangle_ids.as_ref().expect("asked for");
    let mut decided = 0;
    for (index, (&object, &triangle)) in (0..).zip(objects.iter().zip(triangles)) {
        let (x, y) = (index % frame.width, index / frame.width);
        let shown = (object != u32::MAX).then_some((object, triangle));
        match oracle.at(x, y) {
            Seen::Only(expected) => {
                assert_eq!(shown, expected, "{context}: pixel ({x}, {y})");
                decided += 1;
            }
            Seen::NoBackground => assert_ne!(shown, None, "{context}: a crack at pixel ({x}, {y})"),
            Seen::Anything => {}
        }
    }
    f64::from(decided) / objects.len() as f64
}

fn fly(hard: &Hard, frames: u32) {
    let mut renderer = Renderer::new(settings(SIZE));
    let mut decided = 0.0;
    for number in 0..frames {
        let camera = hard.camera(f64::from(number) / f64::from(frames));
        let frame = renderer.render(&hard.scene, &camera).expect("in range");
        check_numbers(&frame);
        let oracle = Oracle::new(&hard.scene, &camera, SIZE);
        decided += check_ids(&frame, &oracle, &format!("{}, frame {number} of {frames}", hard.name));
    }
    let share = decided / f64::from(frames);
    assert!(share > hard.decided, "{}: the oracle decides {share} of the pixels", hard.name);
}

/// One test for each scene, so that they share the processors.
macro_rules! flights {
    ($($test:ident: $index:literal),*) => {$(
        #[test]
        fn $test() {
            let scenes = flight_scenes::all();
            fly(&scenes[$index], frames().div_ceil(scenes.len() as u32));
        }
    )*};
}

flights!(
    a_flight_over_slivers: 0,
    a_flight_over_coplanar_cubes: 1,
    a_flight_ten_million_metres_away: 2,
    a_flight_over_nine_orders_of_size: 3,
    a_flight_over_a_fan: 4,
    a_flight_over_a_wide_land: 5
);
