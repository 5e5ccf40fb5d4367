//! Additional objects shown with the model: a grid, normals and bones as lines, and vertices as
//! balls instead of faces. All of them are geometry of the scene, hidden and lit like any other.

use trigon_math::{Bounds3, DMat3, DVec3, Vec3, Vec4};
use trigon_mesh::{Mesh, MeshBuilder, primitives};
use trigon_scene::{Material, Node, NodeId, Scene, Shading, Transform};

use crate::failure::Failure;

/// What is shown beside the model.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Scenery {
    pub(crate) grid: Grid,
    pub(crate) shows_grid: bool,
    /// The length of lines along normals, as a part of the model's diagonal.
    pub(crate) normals: Option<f64>,
    pub(crate) bones: bool,
    pub(crate) sprites: Option<Sprites>,
}

/// A grid of lines in the plane across the scene's up axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grid {
    /// Side of a square; `None` for a power of ten that suits the model.
    pub(crate) unit: Option<f64>,
    /// Parts of that side.
    pub(crate) subdivisions: u32,
    /// Linear RGB.
    pub(crate) color: Vec3,
    /// Whether it goes through the origin, not below the model.
    pub(crate) absolute: bool,
}

/// Balls in place of faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sprites {
    pub(crate) size: f64,
    /// Whether the size is in metres, not in thousandths of the model's diagonal.
    pub(crate) absolute: bool,
}

/// Vertices beyond this get no balls: they would take gigabytes.
const MOST_SPRITES: usize = 1_000_000;

/// Up to this many, balls are smooth.
const SMOOTH_SPRITES: usize = 20_000;

/// The most lines of a grid in one direction.
const MOST_LINES: f64 = 1000.0;

impl Scenery {
    /// The name of the grid's node.
    pub(crate) const GRID: &str = "grid";

    /// Replaces the model's faces, where that is wanted. To be done before a camera is fitted.
    pub(crate) fn replace(&self, scene: &mut Scene) -> Result<(), Failure> {
        let Some(sprites) = self.sprites else { return Ok(()) };
        let points: Vec<DVec3> = scene.visible_points().filter(|point| point.is_finite()).collect();
        if points.len() > MOST_SPRITES {
            return Err(Failure::work(format!(
                "--point-sprites: the model has {} vertices, and at most {MOST_SPRITES} are drawn as balls; leave it out",
                points.len()
            )));
        }
        let bounds = Bounds3::from_points(points.iter().copied());
        let Some(center) = bounds.center() else { return Ok(()) };
        let unit = if sprites.absolute { 1.0 } else { bounds.size().length() / 1000.0 };
        let ball = primitives::icosphere(1.0, u32::from(points.len() <= SMOOTH_SPRITES));
        let mesh = balls(&points, center, sprites.size * unit * 0.5, &ball);
        let material = scene.materials.iter().next().map(|(id, _)| id);
        let material = material.unwrap_or_else(|| scene.add_material(Material::default()));
        scene.nodes_mut().for_each(|(_, node)| node.mesh = None);
        let mesh = scene.add_mesh("vertices", mesh);
        scene.add(Node::from_mesh(mesh, material).with_name("vertices").at(center));
        Ok(())
    }

    /// Adds lines to a scene; returns their nodes.
    pub(crate) fn add_to(&self, scene: &mut Scene) -> Vec<NodeId> {
        if self.normals.is_none() && !self.bones && !self.shows_grid {
            return Vec::new();
        }
        let bounds = scene.tight_bounds();
        let Some(center) = bounds.center() else { return Vec::new() };
        let diagonal = bounds.size().length();
        let mut added = Vec::new();
        if let Some(length) = self.normals {
            let mesh = normal_lines(scene, center, length * diagonal);
            added.push(add_lines(scene, "normals", mesh, center, Vec3::new(0.0, 0.3, 0.9)));
        }
        if self.bones {
            let mesh = bone_lines(scene, center);
            added.push(add_lines(scene, "bones", mesh, center, Vec3::new(0.9, 0.5, 0.0)));
        }
        if self.shows_grid {
            added.push(self.grid.add_to(scene, &bounds));
        }
        added
    }

