//! What is in front?

use super::*;
use crate::line::Line;
use crate::visibility::{OrderErrors, Visibility, VisibilityCase, balls, sheets};
use trigon_classic::{Field, Method, Scene, visible_lines};

const WRONG: &str = "misordered pixels, ‰";
const TIME: &str = "ms per frame";
const TESTS: &str = "tests";

/// Rays whose tree is built for each image.
const ANEW: &str = "rays, tree built anew";

const PARALLEL: &str = "16 parallel sheets";
const CROSSING: &str = "16 sheets that cross";

pub(super) fn measure(effort: Effort) -> Chapter {
    let side = effort.pick(96, 256);
    let mut rows = Vec::new();
    for case in VisibilityCase::ALL {
        rows.extend(of_scene(case.name(), &case.scene(side), effort));
    }
    for (name, tilt) in [(PARALLEL, 0), (CROSSING, side as i32)] {
        rows.extend(of_scene(name, &sheets(side, tilt), effort));
    }
    let counts: &[usize] = effort.pick(&[10, 20, 40], &[10, 20, 40, 80, 160, 320, 640, 1280]);
    let (by_time, by_tests) = growth(side, counts, effort);
    let findings = findings(&rows, &by_time);
    let balls = VisibilityCase::Balls.name();
    let axis = "balls of 80 faces, of the same size";
    let plots = vec![
        Plot::trade("balls", &rows, balls, [TIME, WRONG]),
        Plot::trade("crossing", &rows, VisibilityCase::Crossing.name(), [TIME, WRONG]),
        Plot::growth("time", "Time of a frame by the number of bodies", [axis, TIME], by_time),
        Plot::growth(
            "tests",
            "Work by the number of bodies",
            [axis, "tests, each algorithm's own"],
            by_tests,
        ),
    ];
    Chapter {
        name: "visibility",
        title: "What is in front?",
        text: "The ways that source D weighs on paper, the painter's algorithm and a tree for rays, on the same bodies. A pixel is \
               misordered if it does not show one of the nearest faces, decided in integers. Each algorithm counts its own kind \
               of test: the painter comparisons, Roberts points against planes, Warnock faces against windows, the z-buffer \
               pixels in bounding boxes, rays faces. All keep their memory from frame to frame but Roberts and Warnock; the tree \
               for rays is kept in one row and built for each image in another.",
        findings,
        images: vec![errors_image(), lines_image()],
        rows,
        plots,
    }
}

/// All algorithms, those that refuse the scene without numbers; then rays with a new tree.
fn of_scene(name: &str, scene: &Scene, effort: Effort) -> Vec<Row> {
    let cached = Visibility::ALL.map(|way| (way, way.name()));
    let ways: Vec<_> = cached.into_iter().chain([(Visibility::Classic(Method::TreeRays), ANEW)]).collect();
    let times = nanoseconds(effort.rounds().div_ceil(2), &ways, |(way, name)| {
        if name == ANEW { way.repeated_anew(scene) } else { way.repeated(scene) }
    });
    let row = |((way, variant), time): ((Visibility, &str), Spread)| {
        let row = |variant: String| {
            let row = Row::new(name, variant).by(way.name()).sized(scene.size());
            if way.keeps_state() && row.variant != ANEW { row } else { row.built_anew() }
        };
        let Ok(drawing) = way.draw(scene) else {
            return row(format!("{variant} (refuses: not convex)"));
        };
        let row = row(variant.to_owned()).with(WRONG, OrderErrors::of(scene, &drawing.faces).per_mille());
        let row = if drawing.tests > 0 { row.with(TESTS, drawing.tests as f64) } else { row };
        row.timed(TIME, time.scaled(1e-6))
    };
    ways.into_iter().zip(times).map(row).collect()
}

type Lines = Vec<(String, Vec<[f64; 2]>)>;

