//! Regions against the oracle.

use std::collections::BTreeSet;

use trigon_camera::Camera;
use trigon_math::{DVec2, DVec3};
use trigon_mesh::primitives;

use super::super::region::center;
use super::oracle::{Answer, Element, Oracle, ROUNDING, contains};
use super::scenes::{Random, camera, regions, scene};
use super::target::{Rendered, Target};
use crate::{ElementSet, Material, NodeId, Outputs, Picker, Reach, Region, RenderSettings, Scene, render};

/// Large beside faces, so that most have a pixel that is far from their outline.
const SIZE: [u32; 2] = [320, 240];
const SCENES: u64 = 16;
/// Draws of regions in each scene; each draw has one of each kind.
const DRAWS: usize = 3;

/// How many elements were looked at, and of how many a rounding decides.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    hit: usize,
    missed: usize,
    open: usize,
}

impl Tally {
    fn check(&mut self, found: bool, expected: Answer, what: &str) {
        match expected {
            Answer::Open => self.open += 1,
            Answer::Yes => {
                assert!(found, "{what} is hit and was not found");
                self.hit += 1;
            }
            Answer::No => {
                assert!(!found, "{what} is not hit and was found");
                self.missed += 1;
            }
        }
    }
}

/// What covers a pixel's centre: for each face that may be visible there, or cover it, whether it
/// is or does.
#[derive(Default)]
struct Pixel {
    visible: Vec<(usize, u32, Answer)>,
    covering: Vec<(usize, u32, Answer)>,
}

/// A triangle that may be seen in a pixel.
struct Met {
    object: usize,
    face: u32,
    seen: Answer,
    near: f64,
    far: f64,
    /// The side at which it is open whether it is.
    side: Option<[DVec3; 2]>,
}

fn pixel(oracle: &Oracle, [x, y]: [u32; 2]) -> Pixel {
    let (mut pixel, at) = (Pixel::default(), center(x, y));
    let mut met = Vec::new();
    for target in oracle.targets.iter().filter(|target| target.is_near(at)) {
        let Target { object, face, .. } = *target;
        let (covers, _) = target.meets(&oracle.lens, at, ROUNDING);
        if covers != Answer::No {
            pixel.covering.push((object, face, covers));
        }
        if let Some(Rendered { answer, distances: [near, far], side }) = target.rendered(&oracle.lens, [x, y])
        {
            met.push(Met { object, face, seen: answer, near, far, side });
        }
    }
    // The farthest that what is seen can be: what is there for certain hides all behind it.
    let limit = certain(&met).fold(f64::INFINITY, f64::min);
    met.retain(|met| met.near <= limit);
    let alone = met.iter().all(|one| (one.object, one.face) == (met[0].object, met[0].face));
    let answer = if certain(&met).next().is_some() && alone { Answer::Yes } else { Answer::Open };
    pixel.visible = met.iter().map(|met| (met.object, met.face, answer)).collect();
    pixel
}

/// How far those are at most that are there for certain: a triangle, or one of two that
/// share a side on which the pixel's centre lies, and lie on either side of it.
fn certain(met: &[Met]) -> impl Iterator<Item = f64> + '_ {
    let single = met.iter().filter(|met| met.seen == Answer::Yes).map(|met| met.far);
    let pairs = met.iter().flat_map(move |one| {
        let other = move |other: &&Met| {
            matches!((one.side, other.side), (Some([a, b]), Some([c, d])) if a == d && b == c)
        };
        met.iter().filter(other).map(move |other| one.far.max(other.far))
    });
    single.chain(pairs)
}

/// For each face of each object, whether it is hit in a region.
fn faces(oracle: &Oracle, pixels: &[Pixel], region: &Region, reach: Reach) -> Vec<Vec<Answer>> {
    let mut answers: Vec<Vec<Answer>> =
        oracle.face_counts.iter().map(|&count| vec![Answer::No; count]).collect();
    let places = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| center(x, y)));
    for (pixel, at) in pixels.iter().zip(places) {
        let inside = contains(region, size(), at);
        if inside == Answer::No {
            continue;
        }
        let faces = if reach == Reach::Visible { &pixel.visible } else { &pixel.covering };
        for &(object, face, answer) in faces {
            let known = &mut answers[object][face as usize];
            *known = (*known).max(answer.min(inside));
        }
    }
    answers
}

fn element(element: &Element, region: &Region, reach: Reach) -> Answer {
    let answers = element.points.iter().map(|point| {
        let visible = if reach == Reach::Visible { point.visible } else { Answer::Yes };
        contains(region, size(), point.seen.at).min(point.exists).min(visible)
    });
    answers.max().unwrap_or(Answer::No)
}

fn size() -> DVec2 {
    SIZE.map(f64::from).into()
}

/// What is found is there, and nothing else: no vertex that nothing uses.
fn check_known(found: &ElementSet, known: &BTreeSet<(NodeId, u32)>, seed: u64) {
    assert!(found.iter().all(|element| known.contains(&element)), "scene {seed}: there is no such element");
    assert!(found.iter().is_sorted(), "scene {seed}: in order");
    assert_eq!(found.iter().count(), found.len(), "scene {seed}: counted");
}

