//! Shades a tile: every visible triangle once at every pixel where it is visible.
//!
//! Groups of 4×2 pixels are shaded in tile order, whichever triangles of a draw they show. Two kinds of pixels go
//! into a list instead: pixels of groups that show several draws, and, with multisampling, pixels that show several
//! triangles. A lane depends on its own triangle and pixel alone, so groups and lists give the same result.
//!
//! Lists of fragments that are sorted by triangle are shaded here, too: masks to be evaluated, and layers to be blended.

use super::shading::{DrawRun, PartialTile, Shading};
use super::visible::{SomeLanes, divide, list};
use crate::bin::TriangleRef;
use crate::draw::Overlap;
use crate::fragments::{
    Codes, Encoding, FragmentSlice, Job, Records, ShadeContext, ShadeOutput, ShadePoint, Task,
    VisibleTriangles,
};
use crate::ink::VisibleFaces;
use crate::simd::{LANES, at_level};
use crate::tile_buffer::{GROUP_COUNT, TileArea};
use crate::view::{FrameView, VisibleTile};

/// Shades the pixels of a tile, or those that are asked for: to bytes if an encoding is given, else in linear
/// light. What covers a part of its pixel is left in linear light in any case. Tells how
/// many fragments were shaded.
pub(crate) fn shade_tile(
    frame: &FrameView<'_>,
    tile: VisibleTile<'_>,
    partly: Option<PartialTile<'_>>,
    shading: &mut Shading,
    encoding: Option<Encoding>,
) -> u64 {
    let count = list_visible(frame, tile, partly, shading);
    let runs = std::mem::take(&mut shading.runs);
    let outer = std::mem::take(&mut shading.outer);
    for run in &runs {
        let context = ShadeContext {
            outer: outer.covered(),
            ..frame.shade_context(tile.area, tile.triangles, run.draw)
        };
        match run.records {
            Some(shape) => shading.records.select(shape),
            None => {
                shading.records.fill(frame.token, &context, &shading.visible_triangles[run.slots.clone()]);
            }
        }
        let visible =
            VisibleTriangles { triangles: tile.buffer.visible(), step: LANES * tile.buffer.samples };
        // With lines on it no triangle is flat.
        if context.is_flat && (frame.ink.is_none() || context.is_of_plain_marks()) {
            shade_flat(frame, &context, shading, run, visible, encoding);
        } else {
            shade_run(frame, &context, shading, run, visible, encoding);
        }
    }
    (shading.runs, shading.outer) = (runs, outer);
    count as u64
}

/// Lists the visible triangles of a tile by draw, and finds what edges cover beyond their triangles. Returns
/// the number of fragments to shade.
pub(crate) fn list_visible(
    frame: &FrameView<'_>,
    tile: VisibleTile<'_>,
    partly: Option<PartialTile<'_>>,
    shading: &mut Shading,
) -> usize {
    let VisibleTile { area, buffer, triangles } = tile;
    let mut outer = std::mem::take(&mut shading.outer);
    let ink = frame.ink.as_ref().filter(|ink| ink.has_lines());
    let some = match partly {
        Some(PartialTile { pixels, .. }) => {
            Some(SomeLanes { shaded: &pixels.lanes, visible: &pixels.visible })
        }
        // Lines reach across the borders of tiles.
        None => {
            ink.map(|_| SomeLanes { shaded: outer.own_lanes(frame, area), visible: &[0xff; GROUP_COUNT] })
        }
    };
    shading.edged = 0;
    let count = at_level!(frame.token, simd => list(simd, buffer, triangles.len(), some, shading));
    divide(frame, buffer, triangles, shading);
    if let Some(ink) = ink {
        outer.begin(triangles.len());
        if let Some(PartialTile { still, indices, .. }) = partly {
            outer.faces_mut().note_again(still, indices);
        }
        let Shading { runs, records, visible_triangles, edged, .. } = shading;
        records.clear();
        for run in runs {
            let context = frame.shade_context(area, triangles, run.draw);
            let visible_triangles = &visible_triangles[run.slots.clone()];
            let shape = records.append(frame.token, &context, visible_triangles, Some(outer.faces_mut()));
            *edged += if shape.lines.is_some() { visible_triangles.len() as u64 } else { 0 };
            run.records = Some(shape);
        }
        outer.find(frame, ink, tile, partly.map(|partly| [&partly.pixels.rows, &partly.pixels.near]));
    } else if !outer.is_empty() {
        outer.begin(0);
    }
    shading.outer = outer;
    count
}

/// What the search for outer halves of lines needs of triangles of a tile, in the order of the frame's primitives.
pub(crate) fn note_faces(
    frame: &FrameView<'_>,
    area: &TileArea,
    triangles: &[TriangleRef],
    records: &mut Records,
) -> VisibleFaces {
    let mut faces = VisibleFaces::default();
    faces.begin(triangles.len());
    let indices: Vec<u32> = (0..triangles.len() as u32).collect();
    records.clear();
    let draw_of = |&index: &u32| frame.draw_of(triangles[index as usize]);
    for indices in indices.chunk_by(|a, b| draw_of(a) == draw_of(b)) {
        let context = frame.shade_context(area, triangles, draw_of(&indices[0]));
        records.append(frame.token, &context, indices, Some(&mut faces));
    }
    faces
}

