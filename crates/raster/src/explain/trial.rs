//! The comparison of all triangles at a sample, with every step recorded. For colours and masks a triangle's pipeline
//! runs for one pixel.

use super::{EdgeExplanation, FragmentExplanation, PrimitiveKind, SampleExplanation, Verdict};
use crate::bin::TriangleRef;
use crate::blend::{SampleShare, leaves};
use crate::fragments::{Job, ShadePoint};
use crate::frame::outer_ink;
use crate::outer_ink::OuterInk;
use crate::primitive::{Corners, Edge, Form, Kind, SetupTriangle, Stroke};
use crate::resolve::saturated;
use crate::shade::{JobList, Shading, mask_jobs, shade_jobs_with};
use crate::tile::TileTriangle;
use crate::tile_buffer::{BEHIND_ALL, TileArea};
use crate::view::FrameView;
use crate::{BlendMode, ulps};
use std::cmp::Ordering;
use trigon_math::Vec4;

/// A frame and all of its triangles.
pub(super) struct Trial<'f> {
    frame: &'f FrameView<'f>,
    triangles: Vec<(TriangleRef, SetupTriangle)>,
}

/// A triangle at a sample, still with its name.
struct Entrant {
    triangle_ref: TriangleRef,
    /// The share that it covers, if it covers the sample.
    coverage: f32,
    fragment: FragmentExplanation,
}

impl Entrant {
    fn depth(&self) -> f32 {
        self.fragment.depth.unwrap_or(BEHIND_ALL)
    }

    fn is(&self, verdict: Verdict) -> bool {
        self.fragment.verdict == verdict
    }
}

impl<'f> Trial<'f> {
    pub(super) fn new(frame: &'f FrameView<'f>) -> Self {
        let triangle_refs = frame.chunks.iter().flat_map(|chunk| chunk.all());
        let triangles = triangle_refs.flat_map(|triangle_ref| {
            // A point that is drawn from its vertex has one entry for both halves of its square.
            let other = frame
                .draw_view(frame.draw_of(triangle_ref))
                .square(triangle_ref)
                .map(|square| square.half(1));
            [Some(frame.triangle(triangle_ref)), other]
                .into_iter()
                .flatten()
                .map(move |triangle| (triangle_ref, triangle))
        });
        Self { frame, triangles: triangles.collect() }
    }

    /// What happened at a sample of a pixel of the finer grid.
    pub(super) fn sample(&self, cell: [u32; 2], number: usize) -> SampleExplanation {
        let frame = self.frame;
        let tile = cell.map(|v| frame.grid.tile_of(v));
        let tile = tile[1] * frame.grid.columns + tile[0];
        let (area, outer) = (frame.area(tile), outer_ink(frame, tile));
        let at = [0, 1].map(|axis| cell[axis] as usize - area.origin[axis] as usize);
        let pixel = PixelInTile { area, at };
        let offset = frame.grid.pattern.offsets()[number];
        let position = [0, 1].map(|axis| cell[axis] as i32 * 256 + offset[axis]);
        let entries = self.triangles.iter();
        let mut entrants: Vec<Entrant> = entries
            .filter_map(|(triangle_ref, triangle)| {
                self.enter(pixel, number, position, *triangle_ref, triangle)
            })
            .collect();
        self.judge(&mut entrants);
        self.number_layers(&mut entrants);
        for entrant in &mut entrants {
            if matches!(entrant.fragment.verdict, Verdict::Visible | Verdict::Layer(_)) {
                // Over translucent faces no edges of others are laid.
                let outer = if entrant.is(Verdict::Visible) { &outer } else { &OuterInk::default() };
                let color = color_of(frame, pixel, entrant.triangle_ref, outer);
                entrant.fragment.color = Some(color * entrant.coverage);
            }
        }
        entrants.sort_by(|a, b| self.in_telling_order(a, b));
        let fragments: Vec<_> = entrants.into_iter().map(|entrant| entrant.fragment).collect();
        let background = frame.lined_background_at(&area, at, &outer);
        SampleExplanation { cell, number, position, color: blended(&fragments, background), fragments }
    }

