//! Lists every primitive that may be visible if vertices are off, also those that the frame itself has dropped.
//!
//! Such a primitive is a [`Contender`], with the bounds of its position. [`Bins`] lists for each tile the contenders
//! that may be visible there.

use super::certificate::Tolerance;
use super::outline::{Outline, area_slack, doubled_area};
use crate::geometry::Shape;
use crate::line::half_size;
use crate::vertex::{DrawVertices, ScreenVertex, nearer};
use crate::view::{DrawPlan, FrameView};
use crate::{BlendMode, Culling, PointShape, Smoothing, clip, ulps};
use trigon_math::{ClipVolume, Fixed, FixedPoint, clip_segment};

/// Everything that may be visible.
pub(super) fn contenders(frame: &FrameView<'_>, tolerance: Tolerance) -> Contenders {
    let volume = clip::volume(frame.grid.viewport);
    let mut contenders = Contenders::default();
    for (number, plan) in frame.plan.draws.iter().enumerate() {
        let mut gather = Gather {
            frame,
            volume: &volume,
            vertices: frame.vertices(number),
            blend_mode: frame.pass[plan.draw()].geometry.blend_mode,
            drift: drift(tolerance.position() * f64::from(frame.supersampling)),
            depth_ulps: tolerance.depth_ulps(),
            contenders: &mut contenders,
        };
        gather.draw(plan);
    }
    contenders
}

/// How far snapped vertices move, in units of the grid, if the positions are off by so
/// many pixels: rounding adds less than one unit, and units are whole.
fn drift(pixels: f64) -> i32 {
    if pixels > 0.0 { (256.0 * pixels).floor() as i32 + 1 } else { 0 }
}

struct Gather<'f> {
    frame: &'f FrameView<'f>,
    volume: &'f ClipVolume,
    vertices: DrawVertices<'f>,
    blend_mode: BlendMode,
    drift: i32,
    depth_ulps: u32,
    contenders: &'f mut Contenders,
}

impl Gather<'_> {
    fn draw(&mut self, plan: &DrawPlan) {
        let supersampling = self.frame.supersampling;
        match self.frame.pass[plan.draw()].geometry.shape {
            Shape::Triangles { triangles, culling, .. } => {
                triangles.iter().for_each(|&indices| self.triangle(indices, culling));
            }
            Shape::Lines { segments, width, smoothing, depth_bias } => {
                let half_width = half_size(width, smoothing, supersampling);
                segments.iter().for_each(|&indices| self.segment(indices, half_width, depth_bias));
            }
            Shape::Points { points, sizes, shape, smoothing, depth_bias } => {
                let half_of = sizes.each(|size| half_size(size, smoothing, supersampling).round() as i32);
                // What covers a share of a sample is never certain.
                let form = (smoothing == Smoothing::Sharp).then_some(shape);
                for (number, &index) in (0..).zip(points) {
                    self.point(index, half_of(number), form, depth_bias);
                }
            }
        }
    }

    fn triangle(&mut self, indices: [u32; 3], culling: Culling) {
        let outcodes = indices.map(|index| self.vertices.outcode(index));
        if outcodes.iter().any(|outcode| outcode.is_invalid()) {
            return;
        }
        let whole = !outcodes.iter().any(|outcode| outcode.cuts());
        let (corners, winding) = if whole { (self.corners(indices), 1) } else { self.cut(indices) };
        if corners.len() < 3 {
            return;
        }
        let area = doubled_area(&corners) * winding;
        let certain = area.abs() > area_slack(&corners, i64::from(self.drift));
        let (is_drawn, is_hidden) = match culling {
            Culling::None => (true, false),
            Culling::Back => (area < 0, certain && area > 0),
            Culling::Front => (area > 0, certain && area < 0),
        };
        if !is_hidden {
            let is_certain = if whole { self.stays_whole(&corners) } else { certain };
            self.push(&corners, is_drawn && is_certain, false);
        }
    }

    /// The corners of a triangle that needs no cutting.
    fn corners(&self, indices: [u32; 3]) -> Vec<Corner> {
        indices.iter().map(|&index| self.corner(*self.vertices.get(index), 0.0)).collect()
    }

    /// What cutting leaves of a triangle, and -1 if it turns it over.
    fn cut(&self, indices: [u32; 3]) -> (Vec<Corner>, i64) {
        let positions = indices.map(|index| self.vertices.position(index));
        let cut = clip::cut_triangle(positions, self.volume);
        let vertices = cut.polygon.vertices().iter();
        let vertices = vertices.filter_map(|v| ScreenVertex::of(v.position, self.frame.grid.viewport));
        (vertices.map(|vertex| self.corner(vertex, 0.0)).collect(), cut.winding)
    }

    /// A line lies around its segment; its exact shape is not examined.
    fn segment(&mut self, indices: [u32; 2], half_width: f64, depth_bias: f32) {
        let outcodes = indices.map(|index| self.vertices.outcode(index));
        if outcodes.iter().any(|outcode| outcode.is_invalid()) {
            return;
        }
        let ends = if outcodes.iter().any(|outcode| outcode.cuts()) {
            let positions = indices.map(|index| self.vertices.position(index));
            let viewport = self.frame.grid.viewport;
            let vertex = |end: trigon_math::ClipVertex<2>| ScreenVertex::of(end.position, viewport);
            clip_segment(positions, self.volume).map(|ends| ends.map(vertex))
        } else {
            Some(indices.map(|index| Some(*self.vertices.get(index))))
        };
        if let Some([Some(a), Some(b)]) = ends {
            let corners = [a, b].map(|end| self.corner(end, depth_bias));
            let drift = self.drift.saturating_add(reach_of_line(half_width));
            let line = Contender { drift, ..self.contender(false, false) };
            self.contenders.push(&corners, line);
        }
    }

    fn point(&mut self, index: u32, half: i32, form: Option<PointShape>, depth_bias: f32) {
        let outcode = self.vertices.outcode(index);
        if outcode.is_invalid() || outcode.cuts() {
            return;
        }
        let center = *self.vertices.get(index);
        let whole = self.stays_whole(&[self.corner(center, 0.0)]);
        let [column, row] = center.raw();
        let corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(|[x, y]| {
            let moved = |raw: i32, by: i32| Fixed::from_raw(raw + by * half);
            self.corner(center.at(FixedPoint::new(moved(column, x), moved(row, y))), depth_bias)
        });
        self.push(&corners, whole && form.is_some(), form == Some(PointShape::Round));
    }

    fn push(&mut self, corners: &[Corner], is_sure: bool, is_disc: bool) {
        let contender = self.contender(is_sure, is_disc);
        self.contenders.push(corners, contender);
    }

    fn contender(&self, is_sure: bool, is_disc: bool) -> Contender {
        // What a plane may come to cut has corners elsewhere, on the same outline.
        let drift = if is_sure { self.drift } else { self.drift + 1 };
        Contender { first: 0, count: 0, drift, blend_mode: self.blend_mode, is_sure, is_disc }
    }

    fn corner(&self, vertex: ScreenVertex, depth_bias: f32) -> Corner {
        let steps = i64::from(self.depth_ulps);
        let at = |steps: i64| nearer(ulps::stepped(vertex.depth(), steps), depth_bias);
        Corner { vertex: vertex.with_depth(at(0)), low: at(-steps), high: at(steps) }
    }

    /// Whether no corner may come to lie beyond a plane that cuts.
    fn stays_whole(&self, corners: &[Corner]) -> bool {
        let viewport = self.frame.grid.viewport;
        let bands = viewport.guard();
        let sides = [viewport.width, viewport.height];
        let within = |vertex: ScreenVertex, axis: usize| {
            // From the middle, in units of the grid.
            let half = 128.0 * f64::from(sides[axis]);
            let offset = f64::from(vertex.raw()[axis]) - half;
            offset.abs() + f64::from(self.drift + 1) < f64::from(bands[axis].factor()) * half
        };
        corners.iter().all(|corner| corner.high <= 1.0 && (0..2).all(|axis| within(corner.vertex, axis)))
    }
}

