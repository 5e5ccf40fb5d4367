//! Explained pixels against drawn ones: visible triangle, depth and colour to the bit, and
//! edge values against exact integers.

use crate::coverage_support::{Samples, rasterizer};
use crate::effort::cases;
use crate::programs::{Scalar, Vertices};
use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{
    Background, BlendMode, Culling, Draw, ExecuteSettings, FragmentExplanation, Lines, Output, Pass,
    PixelExplanation, PointShape, Points, PrimitiveKind, Verdict,
};

const SIZE: [u32; 2] = [23, 17];

/// Vertices, and the surfaces that are drawn with them. Depths are few, so that
/// many are equal.
#[derive(Debug)]
struct Scene {
    vertices: Vertices,
    surfaces: Vec<BlendMode>,
}

fn scene() -> impl Strategy<Value = Scene> {
    let w = prop_oneof![3 => Just(1.0_f32), 1 => -0.3_f32..3.0];
    let depth = prop_oneof![3 => (0..4_u8).prop_map(|step| f32::from(step) / 4.0), 1 => -0.1_f32..1.1];
    let position =
        (-1.5_f32..1.5, -1.5_f32..1.5, depth, w).prop_map(|(x, y, z, w)| Vec4::new(x * w, y * w, z * w, w));
    let color = (0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0, 0.2_f32..1.0).prop_map(Vec4::from);
    let surface = prop_oneof![2 => Just(BlendMode::Opaque), 1 => Just(BlendMode::Masked), 1 => Just(BlendMode::Translucent)];
    let list = proptest::collection::vec((position, color), 3..9);
    (list, proptest::collection::vec(surface, 1..4)).prop_map(|(list, surfaces)| {
        let mut vertices = Vertices::default();
        for (position, color) in list {
            vertices.push(position, color);
        }
        Scene { vertices, surfaces }
    })
}

