//! 100,000 lines and as many points against the plainest loops that draw as much. These are the algorithm of
//! Bresenham, and squares and discs pixel by pixel, each with a depth test, a depth, an id and a colour written to
//! each pixel. Anti-aliased lines and points blend two to three times as many pixels; their times, too, are for
//! each pixel of the plain loops.
//!
//! Both take turns, and the shortest times are compared, so that what else the machine does
//! matters little. A name on the command line picks the rows that contain it, `--quick` takes
//! one turn.

#![expect(clippy::print_stdout, reason = "a table of times is what it is for")]

mod one_color;

use one_color::{OneColor, SIZE, Vertex, numbers};
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};
use trigon_raster::simd::SimdLevel;
use trigon_raster::{
    ExecuteSettings, Lines, Output, Pass, PointShape, Points, Rasterizer, Smoothing, Target,
};

const COUNT: usize = 100_000;
const TURNS: usize = 15;
const COLOR: u32 = 0xff30_80c0;

/// What the plain loops draw into.
struct Plain {
    depth: Vec<f32>,
    id: Vec<u32>,
    color: Vec<u32>,
    /// How many pixels they tried.
    pixels: u64,
}

impl Plain {
    fn new() -> Self {
        let pixels = SIZE[0] * SIZE[1];
        Self { depth: vec![0.0; pixels], id: vec![0; pixels], color: vec![0; pixels], pixels: 0 }
    }

    fn clear(&mut self) {
        self.depth.fill(0.0);
        self.id.fill(u32::MAX);
        self.color.fill(0);
        self.pixels = 0;
    }

    #[inline(always)]
    fn set(&mut self, [x, y]: [i32; 2], depth: f32, id: u32) {
        if (0..SIZE[0] as i32).contains(&x) && (0..SIZE[1] as i32).contains(&y) {
            self.pixels += 1;
            let at = y as usize * SIZE[0] + x as usize;
            if depth > self.depth[at] {
                (self.depth[at], self.id[at], self.color[at]) = (depth, id, COLOR);
            }
        }
    }

    /// J. E. Bresenham, 1965; `width` pixels across the minor axis in each step.
    fn line(&mut self, ends: [Vertex; 2], width: i32, id: u32) {
        let [from, to] = ends.map(|end| end.place.map(|v| v as i32));
        let distance = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
        let step = [0, 1].map(|axis| (to[axis] - from[axis]).signum());
        let minor = usize::from(distance[0] >= distance[1]);
        let slope = (ends[1].depth - ends[0].depth) / distance[1 - minor].max(1) as f32;
        let (mut pixel, mut depth) = (from, ends[0].depth);
        let mut error = distance[0] - distance[1];
        loop {
            if width == 1 {
                self.set(pixel, depth, id);
            } else {
                for across in -width / 2..(width + 1) / 2 {
                    let mut at = pixel;
                    at[minor] += across;
                    self.set(at, depth, id);
                }
            }
            if pixel == to {
                return;
            }
            let doubled = 2 * error;
            if doubled > -distance[1] {
                error -= distance[1];
                pixel[0] += step[0];
            }
            if doubled < distance[0] {
                error += distance[0];
                pixel[1] += step[1];
            }
            depth += slope;
        }
    }

    fn point(&mut self, Vertex { place, depth }: Vertex, size: f32, shape: PointShape, id: u32) {
        let [left, top] = place.map(|v| (v - size / 2.0 + 0.5).floor() as i32);
        let side = size as i32;
        for y in top..top + side {
            for x in left..left + side {
                let [dx, dy] = [x as f32 + 0.5 - place[0], y as f32 + 0.5 - place[1]];
                if shape == PointShape::Square || dx * dx + dy * dy < size * size / 4.0 {
                    self.set([x, y], depth, id);
                }
            }
        }
    }
}

/// Segments of some lengths in turn, in all directions.
fn segments(lengths: &[f32]) -> Vec<[Vertex; 2]> {
    let mut number = numbers();
    let segment = |index: usize| {
        let length = lengths[index % lengths.len()];
        let [mut dx, mut dy] = [0.0, 0.0];
        while !(0.01..1.0).contains(&(dx * dx + dy * dy)) {
            [dx, dy] = [2.0 * number() - 1.0, 2.0 * number() - 1.0];
        }
        let scale = length / f32::sqrt(dx * dx + dy * dy);
        let place = [number() * SIZE[0] as f32, number() * SIZE[1] as f32];
        let end = [place[0] + dx * scale, place[1] + dy * scale];
        [place, end].map(|place| Vertex { place, depth: 0.1 + 0.8 * number() })
    };
    (0..COUNT).map(segment).collect()
}

