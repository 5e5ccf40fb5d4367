//! Triangles around a layout in a circle: as long as none of them is turned over, the border cannot cross itself.
//!
//! Z. Jiang, S. Schaefer and D. Panozzo, *Simplicial Complex Augmentation Framework for Bijective Maps*, 2017. A disc around
//! the chart and its holes are filled with triangles. They take part in each step with the shape that they have before
//! it and a small weight, so that they give way. Between some of the steps their edges are turned until they are a Delaunay
//! triangulation again (C. Lawson, *Software for C¹ Surface Interpolation*, 1977), where the paper fills the disc anew.

use std::collections::BTreeMap;

use trigon_math::{DVec2, Orientation, elementary, orientation};

use super::charts::UvChart;
use super::convex::longest_loop;
use super::factor::NoFactor;
use super::injective::turned_over;
use super::stretch::{
    Model, StretchTriangle, System, energy_of, is_little, minimize_stretch, scale_to_least, step,
};

/// After so many steps the edges of the triangles around a chart are turned, or after one that gains little. As long as
/// they are the same, the matrix has the same pattern. Turned before each step, they do not lead to less stretch.
const STEPS_BETWEEN_TURNS: u32 = 2;

/// The weight of all triangles around a chart together, in parts of the chart's energy.
const WEIGHT: f64 = 0.01;

/// Changes a layout of which the border is a circle around the origin, in at most `iterations` steps that make stretch
/// less. There [`minimize_stretch`] would soon stop, where the border is about to cross itself.
pub(super) fn minimize_stretch_from_circle(
    chart: &UvChart,
    layout: &mut Vec<DVec2>,
    iterations: u32,
    memory: u64,
) -> Result<(), NoFactor> {
    if iterations == 0 || turned_over(chart, layout) > 0 {
        return Ok(());
    }
    let surface = StretchTriangle::of_chart(chart);
    scale_to_least(&surface, layout);
    let count = layout.len();
    let Some(scaffold) = Scaffold::around(chart, layout) else {
        layout.truncate(count);
        return minimize_stretch(chart, layout, iterations, memory);
    };
    step_with(scaffold, surface, layout, iterations, memory)?;
    layout.truncate(count);
    Ok(())
}

/// Steps of a chart with the triangles around it.
struct ScaffoldSteps {
    scaffold: Scaffold,
    /// Those of the chart, then those around it.
    triangles: Vec<StretchTriangle>,
    /// How many of them are the chart's.
    count: usize,
    /// The chart's area.
    area: f64,
    /// The equations of the last step, if the triangles are still the same.
    system: Option<System>,
    energy: f64,
    gain: f64,
}

fn step_with(
    scaffold: Scaffold,
    surface: Vec<StretchTriangle>,
    layout: &mut Vec<DVec2>,
    iterations: u32,
    memory: u64,
) -> Result<(), NoFactor> {
    let mut steps = ScaffoldSteps::new(scaffold, surface, layout);
    let mut age = STEPS_BETWEEN_TURNS;
    for _ in 0..iterations {
        let is_new = age >= STEPS_BETWEEN_TURNS;
        if is_new {
            steps.renew(layout);
            age = 0;
        }
        let gains = steps.step(layout, memory)?;
        if is_new && !gains {
            break;
        }
        age = if gains { age + 1 } else { STEPS_BETWEEN_TURNS };
    }
    Ok(())
}

impl ScaffoldSteps {
    fn new(scaffold: Scaffold, surface: Vec<StretchTriangle>, layout: &[DVec2]) -> Self {
        let area = surface.iter().map(|triangle| triangle.area).sum();
        let (count, energy) = (surface.len(), energy_of(&surface, layout));
        Self { scaffold, triangles: surface, count, area, system: None, energy, gain: f64::INFINITY }
    }

    fn renew(&mut self, layout: &mut [DVec2]) {
        if self.scaffold.renew(layout) {
            self.system = None;
        }
    }

    /// Makes a step; whether it gains more than a little.
    fn step(&mut self, layout: &mut Vec<DVec2>, memory: u64) -> Result<bool, NoFactor> {
        self.triangles.truncate(self.count);
        let weight = WEIGHT * self.energy * self.area / self.scaffold.triangles.len() as f64;
        let at_rest = |vertices: &[u32; 3]| StretchTriangle::at_rest(*vertices, layout, weight);
        self.triangles.extend(self.scaffold.triangles.iter().map(at_rest));
        let triangles = &self.triangles;
        let system = match self.system.take() {
            Some(system) => system,
            None => System::new(layout.len(), &self.scaffold.outermost, triangles, memory)?,
        };
        let offsets = match system.offsets(triangles, layout, Model::at(self.energy, self.gain)) {
            Err(NoFactor::NotPositive) => return Ok(false),
            offsets => offsets?,
        };
        self.system = Some(system);
        let is_allowed = |layout: &[DVec2]| triangles.iter().all(|triangle| triangle.is_right(layout));
        let Some(step) = step(triangles, layout, &offsets, is_allowed) else { return Ok(false) };
        *layout = step.layout;
        let next = energy_of(&triangles[..self.count], layout);
        (self.gain, self.energy) = (self.energy - next, next);
        Ok(!is_little(self.gain, self.energy))
    }
}

