//! Polygons to test with, in the plane (y up, counter-clockwise).

use std::f64::consts::TAU;

use trigon_math::{DVec2, Orientation, Vec3, elementary, orientation};
use trigon_mesh::Mesh;

pub(crate) type Outline = Vec<DVec2>;

pub(crate) fn outline(points: &[(f64, f64)]) -> Outline {
    points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
}

/// Star-shaped round the origin, with these distances in turn.
pub(crate) fn star(radii: &[f64]) -> Outline {
    let count = radii.len() as f64;
    let point = |(i, radius): (usize, &f64)| {
        let (sin, cos) = elementary::sin_cos(TAU * i as f64 / count);
        // As coarse as f32, so that embedding it rounds nothing.
        DVec2::new(cos, sin).as_vec2().as_dvec2() * *radius
    };
    radii.iter().enumerate().map(point).map(|p| p.as_vec2().as_dvec2()).collect()
}

/// A skyline over integer widths and heights: many right angles, and collinear
/// corners wherever neighbours are equally high.
pub(crate) fn skyline(heights: &[u8]) -> Outline {
    let mut points = vec![DVec2::ZERO, DVec2::new(heights.len() as f64, 0.0)];
    for (i, &height) in heights.iter().enumerate().rev() {
        let height = f64::from(height) + 1.0;
        points.push(DVec2::new(i as f64 + 1.0, height));
        points.push(DVec2::new(i as f64, height));
    }
    points.dedup();
    points
}

/// A square with square holes in a row, each joined to the one before by a
/// bridge that the outline passes twice.
pub(crate) fn holes_with_bridges(holes: usize) -> Outline {
    let mut points = vec![DVec2::ZERO];
    let hole = |i: usize| {
        let x = 2.0 * i as f64 + 1.0;
        // Clockwise, from the lower left corner.
        [(x, 1.0), (x, 2.0), (x + 1.0, 2.0), (x + 1.0, 1.0)].map(|(x, y)| DVec2::new(x, y))
    };
    for i in 0..holes {
        let [a, b, c, d] = hole(i);
        points.extend([a, b, c, d]);
    }
    for i in (0..holes).rev() {
        points.push(hole(i)[0]);
        if i > 0 {
            points.push(hole(i - 1)[3]);
        }
    }
    let width = 2.0 * holes as f64 + 1.0;
    points.extend([(0.0, 0.0), (width, 0.0), (width, 3.0), (0.0, 3.0)].map(|(x, y)| DVec2::new(x, y)));
    points
}

/// Long thin teeth: the worst case for a search by boxes.
pub(crate) fn comb(teeth: usize) -> Outline {
    let mut points = vec![DVec2::new(-1.0, 0.0)];
    points.push(DVec2::new(-1.0, -1.0));
    points.push(DVec2::new(1000.0, -1.0));
    for i in 0..teeth {
        points.push(DVec2::new(1000.0, 2.0 * i as f64));
        points.push(DVec2::new(0.0, 2.0 * i as f64 + 1.0));
    }
    points.push(DVec2::new(-1.0, 2.0 * teeth as f64));
    points.remove(0);
    points
}

/// Twice the area.
pub(crate) fn doubled_area(points: &[DVec2]) -> f64 {
    let origin = points[0];
    let mut sum = 0.0;
    for pair in points.windows(2) {
        sum += (pair[0] - origin).perp_dot(pair[1] - origin);
    }
    sum
}

/// The plane laid into space along each pair of axes: exact, and turning the
/// same way seen from some side.
pub(crate) fn in_space(points: &[DVec2], plane: usize) -> Vec<Vec3> {
    let at = |p: &DVec2| match plane % 3 {
        0 => Vec3::new(p.x as f32, p.y as f32, 7.0),
        1 => Vec3::new(-3.0, p.y as f32, p.x as f32),
        _ => Vec3::new(p.x as f32, 0.0, p.y as f32),
    };
    points.iter().map(at).collect()
}

/// A mesh of these faces.
pub(crate) fn mesh(positions: &[Vec3], faces: &[&[u32]]) -> Mesh {
    let mut builder = trigon_mesh::MeshBuilder::new();
    for &position in positions {
        builder.push_vertex(position);
    }
    for face in faces {
        builder.push_face(face).expect("the test's face is a polygon");
    }
    builder.build()
}

/// A triangle that grows: each point goes between the first two neighbours that it can stand between without the
/// outline touching itself, counted from the side that is given with it. Points that cannot stand anywhere are left
/// out. The result has bays within bays, whose ears are in each other's way.
pub(crate) fn grown(points: &[(DVec2, usize)]) -> Outline {
    let mut outline = outline(&[(0.0, 0.0), (16.0, 0.0), (0.0, 16.0)]);
    for &(point, first) in points {
        let count = outline.len();
        let fits = |&side: &usize| fits_between(&outline, side, point);
        if let Some(side) = (first..first + count).map(|side| side % count).find(fits) {
            outline.insert(side + 1, point);
        }
    }
    outline
}

/// Whether the outline stays simple if it goes over a point instead of along a side.
fn fits_between(outline: &[DVec2], side: usize, point: DVec2) -> bool {
    let count = outline.len();
    let at = |index: usize| outline[index % count];
    let ends = [at(side), at(side + 1)];
    let is_on = |p: DVec2, [a, b]: [DVec2; 2]| {
        orientation(a, b, p) == Orientation::Collinear && a.min(b).cmple(p).all() && a.max(b).cmpge(p).all()
    };
    let crosses = |[a, b]: [DVec2; 2], [c, d]: [DVec2; 2]| {
        orientation(a, b, c) != orientation(a, b, d) && orientation(c, d, a) != orientation(c, d, b)
    };
    (0..count).all(|other| {
        let others = [at(other), at(other + 1)];
        let free = |end: DVec2| {
            let new = [end, point];
            let shared = others.contains(&end);
            let touches = others.iter().any(|&p| p != end && is_on(p, new));
            !touches && (shared || !crosses(new, others) && !is_on(end, others))
        };
        !is_on(point, others) && (other == side || ends.into_iter().all(free))
    })
}