    /// Adds the grid of a model to a scene; returns its node.
    #[cfg(feature = "window")]
    pub(crate) fn add_grid(&self, scene: &mut Scene, model: &Scene) -> NodeId {
        self.grid.add_to(scene, &model.tight_bounds())
    }
}

impl Grid {
    fn add_to(&self, scene: &mut Scene, bounds: &Bounds3) -> NodeId {
        // Columns: along the plane, along the plane, up.
        let DMat3 { x_axis: right, y_axis: up, z_axis: front } = scene.up.frame();
        let turned = DMat3::from_cols(right, -front, up);
        let to_plane = turned.transpose();
        let corners = bounds.corners().map(|corner| to_plane * corner);
        let flat = Bounds3::from_points(corners);
        let unit = self.unit.unwrap_or_else(|| suitable_unit(flat.size()));
        let height = if self.absolute { 0.0 } else { flat.min.z };
        let parts = f64::from(self.subdivisions);
        // A square more than the model on either side.
        let starts = [0, 1].map(|axis| (flat.min[axis] / unit).floor() - 1.0);
        let ends = [0, 1].map(|axis| (flat.max[axis] / unit).ceil() + 1.0);
        let counts = [0, 1].map(|axis| ((ends[axis] - starts[axis]) * parts).min(MOST_LINES));
        // Vertices are f32: of a model far from the origin they are counted from a corner of the grid.
        let corner = DVec3::new(starts[0] * unit, starts[1] * unit, height);
        let mesh = grid_lines(counts, unit / parts, &turned);
        add_lines(scene, Scenery::GRID, mesh, turned * corner, self.color)
    }
}

/// The power of ten that gives a model five squares to fifty.
fn suitable_unit(size: DVec3) -> f64 {
    let width = if size.x > size.y { size.x } else { size.y };
    let mut unit = 1.0;
    if !(width.is_finite() && width > 0.0) {
        return unit;
    }
    while unit * 10.0 <= width {
        unit *= 10.0;
    }
    while unit > width {
        unit /= 10.0;
    }
    unit
}

/// Lines along two axes of a plane, at whole numbers of steps from 0 to these.
fn grid_lines([right, far]: [f64; 2], step: f64, turned: &DMat3) -> Mesh {
    let mut builder = MeshBuilder::new();
    let mut line = |from: [f64; 2], to: [f64; 2]| {
        let ends = [from, to].map(|[x, y]| *turned * (DVec3::new(x, y, 0.0) * step));
        push_line(&mut builder, ends[0], ends[1]);
    };
    for x in (0..=right as u32).map(f64::from) {
        line([x, 0.0], [x, far]);
    }
    for y in (0..=far as u32).map(f64::from) {
        line([0.0, y], [right, y]);
    }
    builder.build()
}

/// A line along the normal at each vertex of each visible mesh, relative to a point.
fn normal_lines(scene: &Scene, center: DVec3, length: f64) -> Mesh {
    let mut builder = MeshBuilder::new();
    let visible = scene.visible_transforms();
    for (id, node) in scene.nodes().iter() {
        let Some(world) = visible[id.index()] else { continue };
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        let mesh = asset.mesh();
        let cofactor = world.matrix3.inverse().transpose();
        for (position, normal) in mesh.positions().iter().zip(mesh.vertex_normals()) {
            let foot = world.transform_point3(position.as_dvec3()) - center;
            let Some(direction) = (cofactor * normal.as_dvec3()).try_normalize() else { continue };
            push_line(&mut builder, foot, foot + direction * length);
        }
    }
    builder.build()
}

/// A line from each joint to its parent, if that is a joint, too.
fn bone_lines(scene: &Scene, center: DVec3) -> Mesh {
    let mut builder = MeshBuilder::new();
    let at = |id| scene.world_transform(id).translation - center;
    for (_, skin) in scene.skins.iter() {
        for &joint in &skin.joints {
            let parent = scene.node(joint).and_then(Node::parent);
            if let Some(parent) = parent.filter(|parent| skin.joints.contains(parent)) {
                push_line(&mut builder, at(parent), at(joint));
            }
        }
    }
    builder.build()
}

