//! Whether a layout turns no triangle over and overlaps nowhere.
//!
//! If no triangle of a disc with holes is turned over and its border does not cross itself, its layout overlaps
//! nowhere: around each point the border then turns once or not at all, and each triangle counts as one turn.

use trigon_math::{DVec2, Orientation, orientation};

use super::charts::UvChart;

/// How many triangles are turned over or have no area; decided without rounding.
pub(super) fn turned_over(chart: &UvChart, layout: &[DVec2]) -> usize {
    let is_wrong = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| layout[vertex as usize]);
        orientation(a, b, c) != Orientation::CounterClockwise
    };
    chart.triangles.iter().filter(is_wrong).count()
}

/// Whether no triangle is turned over and the border does not cross itself.
pub(super) fn is_injective(chart: &UvChart, layout: &[DVec2]) -> bool {
    turned_over(chart, layout) == 0 && !border_crosses_itself(chart, layout)
}

/// An edge of the border in the layout.
#[derive(Clone, Copy)]
struct Segment {
    vertices: [u32; 2],
    from: DVec2,
    to: DVec2,
}

impl Segment {
    fn low(&self) -> DVec2 {
        self.from.min(self.to)
    }

    fn high(&self) -> DVec2 {
        self.from.max(self.to)
    }

    /// The signed distances of another's ends from its line.
    fn distances(&self, other: &Self) -> [f64; 2] {
        let along = self.to - self.from;
        let length = along.length();
        [other.from, other.to].map(|point| along.perp_dot(point - self.from) / length)
    }

    /// Whether two cross each other by more than a distance. Those that only touch do not: the two sides of a seam
    /// that ends within a flat surface lie on each other.
    fn crosses(&self, other: &Self, by: f64) -> bool {
        let lies_on_both_sides = |[a, b]: [f64; 2]| (a > by && b < -by) || (a < -by && b > by);
        let is_connected = other.vertices.iter().any(|vertex| self.vertices.contains(vertex));
        !is_connected
            && lies_on_both_sides(self.distances(other))
            && lies_on_both_sides(other.distances(self))
    }
}

fn border_crosses_itself(chart: &UvChart, layout: &[DVec2]) -> bool {
    let segment = |vertices: [u32; 2]| {
        let [from, to] = vertices.map(|vertex| layout[vertex as usize]);
        Segment { vertices, from, to }
    };
    let mut segments: Vec<Segment> = chart.border_edges().map(segment).collect();
    let Some(first) = segments.first() else { return false };
    let (mut low, mut high) = (first.low(), first.high());
    for segment in &segments {
        (low, high) = (low.min(segment.low()), high.max(segment.high()));
    }
    /// In relation to the size of the layout: more than its rounding, less than a texel.
    const LEAST_CROSSING: f64 = 1e-7;
    let size = high - low;
    let by = LEAST_CROSSING * size.max_element();
    // Along the longer side fewer of them lie beside one another.
    if size.y > size.x {
        for segment in &mut segments {
            (segment.from, segment.to) = (segment.from.perp(), segment.to.perp());
        }
    }
    segments.sort_by(|a, b| a.low().x.total_cmp(&b.low().x));
    let mut beside: Vec<Segment> = Vec::new();
    for segment in segments {
        beside.retain(|other| other.high().x >= segment.low().x);
        if beside.iter().any(|other| overlaps_in_y(other, &segment) && other.crosses(&segment, by)) {
            return true;
        }
        beside.push(segment);
    }
    false
}

fn overlaps_in_y(a: &Segment, b: &Segment) -> bool {
    a.low().y <= b.high().y && b.low().y <= a.high().y
}