fn shade_run(
    frame: &FrameView<'_>,
    context: &ShadeContext<'_>,
    shading: &mut Shading,
    run: &DrawRun,
    visible: VisibleTriangles<'_>,
    encoding: Option<Encoding>,
) {
    let Shading { records, columns, slots, groups, fragments, parts, codes, colors, .. } = shading;
    let pipeline = frame.pipeline(run.draw);
    let base = run.slots.start as u32;
    let task = Task {
        records,
        base,
        groups: &groups[run.groups.clone()],
        visible,
        slots,
        fragments: fragments.part(run.fragments.clone()),
        points: None,
    };
    let output = match encoding {
        Some(encoding) => ShadeOutput::Codes(Codes { codes, encoding, colors }),
        None => ShadeOutput::colors(colors),
    };
    let mut output = output.with_ink(context.ink_over());
    pipeline.shade(frame.token, context, &task, columns, &mut output);
    if !run.parts.is_empty() {
        let task = Task::of_fragments(records, base, parts.part(run.parts.clone()));
        let mut output = ShadeOutput::colors(colors).with_ink(context.ink_over());
        pipeline.shade(frame.token, context, &task, columns, &mut output);
    }
}

/// One colour for each triangle, and that for all of its pixels.
fn shade_flat(
    frame: &FrameView<'_>,
    context: &ShadeContext<'_>,
    shading: &mut Shading,
    run: &DrawRun,
    visible: VisibleTriangles<'_>,
    encoding: Option<Encoding>,
) {
    shade_triangles(frame, context, shading, run.draw, run.slots.len(), encoding);
    let Shading { slots, groups, fragments, parts, codes, colors, flat_codes, flat_colors, .. } = shading;
    let base = run.slots.start as u32;
    for group in &groups[run.groups.clone()] {
        let number = group.number as usize;
        let pixels = number * LANES..(number + 1) * LANES;
        let visible_triangles = &visible.triangles[number * visible.step..][..LANES];
        if visible_triangles.iter().all(|&visible| visible == visible_triangles[0]) {
            let slot = (group.slot - base) as usize;
            if encoding.is_some() {
                codes[pixels.clone()].fill(flat_codes[slot]);
            }
            if encoding.is_none() || group.edges != 0 {
                colors[pixels].fill(flat_colors[slot]);
            }
            continue;
        }
        // Lanes that are not active get any colour, which is overwritten later.
        let slot = |lane: usize| {
            let is_shaded = group.lanes >> lane & 1 != 0;
            (if is_shaded { slots[visible_triangles[lane] as usize] } else { group.slot } - base) as usize
        };
        if encoding.is_some() {
            for (lane, code) in codes[pixels.clone()].iter_mut().enumerate() {
                *code = flat_codes[slot(lane)];
            }
        }
        if encoding.is_none() || group.edges != 0 {
            for (lane, color) in colors[pixels].iter_mut().enumerate() {
                *color = flat_colors[slot(lane)];
            }
        }
    }
    let FragmentSlice { slots, outputs, .. } = fragments.part(run.fragments.clone());
    for (&slot, &output) in slots.iter().zip(outputs) {
        match encoding {
            Some(_) => codes[output as usize] = flat_codes[(slot - base) as usize],
            None => colors[output as usize] = flat_colors[(slot - base) as usize],
        }
    }
    let FragmentSlice { slots, outputs, .. } = parts.part(run.parts.clone());
    for (&slot, &output) in slots.iter().zip(outputs) {
        colors[output as usize] = flat_colors[(slot - base) as usize];
    }
}

/// The colours of the flat triangles of a draw, `count` of them.
fn shade_triangles(
    frame: &FrameView<'_>,
    context: &ShadeContext<'_>,
    shading: &mut Shading,
    draw: usize,
    count: usize,
    encoding: Option<Encoding>,
) {
    let Shading { records, columns, flat, flat_codes, flat_colors, .. } = shading;
    flat.clear();
    for slot in 0..count {
        flat.push(slot as u32, ShadePoint::anywhere(0, false, slot));
    }
    let whole = count.next_multiple_of(LANES);
    if flat_colors.len() < whole {
        flat_colors.resize(whole, [0.0; 4]);
        flat_codes.resize(whole, 0);
    }
    let task = Task::of_fragments(records, 0, flat.all());
    let mut output = ShadeOutput::colors(flat_colors);
    frame.pipeline(draw).shade(frame.token, context, &task, columns, &mut output);
    if let Some(encoding) = encoding {
        at_level!(frame.token, simd => encoding.encode_all(simd, &flat_colors[..whole], flat_codes));
    }
}

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
