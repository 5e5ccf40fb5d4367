//! The texture of the knot.

use trigon_raster::{Texture, TextureFormat};

/// 1024 by 1024 texels of plain data: a checker of two tints, 64 texels a square. Each square has a finer
/// pattern (the exclusive or of the coordinates), so that every mip level has something to show.
#[must_use]
pub fn knot_surface() -> Texture {
    const SIZE: u32 = 1024;
    const SQUARE: u32 = 64;
    let texel = |x: u32, y: u32| {
        let shade = (x ^ y) % SQUARE * 2 / 3;
        let tint = if (x / SQUARE + y / SQUARE) % 2 == 1 { [230, 120, 60] } else { [60, 130, 220] };
        let [r, g, b] = tint.map(|channel: u32| (channel - shade) as u8);
        [r, g, b, 255]
    };
    let texels = (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| texel(x, y))).collect();
    Texture::new(SIZE, SIZE, texels, TextureFormat::Linear).expect("the size is in range")
}
