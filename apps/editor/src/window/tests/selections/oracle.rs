//! What can be seen and selected of a scene, by rays against every triangle. It shares no code with the picker: its
//! projection, its coverage and its hiding are its own. Where a rounding could decide otherwise, the answer is open.

use std::collections::BTreeMap;

use trigon_window::Stage;
use trigon_window::scene::AlphaMode;
use trigon_window::scene::math::{DVec2, DVec3};
use trigon_window::scene::mesh::Mesh;

use super::lens::{Answer, Lens, Seen, Triangle};
use super::pixels::{AtPixel, at_pixels};
use super::shape::Shape;

/// An element: the index of its mesh in the scene, and its own.
pub(super) type Key = (usize, u32);

/// What a rounding in f64 moves points by, in pixels.
const ROUNDING: f64 = 1e-6;
/// Sides of the squares that triangles are sorted into, in pixels.
const CELL: usize = 16;

/// A point of a vertex or an edge, and whether no other face hides it.
struct OwnPoint {
    seen: Seen,
    is_visible: Answer,
}

/// What is asked for of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Vertex,
    Edge,
    Face,
}

/// All that may be asked of an image.
pub(super) struct Oracle {
    lens: Lens,
    triangles: Vec<Triangle>,
    cells: Vec<Vec<u32>>,
    vertices: Vec<(Key, OwnPoint)>,
    edges: Vec<(Key, Vec<OwnPoint>)>,
    faces: Vec<AtPixel>,
}

impl Oracle {
    /// Of what a stage shows. An error says why this oracle knows nothing of it.
    pub(super) fn new(stage: &Stage) -> Result<Self, String> {
        let size = stage.visible_area().size.size();
        let lens = Lens::new(&stage.camera(), size).ok_or("it has no perspective")?;
        let (vertices, edges, faces, triangles) = Default::default();
        let cells = vec![Vec::new(); columns(size) * (size.y as usize / CELL + 1)];
        let mut oracle = Self { lens, triangles, cells, vertices, edges, faces };
        let objects = oracle.take_objects(stage)?;
        for (index, triangle) in oracle.triangles.iter().enumerate() {
            for cell in cells_of(triangle.bounds(), size) {
                oracle.cells[cell].push(index as u32);
            }
        }
        for (id, mesh, points) in &objects {
            oracle.add_points(*id, mesh, points);
        }
        oracle.faces = at_pixels(&oracle.lens, &oracle.triangles);
        Ok(oracle)
    }

