//! The geometry of a recorded draw: indices and ids, without the pipeline.

use crate::simd::{InlineMap, LANES};
use crate::{BlendMode, Culling, EdgeFlags, MarkedPoints, Marks, PointShape, Smoothing};

/// The primitives of one draw.
pub(crate) enum Shape<'a> {
    Triangles {
        triangles: &'a [[u32; 3]],
        edge_flags: Option<&'a [EdgeFlags]>,
        /// Few draws have any.
        marks: Option<Box<Marks<'a>>>,
        culling: Culling,
    },
    Lines {
        segments: &'a [[u32; 2]],
        width: f32,
        smoothing: Smoothing,
        depth_bias: f32,
    },
    Points {
        points: &'a [u32],
        sizes: PointSizes<'a>,
        shape: PointShape,
        smoothing: Smoothing,
        depth_bias: f32,
    },
}

/// The sizes of a draw's points.
#[derive(Clone, Copy)]
pub(crate) struct PointSizes<'a> {
    pub(crate) size: f32,
    pub(crate) marked: Option<MarkedPoints<'a>>,
}

impl PointSizes<'_> {
    /// What is made of the size of each point, by its index: once for each size.
    pub(crate) fn each<T: Copy>(&self, of_size: impl Fn(f32) -> T) -> impl Fn(u32) -> T {
        let (usual, marked) =
            (of_size(self.size), self.marked.map(|marked| (marked.set, of_size(marked.size))));
        move |point| match marked {
            Some((set, of_marked)) if set.contains(point as usize) => of_marked,
            _ => usual,
        }
    }
}

/// One draw's primitives with what identifies them.
pub(crate) struct Geometry<'a> {
    pub(crate) shape: Shape<'a>,
    /// For each primitive its face id.
    pub(crate) faces: Option<&'a [u32]>,
    /// The face id of all primitives that have none of their own; without it, their indices.
    pub(crate) common_face: Option<u32>,
    pub(crate) object: u32,
    pub(crate) blend_mode: BlendMode,
}

impl Geometry<'_> {
    /// How many primitives there are.
    pub(crate) fn len(&self) -> usize {
        match self.shape {
            Shape::Triangles { triangles, .. } => triangles.len(),
            Shape::Lines { segments, .. } => segments.len(),
            Shape::Points { points, .. } => points.len(),
        }
    }

    /// The vertices of a primitive; a segment's second and a point's only one
    /// are repeated.
    #[inline]
    pub(crate) fn corners(&self, primitive: u32) -> [u32; 3] {
        let index = primitive as usize;
        match self.shape {
            Shape::Triangles { triangles, .. } => triangles[index],
            Shape::Lines { segments, .. } => {
                let [from, to] = segments[index];
                [from, to, to]
            }
            Shape::Points { points, .. } => [points[index]; 3],
        }
    }

    /// The vertices of eight primitives.
    #[inline(always)]
    pub(crate) fn corners_of(&self, primitives: [u32; LANES]) -> [[u32; 3]; LANES] {
        match self.shape {
            Shape::Triangles { triangles, .. } => primitives.each(
                #[inline(always)]
                |primitive| triangles[primitive as usize],
            ),
            Shape::Lines { .. } | Shape::Points { .. } => {
                primitives.each(|primitive| self.corners(primitive))
            }
        }
    }

    /// The first and the last face id if they ascend from primitive to
    /// primitive.
    pub(crate) fn ascending_faces(&self) -> Option<[u32; 2]> {
        let last = (self.len() as u32).checked_sub(1)?;
        // In the middle of the ids the common one or the primitives' indices take over.
        let listed = self.faces.unwrap_or(&[]);
        let listed = &listed[..listed.len().min(self.len())];
        let next = self.common_face.unwrap_or(listed.len() as u32);
        let in_order =
            listed.is_sorted() && (listed.len() == self.len() || listed.last().is_none_or(|&id| id <= next));
        in_order.then(|| [self.face(0), self.face(last)])
    }

    /// The face id of a primitive.
    #[inline]
    pub(crate) fn face(&self, primitive: u32) -> u32 {
        let listed = self.faces.and_then(|faces| faces.get(primitive as usize));
        listed.copied().unwrap_or_else(|| self.common_face.unwrap_or(primitive))
    }

    /// Whether a pass that paints edges paints those of this draw.
    #[inline]
    pub(crate) fn shows_edges(&self) -> bool {
        matches!(self.shape, Shape::Triangles { edge_flags: Some(_), .. })
    }

    /// Which edges of a primitive are a face's.
    #[inline]
    pub(crate) fn edge_flags(&self, primitive: u32) -> EdgeFlags {
        match self.shape {
            Shape::Triangles { edge_flags, .. } => {
                let listed = edge_flags.and_then(|flags| flags.get(primitive as usize));
                listed.copied().unwrap_or(EdgeFlags::ALL)
            }
            Shape::Lines { .. } | Shape::Points { .. } => EdgeFlags::NONE,
        }
    }

    /// What is marked of triangles, if anything is.
    #[inline]
    pub(crate) fn marks(&self) -> Option<&Marks<'_>> {
        match &self.shape {
            Shape::Triangles { marks, .. } => marks.as_deref(),
            Shape::Lines { .. } | Shape::Points { .. } => None,
        }
    }

    /// The marks of a triangle's sides.
    #[inline]
    pub(crate) fn side_marks(&self, primitive: u32) -> [u8; 3] {
        self.marks().map_or([0; 3], |marks| marks.of_sides(primitive))
    }

    /// The indices of all corners, in order.
    pub(crate) fn indices(&self) -> &[u32] {
        match self.shape {
            Shape::Triangles { triangles, .. } => triangles.as_flattened(),
            Shape::Lines { segments, .. } => segments.as_flattened(),
            Shape::Points { points, .. } => points,
        }
    }
}
