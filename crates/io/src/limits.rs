//! How much a file may ask for.
//!
//! A file is data from elsewhere: a few bytes can claim billions of vertices.
//! Claims are checked with checked arithmetic before anything is allocated;
//! these limits bound what an honest but huge file may use.

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
    /// Corners of all faces of one file (and ends of lines, and points), counted
    /// as often as nodes place them. Default 100 million: 33 million triangles,
    /// which take about 3 GB to draw.
    pub corners: usize,
    /// Nodes of a scene, and groups of an OBJ. Default 1 million.
    pub nodes: usize,
    /// How deep nodes may hang on each other. Default 100 000.
    pub depth: usize,
    /// Width and height of a picture, in pixels. Default 16 384, which is also
    /// the most that a texture can have.
    pub image_side: u32,
    /// Width times height of a picture. Default 2²⁶, which is 8192 × 8192.
    pub image_pixels: u64,
    /// Pixels of all pictures of a model together. A few bytes of file can
    /// claim millions of pixels, so their number alone bounds nothing. Default
    /// 2²⁹, which is 32 pictures of 4096 × 4096, and 3 GB with smaller copies.
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
