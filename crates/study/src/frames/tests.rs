//! What the report says of whole frames, as far as it is about errors.

use super::flight::miss;
use super::*;
use crate::workloads::Workload;
use std::time::Duration;

const SIZE: [u32; 2] = [60, 36];

#[test]
fn each_preset_is_nearer_than_the_one_before() {
    let presets = Preset::ALL.map(Preset::quality);
    for case in Case::ALL {
        let errors = errors(case, SIZE, &presets).unwrap();
        for pair in errors.windows(2) {
            assert!(pair[1] < pair[0], "{}: {errors:?}", case.name());
        }
        assert!(errors[3] > 0.0, "{}: the reference is none of its own", case.name());
    }
}

#[test]
fn light_once_for_each_triangle_is_worse_than_at_its_corners() {
    let qualities = &variants()[..3];
    let names: Vec<String> = qualities.iter().map(|&quality| name(quality)).collect();
    assert_eq!(names, ["1×1×1, flat", "1×1×1, Gouraud", "1×1×1 (draft)"], "in this order");
    let errors = errors(Case::Showcase, SIZE, &qualities[..2]).unwrap();
    assert!(errors[0] > errors[1], "flat, Gouraud: {errors:?}");
}

#[test]
fn flights_are_measured() {
    // Every question takes a tenth of a second: nothing fits but what is asked for first.
    let mut now = Duration::ZERO;
    let mut clock = move || {
        now += Duration::from_millis(100);
        now
    };
    let steps = fly(Case::Showcase, [30, 18], Duration::from_millis(16), [6, 3], &mut clock).unwrap();
    let measured: Vec<bool> = steps.iter().map(|step| step.error.is_some()).collect();
    assert_eq!(measured, [true, false, true, false, true, false], "three of six");
    assert!(steps.iter().all(|step| step.choice.chosen.quality.covered_samples() == 1), "the quickest");
    let kept = Kept::of(&steps);
    assert_eq!((kept.in_time, kept.measured), (0.0, 3), "on a clock like that no frame is in time");
    assert!(kept.foreseen <= 3 && kept.worst < 1.0, "{kept:?}");
}

#[test]
fn misses_are_parts_of_what_was_measured() {
    assert_eq!([miss(0.8, 1.0), miss(1.25, 1.0), miss(0.0, 0.0)], [1.0 - 0.8, 0.25, 0.0], "either way");
}

#[test]
fn most_of_a_smooth_picture_is_certified() {
    let proven = Prover::new(Workload::KnotPhong, 8).unwrap().prove().unwrap();
    let sum = proven.certified + proven.visibility + proven.color;
    // Three quotients by the same number: a few roundings.
    assert!((sum - 1.0).abs() < 1e-12, "every pixel is one of three: {proven:?}");
    assert!(proven.visibility > 0.0 && proven.certified > 0.0, "some of each: {proven:?}");
}