fn push_line(builder: &mut MeshBuilder, from: DVec3, to: DVec3) {
    let [from, to] = [from, to].map(|end| builder.push_vertex(end.as_vec3()));
    builder.push_loose_edge(from, to).expect("its ends are two vertices");
}

fn add_lines(scene: &mut Scene, name: &str, mesh: Mesh, at: DVec3, color: Vec3) -> NodeId {
    let material = Material {
        base_color: Vec4::new(color.x, color.y, color.z, 1.0),
        shading: Shading::Unlit,
        ..Material::default()
    };
    let id = scene.add_object(name, mesh, material);
    if let Some(node) = scene.node_mut(id) {
        node.transform = Transform::from_translation(at);
    }
    id
}

/// One mesh of balls around points, relative to a point.
fn balls(points: &[DVec3], center: DVec3, radius: f64, ball: &Mesh) -> Mesh {
    let faces = points.len() * ball.face_count();
    let mut builder = MeshBuilder::with_capacity(points.len() * ball.vertex_count(), faces, faces * 3);
    for &point in points {
        let first = builder.vertex_count() as u32;
        for position in ball.positions() {
            builder.push_vertex((point - center + position.as_dvec3() * radius).as_vec3());
        }
        for face in 0..ball.face_count() {
            let vertices: Vec<u32> = ball.face_vertices(face).iter().map(|vertex| first + vertex).collect();
            builder.push_face(&vertices).expect("a face of a ball");
        }
    }
    builder.build()
}

#[cfg(test)]
mod tests {
    use trigon_camera::UpAxis;

    use super::*;

    fn scene() -> Scene {
        let mut scene = Scene::new();
        let node = scene.add_object("cube", primitives::cube(3.0), Material::default());
        scene.node_mut(node).expect("just added").transform =
            Transform::from_translation(DVec3::new(100.0, 20.0, 0.0));
        scene
    }

    fn grid() -> Grid {
        Grid { unit: None, subdivisions: 1, color: Vec3::ZERO, absolute: false }
    }

    fn bounds_of(scene: &Scene, id: NodeId) -> Bounds3 {
        let world = scene.world_transform(id);
        let mesh = scene.node(id).and_then(|node| node.mesh).expect("it has a mesh");
        let positions = scene.meshes().get(mesh).expect("it is there").mesh().positions().to_vec();
        Bounds3::from_points(positions.iter().map(|position| world.transform_point3(position.as_dvec3())))
    }

    #[test]
    fn a_grid_lies_below_the_model_or_at_the_origin() {
        for (grid, expected) in [
            (grid(), (DVec3::new(97.0, 18.5, -3.0), DVec3::new(103.0, 18.5, 3.0))),
            (Grid { absolute: true, ..grid() }, (DVec3::new(97.0, 0.0, -3.0), DVec3::new(103.0, 0.0, 3.0))),
            (
                Grid { unit: Some(10.0), ..grid() },
                (DVec3::new(80.0, 18.5, -20.0), DVec3::new(120.0, 18.5, 20.0)),
            ),
        ] {
            let mut scene = scene();
            let scenery = Scenery { grid, shows_grid: true, ..Scenery::default() };
            let added = scenery.add_to(&mut scene);
            let bounds = bounds_of(&scene, added[0]);
            // Positions are f32, of numbers up to 120.
            assert!(bounds.min.abs_diff_eq(expected.0, 1e-4), "{grid:?}: {bounds:?}");
            assert!(bounds.max.abs_diff_eq(expected.1, 1e-4), "{grid:?}: {bounds:?}");
        }
    }

