//! The vertices and faces of an OFF.

use std::cmp::Ordering;
use std::mem::take;

use trigon_math::{DVec3, Vec4};

use super::header::Columns;
use super::header::{OffHeader, REMEDY};
use super::plain;
use super::plain::Piece;
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::numbers::{first_number, number};
use crate::options::LoadStage;
use crate::polygons::{Polygons, RawColors, most_corners, too_many_corners};
use crate::rows::Words;

/// So many rows are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 16;

/// How a file is laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineLayout {
    /// A line for each vertex.
    Lines,
    /// One list of numbers.
    Free,
    /// The same, but for colours between a face and the end of its line.
    FreeWithColors,
}

/// A file while it is read.
pub(super) struct OffReader<'a> {
    header: OffHeader,
    layout: LineLayout,
    text: Words<'a>,
    columns: Columns,
    numbers: RowNumbers,
    polygons: Polygons,
    /// Of vertices.
    colors: RawColors,
    face_colors: RawColors,
    found: FoundRows,
}

/// What was read.
#[derive(Default)]
pub(super) struct FoundRows {
    pub(super) polygons: Polygons,
    /// Each with its remedy.
    pub(super) warnings: Vec<(Location, String, &'static str)>,
    /// Whether another layout may make more of the file.
    pub(super) is_doubtful: bool,
}

impl<'a> OffReader<'a> {
    /// Reads on after the header.
    pub(super) fn new(header: OffHeader, text: Words<'a>, layout: LineLayout) -> Self {
        Self {
            header,
            layout,
            text,
            columns: Columns::of(&header),
            numbers: RowNumbers::default(),
            polygons: Polygons::default(),
            colors: RawColors::default(),
            face_colors: RawColors::default(),
            found: FoundRows::default(),
        }
    }

    pub(super) fn read(&mut self, import: &Import<'_>) -> Result<FoundRows, LoadError> {
        self.vertices(import)?;
        self.faces(import)?;
        let mut polygons = take(&mut self.polygons);
        if self.columns.has_colors {
            polygons.colors = self.finished(|reader| &mut reader.colors);
        }
        polygons.face_colors = self.finished(|reader| &mut reader.face_colors);
        Ok(FoundRows { polygons, ..take(&mut self.found) })
    }

    /// Colours as linear light.
    fn finished(&mut self, colors: impl FnOnce(&mut Self) -> &mut RawColors) -> Vec<Vec4> {
        let colors = take(colors(self));
        let fault =
            colors.fault().map(|what| (Location::Whole, what, "write colours from 0 to 1 or from 0 to 255"));
        self.found.warnings.extend(fault);
        colors.finish()
    }

    /// Whether reading stopped among vertices: some were read, and there is more text.
    pub(super) fn is_within_vertices(&mut self) -> bool {
        let count = self.polygons.positions.len() as u64;
        (1..self.header.vertices).contains(&count) && !self.text.line_ahead().is_empty()
    }

    fn malformed(&self, import: &Import<'_>, what: String) -> LoadError {
        LoadError::malformed(import.path, what, REMEDY).at(Location::Line(self.text.line()))
    }

    fn warn(&mut self, what: String, remedy: &'static str) {
        self.found.warnings.push((Location::Line(self.text.line()), what, remedy));
    }

    fn report(&self, import: &Import<'_>, row: u64) -> Result<(), LoadError> {
        if !row.is_multiple_of(STRIDE) {
            return Ok(());
        }
        let (done, left) = self.text.progress();
        let share = 0.9 * done as f32 / (done + left).max(1) as f32;
        import.options.report(import.path, LoadStage::Geometry, share)
    }

    fn vertices(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let count = self.header.vertices;
        if self.layout == LineLayout::Lines {
            if self.header.least_numbers() == 3 {
                self.plain_positions(import)?;
            }
            self.find_columns();
        }
        for row in self.polygons.positions.len() as u64..count {
            self.report(import, row)?;
            if !self.vertex_row().map_err(|what| self.malformed(import, format!("vertex {row}: {what}")))? {
                let what = format!("the header claims {count} vertices, and the file ends after {row}");
                return Err(self.malformed(import, what));
            }
            if self.numbers.values.len() < self.header.least_numbers() {
                let what = format!("vertex {row} has too few numbers");
                return Err(self.malformed(import, what));
            }
            let (position, rest) = self.numbers.values.split_at(3);
            self.polygons.positions.push(DVec3::from_slice(position));
            self.columns.push(rest, &mut self.polygons, &mut self.colors);
        }
        Ok(())
    }

