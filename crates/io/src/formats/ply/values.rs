//! The numbers of a PLY, row by row, in text and in both byte orders: how reading an element ends, with progress and
//! cancellation.

use super::header::{ByteOrder, Element, Kind, Scalar};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::numbers::number;
use crate::options::LoadStage;
use crate::polygons::too_many_corners;
use crate::rows::{Rows, words};

/// Why a value cannot be read.
pub(super) enum Fault {
    /// The file is at its end.
    Ended,
    /// What is wrong with the row, after its name.
    Bad(String),
    /// There are more corners than the limits allow.
    TooMany,
}

/// A file that ended within an element.
pub(super) struct Ended {
    /// How many rows of it are whole.
    pub(super) rows: u64,
}

/// Rows of text that have more values than they should.
#[derive(Clone, Debug, Default)]
pub(super) struct Surplus {
    pub(super) count: usize,
    pub(super) first: Location,
}

/// Numbers in the order of the file.
pub(super) trait Values {
    /// Goes to the next row.
    fn begin_row(&mut self) -> Result<(), Fault>;

    /// The next number of the row.
    fn value(&mut self, scalar: Scalar) -> Result<f64, Fault>;

    /// Passes over so many numbers.
    fn pass(&mut self, scalar: Scalar, count: u32) -> Result<(), Fault>;

    /// All numbers of the row have been read.
    fn end_row(&mut self) {}

    /// Where in the file this is.
    fn location(&self) -> Location;

    /// How many bytes have been read, and how many have not.
    fn progress(&self) -> (usize, usize);

    /// How many bytes a number of a type takes at least.
    fn least_bytes(&self, scalar: Scalar) -> u64;

    fn surplus(&self) -> Surplus {
        Surplus::default()
    }

    /// The length of a list.
    fn count(&mut self, scalar: Scalar) -> Result<u32, Fault> {
        let count = self.value(scalar)?;
        if count >= 0.0 && count <= f64::from(u32::MAX) && count.fract() == 0.0 {
            return Ok(count as u32);
        }
        Err(Fault::Bad(format!("has a list of length {count}, and lengths are whole numbers from 0")))
    }

    /// Passes over a property.
    fn skip(&mut self, kind: Kind) -> Result<(), Fault> {
        match kind {
            Kind::Scalar(scalar) => self.pass(scalar, 1),
            Kind::List { count, item } => {
                let count = self.count(count)?;
                self.pass(item, count)
            }
        }
    }
}

/// Rows that are lines.
pub(super) struct Text<'a> {
    rows: Rows<'a>,
    rest: &'a [u8],
    surplus: Surplus,
}

impl<'a> Text<'a> {
    /// The lines after the header, which has so many.
    pub(super) fn new(lines: u64, text: &'a [u8]) -> Self {
        Self { rows: Rows::after(lines, text), rest: &[], surplus: Surplus::default() }
    }

    fn word(&mut self) -> Result<&'a [u8], Fault> {
        let start = self.rest.trim_ascii_start();
        let end = start.iter().position(u8::is_ascii_whitespace).unwrap_or(start.len());
        if end == 0 {
            return Err(Fault::Bad("has too few values".to_owned()));
        }
        self.rest = &start[end..];
        Ok(&start[..end])
    }
}

impl Values for Text<'_> {
    fn begin_row(&mut self) -> Result<(), Fault> {
        self.rest = self.rows.next().ok_or(Fault::Ended)?;
        Ok(())
    }

    fn value(&mut self, _: Scalar) -> Result<f64, Fault> {
        let word = self.word()?;
        number(word).map_err(|what| Fault::Bad(format!("cannot be read: {what}")))
    }

    fn pass(&mut self, _: Scalar, count: u32) -> Result<(), Fault> {
        (0..count).try_for_each(|_| self.word().map(drop))
    }

    fn end_row(&mut self) {
        if words(self.rest).next().is_some() {
            if self.surplus.count == 0 {
                self.surplus.first = self.location();
            }
            self.surplus.count += 1;
        }
    }

    fn location(&self) -> Location {
        Location::Line(self.rows.line())
    }

    fn progress(&self) -> (usize, usize) {
        self.rows.progress()
    }

    /// A digit, and what divides it from the next.
    fn least_bytes(&self, _: Scalar) -> u64 {
        2
    }

    fn surplus(&self) -> Surplus {
        self.surplus.clone()
    }
}

