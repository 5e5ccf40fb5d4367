//! The fragments of some layers, one for each triangle and pixel, sorted by triangle, as shading needs them.

use super::runs::Layer;
use crate::fragments::{Job, ShadePoint};

/// Fragments that are to be shaded.
#[derive(Default)]
pub(super) struct Fragments {
    /// Triangle and pixel of each, in the order of the colours.
    listed: Vec<(u32, u32)>,
    /// For each triangle the last fragment that was listed.
    latest: Vec<u32>,
    /// For each triangle how many fragments it has; then where its next one goes.
    counts: Vec<u32>,
    pub(super) jobs: Vec<Job>,
    pub(super) points: Vec<ShadePoint>,
}

impl Fragments {
    /// Empties the list for a tile with this many triangles.
    pub(super) fn reset(&mut self, triangle_count: usize) {
        self.listed.clear();
        self.counts.clear();
        self.counts.resize(triangle_count, 0);
        if self.latest.len() < triangle_count {
            self.latest.resize(triangle_count, 0);
        }
    }

    /// Gives layers of a pixel's samples their colours' numbers; `first` is that of
    /// the pixel's first colour.
    #[inline(always)]
    pub(super) fn name(&mut self, pixel: usize, first: usize, layers: &mut [Layer]) {
        for layer in layers {
            let triangle = layer.triangle as usize;
            let latest = self.latest[triangle] as usize;
            // Another sample of the pixel may have named it already.
            let named = latest >= first && self.listed.get(latest).is_some_and(|at| at.0 == layer.triangle);
            layer.color = if named { latest as u32 } else { self.list(pixel, layer.triangle) };
        }
    }

    #[inline(always)]
    fn list(&mut self, pixel: usize, triangle: u32) -> u32 {
        let color = self.listed.len() as u32;
        self.listed.push((triangle, pixel as u32));
        self.latest[triangle as usize] = color;
        self.counts[triangle as usize] += 1;
        color
    }

    /// How many are listed.
    pub(super) fn len(&self) -> usize {
        self.listed.len()
    }

    /// Sorts them by triangle, by counting.
    pub(super) fn sort(&mut self, partly: bool) {
        self.jobs.clear();
        let mut start = 0;
        for (triangle, count) in self.counts.iter_mut().enumerate().filter(|(_, count)| **count > 0) {
            let end = start + *count as usize;
            self.jobs.push(Job { triangle: triangle as u32, points: start..end });
            *count = start as u32;
            start = end;
        }
        if self.points.len() < start {
            self.points.resize(start, ShadePoint::default());
        }
        for (color, &(triangle, pixel)) in self.listed.iter().enumerate() {
            let next = &mut self.counts[triangle as usize];
            self.points[*next as usize] = ShadePoint::anywhere(pixel as usize, partly, color);
            *next += 1;
        }
    }
}
