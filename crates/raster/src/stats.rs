//! Counts and times of a frame, the clock that measures stages if times are requested, and the counts of a worker.

use std::ops::AddAssign;
use std::time::{Duration, Instant};

/// Counts of one executed pass, and its times. A line or a point counts as one
/// triangle.
///
/// The counts of triangles and samples do not depend on the number of threads;
/// `binned` and `tiles` depend on the tile size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Stats {
    /// Triangles, segments and points recorded, without those of draws that are left out ([`Pass::bounds`](crate::Pass::bounds)).
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
    /// Triangles that a tile hid as a whole, counted once per tile.
    pub tiles_rejected: u64,
    /// Tiles that one triangle filled completely.
    pub tiles_filled: u64,
    /// Tiles whose opaque triangles were drawn a second time, in the order of (object, face),
    /// because several of them have equal depth at too many samples. The counts of blocks and
    /// groups are those of the second time.
    pub tiles_reordered: u64,
    /// Blocks of 8 by 8 pixels that a triangle does not cover, or that hid it as
    /// a whole.
    pub blocks_rejected: u64,
    /// Blocks that a triangle covers all of.
    pub blocks_accepted: u64,
    /// Groups of 4 by 2 pixels that were tested sample by sample, outside of
    /// accepted blocks; a triangle of a few pixels, which is tested pixel by pixel,
    /// counts as one.
    pub groups_tested: u64,
    /// Samples that show an opaque or masked triangle. Zero unless
    /// [`ExecuteSettings::timed`](crate::ExecuteSettings::timed) is set.
    pub samples_visible: u64,
    /// Fragments that were shaded.
    pub pixels_shaded: u64,
    /// Translucent fragments that were shaded.
    pub pixels_blended: u64,
    /// Visible triangles that edges were painted on, counted once per tile.
    pub triangles_edged: u64,
    /// Fragments whose mask was evaluated.
    pub samples_masked: u64,
    /// How long the stages took, if
    /// [`ExecuteSettings::timed`](crate::ExecuteSettings::timed) is set.
    pub times: StageTimes,
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
        self.tiles_rejected += other.tiles_rejected;
        self.tiles_filled += other.tiles_filled;
        self.tiles_reordered += other.tiles_reordered;
        self.blocks_rejected += other.blocks_rejected;
        self.blocks_accepted += other.blocks_accepted;
        self.groups_tested += other.groups_tested;
        self.samples_visible += other.samples_visible;
        self.pixels_shaded += other.pixels_shaded;
        self.pixels_blended += other.pixels_blended;
        self.triangles_edged += other.triangles_edged;
        self.samples_masked += other.samples_masked;
        self.times += other.times;
    }
}

impl Stats {
    /// Adds the counts of a tile's visibility.
    pub(crate) fn add_counts(&mut self, counts: &Counts) {
        self.tiles_rejected += counts.tiles_rejected;
        self.tiles_filled += counts.tiles_filled;
        self.tiles_reordered += counts.tiles_reordered;
        self.blocks_rejected += counts.blocks_rejected;
        self.blocks_accepted += counts.blocks_accepted;
        self.groups_tested += counts.groups;
    }
}

/// How long the stages of a frame took: elapsed time for vertices and set-up, the
/// sum over all threads for the stages inside tiles. Zero unless
/// [`ExecuteSettings::timed`](crate::ExecuteSettings::timed) is set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes {
    /// Running vertices.
    pub vertices: Duration,
    /// Setting up triangles and sorting them into tiles.
    pub set_up: Duration,
    /// Coverage, depth and masks.
    pub visibility: Duration,
    /// Shading what is visible.
    pub shading: Duration,
    /// Shading and blending what is translucent.
    pub blending: Duration,
    /// Averaging samples, encoding, and writing to the target.
    pub resolve: Duration,
}

impl AddAssign for StageTimes {
    fn add_assign(&mut self, other: Self) {
        self.vertices += other.vertices;
        self.set_up += other.set_up;
        self.visibility += other.visibility;
        self.shading += other.shading;
        self.blending += other.blending;
        self.resolve += other.resolve;
    }
}

/// Measures laps, or nothing: WebAssembly alone has no clock.
pub(crate) struct Clock(Option<Instant>);

impl Clock {
    pub(crate) fn new(is_timed: bool) -> Self {
        let has_clock = !cfg!(all(target_family = "wasm", target_os = "unknown"));
        Self((is_timed && has_clock).then(Instant::now))
    }

    /// The time since the last lap.
    pub(crate) fn lap(&mut self) -> Duration {
        let Some(last) = &mut self.0 else {
            return Duration::ZERO;
        };
        let now = Instant::now();
        now - std::mem::replace(last, now)
    }
}

/// Counts of blocks and samples.
#[derive(Clone, Copy, Default)]
pub(crate) struct Counts {
    pub(crate) tiles_rejected: u64,
    pub(crate) tiles_filled: u64,
    pub(crate) blocks_rejected: u64,
    pub(crate) blocks_accepted: u64,
    pub(crate) groups: u64,
    pub(crate) tiles_reordered: u64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each count and each time is another number.
    fn numbered(first: u64) -> Stats {
        let count = |index: u64| first + index;
        let time = |index: u64| Duration::from_millis(first * 100 + index);
        Stats {
            primitives: count(0),
            vertices: count(1),
            invalid: count(2),
            outside: count(3),
            clipped: count(4),
            culled: count(5),
            set_up: count(6),
            binned: count(7),
            tiles: count(8),
            tiles_rejected: count(9),
            tiles_filled: count(10),
            tiles_reordered: count(11),
            blocks_rejected: count(12),
            blocks_accepted: count(13),
            groups_tested: count(14),
            samples_visible: count(15),
            pixels_shaded: count(16),
            pixels_blended: count(17),
            triangles_edged: count(18),
            samples_masked: count(19),
            times: StageTimes {
                vertices: time(20),
                set_up: time(21),
                visibility: time(22),
                shading: time(23),
                blending: time(24),
                resolve: time(25),
            },
        }
    }

    #[test]
    fn each_count_and_each_time_is_added_up() {
        let mut sum = numbered(1000);
        sum += numbered(5000);
        let mut twice = numbered(3000);
        twice += numbered(3000);
        assert_eq!(sum, twice, "1000 + 5000 = 3000 + 3000 in every field");
        assert_eq!((sum.primitives, sum.samples_masked), (6000, 6038));
        assert_eq!(sum.times.resolve, Duration::from_millis(600_050));
        let mut same = numbered(7);
        same += Stats::default();
        assert_eq!(same, numbered(7), "nothing changes nothing");
    }

    #[test]
    fn the_counts_of_a_tile_are_added() {
        let counts = Counts {
            tiles_rejected: 1,
            tiles_filled: 2,
            tiles_reordered: 3,
            blocks_rejected: 4,
            blocks_accepted: 5,
            groups: 6,
        };
        let mut stats = numbered(100);
        stats.add_counts(&counts);
        let expected = Stats {
            tiles_rejected: 110,
            tiles_filled: 112,
            tiles_reordered: 114,
            blocks_rejected: 116,
            blocks_accepted: 118,
            groups_tested: 120,
            ..numbered(100)
        };
        assert_eq!(stats, expected);
    }
}
