//! A contender: a primitive that may be visible, with the bounds of its position.

use super::outline::Outline;
use crate::BlendMode;
use crate::vertex::ScreenVertex;

/// A corner of a primitive's outline on the screen.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub(super) vertex: ScreenVertex,
    /// The range of its depth.
    pub(super) low: f32,
    pub(super) high: f32,
}

/// A primitive that may be visible: a closed outline, each corner of which may be displaced.
#[derive(Clone, Copy)]
pub(super) struct Contender {
    /// Its corners among those of all.
    pub(super) first: u32,
    pub(super) count: u32,
    /// How far the corners may be off on each axis, in units of the grid.
    pub(super) drift: i32,
    pub(super) blend_mode: BlendMode,
    /// Whether it is certainly drawn. If not, it may hide something, but is never itself certain.
    pub(super) is_sure: bool,
    /// Whether only the disc in its square is drawn.
    pub(super) is_disc: bool,
}

/// All of a frame.
#[derive(Default)]
pub(super) struct Contenders {
    pub(super) list: Vec<Contender>,
    pub(super) corners: Vec<Corner>,
}

impl Contenders {
    pub(super) fn push(&mut self, corners: &[Corner], contender: Contender) {
        let (first, count) = (self.corners.len() as u32, corners.len() as u32);
        self.corners.extend_from_slice(corners);
        self.list.push(Contender { first, count, ..contender });
    }

    pub(super) fn corners_of(&self, contender: &Contender) -> &[Corner] {
        &self.corners[contender.first as usize..(contender.first + contender.count) as usize]
    }

    /// What can be said of the contender with this number at any sample.
    pub(super) fn outline(&self, number: usize) -> Outline {
        let contender = self.list[number];
        Outline::new(contender, self.corners_of(&contender))
    }
}

/// The smallest rectangle around corners that may be off, by axis, in units of
/// the grid.
pub(super) fn extent(corners: &[Corner], drift: i32) -> [[i32; 2]; 2] {
    [0, 1].map(|axis| {
        let coordinates = || corners.iter().map(|corner| corner.vertex.raw()[axis]);
        let least = coordinates().min().unwrap_or(0);
        let greatest = coordinates().max().unwrap_or(0);
        [least.saturating_sub(drift), greatest.saturating_add(drift)]
    })
}
