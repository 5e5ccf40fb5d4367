//! Reads one piece of an OBJ: its vertices and elements, with indices into the whole file, and the positions
//! of statements whose meaning depends on the pieces before (`o`, `g`, `usemtl`, `s`, `mtllib`).

use trigon_math::{DVec3, Vec2, Vec3};

use super::index::{Corner, Corners, Counts, is_flat, read_corners};
use super::lines::Chunk;
use super::lines::{Lines, split_keyword};
use super::oddities::{Oddities, Oddity, Tally};
use super::oddities::{Unread, judge};
use super::record::{Content, WHITE};
use crate::numbers::{Numbers, read_numbers};

/// A statement that says something about the elements that follow it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Statement {
    /// How many elements of its piece come before.
    pub(crate) elements_before: u32,
    /// How many bytes of its piece come before.
    pub(crate) at: u32,
    pub(crate) line: u64,
}

/// What was read of a piece.
#[derive(Debug, Default)]
pub(crate) struct Section {
    pub(crate) content: Content,
    pub(crate) statements: Vec<Statement>,
    pub(crate) oddities: Oddities,
    /// Vertices without a colour: odd if others have one.
    pub(crate) colorless: Tally,
    /// The first line with a position that is not finite.
    pub(crate) non_finite_line: Option<u64>,
    /// The first face with fewer than 3 different vertices.
    pub(crate) flat_line: Option<u64>,
    /// The first line or point statement.
    pub(crate) wire_line: Option<u64>,
    /// Of all elements, those that were left out, too.
    pub(crate) corners: usize,
    /// Why reading stopped before the end.
    pub(crate) stop: Option<Stop>,
}

/// What ends the reading of a file, and at which line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stop {
    pub(crate) line: u64,
    pub(crate) what: String,
    pub(crate) remedy: &'static str,
}

/// Reads a piece up to its end, the first malformed line, or the line that has
/// more than so many corners.
pub(crate) fn read_section(chunk: &Chunk<'_>, total: Counts, most_corners: usize) -> Section {
    let mut reader =
        SectionReader { section: Section::default(), before: chunk.before, total, corners: Vec::new() };
    let mut lines = Lines::new(chunk.text);
    loop {
        let at = lines.position();
        let Some((line, text)) = lines.next() else { break };
        let line = chunk.lines_before + line;
        if let Err(fault) = reader.line(line, at, &text) {
            let StatementFault { what, remedy } = fault;
            reader.section.stop = Some(Stop { line, what, remedy });
            break;
        }
        if reader.section.corners > most_corners {
            break;
        }
    }
    reader.section
}

/// What is wrong with a line and what to do about it.
struct StatementFault {
    what: String,
    remedy: &'static str,
}

impl StatementFault {
    fn new(what: impl Into<String>, remedy: &'static str) -> Self {
        Self { what: what.into(), remedy }
    }
}

struct SectionReader {
    section: Section,
    before: Counts,
    total: Counts,
    /// Of the element that is being read.
    corners: Vec<Corner>,
}

impl SectionReader {
    fn line(&mut self, line: u64, at: usize, text: &[u8]) -> Result<(), StatementFault> {
        let Some((keyword, rest)) = split_keyword(text) else { return Ok(()) };
        match keyword {
            b"v" => self.position(line, rest),
            b"vt" => self.coordinate(line, rest),
            b"vn" => self.normal(line, rest),
            b"f" | b"fo" => self.face(line, rest),
            b"l" => self.polyline(line, rest),
            b"p" => self.points(line, rest),
            b"o" | b"g" | b"s" | b"usemtl" | b"mtllib" => {
                let elements_before = self.section.content.arities.len() as u32;
                self.section.statements.push(Statement { elements_before, at: at as u32, line });
                Ok(())
            }
            _ => {
                match judge(keyword, rest) {
                    Unread::Harmless => {}
                    Unread::Noted(oddity) => self.note(oddity, line),
                    Unread::Unknown => self.section.oddities.unknown.note(keyword, line),
                }
                Ok(())
            }
        }
    }

    fn note(&mut self, oddity: Oddity, line: u64) {
        self.section.oddities.note(oddity, line);
    }

    /// x, y, z; then nothing, or a weight, or a colour.
    fn position(&mut self, line: u64, rest: &[u8]) -> Result<(), StatementFault> {
        self.before.positions += 1;
        let Numbers { values, count, surplus } = numbers::<6>(rest)?;
        if count < 3 {
            let what = format!("a vertex has {count} numbers and needs 3");
            return Err(StatementFault::new(what, EXPORT_AGAIN));
        }
        let mut position = DVec3::new(values[0], values[1], values[2]);
        if count == 4 {
            if values[3] == 0.0 {
                return Err(StatementFault::new("a vertex has the weight 0", EXPORT_AGAIN));
            }
            position /= values[3];
        }
        if surplus || count == 5 {
            self.note(Oddity::SurplusInVertex, line);
        }
        if !position.is_finite() {
            self.section.non_finite_line.get_or_insert(line);
        }
        self.color(line, (count == 6).then_some([values[3], values[4], values[5]]));
        self.section.content.positions.push(position);
        Ok(())
    }

