//! STL as text: `facet`, three lines `vertex`, `endfacet`; any number of solids.

use trigon_math::DVec3;

use super::solid::Solid;
use crate::error::{LoadError, Place};
use crate::import::Import;
use crate::numbers::number;
use crate::options::LoadStage;
use crate::polygons::{Polygons, check_solids, most_corners, too_many_corners};
use crate::rows::{Rows, quoted, words};

/// So many lines are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 18;

/// The solids while they are read.
#[derive(Default)]
struct Reader {
    done: Vec<Polygons>,
    /// The one that facets go to.
    solid: Solid,
    /// Of all solids.
    corner_count: usize,
    /// The vertices of the facet so far.
    corners: Vec<DVec3>,
}

pub(super) fn read(import: &mut Import<'_>, text: &[u8]) -> Result<Vec<Polygons>, LoadError> {
    let mut reader = Reader::default();
    let mut rows = Rows::after(0, text);
    while let Some(line) = rows.next() {
        if rows.line().is_multiple_of(STRIDE) {
            let (done, left) = rows.progress();
            import.options.report(
                import.path,
                LoadStage::Geometry,
                0.9 * done as f32 / (done + left) as f32,
            )?;
        }
        reader.line(import, rows.line(), line)?;
    }
    if !reader.corners.is_empty() {
        import.warnings.push(
            Place::Line(rows.line()),
            "the file ends within a facet, which is left out",
            "copy or export the file again",
        );
    }
    reader.begin_solid(import, String::new())?;
    Ok(reader.done)
}

impl Reader {
    fn line(&mut self, import: &mut Import<'_>, number: u64, line: &[u8]) -> Result<(), LoadError> {
        let mut rest = words(line);
        let keyword = rest.next().unwrap_or_default().to_ascii_lowercase();
        match keyword.as_slice() {
            b"vertex" => {
                let corner = place(rest).map_err(|what| {
                    LoadError::malformed(import.path, what, "fix the line, or export the model again")
                        .at(Place::Line(number))
                })?;
                self.corners.push(corner);
            }
            b"endfacet" | b"facet" => self.facet(import)?,
            b"solid" => {
                self.facet(import)?;
                let name = String::from_utf8_lossy(&line[keyword.len()..]).trim().to_owned();
                self.begin_solid(import, name)?;
            }
            b"outer" | b"endloop" | b"endsolid" => {}
            _ => import.warnings.push(
                Place::Line(number),
                format!("the statement {} is not one of STL and is ignored", quoted(&keyword)),
                "export the model again",
            ),
        }
        Ok(())
    }

    /// Ends a facet.
    fn facet(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        if self.corners.is_empty() {
            return Ok(());
        }
        self.corner_count += self.corners.len();
        if self.corner_count > most_corners(import) {
            return Err(too_many_corners(import));
        }
        self.solid.push(import, &self.corners)?;
        self.corners.clear();
        Ok(())
    }

    /// Ends a solid and begins the next. One without facets leaves nothing.
    fn begin_solid(&mut self, import: &Import<'_>, name: String) -> Result<(), LoadError> {
        let solid = std::mem::replace(&mut self.solid, Solid::named(name));
        if !solid.polygons.face_sizes.is_empty() {
            self.done.push(solid.polygons);
            check_solids(import, self.done.len())?;
        }
        Ok(())
    }
}

fn place<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Result<DVec3, String> {
    let mut coordinate = || match words.next() {
        Some(word) => number(word),
        None => Err("a vertex has fewer than 3 coordinates".to_owned()),
    };
    Ok(DVec3::new(coordinate()?, coordinate()?, coordinate()?))
}
