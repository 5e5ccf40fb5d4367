//! What a processor allows at most, under the rules of the renderer: the inner loops of a frame with everything
//! else taken away. The code is safe, without fused multiplication and gathers, with exact quotients and square
//! roots.
//!
//! How near a frame comes to them says what is left to gain.

use crate::{kernels, shaded};
use trigon_study::workloads::Timings;

/// One of the loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Limit {
    /// Writing memory, 8 MB: the size of an image.
    Store,
    /// Reading as much.
    Load,
    /// Multiplications and additions of f32 that wait for no other.
    Arithmetic,
    /// Depth test and both writes in a tile where every pixel passes: W1a.
    FillPass,
    /// The depth test where every pixel fails: W1b.
    FillReject,
    /// Blinn-Phong in each pixel from planes of attributes: W3.
    BlinnPhong,
    /// A trilinear look-up for each pixel, neighbours next to each other: W4.
    Trilinear,
    /// Transform, division and Lambert's law for each vertex: W2.
    Vertices,
}

impl Limit {
    /// All of them.
    pub(crate) const ALL: [Self; 8] = [
        Self::Store,
        Self::Load,
        Self::Arithmetic,
        Self::FillPass,
        Self::FillReject,
        Self::BlinnPhong,
        Self::Trilinear,
        Self::Vertices,
    ];

    /// What is done.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Store => "store",
            Self::Load => "load",
            Self::Arithmetic => "multiply and add",
            Self::FillPass => "fill, every pixel passes",
            Self::FillReject => "fill, every pixel fails",
            Self::BlinnPhong => "Blinn-Phong",
            Self::Trilinear => "trilinear texture",
            Self::Vertices => "vertices with Lambert",
        }
    }

    /// What is counted a second.
    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Store | Self::Load => "GB/s",
            Self::Arithmetic => "GFLOP/s",
            Self::FillPass | Self::FillReject => "Gpixel/s",
            Self::BlinnPhong | Self::Trilinear => "Mpixel/s",
            Self::Vertices => "Mvertex/s",
        }
    }

    /// Measures on the calling thread how much of its unit the processor does in a
    /// second, with its best vector instructions: the median, the least and the most
    /// of so many repetitions.
    pub(crate) fn rates(self, repetitions: usize) -> [f64; 3] {
        let mut kernel = self.kernel();
        let timings = Timings::of_frames(repetitions, || (kernel.run)());
        [timings.median(), timings.max(), timings.min()].map(|milliseconds| kernel.work / milliseconds * 1e3)
    }

    fn kernel(self) -> Kernel {
        match self {
            Self::Store => kernels::store(),
            Self::Load => kernels::load(),
            Self::Arithmetic => kernels::arithmetic(),
            Self::FillPass => kernels::fill(true),
            Self::FillReject => kernels::fill(false),
            Self::BlinnPhong => shaded::blinn_phong(),
            Self::Trilinear => shaded::trilinear(),
            Self::Vertices => shaded::vertices(),
        }
    }
}

/// A loop, and how much of its unit one run does.
pub(crate) struct Kernel {
    pub(crate) work: f64,
    pub(crate) run: Box<dyn FnMut()>,
}
