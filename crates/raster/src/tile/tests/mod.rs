//! What tiles show, against a search through all triangles at every sample.
//!
//! The search finds coverage, facing and samples by itself, in whole numbers. Its depths are those of [`DepthPlane`], because
//! it has to find the same ties to the bit; the property `depth_plane` of the workspace's tests holds these to rational numbers.

mod hidden;
mod layers;
mod marks;
mod points;
mod sizes;

use crate::primitive::{DepthPlane, SetupTriangle};
use crate::simd::SimdLevel;
use crate::tile_buffer::BEHIND_ALL;
use crate::vertex::ScreenVertex;
use crate::{
    BlendMode, Culling, DepthTest, Draw, DrawBounds, ExecuteSettings, Fragment, Output, Pass, Pipeline,
    Rasterizer, Stats, Target, TileSize, VertexOutput,
};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Bounds3, Fixed, FixedPoint, Vec4};

/// No whole number of tiles, of blocks or of groups.
const SIZE: [i32; 2] = [75, 45];

/// A triangle over all of the image.
const ALL: [[i32; 2]; 3] = [[-100_000, -100_000], [200_000, -100_000], [-100_000, 200_000]];

/// Corners in 1/256 pixel, and their depths.
#[derive(Clone, Copy, Debug)]
struct Flat {
    points: [[i32; 2]; 3],
    depths: [f32; 3],
}

/// Triangles of one draw, each with a whole number of its own for its light. The mask
/// leaves out every third.
#[derive(Clone, Debug)]
struct Heap {
    object: u32,
    blend_mode: BlendMode,
    culling: Culling,
    triangles: Vec<Flat>,
    faces: Vec<u32>,
    /// The light of the first.
    light: u32,
}

impl Heap {
    fn bounds(&self) -> DrawBounds {
        let positions =
            (0..self.vertex_count()).map(|index| self.vertex(index).position.truncate().as_dvec3());
        let Bounds3 { min, max } = Bounds3::from_points(positions);
        DrawBounds { least: [min.x, min.y], greatest: [max.x, max.y], nearest: max.z }
    }
}

impl Pipeline for Heap {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        3 * self.triangles.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        let Flat { points, depths } = self.triangles[index / 3];
        // Nearer to the point than to any other of the grid.
        let [x, y] =
            [0, 1].map(|axis| f64::from(points[index % 3][axis]) / f64::from(128 * SIZE[axis]) - 1.0);
        let position = Vec4::new(x as f32, -y as f32, depths[index % 3], 1.0);
        VertexOutput { position, varyings: (self.light + index as u32 / 3) as f32 }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        // Layers without alpha add up.
        Vec4::new(fragment.varyings, 0.0, 0.0, 0.0)
    }

    fn mask(&self, fragment: &Fragment<f32>) -> bool {
        fragment.varyings % 3.0 != 0.0
    }
}

/// What the search asks of a triangle.
struct Known {
    points: [[i32; 2]; 3],
    depth: DepthPlane,
    /// Of two equally deep ones the smaller key is seen.
    key: (u32, u32, usize, usize),
    light: f32,
    is_layer: bool,
}

/// Twice the area; positive where the corners run clockwise as seen, y pointing down.
fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i128 {
    let [[ux, uy], [vx, vy]] = [b, c].map(|corner| [0, 1].map(|axis| i128::from(corner[axis] - a[axis])));
    ux * vy - uy * vx
}

/// Whether a triangle holds a sample that is moved to the right by very little, and down by very little of that. So a sample
/// on an edge belongs to the triangle to its right, and on a horizontal edge to the one below.
fn covers(points: [[i32; 2]; 3], sample: [i32; 2]) -> bool {
    let winding = doubled_area(points).signum();
    (0..3).all(|corner| {
        let [from, to] = [points[corner], points[(corner + 1) % 3]];
        let [right, down] = [0, 1].map(|axis| winding * i128::from(to[axis] - from[axis]));
        // What the sample, its way to the right and its way down add to the area on its side of the edge.
        [winding * doubled_area([from, to, sample]), -down, right] > [0; 3]
    })
}

