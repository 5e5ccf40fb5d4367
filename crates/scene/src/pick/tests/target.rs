//! Triangles as rays in f64 meet them, and as the renderer draws them.
//!
//! A ray through the screen at (x, y) meets a triangle where three volumes have one sign: each
//! is spanned by the ray and two corners, and is linear in x and y. So what holds in a
//! little square around a point, too, is told by the value in its middle and the slopes.
//!
//! What the renderer draws is decided on its grid (`grid`). Only of triangles that the near plane
//! may cut the corners on the grid are not known: there all that a move by half a step of the
//! grid may change is open.

use trigon_camera::{Camera, Projection};
use trigon_math::{DVec2, DVec3};
use trigon_mesh::primitives;

use super::grid::{GridTriangle, Vertex, depths, is_before_far};
use super::oracle::Answer::{No, Open, Yes};
use super::oracle::{Answer, Lens};
use crate::pick::region::center;
use crate::{Frame, Material, NodeId, Outputs, Picker, Reach, Region, RenderSettings, Scene, render};

/// What the renderer moves vertices by: half a step of 1/256 pixel, and the rounding of their
/// coordinates to f32 before.
const SNAPPING: f64 = 0.5 / 256.0 + 1e-4;

/// A triangle as rays meet it.
pub(super) struct Target {
    pub(super) object: usize,
    pub(super) face: u32,
    /// Whether it is drawn as seen from here.
    pub(super) drawn: Answer,
    /// The same for the renderer, which may turn a sliver over by moving its corners.
    snapped: Answer,
    /// Whether an equal triangle comes before it: of those the renderer draws the first.
    pub(super) is_repeated: bool,
    pub(super) corners: [DVec3; 3],
    is_front: bool,
    /// The least and the greatest coordinates of pixels that it may touch.
    bounds: [DVec2; 2],
    /// It on the renderer's grid; `None` where the near plane may cut it.
    grid: Option<GridTriangle>,
    /// For each corner the volume opposite to it, as (by x, by y, constant); positive within
    /// the triangle.
    volumes: [DVec3; 3],
    /// The volume that the triangle spans with the eye, or its corners' distances.
    span: Span,
}

/// What the renderer finds of a triangle at a pixel's centre.
pub(super) struct Rendered {
    /// Whether it is there.
    pub(super) answer: Answer,
    /// The least and the greatest distance there.
    pub(super) distances: [f64; 2],
    /// Its side, counter-clockwise on the screen, if nothing but that leaves open whether it
    /// is there: then a triangle on the other side of it is there if this one is not, since
    /// both have the same corners on the grid.
    pub(super) side: Option<[DVec3; 2]>,
}

enum Span {
    /// Distance is this by the sum of the volumes.
    Eye(f64),
    /// Distance is the mean of these by the volumes.
    Corners([f64; 3]),
}

impl Target {
    pub(super) fn new(
        lens: &Lens,
        vertices: &[Vertex; 3],
        (object, face): (usize, u32),
        double_sided: bool,
    ) -> Self {
        let corners = vertices.map(|vertex| vertex.local);
        // As rays see them: in a parallel projection all at one distance.
        let [a, b, c] =
            corners.map(|corner| if lens.parallel { corner.truncate().extend(1.0) } else { corner });
        let volume = a.dot(b.cross(c));
        let size = (b - a).length() * (c - a).length() * a.length().max(1.0);
        // Across, upwards and forwards are left-handed axes: the volumes of fronts are positive.
        let faces = Answer::of(volume, 1e-12 * size);
        let drawn = if double_sided { Answer::of(volume.abs(), 1e-12 * size).max(Open) } else { faces };
        // The ray through (x, y): across (x - w/2)/scale, upwards (h/2 - y)/scale, forwards 1.
        let linear = |normal: DVec3| {
            let (x, y) = (normal.x / lens.scale, -normal.y / lens.scale);
            DVec3::new(x, y, normal.z - x * lens.size.x / 2.0 - y * lens.size.y / 2.0) * volume.signum()
        };
        let span = if lens.parallel {
            Span::Corners(corners.map(|corner| corner.z))
        } else {
            Span::Eye(volume.abs())
        };
        let snapped = if is_sliver(lens, corners) { Open } else { drawn };
        let is_front = volume > 0.0;
        Self {
            object,
            face,
            drawn,
            snapped,
            is_repeated: false,
            corners,
            is_front,
            bounds: bounds(lens, corners),
            grid: GridTriangle::new(lens, vertices, double_sided),
            volumes: [b.cross(c), c.cross(a), a.cross(b)].map(linear),
            span,
        }
    }

