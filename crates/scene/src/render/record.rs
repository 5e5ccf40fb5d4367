//! Draws that own their pipelines, kept until they are recorded in a pass.

use std::ops::Range;
use std::sync::Arc;

use fixedbitset::FixedBitSet;
use trigon_raster::{
    BlendMode, Culling, Draw, EdgeFlags, LanePipeline, Lines, MarkedPoints, Marks, Pass, Points,
};

use super::wire::{AnyWire, HiddenLine, Wire};
use crate::geometry::Geometry;
use crate::placement::Placement;
use crate::surface::Surface;

/// A draw that owns its pipeline, whatever its type, and can be recorded.
pub(super) trait Record {
    fn record<'a>(&'a self, pass: &mut Pass<'a>);

    /// What it draws.
    fn source(&self) -> DrawSource<'_>;
}

/// The parts of a draw other than its material.
pub(super) struct DrawSource<'s> {
    pub(super) geometry: &'s Geometry,
    /// Those of the geometry's triangles that are drawn; none of lines and points.
    pub(super) triangles: Range<usize>,
    pub(super) placement: Placement,
    pub(super) marked: Marked<'s>,
}

/// The marks of a draw's primitives.
#[derive(Clone, Copy)]
pub(super) enum Marked<'s> {
    /// Of triangles, by their faces and their sides.
    Faces(Option<&'s ObjectMarks<'s>>),
    /// Of lines and points, by their indices.
    Wires(WireNumbers<'s>),
}

/// The marks of lines or points.
#[derive(Clone, Copy)]
pub(super) struct WireNumbers<'s> {
    pub(super) numbers: &'s Arc<Vec<u8>>,
    /// The vertices that the points are, if that may change while the mesh stays as it is.
    pub(super) points: Option<&'s Arc<Vec<u32>>>,
    /// The points that are larger.
    pub(super) large: Option<&'s Arc<FixedBitSet>>,
}

/// Triangles of one mesh, wherever they are: nodes that draw the same share them.
pub(super) struct TriangleRun<'s> {
    pub(super) geometry: &'s Geometry,
    /// Those of the geometry's triangles that are drawn.
    pub(super) range: Range<usize>,
    /// Of those that are drawn.
    pub(super) edge_flags: Option<&'s [EdgeFlags]>,
}

/// Triangles of one mesh at one node. A scene may have millions: what does not depend on the node is shared.
pub(super) struct TriangleDraw<'s, P> {
    pub(super) pipeline: P,
    pub(super) run: Arc<TriangleRun<'s>>,
    /// Few draws have any.
    pub(super) marks: Option<Box<ObjectMarks<'s>>>,
    pub(super) object: u32,
    pub(super) culling: Culling,
    pub(super) blend_mode: BlendMode,
}

/// The marks of an object's edges and faces, for some of its triangles.
pub(super) struct ObjectMarks<'s> {
    pub(super) sides: &'s [[u32; 3]],
    pub(super) numbers: Arc<MarkNumbers>,
}

/// The marks of edges and of faces, by their numbers in the mesh, as [`Marks`] has them.
#[derive(PartialEq)]
pub(super) struct MarkNumbers {
    pub(super) edges: Vec<u8>,
    pub(super) faces: Vec<u8>,
}

/// A pipeline of faces.
pub(super) trait Faces: LanePipeline {
    /// Where they are.
    fn placement(&self) -> Placement;
}

impl<const FLAT: bool> Faces for Surface<'_, FLAT> {
    fn placement(&self) -> Placement {
        self.placement
    }
}

impl Faces for HiddenLine<'_> {
    fn placement(&self) -> Placement {
        self.placement
    }
}

impl<P: Faces> Record for TriangleDraw<'_, P> {
    fn record<'a>(&'a self, pass: &mut Pass<'a>) {
        let TriangleRun { geometry, ref range, edge_flags } = *self.run;
        pass.triangles(Draw {
            faces: geometry.faces_of(range.clone()),
            edge_flags,
            marks: self.marks.as_ref().map(|marks| Marks {
                sides: marks.sides,
                edges: &marks.numbers.edges,
                faces: &marks.numbers.faces,
            }),
            object: self.object,
            culling: self.culling,
            blend_mode: self.blend_mode,
            ..Draw::new(&self.pipeline, &geometry.triangles[range.clone()])
        });
    }

    fn source(&self) -> DrawSource<'_> {
        let marked = Marked::Faces(self.marks.as_deref());
        let (geometry, triangles) = (self.run.geometry, self.run.range.clone());
        DrawSource { geometry, triangles, placement: self.pipeline.placement(), marked }
    }
}

/// Edges and loose lines of one mesh. They belong to no face.
pub(super) struct Segments<'s, P> {
    pub(super) pipeline: P,
    pub(super) geometry: &'s Geometry,
    pub(super) segments: &'s [[u32; 2]],
    pub(super) object: u32,
    pub(super) width: f32,
    pub(super) blend_mode: BlendMode,
}

impl<'s, P: AnyWire<'s>> Record for Segments<'s, P> {
    fn record<'a>(&'a self, pass: &mut Pass<'a>) {
        pass.lines(Lines {
            common_id: Some(NO_FACE),
            object: self.object,
            width: self.width,
            blend_mode: self.blend_mode,
            ..Lines::new(&self.pipeline, self.segments)
        });
    }

    fn source(&self) -> DrawSource<'_> {
        let wire = self.pipeline.wire();
        let wires = WireNumbers { numbers: &wire.marks.numbers, points: None, large: None };
        wire.source(self.geometry, wires)
    }
}

/// The id of lines and points.
const NO_FACE: u32 = u32::MAX;

/// The vertices that points show.
pub(super) enum PointList<'s> {
    /// All loose points of a mesh.
    Loose(&'s [u32]),
    Listed(Arc<Vec<u32>>),
}

/// Vertices of one mesh as points. They belong to no face.
pub(super) struct Dots<'s> {
    pub(super) pipeline: Wire<'s>,
    pub(super) geometry: &'s Geometry,
    pub(super) points: PointList<'s>,
    pub(super) object: u32,
    pub(super) size: f32,
    /// Those of another size.
    pub(super) marked: Option<(Arc<FixedBitSet>, f32)>,
    pub(super) blend_mode: BlendMode,
    /// See [`Points::depth_bias`].
    pub(super) depth_bias: f32,
}

impl Record for Dots<'_> {
    fn record<'a>(&'a self, pass: &mut Pass<'a>) {
        let marked = self.marked.as_ref().map(|(set, size)| MarkedPoints { set, size: *size });
        let points = match &self.points {
            PointList::Loose(points) => points,
            PointList::Listed(points) => points.as_slice(),
        };
        pass.points(Points {
            common_id: Some(NO_FACE),
            object: self.object,
            marked,
            blend_mode: self.blend_mode,
            depth_bias: self.depth_bias,
            ..Points::new(&self.pipeline, points, self.size)
        });
    }

    fn source(&self) -> DrawSource<'_> {
        let large = self.marked.as_ref().map(|(set, _)| set);
        let numbers = &self.pipeline.marks.numbers;
        let points = match &self.points {
            PointList::Loose(_) => None,
            PointList::Listed(points) => Some(points),
        };
        self.pipeline.source(self.geometry, WireNumbers { numbers, points, large })
    }
}

impl Wire<'_> {
    fn source<'s>(&self, geometry: &'s Geometry, wires: WireNumbers<'s>) -> DrawSource<'s> {
        DrawSource { geometry, triangles: 0..0, placement: self.placement, marked: Marked::Wires(wires) }
    }
}
