//! Attributes: positions, normals and whatever else points have. The vertices of the mesh are split into
//! points wherever an attribute has a seam.

use gltf::json::accessor::ComponentType;

use super::Stream;
use super::corners::{CornerTable, NONE};
use super::order::{Order, Visit, find_order};
use super::prediction::{Neighbours, Positions, read_integers};
use super::symbols::{Budget, Failure};
use super::values::{AttributeValues, Number};
use crate::formats::gltf::stream::Broken;

/// The kind of an attribute by which others are predicted.
const POSITION: u8 = 0;

/// A decoded attribute.
pub(crate) struct DecodedAttribute {
    /// The number by which the file refers to it.
    pub(crate) id: u32,
    pub(crate) values: AttributeValues,
}

/// Attributes that are stored in the same order.
struct Group {
    /// The table of corners: none for that of positions.
    seams: Option<usize>,
    visit: Visit,
    attributes: Vec<Attribute>,
}

/// What the stream says of an attribute.
struct Attribute {
    id: u32,
    /// Whether it is the first one of positions.
    is_position: bool,
    number: Number,
    components: usize,
    normalized: bool,
    encoding: ValueEncoding,
}

/// How values become the integers that are stored.
#[derive(Clone, Copy)]
enum ValueEncoding {
    /// They are stored as they are.
    Plain,
    /// They are integers.
    Integers,
    /// Steps of a range.
    Steps,
    /// Unit vectors as two integers.
    Normals,
}

impl ValueEncoding {
    fn from_code(code: u8) -> Result<Self, Failure> {
        match code {
            0 => Ok(Self::Plain),
            1 => Ok(Self::Integers),
            2 => Ok(Self::Steps),
            3 => Ok(Self::Normals),
            _ => Err(Failure::Foreign("an attribute of an unknown encoding")),
        }
    }
}

pub(super) fn read_attributes(
    stream: &mut Stream<'_>,
    shape: &MeshShape,
    budget: &mut Budget,
) -> Result<Vec<DecodedAttribute>, Failure> {
    let groups = read_groups(stream, shape)?;
    let mut reader = AttributeReader { stream, shape, budget, positions: None, found: Vec::new() };
    for group in groups {
        reader.read_group(group)?;
    }
    Ok(reader.found)
}

fn read_groups(stream: &mut Stream<'_>, shape: &MeshShape) -> Result<Vec<Group>, Failure> {
    let count = stream.byte()?;
    let mut groups = Vec::new();
    for _ in 0..count {
        let (seams, visit) = match &shape.tables {
            Some(tables) => read_order(stream, tables.attributes.len())?,
            None => (None, Visit::DepthFirst),
        };
        groups.push(Group { seams, visit, attributes: Vec::new() });
    }
    let mut has_position = false;
    for group in &mut groups {
        for _ in 0..stream.varint()? {
            let attribute = read_attribute(stream, !has_position)?;
            has_position |= attribute.is_position;
            group.attributes.push(attribute);
        }
        for attribute in &mut group.attributes {
            attribute.encoding = ValueEncoding::from_code(stream.byte()?)?;
        }
    }
    Ok(groups)
}

/// The table of corners of a group, and how it is walked.
fn read_order(stream: &mut Stream<'_>, tables: usize) -> Result<(Option<usize>, Visit), Failure> {
    let [table, kind, visit] = stream.array()?;
    let visit = match visit {
        0 => Visit::DepthFirst,
        1 => Visit::MostKnown,
        _ => return Err(Failure::Foreign("attributes in an unknown order")),
    };
    match (kind, visit) {
        (0, visit) => Ok((None, visit)),
        (1, Visit::DepthFirst) if usize::from(table) < tables => Ok((Some(usize::from(table)), visit)),
        _ => Err("attributes have seams that do not exist".into()),
    }
}

fn read_attribute(stream: &mut Stream<'_>, may_be_position: bool) -> Result<Attribute, Failure> {
    let [kind, number, components, normalized] = stream.array()?;
    if components == 0 {
        return Err("an attribute has no components".into());
    }
    Ok(Attribute {
        id: stream.varint()?,
        is_position: kind == POSITION && may_be_position,
        number: Number::from_code(number)?,
        components: usize::from(components),
        normalized: normalized > 0,
        encoding: ValueEncoding::Plain,
    })
}

/// The values of an attribute in the stream, in their order.
enum StoredAttribute {
    Plain(Vec<u8>),
    Integers(Vec<i32>),
}

