//! The pipelines of edges, loose lines and points, and of faces that only hide what is behind them; and the vertices of a
//! mesh that are drawn as points.

use std::collections::HashMap;
use std::mem::take;
use std::sync::{Arc, Mutex, PoisonError};

use fixedbitset::FixedBitSet;
use rayon::prelude::*;
use trigon_math::{UVec2, Vec3, Vec4};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, lanes_of};
use trigon_raster::{Fragment, FragmentLanes, LanePipeline, MarkColors, Pipeline, VertexLanes, VertexOutput};

use crate::elements;
use crate::elements::Mark;
use crate::geometry::Columns;
use crate::material::{AlphaMode, Material};
use crate::node::NodeId;
use crate::placement::Placement;
use crate::prepare::Backdrop;

/// Lines in one colour, or points, unlit.
pub(super) struct Wire<'a> {
    pub(super) positions: &'a [Vec3],
    pub(super) placement: Placement,
    pub(super) paint: WirePaint,
    /// The colours of points, if they differ.
    pub(super) colors: Option<PointColors<'a>>,
    /// Lines or points in other colours.
    pub(super) marks: WireMarks,
}

/// Lines whose vertices have colours, unlit.
pub(super) struct ColoredLines<'a> {
    pub(super) wire: Wire<'a>,
    /// Of the mesh's vertices.
    pub(super) colors: &'a [Vec4],
}

/// The colours of a mesh's vertices, and which of them a draw shows as points.
#[derive(Clone, Copy)]
pub(super) struct PointColors<'a> {
    pub(super) of_vertices: &'a [Vec4],
    pub(super) points: &'a [u32],
}

/// What a material makes of lines and points: glTF 2.0, section 3.7.2.1, defines those without normals as base colour
/// times colour of the vertex plus emission.
#[derive(Clone, Copy)]
pub(super) struct WirePaint {
    base_color: Vec4,
    emissive: Vec3,
    alpha_mode: AlphaMode,
}

impl WirePaint {
    pub(super) fn of(material: &Material) -> Self {
        let Material { base_color, emissive, alpha_mode, .. } = *material;
        Self { base_color, emissive, alpha_mode }
    }

    /// Opaque, in linear RGB.
    pub(super) fn of_color(color: Vec3) -> Self {
        Self { base_color: color.extend(1.0), emissive: Vec3::ZERO, alpha_mode: AlphaMode::Opaque }
    }

    /// The same for outputs that see through nothing but what is transparent altogether.
    pub(super) fn masked(self) -> Self {
        Self { alpha_mode: AlphaMode::Mask { cutoff: f32::MIN_POSITIVE }, ..self }
    }

    pub(super) fn alpha_mode(&self) -> AlphaMode {
        self.alpha_mode
    }

    /// What a vertex of some colour shows, premultiplied.
    fn shown(&self, vertex: Vec4) -> Vec4 {
        let color = self.base_color * vertex;
        let light = color.truncate() + self.emissive;
        match self.alpha_mode {
            AlphaMode::Opaque | AlphaMode::Mask { .. } => light.extend(1.0),
            AlphaMode::Blend => {
                let alpha = color.w.clamp(0.0, 1.0);
                (light * alpha).extend(alpha)
            }
        }
    }

    fn is_drawn(&self, vertex: Vec4) -> bool {
        match self.alpha_mode {
            AlphaMode::Opaque | AlphaMode::Blend => true,
            AlphaMode::Mask { cutoff } => self.base_color.w * vertex.w >= cutoff,
        }
    }
}

/// The marks of a draw's lines or points.
#[derive(Default)]
pub(super) struct WireMarks {
    /// By the index of the line or point; without a mark beyond the end.
    pub(super) numbers: Arc<Vec<u8>>,
    /// By their numbers.
    pub(super) colors: [Vec4; MarkColors::COUNT],
}

impl WireMarks {
    /// The colour of a marked line or point.
    fn color(&self, index: u32) -> Option<Vec4> {
        let number = self.numbers.get(index as usize).copied().filter(|&number| number != 0)?;
        Some(self.colors[usize::from(number)].truncate().extend(1.0))
    }
}

