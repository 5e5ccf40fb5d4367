//! Resource limits.
//!
//! A file is untrusted: a few bytes can claim billions of vertices. Sizes are checked with checked
//! arithmetic before anything is allocated; these limits bound what a valid but huge file may use.

/// Upper bounds on what a load may read and allocate. The defaults fit large
/// real models on an ordinary machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// The largest single file, in bytes. Default 2 GiB.
    pub file_bytes: u64,
    /// All files of a model and all decoded data URIs together, in bytes.
    /// Default 4 GiB.
    pub total_bytes: u64,
    /// Vertices of one mesh, and of one accessor. Default 50 million.
    pub vertices: usize,
    /// Corners of all faces of one file (and ends of lines, and points), counted as often as nodes
    /// use them. Default 100 million: 33 million triangles, which take about 3 GB to draw.
    pub corners: usize,
    /// Nodes of a scene, and groups of an OBJ. Default 1 million.
    pub nodes: usize,
    /// The depth of the node tree. Default 100 000.
    pub depth: usize,
    /// Width and height of an image, in pixels. Default 16 384, which is also the largest size of a
    /// texture.
    pub image_side: u32,
    /// Width times height of an image. Default 2²⁶, which is 8192 × 8192.
    pub image_pixels: u64,
    /// Pixels of all images of a model together. A few bytes of file can claim millions of pixels,
    /// so a limit on their number alone is not enough. Default 2²⁹, which is 32 images of 4096 ×
    /// 4096, and 3 GB with smaller copies.
    pub total_pixels: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 2 << 30,
            total_bytes: 4 << 30,
            vertices: 50_000_000,
            corners: 100_000_000,
            nodes: 1_000_000,
            depth: 100_000,
            image_side: 1 << 14,
            image_pixels: 1 << 26,
            total_pixels: 1 << 29,
        }
    }
}