/// How far a line's corners lie from its ends at most, on each axis, in units of
/// the grid: half its width along, and across that times at most 1 for the slope
/// and the square root of 2 for the cut ends; then they are rounded.
fn reach_of_line(half_width: f64) -> i32 {
    (2.5 * half_width).ceil() as i32 + 1
}

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

/// Numbers of contenders, sorted by tile.
pub(super) struct Bins {
    columns: u32,
    /// (tile, contender), ascending.
    pairs: Vec<(u32, u32)>,
}

impl Bins {
    /// Lists each contender in the tiles that its rectangle overlaps.
    pub(super) fn new(frame: &FrameView<'_>, contenders: &Contenders) -> Self {
        let grid = &frame.grid;
        let sides = [grid.viewport.width, grid.viewport.height].map(|side| side as i32);
        let mut pairs = Vec::new();
        for (number, contender) in contenders.list.iter().enumerate() {
            let extent = extent(contenders.corners_of(contender), contender.drift);
            let [Some(columns), Some(rows)] = extent.map(|range| grid.pattern.pixels_between(range)) else {
                continue;
            };
            if columns[1] < 0 || rows[1] < 0 || columns[0] >= sides[0] || rows[0] >= sides[1] {
                continue;
            }
            let tiles = grid.tiles_that_see(columns, rows);
            for row in tiles.rows {
                pairs
                    .extend(tiles.columns.clone().map(|column| (row * grid.columns + column, number as u32)));
            }
        }
        pairs.sort_unstable();
        Self { columns: grid.columns, pairs }
    }

    /// The contenders of a tile.
    pub(super) fn of(&self, [column, row]: [u32; 2]) -> impl Iterator<Item = &u32> {
        let tile = row * self.columns + column;
        let start = self.pairs.partition_point(|pair| pair.0 < tile);
        let end = self.pairs.partition_point(|pair| pair.0 <= tile);
        self.pairs[start..end].iter().map(|(_, contender)| contender)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapped_places_move_by_less_than_a_unit_more() {
        for (pixels, units) in [(0.0, 0), (1e-9, 1), (1.0 / 512.0, 1), (1.0 / 256.0, 2), (0.01, 3)] {
            assert_eq!(drift(pixels), units, "{pixels} pixels");
            for i in 0..1000 {
                let offset = f64::from(i) * 0.000_37;
                let moved = Fixed::from_f64(offset + pixels).unwrap().raw();
                let by = moved - Fixed::from_f64(offset).unwrap().raw();
                assert!(by <= units, "{offset} by {pixels} pixels moves {by} units");
            }
        }
    }
}
