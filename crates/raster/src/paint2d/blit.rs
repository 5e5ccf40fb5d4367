//! Copies texels to pixels one to one: glyphs, icons, and the image of a 3D view.

use super::blend::{multiply, over, unpack};
use super::{Canvas, Image, Rect, eight};
use crate::simd::prelude::*;
use crate::simd::{F32, LANES, U32};

/// Paints `pixels`, which are inside the canvas, with the texels `offset` from
/// them, which are inside the image, times a colour.
#[inline(always)]
pub(super) fn blit<S: Simd>(
    simd: S,
    canvas: &mut Canvas<'_>,
    pixels: Rect,
    image: &Image,
    offset: [i32; 2],
    color: [u8; 4],
) {
    let white = color == [255; 4];
    let [r, g, b, a] = color.map(f32::from);
    let tint = [F32::splat(simd, r), F32::splat(simd, g), F32::splat(simd, b), F32::splat(simd, a)];
    for y in pixels.min[1]..pixels.max[1] {
        for x in (pixels.min[0]..pixels.max[0]).step_by(LANES) {
            let count = (pixels.max[0] - x).min(LANES as i32);
            let texels: U32<S> = eight::load(simd, image.texels_from(x + offset[0], y + offset[1]));
            if texels.simd_eq(0).all_true() {
                continue;
            }
            let opaque = white && (texels & OPAQUE).simd_eq(OPAQUE).all_true();
            eight::change(
                simd,
                canvas.pixels_from(x, y),
                count,
                #[inline(always)]
                |below| {
                    if opaque { texels } else { over(multiply(tint, unpack(texels)), below) }
                },
            );
        }
    }
}

/// Full alpha.
const OPAQUE: u32 = 0xff00_0000;
