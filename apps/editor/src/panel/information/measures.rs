//! Lengths, angles, areas, volumes, and possible faults of meshes: computed on request.

use trigon_document::mesh::math::{DVec3, elementary};
use trigon_document::modelling::{EditMesh, Inspection, InspectionSettings, VertexId};
use trigon_document::{Document, MeshSelection};

use super::super::row::written;

/// A line of what was measured.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Finding {
    pub(super) name: &'static str,
    pub(super) value: String,
    /// Whether it usually prevents printing or further work.
    pub(super) is_problem: bool,
    /// What a closed body fills in the world, in cubic metres.
    pub(super) filled: Option<f64>,
}

impl Finding {
    fn new(name: &'static str, value: impl Into<String>) -> Self {
        Self { name, value: value.into(), is_problem: false, filled: None }
    }

    fn number(name: &'static str, value: f64, unit: &str) -> Self {
        Self::new(name, format!("{}{unit}", written(value)))
    }

    /// In cubic metres, or in cubic centimetres where there are few.
    fn volume(name: &'static str, value: f64) -> Self {
        if value.abs() < 1e-3 {
            Self::number(name, value * 1e6, " cm³")
        } else {
            Self::number(name, value, " m³")
        }
    }

    /// Something that should not be there.
    fn problem(name: &'static str, count: usize) -> Option<Self> {
        (count > 0).then(|| Self { is_problem: true, ..Self::new(name, count.to_string()) })
    }
}

/// Measures what is selected: elements in edit mode, whole meshes of objects otherwise.
pub(super) fn measured(document: &Document) -> Vec<Finding> {
    let selection = document.selection();
    let mut findings = Vec::new();
    if selection.is_editing() {
        for (id, selected) in selection.meshes().filter(|(_, selected)| !selected.is_empty()) {
            if let Some(mesh) = document.mesh(id) {
                findings.extend(of_elements(document, mesh, selected));
            }
        }
    } else {
        let nodes = document.nodes();
        for (object, node) in selection.objects.iter().filter_map(|&id| Some((id, nodes.node(id)?))) {
            let Some(id) = node.mesh else { continue };
            let enlarged = nodes.world_transform(object).matrix3.determinant().abs();
            findings.push(Finding::new("Object", node.name.clone()));
            match document.mesh(id) {
                Some(mesh) => findings.extend(of_mesh(mesh, enlarged)),
                None => {
                    let mesh = nodes.meshes().get(id).map(|asset| EditMesh::from_mesh(asset.mesh()).0);
                    findings.extend(mesh.iter().flat_map(|mesh| of_mesh(mesh, enlarged)));
                }
            }
        }
    }
    if findings.is_empty() {
        findings.push(Finding::new("Nothing to measure", "select meshes, or elements of one"));
    }
    findings
}

/// Of selected elements: lengths of edges, areas of faces, the distance of two vertices, the angle
/// of three or of two edges.
fn of_elements(document: &Document, mesh: &EditMesh, selected: &MeshSelection) -> Vec<Finding> {
    let kind = document.selection().kind();
    let (edges, faces) = (selected.edges(mesh, kind), selected.faces(mesh, kind));
    let mut findings = Vec::new();
    if !edges.is_empty() {
        let length = edges.iter().map(|&edge| mesh.edge_length(edge)).sum();
        findings.push(Finding::number("Length of edges", length, " m"));
    }
    if let &[edge] = &edges[..]
        && let Some(angle) = mesh.edge_angle(edge)
    {
        findings.push(Finding::number("Angle between its faces", degrees(angle), "°"));
    }
    if !faces.is_empty() {
        let area = faces.iter().map(|&face| mesh.face_area(face)).sum();
        findings.push(Finding::number("Area of faces", area, " m²"));
    }
    findings.extend(of_vertices(mesh, &in_order(document, mesh, selected)));
    findings
}