struct AttributeReader<'r, 'b> {
    stream: &'r mut Stream<'b>,
    shape: &'r MeshShape,
    budget: &'r mut Budget,
    positions: Option<Positions>,
    found: Vec<DecodedAttribute>,
}

impl AttributeReader<'_, '_> {
    fn read_group(&mut self, group: Group) -> Result<(), Failure> {
        let MeshShape { triangles, points, tables } = self.shape;
        self.budget.spend(points.saturating_add(triangles.len()))?;
        let table = tables.as_ref().map(|tables| match group.seams {
            Some(kind) => &tables.attributes[kind],
            None => &tables.positions,
        });
        let order = table.map(|table| find_order(table, group.visit)).transpose()?;
        let of_points = match (table, &order) {
            (Some(table), Some(order)) => values_of_points(self.shape, &table.vertices, order),
            _ => (0..*points as u32).collect(),
        };
        let count = order.as_ref().map_or(*points, |order| order.corners.len());
        let mut stored = Vec::with_capacity(group.attributes.len());
        for attribute in &group.attributes {
            let neighbours = table.zip(order.as_ref()).map(|(table, order)| {
                let positions = self.positions.as_ref();
                Neighbours { table, order, points: triangles, positions }
            });
            let values = read_stored(self.stream, attribute, count, neighbours, self.budget)?;
            if let (true, 3, StoredAttribute::Integers(list)) =
                (attribute.is_position, attribute.components, &values)
            {
                self.budget.spend(list.len() + of_points.len())?;
                self.positions = Some(Positions { values: list.clone(), of_points: of_points.clone() });
            }
            stored.push(values);
        }
        for (attribute, stored) in group.attributes.iter().zip(stored) {
            let values = attribute.finish(self.stream, stored)?;
            self.budget.spend(of_points.len().saturating_mul(attribute.components))?;
            let values = values.of_points(&of_points)?;
            self.found.push(DecodedAttribute { id: attribute.id, values });
        }
        Ok(())
    }
}

/// The value of each point.
fn values_of_points(shape: &MeshShape, vertices: &[u32], order: &Order) -> Vec<u32> {
    let mut values = vec![NONE; shape.points];
    for (&point, &vertex) in shape.triangles.iter().zip(vertices) {
        if let (Some(to), Some(&value)) = (values.get_mut(point as usize), order.values.get(vertex as usize))
        {
            *to = value;
        }
    }
    values
}

fn read_stored(
    stream: &mut Stream<'_>,
    attribute: &Attribute,
    count: usize,
    neighbours: Option<Neighbours<'_>>,
    budget: &mut Budget,
) -> Result<StoredAttribute, Failure> {
    let components = match attribute.encoding {
        ValueEncoding::Plain => {
            let size = attribute.number.size() * attribute.components;
            let bytes = stream.take(count.checked_mul(size).ok_or(Failure::TooLarge)?)?;
            budget.spend(bytes.len() / 4)?;
            return Ok(StoredAttribute::Plain(attribute.number.converted(bytes)));
        }
        ValueEncoding::Integers => attribute.components,
        ValueEncoding::Steps if attribute.number == Number::F32 => attribute.components,
        ValueEncoding::Normals if attribute.number == Number::F32 && attribute.components == 3 => 2,
        _ => return Err("an attribute has the wrong type for its encoding".into()),
    };
    Ok(StoredAttribute::Integers(read_integers(stream, count, components, neighbours, budget)?))
}

impl Attribute {
    /// Turns what is stored into values.
    fn finish(&self, stream: &mut Stream<'_>, stored: StoredAttribute) -> Result<AttributeValues, Failure> {
        let floats = |floats: &mut dyn Iterator<Item = f32>| floats.flat_map(f32::to_le_bytes).collect();
        let (component, bytes) = match (stored, self.encoding) {
            (StoredAttribute::Plain(bytes), _) => (self.number.component(), bytes),
            (StoredAttribute::Integers(list), ValueEncoding::Steps) => {
                let steps = Steps::read(stream, self.components)?;
                (ComponentType::F32, floats(&mut steps.values(&list)))
            }
            (StoredAttribute::Integers(list), ValueEncoding::Normals) => {
                let step = read_normal_step(stream)?;
                let normals = list.as_chunks().0.iter().flat_map(|&point| normal(point, step));
                (ComponentType::F32, floats(&mut { normals }))
            }
            (StoredAttribute::Integers(list), _) => (self.number.component(), self.number.narrowed(&list)?),
        };
        Ok(AttributeValues { component, components: self.components, normalized: self.normalized, bytes })
    }
}

