//! Which pixels does a triangle cover?

use super::*;
use crate::engine::{Corners, Engine, target};
use crate::fill::{Fill, FillCanvas, FillErrors, Painted, Tiling, Triangle, owners, tiles};
use trigon_classic::Field;
use trigon_raster::Output;

const WRONG: &str = "wrong pixels, ‰ of edge pixels";
const GAPS: &str = "gaps, ‰";
const DOUBLES: &str = "doubles, ‰";
const TIME: &str = "ns per triangle";

pub(super) fn measure(effort: Effort) -> Chapter {
    let mut rows = Vec::new();
    for case in Tiling::ALL {
        rows.extend(of_case(case, effort));
    }
    let growth = growth(effort);
    let tiles = Tiling::Tiles.name();
    let plots = vec![
        Plot::trade("tiles", &rows, tiles, [TIME, WRONG]),
        Plot::growth(
            "size",
            "Time of a triangle by its size",
            ["edge of a square of two triangles, pixels", TIME],
            growth,
        ),
    ];
    Chapter {
        name: "fill",
        title: "Which pixels does a triangle cover?",
        text: "Triangles that tile an image of 256 by 256 pixels, so that every pixel has one owner, decided exactly for \
               the corners as they were given. An edge pixel has a neighbour with another owner; a wrong one was not painted \
               exactly once, by its owner. Sources A (strips), B (scanlines) and C (inclusive edges at the corners of pixels) \
               as they are.",
        findings: findings(&rows),
        images: vec![image()],
        rows,
        plots,
    }
}

fn of_case(case: Tiling, effort: Effort) -> Vec<Row> {
    const SIDE: usize = 256;
    let triangles = case.triangles(SIDE, 0);
    let times = times_of(&Fill::ALL, &triangles, SIDE, effort);
    let tilings: Vec<(Vec<Triangle>, Field<u32>)> = (0..effort.pick(2, 8))
        .map(|seed| {
            let triangles = case.triangles(SIDE, seed);
            let owners = owners(&triangles, [SIDE; 2]);
            (triangles, owners)
        })
        .collect();
    let row = |(&fill, time): (&Fill, Spread)| {
        let mut errors = FillErrors::default();
        for (triangles, owners) in &tilings {
            let mut canvas = FillCanvas::new([SIDE; 2]);
            fill.paint(triangles, &mut canvas);
            errors += FillErrors::of(&canvas, owners);
        }
        let per_mille = |count: usize| 1e3 * count as f64 / errors.edge_pixels as f64;
        Row::new(case.name(), fill.name())
            .sized([SIDE; 2])
            .with(WRONG, errors.wrong_per_mille())
            .with(GAPS, per_mille(errors.gaps))
            .with(DOUBLES, per_mille(errors.doubles))
            .timed(TIME, time.per(triangles.len()))
    };
    Fill::ALL.iter().zip(times).map(row).collect()
}

/// Nanoseconds for all triangles. The engine draws and stores one image, as the others do.
fn times_of(fills: &[Fill], triangles: &[Triangle], side: usize, effort: Effort) -> Vec<Spread> {
    nanoseconds(effort.rounds(), fills, |fill| -> Box<dyn FnMut()> {
        let mut canvas = FillCanvas::new([side; 2]);
        if fill != Fill::Engine {
            return Box::new(move || fill.paint(triangles, &mut canvas));
        }
        let (mut engine, mut target) = (Engine::default(), target([side; 2], &[Output::Triangle]));
        let shape = Corners::flat(triangles, [side; 2]);
        Box::new(move || engine.draw(&shape, &mut target))
    })
}

/// The time of a triangle by the size of its square.
fn growth(effort: Effort) -> Vec<(String, Vec<[f64; 2]>)> {
    const FILLS: [Fill; 6] =
        [Fill::Strips, Fill::Scanlines, Fill::EdgesInBox, Fill::FloatHoisted, Fill::Fixed8, Fill::Engine];
    let mut lines: Vec<(String, Vec<[f64; 2]>)> =
        FILLS.iter().map(|fill| (fill.name().to_owned(), Vec::new())).collect();
    for square in [4.0, 8.0, 16.0, 32.0, 64.0, 128.0] {
        let triangles = tiles(512, square, 1.0 / 256.0, 1);
        let times = times_of(&FILLS, &triangles, 512, effort);
        for ((_, line), time) in lines.iter_mut().zip(times) {
            line.push([square, time.per(triangles.len()).median]);
        }
    }
    lines
}