/// The selected vertices, in the order in which they were selected where that is known.
fn in_order(document: &Document, mesh: &EditMesh, selected: &MeshSelection) -> Vec<VertexId> {
    let vertices = selected.vertices(mesh, document.selection().kind());
    let ordered: Vec<VertexId> = selected.order().iter().map(|&index| VertexId::new(index)).collect();
    let is_whole = ordered.len() == vertices.len() && ordered.iter().all(|vertex| vertices.contains(vertex));
    // Few only: more have neither one distance nor one angle.
    if vertices.len() <= 3 && is_whole { ordered } else { vertices }
}

fn of_vertices(mesh: &EditMesh, vertices: &[VertexId]) -> Option<Finding> {
    let at = |vertex: VertexId| mesh.position(vertex).as_dvec3();
    match *vertices {
        [a, b] => Some(Finding::number("Distance", at(a).distance(at(b)), " m")),
        [a, b, c] => {
            let angle = angle_between(at(a) - at(b), at(c) - at(b))?;
            Some(Finding::number("Angle at the second vertex", degrees(angle), "°"))
        }
        _ => None,
    }
}

/// In degrees, to the digits that angles between faces have.
fn degrees(radians: f64) -> f64 {
    (radians.to_degrees() * 1e4).round() / 1e4
}

/// In radians; `None` without a direction.
fn angle_between(a: DVec3, b: DVec3) -> Option<f64> {
    (a != DVec3::ZERO && b != DVec3::ZERO).then(|| elementary::atan2(a.cross(b).length(), a.dot(b)))
}

/// Of a mesh in its own space; `enlarged` is how many times larger its volume is in the world.
fn of_mesh(mesh: &EditMesh, enlarged: f64) -> Vec<Finding> {
    let inspection = mesh.inspect(&InspectionSettings::default());
    let mut findings = vec![Finding::number("Surface", mesh.surface_area(), " m²")];
    match inspection.volume {
        Some(volume) => findings.extend(of_body(volume, enlarged)),
        None => findings.push(Finding { is_problem: true, ..Finding::new("Watertight", "no") }),
    }
    if inspection.volume.is_some() {
        findings.push(Finding::new("Watertight", "yes"));
    }
    findings.push(Finding::new("Parts", inspection.parts.len().to_string()));
    findings.extend(problems(&inspection));
    findings
}

/// Of a closed body: its volume, also that in the world where this is another one.
fn of_body(volume: f64, enlarged: f64) -> Vec<Finding> {
    let mut findings = vec![Finding::volume("Volume", volume)];
    let in_world = volume * enlarged;
    if (enlarged - 1.0).abs() > 1e-6 {
        findings.push(Finding::volume("Volume in the world", in_world));
    }
    if let Some(last) = findings.last_mut() {
        last.filled = Some(in_world.abs());
    }
    findings
}

/// A weight for people, given in kilograms.
pub(super) fn weight(kilograms: f64) -> String {
    if kilograms < 1.0 {
        format!("{} g", written(kilograms * 1e3))
    } else {
        format!("{} kg", written(kilograms))
    }
}

fn problems(found: &Inspection) -> impl Iterator<Item = Finding> {
    let counts = [
        ("Non-manifold edges", found.non_manifold_edges.len()),
        ("Open borders", found.boundary_loops.len()),
        ("Edges with inconsistent normals", found.inconsistent_edges.len()),
        ("Loose edges", found.loose_edges.len()),
        ("Loose vertices", found.loose_vertices.len()),
        ("Edges without length", found.zero_length_edges.len()),
        ("Faces without area", found.zero_area_faces.len()),
        ("Faces that are not planar", found.non_planar_faces.len()),
        ("Doubled vertices", found.doubled_vertices.len()),
        ("Doubled faces", found.doubled_faces.len()),
        ("Touching faces", found.touching_faces.pairs.len()),
    ];
    counts.into_iter().filter_map(|(name, count)| Finding::problem(name, count))
}