/// Triangles around a chart.
struct Scaffold {
    triangles: Vec<[u32; 3]>,
    /// By the ends of a side: the triangle on its left.
    by_side: BTreeMap<[u32; 2], u32>,
    /// The vertices of the outermost ring, in ascending order: they stay where they are.
    outermost: Vec<u32>,
    /// The first vertex that does not belong to the chart; the others follow.
    first: u32,
}

/// Vertices of a ring have as many in the next one as they have, halved, but not fewer.
const LEAST_RING: u32 = 8;

impl Scaffold {
    /// Adds vertices around a layout of which the border is a circle around the origin, and in its holes. `None` if
    /// triangles are turned over: the border has too few edges.
    fn around(chart: &UvChart, layout: &mut Vec<DVec2>) -> Option<Self> {
        let first = layout.len() as u32;
        let outer = longest_loop(chart);
        let mut scaffold =
            Self { triangles: Vec::new(), by_side: BTreeMap::new(), outermost: Vec::new(), first };
        for (i, border) in chart.loops.iter().enumerate() {
            // Between two edges with the same ends there is nothing to fill.
            if i != outer && border.len() > 2 {
                scaffold.fill_hole(border, layout);
            }
        }
        scaffold.add_rings(&chart.loops[outer], layout);
        for (index, triangle) in (0..).zip(&scaffold.triangles) {
            scaffold.by_side.extend(sides(triangle).map(|side| (side, index)));
        }
        let is_right = |triangle: &[u32; 3]| is_counter_clockwise(triangle, layout);
        scaffold.triangles.iter().all(is_right).then_some(scaffold)
    }

    fn fill_hole(&mut self, border: &[u32], layout: &mut Vec<DVec2>) {
        let sum: DVec2 = border.iter().map(|&vertex| layout[vertex as usize]).sum();
        let middle = layout.len() as u32;
        layout.push(sum / border.len() as f64);
        // The border has the surface on its left.
        self.triangles.extend(sides(border).map(|[from, to]| [to, from, middle]));
    }

    /// Rings of vertices around a circle, up to one in which the chart has room whatever its shape.
    fn add_rings(&mut self, border: &[u32], layout: &mut Vec<DVec2>) {
        let mut inner: Vec<u32> = border.to_vec();
        let mut radius = layout[border[0] as usize].length();
        // Half the length of the border: from one end of a chart that is laid out free to the other one.
        let end = radius * std::f64::consts::PI;
        while radius < end {
            let count = (inner.len() as u32 / 2).max(LEAST_RING);
            radius *= 1.0 + std::f64::consts::TAU / f64::from(count);
            let start = layout.len() as u32;
            layout.extend((0..count).map(|i| {
                let (sin, cos) = elementary::sin_cos(std::f64::consts::TAU * f64::from(i) / f64::from(count));
                DVec2::new(cos, sin) * radius
            }));
            let ring: Vec<u32> = (start..start + count).collect();
            self.join_rings(&inner, &ring, layout);
            inner = ring;
        }
        self.outermost = inner;
    }

    /// Triangles between two rings that both run counter-clockwise, from the angle 0 on.
    fn join_rings(&mut self, inner: &[u32], outer: &[u32], layout: &[DVec2]) {
        let (mut i, mut o) = (0, 0);
        let vertex = |ring: &[u32], at: usize| ring[at % ring.len()];
        let angle = |ring: &[u32], at: usize| {
            if at >= ring.len() { std::f64::consts::TAU } else { turn_of(layout[ring[at] as usize]) }
        };
        while i < inner.len() || o < outer.len() {
            let (a, b) = (vertex(inner, i), vertex(outer, o));
            let is_inner_next = o == outer.len()
                || i < inner.len()
                    && angle(inner, i) + angle(inner, i + 1) <= angle(outer, o) + angle(outer, o + 1);
            if is_inner_next {
                i += 1;
                self.triangles.push([vertex(inner, i), a, b]);
            } else {
                o += 1;
                self.triangles.push([b, vertex(outer, o), a]);
            }
        }
    }

    /// Moves vertices to the middle of their neighbours where that turns no triangle over, and turns edges until no
    /// triangle has another's vertex in its circumcircle. Whether any edge was turned.
    fn renew(&mut self, layout: &mut [DVec2]) -> bool {
        self.smooth(layout);
        self.turn_edges(layout) > 0
    }

