//! Shades lists of fragments, sorted by triangle: masks to be evaluated, and layers to be blended.

use super::Shading;
use crate::bin::TriangleRef;
use crate::fragments::{Job, ShadeContext, ShadeOutput, ShadePoint, Task};
use crate::marks::Overlap;
use crate::tile_buffer::TileArea;
use crate::view::FrameView;

/// So many triangles at most are ready at a time, to bound memory.
const READY: usize = 1024;

/// Triangles of a tile to be shaded, each at some of its pixels.
#[derive(Clone, Copy)]
pub(crate) struct JobList<'l> {
    /// The tile's triangles.
    pub(crate) triangles: &'l [TriangleRef],
    pub(crate) jobs: &'l [Job],
    /// The pixels that the jobs refer to.
    pub(crate) points: &'l [ShadePoint],
}

/// Shades jobs in the order of their draws.
pub(crate) fn shade_jobs(
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    list: JobList<'_>,
    colors: &mut [[f32; 4]],
) {
    // Edges of other faces are not painted over translucent ones.
    shade_jobs_with(frame, area, shading, list, colors, None);
}

/// [`shade_jobs`], with what edges of other faces cover.
pub(crate) fn shade_jobs_with(
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    list: JobList<'_>,
    colors: &mut [[f32; 4]],
    outer: Option<&[Overlap]>,
) {
    for_each_part(frame, area, shading, list, |draw, context, shading| {
        let context = &ShadeContext { outer, ..*context };
        let Shading { records, columns, fragments, .. } = shading;
        let task = Task::of_fragments(records, 0, fragments.all());
        let mut output = ShadeOutput::colors(colors).with_ink(context.ink_over());
        frame.pipeline(draw).shade(frame.token, context, &task, columns, &mut output);
    });
}

/// Evaluates the masks of jobs: 1 or 0 at each output's index.
pub(crate) fn mask_jobs(
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    list: JobList<'_>,
    passed: &mut [u8],
) {
    for_each_part(frame, area, shading, list, |draw, context, shading| {
        let Shading { records, columns, fragments, .. } = shading;
        let task = Task::of_fragments(records, 0, fragments.all());
        frame.pipeline(draw).mask(frame.token, context, &task, columns, passed);
    });
}

/// Visits the jobs, some of one draw at a time, their triangles and fragments made
/// ready in `shading`.
fn for_each_part(
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    list: JobList<'_>,
    mut visit: impl FnMut(usize, &ShadeContext<'_>, &mut Shading),
) {
    let JobList { triangles, jobs, points } = list;
    let mut rest = jobs;
    while let Some(first) = rest.first() {
        let draw = frame.draw_of(triangles[first.triangle as usize]);
        let end = frame.plan.draws[draw].ordinals.end;
        let same = rest.partition_point(|job| triangles[job.triangle as usize].ordinal < end);
        let (part, after) = rest.split_at(same.min(READY));
        shading.visible_triangles.clear();
        shading.visible_triangles.extend(part.iter().map(|job| job.triangle));
        shading.fragments.clear();
        for (slot, job) in part.iter().enumerate() {
            for &point in &points[job.points.clone()] {
                shading.fragments.push(slot as u32, point);
            }
        }
        let context = frame.shade_context(area, triangles, draw);
        shading.records.fill(frame.token, &context, &shading.visible_triangles);
        visit(draw, &context, shading);
        rest = after;
    }
}
