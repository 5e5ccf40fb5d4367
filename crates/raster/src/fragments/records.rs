//! Visible triangles prepared for shading: one record of numbers for each.
//!
//! Records are made eight triangles at a time, one triangle in each lane, and then transposed, so
//! that a record is contiguous. Shading loads the records of the eight triangles that its eight
//! pixels show, and transposes them back into columns ([`Columns`](super::columns::Columns)): one
//! pixel in each lane, whichever triangles they belong to.

use super::context::ShadeContext;
use super::layout::{RecordShape, cold, hot};
use super::lines::FaceLines;
use super::sorted::SortedTriangles;
use crate::bin::TriangleRef;
use crate::draw::Marks;
use crate::ink::VisibleFaces;
use crate::simd::{InlineMap, LANES, Row, Simd, Token, at_level, lanes_of, transpose};

/// What few pipelines read of a triangle.
#[derive(Clone, Copy, Default)]
pub(crate) struct Tag {
    /// The index of the triangle, segment or point in its draw.
    pub(crate) primitive: u32,
    /// See [`flag`].
    pub(crate) flags: i32,
}

/// Records of triangles of one draw: the hot columns and the varyings of the
/// vertices in whole rows, and perhaps two cold rows.
#[derive(Default)]
pub(crate) struct Records {
    rows: Vec<Row>,
    tags: Vec<Tag>,
    /// The triangles among the tile's.
    visible: Vec<u32>,
    /// The layout of the selected draw's records.
    shape: RecordShape,
    /// How many rows and records there are.
    used: [usize; 2],
}

impl Records {
    /// Makes records of some of the tile's triangles, all of the context's draw, and forgets
    /// all others.
    pub(crate) fn fill(&mut self, token: Token, context: &ShadeContext<'_>, visible: &[u32]) {
        self.clear();
        self.append(token, context, visible, None);
    }

    /// Forgets all records.
    pub(crate) fn clear(&mut self) {
        self.used = [0; 2];
        self.visible.clear();
    }

    /// Appends records of triangles of the context's draw and selects them. `outer`
    /// gets the lines on them, if there is one.
    pub(crate) fn append(
        &mut self,
        token: Token,
        context: &ShadeContext<'_>,
        visible: &[u32],
        mut outer: Option<&mut VisibleFaces>,
    ) -> RecordShape {
        let shape = RecordShape { first: self.used, ..RecordShape::new(context) };
        let [row, record] = shape.first;
        let used = [row + visible.len() * shape.size, record + visible.len()];
        if self.rows.len() < used[0] {
            self.rows.resize(used[0], [0; LANES]);
        }
        if self.tags.len() < used[1] {
            self.tags.resize(used[1], Tag::default());
        }
        self.visible.extend_from_slice(visible);
        (self.used, self.shape) = (used, shape);
        if context.has_flat_marks() {
            self.fill_flat(context, visible, shape);
            if let Some(outer) = outer.as_deref_mut() {
                note_flat(context, visible, outer);
            }
            return shape;
        }
        at_level!(token, simd => {
            let rows = self.rows[row..used[0]].chunks_mut(LANES * shape.size);
            let tags = self.tags[record..used[1]].chunks_mut(LANES);
            for ((visible, rows), tags) in visible.chunks(LANES).zip(rows).zip(tags) {
                prepare_batch(simd, context, visible, EightRecords { rows, shape, tags }, outer.as_deref_mut());
            }
        });
        shape
    }

    /// Records of nothing but tags, of a draw with this many varyings.
    pub(crate) fn set_tags(&mut self, varyings: usize, tags: impl Iterator<Item = Tag>) {
        self.clear();
        self.shape = RecordShape { varyings, ..RecordShape::default() };
        self.tags.clear();
        self.tags.extend(tags);
    }

    /// Selects the records of another draw.
    pub(crate) fn select(&mut self, shape: RecordShape) {
        self.shape = shape;
    }

    /// Records of flat lines and points. Only their ids are read, so all else stays zero, except
    /// the steps, because steps of zero mark a triangle that is wide or cut.
    fn fill_flat(&mut self, context: &ShadeContext<'_>, visible: &[u32], shape: RecordShape) {
        let [row, record] = shape.first;
        let rows = &mut self.rows[row..self.used[0]];
        rows.fill([0; LANES]);
        let first = context.draw.first;
        let tags = &mut self.tags[record..];
        for ((record, tag), &number) in rows.chunks_exact_mut(shape.size).zip(tags).zip(visible) {
            record[0][hot::STEPS] = 1;
            record[0][hot::STEPS + 1] = 1;
            *tag = Tag { primitive: context.triangles[number as usize].ordinal - first, flags: 0 };
        }
    }

