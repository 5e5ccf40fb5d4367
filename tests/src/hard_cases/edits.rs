//! Edits that should lead back to where they began.

use std::f64::consts::PI;

use proptest::prelude::*;
use trigon_math::{DAffine3, DQuat, DVec3, SplitMix64, elementary};
use trigon_mesh::{Mesh, primitives};
use trigon_scene::Transform;

use crate::effort::cases;

const DEGREE: f64 = PI / 180.0;

/// Rounding unit of f64.
const UNIT: f64 = f64::EPSILON / 2.0;

fn axis() -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-1.0..1.0_f64)
        .prop_map(DVec3::from_array)
        .prop_filter("has a direction", |axis| axis.length() > 0.1)
}

proptest! {
    #![proptest_config(cases(64))]

    /// A step is a product of two unit quaternions: sine and cosine are off by a unit in
    /// the last place each, the axis by three, the four terms of each entry by four, and
    /// its new length by three; together less than 16 roundings of a whole. 360 steps
    /// add up at most that often, and turn a corner by twice the angle.
    #[test]
    fn a_node_turned_by_a_degree_360_times_is_back(axis in axis(), start in prop::array::uniform4(-1.0..1.0_f64)) {
        let [x, y, z, w] = start;
        let start = DQuat::from_xyzw(x, y, z, w + 2.0);
        let mut transform = Transform::from_scale_rotation_translation(DVec3::ONE, start, DVec3::ZERO);
        let before = transform.to_affine();
        for _ in 0..360 {
            transform.rotate(axis, DEGREE);
        }
        let after = transform.to_affine();
        for corner in DVec3::AXES {
            let miss = after.transform_point3(corner).distance(before.transform_point3(corner));
            prop_assert!(miss <= 2.0 * 16.0 * 360.0 * UNIT, "{} came back {} away", corner, miss);
        }
        let Transform::Decomposed { rotation, .. } = transform else { panic!("a turn keeps the kind") };
        // Root, quotient and the sum of squares.
        prop_assert!((rotation.length() - 1.0).abs() <= 4.0 * UNIT, "|q| = {}", rotation.length());
    }

    /// Baked into vertices each step rounds each coordinate to f32 once: by half a unit in
    /// the last place, and that is all that is lost on the way.
    #[test]
    fn a_mesh_turned_by_a_degree_360_times_is_back(axis in axis()) {
        let before = primitives::cube(2.0);
        let mut mesh = before.clone();
        let (sin, cos) = elementary::sin_cos(DEGREE / 2.0);
        let half = axis.normalize() * sin;
        let turn = DAffine3::from_quat(DQuat::from_xyzw(half.x, half.y, half.z, cos));
        for _ in 0..360 {
            let old: Vec<DVec3> = mesh.positions().iter().map(|place| turn.transform_point3(place.as_dvec3())).collect();
            mesh.transform(&turn);
            for (exact, new) in old.iter().zip(mesh.positions()) {
                // Sums of four terms below 2 in f64, and half a unit of f32.
                let bound = exact.abs() / f64::from(1 << 24) + DVec3::splat(8.0 * UNIT);
                prop_assert!((new.as_dvec3() - *exact).abs().cmple(bound).all(), "{} instead of {}", new, exact);
            }
        }
        // Half a unit of coordinates below 2 is at most 2^-24, for each of three
        // coordinates at each step; the f64 in between is worth less than a hundredth.
        let bound = 1.01 * 360.0 * 3.0_f64.sqrt() / f64::from(1 << 24);
        for (old, new) in before.positions().iter().zip(mesh.positions()) {
            let miss = new.as_dvec3().distance(old.as_dvec3());
            prop_assert!(miss <= bound, "{} came back {} away", old, miss);
        }
        prop_assert!(mesh.corner_vertices() == before.corner_vertices(), "still closed: the same faces");
    }

    /// What has an exact inverse in binary comes back to the bit, however often: scales
    /// by powers of two and mirrors.
    #[test]
    fn exact_edits_undone_in_reverse_give_the_first_mesh_back(edits in edits(40)) {
        let before = knot();
        let mut mesh = before.clone();
        edits.iter().for_each(|edit| mesh.transform(&edit.forth()));
        edits.iter().rev().for_each(|edit| mesh.transform(&edit.back()));
        prop_assert!(is_same(&mesh, &before), "it differs from the first");
    }
}

proptest! {
    // Each case is ten thousand edits.
    #![proptest_config(cases(4))]

    /// Any way to and fro through a history, 10,000 edits long, leads to the meshes of
    /// the first way there, and in the end to the first mesh: nothing piles up.
    #[test]
    fn edits_undone_and_redone_ten_thousand_times_give_the_same_meshes_to_the_bit(
        edits in edits(16),
        seed: u64,
    ) {
        let mut history = vec![knot()];
        for edit in &edits {
            history.push(history[history.len() - 1].transformed(&edit.forth()));
        }
        let (mut at, mut count) = (edits.len(), 0);
        let mut mesh = history[at].clone();
        let mut random = SplitMix64::new(seed);
        while count < 10_000 || at > 0 {
            let to = if count < 10_000 { random.below(history.len()) } else { 0 };
            edits[to.min(at)..at].iter().rev().for_each(|edit| mesh.transform(&edit.back()));
            edits[at.min(to)..to].iter().for_each(|edit| mesh.transform(&edit.forth()));
            count += at.abs_diff(to);
            at = to;
            prop_assert!(is_same(&mesh, &history[at]), "mesh {} differs after {} edits", at, count);
        }
    }
}

/// A scale along an axis by a power of two, and perhaps a mirror.
#[derive(Debug, Clone)]
struct Edit {
    axis: usize,
    power: i32,
    mirrors: bool,
}

impl Edit {
    fn forth(&self) -> DAffine3 {
        self.map(self.power)
    }

    fn back(&self) -> DAffine3 {
        self.map(-self.power)
    }

    fn map(&self, power: i32) -> DAffine3 {
        let mut scale = DVec3::ONE;
        scale[self.axis] = elementary::exp2(f64::from(power)) * if self.mirrors { -1.0 } else { 1.0 };
        DAffine3::from_scale(scale)
    }
}

fn edits(most: usize) -> impl Strategy<Value = Vec<Edit>> {
    let edit = (0..3_usize, -2..=2_i32, any::<bool>());
    prop::collection::vec(edit.prop_map(|(axis, power, mirrors)| Edit { axis, power, mirrors }), 1..most)
}

fn knot() -> Mesh {
    primitives::torus_knot(&primitives::TorusKnot { segments: 12, sides: 4, ..Default::default() })
}

/// In positions and faces. (Normals are made of unit length again at each step, which
/// rounds.)
fn is_same(a: &Mesh, b: &Mesh) -> bool {
    a.positions() == b.positions() && a.corner_vertices() == b.corner_vertices()
}
