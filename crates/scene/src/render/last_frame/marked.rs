//! Finds the primitives whose marks differ from those of the last image.

use std::sync::Arc;

use fixedbitset::FixedBitSet;
use rayon::prelude::*;
use trigon_math::Vec4;
use trigon_raster::MarkColors;

use crate::elements;
use crate::elements::Marks;
use crate::render::record::{DrawSource, MarkNumbers, Marked, WireNumbers};

/// The colours of marks, by their numbers.
#[derive(Clone, PartialEq)]
pub(super) struct MarkPalette {
    edges: [Vec4; MarkColors::COUNT],
    faces: [Vec4; MarkColors::COUNT],
    vertices: [Vec4; MarkColors::COUNT],
    outlined: [bool; MarkColors::COUNT],
}

impl MarkPalette {
    pub(super) fn new(marks: &Marks) -> Self {
        let MarkColors { edges, faces, outlined } = marks.colors();
        Self { edges, faces, vertices: elements::colors(&marks.vertices), outlined }
    }
}

/// The marks of a draw's primitives.
#[derive(PartialEq)]
pub(super) enum MarkOrigin {
    Faces(Option<Arc<MarkNumbers>>),
    Wires { numbers: Arc<Vec<u8>>, points: Option<Arc<Vec<u32>>>, large: Option<Arc<FixedBitSet>> },
}

/// Primitives whose marks have changed; increasing.
#[derive(Default)]
pub(super) struct MarkedPrimitives {
    pub(super) recolored: Vec<u32>,
    pub(super) resized: Vec<u32>,
}

impl MarkOrigin {
    pub(super) fn new(marked: &Marked<'_>) -> Self {
        match *marked {
            Marked::Faces(marks) => Self::Faces(marks.map(|marks| Arc::clone(&marks.numbers))),
            Marked::Wires(WireNumbers { numbers, points, large }) => {
                Self::Wires { numbers: Arc::clone(numbers), points: points.cloned(), large: large.cloned() }
            }
        }
    }

    /// The primitives of a draw whose marks have changed; `None` if that is unknown.
    pub(super) fn difference(&self, now: &Self, source: &DrawSource<'_>) -> Option<MarkedPrimitives> {
        match (self, now) {
            (Self::Faces(before), Self::Faces(now)) => {
                let recolored = triangles([before, now].map(Option::as_deref), source)?;
                Some(MarkedPrimitives { recolored, resized: Vec::new() })
            }
            (
                Self::Wires { numbers, points, large },
                Self::Wires { numbers: now, points: points_now, large: large_now },
            ) if points == points_now => Some(MarkedPrimitives {
                recolored: differing(numbers, now),
                resized: differing_bits(large.as_deref(), large_now.as_deref()),
            }),
            _ => None,
        }
    }
}

/// The elements in which two sets differ.
fn differing_bits(before: Option<&FixedBitSet>, now: Option<&FixedBitSet>) -> Vec<u32> {
    let none = FixedBitSet::new();
    let [before, now] = [before, now].map(|set| set.unwrap_or(&none));
    before.symmetric_difference(now).map(|bit| bit as u32).collect()
}

/// Triangles that a thread takes at a time.
const SHARE: usize = 1 << 14;

/// The triangles of a draw whose faces or sides have changed marks.
fn triangles(marks: [Option<&MarkNumbers>; 2], source: &DrawSource<'_>) -> Option<Vec<u32>> {
    let numbers = |of: fn(&MarkNumbers) -> &Vec<u8>| {
        let [before, now] = marks.map(|marks| marks.map_or(&[][..], |marks| of(marks)));
        Elements::new(&differing(before, now))
    };
    let (edges, faces) = rayon::join(|| numbers(|marks| &marks.edges), || numbers(|marks| &marks.faces));
    if edges.is_none() && faces.is_none() {
        return Some(Vec::new());
    }
    let range = source.triangles.clone();
    let sides = match &source.marked {
        _ if edges.is_none() => &[][..],
        Marked::Faces(Some(marks)) if !marks.sides.is_empty() => marks.sides,
        _ => &source.geometry.sides_if_known()?[range.clone()],
    };
    let own = |triangle: usize| source.geometry.face(range.start + triangle);
    let is_other = |triangle: &usize| {
        faces.as_ref().is_some_and(|faces| faces.has(own(*triangle)))
            || edges.as_ref().is_some_and(|edges| sides[*triangle].iter().any(|&side| edges.has(side)))
    };
    let starts: Vec<usize> = (0..range.len()).step_by(SHARE).collect();
    let shares = starts.into_par_iter().map(|start| {
        let share = start..range.len().min(start + SHARE);
        share.filter(is_other).map(|triangle| triangle as u32).collect::<Vec<u32>>()
    });
    Some(shares.collect::<Vec<_>>().concat())
}

/// Some elements of a mesh.
struct Elements {
    least: u32,
    bits: FixedBitSet,
}

impl Elements {
    /// Those listed, increasing; `None` if there are none.
    fn new(listed: &[u32]) -> Option<Self> {
        let (&least, &greatest) = (listed.first()?, listed.last()?);
        let mut bits = FixedBitSet::with_capacity((greatest - least) as usize + 1);
        bits.extend(listed.iter().map(|element| (element - least) as usize));
        Some(Self { least, bits })
    }

    #[inline]
    fn has(&self, element: u32) -> bool {
        // Elements before the first wrap around to numbers beyond the last.
        self.bits.contains(element.wrapping_sub(self.least) as usize)
    }
}

/// The positions at which two lists of marks differ; missing entries have no marks.
fn differing(before: &[u8], now: &[u8]) -> Vec<u32> {
    /// Marks that are compared together.
    const BLOCK: usize = 256;
    let mut listed = Vec::new();
    // Mostly both frames share one list.
    if std::ptr::eq(before, now) {
        return listed;
    }
    let common = before.len().min(now.len());
    let blocks = before[..common].chunks(BLOCK).zip(now[..common].chunks(BLOCK));
    for ((before, now), first) in blocks.zip((0..).step_by(BLOCK)) {
        if before != now {
            let pairs = (first..).zip(before.iter().zip(now));
            listed.extend(pairs.filter(|(_, (before, now))| before != now).map(|(index, _)| index));
        }
    }
    let rest = if before.len() > common { &before[common..] } else { &now[common..] };
    listed.extend((common as u32..).zip(rest).filter(|&(_, &mark)| mark != 0).map(|(index, _)| index));
    listed
}