    /// A triangle whose bounding box holds the sample.
    fn enter(
        &self,
        pixel: PixelInTile,
        number: usize,
        point: [i32; 2],
        triangle_ref: TriangleRef,
        triangle: &SetupTriangle,
    ) -> Option<Entrant> {
        let within = |axis: usize| {
            let [low, high] = triangle.extent(axis);
            low <= point[axis] && point[axis] <= high
        };
        if !(within(0) && within(1)) {
            return None;
        }
        let mut fragment = self.describe(triangle_ref, triangle, point);
        let covering = TileTriangle::new(triangle, &self.frame.grid, &pixel.area);
        let at = pixel.at.map(|v| v as i32);
        let stroke = self.frame.chunk_of(triangle_ref).stroke_of(triangle_ref);
        let coverage = stroke.map_or(1.0, |stroke| stroke.coverage_at(point) as f32);
        let covers = |covering: &TileTriangle| coverage > 0.0 && covering.covers(at, number, point);
        if let Some(covering) = covering.filter(covers) {
            fragment.is_covered = true;
            fragment.depth = Some(covering.depth.at(point));
            let is_there = match fragment.blend_mode {
                BlendMode::Opaque | BlendMode::Overlay | BlendMode::Translucent => true,
                BlendMode::Masked => passes_mask(self.frame, pixel, None, triangle_ref),
                BlendMode::MaskedPerSample => passes_mask(self.frame, pixel, Some(number), triangle_ref),
            };
            fragment.verdict = if is_there { Verdict::Hidden } else { Verdict::MaskedAway };
        }
        Some(Entrant { triangle_ref, coverage, fragment })
    }

    /// A triangle that misses the sample, until it is known to cover it.
    fn describe(
        &self,
        triangle_ref: TriangleRef,
        triangle: &SetupTriangle,
        point: [i32; 2],
    ) -> FragmentExplanation {
        let frame = self.frame;
        let plan = &frame.plan.draws[frame.draw_of(triangle_ref)];
        let geometry = &frame.pass[plan.draw()].geometry;
        let primitive = triangle_ref.ordinal - plan.ordinals.start;
        let order = order_of(triangle);
        // Each is opposite the vertex that it does not meet.
        let edges = Edge::of(triangle);
        let edges = [2, 0, 1].map(|vertex| explain_edge(&edges[order[vertex]], point));
        FragmentExplanation {
            draw: plan.draw(),
            object: geometry.object,
            face: geometry.face(primitive),
            primitive,
            kind: self.kind_of(triangle_ref, triangle),
            blend_mode: geometry.blend_mode,
            is_cut: self.is_cut(triangle_ref, triangle),
            front_facing: triangle.front_facing,
            vertices: order.map(|i| triangle.vertices[i].raw()),
            edges,
            is_covered: false,
            depth: None,
            margin: None,
            color: None,
            verdict: shut_out(&edges),
        }
    }

    fn kind_of(&self, triangle_ref: TriangleRef, triangle: &SetupTriangle) -> PrimitiveKind {
        match triangle.kind {
            Kind::Triangle => PrimitiveKind::Triangle,
            Kind::Line => PrimitiveKind::Line,
            Kind::SquarePoint => PrimitiveKind::SquarePoint,
            Kind::RoundPoint => PrimitiveKind::RoundPoint,
            Kind::Stroke => match self.frame.chunk_of(triangle_ref).stroke_of(triangle_ref).map(Stroke::form)
            {
                Some(Form::Square) => PrimitiveKind::SquarePoint,
                Some(Form::Round) => PrimitiveKind::RoundPoint,
                Some(Form::Line) | None => PrimitiveKind::Line,
            },
        }
    }

    /// Whether vertices of the triangle are not its primitive's own.
    fn is_cut(&self, triangle_ref: TriangleRef, triangle: &SetupTriangle) -> bool {
        match triangle.corners {
            Corners::Whole(_) => false,
            Corners::Cut { .. } | Corners::Ends(_) => {
                let weights = self.frame.chunk_of(triangle_ref).weights_of(triangle_ref);
                weights.is_some_and(|weights| !weights.iter().all(|corners| corners.contains(&1.0)))
            }
        }
    }