/// The steps of a range.
struct Steps {
    /// The smallest value of each component.
    min: Vec<f32>,
    step: f32,
}

impl Steps {
    fn read(stream: &mut Stream<'_>, components: usize) -> Result<Self, Broken> {
        let min = (0..components).map(|_| stream.array().map(f32::from_le_bytes));
        let min = min.collect::<Result<_, _>>()?;
        let range = f32::from_le_bytes(stream.array()?);
        let bits = stream.byte()?;
        if !(1..=30).contains(&bits) {
            return Err("an attribute has an impossible precision");
        }
        Ok(Self { min, step: range / ((1_u32 << bits) - 1) as f32 })
    }

    fn values(&self, steps: &[i32]) -> impl Iterator<Item = f32> {
        steps.iter().zip(self.min.iter().cycle()).map(|(&steps, min)| steps as f32 * self.step + min)
    }
}

/// The step between points of the square of normals, whose side is 2.
fn read_normal_step(stream: &mut Stream<'_>) -> Result<f32, Broken> {
    match stream.byte()? {
        bits @ 2..=30 => Ok(2.0 / ((1_u32 << bits) - 2) as f32),
        _ => Err("its normals have an impossible precision"),
    }
}

/// The unit vector of a point of the square; zero if there is none.
fn normal(point: [i32; 2], step: f32) -> [f32; 3] {
    let [s, t] = point.map(|number| number as f32 * step - 1.0);
    let x = 1.0 - s.abs() - t.abs();
    // Outside of the diamond the octahedron is folded back.
    let fold = (-x).max(0.0);
    let [y, z] = [s, t].map(|number| number + if number < 0.0 { fold } else { -fold });
    let square = x * x + y * y + z * z;
    if f64::from(square) < 1e-6 {
        return [0.0; 3];
    }
    let scale = 1.0 / square.sqrt();
    [x, y, z].map(|number| number * scale)
}

/// The triangles of a mesh, before its attributes are known.
pub(super) struct MeshShape {
    pub(super) points: usize,
    /// Three points each.
    pub(super) triangles: Vec<u32>,
    /// How the triangles hang together, if the stream says so.
    pub(super) tables: Option<Tables>,
}

/// The corners of a mesh: for positions, and for each kind of attribute with seams of its own.
pub(super) struct Tables {
    pub(super) positions: CornerTable,
    pub(super) attributes: Vec<CornerTable>,
}

/// The triangles in points.
pub(super) struct Numbered {
    pub(super) points: usize,
    /// Three points each.
    pub(super) triangles: Vec<u32>,
}

/// Numbers the points. `is_closed` tells of each vertex whether its triangles close around it.
pub(super) fn number_points(tables: &Tables, is_closed: &[bool]) -> Result<Numbered, Broken> {
    let positions = &tables.positions;
    if tables.attributes.is_empty() {
        return Ok(Numbered { points: positions.first.len(), triangles: positions.vertices.clone() });
    }
    let mut triangles = vec![NONE; positions.vertices.len()];
    let mut points = 0;
    for (&corner, &is_closed) in positions.first.iter().zip(is_closed) {
        if corner == NONE {
            continue;
        }
        let start = if is_closed { after_seam(tables, corner)? } else { corner };
        triangles[start as usize] = points;
        let mut before = start;
        loop {
            let corner = positions.swing_right(before);
            if corner == NONE || corner == start {
                break;
            }
            let differs = |table: &CornerTable| table.vertex(corner) != table.vertex(before);
            points += u32::from(tables.attributes.iter().any(differs));
            triangles[corner as usize] = points;
            before = corner;
        }
        points += 1;
    }
    if triangles.contains(&NONE) {
        return Err("some of its triangles hang together wrongly");
    }
    Ok(Numbered { points: points as usize, triangles })
}

/// The first corner to the right of a seam around a closed vertex; the corner itself if no
/// attribute has one there.
fn after_seam(tables: &Tables, corner: u32) -> Result<u32, Broken> {
    for table in &tables.attributes {
        let mut right = tables.positions.swing_right(corner);
        while right != corner {
            if right == NONE {
                return Err("a vertex that should be closed is on a boundary");
            }
            if table.vertex(right) != table.vertex(corner) {
                return Ok(right);
            }
            right = tables.positions.swing_right(right);
        }
    }
    Ok(corner)
}