/// What both need for a row of the table.
struct Row<'a> {
    name: String,
    pass: Pass<'a>,
    plain: Box<dyn FnMut(&mut Plain) + 'a>,
}

fn measure(row: Row<'_>, rasterizer: &mut Rasterizer, turns: usize) {
    let Row { name, pass, mut plain } = row;
    let outputs = [Output::Srgb8, Output::Depth, Output::Object];
    let mut target = Target::new(SIZE[0] as u32, SIZE[1] as u32, &outputs).expect("the size is in range");
    let mut buffers = Plain::new();
    let [mut ours, mut theirs] = [Duration::MAX; 2];
    let mut stages = Default::default();
    for _ in 0..turns + 1 {
        let start = Instant::now();
        let stats = rasterizer.draw(black_box(&pass), &mut target);
        if start.elapsed() < ours {
            (ours, stages) = (start.elapsed(), stats.times);
        }
        let start = Instant::now();
        buffers.clear();
        plain(black_box(&mut buffers));
        theirs = theirs.min(start.elapsed());
    }
    let of_pixel = |time: Duration| time.as_nanos() as f64 / buffers.pixels as f64;
    let [a, b] = [of_pixel(ours), of_pixel(theirs)];
    println!("{name:40} {:9} {a:8.2} {b:8.2} {:7.2}", buffers.pixels, a / b);
    if rasterizer.settings().timed {
        println!("    {stages:?}");
    }
}

fn prefix(smoothing: Smoothing) -> &'static str {
    match smoothing {
        Smoothing::Sharp => "",
        Smoothing::AntiAliased => "smooth ",
    }
}

fn main() {
    let arguments: Vec<_> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let has = |flag: &str| arguments.iter().any(|argument| argument == flag);
    let (turns, timed) = (if has("--quick") || has("--test") { 1 } else { TURNS }, has("--stages"));
    let simd = has("--avx2").then_some(SimdLevel::Avx2);
    let settings = ExecuteSettings { threads: NonZeroUsize::new(1), timed, simd, ..Default::default() };
    let mut rasterizer = Rasterizer::new(settings).expect("the level is supported");
    let picked: Vec<_> = arguments.iter().filter(|argument| !argument.starts_with("--")).collect();
    let is_picked = |name: &str| picked.is_empty() || picked.iter().any(|part| name.contains(*part));
    println!("{:40} {:>9} {:>8} {:>8} {:>7}", "ns per pixel", "pixels", "trigon", "plain", "ratio");
    for (lengths, what) in
        [(vec![5.0], "5"), (vec![20.0], "20"), (vec![100.0], "100"), (vec![5.0, 20.0, 100.0], "5, 20, 100")]
    {
        let segments = segments(&lengths);
        let wire = OneColor::new(segments.as_flattened());
        let indices: Vec<_> = (0..COUNT as u32).map(|i| [2 * i, 2 * i + 1]).collect();
        for (smoothing, width) in
            [Smoothing::Sharp, Smoothing::AntiAliased].into_iter().flat_map(|o| [(o, 1), (o, 3)])
        {
            let name = format!("{}lines of {what} px, width {width}", prefix(smoothing));
            if !is_picked(&name) {
                continue;
            }
            let mut pass = Pass::new();
            pass.lines(Lines { width: width as f32, smoothing, ..Lines::new(&wire, &indices) });
            let plain = Box::new(|plain: &mut Plain| {
                segments.iter().zip(0..).for_each(|(&ends, id)| plain.line(ends, width, id));
            });
            measure(Row { name, pass, plain }, &mut rasterizer, turns);
        }
    }
    let segments = segments(&[1.0]);
    let vertices: Vec<_> = segments.iter().map(|[vertex, _]| *vertex).collect();
    let (wire, indices) = (OneColor::new(&vertices), (0..COUNT as u32).collect::<Vec<_>>());
    let shapes = [
        (PointShape::Square, Smoothing::Sharp, "square"),
        (PointShape::Round, Smoothing::Sharp, "round"),
        (PointShape::Round, Smoothing::AntiAliased, "round"),
    ];
    for (shape, smoothing, what) in shapes {
        for size in [1.0, 3.0, 5.0] {
            let name = format!("{}{what} points of {size} px", prefix(smoothing));
            if !is_picked(&name) {
                continue;
            }
            let mut pass = Pass::new();
            pass.points(Points { shape, smoothing, ..Points::new(&wire, &indices, size) });
            let plain = Box::new(|plain: &mut Plain| {
                vertices.iter().zip(0..).for_each(|(&vertex, id)| plain.point(vertex, size, shape, id));
            });
            measure(Row { name, pass, plain }, &mut rasterizer, turns);
        }
    }
}