fn check_scene(seed: u64, tallies: &mut [[Tally; 3]; 2]) {
    let mut random = Random((seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let (scene, camera) = (scene(&mut random), camera(&mut random));
    let outputs = Outputs { ids: true, ..Outputs::NONE };
    let [width, height] = SIZE;
    let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(width, height) };
    let frame = render(&scene, &camera, &settings).expect("drawn");
    let picker = Picker::new(&scene, &camera, &frame);
    let ahead = Picker::new(&scene, &camera, &frame);
    ahead.find_visible_vertices();
    let oracle = Oracle::new(&scene, &camera, size());
    let places = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
    let pixels: Vec<Pixel> = places.map(|at| pixel(&oracle, at)).collect();
    let elements = [&oracle.vertices, &oracle.edges];
    let known = elements.map(|list| list.iter().map(|element| (element.node, element.index)).collect());
    for region in (0..DRAWS).flat_map(|_| regions(&mut random, size())) {
        for (reach, tallies) in [Reach::Visible, Reach::Through].into_iter().zip(tallies.iter_mut()) {
            let about =
                |kind, node, index| format!("scene {seed}, {region:?}, {reach:?}: {kind} {node:?} {index}");
            let found = picker.faces(&region, reach);
            let expected = faces(&oracle, &pixels, &region, reach);
            for (&node, answers) in oracle.nodes.iter().zip(&expected) {
                for (face, &answer) in (0..).zip(answers) {
                    tallies[0].check(found.contains(node, face), answer, &about("face", node, face));
                }
            }
            let found = [picker.vertices(&region, reach), picker.edges(&region, reach)];
            assert!(ahead.vertices(&region, reach) == found[0], "scene {seed}, {region:?}: found ahead");
            for (kind, name) in ["vertex", "edge"].into_iter().enumerate() {
                check_known(&found[kind], &known[kind], seed);
                for of in elements[kind] {
                    let about = about(name, of.node, of.index);
                    let is_found = found[kind].contains(of.node, of.index);
                    tallies[kind + 1].check(is_found, element(of, &region, reach), &about);
                }
            }
        }
    }
}

#[test]
fn regions_hit_what_rays_say() {
    let mut tallies = [[Tally::default(); 3]; 2];
    (0..SCENES).for_each(|seed| check_scene(seed, &mut tallies));
    for tallies in tallies {
        assert!(
            tallies.iter().all(|tally| tally.hit > 500 && tally.missed > 500),
            "both happen: {tallies:?}"
        );
        for Tally { hit, missed, open } in tallies {
            assert!(open * 1000 <= hit + missed + open, "at most a thousandth is open: {tallies:?}");
        }
    }
}

/// More triangles than a thread takes at a time, and more points in a pixel than are asked
/// together.
#[test]
fn any_number_of_threads_picks_the_same() {
    let mut scene = Scene::new();
    scene.add_object("torus", primitives::torus(1.0, 0.45, 150, 90), Material::default());
    let camera = Camera::look_at(DVec3::new(0.0, 2.6, 4.6), DVec3::ZERO, DVec3::Y);
    let outputs = Outputs { ids: true, ..Outputs::NONE };
    let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(96, 72) };
    let frame = render(&scene, &camera, &settings).expect("drawn");
    let region = Region::Rectangle { min: DVec2::new(3.0, 2.0), max: DVec2::new(70.0, 60.0) };
    let picked = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| {
            let picker = Picker::new(&scene, &camera, &frame);
            [Reach::Visible, Reach::Through].map(|reach| {
                let nearest = picker.nearest(DVec2::new(40.0, 50.0), 12.0, reach);
                let of = [
                    picker.faces(&region, reach),
                    picker.vertices(&region, reach),
                    picker.edges(&region, reach),
                ];
                (of, nearest)
            })
        })
    };
    let alone = picked(1);
    let counts = alone.each_ref().map(|(of, _)| of.each_ref().map(ElementSet::len));
    assert!(counts.as_flattened().iter().all(|&count| count > 1000), "{counts:?}");
    assert!(counts[0].iter().zip(counts[1]).all(|(&seen, all)| seen < all), "some are hidden: {counts:?}");
    for threads in [2, 3, 8] {
        assert!(picked(threads) == alone, "{threads} threads");
    }
}

/// A small circle is searched first; where it is empty of one kind, the whole circle is.
#[test]
fn the_nearest_elements_do_not_depend_on_how_far_one_looks() {
    let mut scene = Scene::new();
    scene.add_object("coarse", primitives::torus(1.0, 0.45, 14, 9), Material::default());
    scene.add_object("dense", primitives::uv_sphere(0.4, 60, 40), Material::default());
    let camera = Camera::look_at(DVec3::new(0.0, 2.6, 4.6), DVec3::ZERO, DVec3::Y);
    let outputs = Outputs { ids: true, ..Outputs::NONE };
    let settings = RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(192, 144) };
    let frame = render(&scene, &camera, &settings).expect("drawn");
    let picker = Picker::new(&scene, &camera, &frame);
    let (mut close, mut far) = (0, 0);
    for (x, y) in (0..192).step_by(7).flat_map(|x| (0..144).step_by(9).map(move |y| (x, y))) {
        let point = DVec2::new(f64::from(x) + 0.3, f64::from(y) + 0.6);
        for reach in [Reach::Visible, Reach::Through] {
            let found = picker.nearest(point, 20.0, reach);
            // Each smaller circle that holds anything of a kind holds the nearest.
            for radius in [1.5, 3.0, 3.9, 6.0, 12.0] {
                let within = picker.nearest(point, radius, reach);
                for (within, found) in
                    [(within.vertex, found.vertex), (within.edge, found.edge), (within.face, found.face)]
                {
                    assert!(within.is_none() || within == found, "{point}, {radius} pixels, {reach:?}");
                    close += usize::from(within.is_some() && radius < 4.0);
                    far += usize::from(within.is_none() && found.is_some() && radius > 4.0);
                }
            }
        }
    }
    assert!(close > 100 && far > 100, "both happen: {close} and {far}");
}
