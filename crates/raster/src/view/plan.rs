//! The plan: in which order a frame's draws are set up, and where their vertices are stored.

use crate::BlendMode;
use crate::bin::Chunk;
use crate::pass::RecordedDraw;
use crate::point::PlainPoints;
use crate::vertex::{Slots, UsedVertices};
use fixedbitset::FixedBitSet;
use std::ops::Range;

/// The fewest primitives of a chunk: enough to be worth handing to a worker.
const LEAST: u32 = 8192;

/// The most primitives of a chunk: few enough to stay in a worker's cache.
const MOST: u32 = 65_536;

/// Chunks for each worker, so that none waits long for another. Every tile visits all
/// chunks, so there should not be more.
const SHARES: u32 = 16;

/// One draw of the pass in the frame. There may be millions.
pub(crate) struct DrawPlan {
    draw: u32,
    /// Ordinals of its primitives in the frame.
    pub(crate) ordinals: Range<u32>,
    pub(crate) used: UsedVertices,
    /// Where its vertices begin in the frame's array.
    first_vertex: usize,
    /// The same for its varyings.
    pub(crate) varyings: usize,
    /// Where the plan says how its points look, if they are drawn from their vertices.
    points: Option<u32>,
}

impl DrawPlan {
    /// Index of the draw in the pass.
    #[inline(always)]
    pub(crate) fn draw(&self) -> usize {
        self.draw as usize
    }

    /// Where its vertices are in the frame's array.
    #[inline(always)]
    pub(crate) fn screen_vertices(&self) -> Range<usize> {
        self.first_vertex..self.first_vertex + self.used.len()
    }
}

/// The draws of a frame in the order of their ordinals: opaque, masked, translucent; within each, the smaller
/// object first. So at equal depth the triangle with the smaller ordinal is usually the visible one, whatever
/// order the draws were recorded in.
#[derive(Default)]
pub(crate) struct Plan {
    pub(crate) draws: Vec<DrawPlan>,
    /// The vertices of those draws that use few of many.
    listed: Vec<u32>,
    /// The looks of points: few draws have any.
    points: Vec<PlainPoints>,
    /// How many vertices and varyings there are in all.
    pub(crate) vertices: usize,
    pub(crate) varyings: usize,
    /// How many chunks its primitives are cut into.
    pub(crate) chunks: usize,
    /// Whether the order of ordinals is the order of (object, face) throughout
    /// the opaque draws.
    pub(crate) ordinals_are_keys: bool,
}

