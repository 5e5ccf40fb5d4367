//! Certified pixels: whatever is off within the bounds, they stay as they are. And
//! of ordinary images most pixels are certified.

use crate::coverage_support::{Samples, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::{SplitMix64, Vec2, Vec3, Vec4, elementary};
use trigon_math::{look_at_mat4, perspective_infinite_reverse};
use trigon_raster::{
    Background, BlendMode, Certainty, Certificate, Culling, Draw, ExecuteSettings, Fragment, Lines, Output,
    Pass, Pipeline, PointShape, Points, TargetImages, Tolerance, VertexOutput,
};

const SIZE: [u32; 2] = [32, 24];

/// The near plane of vertices of which some lie behind it.
const NEAR: f32 = 0.125;

/// Vertices, a colour for each face, and how masks answer.
#[derive(Clone, Debug)]
struct Shapes {
    vertices: Vec<Vec4>,
    colors: Vec<Vec4>,
    masks: u32,
}

impl Pipeline for Shapes {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.vertices[index], varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let color = self.colors[fragment.face as usize % self.colors.len()];
        // Not the same all over the pixel.
        let is_centre = fragment.position.fract() == Vec2::splat(0.5);
        if is_centre { color } else { color * 0.5 }
    }

    fn mask(&self, fragment: &Fragment<()>) -> bool {
        let pixel = fragment.pixel.x * 7 + fragment.pixel.y * 13 + fragment.face;
        (pixel.wrapping_mul(self.masks) >> 7) & 1 == 0
    }
}

/// What is drawn with the shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Triangles(Culling),
    Lines,
    Points(PointShape),
}

#[derive(Clone, Debug)]
struct Scene {
    shapes: Shapes,
    draws: Vec<(Kind, BlendMode)>,
    /// Whether vertices lie on both sides of the near plane.
    is_cut: bool,
}

fn depth() -> impl Strategy<Value = f32> {
    prop_oneof![6 => 0.0_f32..1.0, 1 => Just(0.5_f32), 1 => Just(1.0_f32), 1 => -0.1_f32..0.0]
}

/// In front of the eye, at depths that w does not round.
fn whole_vertex() -> impl Strategy<Value = Vec4> {
    (-1.3_f32..1.3, -1.3_f32..1.3, depth(), prop_oneof![Just(0.5_f32), Just(1.0), Just(4.0)])
        .prop_map(|(x, y, z, w)| Vec4::new(x * w, y * w, z * w, w))
}

/// Anywhere around the eye, the near plane at [`NEAR`].
fn any_vertex() -> impl Strategy<Value = Vec4> {
    (-2.0_f32..2.0, -2.0_f32..2.0, -1.0_f32..3.0).prop_map(|(x, y, w)| Vec4::new(x, y, NEAR, w))
}

fn color() -> impl Strategy<Value = Vec4> {
    (0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0, prop_oneof![Just(1.0_f32), 0.2_f32..1.0])
        .prop_map(|(r, g, b, a)| Vec4::new(r * a, g * a, b * a, a))
}

fn kind() -> impl Strategy<Value = Kind> {
    prop_oneof![
        4 => Just(Kind::Triangles(Culling::None)),
        2 => Just(Kind::Triangles(Culling::Back)),
        1 => Just(Kind::Triangles(Culling::Front)),
        1 => Just(Kind::Lines),
        1 => Just(Kind::Points(PointShape::Round)),
        1 => Just(Kind::Points(PointShape::Square)),
    ]
}

fn surface() -> impl Strategy<Value = BlendMode> {
    prop_oneof![4 => Just(BlendMode::Opaque), 1 => Just(BlendMode::Masked), 2 => Just(BlendMode::Translucent)]
}

fn scene() -> impl Strategy<Value = Scene> {
    let vertices = prop_oneof![
        2 => proptest::collection::vec(whole_vertex(), 3..8).prop_map(|list| (list, false)),
        1 => proptest::collection::vec(any_vertex(), 3..6).prop_map(|list| (list, true)),
    ];
    let draws = proptest::collection::vec((kind(), surface()), 1..3);
    (vertices, proptest::collection::vec(color(), 1..8), draws).prop_map(
        |((vertices, is_cut), colors, draws)| Scene {
            shapes: Shapes { vertices, colors, masks: 1 },
            draws,
            is_cut,
        },
    )
}

/// Numbers from -1 to 1, or only those two.
struct Noise {
    random: SplitMix64,
    extreme: bool,
}

impl Noise {
    fn next(&mut self) -> f32 {
        let number = self.random.between(-1.0, 1.0) as f32;
        if self.extreme { number.signum() } else { number }
    }
}