impl Wire<'_> {
    /// The colour of a line or point before its material's.
    fn vertex_color(&self, index: u32) -> Vec4 {
        let of = |colors: PointColors<'_>| colors.of_vertices[colors.points[index as usize] as usize];
        self.colors.map_or(Vec4::ONE, of)
    }

    fn clip_position(&self, vertex: usize) -> Vec4 {
        let position = self.positions[vertex] - self.placement.anchor;
        self.placement.to_clip * position.extend(1.0)
    }
}

impl Pipeline for Wire<'_> {
    type Varyings = ();
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.clip_position(index), varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let own = || self.paint.shown(self.vertex_color(fragment.triangle));
        self.marks.color(fragment.triangle).unwrap_or_else(own)
    }

    fn mask(&self, fragment: &Fragment<()>) -> bool {
        self.paint.is_drawn(self.vertex_color(fragment.triangle))
    }
}

impl Pipeline for ColoredLines<'_> {
    /// The colour of the vertex.
    type Varyings = Vec4;

    fn vertex_count(&self) -> usize {
        self.wire.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec4> {
        VertexOutput { position: self.wire.clip_position(index), varyings: self.colors[index] }
    }

    fn fragment(&self, fragment: &Fragment<Vec4>) -> Vec4 {
        let own = || self.wire.paint.shown(fragment.varyings);
        self.wire.marks.color(fragment.triangle).unwrap_or_else(own)
    }

    fn mask(&self, fragment: &Fragment<Vec4>) -> bool {
        self.wire.paint.is_drawn(fragment.varyings)
    }
}

/// A pipeline of lines or points.
pub(super) trait AnyWire<'a>: Pipeline {
    fn wire(&self) -> &Wire<'a>;
}

impl<'a> AnyWire<'a> for Wire<'a> {
    fn wire(&self) -> &Self {
        self
    }
}

impl<'a> AnyWire<'a> for ColoredLines<'a> {
    fn wire(&self) -> &Wire<'a> {
        &self.wire
    }
}

/// Faces painted in the background's colour. With the edges that the pass paints on them, they make a
/// hidden-line image.
pub(super) struct HiddenLine<'a> {
    pub(super) columns: &'a Columns,
    pub(super) placement: Placement,
    pub(super) backdrop: &'a Backdrop,
}

impl LanePipeline for HiddenLine<'_> {
    const VARYINGS: usize = 0;

    fn vertex_count(&self) -> usize {
        self.columns.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z] = &self.columns.positions;
        let position = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
        self.placement.clip(simd, position)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [columns, rows]: [[f32; LANES]; 2] = fragments.position().each(
            #[inline(always)]
            |axis| axis.into(),
        );
        let papers =
            lanes_of(|lane| self.backdrop.at(UVec2::new(columns[lane] as u32, rows[lane] as u32)).to_array());
        [0, 1, 2, 3].each(
            #[inline(always)]
            |channel| {
                let values = papers.each(
                    #[inline(always)]
                    |paper| paper[channel],
                );
                F32::simd_from(simd, values)
            },
        )
    }
}

/// Vertices that a thread takes at a time.
const SHARE: usize = 1 << 14;

/// The vertices of a mesh at a node that are shown as points, with their marks. The lists are shared
/// with the last image, which compares them with those of the next.
#[derive(Clone)]
pub(super) struct VertexList {
    /// Increasing.
    pub(super) points: Arc<Vec<u32>>,
    /// The number of the mark of each point, 0 without one.
    pub(super) numbers: Arc<Vec<u8>>,
    /// The points that have a mark.
    pub(super) marked: Arc<FixedBitSet>,
}

impl VertexList {
    /// The used vertices, without those that a mark hides.
    fn new(node: NodeId, used: &[bool], marks: &[Mark]) -> Self {
        let (of_vertices, colors) = (elements::numbers(marks, node), elements::colors(marks));
        let starts: Vec<usize> = (0..used.len()).step_by(SHARE).collect();
        let shares = starts.into_par_iter().map(|start| {
            let share = start..used.len().min(start + SHARE);
            let (mut points, mut numbers) = (Vec::with_capacity(SHARE), Vec::with_capacity(SHARE));
            for vertex in share.filter(|&vertex| used[vertex]) {
                let number = of_vertices.get(vertex).copied().unwrap_or(0);
                if number == 0 || colors[usize::from(number)].w > 0.0 {
                    points.push(vertex as u32);
                    numbers.push(number);
                }
            }
            (points, numbers)
        });
        let (points, numbers): (Vec<Vec<u32>>, Vec<Vec<u8>>) = shares.unzip();
        let (points, numbers) = (points.concat(), numbers.concat());
        let word = |numbers: &[u8]| {
            numbers.iter().rev().fold(0, |word, &number| word << 1 | usize::from(number != 0))
        };
        let words = numbers.chunks(usize::BITS as usize).map(word);
        let marked = FixedBitSet::with_capacity_and_blocks(numbers.len(), words);
        Self { points: Arc::new(points), numbers: Arc::new(numbers), marked: Arc::new(marked) }
    }
}