/// The samples of a pixel in 1/256 of it, as Direct3D 11.3 lists them in sixteenths from its middle (section 19.2.4).
fn sample_offsets(samples: u32) -> Vec<[i32; 2]> {
    let sixteenths: &[[i32; 2]] = match samples {
        2 => &[[4, 4], [-4, -4]],
        4 => &[[-2, -6], [6, -2], [-6, 2], [2, 6]],
        16 => &[
            [1, 1],
            [-1, -3],
            [-3, 2],
            [4, -1],
            [-5, -2],
            [2, 5],
            [5, 3],
            [3, -5],
            [-2, 6],
            [0, -7],
            [-4, -6],
            [-6, 4],
            [-8, 0],
            [7, -4],
            [6, 7],
            [-7, -8],
        ],
        _ => &[[0, 0]],
    };
    sixteenths.iter().map(|offset| offset.map(|step| 128 + 16 * step)).collect()
}

impl Known {
    fn new(heap: &Heap, draw: usize, index: usize) -> Option<Self> {
        let Flat { points, depths } = heap.triangles[index];
        let vertices = [0, 1, 2].map(|corner| {
            let [x, y] = points[corner].map(Fixed::from_raw);
            ScreenVertex::new(FixedPoint::new(x, y), depths[corner], 1.0)
        });
        let area = doubled_area(points);
        let light = heap.light + index as u32;
        let is_masked = matches!(heap.blend_mode, BlendMode::Masked | BlendMode::MaskedPerSample);
        let faces = match heap.culling {
            Culling::None => true,
            // Counter-clockwise as seen, where y points down.
            Culling::Back => area < 0,
            Culling::Front => area >= 0,
        };
        let exists = faces && area != 0 && !(is_masked && light.is_multiple_of(3));
        exists.then(|| Self {
            points,
            depth: DepthPlane::of(&SetupTriangle::whole(vertices, 0)),
            key: (heap.object, heap.faces.get(index).map_or(index as u32, |&face| face), index, draw),
            light: light as f32,
            is_layer: heap.blend_mode == BlendMode::Translucent,
        })
    }

    /// The depth at a point, if it covers that.
    fn at(&self, point: [i32; 2]) -> Option<f32> {
        covers(self.points, point).then(|| self.depth.at(point))
    }

    fn is_before(&self, depth: f32, (other, there): (Option<&Self>, f32)) -> bool {
        depth > there || (depth == there && other.is_some_and(|other| self.key < other.key))
    }
}

/// The depth of what is seen at a point, and all light from there.
fn search(known: &[Known], point: [i32; 2]) -> (Option<f32>, f32) {
    let covering = |layers: bool| {
        let of_kind = known.iter().filter(move |triangle| triangle.is_layer == layers);
        of_kind.filter_map(|triangle| Some((triangle, triangle.at(point)?)))
    };
    let seen = covering(false).fold((None, BEHIND_ALL), |seen, (triangle, depth)| {
        if triangle.is_before(depth, seen) { (Some(triangle), depth) } else { seen }
    });
    let layers = covering(true).filter(|(triangle, depth)| triangle.is_before(*depth, seen));
    let light: f32 = layers.map(|(triangle, _)| triangle.light).sum();
    (seen.0.map(|_| seen.1), light + seen.0.map_or(0.0, |triangle| triangle.light))
}

/// All corners within some distance from a place in the image or beside it; on whole
/// multiples of some steps.
fn flat(reach: [i32; 2], steps: i32) -> impl Strategy<Value = Flat> {
    let middle = SIZE.map(|side| -2000..side * 256 + 2000);
    let corner = || reach.map(|reach| -reach..=reach);
    // Many are equal.
    let depth =
        || prop_oneof![2 => (0..=8_u8).prop_map(|eighths| f32::from(eighths) / 8.0), 1 => 0.0_f32..=1.0];
    let depths = prop_oneof![depth().prop_map(|depth| [depth; 3]), [depth(), depth(), depth()]];
    (middle, [corner(), corner(), corner()], depths).prop_map(move |(middle, corners, depths)| {
        let on_steps = |axis: usize, way: i32| (middle[axis] + way) / steps * steps;
        let points = corners.map(|[x, y]| [on_steps(0, x), on_steps(1, y)]);
        Flat { points, depths }
    })
}