/// The bounds, and a scene that is off within them.
fn moved(scene: &Scene, tolerance: Tolerance, noise: &mut Noise) -> Scene {
    let mut moved = scene.clone();
    // Room for the rounding of the sums below.
    let reach = [0, 1].map(|axis| 0.99 * tolerance.position() as f32 * 2.0 / SIZE[axis] as f32);
    for vertex in &mut moved.shapes.vertices {
        // What is cut lies at w >= NEAR then, and is off by no more than this.
        let w = if scene.is_cut { NEAR } else { vertex.w };
        vertex.x += reach[0] * w * noise.next();
        vertex.y += reach[1] * w * noise.next();
        if !scene.is_cut {
            let steps = (tolerance.depth_ulps() as f32 * noise.next()).round() as i32;
            let depth = vertex.z / vertex.w;
            let step = |depth: f32, _| if steps < 0 { depth.next_down() } else { depth.next_up() };
            vertex.z = (0..steps.abs()).fold(depth, step) * vertex.w;
        }
    }
    // Every layer may add its share, and what shows through it.
    let is_blended = scene.draws.iter().any(|&(_, surface)| surface == BlendMode::Translucent);
    let layers = if is_blended { 8 * scene.draws.len() } else { 0 };
    for color in &mut moved.shapes.colors {
        let most = 0.9 * tolerance.color() / (1 + 2 * layers) as f32;
        *color += most * Vec4::from_array([(); 4].map(|()| noise.next()));
    }
    moved.shapes.masks = (noise.random.next_u64() >> 33) as u32 | 1;
    moved
}