/// Calls `check` with the scene's pass; the same triangles again for each
/// surface, so that equal depths of different objects are many.
fn with_pass(scene: &Scene, check: impl FnOnce(&Pass<'_>)) {
    let pipeline = Scalar(&scene.vertices);
    let count = scene.vertices.len() as u32;
    let triangles: Vec<_> = (0..count).map(|i| [i, (i + 1) % count, (i + 3) % count]).collect();
    let faces: Vec<_> = (0..count).map(|i| i / 2).collect();
    let segments: Vec<_> = (1..count).map(|i| [i - 1, i]).collect();
    let points: Vec<_> = (0..count).collect();
    let mut pass = Pass::new();
    pass.background(Background::Color(Vec4::new(0.1, 0.2, 0.3, 0.5)));
    for (i, &surface) in scene.surfaces.iter().enumerate() {
        let object = 7 - i as u32;
        let draw =
            Draw { object, blend_mode: surface, faces: Some(&faces), ..Draw::new(&pipeline, &triangles) };
        pass.triangles(Draw { culling: Culling::None, ..draw });
        pass.lines(Lines { object, blend_mode: surface, width: 1.5, ..Lines::new(&pipeline, &segments) });
        let shape = if i == 0 { PointShape::Round } else { PointShape::Square };
        pass.points(Points { object, blend_mode: surface, shape, ..Points::new(&pipeline, &points, 4.0) });
    }
    check(&pass);
}

fn bits(color: Vec4) -> [u32; 4] {
    color.to_array().map(f32::to_bits)
}

/// Twice the signed area of a triangle.
fn doubled_area([a, b, c]: [[i32; 2]; 3]) -> i128 {
    let [[ux, uy], [vx, vy]] =
        [b, c].map(|point| [0, 1].map(|axis| i128::from(point[axis]) - i128::from(a[axis])));
    ux * vy - uy * vx
}

/// Edge values, whether they cover, and whose boundary is whose: by the corners
/// that are told.
fn check_edges(fragment: &FragmentExplanation, position: [i32; 2]) {
    let corners = fragment.vertices;
    let sign = doubled_area(corners).signum();
    for (i, edge) in fragment.edges.iter().enumerate() {
        let (from, to) = (corners[i], corners[(i + 1) % 3]);
        let exact = sign * doubled_area([from, to, position]);
        assert_eq!(i128::from(edge.value), exact, "edge {i} of {corners:?} at {position:?}");
        // With the triangle on its right: a left edge goes up, a top edge right.
        let [dx, dy] = [0, 1].map(|axis| (to[axis] - from[axis]) * sign as i32);
        let owns = dy < 0 || (dy == 0 && dx > 0);
        assert_eq!(edge.owns_boundary, owns, "edge {i} of {corners:?}");
    }
    let inside = fragment.edges.iter().all(|edge| edge.is_inside());
    if fragment.kind == PrimitiveKind::RoundPoint {
        assert!(inside || !fragment.is_covered, "a disc lies in its square");
    } else {
        assert_eq!(fragment.is_covered, inside, "{fragment}");
    }
}

/// Whether verdict, margin and what is told besides belong together.
fn check_verdict(fragment: &FragmentExplanation) {
    let margin = fragment.margin;
    let agrees = match fragment.verdict {
        Verdict::Visible => margin.is_none_or(|margin| margin >= 0) && fragment.color.is_some(),
        Verdict::Hidden => margin.is_some_and(|margin| margin < 0),
        Verdict::EqualDepth => margin == Some(0),
        Verdict::Layer(_) => margin.is_none_or(|margin| margin >= 0) && fragment.color.is_some(),
        Verdict::LeftToJoint => fragment.kind == PrimitiveKind::Line,
        Verdict::MaskedAway => fragment.blend_mode == BlendMode::Masked,
        Verdict::BehindFarPlane => fragment.depth.is_some_and(|depth| depth < 0.0),
        Verdict::OutsideEdge(edge) => !fragment.edges[edge].is_inside(),
        Verdict::OutsideDisc => fragment.kind == PrimitiveKind::RoundPoint,
    };
    assert!(agrees, "{fragment}");
}

fn check_pixel(pixel: &PixelExplanation) {
    for sample in &pixel.samples {
        let layers: Vec<_> = sample.layers().map(|layer| (layer.verdict, layer.depth)).collect();
        for (number, layer) in layers.iter().enumerate() {
            assert_eq!(layer.0, Verdict::Layer(number), "layers are told from the back: {sample}");
        }
        assert!(layers.is_sorted_by_key(|layer| layer.1), "the nearest last: {sample}");
        for fragment in &sample.fragments {
            check_edges(fragment, sample.position);
            check_verdict(fragment);
        }
    }
    assert!(pixel.to_string().lines().count() > pixel.samples.len(), "there is something to read");
}

proptest! {
    #![proptest_config(cases(10))]

    #[test]
    fn an_explanation_ends_at_what_is_drawn(scene in scene(), samples in Samples::any()) {
        with_pass(&scene, |pass| {
            let outputs = [Output::Linear, Output::Depth, Output::Object, Output::Face, Output::Triangle];
            let mut target = samples.target(SIZE, &outputs);
            let mut rasterizer = rasterizer(&ExecuteSettings::default());
            rasterizer.draw(pass, &mut target);
            for index in 0..(SIZE[0] * SIZE[1]) as usize {
                let [x, y] = [index as u32 % SIZE[0], index as u32 / SIZE[0]];
                let pixel = rasterizer.explain_pixel(pass, &target, x, y).expect("inside of the target");
                check_pixel(&pixel);
                let visible = pixel.reported().visible();
                let told = visible.map_or([u32::MAX; 3], |w| [w.object, w.face, w.primitive]);
                let planes = [target.objects(), target.faces(), target.triangles()];
                let drawn = planes.map(|plane| plane.expect("asked for")[index]);
                assert_eq!(told, drawn, "{pixel}");
                let depth = visible.and_then(|visible| visible.depth).unwrap_or(0.0);
                let drawn = target.depth().expect("asked for")[index];
                assert_eq!(depth.max(0.0).to_bits(), drawn.to_bits(), "{pixel}");
                let drawn = target.linear().expect("asked for")[index];
                assert_eq!(bits(pixel.color), bits(drawn), "{drawn} is drawn: {pixel}");
            }
        });
    }
}

/// A quad of two triangles, one behind it, and one beside the pixel.
#[test]
fn an_explanation_can_be_read() {
    let mut vertices = Vertices::default();
    for [x, y, z] in
        [[-1.0, -1.0, 0.5], [1.0, -1.0, 0.5], [1.0, 1.0, 0.5], [-1.0, 1.0, 0.5], [0.0, 0.9, 0.25]]
    {
        vertices.push(Vec4::new(x, y, z, 1.0), Vec4::ONE);
    }
    let pipeline = Scalar(&vertices);
    let mut pass = Pass::new();
    pass.triangles(Draw::new(&pipeline, &[[0, 1, 2], [0, 2, 3]]));
    pass.triangles(Draw { object: 1, culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 4]]) });
    let target = Samples::ONE.target([8, 8], &[]);
    let mut rasterizer = rasterizer(&ExecuteSettings::default());
    let pixel = rasterizer.explain_pixel(&pass, &target, 4, 6).expect("inside of the target");
    let expected = "\
pixel (4, 6): linear colour [1, 1, 1, 1]
 sample 0 at (4.5, 6.5): object 0, face 0
  triangle 0 of draw 0 (object 0, face 0): visible; nearer than the next by 1655306 ulp
    edges 786432 (> 0), 1835008 (> 0), 1572864 (≥ 0); depth 0.5
  triangle 0 of draw 1 (object 1, face 0): hidden by 1655306 ulp
    edges 786432 (> 0), 1350400 (> 0), 1848576 (≥ 0); depth 0.45066804
  triangle 1 of draw 0 (object 0, face 1): misses the sample: outside of edge 0 by 2.1213 pixel
    edges -1572864 (> 0), 3407872 (≥ 0), 2359296 (≥ 0)
";
    assert_eq!(pixel.to_string(), expected, "as it is printed");
    assert!(rasterizer.explain_pixel(&pass, &target, 8, 0).is_none(), "beside the target");
    assert!(rasterizer.explain_pixel(&pass, &target, 0, 8).is_none(), "below the target");
}
