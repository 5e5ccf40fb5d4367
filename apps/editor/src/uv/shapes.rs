//! The coordinates themselves: outlines of faces, what is selected, seams, stretch and overlaps by colour.

use trigon_document::mesh::math::{DVec2, Vec3, elementary};
use trigon_document::mesh::triangulate_polygon;
use trigon_document::modelling::{CornerId, EditMesh, FaceId};
use trigon_document::{Document, ElementKind, MeshSelection};
use trigon_window::egui::epaint::{Mesh, Vertex, WHITE_UV};
use trigon_window::egui::{Color32, Painter, Pos2, Shape, Stroke};

use super::canvas::UvCanvas;
use super::picking::{UV_SET, meshes, uv};

const EDGE: Color32 = Color32::from_gray(10);
const SELECTED: Color32 = Color32::from_rgb(255, 153, 0);
const FACE: Color32 = Color32::from_rgba_premultiplied(90, 57, 0, 90);
const OVERLAP: Color32 = Color32::from_rgba_premultiplied(120, 0, 60, 120);
const SEAM: Color32 = Color32::from_rgb(219, 37, 18);

const PINNED: Color32 = Color32::from_rgb(230, 30, 30);

/// Of a vertex, in points.
const DOT: f32 = 2.5;
/// Of a pinned corner.
const PIN: f32 = 4.0;

/// More corners than this take seconds to draw: then only what is selected is.
const MOST_CORNERS: usize = 60_000;

/// What colours faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct UvColors {
    /// From blue, without stretch, to red.
    pub(crate) stretch: bool,
    /// Faces that lie on others.
    pub(crate) overlaps: bool,
}

/// The faces that lie on others, as long as the document is the same.
#[derive(Debug, Default)]
pub(super) struct KnownOverlaps(Option<(u64, Vec<Vec<FaceId>>)>);

impl KnownOverlaps {
    fn of(&mut self, document: &Document) -> &[Vec<FaceId>] {
        let revision = document.revision();
        let known = self.0.take().filter(|(of, _)| *of == revision);
        let found = known.unwrap_or_else(|| {
            (revision, meshes(document).map(|(_, mesh)| mesh.uv_overlaps(UV_SET)).collect())
        });
        &self.0.insert(found).1
    }
}

/// Draws all edited meshes. Returns whether some faces were left out, as there are too many.
pub(super) fn draw(
    painter: &Painter,
    canvas: &UvCanvas,
    document: &Document,
    colors: UvColors,
    overlaps: &mut KnownOverlaps,
) -> bool {
    let corners: usize = meshes(document).map(|(_, mesh)| mesh.corner_count()).sum();
    let all = corners <= MOST_CORNERS;
    let doubled = if colors.overlaps && all { overlaps.of(document) } else { &[] };
    for (number, (id, mesh)) in meshes(document).enumerate() {
        let Some(selection) = document.selection().of(id) else { continue };
        let drawn = Drawn::new(canvas, document, mesh, selection, all);
        let mut fills = Mesh::default();
        if colors.stretch {
            drawn.add_stretch(&mut fills);
        }
        for &face in doubled.get(number).map_or(&[][..], Vec::as_slice) {
            drawn.add_fill(&mut fills, face, OVERLAP);
        }
        drawn.add_selected(&mut fills);
        painter.add(Shape::mesh(fills));
        drawn.draw_lines(painter);
    }
    !all
}

/// One mesh in the canvas.
struct Drawn<'d> {
    canvas: &'d UvCanvas,
    mesh: &'d EditMesh,
    kind: ElementKind,
    faces: Vec<FaceId>,
    selected_vertices: Vec<bool>,
    selected_edges: Vec<bool>,
    selected_faces: Vec<bool>,
}

