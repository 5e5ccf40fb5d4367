//! An image of values of any type, into which every algorithm draws, and the result of every algorithm.

use std::ops::{Index, IndexMut};

/// Row-major values, from the top left; y points down.
#[derive(Clone, Debug, PartialEq)]
pub struct Field<T> {
    width: usize,
    values: Vec<T>,
}

impl<T: Clone> Field<T> {
    /// `width` by `height` times the same value; at least one pixel wide.
    pub fn new([width, height]: [usize; 2], value: T) -> Self {
        let width = width.max(1);
        Self { width, values: vec![value; width * height] }
    }

    /// Sets every pixel to the same value.
    pub fn clear(&mut self, value: T) {
        self.values.fill(value);
    }
}

impl<T> Field<T> {
    /// The value of a function for each pixel, in rows from the top.
    pub fn from_fn([width, height]: [usize; 2], value: impl Fn([usize; 2]) -> T) -> Self {
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        Self { width: width.max(1), values: pixels.map(value).collect() }
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.values.len() / self.width]
    }

    /// All values, row by row.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.values
    }

    /// The same, to be changed.
    pub fn values_mut(&mut self) -> &mut [T] {
        &mut self.values
    }

    /// The value at a position, if it is in the image.
    #[must_use]
    pub fn get(&self, pixel: [i32; 2]) -> Option<&T> {
        self.index(pixel).map(|index| &self.values[index])
    }

    /// The same, to be changed.
    #[inline]
    pub fn get_mut(&mut self, pixel: [i32; 2]) -> Option<&mut T> {
        self.index(pixel).map(|index| &mut self.values[index])
    }

    /// Every value with its pixel.
    pub fn pixels(&self) -> impl Iterator<Item = ([usize; 2], &T)> {
        let width = self.width;
        self.values.iter().enumerate().map(move |(index, value)| ([index % width, index / width], value))
    }

    /// A row, counted from the top.
    #[inline]
    pub fn row_mut(&mut self, y: usize) -> &mut [T] {
        let start = y * self.width;
        &mut self.values[start..start + self.width]
    }

    /// The rows, from the top.
    pub fn rows_mut(&mut self) -> impl Iterator<Item = &mut [T]> {
        self.values.chunks_mut(self.width)
    }

    /// An image of the same size, with a function applied to each value.
    pub fn map<U>(&self, value: impl FnMut(&T) -> U) -> Field<U> {
        Field { width: self.width, values: self.values.iter().map(value).collect() }
    }

    #[inline]
    fn index(&self, [x, y]: [i32; 2]) -> Option<usize> {
        let (x, y) = (usize::try_from(x).ok()?, usize::try_from(y).ok()?);
        let index = y * self.width + x;
        (x < self.width && index < self.values.len()).then_some(index)
    }
}

impl<T> Index<[usize; 2]> for Field<T> {
    type Output = T;

    #[inline]
    fn index(&self, [x, y]: [usize; 2]) -> &T {
        &self.values[y * self.width + x]
    }
}

impl<T> IndexMut<[usize; 2]> for Field<T> {
    #[inline]
    fn index_mut(&mut self, [x, y]: [usize; 2]) -> &mut T {
        &mut self.values[y * self.width + x]
    }
}

/// What an image shows, and what it took to find out.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The number of the face in each pixel, `u32::MAX` for none.
    pub faces: Field<u32>,
    /// The algorithm's own unit of work; see [`Method::test`](super::Method::test). 0 where it is not
    /// counted.
    pub tests: u64,
}

impl Drawing {
    pub(super) fn empty(size: [usize; 2]) -> Self {
        Self { faces: Field::new(size, u32::MAX), tests: 0 }
    }

    pub(super) fn clear(&mut self) {
        self.faces.clear(u32::MAX);
        self.tests = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_outside_hold_nothing() {
        let field = Field::from_fn([3, 2], |[x, y]| 10 * y + x);
        assert_eq!((field.size(), field[[2, 1]]), ([3, 2], 12), "columns, rows, and the last value");
        let outside = [[-1, 0], [3, 0], [0, 2], [0, -1]].map(|pixel| field.get(pixel));
        assert_eq!(outside, [None; 4], "left, right, below and above");
    }

    #[test]
    fn each_place_holds_its_own_value() {
        let mut field = Field::new([3, 2], 7);
        assert_eq!(field.values(), [7; 6]);
        for (x, y) in [(0, 0), (2, 0), (1, 1), (2, 1)] {
            field[[x, y]] = 10 * y + x;
            assert_eq!(field[[x, y]], 10 * y + x);
            assert_eq!(field.get([x as i32, y as i32]), Some(&(10 * y + x)));
        }
        assert_eq!(field.values(), [0, 7, 2, 7, 11, 12], "row by row");
        *field.get_mut([1, 0]).expect("it is in the image") = 1;
        assert_eq!(field.get_mut([3, 1]), None, "no pixel of the next row");
        field.row_mut(1)[0] = 10;
        assert_eq!(field, Field::from_fn([3, 2], |[x, y]| 10 * y + x));
        let differences: Vec<_> = field.pixels().map(|([x, y], value)| value - (10 * y + x)).collect();
        assert_eq!(differences, [0; 6], "every pixel with its place");
        let rows: Vec<Vec<usize>> = field.rows_mut().map(|row| row.to_vec()).collect();
        assert_eq!(rows, [[0, 1, 2], [10, 11, 12]]);
        let doubled = field.map(|value| 2 * value);
        assert_eq!((doubled.size(), doubled[[2, 1]]), ([3, 2], 24));
        field.values_mut()[5] = 1;
        assert_eq!(field[[2, 1]], 1);
        field.clear(4);
        assert_eq!(field.values(), [4; 6]);
        assert_eq!(Field::new([0, 5], 1).values(), [1; 5], "at least a pixel wide");
    }
}
