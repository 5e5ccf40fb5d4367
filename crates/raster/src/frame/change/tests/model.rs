//! Surfaces, and what becomes of them.

use crate::{BlendMode, Culling, Draw, EdgeFlags, Fragment, Marks, Pass, Pipeline, VertexOutput};
use fixedbitset::FixedBitSet;
use proptest::prelude::*;
use trigon_math::Vec4;

/// A surface of quads and a line beside it, whose vertices have colours.
#[derive(Clone, Debug)]
pub(super) struct Model {
    pub(super) vertices: Vec<(Vec4, Vec4)>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) faces: Vec<u32>,
    pub(super) flags: Vec<EdgeFlags>,
    /// The numbers of the edges that the triangles' sides are.
    pub(super) sides: Vec<[u32; 3]>,
    pub(super) edge_marks: Vec<u8>,
    pub(super) face_marks: Vec<u8>,
    /// Its points that are larger.
    pub(super) large: FixedBitSet,
    pub(super) blend_mode: BlendMode,
}

impl Pipeline for Model {
    type Varyings = Vec4;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec4> {
        let (position, varyings) = self.vertices[index];
        VertexOutput { position, varyings }
    }

    fn fragment(&self, fragment: &Fragment<Vec4>) -> Vec4 {
        let color = fragment.varyings;
        (color.truncate() * color.w).extend(color.w)
    }

    fn mask(&self, fragment: &Fragment<Vec4>) -> bool {
        fragment.varyings.x < 0.7
    }
}

/// The vertices of a model with one colour for each primitive: its points are drawn from them.
impl Pipeline for Vec<(Vec4, Vec4)> {
    type Varyings = ();
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self[index].0, varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        Vec4::new(0.01 * fragment.triangle as f32, 0.5, 0.2, 1.0)
    }
}

pub(super) const QUADS: u32 = 9;

/// One for each vertex of a sheet.
pub(super) const ALL_POINTS: [u32; ((QUADS + 1) * (QUADS + 1)) as usize] = {
    let mut points = [0; ((QUADS + 1) * (QUADS + 1)) as usize];
    let mut index = 0;
    while index < points.len() {
        points[index] = index as u32;
        index += 1;
    }
    points
};

impl Model {
    /// A wavy sheet in front of the camera, `shift` deep.
    pub(super) fn sheet(blend_mode: BlendMode, shift: f32) -> Self {
        let side = QUADS + 1;
        let vertex = |index: u32| {
            let [x, y] = [index % side, index / side].map(|v| v as f32 / QUADS as f32);
            let w = 1.0 + 0.5 * x + shift;
            let position = Vec4::new((2.2 * x - 1.1) * w, (2.2 * y - 1.1) * w, 0.3, w);
            (position, Vec4::new(x, y, 0.5, 0.6))
        };
        let quads = (0..QUADS * QUADS).map(|quad| quad / QUADS * side + quad % QUADS);
        let halves = |at: u32| [[at, at + 1, at + side + 1], [at, at + side + 1, at + side]];
        let flags = [[true, true, false], [false, true, true]].map(EdgeFlags::new);
        let triangles: Vec<_> = quads.flat_map(halves).collect();
        // One edge to the right and one downwards from each vertex.
        let edge = |from: u32, to: u32| match from.abs_diff(to) {
            1 => from.min(to),
            across if across == side => side * side + from.min(to),
            _ => u32::MAX,
        };
        Self {
            vertices: (0..side * side).map(vertex).collect(),
            sides: triangles.iter().map(|&[a, b, c]| [edge(a, b), edge(b, c), edge(c, a)]).collect(),
            edge_marks: (0..2 * side * side).map(|edge| (edge % 3) as u8).collect(),
            face_marks: (0..QUADS * QUADS).map(|face| (face % 5 / 3) as u8).collect(),
            large: FixedBitSet::with_capacity(4),
            triangles,
            faces: (0..2 * QUADS * QUADS).map(|triangle| triangle / 2).collect(),
            flags: (0..QUADS * QUADS).flat_map(|_| flags).collect(),
            blend_mode,
        }
    }

    pub(super) fn record<'a>(&'a self, object: u32, pass: &mut Pass<'a>) {
        pass.triangles(Draw {
            faces: Some(&self.faces),
            edge_flags: Some(&self.flags),
            marks: Some(Marks { sides: &self.sides, edges: &self.edge_marks, faces: &self.face_marks }),
            object,
            culling: Culling::None,
            blend_mode: self.blend_mode,
            ..Draw::new(self, &self.triangles)
        });
    }
}

