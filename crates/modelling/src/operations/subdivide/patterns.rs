//! How a face is divided, depending on which of its sides are cut. See the table at
//! [`EditMesh::subdivide`](super::EditMesh::subdivide).

use smallvec::{SmallVec, smallvec};

use super::super::parts::fill_strip;
use crate::euler::Parts;

/// A new point within a face: weights of the face's corners, which sum to 1.
pub(super) type Interior = SmallVec<[(usize, f64); 4]>;

/// The points on the sides of a face.
pub(super) struct Outline<'a> {
    /// For each side, which runs from the corner with its number to the next.
    pub(super) is_cut: &'a [bool],
    /// For each corner, its place among the points. The new points on its side follow it.
    pub(super) starts: &'a [u32],
    /// How many new points are on a side that is cut.
    pub(super) cuts: usize,
    /// How many points there are: points within the face get places from here on.
    pub(super) count: u32,
}

impl Outline<'_> {
    fn sides(&self) -> usize {
        self.is_cut.len()
    }

    fn corner(&self, number: usize) -> u32 {
        self.starts[number % self.sides()]
    }

    /// A point on a side that is cut: 0 is its corner, `cuts` + 1 the next corner.
    fn at(&self, side: usize, step: usize) -> u32 {
        let side = side % self.sides();
        if step > self.cuts { self.corner(side + 1) } else { self.starts[side] + step as u32 }
    }

    /// The points of a cut side, both corners included.
    fn row(&self, side: usize) -> Vec<u32> {
        (0..self.cuts + 2).map(|step| self.at(side, step)).collect()
    }

    /// The same from its end to its start.
    fn row_back(&self, side: usize) -> Vec<u32> {
        (0..self.cuts + 2).rev().map(|step| self.at(side, step)).collect()
    }

    /// All points from one corner to another, on the way around.
    fn way(&self, from: usize, to: usize) -> impl Iterator<Item = u32> + '_ {
        let (start, end) = (self.corner(from), self.corner(to));
        let length = if start <= end { end - start } else { end + self.count - start };
        (0..=length).map(move |step| (start + step) % self.count)
    }
}

/// The parts of a face, and the points within it.
#[derive(Default)]
pub(super) struct Pattern {
    pub(super) parts: Parts,
    pub(super) interior: Vec<Interior>,
}

impl Pattern {
    /// Divides a face. `is_convex` says whether the face turns left at a corner.
    pub(super) fn choose(&mut self, outline: &Outline<'_>, is_convex: impl Fn(usize) -> bool) {
        self.parts.clear();
        self.interior.clear();
        let is_cut = outline.is_cut;
        let cut = is_cut.iter().filter(|&&is_cut| is_cut).count();
        let first_cut = is_cut.iter().position(|&is_cut| is_cut).unwrap_or(0);
        let first_whole = is_cut.iter().position(|&is_cut| !is_cut).unwrap_or(0);
        match (outline.sides(), cut) {
            (_, 0) => self.keep_whole(outline),
            (3, 3) => self.triangle_grid(outline),
            // The cut sides meet in the corner opposite to the whole one.
            (3, 2) => self.strip(&outline.row(first_whole + 2), &outline.row_back(first_whole + 1)),
            (3, _) => self.strip(&outline.row(first_cut), &[outline.corner(first_cut + 2)]),
            (4, 4) => self.quad_grid(outline),
            (4, 3) => self.three_sides(outline, first_whole),
            (4, 2) if is_cut[(first_cut + 2) % 4] => {
                self.strip(&outline.row(first_cut), &outline.row_back(first_cut + 2));
            }
            (4, 2) if is_cut[(first_cut + 1) % 4] => self.around_a_corner(outline, first_cut + 1),
            (4, 2) => self.around_a_corner(outline, first_cut),
            (4, _) => {
                let other = [first_cut + 3, first_cut + 2].map(|corner| outline.corner(corner));
                self.strip(&outline.row(first_cut), &other);
            }
            (_, 2) => self.two_sides(outline, first_cut),
            (_, 1) => self.keep_whole(outline),
            _ => self.cut_off_corners(outline, is_convex),
        }
    }

    /// One part, with all points on the sides.
    pub(super) fn keep_whole(&mut self, outline: &Outline<'_>) {
        self.parts.clear();
        self.interior.clear();
        self.parts.push(0..outline.count);
    }

    fn strip(&mut self, row: &[u32], other: &[u32]) {
        fill_strip(row, other, |piece| self.parts.push(piece.iter().copied()));
    }

