//! One image of a target. It is absent, owned by the target, or borrowed from the caller.

/// An image, row-major.
pub(super) enum Plane<'a, T> {
    Owned(Vec<T>),
    Borrowed(&'a mut [T]),
}

impl<T: Clone> Plane<'_, T> {
    /// An owned image, without pixels if it is empty. `None` if there is not enough memory.
    pub(super) fn owned(pixels: usize, value: T) -> Option<Self> {
        let mut image = Vec::new();
        image.try_reserve_exact(pixels).ok()?;
        image.resize(pixels, value);
        Some(Self::Owned(image))
    }
}

impl<T> Plane<'_, T> {
    pub(super) fn pixels(&self) -> Option<&[T]> {
        let pixels = match self {
            Self::Owned(image) => image.as_slice(),
            Self::Borrowed(image) => image,
        };
        (!pixels.is_empty()).then_some(pixels)
    }

    pub(super) fn pixels_mut(&mut self) -> &mut [T] {
        match self {
            Self::Owned(image) => image,
            Self::Borrowed(image) => image,
        }
    }

    pub(super) fn into_owned(self) -> Option<Vec<T>> {
        match self {
            Self::Owned(image) => (!image.is_empty()).then_some(image),
            Self::Borrowed(_) => None,
        }
    }
}