    /// Whether `a` is visible rather than `b`, where both cover the sample.
    fn beats(&self, a: &Entrant, b: &Entrant) -> bool {
        a.depth() > b.depth()
            || (a.depth() == b.depth() && self.frame.precedes(a.triangle_ref, b.triangle_ref))
    }

    /// Finds the visible triangle, and why the others that cover the sample are not visible; layers are left
    /// at [`Verdict::Layer`] 0.
    fn judge(&self, entrants: &mut [Entrant]) {
        for entrant in entrants.iter_mut().filter(|entrant| entrant.is(Verdict::Hidden)) {
            if entrant.depth() <= BEHIND_ALL {
                entrant.fragment.verdict = Verdict::BehindFarPlane;
            }
        }
        let hides = |entrant: &Entrant| {
            entrant.is(Verdict::Hidden) && entrant.fragment.blend_mode != BlendMode::Translucent
        };
        let best = |except: Option<usize>| {
            let rivals = (0..entrants.len()).filter(|&i| Some(i) != except && hides(&entrants[i]));
            rivals.reduce(|a, b| if self.beats(&entrants[b], &entrants[a]) { b } else { a })
        };
        let visible = best(None);
        let next = visible.and_then(|visible| best(Some(visible)));
        let verdicts: Vec<_> =
            entrants.iter().map(|entrant| self.verdict(entrants, entrant, visible)).collect();
        let depths = [visible, next].map(|i| i.map(|i| entrants[i].depth()));
        for (i, (entrant, verdict)) in entrants.iter_mut().zip(verdicts).enumerate() {
            entrant.fragment.verdict = verdict;
            let rival = if visible == Some(i) { depths[1] } else { depths[0] };
            let pair = entrant.fragment.depth.zip(rival);
            entrant.fragment.margin = pair.map(|(ours, theirs)| ulps::ordinal(ours) - ulps::ordinal(theirs));
        }
    }

    fn verdict(&self, entrants: &[Entrant], entrant: &Entrant, visible: Option<usize>) -> Verdict {
        if !entrant.is(Verdict::Hidden) {
            return entrant.fragment.verdict;
        }
        let visible = visible.map(|visible| &entrants[visible]);
        match visible {
            Some(visible) if std::ptr::eq(visible, entrant) => Verdict::Visible,
            _ if entrant.fragment.blend_mode == BlendMode::Translucent
                && visible.is_none_or(|visible| self.beats(entrant, visible)) =>
            {
                Verdict::Layer(0)
            }
            Some(visible) if visible.depth() == entrant.depth() => Verdict::EqualDepth,
            _ => Verdict::Hidden,
        }
    }

    /// Numbers the layers from the back; takes out lines that leave the sample to
    /// another.
    fn number_layers(&self, entrants: &mut [Entrant]) {
        let mut layers: Vec<&mut Entrant> =
            entrants.iter_mut().filter(|entrant| entrant.is(Verdict::Layer(0))).collect();
        layers.sort_by(|a, b| self.back_to_front(a, b));
        let shares: Vec<_> = layers
            .iter()
            .map(|layer| SampleShare { triangle: layer.triangle_ref, coverage: layer.coverage })
            .collect();
        let mut number = 0;
        for (layer, own) in layers.into_iter().zip(&shares) {
            if shares.iter().any(|other| leaves(self.frame, *own, *other)) {
                layer.fragment.verdict = Verdict::LeftToJoint;
            } else {
                layer.fragment.verdict = Verdict::Layer(number);
                number += 1;
            }
        }
    }

    fn back_to_front(&self, a: &Entrant, b: &Entrant) -> Ordering {
        let depth = a.depth().partial_cmp(&b.depth()).unwrap_or(Ordering::Equal);
        depth.then_with(|| self.frame.compare(b.triangle_ref, a.triangle_ref))
    }

