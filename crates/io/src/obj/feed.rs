//! What stands between an OBJ file and tobj.
//!
//! tobj reads vertices and faces quickly, but it stops at the first odd byte
//! without saying where, wraps absurd indices, mistakes lines for polygons and
//! shifts vertex colours. So it reads from here: a `BufRead` that walks the
//! file once, checks every index, writes plain `v`, `vt`, `vn` and `f` lines in
//! small portions, and keeps groups, materials and smoothing to itself
//! ([`Record`]). One portion is in memory at a time. Since tobj takes one line
//! after the other, the number of lines taken says where it failed.

use std::io::{self, BufRead, Read};
use std::path::Path;

use super::corner::write_corner;
use super::index::{Corner, Counts, parse_corner};
use super::lines::{Lines, split_keyword, words};
use super::numbers::copy_numbers;
use super::oddities::Oddities;
use super::record::Record;
use crate::error::{LoadError, Place};
use crate::options::{LoadOptions, Stage};
use crate::warning::Warnings;

/// About how many bytes are prepared at a time.
const PORTION: usize = 1 << 16;

/// Whether the vertices have colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Colors {
    /// Decided by the first vertex.
    Unknown,
    /// None has.
    Absent,
    /// Some have; the others are white.
    Present,
}

/// Why the feed stopped.
#[derive(Debug)]
pub(crate) enum Stop {
    /// A colour came after vertices without: start again with
    /// [`Colors::Present`].
    LateColor,
    Error(LoadError),
}

/// Where to read from and what is known beforehand.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    pub(crate) path: &'a Path,
    pub(crate) text: &'a [u8],
    pub(crate) total: Counts,
    pub(crate) options: &'a LoadOptions<'a>,
}

pub(crate) struct Feed<'a> {
    source: Source<'a>,
    lines: Lines<'a>,
    seen: Counts,
    colors: Colors,
    record: Record,
    corners: usize,
    oddities: Oddities,
    /// The first line with a position that is not finite.
    non_finite_line: Option<u64>,
    portion: Vec<u8>,
    taken: usize,
    /// The file's line of each line of the portion, and how many were taken.
    portion_lines: Vec<u64>,
    taken_lines: usize,
    stop: Option<Stop>,
    corner_buffer: Vec<Corner>,
}

impl<'a> Feed<'a> {
    pub(crate) fn new(source: Source<'a>, colors: Colors) -> Self {
        let mut feed = Self {
            source,
            lines: Lines::new(source.text),
            seen: Counts::default(),
            colors,
            record: Record::default(),
            corners: 0,
            oddities: Oddities::default(),
            non_finite_line: None,
            portion: Vec::with_capacity(PORTION + PORTION / 4),
            taken: 0,
            portion_lines: Vec::new(),
            taken_lines: 0,
            stop: None,
            corner_buffer: Vec::new(),
        };
        // What corners without a coordinate or normal refer to, see `write_corner`.
        if source.total.coordinates > 0 {
            feed.emit(0, b"vt nan nan\n");
        }
        if source.total.normals > 0 {
            feed.emit(0, b"vn nan nan nan\n");
        }
        feed
    }

    pub(crate) fn take_stop(&mut self) -> Option<Stop> {
        self.stop.take()
    }

    /// The line that tobj took last.
    pub(crate) fn last_line(&self) -> u64 {
        self.portion_lines.get(self.taken_lines.wrapping_sub(1)).copied().unwrap_or(0)
    }

    /// Warns of what was odd, and hands over what was recorded.
    pub(crate) fn finish(self, warnings: &mut Warnings) -> (Record, Option<u64>) {
        self.oddities.warn(warnings);
        (self.record, self.non_finite_line)
    }

    fn emit(&mut self, line: u64, text: &[u8]) {
        self.portion.extend_from_slice(text);
        self.portion_lines.push(line);
    }

    fn error(&self, line: u64, what: impl Into<String>, remedy: &str) -> Stop {
        Stop::Error(LoadError::malformed(self.source.path, what, remedy).at(Place::Line(line)))
    }

    fn refill(&mut self) -> Result<(), Stop> {
        self.portion.clear();
        self.portion_lines.clear();
        (self.taken, self.taken_lines) = (0, 0);
        let within = self.lines.position() as f32 / self.source.text.len().max(1) as f32;
        // The last quarter is for building the mesh.
        self.source.options.report(self.source.path, Stage::Geometry, within * 0.75).map_err(Stop::Error)?;
        while self.portion.len() < PORTION {
            let Some((number, line)) = self.lines.next() else { break };
            self.line(number, &line)?;
        }
        Ok(())
    }

    fn line(&mut self, number: u64, line: &[u8]) -> Result<(), Stop> {
        let Some((keyword, rest)) = split_keyword(line) else { return Ok(()) };
        match keyword {
            b"v" => self.position(number, rest)?,
            b"vt" => self.numbers(number, "vt", rest, 2)?,
            b"vn" => self.numbers(number, "vn", rest, 3)?,
            b"f" | b"fo" => self.face(number, rest)?,
            b"l" => self.polyline(number, rest)?,
            b"p" => self.points(number, rest)?,
            b"o" => self.record.set_object(rest),
            b"g" => self.record.set_group(rest),
            b"s" => self.record.set_smoothing(rest),
            b"usemtl" => self.record.set_material(number, rest),
            b"mtllib" => self.record.add_library(number, rest),
            b"curv" | b"curv2" | b"surf" => self.oddities.unknown.add(number),
            _ => {}
        }
        Ok(())
    }

