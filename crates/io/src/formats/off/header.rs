//! The start of an OFF: the attributes of vertices, the numbers of vertices and faces, and what the numbers
//! in a row of a vertex mean. The keyword tells, but MeshLab writes colours before normals, and others write
//! colours without saying so.

use trigon_math::{DVec3, Vec2};

use super::reader::RowNumbers;
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::polygons::{Polygons, RawColors};
use crate::rows::{Rows, Words, quoted, words};

/// What helps against most faults.
pub(super) const REMEDY: &str = "fix the line, or export the model again";

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct OffHeader {
    pub(super) has_normals: bool,
    pub(super) has_colors: bool,
    pub(super) has_uvs: bool,
    pub(super) vertices: u64,
    pub(super) faces: u64,
}

impl OffHeader {
    /// How many numbers a vertex has at least.
    pub(super) fn least_numbers(&self) -> usize {
        let count = |is_there: bool, numbers: usize| if is_there { numbers } else { 0 };
        3 + count(self.has_normals, 3) + count(self.has_colors, 3) + count(self.has_uvs, 2)
    }

    /// How many it has where no line ends it: a colour has its alpha then.
    pub(super) fn all_numbers(&self) -> usize {
        self.least_numbers() + usize::from(self.has_colors)
    }
}

/// Whether a file starts as an OFF does.
pub(crate) fn is_off(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1 << 12)];
    // Words of people may begin with a small "off".
    let is_keyword =
        |line: &[u8]| line.windows(3).any(|word| word == b"OFF") && split_keyword(line).is_some();
    Rows::without_comments(start).next().is_some_and(is_keyword)
}

/// The letters before `OFF`, and how many bytes both are: some files have the counts behind them, even
/// without a space between.
fn split_keyword(line: &[u8]) -> Option<(Vec<u8>, usize)> {
    let at = line.windows(3).take(8).position(|window| window.eq_ignore_ascii_case(b"OFF"))?;
    let (prefix, rest) = (&line[..at], &line[at + 3..]);
    // A small n before large letters counts dimensions.
    let prefix = if &line[at..at + 3] == b"off" { prefix.to_ascii_uppercase() } else { prefix.to_vec() };
    let is_end = rest.first().is_none_or(|byte| byte.is_ascii_whitespace() || byte.is_ascii_digit());
    (is_end && prefix.iter().all(|byte| b"STCN4n".contains(byte))).then_some((prefix, at + 3))
}

pub(super) fn read_header(import: &Import<'_>, text: &mut Words<'_>) -> Result<OffHeader, LoadError> {
    let path = import.path;
    let first = text.line_ahead();
    if first.is_empty() {
        let remedy = "export the model again";
        return Err(LoadError::new(LoadErrorKind::Empty, path, "the file is empty", remedy));
    }
    let mut header = OffHeader::default();
    // The keyword may be left out.
    if let Some((prefix, length)) = split_keyword(first) {
        text.pass_in_line(length);
        if prefix.iter().any(|letter| b"4n".contains(letter))
            || words(text.rest_of_line()).any(|word| word == b"BINARY")
        {
            let what = format!("it is of the kind {}, which is not read", quoted(first));
            let remedy = "save it as text in three dimensions, or as PLY";
            return Err(LoadError::new(LoadErrorKind::Unsupported, path, what, remedy));
        }
        header.has_uvs = prefix.starts_with(b"ST");
        header.has_colors = prefix.contains(&b'C');
        header.has_normals = prefix.contains(&b'N');
    }
    header.vertices = read_count(import, text)?;
    let line = text.line();
    header.faces = read_count(import, text)?;
    pass_edge_count(text, line);
    Ok(header)
}

fn read_count(import: &Import<'_>, text: &mut Words<'_>) -> Result<u64, LoadError> {
    let word = text.next().unwrap_or_default();
    count(word).ok_or_else(|| {
        let what = format!("{} does not tell how many vertices and faces there are", quoted(word));
        LoadError::malformed(import.path, what, REMEDY).at(Location::Line(text.line()))
    })
}

fn count(word: &[u8]) -> Option<u64> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// Some files leave the number of edges out, which nothing uses. `line` is that of the number of vertices.
fn pass_edge_count(text: &mut Words<'_>, line: u64) {
    let mut ahead = text.clone();
    let is_on_line = !text.rest_of_line().is_empty();
    let is_number = ahead.next().and_then(count).is_some();
    // On the next line it stands alone.
    let is_alone = ahead.rest_of_line().is_empty();
    if is_number && (is_on_line || line != text.line() || is_alone) {
        *text = ahead;
    }
}

/// Where the values of a vertex stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Columns {
    pub(super) has_normals: bool,
    pub(super) has_colors: bool,
    pub(super) has_uvs: bool,
    /// Whether colours come before normals.
    pub(super) colors_first: bool,
    /// How many numbers a row has beyond its place, that the keyword does not announce.
    pub(super) surplus: usize,
    /// Whether rows differ in their numbers where they should not.
    pub(super) is_uneven: bool,
}

