//! OFF, the object file format of Geomview (University of Minnesota, 1991), as text: with normals (NOFF),
//! colours (COFF) and texture coordinates (STOFF) of vertices, and colours of faces.
//!
//! The crate `off-rs` 2.0 has limits and names lines in errors, but it reads neither normals nor texture
//! coordinates, reads colours only of a kind that the caller knows beforehand, and no file with a face of two
//! vertices.

mod header;
mod plain;
mod rows;
mod write;

use std::borrow::Cow;

use trigon_math::{DVec3, Vec2, Vec4};

use self::header::{Header, REMEDY, read_header};
use self::plain::Piece;
use self::rows::Numbers;
use crate::error::{LoadError, Place};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{
    Polygons, add_polygons, check_vertices, light_from_srgb, most_corners, too_many_corners,
};
use crate::rows::Rows;

pub(crate) use header::is_off;
pub(crate) use write::write_off;

/// So many rows are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 16;

/// Reads an OFF into the scene.
pub(crate) fn import_off(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let mut rows = Rows::without_comments(&bytes);
    let header = read_header(import, &mut rows)?;
    check_vertices(import, header.vertices)?;
    let mut reader = Reader { header, rows, polygons: Polygons::default(), colors: Colors::default() };
    reader.vertices(import)?;
    reader.faces(import)?;
    let polygons = reader.finish();
    drop(bytes);
    add_polygons(import, vec![polygons])
}

/// A file while it is read.
struct Reader<'a> {
    header: Header,
    rows: Rows<'a>,
    polygons: Polygons,
    /// Of vertices, as they are in the file.
    colors: Colors,
}

impl Reader<'_> {
    fn malformed(&self, import: &Import<'_>, what: String) -> LoadError {
        LoadError::malformed(import.path, what, REMEDY).at(Place::Line(self.rows.line()))
    }

    fn report(&self, import: &Import<'_>, row: u64) -> Result<(), LoadError> {
        if !row.is_multiple_of(STRIDE) {
            return Ok(());
        }
        let (done, left) = self.rows.progress();
        let share = 0.9 * done as f32 / (done + left).max(1) as f32;
        import.options.report(import.path, LoadStage::Geometry, share)
    }

    fn vertices(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let (count, mut numbers) = (self.header.vertices, Numbers::default());
        if self.header.least_numbers() == 3 {
            self.plain_places(import)?;
        }
        for row in self.polygons.positions.len() as u64..count {
            self.report(import, row)?;
            let Some(line) = self.rows.next() else {
                let what = format!("the header claims {count} vertices, and the file ends after {row}");
                return Err(self.malformed(import, what));
            };
            numbers.read(line).map_err(|what| self.malformed(import, format!("vertex {row}: {what}")))?;
            if numbers.values.len() < self.header.least_numbers() {
                let what = format!("vertex {row} has too few numbers");
                return Err(self.malformed(import, what));
            }
            self.vertex(&numbers);
        }
        Ok(())
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
            let pieces = read(self.rows.rest());
            if pieces.is_empty() {
                return Ok(());
            }
            for piece in pieces {
                let Some(Piece { bytes, lines, rows }) = piece else { return Ok(()) };
                if !add(&mut self.polygons, rows) {
                    return Ok(());
                }
                self.rows.pass(bytes, lines);
            }
        }
    }

    fn plain_places(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let count = self.header.vertices;
        self.plain_rows(import, plain::places, |polygons, places| {
            let fits = (polygons.positions.len() + places.len()) as u64 <= count;
            if fits {
                polygons.positions.extend(places);
            }
            fits
        })
    }

    /// A row: the place, then normal, colour and texture coordinates, those that there are.
    fn vertex(&mut self, numbers: &Numbers) {
        let (place, mut rest) = numbers.values.split_at(3);
        self.polygons.positions.push(DVec3::from_slice(place));
        if self.header.has_normals {
            let (normal, after) = rest.split_at(3);
            self.polygons.normals.push(DVec3::from_slice(normal).as_vec3());
            rest = after;
        }
        if self.header.has_uvs {
            let (before, uv) = rest.split_at(rest.len() - 2);
            // OFF counts v upwards.
            let uv = Vec2::new(uv[0] as f32, (1.0 - uv[1]) as f32);
            self.polygons.uvs.push(if uv.is_finite() { uv } else { Vec2::ZERO });
            rest = before;
        }
        if self.header.has_colors {
            self.colors.push(rest);
        }
    }

    fn faces(&mut self, import: &mut Import<'_>) -> Result<(), LoadError> {
        let (count, mut numbers) = (self.header.faces, Numbers::default());
        let mut colors = Colors::default();
        self.plain_faces(import)?;
        for row in self.polygons.face_sizes.len() as u64..count {
            self.report(import, row)?;
            let Some(line) = self.rows.next() else {
                let what = format!("the header claims {count} faces, and the file ends after {row}");
                import.warnings.push(Place::Line(self.rows.line()), what, "copy or export the file again");
                break;
            };
            numbers.read(line).map_err(|what| self.malformed(import, format!("face {row}: {what}")))?;
            let (corners, color) =
                numbers.face().map_err(|what| self.malformed(import, format!("face {row} {what}")))?;
            let faces_before = self.polygons.face_sizes.len();
            if self.face(import, row, corners)? && (color.len() >= 3 || !colors.colors.is_empty()) {
                // Until the first one, no face has a colour.
                (colors.colors.len()..faces_before).for_each(|_| colors.push(&[]));
                colors.push(color);
            }
        }
        self.polygons.face_colors = colors.finish();
        Ok(())
    }

    fn plain_faces(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let (Header { vertices, faces, .. }, most) = (self.header, most_corners(import));
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
    fn face(&mut self, import: &Import<'_>, row: u64, corners: &[f64]) -> Result<bool, LoadError> {
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

    fn finish(mut self) -> Polygons {
        if self.header.has_colors {
            self.polygons.colors = self.colors.finish();
        }
        self.polygons
    }
}

/// Colours as they are in a file: from 0 to 1, or from 0 to 255 if any is above 1.
#[derive(Default)]
struct Colors {
    colors: Vec<Vec4>,
    /// Whether alpha is there, in each.
    with_alpha: Vec<bool>,
    largest: f32,
}

impl Colors {
    /// What a row has of it: fewer than three numbers are white.
    fn push(&mut self, numbers: &[f64]) {
        let channel = |at: usize| numbers.get(at).map(|&value| value as f32).filter(|value| !value.is_nan());
        let is_color = numbers.len() >= 3;
        let of = |at| if is_color { channel(at).unwrap_or(0.0) } else { f32::INFINITY };
        let color = Vec4::new(of(0), of(1), of(2), if is_color { channel(3).unwrap_or(0.0) } else { 0.0 });
        if is_color {
            self.largest = self.largest.max(color.truncate().max_element());
        }
        self.colors.push(color);
        self.with_alpha.push(is_color && numbers.len() > 3);
    }

    /// As linear light.
    fn finish(self) -> Vec<Vec4> {
        let full = if self.largest > 1.0 { 255.0 } else { 1.0 };
        let linear = |(color, &has_alpha): (&Vec4, &bool)| {
            let [red, green, blue, alpha] = (*color / full).to_array();
            light_from_srgb([red, green, blue, if has_alpha { alpha } else { 1.0 }])
        };
        self.colors.iter().zip(&self.with_alpha).map(linear).collect()
    }
}