/// The lists of the last frame, most of which the next one shows again.
#[derive(Default)]
pub(super) struct VertexLists(Mutex<TwoFrames>);

#[derive(Default)]
struct TwoFrames {
    last: HashMap<NodeId, KnownList>,
    now: HashMap<NodeId, KnownList>,
}

/// A list, and what it was made from.
struct KnownList {
    used: Arc<Vec<bool>>,
    marks: Vec<Mark>,
    list: VertexList,
}

impl VertexLists {
    /// Begins a frame: forgets lists that the last one did not use.
    pub(super) fn begin(&mut self) {
        let TwoFrames { last, now } = self.0.get_mut().unwrap_or_else(PoisonError::into_inner);
        *last = take(now);
    }

    /// The used vertices of a node's mesh, without those that a mark hides.
    pub(super) fn of(&self, node: NodeId, used: &Arc<Vec<bool>>, marks: &[Mark]) -> VertexList {
        let mut frames = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let TwoFrames { last, now } = &mut *frames;
        let known = now.remove(&node).or_else(|| last.remove(&node));
        let known = known.filter(|known| known.is_of(used, marks)).unwrap_or_else(|| KnownList {
            used: Arc::clone(used),
            marks: marks.to_vec(),
            list: VertexList::new(node, used, marks),
        });
        now.entry(node).insert_entry(known).get().list.clone()
    }
}

impl KnownList {
    /// Whether it was made from the same. Sets that were made anew may be equal, but comparing them takes long.
    fn is_of(&self, used: &Arc<Vec<bool>>, marks: &[Mark]) -> bool {
        let are_same = |(one, other): (&Mark, &Mark)| {
            Arc::ptr_eq(&one.elements, &other.elements)
                && (one.color, one.opacity) == (other.color, other.opacity)
        };
        Arc::ptr_eq(&self.used, used)
            && self.marks.len() == marks.len()
            && self.marks.iter().zip(marks).all(are_same)
    }
}

#[cfg(test)]
mod tests {
    use fixedbitset::FixedBitSet;
    use trigon_math::Vec3;

    use super::*;
    use crate::{ElementSet, Node, Scene};

    #[test]
    fn a_list_is_kept_as_long_as_nothing_of_it_changes() {
        let mut scene = Scene::new();
        let [node, other] = [(); 2].map(|()| scene.add(Node::default()));
        let used = Arc::new(vec![true, false, true, true]);
        let mark = |hidden: usize, opacity: f32| {
            let mut bits = FixedBitSet::with_capacity(4);
            bits.insert(hidden);
            let mut elements = ElementSet::default();
            elements.add(node, bits);
            Mark { elements: Arc::new(elements), color: Vec3::ONE, opacity, outlined: false }
        };
        let (marked, transparent) = (vec![mark(2, 1.0)], vec![mark(2, 0.0)]);
        let mut lists = VertexLists::default();
        let mut points = |node: NodeId, used: &Arc<Vec<bool>>, marks: &[Mark]| {
            lists.begin();
            lists.of(node, used, marks).points
        };
        let first = points(node, &used, &marked);
        assert_eq!(*first, [0, 2, 3], "the used ones");
        assert!(Arc::ptr_eq(&first, &points(node, &used, &marked)), "the same list");
        assert_eq!(*points(node, &used, &transparent), [0, 3], "a mark hides one");
        assert_eq!(*points(node, &Arc::new(vec![true; 2]), &transparent), [0, 1], "of another mesh");
        assert_eq!(*points(other, &used, &marked), [0, 2, 3], "of another node");
        let again = points(node, &used, &marked);
        assert!(*again == *first && !Arc::ptr_eq(&again, &first), "it was not shown meanwhile");
    }
}