/// Rows without anything between them.
pub(super) struct Binary<'a> {
    order: ByteOrder,
    /// Where the data begin in the file.
    start: u64,
    data: &'a [u8],
    at: usize,
}

impl<'a> Binary<'a> {
    pub(super) fn new(order: ByteOrder, start: u64, data: &'a [u8]) -> Self {
        Self { order, start, data, at: 0 }
    }
}

impl Values for Binary<'_> {
    fn begin_row(&mut self) -> Result<(), Fault> {
        Ok(())
    }

    fn value(&mut self, scalar: Scalar) -> Result<f64, Fault> {
        let rest = &self.data[self.at..];
        if rest.len() < scalar.size() {
            return Err(Fault::Ended);
        }
        self.at += scalar.size();
        Ok(scalar.read(rest, self.order))
    }

    fn pass(&mut self, scalar: Scalar, count: u32) -> Result<(), Fault> {
        let bytes = scalar.size() as u64 * u64::from(count);
        if bytes > (self.data.len() - self.at) as u64 {
            return Err(Fault::Ended);
        }
        self.at += bytes as usize;
        Ok(())
    }

    fn location(&self) -> Location {
        Location::Byte(self.start + self.at as u64)
    }

    fn progress(&self) -> (usize, usize) {
        (self.at, self.data.len() - self.at)
    }

    fn least_bytes(&self, scalar: Scalar) -> u64 {
        scalar.size() as u64
    }
}

/// An element to its end, or to that of the file.
pub(super) type Outcome = Result<Result<(), Ended>, LoadError>;

/// So many rows are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 16;

/// Tells how far reading has come.
pub(super) fn report(import: &Import<'_>, row: u64, values: &impl Values) -> Result<(), LoadError> {
    if row.is_multiple_of(STRIDE) {
        let (done, left) = values.progress();
        let share = 0.9 * done as f32 / (done + left).max(1) as f32;
        import.options.report(import.path, LoadStage::Geometry, share)?;
    }
    Ok(())
}

/// What becomes of an element of which a row cannot be read.
pub(super) fn stopped<V: Values>(
    import: &Import<'_>,
    element: &Element,
    row: u64,
    values: &V,
    fault: Fault,
) -> Outcome {
    match fault {
        Fault::Ended => Ok(Err(Ended { rows: row })),
        Fault::Bad(what) => Err(broken(import, element, row, values, &what)),
        Fault::TooMany => Err(too_many_corners(import)),
    }
}

/// The error of a row that contradicts its header.
pub(super) fn broken(
    import: &Import<'_>,
    element: &Element,
    row: u64,
    values: &impl Values,
    what: &str,
) -> LoadError {
    let what = format!("{} {row} {what}", element.name);
    LoadError::malformed(import.path, what, "export the model again").at(values.location())
}

/// The error of a file that ends before its vertices do.
pub(super) fn cut_off(import: &Import<'_>, element: &Element, rows: u64, values: &impl Values) -> LoadError {
    let what = format!("the header claims {} vertices, and the file ends after {rows}", element.count);
    LoadError::new(LoadErrorKind::Malformed, import.path, what, "copy or export the file again")
        .at(values.location())
}

/// Passes over an element that means nothing here.
pub(super) fn skip<V: Values>(import: &Import<'_>, element: &Element, values: &mut V) -> Outcome {
    // Rows without properties take no room, however many there are said to be.
    let rows = if element.properties.is_empty() { 0 } else { element.count };
    for row in 0..rows {
        report(import, row, values)?;
        if let Err(fault) = skip_row(element, values) {
            return stopped(import, element, row, values, fault);
        }
    }
    Ok(Ok(()))
}

fn skip_row<V: Values>(element: &Element, values: &mut V) -> Result<(), Fault> {
    values.begin_row()?;
    element.properties.iter().try_for_each(|property| values.skip(property.kind))?;
    values.end_row();
    Ok(())
}
