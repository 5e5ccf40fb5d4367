//! One picture of a target: not there, its own, or the caller's.

/// A picture, row-major.
pub(super) enum Plane<'a, T> {
    Owned(Vec<T>),
    Borrowed(&'a mut [T]),
}

impl<T: Clone> Plane<'_, T> {
    /// A picture of its own; none if it has no pixels. `None` without memory.
    pub(super) fn owned(pixels: usize, value: T) -> Option<Self> {
        let mut picture = Vec::new();
        picture.try_reserve_exact(pixels).ok()?;
        picture.resize(pixels, value);
        Some(Self::Owned(picture))
    }
}

impl<T> Plane<'_, T> {
    pub(super) fn pixels(&self) -> Option<&[T]> {
        let pixels = match self {
            Self::Owned(picture) => picture.as_slice(),
            Self::Borrowed(picture) => picture,
        };
        (!pixels.is_empty()).then_some(pixels)
    }

    pub(super) fn pixels_mut(&mut self) -> &mut [T] {
        match self {
            Self::Owned(picture) => picture,
            Self::Borrowed(picture) => picture,
        }
    }

    pub(super) fn into_owned(self) -> Option<Vec<T>> {
        match self {
            Self::Owned(picture) => (!picture.is_empty()).then_some(picture),
            Self::Borrowed(_) => None,
        }
    }
}