impl Plan {
    /// Plans a frame for a number of workers, with so many internal pixels for each pixel and axis,
    /// and cuts it into chunks. If `drawn` is given, all other draws are left out. Returns how many of
    /// `chunks` are used, from the first on, in the order of their ordinals.
    pub(crate) fn make(
        &mut self,
        recorded: &[RecordedDraw<'_>],
        drawn: Option<&FixedBitSet>,
        chunks: &mut Vec<Chunk>,
        workers: usize,
        supersampling: u32,
    ) -> usize {
        self.draws.clear();
        self.listed.clear();
        self.points.clear();
        (self.vertices, self.varyings) = (0, 0);
        let is_drawn = |draw: u32| drawn.is_none_or(|drawn| drawn.contains(draw as usize));
        let needed = recorded.iter().zip(0..).filter(|&(_, draw)| is_drawn(draw));
        self.draws.extend(needed.map(|(draw_of_pass, draw)| {
            let RecordedDraw { geometry, pipeline } = draw_of_pass;
            let used = UsedVertices::new(geometry.indices(), pipeline.vertex_count(), &mut self.listed);
            let points = plain_points(draw_of_pass, supersampling).map(|looks| {
                self.points.push(looks);
                self.points.len() as u32 - 1
            });
            DrawPlan { draw, ordinals: 0..0, used, first_vertex: 0, varyings: 0, points }
        }));
        // Equal keys stay in the order of the pass.
        self.draws.sort_unstable_by_key(|plan| {
            let geometry = &recorded[plan.draw()].geometry;
            (geometry.blend_mode, geometry.object, plan.draw)
        });
        let mut ordinal = 0;
        for plan in &mut self.draws {
            let RecordedDraw { geometry, pipeline } = &recorded[plan.draw()];
            let end = ordinal + geometry.len() as u32;
            plan.ordinals = ordinal..end;
            ordinal = end;
            (plan.first_vertex, plan.varyings) = (self.vertices, self.varyings);
            self.vertices += plan.used.len();
            self.varyings += plan.used.len() * pipeline.stride();
        }
        self.ordinals_are_keys = self.are_keys(recorded);
        let size = (ordinal / (SHARES * workers as u32)).clamp(LEAST, MOST);
        self.chunks = self.cut(recorded, chunks, size);
        self.chunks
    }

    /// Brings the looks of points up to date with a pass for which [`has_points_of`](Self::has_points_of)
    /// holds.
    pub(crate) fn update_points(&mut self, recorded: &[RecordedDraw<'_>], supersampling: u32) {
        for plan in &self.draws {
            let looks = plain_points(&recorded[plan.draw()], supersampling);
            if let (Some(index), Some(looks)) = (plan.points, looks) {
                self.points[index as usize] = looks;
            }
        }
    }

    /// Whether the same draws of a pass have points that are drawn from their vertices.
    pub(crate) fn has_points_of(&self, recorded: &[RecordedDraw<'_>], supersampling: u32) -> bool {
        self.draws.iter().all(|plan| {
            plan.points.is_some() == plain_points(&recorded[plan.draw()], supersampling).is_some()
        })
    }

    /// Whether equal depths can be decided by the ordinal among opaque draws.
    fn are_keys(&self, recorded: &[RecordedDraw<'_>]) -> bool {
        let opaque = self
            .draws
            .iter()
            .map(|plan| &recorded[plan.draw()].geometry)
            .filter(|g| g.blend_mode == BlendMode::Opaque);
        let mut before: Option<((u32, u32), usize)> = None;
        for geometry in opaque.filter(|geometry| geometry.len() > 0) {
            let Some([first, last]) = geometry.ascending_faces() else {
                return false;
            };
            // A face that continues in the next draw, where the triangle of smaller index may be.
            let goes_on = |last: (u32, u32), len: usize| last == (geometry.object, first) && len > 1;
            if before.is_some_and(|(last, len)| last > (geometry.object, first) || goes_on(last, len)) {
                return false;
            }
            before = Some(((geometry.object, last), geometry.len()));
        }
        true
    }

    /// Cuts it into chunks of at most `size` primitives.
    fn cut(&self, recorded: &[RecordedDraw<'_>], chunks: &mut Vec<Chunk>, size: u32) -> usize {
        let mut count = 0;
        let mut add = |ordinals: Range<u32>, blend_mode: BlendMode| {
            if count == chunks.len() {
                chunks.push(Chunk::default());
            }
            chunks[count].reset(ordinals, blend_mode);
            count += 1;
        };
        let blend_mode = |plan: &DrawPlan| recorded[plan.draw()].geometry.blend_mode;
        for draws in self.draws.chunk_by(|a, b| blend_mode(a) == blend_mode(b)) {
            let end = draws[draws.len() - 1].ordinals.end;
            let mut start = draws[0].ordinals.start;
            while start < end {
                let next = end.min(start.saturating_add(size));
                add(start..next, blend_mode(&draws[0]));
                start = next;
            }
        }
        count
    }

    /// The draws that have a share in some ordinals, each with the range of its
    /// primitives.
    pub(crate) fn parts(&self, ordinals: Range<u32>) -> impl Iterator<Item = (&DrawPlan, Range<u32>)> {
        let first = self.draws.partition_point(|plan| plan.ordinals.end <= ordinals.start);
        let draws = self.draws[first..].iter();
        draws.take_while(move |plan| plan.ordinals.start < ordinals.end).map(move |plan| {
            let start = ordinals.start.max(plan.ordinals.start) - plan.ordinals.start;
            let end = ordinals.end.min(plan.ordinals.end) - plan.ordinals.start;
            (plan, start..end)
        })
    }

    /// How the points of a draw look, if they are drawn from their vertices.
    #[inline(always)]
    pub(crate) fn points(&self, draw: &DrawPlan) -> Option<&PlainPoints> {
        draw.points.map(|index| &self.points[index as usize])
    }

    /// How the vertices of a draw are looked up.
    #[inline(always)]
    pub(crate) fn slots(&self, draw: &DrawPlan) -> Slots<'_> {
        draw.used.slots(&self.listed)
    }

    /// The draw of a primitive.
    #[inline]
    pub(crate) fn draw_of(&self, ordinal: u32) -> usize {
        if let [only] = self.draws.as_slice() {
            debug_assert!(only.ordinals.contains(&ordinal), "ordinals come from the plan");
            return 0;
        }
        self.draws.partition_point(|plan| plan.ordinals.end <= ordinal)
    }
}

fn plain_points(recorded: &RecordedDraw<'_>, supersampling: u32) -> Option<PlainPoints> {
    PlainPoints::of(&recorded.geometry, recorded.pipeline.is_flat(), supersampling)
}