/// What three numbers look like in all rows.
#[derive(Clone, Copy)]
struct Looks {
    /// None is negative.
    color: bool,
    /// Of about unit length, or zero.
    normal: bool,
    /// Of unit length but for rounding.
    unit: bool,
    /// Some have a length, and some number is neither 0 nor 1, as those of pure colours are.
    has_length: bool,
    is_telling: bool,
}

impl Looks {
    const ALL: Self = Self { color: true, normal: true, unit: true, has_length: false, is_telling: false };

    fn see(&mut self, values: &[f64]) {
        /// Normals are written with few digits, and not always as unit vectors.
        const LENGTHS: std::ops::RangeInclusive<f64> = 0.8..=1.2;
        const ROUNDING: f64 = 0.01;
        let length = DVec3::from_slice(values).length();
        self.color &= values.iter().all(|&value| value >= 0.0);
        self.normal &= length == 0.0 || LENGTHS.contains(&length);
        self.unit &= (length - 1.0).abs() < ROUNDING;
        self.has_length |= length > 0.0;
        self.is_telling |= values.iter().any(|&value| value != 0.0 && value != 1.0);
    }
}

impl Columns {
    /// As the keyword says.
    pub(super) fn of(header: &OffHeader) -> Self {
        let &OffHeader { has_normals, has_colors, has_uvs, .. } = header;
        Self { has_normals, has_colors, has_uvs, ..Self::default() }
    }

    /// As the rows ahead say, of which there are so many.
    pub(super) fn find(header: &OffHeader, mut text: Words<'_>, rows: u64) -> Self {
        let columns = Self::of(header);
        let is_plain = header.least_numbers() == 3;
        let is_open = header.has_normals && header.has_colors && !header.has_uvs;
        if !is_plain && !is_open {
            return columns;
        }
        let (mut numbers, mut width, mut is_uneven) = (RowNumbers::default(), None, false);
        let (mut first, mut last) = (Looks::ALL, Looks::ALL);
        for _ in 0..rows {
            let Some(line) = text.take_line() else { break };
            if numbers.read(line).is_err() || numbers.values.len() < header.least_numbers() {
                break;
            }
            let count = numbers.values.len();
            is_uneven |= *width.get_or_insert(count) != count;
            if count >= 6 {
                first.see(&numbers.values[3..6]);
                last.see(&numbers.values[count - 3..]);
            }
        }
        let width = width.unwrap_or(3);
        if is_open {
            let is_as_announced = first.normal && first.has_length && last.color;
            let colors_first = first.color && last.normal && !is_as_announced;
            return Self { colors_first, ..columns };
        }
        Self { is_uneven, ..columns.guessed(if is_uneven { 3 } else { width }, first, last) }
    }

    /// Of rows with so many numbers under a keyword for places alone.
    fn guessed(self, width: usize, first: Looks, last: Looks) -> Self {
        let surplus = width - 3;
        // Few surfaces have no normal with a negative part.
        let is_normal = first.normal && (!first.color || first.unit && first.is_telling);
        match width {
            6 if is_normal => Self { has_normals: true, surplus, ..self },
            6 | 7 if first.color => Self { has_colors: true, surplus, ..self },
            9 | 10 if first.normal && !first.color => {
                Self { has_normals: true, has_colors: true, surplus, ..self }
            }
            9 | 10 if first.color && last.normal => {
                Self { has_normals: true, has_colors: true, colors_first: true, surplus, ..self }
            }
            _ => Self { surplus, ..self },
        }
    }

    /// What is odd about the rows, and what is made of it.
    pub(super) fn oddity(&self) -> Option<String> {
        if self.is_uneven {
            return Some(
                "rows of vertices differ in their numbers, and those after the place are not read".to_owned(),
            );
        }
        let taken = match (self.has_normals, self.has_colors) {
            (true, true) if self.colors_first && self.surplus == 0 => {
                return Some(
                    "the colours of vertices stand before their normals, as MeshLab writes them".to_owned(),
                );
            }
            _ if self.surplus == 0 => return None,
            (true, true) => "taken as normals and colours",
            (true, false) => "taken as normals",
            (false, true) => "taken as colours",
            (false, false) => "not read",
        };
        Some(format!("vertices have {} numbers after their places, which are {taken}", self.surplus))
    }

    /// Adds the values of a vertex after its place.
    pub(super) fn push(&self, values: &[f64], polygons: &mut Polygons, colors: &mut RawColors) {
        let uvs = if self.has_uvs { 2 } else { 0 };
        let (mut rest, uv) = values.split_at(values.len().saturating_sub(uvs));
        if self.has_uvs {
            // OFF counts v upwards.
            let uv = Vec2::new(uv[0] as f32, (1.0 - uv[1]) as f32);
            polygons.uvs.push(if uv.is_finite() { uv } else { Vec2::ZERO });
        }
        if self.has_normals {
            let normal;
            (normal, rest) = match self.colors_first {
                true => {
                    rest.split_last_chunk::<3>().map_or((&[0.0; 3], rest), |(rest, normal)| (normal, rest))
                }
                false => {
                    rest.split_first_chunk::<3>().map_or((&[0.0; 3], rest), |(normal, rest)| (normal, rest))
                }
            };
            polygons.normals.push(DVec3::from_array(*normal).as_vec3());
        }
        if self.has_colors {
            colors.push(rest);
        }
    }
}