    fn color(&mut self, line: u64, color: Option<[f64; 3]>) {
        let Some(color) = color else { return self.section.colorless.add(line) };
        let is_outside = |&value: &f64| value.is_finite() && !(0.0..=1.0).contains(&value);
        if color.iter().any(is_outside) {
            self.note(Oddity::ColorOutOfRange, line);
        }
        let Content { positions, colors, .. } = &mut self.section.content;
        let channel = |value: f64| if value.is_finite() { value.clamp(0.0, 1.0) as f32 } else { f32::NAN };
        colors.resize(positions.len(), WHITE);
        colors.push(Vec3::from(color.map(channel)));
    }

    /// u and v; v may be missing, and a third number is for images of three dimensions.
    fn coordinate(&mut self, line: u64, rest: &[u8]) -> Result<(), StatementFault> {
        self.before.coordinates += 1;
        let Numbers { values: [u, v, _], count, surplus } = numbers::<3>(rest)?;
        if count == 0 {
            return Err(StatementFault::new("a vt line has 0 numbers and needs 2", EXPORT_AGAIN));
        }
        // OBJ counts from the lower left of the image.
        let coordinate = Vec2::new(u as f32, (1.0 - v) as f32);
        if surplus {
            self.note(Oddity::SurplusInAttribute, line);
        }
        if !coordinate.is_finite() {
            self.note(Oddity::OddCoordinate, line);
        }
        self.section.content.coordinates.push(coordinate);
        Ok(())
    }

    fn normal(&mut self, line: u64, rest: &[u8]) -> Result<(), StatementFault> {
        self.before.normals += 1;
        let Numbers { values, count, surplus } = numbers::<3>(rest)?;
        if count < 3 {
            let what = format!("a vn line has {count} numbers and needs 3");
            return Err(StatementFault::new(what, EXPORT_AGAIN));
        }
        let normal = DVec3::from(values).as_vec3();
        if surplus {
            self.note(Oddity::SurplusInAttribute, line);
        }
        if !normal.is_finite() || normal == Vec3::ZERO {
            self.note(Oddity::NoDirection, line);
        }
        self.section.content.normals.push(normal);
        Ok(())
    }

    fn face(&mut self, line: u64, rest: &[u8]) -> Result<(), StatementFault> {
        let Corners { count, coordinates, normals, dropped } = self.read_corners(line, rest)?;
        if count < 3 {
            self.note(Oddity::ShortFace, line);
            return Ok(());
        }
        if dropped == 0 && coordinates != 0 && coordinates < count {
            self.note(Oddity::MixedCoordinates, line);
        }
        if dropped == 0 && normals != 0 && normals < count {
            self.note(Oddity::MixedNormals, line);
        }
        if self.section.flat_line.is_none() && is_flat(&self.corners) {
            self.section.flat_line = Some(line);
        }
        self.push_element(0, count);
        Ok(())
    }

    fn polyline(&mut self, line: u64, rest: &[u8]) -> Result<(), StatementFault> {
        let count = self.read_wire(line, rest, 2)?;
        for end in 1..count {
            self.push_element(end - 1, 2);
        }
        Ok(())
    }

    fn points(&mut self, line: u64, rest: &[u8]) -> Result<(), StatementFault> {
        for point in 0..self.read_wire(line, rest, 1)? {
            self.push_element(point, 1);
        }
        Ok(())
    }

    /// Reads the corners of lines or points, and says how many there are.
    fn read_wire(&mut self, line: u64, rest: &[u8], fewest: usize) -> Result<usize, StatementFault> {
        let Corners { count, coordinates, .. } = self.read_corners(line, rest)?;
        if count < fewest {
            self.note(Oddity::ShortLine, line);
        }
        if coordinates > 0 {
            self.note(Oddity::WireCoordinate, line);
        }
        self.section.wire_line.get_or_insert(line);
        Ok(count)
    }

    /// Reads the corners of an element.
    fn read_corners(&mut self, line: u64, rest: &[u8]) -> Result<Corners, StatementFault> {
        let found = read_corners(rest, self.before, self.total, &mut self.corners)
            .map_err(|what| StatementFault::new(what, "export the model again, or fix the line"))?;
        for _ in 0..found.dropped {
            self.note(Oddity::IndexDropped, line);
        }
        self.section.corners += found.count;
        Ok(found)
    }

    /// An element of some of the corners that were read.
    fn push_element(&mut self, start: usize, length: usize) {
        let content = &mut self.section.content;
        let corners = &self.corners[start..start + length];
        content.arities.push(length as u32);
        content.position_indices.extend(corners.iter().map(|corner| corner.position));
        if self.total.coordinates > 0 {
            content.coordinate_indices.extend(corners.iter().map(|corner| corner.coordinate));
        }
        if self.total.normals > 0 {
            content.normal_indices.extend(corners.iter().map(|corner| corner.normal));
        }
    }
}

const EXPORT_AGAIN: &str = "export the model again";

fn numbers<const MOST: usize>(rest: &[u8]) -> Result<Numbers<MOST>, StatementFault> {
    read_numbers(rest).map_err(|what| StatementFault::new(what, "write plain decimal numbers"))
}
