//! G G: sliding along edges. The vertex nearest to the pointer determines the scale between screen and edge.

use trigon_document::mesh::math::{DAffine3, DVec2, DVec3};
use trigon_document::modelling::{EditMesh, VertexId};
use trigon_document::scene::MeshId;
use trigon_document::{Document, ElementKind, SlideEdges};

use super::selected::placed;
use super::view::ToolView;

/// The vectors with which the pointer's movement is compared.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Slide {
    /// Whether whole loops of edges slide, rather than vertices each along an edge.
    pub(super) edges: bool,
    /// In the image, from the nearest vertex: to the end on the side of positive factors, and on the
    /// other one.
    ways: [DVec2; 2],
    /// Where vertices may go, in the world, and that in the image.
    directions: Vec<(DVec3, DVec2)>,
}

impl Slide {
    /// For what is selected, which is where it was at the start.
    pub(crate) fn of(document: &mut Document, view: &ToolView, position: DVec2) -> Self {
        let edges = document.selection().kind() != ElementKind::Vertex;
        let none = Self { edges, ways: [DVec2::ZERO; 2], directions: Vec::new() };
        let Some((id, vertex)) = nearest_vertex(document, view, position) else { return none };
        let to_world = document.mesh_transform(id);
        if edges {
            return Self { ways: both_ways(document, id, vertex, view, &to_world), ..none };
        }
        let directions = document.mesh(id).map(|mesh| directions(mesh, vertex, view, &to_world));
        Self { directions: directions.unwrap_or_default(), ..none }
    }

    /// The factor for a movement of the pointer and, for vertices, the direction in the world.
    pub(super) fn follow(&self, way: DVec2) -> (f64, DVec3) {
        if self.edges {
            let [left, right] = self.ways.map(|end| part(way, end));
            return (if left >= right { left.min(1.0) } else { -right.min(1.0) }, DVec3::ZERO);
        }
        let nearest = self.directions.iter().map(|&(world, screen)| (part(way, screen), world, screen));
        // The one along which the pointer went farthest in the image.
        let farthest = nearest.max_by(|a, b| {
            let along = |(_, _, screen): &(f64, DVec3, DVec2)| way.dot(screen.normalize_or_zero());
            along(a).total_cmp(&along(b))
        });
        farthest.map_or((0.0, DVec3::ZERO), |(part, world, _)| (part.clamp(0.0, 1.0), world))
    }
}

/// The fraction of the way to an end; 0 for an end that is drawn at the same position.
fn part(way: DVec2, end: DVec2) -> f64 {
    let part = way.dot(end) / end.length_squared();
    if part.is_finite() { part.max(0.0) } else { 0.0 }
}

fn nearest_vertex(document: &Document, view: &ToolView, position: DVec2) -> Option<(MeshId, VertexId)> {
    let kind = document.selection().kind();
    let mut nearest: Option<(f64, MeshId, VertexId)> = None;
    for (id, selection) in document.selection().meshes() {
        let Some(mesh) = document.mesh(id) else { continue };
        let to_world = document.mesh_transform(id);
        for vertex in selection.vertices(mesh, kind) {
            let Some(screen) = view.screen(placed(mesh, vertex, &to_world)) else { continue };
            let distance = screen.distance(position);
            if nearest.is_none_or(|(least, ..)| distance < least) {
                nearest = Some((distance, id, vertex));
            }
        }
    }
    nearest.map(|(_, id, vertex)| (id, vertex))
}

/// Where a vertex of a loop would go, found by trying out both ends.
fn both_ways(
    document: &mut Document,
    id: MeshId,
    vertex: VertexId,
    view: &ToolView,
    to_world: &DAffine3,
) -> [DVec2; 2] {
    let screen = |document: &Document| view.screen(placed(document.mesh(id)?, vertex, to_world));
    let Some(start) = screen(document) else { return [DVec2::ZERO; 2] };
    [1.0, -1.0].map(|factor| {
        let end = document.preview(SlideEdges { factor }.into()).ok().and_then(|_| screen(document));
        document.cancel();
        end.map_or(DVec2::ZERO, |end| end - start)
    })
}

fn directions(
    mesh: &EditMesh,
    vertex: VertexId,
    view: &ToolView,
    to_world: &DAffine3,
) -> Vec<(DVec3, DVec2)> {
    let start = placed(mesh, vertex, to_world);
    let ends = mesh.vertex_edges(vertex).map(|edge| placed(mesh, mesh.other_vertex(edge, vertex), to_world));
    ends.filter_map(|end| Some((end - start, view.screen(end)? - view.screen(start)?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_measured_against_the_nearer_side() {
        let slide =
            Slide { edges: true, ways: [DVec2::X * 100.0, DVec2::NEG_X * 50.0], directions: Vec::new() };
        assert_eq!(slide.follow(DVec2::new(25.0, 9.0)).0, 0.25, "a quarter to the left");
        assert_eq!(slide.follow(DVec2::new(-25.0, 9.0)).0, -0.5, "half of a shorter way");
        assert_eq!(slide.follow(DVec2::new(900.0, 0.0)).0, 1.0, "not beyond the end");
    }

    #[test]
    fn vertices_choose_the_edge_along_which_the_pointer_goes() {
        let directions = vec![(DVec3::X, DVec2::X * 10.0), (DVec3::Y, DVec2::NEG_Y * 100.0)];
        let slide = Slide { edges: false, ways: [DVec2::ZERO; 2], directions };
        assert_eq!(slide.follow(DVec2::new(5.0, -50.0)), (0.5, DVec3::Y), "upwards");
        assert_eq!(slide.follow(DVec2::new(5.0, 50.0)), (0.5, DVec3::X), "rightwards");
    }
}