    /// Whether the ray meets it beyond the near and before the far plane, wherever in a square
    /// of twice this side it is, and between which distances.
    pub(super) fn meets(&self, lens: &Lens, at: DVec2, reach: f64) -> (Answer, [f64; 2]) {
        let value = |volume: DVec3| volume.x * at.x + volume.y * at.y + volume.z;
        let slope = |volume: DVec3| reach * (volume.x.abs() + volume.y.abs());
        let covered = self.volumes.map(|volume| self.covered(volume, at, reach));
        let covered = covered.into_iter().min().expect("three");
        if covered == No {
            return (No, [0.0; 2]);
        }
        let sum = self.volumes.iter().sum::<DVec3>();
        let distances = match self.span {
            Span::Eye(volume) => {
                let (sum, slope) = (value(sum), slope(sum));
                [volume / (sum + slope), if sum > slope { volume / (sum - slope) } else { f64::INFINITY }]
            }
            Span::Corners(corners) => {
                // The distance is linear, too.
                let weighted: DVec3 =
                    self.volumes.iter().zip(corners).map(|(&volume, corner)| volume * corner).sum();
                let (middle, change) = (value(weighted) / value(sum), slope(weighted) / value(sum));
                [middle - change, middle + change]
            }
        };
        let range = distances.map(|distance| lens.in_range(distance, reach));
        let in_range = match range {
            [Yes, Yes] => Yes,
            [No, No] if (distances[0] < lens.near) == (distances[1] < lens.near) => No,
            _ => Open,
        };
        (covered.min(in_range), distances)
    }
}

/// Whether the renderer's steps may turn a triangle over that lies before the eye.
fn is_sliver(lens: &Lens, corners: [DVec3; 3]) -> bool {
    if corners.iter().any(|corner| corner.z < lens.near) {
        return false;
    }
    let [a, b, c] = corners.map(|corner| lens.seen(corner).at);
    let longest = (b - a).length().max((c - b).length()).max((a - c).length());
    (b - a).perp_dot(c - a).abs() <= 4.0 * SNAPPING * longest
}

impl Target {
    /// Whether it may be met in a pixel at all.
    pub(super) fn is_near(&self, at: DVec2) -> bool {
        self.bounds[0].cmple(at).all() && self.bounds[1].cmpge(at).all()
    }

    /// What the renderer finds of it at a pixel's centre; `None` where it is certain that it
    /// finds nothing.
    pub(super) fn rendered(&self, lens: &Lens, pixel: [u32; 2]) -> Option<Rendered> {
        let found = match &self.grid {
            _ if self.is_repeated => None,
            Some(grid) => self.on_grid(lens, grid, pixel),
            None => self.cut(lens, center(pixel[0], pixel[1])),
        };
        found.filter(|found| found.answer != No)
    }

    fn on_grid(&self, lens: &Lens, grid: &GridTriangle, pixel: [u32; 2]) -> Option<Rendered> {
        let met = grid.met(lens, pixel)?;
        let before_far = is_before_far(lens, met.distances);
        let side = met.side.filter(|_| before_far == Yes);
        Some(Rendered {
            answer: met.covered.min(before_far),
            distances: depths(met.distances),
            side: side.map(|ends| ends.map(|end| self.corners[end])),
        })
    }

    /// The same where it is open where its corners are on the grid.
    fn cut(&self, lens: &Lens, at: DVec2) -> Option<Rendered> {
        let (met, distances) = self.meets(lens, at, SNAPPING);
        let covered = self.volumes.map(|volume| self.covered(volume, at, SNAPPING));
        let in_range = distances.iter().all(|&distance| lens.in_range(distance, SNAPPING) == Yes);
        let alone = covered.iter().filter(|&&answer| answer == Open).count() == 1;
        let side = covered.iter().position(|&answer| answer == Open);
        let side = side.filter(|_| self.snapped == Yes && in_range && alone);
        (met != No).then_some(Rendered {
            answer: met.min(self.snapped),
            distances: depths(distances),
            side: side.map(|side| self.side(side)),
        })
    }

    /// The side opposite to a corner, counter-clockwise on the screen.
    fn side(&self, corner: usize) -> [DVec3; 2] {
        let [from, to] = [self.corners[(corner + 1) % 3], self.corners[(corner + 2) % 3]];
        if self.is_front { [from, to] } else { [to, from] }
    }

    /// Whether the ray passes a side of it on the inside.
    fn covered(&self, volume: DVec3, at: DVec2, reach: f64) -> Answer {
        let value = volume.x * at.x + volume.y * at.y + volume.z;
        Answer::of(value, reach * (volume.x.abs() + volume.y.abs()))
    }
}

