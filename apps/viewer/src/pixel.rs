//! Why a pixel looks as it does: which triangles touch it, their exact edge values and depths, which of them is
//! seen, and why. `--explain-pixel` writes it, and a panel of the window shows it.

use serde_json::{Value, json};
use trigon_camera::Camera;
use trigon_scene::{
    FragmentExplanation, PixelExplanation, PrimitiveKind, Renderer, SampleExplanation, Scene, Verdict,
};

use crate::args::Request;
use crate::failure::Failure;
use crate::loading;
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::{json_line, print_lines};

/// `--explain-pixel`: explains a pixel of every source's image; returns the worst exit code.
pub(crate) fn run(request: &Request, at: [u32; 2], reporter: Reporter) -> u8 {
    let mut unwritten = 0;
    let code = Source::visit_all(request, reporter, |source, request| {
        let mut model = loading::load_aloud(source, request, reporter)?;
        let camera = model.shot_with_scenery(request)?.camera;
        let mut renderer = Renderer::new(request.settings.clone());
        let explained = explained(&mut renderer, &model.scene, &camera, at)?;
        let written = if request.json {
            json_line(&explained.to_json(&model.scene), reporter)
        } else {
            let lines = explained.lines(&model.scene).into_iter().map(|line| line.indented());
            print_lines(std::iter::once(source.title()).chain(lines), reporter)
        };
        unwritten = unwritten.max(written);
        Ok(())
    });
    code.max(unwritten)
}

/// A pixel with its explanation.
pub(crate) struct ExplainedPixel(PixelExplanation);

/// Explains a pixel of the image that a renderer draws.
///
/// # Errors
/// When it lies outside of the image, or that cannot be drawn.
pub(crate) fn explained(
    renderer: &mut Renderer,
    scene: &Scene,
    camera: &Camera,
    [x, y]: [u32; 2],
) -> Result<ExplainedPixel, Failure> {
    let pixel = renderer.explain_pixel(scene, camera, x, y).map_err(Failure::work)?;
    let settings = renderer.settings();
    let outside = || {
        Failure::Usage(format!(
            "the pixel {x},{y} lies outside of the image, which has {}x{} pixels, counted from 0",
            settings.width, settings.height
        ))
    };
    pixel.map(ExplainedPixel).ok_or_else(outside)
}

/// A line of an explanation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ExplanationLine {
    /// How far it is moved to the right.
    pub(crate) indent: u8,
    /// Whether lines below it belong to it.
    pub(crate) is_heading: bool,
    pub(crate) text: String,
}

impl ExplanationLine {
    fn indented(&self) -> String {
        format!("{:1$}{2}", "", 2 * usize::from(self.indent) + 2, self.text)
    }
}

impl ExplainedPixel {
    /// For people: the sample that the pixel's depth and ids come from, and then all others.
    pub(crate) fn lines(&self, scene: &Scene) -> Vec<ExplanationLine> {
        let pixel = &self.0;
        let [r, g, b, a] = pixel.color.to_array();
        let [x, y] = pixel.pixel;
        let mut lines = Vec::new();
        let mut push = |indent, is_heading, text| lines.push(ExplanationLine { indent, is_heading, text });
        push(0, true, format!("pixel {x}, {y}"));
        push(0, false, format!("linear colour {r:.4} {g:.4} {b:.4}, alpha {a:.4}"));
        let is_one = pixel.samples.len() == 1;
        let others = (0..pixel.samples.len()).filter(|&index| index != pixel.reported);
        for index in std::iter::once(pixel.reported).chain(others) {
            let sample = &pixel.samples[index];
            let source = if is_one || index != pixel.reported { "" } else { "; ids and depth are its" };
            push(
                0,
                true,
                format!(
                    "sample {} at {}: {}{source}",
                    index + 1,
                    position_of(sample),
                    visible_surface(sample, scene)
                ),
            );
            for fragment in &sample.fragments {
                push(1, true, format!("{}: {}", owner(fragment, scene), verdict(fragment)));
                push(2, false, edges(fragment));
                if let Some(depth) = fragment.depth {
                    push(2, false, format!("depth {depth} (1 is near, 0 is far){}", margin(fragment)));
                }
            }
        }
        lines
    }

    /// For programs.
    pub(crate) fn to_json(&self, scene: &Scene) -> Value {
        let pixel = &self.0;
        json!({
            "pixel": pixel.pixel,
            "color": pixel.color.to_array(),
            "reported": pixel.reported,
            "samples": pixel.samples.iter().map(|sample| sample_json(sample, scene)).collect::<Vec<_>>(),
        })
    }
}