/// Time and work by the number of balls.
fn growth(side: usize, counts: &[usize], effort: Effort) -> (Lines, Lines) {
    let empty = || Visibility::ALL.map(|way| (way.name().to_owned(), Vec::new())).to_vec();
    let (mut by_time, mut by_tests): (Lines, Lines) = (empty(), empty());
    for &count in counts {
        let scene = balls(side, count, side as f64 / 20.0, 5);
        for (index, way) in Visibility::ALL.into_iter().enumerate() {
            // What is quadratic, or takes each pixel with each face, ends early.
            let slow =
                [Visibility::Classic(Method::Roberts), Visibility::Classic(Method::AllRays)].contains(&way);
            if slow && count > 160 {
                continue;
            }
            let rounds = if slow { 1 } else { effort.rounds().div_ceil(3) };
            let scene = &scene;
            let time = nanoseconds(rounds, &[way], |way| way.repeated(scene))[0];
            by_time[index].1.push([count as f64, time.median * 1e-6]);
            if let Ok(drawing) = way.draw(scene)
                && drawing.tests > 0
            {
                by_tests[index].1.push([count as f64, drawing.tests as f64]);
            }
        }
    }
    let drawn = |lines: Lines| lines.into_iter().filter(|(_, line)| !line.is_empty()).collect();
    (drawn(by_time), drawn(by_tests))
}

/// The ring as each algorithm shows it, then where the painter is wrong.
fn errors_image() -> ImageRow {
    let scene = VisibilityCase::Crossing.scene(256);
    let faces = |way: Visibility| {
        way.draw(&scene).map_or_else(|_| Field::new([256; 2], u32::MAX), |drawing| drawing.faces)
    };
    let (painter, engine) = (faces(Visibility::Classic(Method::Painter)), faces(Visibility::Engine));
    let wrong = Field::from_fn([256; 2], |position| {
        heat(if painter[position] == engine[position] { 0.0 } else { 0.5 })
    });
    let caption =
        "Balls that stick in each other: the painter's algorithm, the engine, and where they differ";
    ImageRow::new("errors", caption, vec![tinted(&painter), tinted(&engine), wrong])
}

/// Hidden lines by Roberts.
fn lines_image() -> ImageRow {
    let panel = |case: VisibilityCase| {
        drawn(visible_lines(&case.scene(256)).map(|lines| lines.lines).unwrap_or_default())
    };
    let caption = "Hidden lines by Roberts' algorithm: 40 balls, three bodies in a ring, balls that stick in each other";
    ImageRow::new(
        "lines",
        caption,
        [VisibilityCase::Balls, VisibilityCase::Ring, VisibilityCase::Crossing].map(panel).to_vec(),
    )
}

/// Lines between points in 1/256 pixel, black on white.
fn drawn(lines: Vec<[[f64; 3]; 2]>) -> Field<[u8; 3]> {
    let mut ink = Field::new([256; 2], 0.0);
    let end = |[x, y, _]: [f64; 3]| [x, y].map(|part| (part / 256.0).floor() as i32);
    let segments: Vec<_> = lines.into_iter().map(|line| line.map(end)).collect();
    Line::Wu.paint(&segments, &mut ink);
    ink.map(|&ink| grey(1.0 - f64::from(ink).min(1.0)))
}

pub(super) fn findings(rows: &[Row], by_time: &Lines) -> Vec<String> {
    let painter = |case: VisibilityCase| {
        number(value(rows, case.name(), Visibility::Classic(Method::Painter).name(), WRONG))
    };
    vec![
        crossover(by_time),
        format!(
            "The painter is right while there is an order: {} ‰ wrong on a torus, {} ‰ where balls stick in each other, {} ‰ in a \
             ring.",
            painter(VisibilityCase::Torus),
            painter(VisibilityCase::Crossing),
            painter(VisibilityCase::Ring),
        ),
        "Source D's claims hold: Roberts' work is quadratic in the number of bodies, and the z-buffer's linear (twice the bodies, \
         four and two times the tests: see the plot); Warnock's follows what overlaps."
            .to_owned(),
    ]
}

