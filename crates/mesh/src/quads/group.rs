//! Quads among the faces of a mesh.

use fearless_simd::{Level, Simd, dispatch};
use trigon_math::Vec3;

use super::Quads;

/// Quads that are computed at a time.
const LANES: usize = 4;

/// The quads among some faces of a mesh. All are placed before the first of them is computed: a processor
/// waits when it reads several numbers at once that it has just written one by one.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct QuadGroup {
    /// The places of the quads in the list of faces, increasing.
    numbers: Vec<u32>,
    /// Those of the other faces.
    others: Vec<u32>,
    quads: Vec<Quads<LANES>>,
}

impl QuadGroup {
    /// How many faces a group has at most.
    pub const MOST: usize = 256;

    /// Takes the corners of those faces in a list that are quads.
    pub(crate) fn fill(&mut self, faces: impl Iterator<Item = Option<[Vec3; 4]>>) {
        self.numbers.clear();
        self.others.clear();
        for (number, corners) in (0..).zip(faces) {
            // Most faces of most meshes.
            let Some(corners) = corners else {
                self.others.push(number);
                continue;
            };
            let at = self.numbers.len();
            self.numbers.push(number);
            if at / LANES == self.quads.len() {
                self.quads.push(Quads::NONE);
            }
            self.quads[at / LANES].place(at % LANES, corners);
        }
    }

    /// Moves a corner of one of the quads, which are counted without the other faces.
    pub(crate) fn move_corner(&mut self, quad: usize, corner: usize, place: Vec3) {
        self.quads[quad / LANES].move_corner(quad % LANES, corner, place);
    }

    /// The places of the quads in the list of faces, increasing.
    pub(crate) fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// The places of all other faces, increasing.
    pub(crate) fn others(&self) -> &[u32] {
        &self.others
    }

    /// Calls back with the quads, side by side, each with its place in the list of faces. Those without a place are none of
    /// them. What is computed from them uses the widest instructions that the processor has if the closure and all that
    /// it calls is `#[inline(always)]`; it has the same bits with any.
    pub fn for_each(&self, call: impl FnMut(&[u32], &Quads<LANES>)) {
        self.for_each_at(Level::new(), call);
    }

    fn for_each_at(&self, level: Level, mut call: impl FnMut(&[u32], &Quads<LANES>)) {
        dispatch!(level, simd => simd.vectorize(
            #[inline(always)]
            || {
                for (numbers, quads) in self.numbers.chunks(LANES).zip(&self.quads) {
                    call(numbers, quads);
                }
            },
        ));
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::QuadCut;

    /// All that is computed of the quads of a group, but for what kind of no number something is.
    fn computed(group: &QuadGroup, level: Level) -> Vec<(u32, Option<QuadCut>, Vec<u64>)> {
        let mut computed = Vec::new();
        group.for_each_at(
            level,
            #[inline(always)]
            |numbers, quads| {
                let (normals, angles, cuts) = (quads.normals(), quads.angles(), quads.cuts());
                let halves = quads.halves(cuts.map(|cut| cut == Some(QuadCut::First)));
                for (lane, &number) in numbers.iter().enumerate() {
                    let mut values = vec![halves.diagonals[lane]];
                    values.extend(halves.doubled_areas.map(|areas| areas[lane]));
                    values.extend(halves.outer_lengths.map(|lengths| lengths[lane]));
                    values.extend(angles[lane]);
                    values.extend(normals[lane].to_array().map(f64::from));
                    let bits = |value: f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
                    computed.push((number, cuts[lane], values.into_iter().map(bits).collect()));
                }
            },
        );
        computed
    }

    fn levels() -> Vec<Level> {
        let best = Level::new();
        let mut levels = vec![best];
        #[cfg(target_arch = "x86_64")]
        {
            levels.extend(best.as_sse2().map(Level::Sse2));
            levels.extend(best.as_avx2().map(Level::Avx2));
        }
        levels
    }

    proptest! {
        #[test]
        fn every_level_computes_the_same(
            faces in prop::collection::vec(prop::option::weighted(0.8, prop::array::uniform4(
                prop::array::uniform3(prop_oneof![
                    6 => -2.0_f32..2.0,
                    3 => (-1_i8..=1).prop_map(f32::from),
                    1 => prop::sample::select(vec![-0.0, 1e-30, 1e30, f32::NAN, f32::INFINITY]),
                ]),
            )), 1..20),
        ) {
            let faces = faces.iter().map(|corners| corners.map(|corners| corners.map(Vec3::from_array)));
            let mut group = QuadGroup::default();
            group.fill(faces.clone());
            let quads: Vec<u32> = (0..).zip(faces).filter(|(_, quad)| quad.is_some()).map(|(number, _)| number).collect();
            let expected = computed(&group, Level::fallback());
            prop_assert_eq!(expected.iter().map(|quad| quad.0).collect::<Vec<_>>(), quads);
            for level in levels() {
                prop_assert_eq!(&computed(&group, level), &expected, "{:?}", level);
            }
        }
    }
}