    fn position(&mut self, number: u64, rest: &[u8]) -> Result<(), Stop> {
        self.seen.positions += 1;
        let start = self.portion.len();
        self.portion.push(b'v');
        let tally = copy_numbers(rest, 6, &mut self.portion)
            .map_err(|what| self.error(number, what, "write plain decimal numbers"))?;
        if tally.count < 3 {
            let what = format!("a vertex has {} numbers and needs 3", tally.count);
            return Err(self.error(number, what, "export the model again"));
        }
        let colored = tally.count == 6;
        match (self.colors, colored) {
            (Colors::Unknown, _) => self.colors = if colored { Colors::Present } else { Colors::Absent },
            (Colors::Absent, true) => return Err(Stop::LateColor),
            _ => {}
        }
        if tally.surplus || tally.count == 5 {
            self.oddities.surplus.add(number);
        }
        if tally.non_finite {
            self.non_finite_line.get_or_insert(number);
        }
        if !colored && (tally.count == 5 || self.colors == Colors::Present) {
            self.respell_uncolored(start);
        }
        if !colored && self.colors == Colors::Present {
            self.portion.extend_from_slice(b" 1 1 1");
            self.oddities.colorless.add(number);
        }
        self.portion.push(b'\n');
        self.portion_lines.push(number);
        Ok(())
    }

    /// Cuts the vertex that starts at `start` to its three coordinates.
    fn respell_uncolored(&mut self, start: usize) {
        let line = self.portion.split_off(start);
        self.portion.push(b'v');
        for word in words(&line[1..]).take(3) {
            self.portion.push(b' ');
            self.portion.extend_from_slice(word);
        }
    }

    fn numbers(
        &mut self,
        number: u64,
        keyword: &'static str,
        rest: &[u8],
        needed: usize,
    ) -> Result<(), Stop> {
        let seen = if keyword == "vt" { &mut self.seen.coordinates } else { &mut self.seen.normals };
        *seen += 1;
        self.portion.extend_from_slice(keyword.as_bytes());
        let tally = copy_numbers(rest, 3, &mut self.portion)
            .map_err(|what| self.error(number, what, "write plain decimal numbers"))?;
        // A texture coordinate may be a single number.
        if keyword == "vt" && tally.count == 1 {
            self.portion.extend_from_slice(b" 0");
        } else if tally.count < needed {
            let what = format!("a {keyword} line has {} numbers and needs {needed}", tally.count);
            return Err(self.error(number, what, "export the model again"));
        }
        self.portion.push(b'\n');
        self.portion_lines.push(number);
        Ok(())
    }

    /// Reads the corners of an element into the buffer.
    fn corners(&mut self, number: u64, rest: &[u8]) -> Result<(), Stop> {
        self.corner_buffer.clear();
        for word in words(rest) {
            let parsed = parse_corner(word, self.seen, self.source.total);
            let corner = parsed
                .map_err(|what| self.error(number, what, "export the model again, or mend the line"))?;
            if corner.dropped {
                self.oddities.dropped_indices.add(number);
            }
            self.corner_buffer.push(corner);
        }
        self.corners += self.corner_buffer.len();
        let limit = self.source.options.limits.corners;
        if self.corners > limit {
            let what = format!("the faces have more than {limit} corners");
            return Err(Stop::Error(LoadError::limit(self.source.path, what).at(Place::Line(number))));
        }
        Ok(())
    }

    fn face(&mut self, number: u64, rest: &[u8]) -> Result<(), Stop> {
        self.corners(number, rest)?;
        if self.corner_buffer.len() < 3 {
            self.oddities.short_faces.add(number);
            return Ok(());
        }
        self.record.faces += 1;
        self.emit_element(number, 0, self.corner_buffer.len());
        Ok(())
    }

    fn polyline(&mut self, number: u64, rest: &[u8]) -> Result<(), Stop> {
        self.corners(number, rest)?;
        for start in 1..self.corner_buffer.len() {
            self.emit_element(number, start - 1, 2);
        }
        Ok(())
    }

    fn points(&mut self, number: u64, rest: &[u8]) -> Result<(), Stop> {
        self.corners(number, rest)?;
        for start in 0..self.corner_buffer.len() {
            self.emit_element(number, start, 1);
        }
        Ok(())
    }

    fn emit_element(&mut self, number: u64, start: usize, length: usize) {
        self.record.add_element();
        self.portion.push(b'f');
        for corner in &self.corner_buffer[start..start + length] {
            write_corner(&mut self.portion, corner, self.source.total);
        }
        self.portion.push(b'\n');
        self.portion_lines.push(number);
    }
}

impl Read for Feed<'_> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let available = self.fill_buf()?;
        let length = available.len().min(into.len());
        into[..length].copy_from_slice(&available[..length]);
        self.consume(length);
        Ok(length)
    }
}

impl BufRead for Feed<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        while self.taken == self.portion.len() {
            let at = self.lines.position();
            if let Err(stop) = self.refill() {
                self.stop = Some(stop);
                return Err(io::Error::other("stopped"));
            }
            if self.lines.position() == at {
                break;
            }
        }
        Ok(&self.portion[self.taken..])
    }

    fn consume(&mut self, amount: usize) {
        let taken = &self.portion[self.taken..self.taken + amount];
        // Line by line this is one newline, at the end.
        self.taken_lines += taken.iter().rev().take(1).filter(|&&byte| byte == b'\n').count();
        self.taken += amount;
    }
}
