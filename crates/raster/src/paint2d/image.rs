//! Images that triangles are painted with.

use super::{Rect, SizeError};
use crate::texture::{Filter, Wrap};

/// An image in gamma space, premultiplied by alpha, which comes last; never
/// empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Image {
    size: [i32; 2],
    texels: Vec<[u8; 4]>,
    /// The colour between the middles of texels.
    pub filter: Filter,
    /// The colour beyond the edges.
    pub wrap: Wrap,
}

impl Image {
    /// The image with these row-major texels from the top left.
    ///
    /// # Errors
    /// If a side is 0 or above [`MAX_SIZE`](super::MAX_SIZE), or the number of
    /// texels is not `width * height`.
    pub fn new(width: u32, height: u32, texels: Vec<[u8; 4]>) -> Result<Self, SizeError> {
        let size = SizeError::check(width, height, texels.len())?;
        Ok(Self { size, texels, filter: Filter::default(), wrap: Wrap::ClampToEdge })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size.map(i32::cast_unsigned)
    }

    /// All texels, row-major from the top left.
    #[must_use]
    pub fn texels(&self) -> &[[u8; 4]] {
        &self.texels
    }

    /// Replaces the texels of `area` by others, row-major.
    ///
    /// # Errors
    /// If `area` is empty or not within the image, or the number of texels is not
    /// that of the area; nothing is replaced then.
    pub fn update(&mut self, area: Rect, texels: &[[u8; 4]]) -> Result<(), SizeError> {
        let side = |axis: usize| {
            let length = i64::from(area.max[axis]) - i64::from(area.min[axis]);
            u32::try_from(length).unwrap_or(0)
        };
        let [width, height] = [side(0), side(1)];
        if !self.bounds().contains(area) {
            return Err(SizeError { width, height, pixels: texels.len() });
        }
        SizeError::check(width, height, texels.len())?;
        let [left, top] = area.min.map(|v| v as usize);
        let rows = self.texels.chunks_exact_mut(self.size[0] as usize).skip(top);
        for (row, texels) in rows.zip(texels.chunks_exact(width as usize)) {
            row[left..left + texels.len()].copy_from_slice(texels);
        }
        Ok(())
    }

    /// All texels' positions.
    pub(super) fn bounds(&self) -> Rect {
        Rect::new([0, 0], self.size)
    }

    /// From a texel, which is inside, to the end of the image.
    #[inline(always)]
    pub(super) fn texels_from(&self, x: i32, y: i32) -> &[[u8; 4]] {
        &self.texels[y as usize * self.size[0] as usize + x as usize..]
    }

    /// The texel at a column and a row, wherever these are.
    #[inline(always)]
    pub(super) fn texel(&self, column: i32, row: i32) -> u32 {
        let [x, y] = [self.wrap.index(column, self.size[0]), self.wrap.index(row, self.size[1])];
        u32::from_le_bytes(self.texels_from(x, y)[0])
    }
}

impl Wrap {
    /// Which of `size` texels is at `index`.
    #[inline(always)]
    fn index(self, index: i32, size: i32) -> i32 {
        match self {
            Self::ClampToEdge => index.clamp(0, size - 1),
            Self::Repeat => index.rem_euclid(size),
            Self::MirroredRepeat => {
                let twice = index.rem_euclid(2 * size);
                if twice < size { twice } else { 2 * size - 1 - twice }
            }
        }
    }
}
