//! Checks of faces and how they join: inside out, inconsistent winding, non-manifold, without area,
//! with normals that point inwards.

use std::collections::HashMap;

use trigon_math::{DVec3, Vec3};
use trigon_mesh::Mesh;

use super::{Finding, Severity, counted, place};
use crate::scene::Scene;

/// From this number of faces on, a fraction without area counts as a fault.
const SHARE_WITHOUT_AREA: f64 = 0.05;

pub(super) fn check(scene: &Scene, findings: &mut Vec<Finding>) {
    for (id, asset) in scene.meshes().iter() {
        let mesh = asset.mesh();
        if mesh.face_count() == 0 {
            continue;
        }
        let place = place("mesh", &asset.name, id.index());
        let surface = Surface::new(mesh);
        winding(&surface, &place, findings);
        without_area(mesh, &place, findings);
        normals(mesh, &place, findings);
    }
}

/// How the faces of a mesh join.
struct Surface {
    /// Edges of two faces that traverse them in the same direction.
    turned: usize,
    /// Edges of three or more faces.
    crowded: usize,
    /// Volume of the largest closed part with consistent winding; 0 without one.
    volume: f64,
    faces: usize,
}

/// The faces of an edge: the first two with their direction, and their number.
#[derive(Clone, Copy, Default)]
struct EdgeUse {
    faces: [(usize, bool); 2],
    count: usize,
}

impl Surface {
    fn new(mesh: &Mesh) -> Self {
        let points = welded(mesh);
        let mut edges: HashMap<(u32, u32), EdgeUse> = HashMap::new();
        for face in 0..mesh.face_count() {
            for (from, to) in around(mesh, face, &points) {
                let edge = edges.entry((from.min(to), from.max(to))).or_default();
                if let Some(slot) = edge.faces.get_mut(edge.count) {
                    *slot = (face, from < to);
                }
                edge.count += 1;
            }
        }
        let mut parts = Parts::new(mesh.face_count());
        let (mut turned, mut crowded) = (0, 0);
        // The order of the map does not matter: everything in it is counted or joined.
        for edge in edges.values() {
            let [one, other] = edge.faces;
            match edge.count {
                2 if one.1 == other.1 => {
                    turned += 1;
                    parts.open(one.0);
                    parts.join(one.0, other.0);
                }
                2 => parts.join(one.0, other.0),
                1 => parts.open(one.0),
                _ => {
                    crowded += 1;
                    parts.open(one.0);
                    parts.open(other.0);
                }
            }
        }
        Self { turned, crowded, volume: parts.largest_volume(mesh), faces: mesh.face_count() }
    }
}

/// For each vertex the first one at the same position: files split vertices at seams.
fn welded(mesh: &Mesh) -> Vec<u32> {
    let mut first: HashMap<[u32; 3], u32> = HashMap::new();
    let at = |(position, index): (&Vec3, u32)| {
        // . 0 and −0 are the same position.
        let key = position.to_array().map(|coordinate| (coordinate + 0.0).to_bits());
        *first.entry(key).or_insert(index)
    };
    mesh.positions().iter().zip(0..).map(at).collect()
}

/// The edges of a face in its direction, without those of length 0.
fn around<'m>(mesh: &'m Mesh, face: usize, points: &'m [u32]) -> impl Iterator<Item = (u32, u32)> + 'm {
    let vertices = mesh.face_vertices(face);
    let next = vertices.iter().cycle().skip(1);
    let ends = vertices.iter().zip(next).map(|(&from, &to)| (points[from as usize], points[to as usize]));
    ends.filter(|(from, to)| from != to)
}

/// Connected faces.
struct Parts {
    /// For each face another of its part, or itself.
    parents: Vec<usize>,
    /// Whether a face has an edge that closes nothing.
    is_open: Vec<bool>,
}

impl Parts {
    fn new(faces: usize) -> Self {
        Self { parents: (0..faces).collect(), is_open: vec![false; faces] }
    }