    /// What rows that are not plain mean.
    fn find_columns(&mut self) {
        let known = self.polygons.positions.len();
        let left = self.header.vertices - known as u64;
        if left == 0 {
            return;
        }
        let mut columns = Columns::find(&self.header, self.text.clone(), left);
        if known > 0 && columns.surplus > 0 {
            // Those before have no more than a place.
            columns = Columns { is_uneven: true, ..Columns::of(&self.header) };
        }
        self.columns = columns;
        self.found.is_doubtful |= columns.is_uneven;
        if let Some(what) = columns.oddity() {
            let location = Location::Line(self.text.line() + 1);
            let remedy = "export the model again as NOFF, COFF or PLY";
            self.found.warnings.push((location, what, remedy));
        }
    }

    /// Reads the numbers of a vertex; false at the end of the file.
    fn vertex_row(&mut self) -> Result<bool, String> {
        match self.layout {
            LineLayout::Lines => match self.text.take_line() {
                Some(line) => self.numbers.read(line).map(|()| true),
                None => Ok(false),
            },
            LineLayout::Free | LineLayout::FreeWithColors => {
                self.numbers.values.clear();
                let count = self.header.all_numbers();
                self.numbers.read_on(&mut self.text, count).map(|read| read == count)
            }
        }
    }

    /// Reads pieces of plain rows, up to one that has any other row or that `add` does not take.
    fn plain_rows<T>(
        &mut self,
        import: &Import<'_>,
        read: impl Fn(&[u8]) -> Vec<Option<Piece<T>>>,
        add: impl Fn(&mut Polygons, T) -> bool,
    ) -> Result<(), LoadError> {
        loop {
            self.report(import, 0)?;
            // What is left of a line is no plain row.
            let Some(text) = self.text.whole_rows() else { return Ok(()) };
            let pieces = read(text.rest());
            if pieces.is_empty() {
                return Ok(());
            }
            for piece in pieces {
                let Some(Piece { bytes, lines, rows }) = piece else { return Ok(()) };
                if !add(&mut self.polygons, rows) {
                    return Ok(());
                }
                text.pass(bytes, lines);
            }
        }
    }

    fn plain_positions(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let count = self.header.vertices;
        self.plain_rows(import, plain::positions, |polygons, positions| {
            let fits = (polygons.positions.len() + positions.len()) as u64 <= count;
            if fits {
                polygons.positions.extend(positions);
            }
            fits
        })
    }

    fn faces(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let count = self.header.faces;
        self.plain_faces(import)?;
        let faces_on_lines = self.faces_on_lines(count);
        for row in self.polygons.face_sizes.len() as u64..count {
            self.report(import, row)?;
            if !self
                .face_row(faces_on_lines)
                .map_err(|what| self.malformed(import, format!("face {row}: {what}")))?
            {
                let what = format!("the header claims {count} faces, and the file ends after {row}");
                if self.layout != LineLayout::Lines {
                    return Err(self.malformed(import, what));
                }
                self.found.is_doubtful = true;
                self.warn(what, "copy or export the file again");
                return Ok(());
            }
            self.face(import, row)?;
        }
        if self.layout != LineLayout::Lines && self.text.next().is_some() {
            return Err(self.malformed(import, "there is more than the header claims".to_owned()));
        }
        Ok(())
    }

    /// Compares the faces that are left with the lines that are left.
    fn faces_on_lines(&self, count: u64) -> Ordering {
        let faces = count - self.polygons.face_sizes.len() as u64;
        if faces == 0 {
            return Ordering::Equal;
        }
        let (mut text, mut lines) = (self.text.clone(), 0);
        while lines <= faces && text.take_line().is_some() {
            lines += 1;
        }
        faces.cmp(&lines)
    }

