//! How reading an element ends, and its progress and cancellation.

use super::header::Element;
use super::values::{Ended, Fault, Values};
use crate::error::{LoadError, LoadErrorKind};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::too_many_corners;

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