    fn in_telling_order(&self, a: &Entrant, b: &Entrant) -> Ordering {
        let rank = |entrant: &Entrant| match entrant.fragment.verdict {
            Verdict::Visible => 0,
            Verdict::Layer(_) => 1,
            Verdict::OutsideEdge(_) | Verdict::OutsideDisc => 3,
            _ => 2,
        };
        rank(a).cmp(&rank(b)).then_with(|| self.back_to_front(b, a))
    }
}

/// The colour of a sample: its layers over the visible triangle or the background.
fn blended(fragments: &[FragmentExplanation], background: Vec4) -> Vec4 {
    let colored = |won: bool| {
        let explained =
            fragments.iter().rev().filter(move |fragment| (fragment.verdict == Verdict::Visible) == won);
        explained.filter_map(|fragment| fragment.color)
    };
    let ground = colored(true).next().unwrap_or(background);
    colored(false).fold(ground, |color, layer| saturated(layer + color * (1.0 - layer.w)))
}

/// The vertices in the order in which they are reported: that of the draw's indices if they are known.
fn order_of(triangle: &SetupTriangle) -> [usize; 3] {
    match (triangle.corners, triangle.kind) {
        (Corners::Whole(corners), Kind::Triangle) => {
            [0, 1, 2].map(|corner| corners.iter().position(|&c| c == corner).expect("corners are 0, 1 and 2"))
        }
        _ => [0, 1, 2],
    }
}

fn explain_edge(edge: &Edge, point: [i32; 2]) -> EdgeExplanation {
    let value = edge.at(point);
    let [right, down] = [edge.right, edge.down].map(f64::from);
    let distance = value as f64 / (right * right + down * down).sqrt() / 256.0;
    EdgeExplanation { value, owns_boundary: edge.bias() == 0, distance }
}

/// Which edge shuts a sample out the most; the disc if none does.
fn shut_out(edges: &[EdgeExplanation; 3]) -> Verdict {
    let outside = (0..3).filter(|&i| !edges[i].is_inside());
    outside
        .min_by(|&a, &b| edges[a].distance.total_cmp(&edges[b].distance))
        .map_or(Verdict::OutsideDisc, Verdict::OutsideEdge)
}

/// A pixel in its tile.
#[derive(Clone, Copy)]
struct PixelInTile {
    area: TileArea,
    at: [usize; 2],
}

impl PixelInTile {
    /// The pixel alone, as fragments of one triangle are shaded.
    fn alone(&self, frame: &FrameView<'_>) -> (Job, ShadePoint) {
        let point = ShadePoint::anywhere(TileArea::index_of(self.at), frame.is_multisampled(), 0);
        (Job { triangle: 0, points: 0..1 }, point)
    }
}

/// Whether a masked triangle exists at a pixel that it covers, or at one of the
/// pixel's samples.
fn passes_mask(
    frame: &FrameView<'_>,
    pixel: PixelInTile,
    sample: Option<usize>,
    triangle: TriangleRef,
) -> bool {
    let (job, point) = pixel.alone(frame);
    let at = |sample| ShadePoint::at_sample(TileArea::index_of(pixel.at), sample, 0);
    let point = sample.map_or(point, at);
    let mut passed = [0];
    let list = JobList { triangles: &[triangle], jobs: &[job], points: &[point] };
    mask_jobs(frame, &pixel.area, &mut Shading::new(), list, &mut passed);
    passed != [0]
}

/// The colour of a triangle at a pixel that it covers, with edges that others paint there.
fn color_of(frame: &FrameView<'_>, pixel: PixelInTile, triangle: TriangleRef, outer: &OuterInk) -> Vec4 {
    let (job, point) = pixel.alone(frame);
    let mut colors = [[0.0; 4]];
    let list = JobList { triangles: &[triangle], jobs: &[job], points: &[point] };
    shade_jobs_with(frame, &pixel.area, &mut Shading::new(), list, &mut colors, outer.covered());
    Vec4::from_array(colors[0])
}
