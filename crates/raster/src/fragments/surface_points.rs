//! Points of triangles that something other than the rasterizer found visible, such as rays, as the input of a pipeline's
//! shading function. Their weights are given: nothing of them follows from where triangles are on the screen.

use super::columns::Columns;
use super::context::{ShadeContext, ShadePoint};
use super::layout::flag;
use super::records::{Records, Tag};
use super::surface_point::SurfacePoint;
use super::task::{FragmentList, Task};

/// Memory for points, to be reused.
pub struct PointScratch {
    records: Records,
    fragments: FragmentList,
    columns: [Columns; 2],
}

impl Default for PointScratch {
    fn default() -> Self {
        let (records, fragments) = (Records::default(), FragmentList::default());
        Self { records, fragments, columns: [Columns::new(), Columns::new()] }
    }
}

impl PointScratch {
    /// A list of fragments, one for each point; their results go to the indices of the points.
    pub(crate) fn list<'t>(
        &'t mut self,
        context: &ShadeContext<'_>,
        points: &'t [SurfacePoint],
    ) -> (Task<'t>, &'t mut [Columns; 2]) {
        let Self { records, fragments, columns } = self;
        let flags = |point: &SurfacePoint| if point.front_facing { 0 } else { flag::BACK };
        let tags = points.iter().map(|point| Tag { primitive: point.triangle, flags: flags(point) });
        records.set_tags(context.varying_count, tags);
        fragments.clear();
        for index in 0..points.len() {
            fragments.push(index as u32, ShadePoint::anywhere(0, false, index));
        }
        let task = Task { points: Some(points), ..Task::of_fragments(records, 0, fragments.all()) };
        (task, columns)
    }
}