    #[inline(always)]
    pub(crate) fn shape(&self) -> RecordShape {
        self.shape
    }

    #[inline(always)]
    pub(crate) fn tag(&self, slot: u32) -> Tag {
        self.tags[self.shape.first[1] + slot as usize]
    }

    /// The rows of a triangle.
    #[inline(always)]
    fn rows_of(&self, slot: u32) -> &[Row] {
        &self.rows[self.shape.first[0] + slot as usize * self.shape.size..]
    }

    /// The rows of a triangle that every vector loads.
    #[inline(always)]
    pub(crate) fn of(&self, slot: u32) -> &[Row] {
        self.selected().of(slot)
    }

    /// The rows of the requested draw.
    #[inline(always)]
    pub(crate) fn selected(&self) -> SelectedRows<'_> {
        SelectedRows { rows: &self.rows[self.shape.first[0]..], shape: self.shape }
    }

    /// The cold columns of eight triangles.
    #[inline(always)]
    pub(crate) fn cold<S: Simd>(
        &self,
        simd: S,
        context: &ShadeContext<'_>,
        slots: [u32; LANES],
    ) -> [Row; cold::COUNT] {
        // A separate function, so that it is compiled once.
        simd.vectorize(
            #[inline(always)]
            || {
                let visible = slots.each(
                    #[inline(always)]
                    |slot| self.visible[self.shape.first[1] + slot as usize],
                );
                let mut columns = [[0; LANES]; cold::COUNT];
                if self.shape.size == self.shape.loaded {
                    let triangles = triangle_refs(context, visible);
                    let indices = context.geometry().corners_of(primitives_of(context, triangles));
                    let sorted = sorted_triangles(simd, context, triangles, indices);
                    let [_, first, second] = sorted.heads(simd, context.area.origin);
                    columns[..LANES].copy_from_slice(&first);
                    columns[LANES..].copy_from_slice(&second);
                } else {
                    for (half, columns) in columns.as_chunks_mut().0.iter_mut().enumerate() {
                        let row = self.shape.loaded + half;
                        let rows = slots.each(
                            #[inline(always)]
                            |slot| &self.rows_of(slot)[row],
                        );
                        transpose(simd, rows, columns);
                    }
                }
                columns[cold::INDEX] = visible.each(u32::cast_signed);
                columns
            },
        )
    }
}

/// Notes where flat lines and points lie, for the edges of faces beside them.
fn note_flat(context: &ShadeContext<'_>, visible: &[u32], outer: &mut VisibleFaces) {
    for &number in visible {
        let greatest = context.draw.triangle(context.triangles[number as usize]).nearest();
        outer.note_unlined(number, greatest);
    }
}

/// The rows of one draw.
#[derive(Clone, Copy)]
pub(crate) struct SelectedRows<'r> {
    rows: &'r [Row],
    shape: RecordShape,
}

impl<'r> SelectedRows<'r> {
    /// Those of a triangle that every vector loads.
    #[inline(always)]
    pub(crate) fn of(self, slot: u32) -> &'r [Row] {
        &self.rows[slot as usize * self.shape.size..][..self.shape.loaded]
    }
}

/// Eight of the tile's triangles.
#[inline(always)]
fn triangle_refs(context: &ShadeContext<'_>, visible: [u32; LANES]) -> [TriangleRef; LANES] {
    visible.each(
        #[inline(always)]
        |number| context.triangles[number as usize],
    )
}

/// The primitives of the context's draw that eight triangles belong to.
#[inline(always)]
fn primitives_of(context: &ShadeContext<'_>, triangles: [TriangleRef; LANES]) -> [u32; LANES] {
    let first = context.draw.first;
    triangles.each(
        #[inline(always)]
        |triangle| triangle.ordinal - first,
    )
}

/// Eight triangles; `indices` are the vertices of their primitives.
#[inline(always)]
fn sorted_triangles<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    triangles: [TriangleRef; LANES],
    indices: [[u32; 3]; LANES],
) -> SortedTriangles<S> {
    if triangles.iter().all(|triangle| triangle.is_whole()) {
        return SortedTriangles::whole(simd, context, indices);
    }
    simd.vectorize(
        #[inline(always)]
        || SortedTriangles::made(simd, context, triangles),
    )
}

/// Where the records of up to eight triangles are written.
struct EightRecords<'r> {
    rows: &'r mut [Row],
    shape: RecordShape,
    tags: &'r mut [Tag],
}