pub(super) fn headlines() -> Vec<Headline> {
    let of = |case: VisibilityCase, ways: [Visibility; 2]| {
        Headline::within(case.name(), ways.map(Visibility::name), [TIME, WRONG])
    };
    let crossing = |way: Visibility| Headline::between([CROSSING, PARALLEL], way.name(), [TESTS]);
    vec![
        of(
            VisibilityCase::Balls,
            [Visibility::Classic(Method::TreeRays), Visibility::Classic(Method::ZBuffer)],
        ),
        of(
            VisibilityCase::Balls,
            [Visibility::Classic(Method::AllRays), Visibility::Classic(Method::TreeRays)],
        ),
        Headline::within(
            VisibilityCase::Balls.name(),
            [ANEW, Visibility::Classic(Method::TreeRays).name()],
            [TIME],
        ),
        of(VisibilityCase::Balls, [Visibility::Engine, Visibility::Classic(Method::ZBuffer)]),
        of(
            VisibilityCase::Crossing,
            [Visibility::Classic(Method::Painter), Visibility::Classic(Method::ZBuffer)],
        ),
        crossing(Visibility::Classic(Method::Warnock)),
        crossing(Visibility::Classic(Method::ZBuffer)),
    ]
}

/// From how many triangles on rays with a tree are faster than the z-buffer.
fn crossover(by_time: &Lines) -> String {
    let line = |way: Visibility| {
        let found = by_time.iter().find(|(name, _)| name == way.name());
        found.map_or(&[][..], |(_, line)| line.as_slice())
    };
    let pairs =
        line(Visibility::Classic(Method::TreeRays)).iter().zip(line(Visibility::Classic(Method::ZBuffer)));
    let mut faster = pairs.filter(|(rays, buffer)| rays[1] < buffer[1]);
    match (faster.next(), line(Visibility::Classic(Method::ZBuffer)).last()) {
        (Some((rays, _)), _) => {
            format!(
                "From {} triangles on rays with a tree are faster than the plain z-buffer.",
                rays[0] * 80.0
            )
        }
        (None, Some(last)) => format!("Up to {} triangles the answer does not change.", last[0] * 80.0),
        (None, None) => String::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_black_where_they_were_found() {
        let found = drawn(vec![
            [[10.5, 20.25, 3.0], [70.0, 20.75, -5.0]].map(|point| point.map(|part| part * 256.0)),
        ]);
        for (position, &color) in found.pixels() {
            let is_line = position[1] == 20 && (10..=70).contains(&position[0]);
            assert_eq!(color, if is_line { [0; 3] } else { [255; 3] }, "{position:?}");
        }
    }

    #[test]
    fn rays_are_faster_from_the_first_count_on_at_which_they_take_less() {
        let lines = |rays: &[f64]| {
            let line = |times: &[f64]| (1..).zip(times).map(|(i, &time)| [f64::from(10 * i), time]).collect();
            vec![
                (Visibility::Classic(Method::Painter).name().to_owned(), line(&[0.0; 3])),
                (Visibility::Classic(Method::TreeRays).name().to_owned(), line(rays)),
                (Visibility::Classic(Method::ZBuffer).name().to_owned(), line(&[1.0, 2.0, 4.0])),
            ]
        };
        // A ball has 80 triangles.
        assert!(crossover(&lines(&[1.5, 1.9, 3.0])).starts_with("From 1600 triangles on rays"));
        assert!(crossover(&lines(&[1.5, 2.0, 3.0])).starts_with("From 2400 triangles on rays"));
        assert_eq!(crossover(&lines(&[1.5, 2.5, 4.0])), "Up to 2400 triangles the answer does not change.");
        assert_eq!(crossover(&Lines::new()), "", "nothing was measured");
    }

    #[test]
    fn growth_has_a_point_for_each_count_of_balls() {
        let (times, tests) = growth(16, &[2, 4], Effort::Once);
        assert_eq!(times.len(), Visibility::ALL.len(), "a line for each algorithm");
        for (name, line) in &times {
            assert_eq!(line.iter().map(|point| point[0]).collect::<Vec<_>>(), [2.0, 4.0], "{name}");
        }
        for (name, line) in &tests {
            let way = Visibility::ALL.into_iter().find(|way| way.name() == name).expect("it is one of them");
            for &[count, counted] in line {
                let scene = balls(16, count as usize, 0.8, 5);
                let drawing = way.draw(&scene).expect("balls are convex");
                assert_eq!(counted, drawing.tests as f64, "{name}, {count} balls");
            }
        }
        assert!(tests.len() > 3 && tests.iter().all(|(_, line)| line.len() == 2), "those that count tests");
    }
}