impl<'d> Drawn<'d> {
    fn new(
        canvas: &'d UvCanvas,
        document: &Document,
        mesh: &'d EditMesh,
        selection: &MeshSelection,
        all: bool,
    ) -> Self {
        let kind = document.selection().kind();
        let bits = |indices: &mut dyn Iterator<Item = u32>, capacity: usize| {
            let mut bits = vec![false; capacity];
            indices.for_each(|index| bits[index as usize] = true);
            bits
        };
        let mut vertices = selection.vertices(mesh, kind).into_iter().map(|vertex| vertex.index());
        let mut edges = selection.edges(mesh, kind).into_iter().map(|edge| edge.index());
        let mut of_faces = selection.faces(mesh, kind).into_iter().map(|face| face.index());
        let selected_faces = bits(&mut of_faces, mesh.face_capacity());
        let is_shown =
            |face: &FaceId| !mesh.is_face_hidden(*face) && (all || selected_faces[face.index() as usize]);
        Self {
            canvas,
            mesh,
            kind,
            faces: mesh.faces().filter(is_shown).collect(),
            selected_vertices: bits(&mut vertices, mesh.vertex_capacity()),
            selected_edges: bits(&mut edges, mesh.edge_capacity()),
            selected_faces,
        }
    }

    fn at(&self, corner: CornerId) -> Pos2 {
        self.canvas.point(uv(self.mesh, corner))
    }

    fn add_selected(&self, fills: &mut Mesh) {
        for &face in &self.faces {
            if self.selected_faces[face.index() as usize] {
                self.add_fill(fills, face, FACE);
            }
        }
    }

    fn add_stretch(&self, fills: &mut Mesh) {
        let scale = self.scale();
        for &face in &self.faces {
            self.add_fill(fills, face, color_of(stretch(self.mesh, face, scale)));
        }
    }

    /// Square metres for the unit of area in the image, on average.
    fn scale(&self) -> f64 {
        let flat: f64 = self.faces.iter().map(|&face| flat_area(self.mesh, face).abs()).sum();
        let curved: f64 = self.faces.iter().map(|&face| self.mesh.face_area(face)).sum();
        curved / flat
    }

    fn add_fill(&self, fills: &mut Mesh, face: FaceId, color: Color32) {
        let corners: Vec<CornerId> = self.mesh.face_corners(face).collect();
        let points: Vec<Vec3> = corners.iter().map(|&at| uv(self.mesh, at).as_vec2().extend(0.0)).collect();
        let first = fills.vertices.len() as u32;
        let vertex = |&corner: &CornerId| Vertex { pos: self.at(corner), uv: WHITE_UV, color };
        fills.vertices.extend(corners.iter().map(vertex));
        fills.indices.extend(triangulate_polygon(&points).into_iter().flatten().map(|at| first + at));
    }

    fn draw_lines(&self, painter: &Painter) {
        let visible = painter.clip_rect();
        // What is selected is drawn over the rest.
        for selected in [false, true] {
            for corner in self.faces.iter().flat_map(|&face| self.mesh.face_corners(face)) {
                let edge = self.mesh.corner_edge(corner);
                let is_selected = match self.kind {
                    // An edge of a selected face lies in other islands, too.
                    ElementKind::Face => self.selected_faces[self.mesh.corner_face(corner).index() as usize],
                    _ => self.selected_edges[edge.index() as usize],
                };
                let line = [self.at(corner), self.at(self.mesh.next_corner(corner))];
                if is_selected == selected
                    && visible.intersects(trigon_window::egui::Rect::from_two_pos(line[0], line[1]))
                {
                    let color = match (is_selected, self.mesh.is_seam(edge)) {
                        (true, _) => SELECTED,
                        (false, true) => SEAM,
                        (false, false) => EDGE,
                    };
                    painter.line_segment(line, Stroke::new(1.0, color));
                }
            }
        }
        if self.kind == ElementKind::Vertex {
            self.draw_vertices(painter);
        }
        self.draw_pins(painter);
    }

    fn draw_pins(&self, painter: &Painter) {
        let corners = self.faces.iter().flat_map(|&face| self.mesh.face_corners(face));
        for corner in corners.filter(|&corner| self.mesh.is_uv_pinned(UV_SET, corner)) {
            painter.circle_filled(self.at(corner), PIN, PINNED);
        }
    }