/// Makes the records of up to eight triangles. Unused lanes repeat the first.
#[inline(always)]
fn prepare_batch<S: Simd>(
    simd: S,
    context: &ShadeContext<'_>,
    visible: &[u32],
    out: EightRecords<'_>,
    outer: Option<&mut VisibleFaces>,
) {
    let EightRecords { rows, shape, tags } = out;
    let numbers = lanes_of(
        #[inline(always)]
        |lane| *visible.get(lane).unwrap_or(&visible[0]),
    );
    let triangles = triangle_refs(context, numbers);
    let primitives = primitives_of(context, triangles);
    let indices = context.geometry().corners_of(primitives);
    let sorted = sorted_triangles(simd, context, triangles, indices);
    let columns = sorted.heads(simd, context.area.origin);
    let flags: Row = sorted.flags(simd).into();
    for ((tag, primitive), flags) in tags.iter_mut().zip(primitives).zip(flags) {
        *tag = Tag { primitive, flags };
    }
    let columns_per_row = if shape.size == shape.loaded { 1 } else { 3 };
    for (columns, row) in columns.iter().zip([0, shape.loaded, shape.loaded + 1]).take(columns_per_row) {
        let mut turned = [[0; LANES]; LANES];
        transpose(simd, columns.each_ref(), &mut turned);
        for (record, turned) in rows.chunks_exact_mut(shape.size).zip(turned) {
            record[row] = turned;
        }
    }
    if let Some(ink) = context.frame_ink
        && (shape.lines.is_some() || outer.is_some())
    {
        // A separate function, so that it takes no registers elsewhere.
        simd.vectorize(
            #[inline(always)]
            || {
                let lines = FaceLines::new(simd, context, ink, &sorted, triangles, primitives);
                lines.store(simd, rows, shape, visible.len());
                if let Some(outer) = outer {
                    lines.note(simd, &sorted, visible, outer);
                }
            },
        );
    }
    if let Some(marks) = context.marks() {
        store_marks(context, marks, rows, shape, &primitives, &sorted.corners);
    }
    let corners = lanes_of(
        #[inline(always)]
        |lane| {
            sorted.corners.each_ref().each(
                #[inline(always)]
                |corner| indices[lane][corner[lane] as usize],
            )
        },
    );
    let records = rows.chunks_exact_mut(shape.size).zip(&corners[..visible.len()]);
    // The most common counts are constants, so that the copy needs no loop.
    match shape.varyings {
        0 => {}
        1 => copy_varyings::<1>(context, records),
        2 => copy_varyings::<2>(context, records),
        3 => copy_varyings::<3>(context, records),
        4 => copy_varyings::<4>(context, records),
        6 => copy_varyings::<6>(context, records),
        8 => copy_varyings::<8>(context, records),
        _ => copy_many_varyings(context, records),
    }
}

/// Puts the marks of triangles and of their sides into records.
#[cold]
fn store_marks(
    context: &ShadeContext<'_>,
    marks: &Marks<'_>,
    rows: &mut [Row],
    shape: RecordShape,
    primitives: &[u32; LANES],
    corners: &[Row; 3],
) {
    let Some(column) = shape.marks else { return };
    for (lane, (record, &primitive)) in rows.chunks_exact_mut(shape.size).zip(primitives).enumerate() {
        let sides = marks.of_sides(primitive);
        // Opposite corner k lies the side from k + 1 to k + 2.
        let [a, b, c] = corners.map(|corner| sides[(corner[lane] as usize + 1) % 3]);
        let packed = [a, b, c, marks.of_face(context.geometry().face(primitive))];
        record.as_flattened_mut()[column] = i32::from_le_bytes(packed);
    }
}

/// Puts the varyings of the corners into records: `COUNT` of each.
#[inline(always)]
fn copy_varyings<'r, const COUNT: usize>(
    context: &ShadeContext<'_>,
    records: impl Iterator<Item = (&'r mut [Row], &'r [u32; 3])>,
) {
    let varyings = context.varyings;
    for (record, corners) in records {
        let values = record.as_flattened_mut()[hot::COUNT..].as_chunks_mut::<COUNT>().0;
        for (values, &corner) in values.iter_mut().zip(corners) {
            let from: &[f32; COUNT] = varyings.of(corner).first_chunk().expect("varyings are this many");
            *values = from.map(|value| value.to_bits().cast_signed());
        }
    }
}

/// As [`copy_varyings`], for any number.
fn copy_many_varyings<'r>(
    context: &ShadeContext<'_>,
    records: impl Iterator<Item = (&'r mut [Row], &'r [u32; 3])>,
) {
    let varyings = context.varyings;
    for (record, corners) in records {
        let values = record.as_flattened_mut()[hot::COUNT..].chunks_exact_mut(context.varying_count);
        for (values, &corner) in values.zip(corners) {
            for (to, from) in values.iter_mut().zip(varyings.of(corner)) {
                *to = from.to_bits().cast_signed();
            }
        }
    }
}
