//! Finds the parts of an object that may lie in a small area, and skips all others box by box.

use super::box_culling::BoxCulling;
use super::object::{DrawnTriangles, PickObject};
use super::region::Area;
use super::screen::Screen;
use super::sides::Sides;
use crate::geometry::Blocks;

/// The elements of an object that may lie in an area, each list increasing.
#[derive(Default)]
pub(super) struct SmallRegion {
    pub(super) vertices: Vec<u32>,
    pub(super) edges: Vec<u32>,
    pub(super) triangles: Vec<u32>,
}

impl SmallRegion {
    pub(super) fn new(object: &PickObject<'_>, screen: &Screen, area: &Area<'_>) -> Self {
        let mesh = object.mesh();
        let (mut triangles, mut faces) = (Vec::new(), Vec::new());
        if let Some(drawn) = object.drawn() {
            let blocks = drawn.blocks(mesh);
            triangles = near_triangles(drawn, blocks, screen, area);
            faces.extend(triangles.iter().map(|&triangle| drawn.face(triangle as usize)));
            faces.extend(&blocks.scant_faces);
        }
        let faces = each_once(faces);
        let corners = || faces.iter().flat_map(|&face| mesh.face_corners(face as usize));
        let loose_vertices = mesh.loose_edges().as_flattened().iter().chain(mesh.loose_points()).copied();
        let loose_edges = mesh.face_edge_count() as u32..mesh.edge_count() as u32;
        let vertices = corners().map(|corner| mesh.corner_vertices()[corner]).chain(loose_vertices);
        let edges = corners().filter_map(|corner| mesh.corner_edge(corner)).chain(loose_edges);
        Self { vertices: each_once(vertices.collect()), edges: each_once(edges.collect()), triangles }
    }
}

/// The triangles that may lie in an area.
fn near_triangles(drawn: &DrawnTriangles, blocks: &Blocks, screen: &Screen, area: &Area<'_>) -> Vec<u32> {
    let culling = BoxCulling::new(drawn.map(), screen.half_size(), area);
    let corner = drawn.corners(screen);
    let is_near = |triangle: &usize| {
        !Sides::is_beside(&drawn.triangle(*triangle).map(|at| Sides::of(&corner(at), area)))
    };
    let near = drawn.within(blocks, |block| culling.may_hold(block));
    near.flatten().filter(is_near).map(|triangle| triangle as u32).collect()
}

fn each_once(mut numbers: Vec<u32>) -> Vec<u32> {
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}