    fn quad_grid(&mut self, outline: &Outline<'_>) {
        let (cuts, pieces) = (outline.cuts, outline.cuts + 1);
        // u runs along the first side, v along the last one, backwards.
        let at = |u: usize, v: usize| match (u, v) {
            (u, 0) => outline.at(0, u),
            (u, v) if u == pieces => outline.at(1, v),
            (u, v) if v == pieces => outline.at(2, pieces - u),
            (0, v) => outline.at(3, pieces - v),
            _ => outline.count + ((v - 1) * cuts + u - 1) as u32,
        };
        for v in 0..pieces {
            for u in 0..pieces {
                self.parts.push([at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)]);
            }
        }
        for v in 1..pieces {
            for u in 1..pieces {
                let [u, v] = [u, v].map(|step| step as f64 / pieces as f64);
                self.interior.push(bilinear(0, u, v));
            }
        }
    }

    fn triangle_grid(&mut self, outline: &Outline<'_>) {
        let pieces = outline.cuts + 1;
        // How many points within are in the rows before one.
        let before = |row: usize| (1..row).map(|row| pieces - 1 - row).sum::<usize>();
        // u steps from the first corner towards the second, v towards the third.
        let at = |u: usize, v: usize| match (u, v) {
            (u, 0) => outline.at(0, u),
            (u, v) if u + v == pieces => outline.at(1, v),
            (0, v) => outline.at(2, pieces - v),
            _ => outline.count + (before(v) + u - 1) as u32,
        };
        for v in 0..pieces {
            for u in 0..pieces - v {
                self.parts.push([at(u, v), at(u + 1, v), at(u, v + 1)]);
                if u + v + 1 < pieces {
                    self.parts.push([at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)]);
                }
            }
        }
        for v in 1..pieces {
            for u in 1..pieces - v {
                let weights = [pieces - u - v, u, v].map(|steps| steps as f64 / pieces as f64);
                self.interior.push(smallvec![(0, weights[0]), (1, weights[1]), (2, weights[2])]);
            }
        }
    }

    /// A quad, one side of which is whole: strips along it, the last of which has the points of
    /// the opposite side.
    fn three_sides(&mut self, outline: &Outline<'_>, whole: usize) {
        let (right, left) = (outline.row(whole + 1), outline.row_back(whole + 3));
        for step in 0..outline.cuts {
            self.parts.push([left[step], right[step], right[step + 1], left[step + 1]]);
        }
        self.strip(&outline.row(whole + 2), &[right[outline.cuts], left[outline.cuts]]);
    }

    /// A quad whose sides before and after a corner are cut: quads around points on the diagonal
    /// from there.
    fn around_a_corner(&mut self, outline: &Outline<'_>, corner: usize) {
        let (ahead, back) = (outline.row(corner), outline.row_back(corner + 3));
        let (cuts, pieces) = (outline.cuts, outline.cuts + 1);
        let inner = |step: usize| if step == 0 { ahead[0] } else { outline.count + step as u32 - 1 };
        self.parts.push([ahead[0], ahead[1], inner(1), back[1]]);
        for step in 1..cuts {
            self.parts.push([ahead[step], ahead[step + 1], inner(step + 1), inner(step)]);
            self.parts.push([inner(step), inner(step + 1), back[step + 1], back[step]]);
        }
        let opposite = outline.corner(corner + 2);
        self.parts.push([ahead[cuts], ahead[pieces], opposite, inner(cuts)]);
        self.parts.push([inner(cuts), opposite, back[pieces], back[cuts]]);
        for step in 1..pieces {
            let t = step as f64 / pieces as f64;
            self.interior.push(bilinear(corner, t, t));
        }
    }

    /// A face of more than four sides, two of which are cut: strips between these.
    fn two_sides(&mut self, outline: &Outline<'_>, first: usize) {
        let sides = outline.sides();
        let second = (first + 1..sides).find(|&side| outline.is_cut[side]).expect("two are cut");
        let cuts = outline.cuts;
        let mut band = |ahead: &[u32], back: &[u32]| {
            for step in 1..cuts {
                self.parts.push([ahead[step], ahead[step + 1], back[step + 1], back[step]]);
            }
        };
        // From `ahead`'s end around to `back`'s end is the rest.
        let (corner, ahead, back) = if second == first + 1 {
            (Some(second), outline.row(second), outline.row_back(first))
        } else if first == 0 && second == sides - 1 {
            (Some(0), outline.row(0), outline.row_back(second))
        } else {
            (None, outline.row(first), outline.row_back(second))
        };
        band(&ahead, &back);
        let Some(corner) = corner else {
            let ends = [ahead[1], back[1]];
            self.parts.push(outline.way(second + 1, first).chain(ends));
            let middle = outline.way(first + 1, second);
            self.parts.push(std::iter::once(ahead[cuts]).chain(middle).chain([back[cuts]]));
            return;
        };
        self.parts.push([ahead[0], ahead[1], back[1]]);
        let rest = outline.way(corner + 1, corner + sides - 1);
        self.parts.push(std::iter::once(ahead[cuts]).chain(rest).chain([back[cuts]]));
    }

    /// Cuts off each convex corner between two cut sides, at the points next to it.
    fn cut_off_corners(&mut self, outline: &Outline<'_>, is_convex: impl Fn(usize) -> bool) {
        let sides = outline.sides();
        let before = |corner: usize| (corner + sides - 1) % sides;
        let is_cut_off =
            |&corner: &usize| outline.is_cut[corner] && outline.is_cut[before(corner)] && is_convex(corner);
        let corners: Vec<usize> = (0..sides).filter(is_cut_off).collect();
        let gone: Vec<u32> = corners.iter().map(|&corner| outline.corner(corner)).collect();
        self.parts.push((0..outline.count).filter(|index| gone.binary_search(index).is_err()));
        for corner in corners {
            let last = outline.at(before(corner), outline.cuts);
            self.parts.push([outline.corner(corner), outline.at(corner, 1), last]);
        }
    }
}

/// A point in a quad: u from a corner towards the next one, v towards the one before.
fn bilinear(corner: usize, u: f64, v: f64) -> Interior {
    let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
    weights.into_iter().enumerate().map(|(i, weight)| ((corner + i) % 4, weight)).collect()
}
