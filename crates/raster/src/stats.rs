//! What a frame took, in counts.

use std::ops::AddAssign;

/// Counts of one executed pass. Lines and points count as the triangles that
/// they are made of, from `set_up` on.
///
/// The counts of triangles and samples do not depend on the number of threads;
/// `binned` and `tiles` depend on the tile size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Stats {
    /// Triangles, segments and points recorded.
    pub primitives: u64,
    /// Vertices that went through the vertex stage.
    pub vertices: u64,
    /// Primitives dropped for an index out of range or a coordinate that is
    /// not finite.
    pub invalid: u64,
    /// Primitives dropped because they lie outside the view.
    pub outside: u64,
    /// Primitives that were cut by a plane.
    pub clipped: u64,
    /// Triangles dropped for their facing, for having no area after snapping,
    /// or for holding no sample.
    pub culled: u64,
    /// Triangles that were set up.
    pub set_up: u64,
    /// Entries of triangles in tiles.
    pub binned: u64,
    /// Tiles that had any entry.
    pub tiles: u64,
    /// Calls of the fragment function.
    pub samples_shaded: u64,
    /// Calls of the mask function.
    pub samples_masked: u64,
}

impl AddAssign for Stats {
    fn add_assign(&mut self, other: Self) {
        self.primitives += other.primitives;
        self.vertices += other.vertices;
        self.invalid += other.invalid;
        self.outside += other.outside;
        self.clipped += other.clipped;
        self.culled += other.culled;
        self.set_up += other.set_up;
        self.binned += other.binned;
        self.tiles += other.tiles;
        self.samples_shaded += other.samples_shaded;
        self.samples_masked += other.samples_masked;
    }
}