    fn root(&mut self, mut face: usize) -> usize {
        while self.parents[face] != face {
            self.parents[face] = self.parents[self.parents[face]];
            face = self.parents[face];
        }
        face
    }

    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        self.parents[one.max(other)] = one.min(other);
    }

    fn open(&mut self, face: usize) {
        self.is_open[face] = true;
    }

    /// The volume of the largest closed part, negative if it is inside out.
    fn largest_volume(&mut self, mesh: &Mesh) -> f64 {
        let faces = self.parents.len();
        let (mut volumes, mut open) = (vec![0.0; faces], vec![false; faces]);
        // Relative to a point of the mesh, so that a distant position costs no digits.
        let origin = mesh.positions().first().copied().unwrap_or_default().as_dvec3();
        for face in 0..faces {
            let root = self.root(face);
            volumes[root] += cone(mesh, face, origin);
            open[root] |= self.is_open[face];
        }
        let closed = volumes.into_iter().zip(open).filter(|(_, open)| !open).map(|(volume, _)| volume);
        closed.fold(0.0, |largest: f64, volume| if volume.abs() > largest.abs() { volume } else { largest })
    }
}

/// Six times the volume between a face and a point: a fan of triangles gives the same as any other
/// triangulation.
fn cone(mesh: &Mesh, face: usize, origin: DVec3) -> f64 {
    let at = |vertex: u32| mesh.positions()[vertex as usize].as_dvec3() - origin;
    let vertices = mesh.face_vertices(face);
    let first = at(vertices[0]);
    vertices[1..].windows(2).map(|pair| first.dot(at(pair[0]).cross(at(pair[1])))).sum()
}

fn winding(surface: &Surface, place: &str, findings: &mut Vec<Finding>) {
    let mut found = |severity, fault, what: String, remedy| {
        findings.push(Finding { severity, fault, place: place.to_owned(), what, remedy });
    };
    if surface.volume < 0.0 {
        let remedy = "flip its faces (in Blender: Mesh, Normals, Recalculate Outside)";
        found(Severity::Error, "inside-out", "its faces point inwards".to_owned(), remedy);
    }
    if surface.turned > 0 {
        let what = format!(
            "its faces are turned against each other along {} (of {})",
            counted(surface.turned, "edge"),
            counted(surface.faces, "face")
        );
        let remedy = "make them face the same way (in Blender: Mesh, Normals, Recalculate Outside)";
        found(Severity::Warning, "mixed-winding", what, remedy);
    }
    if surface.crowded > 0 {
        let what = format!("three faces or more share {}", counted(surface.crowded, "edge"));
        let remedy = "it is not a surface there: remove faces inside it before printing or cutting it";
        found(Severity::Warning, "non-manifold", what, remedy);
    }
}

fn without_area(mesh: &Mesh, place: &str, findings: &mut Vec<Finding>) {
    let is_flat = |&face: &usize| mesh.face_area_vector(face) == DVec3::ZERO;
    let flat = (0..mesh.face_count()).filter(is_flat).count();
    if flat as f64 > SHARE_WITHOUT_AREA * mesh.face_count() as f64 {
        findings.push(Finding {
            severity: Severity::Warning,
            fault: "no-area",
            place: place.to_owned(),
            what: format!("no area: {} of {}", counted(flat, "face"), mesh.face_count()),
            remedy: "merge vertices that lie at the same place",
        });
    }
}

/// Normals of the file compared with the faces.
fn normals(mesh: &Mesh, place: &str, findings: &mut Vec<Finding>) {
    let Some(normals) = &mesh.attributes().corner_normals else { return };
    let (mut useless, mut against) = (0, 0);
    for (face, corners) in mesh.faces().enumerate() {
        let across = mesh.face_area_vector(face);
        for normal in &normals[corners] {
            let is_direction = normal.is_finite() && *normal != Vec3::ZERO;
            useless += usize::from(!is_direction);
            against += usize::from(is_direction && normal.as_dvec3().dot(across) < 0.0);
        }
    }
    let mut found = |fault, what: String, remedy| {
        findings.push(Finding { severity: Severity::Error, fault, place: place.to_owned(), what, remedy });
    };
    if useless * 2 > normals.len() {
        let what = format!("zero or not a number: {} of {}", counted(useless, "normal"), normals.len());
        found("broken-normals", what, "export it without normals, or recalculate them");
    }
    if against * 2 > normals.len() {
        let what = format!(
            "pointing to the back of their faces: {} of {}",
            counted(against, "normal"),
            normals.len()
        );
        found("inverted-normals", what, "it is lit from the wrong side: flip the normals or the faces");
    }
}