fn with_pass<T>(scene: &Scene, act: impl FnOnce(&Pass<'_>) -> T) -> T {
    let count = scene.shapes.vertices.len() as u32;
    let triangles: Vec<_> = (0..count).map(|i| [i, (i + 1) % count, (i + 2) % count]).collect();
    let segments: Vec<_> = (1..count).map(|i| [i - 1, i]).collect();
    let points: Vec<_> = (0..count).collect();
    let pipeline = &scene.shapes;
    let mut pass = Pass::new();
    pass.background(Background::Color(Vec4::new(0.2, 0.3, 0.4, 1.0)));
    for (object, &(kind, surface)) in scene.draws.iter().enumerate() {
        let object = object as u32;
        match kind {
            Kind::Triangles(culling) => pass.triangles(Draw {
                object,
                blend_mode: surface,
                culling,
                ..Draw::new(pipeline, &triangles)
            }),
            Kind::Lines => pass.lines(Lines {
                object,
                blend_mode: surface,
                width: 2.3,
                ..Lines::new(pipeline, &segments)
            }),
            Kind::Points(shape) => pass.points(Points {
                object,
                blend_mode: surface,
                shape,
                ..Points::new(pipeline, &points, 7.0)
            }),
        };
    }
    act(&pass)
}

const OUTPUTS: [Output; 5] = [Output::Srgb8, Output::Unorm8, Output::Object, Output::Face, Output::Triangle];

fn draw(scene: &Scene, samples: Samples) -> TargetImages {
    with_pass(scene, |pass| {
        let mut target = samples.target(SIZE, &OUTPUTS);
        rasterizer(&ExecuteSettings::default()).draw(pass, &mut target);
        target.into_images()
    })
}

fn certify(pass: &Pass<'_>, samples: Samples, size: [u32; 2], tolerance: Tolerance) -> Certificate {
    let target = samples.target(size, &OUTPUTS);
    rasterizer(&ExecuteSettings::default()).certify(pass, &target, tolerance).expect("there is memory")
}

fn tolerance() -> impl Strategy<Value = Tolerance> {
    let position = prop_oneof![Just(1.0 / 512.0), Just(0.0), 0.0_f64..0.3];
    (position, 0..40_u32, 0.0_f32..0.002)
        .prop_map(|(position, ulps, color)| Tolerance::new(position, ulps, color).expect("in range"))
}

fn ids(images: &TargetImages, index: usize) -> [u32; 3] {
    let planes = [&images.objects, &images.faces, &images.triangles];
    planes.map(|plane| plane.as_ref().expect("asked for")[index])
}

fn bytes(images: &TargetImages, index: usize) -> [[u8; 4]; 2] {
    [&images.srgb8, &images.unorm8].map(|plane| plane.as_ref().expect("asked for")[index])
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn certified_pixels_stay_as_they_are(
        scene in scene(),
        tolerance in tolerance(),
        samples in Samples::any(),
        seed in any::<u64>(),
    ) {
        let certificate = with_pass(&scene, |pass| certify(pass, samples, SIZE, tolerance));
        let drawn = draw(&scene, samples);
        for attempt in 0..6 {
            let mut noise = Noise { random: SplitMix64::new(seed.wrapping_add(attempt)), extreme: attempt % 2 == 0 };
            let other = draw(&moved(&scene, tolerance, &mut noise), samples);
            for (index, &certainty) in certificate.pixels().iter().enumerate() {
                if certainty == Certainty::Visibility {
                    continue;
                }
                let at = [index as u32 % SIZE[0], index as u32 / SIZE[0]];
                prop_assert_eq!(ids(&drawn, index), ids(&other, index), "ids at {:?}", at);
                if certainty == Certainty::Certified {
                    prop_assert_eq!(bytes(&drawn, index), bytes(&other, index), "bytes at {:?}", at);
                }
            }
        }
    }
}

/// Sine and cosine of parts of a turn.
fn turn(part: f32) -> [f32; 2] {
    let (sine, cosine) = elementary::sin_cos(f64::from(part) * std::f64::consts::TAU);
    [sine as f32, cosine as f32]
}

/// A torus on a ground that goes on under the eye, and a pane of glass.
fn ordinary_scene() -> (Shapes, [Vec<[u32; 3]>; 3]) {
    let eye = Vec3::new(0.5, 1.6, 3.4);
    let view = perspective_infinite_reverse(0.8, 4.0 / 3.0, 0.1) * look_at_mat4(eye, Vec3::ZERO, Vec3::Y);
    let mut vertices = Vec::new();
    let [around, along] = [32_u32, 16];
    for i in 0..around * along {
        let [[sine, cosine], [up, out]] =
            [turn((i / along) as f32 / around as f32), turn((i % along) as f32 / along as f32)];
        let radius = 1.0 + 0.4 * out;
        vertices.push(Vec3::new(radius * cosine, 0.4 * up, radius * sine));
    }
    let at = |i: u32, j: u32| (i % around) * along + j % along;
    let quads = (0..around).flat_map(|i| (0..along).map(move |j| [i, j]));
    let torus = quads.flat_map(|[i, j]| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    let torus = torus.collect();
    let quad = |vertices: &mut Vec<Vec3>, corners: [[f32; 3]; 4]| {
        let first = vertices.len() as u32;
        vertices.extend(corners.map(Vec3::from_array));
        vec![[first, first + 1, first + 2], [first, first + 2, first + 3]]
    };
    let corners = [[-50.0, -0.5, -50.0], [-50.0, -0.5, 50.0], [50.0, -0.5, 50.0], [50.0, -0.5, -50.0]];
    let ground = quad(&mut vertices, corners);
    let glass = quad(&mut vertices, [[0.2, 0.0, 1.7], [1.4, 0.0, 1.7], [1.4, 1.1, 1.7], [0.2, 1.1, 1.7]]);
    let vertices = vertices.into_iter().map(|vertex| view * vertex.extend(1.0)).collect();
    // None at a threshold of a byte, as 0.3 is: 76.5 of 255.
    let colors = vec![Vec4::new(0.31, 0.21, 0.11, 1.0), Vec4::new(0.1, 0.2, 0.21, 0.5)];
    (Shapes { vertices, colors, masks: 1 }, [torus, ground, glass])
}

#[test]
fn most_pixels_of_an_ordinary_image_are_certified() {
    let (shapes, [torus, ground, glass]) = ordinary_scene();
    let mut pass = Pass::new();
    pass.triangles(Draw { faces: Some(&[0; 1024]), ..Draw::new(&shapes, &torus) });
    pass.triangles(Draw {
        object: 1,
        culling: Culling::None,
        faces: Some(&[0; 2]),
        ..Draw::new(&shapes, &ground)
    });
    let surface = BlendMode::Translucent;
    pass.triangles(Draw {
        object: 2,
        blend_mode: surface,
        culling: Culling::None,
        faces: Some(&[1; 2]),
        ..Draw::new(&shapes, &glass)
    });
    for (samples, least) in [(1, 0.97), (4, 0.9)] {
        let samples = Samples { per_axis: 1, per_pixel: samples };
        let certificate = certify(&pass, samples, [160, 120], Tolerance::default());
        let share = certificate.count(Certainty::Certified) as f64 / f64::from(160 * 120);
        let unseen = certificate.count(Certainty::Visibility);
        assert!(share > least, "{share} of the pixels with {samples:?}, {unseen} for what they see");
        assert!(share < 1.0, "edges are not certain");
    }
}