    /// The triangles of all objects, with the places of their vertices.
    fn take_objects<'s>(&mut self, stage: &'s Stage) -> Result<Vec<Object<'s>>, String> {
        const MOST: usize = 40_000;
        let mut objects = Vec::new();
        for (id, node) in stage.scene.nodes().iter().filter(|(_, node)| node.visible) {
            let Some(mesh_id) = node.mesh else { continue };
            let mesh = stage.scene.meshes().get(mesh_id).ok_or("a mesh is missing")?.mesh();
            let mut sides = Vec::new();
            for material in &node.materials {
                let material = stage.scene.materials.get(*material).ok_or("a material is missing")?;
                sides.push(material.double_sided);
                if material.alpha_mode != AlphaMode::Opaque {
                    return Err("not all of it is opaque".into());
                }
            }
            sides.dedup();
            if sides.len() > 1 || !node.morph_weights.is_empty() || node.skin.is_some() {
                return Err("materials differ in their sides, or it moves".into());
            }
            let world = stage.scene.world_transform(id);
            let places = mesh.positions().iter().map(|place| world.transform_point3(place.as_dvec3()));
            let points: Vec<_> = places.map(|place| self.lens.local(place)).collect();
            if points.iter().any(|point| point.z < 1e-3) {
                return Err("something lies behind the eye".into());
            }
            let triangulation = mesh.triangulation();
            for (corners, &face) in triangulation.triangles.iter().zip(&triangulation.triangle_faces) {
                let mut corners =
                    corners.map(|corner| points[mesh.corner_vertices()[corner as usize] as usize]);
                if world.matrix3.determinant() < 0.0 {
                    corners.swap(1, 2);
                }
                let is_double_sided = sides.first().copied().unwrap_or(true);
                self.triangles.push(Triangle::new(
                    &self.lens,
                    (mesh_id.index(), face),
                    corners,
                    is_double_sided,
                ));
            }
            if objects.iter().any(|(known, ..): &Object<'_>| *known == mesh_id.index()) {
                return Err("objects share a mesh".into());
            }
            objects.push((mesh_id.index(), mesh, points));
        }
        if self.triangles.len() > MOST { Err("it has too many triangles".into()) } else { Ok(objects) }
    }

    fn near(&self, at: DVec2) -> impl Iterator<Item = &Triangle> {
        let cell = cells_of([at, at], self.lens.size).next();
        let found = cell.into_iter().flat_map(|cell| self.cells[cell].iter());
        found.map(|&index| &self.triangles[index as usize])
    }

    /// Whether no other face than its own hides a point.
    fn is_visible(&self, seen: Seen, is_own: impl Fn(Key) -> bool) -> Answer {
        let touching = self.lens.touching(seen.distance);
        let hides =
            self.near(seen.at).filter(|triangle| triangle.is_drawn && !is_own(triangle.face)).map(|other| {
                let covers = Answer::of(other.depth_within(seen.at), ROUNDING);
                let before = seen.distance - touching - other.distance(&self.lens, seen.at);
                covers.min(Answer::of(before, 1e-3 * touching))
            });
        hides.max().unwrap_or(Answer::No).not()
    }

    fn add_points(&mut self, id: usize, mesh: &Mesh, points: &[DVec3]) {
        for (vertex, _) in mesh.used_vertices().iter().enumerate().filter(|(_, is_used)| **is_used) {
            let seen = self.lens.seen(points[vertex]);
            let own =
                |(of, face): Key| of == id && mesh.face_vertices(face as usize).contains(&(vertex as u32));
            let is_visible = self.is_visible(seen, own);
            self.vertices.push(((id, vertex as u32), OwnPoint { seen, is_visible }));
        }
        for (edge, ends) in mesh.edges().iter().enumerate() {
            let own = |(of, face): Key| of == id && has_side(mesh.face_vertices(face as usize), *ends);
            let line = line(ends.map(|end| self.lens.seen(points[end as usize])), self.lens.size);
            let of_line = line.into_iter().map(|(seen, exists)| {
                let is_visible = self.is_visible(seen, own).min(exists);
                OwnPoint { seen, is_visible }
            });
            let of_line = of_line.collect();
            self.edges.push(((id, edge as u32), of_line));
        }
    }

    /// For each element that may be in a region, whether it is; with `through` whatever hides it.
    pub(super) fn region(&self, kind: Kind, shape: &Shape, through: bool) -> BTreeMap<Key, Answer> {
        let mut answers: BTreeMap<Key, Answer> = BTreeMap::new();
        for (key, at, is_visible, is_there) in self.points(kind) {
            let inside = shape.contains(at).min(self.is_in_image(at));
            let answer = inside.min(if through { is_there } else { is_visible });
            let known = answers.entry(key).or_insert(Answer::No);
            *known = answer.max(*known);
        }
        answers.retain(|_, answer| *answer != Answer::No);
        answers
    }

    /// The elements that may be nearest to a place within a radius: more than one where roundings decide.
    pub(super) fn nearest(&self, kind: Kind, place: DVec2, radius: f64, through: bool) -> Vec<Key> {
        let candidates = self.points(kind).filter_map(|(key, at, is_visible, is_there)| {
            let answer = if through { is_there } else { is_visible }.min(self.is_in_image(at));
            let distance = at.distance(place);
            (answer != Answer::No && distance <= radius + ROUNDING).then_some((key, distance, answer))
        });
        let candidates: Vec<(Key, f64, Answer)> = candidates.collect();
        let sure =
            candidates.iter().filter(|(.., answer)| *answer == Answer::Yes).map(|(_, distance, _)| *distance);
        let limit = sure.fold(f64::INFINITY, f64::min) + ROUNDING;
        let mut found: Vec<Key> =
            candidates.into_iter().filter(|found| found.1 <= limit).map(|found| found.0).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// All points by which elements of a kind are found: whether they are seen, and whether they are there at all.
    fn points(&self, kind: Kind) -> Box<dyn Iterator<Item = (Key, DVec2, Answer, Answer)> + '_> {
        let own = |key: Key, point: &OwnPoint| (key, point.seen.at, point.is_visible, Answer::Yes);
        match kind {
            Kind::Vertex => Box::new(self.vertices.iter().map(move |(key, point)| own(*key, point))),
            Kind::Edge => Box::new(
                self.edges
                    .iter()
                    .flat_map(move |(key, points)| points.iter().map(move |point| own(*key, point))),
            ),
            Kind::Face => {
                Box::new(self.faces.iter().map(|face| (face.face, face.at, face.wins, face.covers)))
            }
        }
    }

    fn is_in_image(&self, at: DVec2) -> Answer {
        Answer::of(at.min(self.lens.size - at).min_element(), ROUNDING)
    }
}