fn sample_json(sample: &SampleExplanation, scene: &Scene) -> Value {
    json!({
        "cell": sample.cell,
        "number": sample.number,
        "position": sample.position.map(|at| f64::from(at) / 256.0),
        "color": sample.color.to_array(),
        "fragments": sample.fragments.iter().map(|it| fragment_json(it, scene)).collect::<Vec<_>>(),
    })
}

fn fragment_json(fragment: &FragmentExplanation, scene: &Scene) -> Value {
    let edge = |index: usize| {
        let edge = &fragment.edges[index];
        json!({"value": edge.value, "owns_boundary": edge.owns_boundary, "distance": edge.distance})
    };
    json!({
        "node": node_name(fragment, scene),
        "object": fragment.object,
        "face": fragment.face,
        "kind": kind(fragment.kind),
        "primitive": fragment.primitive,
        "cut": fragment.is_cut,
        "front_facing": fragment.front_facing,
        "vertices": fragment.vertices.map(|[x, y]| [f64::from(x) / 256.0, f64::from(y) / 256.0]),
        "edges": [edge(0), edge(1), edge(2)],
        "covered": fragment.is_covered,
        "depth": fragment.depth,
        "margin": fragment.margin,
        "color": fragment.color.map(|color| color.to_array()),
        "visible": fragment.verdict == Verdict::Visible,
        "verdict": verdict(fragment),
    })
}

/// "0.5, 0.5"
fn position_of(sample: &SampleExplanation) -> String {
    let [x, y] = sample.position.map(|at| f64::from(at) / 256.0);
    format!("{x}, {y}")
}

fn visible_surface(sample: &SampleExplanation, scene: &Scene) -> String {
    let below = sample.visible().map_or("the background".to_owned(), |visible| node_name(visible, scene));
    match sample.layers().count() {
        0 => below,
        1 => format!("{below} under 1 layer"),
        layers => format!("{below} under {layers} layers"),
    }
}

fn node_name(fragment: &FragmentExplanation, scene: &Scene) -> String {
    let node = scene.nodes().id_at(fragment.object as usize).and_then(|id| scene.node(id));
    match node.map(|node| node.name.as_str()) {
        Some(name) if !name.is_empty() => name.to_owned(),
        _ => format!("node {}", fragment.object),
    }
}

/// "teapot, face 7, triangle 12"
fn owner(fragment: &FragmentExplanation, scene: &Scene) -> String {
    let name = node_name(fragment, scene);
    let face = if fragment.face == u32::MAX { String::new() } else { format!(", face {}", fragment.face) };
    let cut = if fragment.is_cut { " (cut)" } else { "" };
    format!("{name}{face}, {} {}{cut}", kind(fragment.kind), fragment.primitive)
}

fn kind(kind: PrimitiveKind) -> &'static str {
    match kind {
        PrimitiveKind::Triangle => "triangle",
        PrimitiveKind::Line => "line",
        PrimitiveKind::SquarePoint => "square point",
        PrimitiveKind::RoundPoint => "round point",
    }
}

fn verdict(fragment: &FragmentExplanation) -> String {
    match fragment.verdict {
        Verdict::Visible => match fragment.margin {
            None => "visible; nothing else is here".to_owned(),
            Some(0) => "visible; as near as the next, with the smaller (object, face)".to_owned(),
            Some(_) => "visible, because it is the nearest".to_owned(),
        },
        Verdict::Hidden => "hidden by the visible triangle, which is nearer".to_owned(),
        Verdict::EqualDepth => {
            "as near as the visible triangle, which has the smaller (object, face)".to_owned()
        }
        Verdict::BehindFarPlane => "behind the far plane".to_owned(),
        Verdict::MaskedAway => "its alpha mask has a hole here".to_owned(),
        Verdict::Layer(number) => format!("translucent: layer {} from the back", number + 1),
        Verdict::LeftToJoint => "drawn by the next segment of the line".to_owned(),
        Verdict::OutsideEdge(edge) => {
            let distance = -fragment.edges[edge].distance;
            format!("misses the sample by {distance:.4} pixel, outside of edge {}", edge + 1)
        }
        Verdict::OutsideDisc => "misses the sample, outside of its disc".to_owned(),
    }
}

/// "edges 512, 90 and 3, all inside"
fn edges(fragment: &FragmentExplanation) -> String {
    let [a, b, c] = fragment
        .edges
        .map(|edge| format!("{} ({})", edge.value, if edge.is_inside() { "in" } else { "out" }));
    format!("edge values {a}, {b}, {c}")
}

fn margin(fragment: &FragmentExplanation) -> String {
    match fragment.margin {
        None | Some(0) => String::new(),
        Some(margin) if fragment.verdict == Verdict::Visible => format!(", {margin} ulp before the next"),
        Some(margin) if margin > 0 => format!(", {margin} ulp before what is seen"),
        Some(margin) => format!(", {} ulp behind what is seen", -margin),
    }
}