    fn draw_vertices(&self, painter: &Painter) {
        let visible = painter.clip_rect();
        for corner in self.faces.iter().flat_map(|&face| self.mesh.face_corners(face)) {
            let vertex = self.mesh.corner_vertex(corner);
            let is_selected = self.selected_vertices[vertex.index() as usize];
            let at = self.at(corner);
            if visible.contains(at) {
                painter.circle_filled(at, DOT, if is_selected { SELECTED } else { EDGE });
            }
        }
    }
}

/// The area of a face in the image, with its sign: positive where it is seen from outside, as v grows downwards.
fn flat_area(mesh: &EditMesh, face: FaceId) -> f64 {
    let uvs: Vec<DVec2> = mesh.face_corners(face).map(|corner| uv(mesh, corner)).collect();
    let next = |index: usize| uvs[(index + 1) % uvs.len()];
    -(0..uvs.len()).map(|index| uvs[index].perp_dot(next(index))).sum::<f64>() / 2.0
}

/// From 0, where lengths and angles are those of the surface, to 1, where a face is turned over or has another size by a
/// factor of four: the greatest relative difference of an edge's length.
fn stretch(mesh: &EditMesh, face: FaceId, scale: f64) -> f64 {
    if flat_area(mesh, face) <= 0.0 {
        return 1.0;
    }
    let unit = scale.sqrt();
    let of_edge = |corner: CornerId| {
        let next = mesh.next_corner(corner);
        let flat = uv(mesh, corner).distance(uv(mesh, next)) * unit;
        let [a, b] = [corner, next].map(|corner| mesh.position(mesh.corner_vertex(corner)).as_dvec3());
        let ratio = flat / a.distance(b);
        // 0 for 1, 1 for 4 and for 1/4.
        if ratio.is_finite() && ratio > 0.0 {
            (elementary::ln(ratio) / elementary::ln(4.0)).abs()
        } else {
            1.0
        }
    };
    mesh.face_corners(face).map(of_edge).fold(0.0, f64::max).min(1.0)
}

/// From blue over green to red.
fn color_of(stretch: f64) -> Color32 {
    let [red, green, blue] = [2.0 * stretch - 0.5, 1.0 - (2.0 * stretch - 1.0).abs(), 1.0 - 2.0 * stretch];
    let byte = |value: f64| (value.clamp(0.0, 1.0) * 160.0) as u8;
    Color32::from_rgba_premultiplied(byte(red), byte(green), byte(blue), 160)
}

#[cfg(test)]
mod tests {
    use trigon_document::mesh::primitives;

    use super::*;

    #[test]
    fn stretch_is_nothing_where_lengths_are_those_of_the_surface() {
        let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 2, 2));
        let faces: Vec<FaceId> = mesh.faces().collect();
        mesh.unwrap_faces(&faces, &Default::default()).expect("a flat sheet");
        let flat: f64 = faces.iter().map(|&face| flat_area(&mesh, face)).sum();
        assert!(flat > 0.0, "seen from outside");
        let all =
            |mesh: &EditMesh| faces.iter().map(|&face| stretch(mesh, face, 4.0 / flat)).fold(0.0, f64::max);
        assert!(all(&mesh) < 1e-5, "{}", all(&mesh));
        for corner in mesh.corners().collect::<Vec<_>>() {
            let at = uv(&mesh, corner);
            mesh.set_uv(UV_SET, corner, DVec2::new(2.0 * at.x, at.y).as_vec2());
        }
        assert!((all(&mesh) - 0.5).abs() < 1e-5, "twice as wide: {}", all(&mesh));
        for corner in mesh.corners().collect::<Vec<_>>() {
            let at = uv(&mesh, corner);
            mesh.set_uv(UV_SET, corner, DVec2::new(-at.x, at.y).as_vec2());
        }
        assert_eq!(all(&mesh), 1.0, "turned over");
        assert!(color_of(0.0).b() > 100 && color_of(0.5).g() > 100 && color_of(1.0).r() > 100);
    }
}