/// Runs of triangles from less than a pixel to far more than the image, half of them with
/// corners on samples.
fn flats() -> impl Strategy<Value = Vec<Flat>> {
    let reach = || prop::sample::select(vec![300, 600, 2500, 7000, 30_000, 1 << 18]);
    let alike = reach().prop_map(|reach| [reach; 2]);
    let reach = prop_oneof![3 => alike, 1 => [reach(), reach()]];
    let steps = prop_oneof![Just(1), Just(128)];
    let run = (reach, steps).prop_flat_map(|(reach, steps)| prop::collection::vec(flat(reach, steps), 1..12));
    prop::collection::vec(run, 1..5).prop_map(|runs| runs.concat())
}

/// Two draws of opaque triangles, one of masked ones, one of layers: in the order of their
/// keys or in none.
fn heaps() -> impl Strategy<Value = Vec<Heap>> {
    let masked = prop_oneof![Just(BlendMode::Masked), Just(BlendMode::MaskedPerSample)];
    let faces = prop::option::of(prop::collection::vec(0..4_u32, 64));
    let culling = prop::sample::select(vec![Culling::None, Culling::None, Culling::Back, Culling::Front]);
    let draws = ([flats(), flats(), flats(), flats()], prop::array::uniform4(culling));
    (draws, masked, faces).prop_map(|((flats, culling), masked, faces)| {
        let surfaces = [BlendMode::Opaque, BlendMode::Opaque, masked, BlendMode::Translucent];
        let objects = if faces.is_some() { [1, 0, 1, 1] } else { [0, 1, 2, 1] };
        let mut light = 1;
        let heap = |(draw, triangles): (usize, Vec<Flat>)| {
            let first = light;
            light += triangles.len() as u32;
            let faces =
                faces.iter().map(|faces| faces[..triangles.len()].to_vec()).next().unwrap_or_default();
            let (object, blend_mode, culling) = (objects[draw], surfaces[draw], culling[draw]);
            Heap { object, blend_mode, culling, faces, triangles, light: first }
        };
        flats.into_iter().enumerate().map(heap).collect()
    })
}

fn settings() -> impl Strategy<Value = ExecuteSettings> {
    let levels: Vec<_> = SimdLevel::ALL.into_iter().filter(|level| level.is_supported()).collect();
    let tiles = vec![TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64];
    let tests = vec![DepthTest::Hierarchical, DepthTest::Hierarchical, DepthTest::Late];
    use prop::sample::select;
    (select(levels), select(tiles), select(tests)).prop_map(|(level, tile_size, depth_test)| {
        ExecuteSettings {
            threads: NonZeroUsize::new(1),
            simd: Some(level),
            tile_size,
            depth_test,
            timed: true,
        }
    })
}

