//! Points that are drawn from their vertices, against the same points as records, which the kernel of
//! squares of any size draws.

use super::{Rasterizer, settings};
use crate::{
    BlendMode, Draw, EdgeFlags, ExecuteSettings, FaceEdges, FixedBitSet, Fragment, MarkedPoints, Output,
    Pass, Pipeline, PointShape, Points, Target, TargetImages, VertexOutput,
};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Vec3, Vec4};

/// No whole number of tiles, of blocks or of groups.
const SIZE: [u32; 2] = [93, 61];

/// Vertices with a colour for each primitive. As points of a flat pipeline they are drawn from their
/// vertices, else from records.
#[derive(Clone, Debug)]
struct Cloud<const FLAT: bool>(Vec<Vec4>);

impl<const FLAT: bool> Pipeline for Cloud<FLAT> {
    type Varyings = ();
    const FLAT: bool = FLAT;

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.0[index], varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let number = fragment.triangle as f32;
        Vec4::new(0.013 * number, 1.0 - 0.02 * number, 0.5, 1.0)
    }
}

/// Points over triangles.
#[derive(Clone, Debug)]
struct Still {
    vertices: Vec<Vec4>,
    /// Of vertices, some of which may not exist.
    points: Vec<u32>,
    sizes: [f32; 2],
    large: FixedBitSet,
    shape: PointShape,
    blend_mode: BlendMode,
    depth_bias: f32,
    /// Of the triangles: their edges, if they show any.
    edges: Option<f32>,
    samples: [u32; 2],
}

impl Still {
    fn draw<P: Pipeline>(
        &self,
        (triangles, points): (&Cloud<false>, &P),
        settings: ExecuteSettings,
    ) -> TargetImages {
        let corners: Vec<_> =
            (0..self.vertices.len() as u32 / 3).map(|i| [0, 1, 2].map(|c| 3 * i + c)).collect();
        let flags = vec![EdgeFlags::ALL; corners.len()];
        let mut pass = Pass::new();
        pass.triangles(Draw { edge_flags: Some(&flags), object: 3, ..Draw::new(triangles, &corners) });
        if let Some(width) = self.edges {
            pass.edges(FaceEdges { width, color: Vec3::X, opacity: 0.7 });
        }
        let Self { shape, blend_mode, depth_bias, sizes: [size, marked], .. } = *self;
        let marked = Some(MarkedPoints { set: &self.large, size: marked });
        let dots =
            Points { shape, blend_mode, depth_bias, marked, ..Points::new(points, &self.points, size) };
        pass.points(Points { object: 4, ..dots });
        let outputs =
            [Output::Srgb8, Output::Linear, Output::Depth, Output::Object, Output::Face, Output::Triangle];
        let target = Target::new(SIZE[0], SIZE[1], &outputs).unwrap();
        let target = target.with_samples_per_axis(self.samples[0]).unwrap();
        let mut target = target.with_samples(self.samples[1]).unwrap();
        Rasterizer::new(settings).unwrap().draw(&pass, &mut target);
        target.into_images()
    }
}

/// In the image, often on samples and at depths of others, beside it, and behind the eye.
fn vertex() -> impl Strategy<Value = Vec4> {
    let coordinates = [-1.2_f32..1.2, -1.2_f32..1.2];
    let on_samples = [0..SIZE[0] * 2, 0..SIZE[1] * 2]
        .prop_map(|coordinate| [0, 1].map(|axis| coordinate[axis] as f32 / SIZE[axis] as f32 - 1.0));
    let coordinates = prop_oneof![2 => coordinates, 1 => on_samples];
    let depth = prop_oneof![(0..=4_u8).prop_map(|quarters| f32::from(quarters) / 4.0), -0.1_f32..1.1];
    let w = prop_oneof![6 => Just(1.0), 2 => 0.2_f32..3.0, 1 => -1.0_f32..0.1];
    (coordinates, depth, w).prop_map(|([x, y], depth, w)| Vec4::new(x * w, y * w, depth * w, w))
}

fn still() -> impl Strategy<Value = Still> {
    let size = || prop_oneof![3 => Just(3.0_f32), 1 => Just(1.0), 2 => 1.0_f32..9.0, 1 => 0.5_f32..40.0];
    let shape = prop_oneof![Just(PointShape::Round), Just(PointShape::Square)];
    let blend_mode = prop_oneof![Just(BlendMode::Opaque), Just(BlendMode::Overlay)];
    let depth_bias = prop_oneof![Just(0.0), Just(0.001), Just(0.5)];
    let edges = prop_oneof![Just(None), Just(Some(1.0)), Just(Some(5.0))];
    let samples = prop_oneof![3 => Just([1, 1]), 1 => Just([2, 1]), 1 => Just([1, 4]), 1 => Just([1, 16])];
    let points = prop::collection::vec(0..45_u32, 1..60);
    let large = prop::collection::vec(any::<bool>(), 0..60);
    let vertices = prop::collection::vec(vertex(), 3..44);
    let looks = (shape, blend_mode, depth_bias, edges, samples);
    (vertices, points, [size(), size()], large, looks).prop_map(|(vertices, points, sizes, large, looks)| {
        let (shape, blend_mode, depth_bias, edges, samples) = looks;
        let large = large.iter().enumerate().filter(|(_, large)| **large).map(|(index, _)| index).collect();
        Still { vertices, points, sizes, large, shape, blend_mode, depth_bias, edges, samples }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 4, ..ProptestConfig::default() })]

    /// Colours, depths and ids.
    #[test]
    fn points_from_vertices_are_as_points_from_records(
        still in still(),
        settings in settings(),
        threads in 1..4_usize,
    ) {
        let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..settings };
        let triangles = Cloud::<false>(still.vertices.clone());
        let expected = still.draw((&triangles, &triangles), ExecuteSettings::default());
        let points = Cloud::<true>(still.vertices.clone());
        let found = still.draw((&triangles, &points), settings);
        prop_assert!(found == expected, "{:?}", settings);
    }
}
