//! How a texture is looked up.

/// What lies beyond the edges of a texture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The texture again.
    #[default]
    Repeat,
    /// The texture mirrored, then again.
    MirroredRepeat,
    /// Its outermost texels.
    ClampToEdge,
}

/// How texels of one level become a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// The texel that the coordinate lies in.
    Nearest,
    /// The four nearest, weighted by distance.
    #[default]
    Linear,
}

/// How mip levels are chosen when the texture is reduced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MipFilter {
    /// Only the base level: sharp, and it shimmers.
    None,
    /// The nearest level.
    Nearest,
    /// The two nearest levels, weighted ("trilinear" with [`Filter::Linear`]).
    #[default]
    Linear,
}

/// How a texture is looked up; the default repeats and is trilinear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Sampler {
    /// Beyond the left and right edge.
    pub wrap_u: Wrap,
    /// Beyond the top and bottom edge.
    pub wrap_v: Wrap,
    /// Filter where a texel is larger than a sample step.
    pub magnification: Filter,
    /// Filter within a level where it is smaller.
    pub minification: Filter,
    /// Choice of levels where it is smaller.
    pub mip: MipFilter,
}