/// Errors: a gap is white, a pixel painted twice red, a neighbour's pixel yellow.
fn image() -> ImageRow {
    const SIZE: [usize; 2] = [64; 2];
    let triangles = Tiling::Lattice.triangles(SIZE[0], 2);
    let owners = owners(&triangles, SIZE);
    let panel = |fill: Fill| {
        let mut canvas = FillCanvas::new(SIZE);
        fill.paint(&triangles, &mut canvas);
        let color = |position: [usize; 2]| match canvas.pixels()[position] {
            Painted { count: 0, .. } => [255; 3],
            Painted { count: 1, last } if last == owners[position] => tint(last).map(|part| part / 3),
            Painted { count: 1, .. } => [240, 200, 40],
            _ => [230, 50, 40],
        };
        Field::from_fn(SIZE, color)
    };
    let fills = [Fill::Strips, Fill::Scanlines, Fill::EdgesInBox, Fill::EdgesAtCenters, Fill::Engine];
    let caption = "Strips, scanlines, inclusive edges at corners and at centres of pixels, and the engine, on corners at half \
                   pixels: red was painted twice, yellow belongs to a neighbour, white was left out";
    ImageRow::new("errors", caption, fills.map(panel).to_vec())
}

pub(super) fn findings(rows: &[Row]) -> Vec<String> {
    let [tiles, fan, lattice] = [Tiling::Tiles, Tiling::Fan, Tiling::Lattice].map(Tiling::name);
    let of = |case: &str, fill: Fill, quantity: &str| value(rows, case, fill.name(), quantity);
    let [float, exact] = [Fill::FloatFromCorners, Fill::Fixed8];
    vec![
        format!(
            "What a grid costs is accuracy against corners between its points: {}, {} and {} of a thousand edge pixels go to the \
             neighbour with 4, 8 and 12 bits. With `f32` from corners it is {}; but far corners leave {} gaps and {} doubles of a \
             thousand there, where a grid has none, ever.",
            number(of(tiles, Fill::Fixed4, WRONG)),
            number(of(tiles, exact, WRONG)),
            number(of(tiles, Fill::Fixed12, WRONG)),
            number(of(tiles, float, WRONG)),
            number(of(fan, float, GAPS)),
            number(of(fan, float, DOUBLES)),
        ),
        format!(
            "Inclusive edges paint {} of a thousand edge pixels twice where corners lie on half pixels, strips {}: translucent \
             or counted surfaces show that.",
            number(of(lattice, Fill::EdgesAtCenters, DOUBLES)),
            number(of(lattice, Fill::Strips, DOUBLES)),
        ),
    ]
}

pub(super) fn headlines() -> Vec<Headline> {
    let tiles =
        |fills: [Fill; 2]| Headline::within(Tiling::Tiles.name(), fills.map(Fill::name), [TIME, WRONG]);
    vec![
        tiles([Fill::Fixed8, Fill::FloatHoisted]),
        tiles([Fill::Fixed8Lanes, Fill::FloatLanes])
            .meaning("Both walk the same boxes with edges that are set up once."),
        tiles([Fill::Engine, Fill::Fixed8Lanes])
            .meaning("The engine also sorts triangles into tiles and tests depth."),
        tiles([Fill::EdgesOnScreen, Fill::EdgesInBox]).meaning("The bounding box changes no pixel."),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners are on half pixels, so the engine is exact: each pixel has its owner's colour, darker.
    #[test]
    fn what_was_painted_by_its_owner_is_dark() {
        let triangles = Tiling::Lattice.triangles(64, 2);
        let owners = owners(&triangles, [64; 2]);
        let panels = image().panels;
        let engine = panels.last().expect("the engine's");
        for (position, &owner) in owners.pixels() {
            assert_eq!(engine[position], tint(owner).map(|part| part / 3), "{position:?}");
        }
        let count = |panel: usize, color: [u8; 3]| {
            panels[panel].values().iter().filter(|&&found| found == color).count()
        };
        let (white, red) = ([255; 3], [230, 50, 40]);
        assert!(count(0, red) > 100 && count(0, white) == 0, "strips take in all pixels at their ends");
        assert!(count(3, red) > 10 && count(3, white) == 0, "inclusive edges paint shared pixels twice");
    }
}