    /// Returns how many edges were turned.
    fn turn_edges(&mut self, layout: &[DVec2]) -> usize {
        let mut count = 0;
        let mut waiting: Vec<[u32; 2]> = self.by_side.keys().copied().filter(|[a, b]| a < b).collect();
        // Rounding could turn edges without end.
        let most = 20 * waiting.len();
        while let Some([a, b]) = waiting.pop() {
            let (Some(&one), Some(&other)) = (self.by_side.get(&[a, b]), self.by_side.get(&[b, a])) else {
                continue;
            };
            let (c, d) = (self.opposite(one, [a, b]), self.opposite(other, [a, b]));
            let turned = [[c, d, b], [d, c, a]];
            let is_better = count < most
                && is_in_circle([a, b, c, d].map(|vertex| layout[vertex as usize]))
                && turned.iter().all(|triangle| is_counter_clockwise(triangle, layout));
            if !is_better {
                continue;
            }
            count += 1;
            self.by_side.remove(&[a, b]);
            self.by_side.remove(&[b, a]);
            for (index, triangle) in [one, other].into_iter().zip(turned) {
                self.triangles[index as usize] = triangle;
                self.by_side.extend(sides(&triangle).map(|side| (side, index)));
            }
            waiting.extend([[b, c], [c, a], [a, d], [d, b]]);
        }
        count
    }

    /// The vertex of a triangle that is not one of two.
    fn opposite(&self, triangle: u32, ends: [u32; 2]) -> u32 {
        let corners = self.triangles[triangle as usize];
        corners.into_iter().find(|corner| !ends.contains(corner)).unwrap_or(corners[0])
    }

    fn smooth(&self, layout: &mut [DVec2]) {
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); layout.len() - self.first as usize];
        for (index, triangle) in (0..).zip(&self.triangles) {
            for &corner in triangle.iter().filter(|&&corner| corner >= self.first) {
                around[(corner - self.first) as usize].push(index);
            }
        }
        for (vertex, around) in (self.first..).zip(around) {
            if self.outermost.contains(&vertex) || around.is_empty() {
                continue;
            }
            let corners = around.iter().flat_map(|&index| self.triangles[index as usize]);
            let sum: DVec2 = corners.map(|corner| layout[corner as usize]).sum();
            let before = layout[vertex as usize];
            // Each neighbour belongs to two of the triangles.
            let count = around.len() as f64;
            layout[vertex as usize] = (sum - before * count) / (2.0 * count);
            let is_right = |&index: &u32| is_counter_clockwise(&self.triangles[index as usize], layout);
            if !around.iter().all(is_right) {
                layout[vertex as usize] = before;
            }
        }
    }
}

fn sides(ring: &[u32]) -> impl Iterator<Item = [u32; 2]> + '_ {
    (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]])
}

fn is_counter_clockwise(triangle: &[u32; 3], layout: &[DVec2]) -> bool {
    let [a, b, c] = triangle.map(|vertex| layout[vertex as usize]);
    orientation(a, b, c) == Orientation::CounterClockwise
}

/// The angle of a point from 0 to a whole turn.
fn turn_of(point: DVec2) -> f64 {
    let angle = elementary::atan2(point.y, point.x);
    if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
}

/// Whether the last point lies in the circle around a counter-clockwise triangle by more than rounding: the angles at
/// both ends add up to more than half a turn.
fn is_in_circle([a, b, c, d]: [DVec2; 4]) -> bool {
    let (sine_c, cosine_c) = ((a - c).perp_dot(b - c), (a - c).dot(b - c));
    let (sine_d, cosine_d) = ((b - d).perp_dot(a - d), (b - d).dot(a - d));
    let sizes = (sine_c.abs() + cosine_c.abs()) * (sine_d.abs() + cosine_d.abs());
    sine_c * cosine_d + cosine_c * sine_d < -1e-9 * sizes
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use trigon_math::Vec3;
    use trigon_mesh::{Mesh, MeshBuilder};

    use super::super::tests::{all_triangles, check_layout, stretch};
    use super::super::{UnwrapMethod, UnwrapSettings};
    use crate::edit_mesh::EditMesh;

    /// Flat squares: a row of nine, with teeth of three on every second.
    fn comb() -> Mesh {
        let mut builder = MeshBuilder::new();
        let mut vertices = BTreeMap::new();
        for column in 0..9 {
            for row in 0..if column % 2 == 0 { 4 } else { 1 } {
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| {
                    let at = (column + x, row + y);
                    *vertices
                        .entry(at)
                        .or_insert_with(|| builder.push_vertex(Vec3::new(at.0 as f32, at.1 as f32, 0.0)))
                });
                builder.push_face(&corners).expect("a square");
            }
        }
        builder.build()
    }

    /// Its teeth, pressed together in the circle, have to pass one another.
    #[test]
    fn a_flat_comb_is_flat_again_after_a_circle() {
        let (mut mesh, _) = EditMesh::from_mesh(&comb());
        let faces: Vec<_> = mesh.faces().collect();
        let settings = UnwrapSettings {
            method: UnwrapMethod::Convex,
            minimize_stretch: 30,
            ..UnwrapSettings::default()
        };
        mesh.unwrap_faces(&faces, &settings).expect("a disc");
        let triangles = all_triangles(&mesh);
        check_layout(&triangles).expect("no overlap");
        let stretch = stretch(&triangles);
        assert!(stretch < 1.001, "{stretch}");
    }
}