    /// A model of 5 m, 10⁶ and 10⁷ m from the origin: lines are where whole numbers of units are. In f32 from the
    /// origin they were up to half a metre off, and several fell together.
    #[test]
    fn the_lines_of_a_grid_far_away_are_at_whole_units() {
        for (far, up) in [1e6, -1e7].into_iter().flat_map(|far| [DVec3::Y, DVec3::Z].map(|up| (far, up))) {
            let mut scene = Scene::new();
            scene.up = UpAxis::new(up);
            let node = scene.add_object("cube", primitives::cube(5.0), Material::default());
            scene.node_mut(node).expect("just added").transform =
                Transform::from_translation(DVec3::splat(far));
            let grid = Grid { subdivisions: 4, ..grid() };
            let id = Scenery { grid, shows_grid: true, ..Scenery::default() }.add_to(&mut scene)[0];
            let origin = scene.world_transform(id).translation;
            let mesh = scene.node(id).and_then(|node| node.mesh).expect("it has a mesh");
            let mesh = scene.meshes().get(mesh).expect("it is there").mesh();
            // Between lines there is a quarter of a metre: (8 squares · 4 + 1) lines each way, and ends on whole metres.
            assert_eq!(mesh.edge_count(), 2 * 33, "the model's squares and one on each side");
            let mut points: Vec<[i64; 3]> = Vec::new();
            for position in mesh.positions() {
                let quarters = (origin + position.as_dvec3()) * 4.0;
                let across = if up == DVec3::Y { quarters.y } else { quarters.z };
                assert!((across - (far - 2.5) * 4.0).abs() < 1e-6, "below the model: {across}");
                let nearest = quarters.round();
                // Positions in the world round twice in f64, at up to 4·10⁷ quarters.
                let off = (quarters - nearest).abs().max_element();
                assert!(off < 4.0 * 8.0 * f64::EPSILON * 1e7, "{off} quarters off");
                points.push(nearest.to_array().map(|quarter| quarter as i64));
            }
            points.sort_unstable();
            points.dedup();
            // Each line has ends of its own, but for the four corners.
            assert_eq!(points.len(), 4 * 33 - 4, "no two lines fall together");
        }
    }

    #[test]
    fn a_grid_lies_across_the_up_axis_of_the_scene() {
        for (up, expected) in [
            (DVec3::Z, (DVec3::new(97.0, 17.0, -1.5), DVec3::new(103.0, 23.0, -1.5))),
            (DVec3::NEG_Z, (DVec3::new(97.0, 17.0, 1.5), DVec3::new(103.0, 23.0, 1.5))),
            (DVec3::X, (DVec3::new(98.5, 17.0, -3.0), DVec3::new(98.5, 23.0, 3.0))),
        ] {
            let mut scene = scene();
            scene.up = UpAxis::new(up);
            let scenery = Scenery { grid: grid(), shows_grid: true, ..Scenery::default() };
            let added = scenery.add_to(&mut scene);
            let bounds = bounds_of(&scene, added[0]);
            // Positions are f32, of numbers up to 120.
            assert!(bounds.min.abs_diff_eq(expected.0, 1e-4), "{up}: {bounds:?}");
            assert!(bounds.max.abs_diff_eq(expected.1, 1e-4), "{up}: {bounds:?}");
        }
    }

    #[test]
    fn a_huge_unit_or_a_tiny_one_makes_no_endless_grid() {
        for unit in [1e-9, 1e9] {
            let mut scene = scene();
            let grid = Grid { unit: Some(unit), ..grid() };
            let scenery = Scenery { grid, shows_grid: true, ..Scenery::default() };
            scenery.add_to(&mut scene);
            let lines = scene.meshes().iter().last().expect("the grid").1.mesh().edge_count();
            assert!(lines <= 2 * (MOST_LINES as usize + 1), "{unit}: {lines} lines");
        }
    }

    #[test]
    fn normals_stand_on_the_vertices() {
        let mut scene = scene();
        let scenery = Scenery { normals: Some(0.1), ..Scenery::default() };
        let added = scenery.add_to(&mut scene);
        let bounds = bounds_of(&scene, added[0]);
        // A tenth of 3·√3, along a diagonal of a corner.
        assert!((bounds.size().x - (3.0 + 0.6)).abs() < 1e-5, "{bounds:?}");
    }

    #[test]
    fn balls_take_the_place_of_faces() {
        let mut scene = scene();
        let sprites = Some(Sprites { size: 0.5, absolute: true });
        Scenery { sprites, ..Scenery::default() }.replace(&mut scene).expect("few vertices");
        let faces: usize =
            scene.meshes().iter().last().map(|(_, asset)| asset.mesh().face_count()).expect("balls");
        assert_eq!(faces, 8 * 80, "a ball of 80 faces at each corner");
        let size = scene.tight_bounds().size();
        assert!((size.x - 3.5).abs() < 0.05, "half a metre larger: {size}");
    }
}
