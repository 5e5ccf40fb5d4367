//! Converts corner values to vertex values, for formats without corner values.
//!
//! A vertex whose corners agree keeps its number. Where they differ, as at a seam or a sharp edge,
//! additional vertices at the same position follow after those of the object.

use std::collections::HashMap;

use trigon_math::{DVec3, Vec2, Vec3, Vec4};

use super::{Gathered, Object};

/// The values that vertices need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Columns {
    pub(crate) normals: bool,
    pub(crate) uvs: bool,
    pub(crate) colors: bool,
}

impl Columns {
    /// Those of these that any object has.
    pub(crate) fn found(self, gathered: &Gathered<'_>) -> Self {
        let any = |has: fn(&Object<'_>) -> bool| gathered.objects.iter().any(has);
        Self {
            normals: self.normals && any(|object| object.is_shaded()),
            uvs: self.uvs && any(|object| !object.mesh.attributes().uv_sets.is_empty()),
            colors: self.colors && any(|object| object.mesh.attributes().has_colors()),
        }
    }
}

/// The values of a vertex. Values that are not requested keep those of `Default`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Values {
    pub(crate) normal: Vec3,
    pub(crate) uv: Vec2,
    /// Linear, with alpha.
    pub(crate) color: Vec4,
}

impl Default for Values {
    fn default() -> Self {
        Self { normal: Vec3::ZERO, uv: Vec2::ZERO, color: Vec4::ONE }
    }
}

impl Values {
    /// `normals` are those of the mesh's corners, or none of them.
    fn of(object: &Object<'_>, corner: u32, columns: Columns, normals: &[Vec3]) -> Self {
        let (attributes, mut values) = (object.mesh.attributes(), Self::default());
        if let Some(&normal) = normals.get(corner as usize) {
            values.normal = object.turned(normal);
        }
        if let Some(uvs) = attributes.uv_sets.first().filter(|_| columns.uvs) {
            values.uv = Some(uvs[corner as usize]).filter(|uv| uv.is_finite()).unwrap_or_default();
        }
        if let Some(colors) = attributes.corner_colors.as_ref().filter(|_| columns.colors) {
            values.color = colors[corner as usize];
        }
        values
    }

    fn bits(&self) -> [u32; 9] {
        let Self { normal, uv, color } = self;
        [normal.x, normal.y, normal.z, uv.x, uv.y, color.x, color.y, color.z, color.w].map(f32::to_bits)
    }
}

/// The copies of an object's vertices, by the vertex and its other values.
type Others = HashMap<(u32, [u32; 9]), u32>;

/// The vertices of all objects, one object after the other.
#[derive(Default)]
pub(crate) struct VertexTable {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) values: Vec<Values>,
    /// The vertices of all faces.
    pub(crate) corner_vertices: Vec<u32>,
    pub(crate) edges: Vec<[u32; 2]>,
    /// The number of repeated vertices.
    pub(crate) split: usize,
}

impl VertexTable {
    pub(crate) fn new(gathered: &Gathered<'_>, columns: Columns) -> Self {
        let mut table = Self::default();
        for object in &gathered.objects {
            table.add(gathered, object, columns);
        }
        table
    }

    fn add(&mut self, gathered: &Gathered<'_>, object: &Object<'_>, columns: Columns) {
        let base = self.positions.len();
        let count = object.mesh.vertex_count();
        self.positions.extend((0..count as u32).map(|vertex| gathered.position(object, vertex)));
        self.values.resize(base + count, Values::default());
        let mut is_known = vec![false; count];
        // Such files know no smooth faces: their normals say it.
        let has_normals = columns.normals && object.is_shaded();
        let normals = if has_normals { object.mesh.shading_normals() } else { Vec::new() };
        let mut others = Others::new();
        for &corner in &object.corners {
            let vertex = object.vertex(corner);
            let values = Values::of(object, corner, columns, &normals);
            if !std::mem::replace(&mut is_known[vertex as usize], true) {
                self.values[base + vertex as usize] = values;
            }
            let number = self.number(base, vertex, values, &mut others);
            self.corner_vertices.push(number);
        }
        let colors = object.mesh.attributes().vertex_colors.as_deref().filter(|_| columns.colors);
        for (vertex, color) in
            colors.into_iter().flatten().enumerate().filter(|(vertex, _)| !is_known[*vertex])
        {
            self.values[base + vertex].color = *color;
        }
        for &edge in object.mesh.loose_edges() {
            let edge = edge.map(|end| {
                let values = self.values[base + end as usize];
                let color = colors.map_or(values.color, |colors| colors[end as usize]);
                self.number(base, end, Values { color, ..values }, &mut others)
            });
            self.edges.push(edge);
        }
    }

    /// The number of a vertex of an object with some values: its own if it has them, else that of a copy.
    fn number(&mut self, base: usize, vertex: u32, values: Values, others: &mut Others) -> u32 {
        let own = base + vertex as usize;
        if self.values[own].bits() == values.bits() {
            return own as u32;
        }
        let next = self.positions.len() as u32;
        let number = *others.entry((vertex, values.bits())).or_insert(next);
        if number == next {
            self.positions.push(self.positions[own]);
            self.values.push(values);
            self.split += 1;
        }
        number
    }
}