/// What becomes of a model.
#[derive(Clone, Debug)]
pub(super) struct Delta {
    pub(super) model: usize,
    /// Vertices with how far they move in clip space.
    pub(super) moved: Vec<(u32, [f32; 4])>,
    /// Vertices with other colours.
    pub(super) painted: Vec<(u32, Vec4)>,
    /// Triangles whose corners are turned on, and whose flags are others.
    pub(super) turned: Vec<u32>,
    /// Edges and faces with other marks.
    pub(super) marked: [Vec<(u32, u8)>; 2],
    /// Points with another size.
    pub(super) resized: Vec<u32>,
}

/// The changes of a model that are passed to `redraw`.
pub(super) struct Told {
    pub(super) vertices: Vec<u32>,
    pub(super) reshaped: Vec<u32>,
    pub(super) recolored: Vec<u32>,
    pub(super) resized: Vec<u32>,
}

impl Delta {
    /// Changes the model; returns what is passed to `redraw`.
    pub(super) fn apply(&self, model: &mut Model) -> Told {
        self.apply_part(model, self.moved.len())
    }

    /// The same, of which only the first vertices move, `count` of them.
    pub(super) fn apply_part(&self, model: &mut Model, count: usize) -> Told {
        let moved = &self.moved[..count];
        for &(vertex, way) in moved {
            model.vertices[vertex as usize].0 += Vec4::from_array(way);
        }
        for &(vertex, color) in &self.painted {
            model.vertices[vertex as usize].1 = color;
        }
        let mut turned = self.turned.clone();
        turned.sort_unstable();
        turned.dedup();
        for &triangle in &turned {
            model.triangles[triangle as usize].rotate_left(1);
            model.sides[triangle as usize].rotate_left(1);
            model.flags[triangle as usize] = EdgeFlags::new([triangle % 2 == 0, true, triangle % 3 == 0]);
        }
        let painted = self.painted.iter().map(|&(vertex, _)| vertex);
        let vertices = moved.iter().map(|&(vertex, _)| vertex).chain(painted).collect();
        let mut resized = self.resized.clone();
        resized.sort_unstable();
        resized.dedup();
        resized.iter().for_each(|&point| model.large.toggle(point as usize));
        Told { vertices, reshaped: turned, recolored: self.mark(model), resized }
    }

    /// Changes marks; the triangles that have them.
    pub(super) fn mark(&self, model: &mut Model) -> Vec<u32> {
        let [edges, faces] = &self.marked;
        edges.iter().for_each(|&(edge, mark)| model.edge_marks[edge as usize] = mark);
        faces.iter().for_each(|&(face, mark)| model.face_marks[face as usize] = mark);
        let has_marked = |&triangle: &u32| {
            let (sides, own) = (model.sides[triangle as usize], model.faces[triangle as usize]);
            edges.iter().any(|(edge, _)| sides.contains(edge)) || faces.iter().any(|(face, _)| *face == own)
        };
        (0..model.triangles.len() as u32).filter(has_marked).collect()
    }
}

pub(super) fn delta() -> impl Strategy<Value = Delta> {
    let vertex = 0..(QUADS + 1) * (QUADS + 1);
    let small = -0.2_f32..0.2;
    // Some go behind the eye, far away, or nowhere.
    let large = prop_oneof![-3.0_f32..3.0, Just(1e9), Just(f32::NAN)];
    let way = prop_oneof![
        6 => prop::array::uniform4(small),
        1 => prop::array::uniform4(large),
    ];
    let color = prop::array::uniform4(0.0_f32..1.0).prop_map(Vec4::from_array);
    let moved = prop::collection::vec((vertex.clone(), way), 0..5);
    let painted = prop::collection::vec((vertex, color), 0..4);
    let turned = prop::collection::vec(0..2 * QUADS * QUADS, 0..3);
    let marked = [2 * (QUADS + 1) * (QUADS + 1), QUADS * QUADS]
        .map(|elements| prop::collection::vec((0..elements, 0..4_u8), 0..3));
    let resized = prop::collection::vec(0..4_u32, 0..3);
    (0..2_usize, moved, painted, turned, marked, resized).prop_map(
        |(model, moved, painted, turned, marked, resized)| Delta {
            model,
            moved,
            painted,
            turned,
            marked,
            resized,
        },
    )
}