/// A box around a triangle on the screen, with a pixel more on each side; around everything
/// if it reaches before the near plane.
fn bounds(lens: &Lens, corners: [DVec3; 3]) -> [DVec2; 2] {
    if corners.iter().any(|corner| corner.z < lens.near) {
        return [DVec2::NEG_INFINITY, DVec2::INFINITY];
    }
    let [a, b, c] = corners.map(|corner| lens.seen(corner).at);
    [a.min(b).min(c) - 1.0, a.max(b).max(c) + 1.0]
}

const SIZE: [u32; 2] = [320, 240];

/// Half of what the image is high at a metre.
const HALF: f64 = 1.4;

/// Where a point in front of a camera at the origin that looks along −z is drawn.
fn drawn(point: DVec3) -> DVec2 {
    let size = DVec2::new(SIZE[0].into(), SIZE[1].into());
    let scale = size.y / 2.0 / HALF / -point.z;
    DVec2::new(size.x / 2.0 + point.x * scale, size.y / 2.0 - point.y * scale)
}

/// A room of 4 m about the eye: the four edges that run past it are found wherever they are in view, and the wall ahead
/// and the others in the pixels that they cover.
#[test]
fn edges_and_walls_that_run_past_the_eye_are_picked_where_they_are_seen() {
    let mut scene = Scene::new();
    let room = scene.add_object("room", primitives::cube(4.0), Material::default());
    let angle = 2.0 * trigon_math::elementary::atan2(HALF, 1.0);
    let projection = Projection::perspective(angle, 1.0, None).expect("in range");
    for eye in [DVec3::ZERO, DVec3::new(0.7, -0.4, 1.0), DVec3::new(0.0, 1.5, 0.5)] {
        let camera = Camera::look_at(eye, eye + DVec3::NEG_Z, DVec3::Y).with_projection(projection);
        let camera = camera.with_clip_planes(&scene.bounds());
        assert!(camera.projection.near() < 1e-20, "right before the eye: {}", camera.projection.near());
        let outputs = Outputs { ids: true, depth: true, ..Outputs::NONE };
        let settings =
            RenderSettings { outputs, samples_per_axis: 1, ..RenderSettings::new(SIZE[0], SIZE[1]) };
        let frame = render(&scene, &camera, &settings).expect("drawn");
        let picker = Picker::new(&scene, &camera, &frame);
        let found = edges_found(&picker, &scene, eye);
        assert!(found >= 4, "{found} points of edges are in view from {eye}");
        check_faces(&picker, &frame, room);
    }
}

/// Picks points of the edges along z; how many of them are in view.
fn edges_found(picker: &Picker<'_>, scene: &Scene, eye: DVec3) -> usize {
    let mesh = scene.meshes().iter().next().expect("the room").1.mesh();
    let mut found = 0;
    let corners = [(-2.0, -2.0), (-2.0, 2.0), (2.0, -2.0), (2.0, 2.0)];
    for ((x, y), z) in corners.into_iter().flat_map(|corner| [-1.9, -1.5, -1.2].map(|z| (corner, z))) {
        let at = drawn(DVec3::new(x, y, z) - eye);
        if z > eye.z - 0.1 || at.cmplt(DVec2::ONE).any() || at.x > 319.0 || at.y > 239.0 {
            continue;
        }
        let edge = picker.nearest(at, 3.0, Reach::Visible).edge;
        let (_, edge) = edge.unwrap_or_else(|| panic!("none at {at} from {eye}"));
        let ends = mesh.edges()[edge as usize].map(|end| mesh.positions()[end as usize].as_dvec3());
        assert!(ends.iter().all(|end| end.x == x && end.y == y), "{ends:?} at {x}, {y}, {z}");
        found += 1;
    }
    found
}

/// Some pixels: the face of the pixel's id; through all, too, but for a centre on an edge, which both faces cover.
fn check_faces(picker: &Picker<'_>, frame: &Frame, room: NodeId) {
    let ids = frame.face_ids.as_ref().expect("asked for");
    for (index, &face) in ids.iter().enumerate().step_by(1999) {
        let at = center(index as u32 % SIZE[0], index as u32 / SIZE[0]);
        assert_ne!(face, u32::MAX, "a wall at {at}");
        for (reach, most) in [(Reach::Visible, 1), (Reach::Through, 2)] {
            let faces = picker.faces(&Region::Point(at), reach);
            assert!(faces.contains(room, face) && faces.len() <= most, "{faces:?} at {at}, {reach:?}");
        }
    }
}