/// The index of a mesh, the mesh, and where its vertices are to the camera.
type Object<'s> = (usize, &'s Mesh, Vec<DVec3>);

fn columns(size: DVec2) -> usize {
    size.x as usize / CELL + 1
}

/// The squares that a box lies in; none beside the image.
fn cells_of([min, max]: [DVec2; 2], size: DVec2) -> impl Iterator<Item = usize> {
    let is_beside = max.cmplt(DVec2::ZERO).any() || min.cmpgt(size).any();
    let cell = |at: DVec2| at.clamp(DVec2::ZERO, size).to_array().map(|side| side as usize / CELL);
    let ([left, top], [right, bottom]) = (cell(min), cell(max));
    let rows = (top..=bottom).filter(move |_| !is_beside);
    rows.flat_map(move |row| (left..=right).map(move |column| row * columns(size) + column))
}

fn has_side(around: &[u32], [a, b]: [u32; 2]) -> bool {
    (0..around.len()).any(|i| {
        let side = [around[i], around[(i + 1) % around.len()]];
        side == [a, b] || side == [b, a]
    })
}

/// The own points of an edge: where it crosses the middles of columns, or of rows where it is steeper than 45°.
fn line([start, end]: [Seen; 2], size: DVec2) -> Vec<(Seen, Answer)> {
    let way = end.at - start.at;
    let axis = usize::from(way.x.abs() < way.y.abs());
    let is_open = (way.x.abs() - way.y.abs()).abs() < ROUNDING;
    let between = |share: f64| Seen {
        at: start.at + way * share,
        distance: 1.0 / (1.0 / start.distance + (1.0 / end.distance - 1.0 / start.distance) * share),
    };
    let (low, high) = (start.at[axis].min(end.at[axis]), start.at[axis].max(end.at[axis]));
    let ends_on_middle = [low, high].iter().any(|end| (end - 0.5 - (end - 0.5).round()).abs() < ROUNDING);
    let exists = if is_open || ends_on_middle { Answer::Open } else { Answer::Yes };
    let (first, last) = ((low - 0.5).ceil(), (high - 0.5).floor());
    if first > last {
        return vec![(between(0.5), exists)];
    }
    let pixels = first.max(-1.0) as i64..=last.min(size[axis]) as i64;
    pixels.map(|pixel| (between((pixel as f64 + 0.5 - start.at[axis]) / way[axis]), exists)).collect()
}
