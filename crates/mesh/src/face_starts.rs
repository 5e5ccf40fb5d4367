//! Where the corners of each face begin.

use std::ops::Range;

/// The first corner of each face. Meshes whose faces have equally many corners, as those of triangles alone and those of
/// quads alone, need no list of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum FaceStarts {
    /// So many faces with so many corners each; with three if there is no face.
    Equal { count: usize, size: usize },
    /// The first corner of each face, and the number of corners at the end; at least two faces have not equally many.
    Listed(Vec<u32>),
}

impl Default for FaceStarts {
    /// No faces.
    fn default() -> Self {
        Self::Equal { count: 0, size: 3 }
    }
}

impl FaceStarts {
    /// Of faces with so many corners each. All corners can be numbered.
    pub(crate) fn of_sizes(sizes: &[u32]) -> Self {
        let mut starts = Self::default();
        sizes.iter().for_each(|&size| starts.push(size as usize, sizes.len()));
        starts
    }

    /// Adds a face with so many corners, at least three. `room` is the number of faces that are expected in all.
    pub(crate) fn push(&mut self, size: usize, room: usize) {
        match self {
            Self::Equal { count, size: each } if *count == 0 || *each == size => {
                (*count, *each) = (*count + 1, size);
            }
            Self::Equal { count, size: each } => {
                let mut starts = Vec::with_capacity(room.max(*count + 1) + 1);
                starts.extend((0..=*count).map(|face| (*each * face) as u32));
                *self = Self::Listed(starts);
                self.push(size, room);
            }
            Self::Listed(starts) => starts.push(starts[starts.len() - 1] + size as u32),
        }
    }

    /// Adds so many triangles.
    pub(crate) fn push_triangles(&mut self, more: usize) {
        match self {
            Self::Equal { count, size: 3 } => *count += more,
            Self::Equal { .. } | Self::Listed(_) => (0..more).for_each(|_| self.push(3, 0)),
        }
    }

    /// The number of faces.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Equal { count, .. } => *count,
            Self::Listed(starts) => starts.len() - 1,
        }
    }

    /// The corners of a face, which must exist.
    pub(crate) fn corners(&self, face: usize) -> Range<usize> {
        match self {
            Self::Equal { count, size } => {
                assert!(face < *count, "there is no face {face}: there are {count}");
                size * face..size * face + size
            }
            Self::Listed(starts) => starts[face] as usize..starts[face + 1] as usize,
        }
    }

    /// The corners of every face, in order.
    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = Range<usize>> + Clone + '_ {
        (0..self.len()).map(|face| self.corners(face))
    }

    /// The face of a corner, which must exist.
    pub(crate) fn face_at(&self, corner: u32) -> usize {
        match self {
            Self::Equal { size, .. } => corner as usize / size,
            Self::Listed(starts) => starts.partition_point(|&start| start <= corner) - 1,
        }
    }

    /// Whether all faces are triangles.
    pub(crate) fn are_triangles(&self) -> bool {
        matches!(self, Self::Equal { size: 3, .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_follow_each_other_whatever_the_sizes() {
        for sizes in
            [vec![], vec![3], vec![3, 3, 3], vec![4], vec![4, 4], vec![4, 3], vec![3, 3, 5, 3], vec![6, 3, 4]]
        {
            let starts = FaceStarts::of_sizes(&sizes);
            let is_triangles = sizes.iter().all(|&size| size == 3);
            assert_eq!(starts.are_triangles(), is_triangles, "{sizes:?}");
            assert_eq!(starts.len(), sizes.len(), "{sizes:?}");
            let mut end = 0;
            for (face, (&size, corners)) in sizes.iter().zip(starts.iter()).enumerate() {
                assert_eq!(corners, end..end + size as usize, "face {face} of {sizes:?}");
                assert_eq!(starts.corners(face), corners, "one by one");
                assert!(corners.clone().all(|corner| starts.face_at(corner as u32) == face), "and back");
                end = corners.end;
            }
            let mut more = starts.clone();
            more.push_triangles(2);
            let expected: Vec<u32> = sizes.iter().copied().chain([3, 3]).collect();
            assert_eq!(more, FaceStarts::of_sizes(&expected), "two triangles more than {sizes:?}");
        }
    }

    #[test]
    #[should_panic(expected = "no face 2")]
    fn a_triangle_that_does_not_exist_has_no_corners() {
        let _ = FaceStarts::of_sizes(&[3, 3]).corners(2);
    }
}