    /// Reads the numbers of a face: how many vertices, these, and its colour; false at the end of the file.
    fn face_row(&mut self, faces_on_lines: Ordering) -> Result<bool, String> {
        let Self { numbers, text, .. } = self;
        if self.layout == LineLayout::Lines && faces_on_lines.is_eq() {
            let Some(line) = text.take_line() else { return Ok(false) };
            return numbers.read(line).map(|()| true);
        }
        numbers.values.clear();
        if numbers.read_on(text, 1)? == 0 {
            return Ok(false);
        }
        let corners = numbers.values[0];
        if self.layout != LineLayout::Lines && corners < 1.0 {
            return Err("has no vertices".to_owned());
        }
        // What is no count has no corners; the face says so.
        numbers.read_on(text, if corners >= 0.0 { corners as usize } else { 0 })?;
        // Where faces share lines, what follows is the next one.
        let has_colors = match self.layout {
            LineLayout::Lines => faces_on_lines.is_lt(),
            LineLayout::Free => false,
            LineLayout::FreeWithColors => true,
        };
        if has_colors {
            numbers.add(text.rest_of_line())?;
            text.pass_in_line(text.rest_of_line().len());
        }
        Ok(true)
    }

    fn face(&mut self, import: &Import<'_>, row: u64) -> Result<(), LoadError> {
        let numbers = take(&mut self.numbers);
        let (corners, color) =
            numbers.face().map_err(|what| self.malformed(import, format!("face {row} {what}")))?;
        let faces_before = self.polygons.face_sizes.len();
        if self.add_face(import, row, corners)? && (color.len() >= 3 || self.face_colors.len() > 0) {
            // Until the first one, no face has a colour.
            (self.face_colors.len()..faces_before).for_each(|_| self.face_colors.push(&[]));
            self.face_colors.push(color);
        }
        self.numbers = numbers;
        Ok(())
    }

    fn plain_faces(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let (OffHeader { vertices, faces, .. }, most) = (self.header, most_corners(import));
        let read = |text: &[u8]| plain::faces(text, vertices);
        self.plain_rows(import, read, |polygons, more| {
            let fits = (polygons.face_sizes.len() + more.sizes.len()) as u64 <= faces
                && polygons.corner_vertices.len() + more.vertices.len() <= most;
            if fits {
                polygons.face_sizes.extend(more.sizes);
                polygons.corner_vertices.extend(more.vertices);
            }
            fits
        })
    }

    /// Adds a face, or an edge if it has two vertices; whether it was a face.
    fn add_face(&mut self, import: &Import<'_>, row: u64, corners: &[f64]) -> Result<bool, LoadError> {
        let first = self.polygons.corner_vertices.len();
        if first + corners.len() + 2 * self.polygons.edges.len() > most_corners(import) {
            return Err(too_many_corners(import));
        }
        for &index in corners {
            if !(index >= 0.0 && index < self.header.vertices as f64 && index.fract() == 0.0) {
                let last = self.header.vertices as i64 - 1;
                let what = format!("face {row} names vertex {index}, and the vertices are 0 to {last}");
                return Err(self.malformed(import, what));
            }
            self.polygons.corner_vertices.push(index as u32);
        }
        if corners.len() == 2 {
            self.polygons.edges.push([corners[0] as u32, corners[1] as u32]);
            self.polygons.corner_vertices.truncate(first);
            return Ok(false);
        }
        self.polygons.face_sizes.push(corners.len() as u32);
        Ok(true)
    }
}

/// The numbers of a row.
#[derive(Default)]
pub(super) struct RowNumbers {
    pub(super) values: Vec<f64>,
}

impl RowNumbers {
    pub(super) fn read(&mut self, line: &[u8]) -> Result<(), String> {
        self.values.clear();
        self.add(line)
    }

    /// Adds those of a line.
    pub(super) fn add(&mut self, line: &[u8]) -> Result<(), String> {
        let mut rest = line.trim_ascii_start();
        while !rest.is_empty() {
            let (value, length) = first_number(rest)?;
            self.values.push(value);
            rest = rest[length..].trim_ascii_start();
        }
        Ok(())
    }

    /// Adds so many, whatever lines they stand on, or those up to the end; how many that were.
    pub(super) fn read_on(&mut self, text: &mut Words<'_>, count: usize) -> Result<usize, String> {
        for read in 0..count {
            let Some(word) = text.next() else { return Ok(read) };
            self.values.push(number(word)?);
        }
        Ok(count)
    }

    /// A row of a face: how many vertices, these, and what else there is: a colour.
    pub(super) fn face(&self) -> Result<(&[f64], &[f64]), String> {
        let (&count, rest) = self.values.split_first().ok_or("is empty")?;
        // No row has as many numbers as an f64 could round.
        if count >= 0.0 && count.fract() == 0.0 && count <= rest.len() as f64 {
            return Ok(rest.split_at(count as usize));
        }
        Err(format!("claims {count} vertices and has {} numbers", rest.len()))
    }
}