/// A frame of the heaps.
fn draw(heaps: &[Heap], settings: ExecuteSettings, samples: u32) -> (Target<'static>, Stats) {
    let corners =
        |heap: &Heap| (0..heap.triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let indices: Vec<Vec<_>> = heaps.iter().map(corners).collect();
    let mut pass = Pass::new();
    for (heap, indices) in heaps.iter().zip(&indices) {
        let faces = (!heap.faces.is_empty()).then_some(&heap.faces[..]);
        let draw =
            Draw { object: heap.object, blend_mode: heap.blend_mode, faces, ..Draw::new(heap, indices) };
        pass.triangles(Draw { culling: heap.culling, ..draw }).bounds(heap.bounds());
    }
    let [width, height] = SIZE.map(|side| side as u32);
    let target = Target::new(width, height, &[Output::Linear, Output::Depth]).unwrap();
    let mut target = target.with_samples(samples).unwrap();
    let stats = Rasterizer::new(settings).unwrap().draw(&pass, &mut target);
    (target, stats)
}

/// Holds every pixel of a frame of the heaps against the search.
fn check(heaps: &[Heap], settings: ExecuteSettings, samples: u32) {
    let (target, stats) = draw(heaps, settings, samples);
    let (linear, depth) = (target.linear().unwrap(), target.depth().unwrap());

    let of_heap = |(draw, heap): (usize, &Heap)| {
        (0..heap.triangles.len()).filter_map(|index| Known::new(heap, draw, index)).collect::<Vec<_>>()
    };
    let known: Vec<_> = heaps.iter().enumerate().flat_map(of_heap).collect();
    let offsets = sample_offsets(samples);
    let mut seen = 0;
    for (index, (shown, depth)) in linear.iter().zip(depth).enumerate() {
        let pixel = [index as i32 % SIZE[0], index as i32 / SIZE[0]];
        let at = |offset: &[i32; 2]| search(&known, [0, 1].map(|axis| pixel[axis] * 256 + offset[axis]));
        let found: Vec<_> = offsets.iter().map(at).collect();
        // Whole numbers and their sixteenths: no sum rounds.
        let light = found.iter().map(|(_, light)| light).sum::<f32>() / samples as f32;
        assert_eq!(shown.x, light, "the light of pixel {pixel:?}");
        assert_eq!(*depth, found[0].0.unwrap_or(0.0), "the depth of pixel {pixel:?}");
        seen += found.iter().filter(|(depth, _)| depth.is_some()).count() as u64;
    }
    assert_eq!(stats.samples_visible, seen, "samples of the image that see a triangle");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 8, ..ProptestConfig::default() })]

    #[test]
    fn every_sample_shows_what_a_search_finds(
        heaps in heaps(),
        settings in settings(),
        samples in prop_oneof![2 => Just(1_u32), 1 => Just(2), 1 => Just(4), 1 => Just(16)],
    ) {
        check(&heaps, settings, samples);
    }
}

fn heap(object: u32, light: u32, triangles: &[[[i32; 2]; 3]]) -> Heap {
    let triangles = triangles.iter().map(|&points| Flat { points, depths: [0.875; 3] }).collect();
    let (blend_mode, culling) = (BlendMode::Opaque, Culling::None);
    Heap { object, blend_mode, culling, triangles, faces: Vec::new(), light }
}

fn timed() -> ExecuteSettings {
    ExecuteSettings { timed: true, ..ExecuteSettings::default() }
}

/// Of eight triangles that are set up together, small ones once came before large ones, and
/// were seen where both are equally deep.
#[test]
fn a_large_triangle_is_seen_before_a_later_small_one_of_its_depth() {
    let large = [[25456, 1936], [6150, 1936], [6150, 6865]];
    let small = [[7297, 2834], [7363, 2834], [7458, 2967]];
    check(&[heap(0, 1, &[large, small])], timed(), 4);
}

/// What lies at the depth of all of a tile is neither hidden by that nor hides it: keys decide.
#[test]
fn keys_decide_where_a_tile_is_as_deep_as_a_triangle() {
    for side in [700, 3000, 9000, 40_000, 200_000] {
        let triangles = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
            let [x, y] = [800 * i - side / 8, 900 * i - side / 8];
            [[x, y], [x + side, y], [x, y + side]]
        });
        // Descending, so that the order of the triangles is not that of the keys.
        for (face, faces) in [(8, [7, 6, 5, 4, 3, 2, 1, 0]), (0, [8, 7, 6, 5, 4, 3, 2, 1])] {
            let all = Heap { faces: vec![face], ..heap(0, 1, &[ALL]) };
            let others = Heap { faces: faces.to_vec(), ..heap(0, 2, &triangles) };
            for samples in [1, 4] {
                check(&[all.clone(), others.clone()], timed(), samples);
            }
        }
    }
}
