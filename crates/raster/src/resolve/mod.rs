//! Samples become pixels: mean in linear light, transfer function, ids; straight
//! into the rows of the target that belong to the tile.

use crate::frame::Frame;
use crate::pass::Background;
use crate::target::{TileRect, TileRows};
use crate::tile::{NOBODY, STRIDE, Scratch};
use trigon_math::{UVec2, Vec4, color};

/// A linear premultiplied colour as sRGB bytes with straight alpha.
#[inline]
fn encode(value: Vec4) -> [u8; 4] {
    color::linear_to_srgba8(if value.w == 1.0 { value } else { color::unpremultiplied(value) })
}

impl Background<'_> {
    fn at(&self, x: u32, y: u32) -> Vec4 {
        let value = match self {
            Self::Color(color) => *color,
            Self::PerPixel(function) => function(UVec2::new(x, y)),
        };
        if value.is_finite() { value } else { Vec4::ZERO }
    }
}

/// Draws a tile that nothing is in.
pub(crate) fn fill_background(frame: &Frame<'_>, rows: &mut TileRows<'_>) {
    let TileRect { x: left, y: top, .. } = rows.rect;
    match frame.background {
        Background::Color(_) => {
            let value = frame.background.at(0, 0);
            let code = encode(value);
            rows.linear.iter_mut().for_each(|row| row.fill(value));
            rows.srgb8.iter_mut().for_each(|row| row.fill(code));
        }
        Background::PerPixel(_) => {
            for y in 0..rows.rect.height as usize {
                for x in 0..rows.rect.width as usize {
                    store(rows, [x, y], || frame.background.at(left + x as u32, top + y as u32));
                }
            }
        }
    }
    rows.depth.iter_mut().for_each(|row| row.fill(0.0));
    let ids = rows.objects.iter_mut().chain(&mut rows.faces).chain(&mut rows.triangles);
    ids.for_each(|row| row.fill(u32::MAX));
}

/// Stores a colour in the outputs that want one.
#[inline]
fn store(rows: &mut TileRows<'_>, [x, y]: [usize; 2], value: impl FnOnce() -> Vec4) {
    if rows.linear.is_empty() && rows.srgb8.is_empty() {
        return;
    }
    let value = value();
    if let Some(row) = rows.linear.get_mut(y) {
        row[x] = value;
    }
    if let Some(row) = rows.srgb8.get_mut(y) {
        row[x] = encode(value);
    }
}

/// Puts the background's colour into all samples that see it.
pub(crate) fn lay_background(frame: &Frame<'_>, rect: TileRect, scratch: &mut Scratch) {
    let samples = frame.samples_per_axis.get() as usize;
    let constant = frame.background.at(0, 0);
    for y in 0..rect.height as usize {
        for x in 0..rect.width as usize {
            let block = sample_indices([x, y], samples);
            if block.clone().all(|sample| scratch.winner[sample] != NOBODY) {
                continue;
            }
            let value = match frame.background {
                Background::Color(_) => constant,
                Background::PerPixel(_) => frame.background.at(rect.x + x as u32, rect.y + y as u32),
            };
            block.for_each(|sample| scratch.color[sample] = value);
        }
    }
}

/// The samples of a pixel of the tile, row by row.
#[inline]
fn sample_indices([x, y]: [usize; 2], samples: usize) -> impl Iterator<Item = usize> + Clone {
    let first = (y * STRIDE + x) * samples;
    (0..samples).flat_map(move |row| (0..samples).map(move |column| first + row * STRIDE + column))
}

/// Writes all outputs of a tile.
pub(crate) fn resolve(frame: &Frame<'_>, scratch: &Scratch, rows: &mut TileRows<'_>) {
    let samples = frame.samples_per_axis.get() as usize;
    let middle = (samples / 2) * STRIDE + samples / 2;
    for y in 0..rows.rect.height as usize {
        for x in 0..rows.rect.width as usize {
            store(rows, [x, y], || match samples {
                1 => scratch.color[y * STRIDE + x],
                _ => mean(&scratch.color, [x, y], samples),
            });
            let sample = (y * STRIDE + x) * samples + middle;
            if let Some(row) = rows.depth.get_mut(y) {
                // -0 becomes 0.
                row[x] = scratch.depth[sample] + 0.0;
            }
            store_ids(frame, scratch, (sample, [x, y]), rows);
        }
    }
}

/// The mean of a pixel's samples. Equal ones are not rounded, so that a pixel
/// that shows only the background is the same in a tile that shows more.
fn mean(colors: &[Vec4], pixel: [usize; 2], samples: usize) -> Vec4 {
    let mut indices = sample_indices(pixel, samples);
    let first = indices.next().map_or(Vec4::ZERO, |sample| colors[sample]);
    let (mut sum, mut equal) = (first, true);
    for sample in indices {
        sum += colors[sample];
        equal &= colors[sample] == first;
    }
    let share = 1.0 / (samples * samples) as f32;
    if equal {
        first
    } else if sum.is_finite() {
        sum * share
    } else {
        saturated(sample_indices(pixel, samples).map(|sample| colors[sample] * share).sum())
    }
}

/// The largest number in place of infinity: what sums of finite colours can
/// reach. An infinity would be no number as soon as it met a factor of 0.
#[inline]
pub(crate) fn saturated(color: Vec4) -> Vec4 {
    if color.is_finite() {
        return color;
    }
    Vec4::from_array(color.to_array().map(|v| {
        if v.is_finite() {
            v
        } else if v > 0.0 {
            f32::MAX
        } else {
            f32::MIN
        }
    }))
}

#[inline]
fn store_ids(
    frame: &Frame<'_>,
    scratch: &Scratch,
    (sample, [x, y]): (usize, [usize; 2]),
    rows: &mut TileRows<'_>,
) {
    if rows.objects.is_empty() && rows.faces.is_empty() && rows.triangles.is_empty() {
        return;
    }
    let [object, face, primitive] = match scratch.winner[sample] {
        NOBODY => [u32::MAX; 3],
        place => {
            let triangle = &frame.triangles[scratch.triangles[place as usize] as usize];
            let geometry = frame.geometry(triangle);
            [geometry.object, geometry.face(triangle.primitive), triangle.primitive]
        }
    };
    let outputs = [(&mut rows.objects, object), (&mut rows.faces, face), (&mut rows.triangles, primitive)];
    for (output, id) in outputs {
        if let Some(row) = output.get_mut(y) {
            row[x] = id;
        }
    }
}
