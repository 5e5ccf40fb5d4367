//! A point of a triangle that something other than the rasterizer found visible, such as a ray.

/// A point of a triangle that is to be shaded.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The number of the triangle in its draw.
    pub triangle: u32,
    /// Whether its corners wind counter-clockwise as the eye sees them.
    pub front_facing: bool,
    /// The barycentric weights of its corners.
    pub weights: [f32; 3],
    /// The derivatives of the weights of corners 1 and 2, to the right and downwards, per sample of the finer grid; that
    /// of corner 0 makes their sum 0.
    pub slopes: [[f32; 2]; 2],
    /// The column and row of the sample in the finer grid of supersampling, both below 65536.
    pub sample: [u32; 2],
}
