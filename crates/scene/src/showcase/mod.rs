//! The built-in scene, also used for measurements and tests: the teapot among standard objects on a wooden
//! floor, lit by the sun, a lamp and the sky.

mod floor;

use trigon_camera::{Camera, Projection};
use trigon_math::glam::{Affine2, Mat2};
use trigon_math::{DAffine3, DMat3, DQuat, DVec2, DVec3, Vec2, Vec3, Vec4, color};
use trigon_mesh::Mesh;
use trigon_mesh::primitives::{self, TorusKnot};

use crate::light::Light;
use crate::material::{AlphaMode, Material, Shading, TextureBinding};
use crate::node::Node;
use crate::scene::Scene;
use crate::texture_asset::TextureId;
use crate::transform::Transform;

/// A scene to look at, to measure and to test with: the teapot among standard
/// objects on a wooden floor. It has its own lights, and its own camera, which
/// is composed for images of 1000×600 pixels.
///
/// ```
/// use trigon_scene::{RenderSettings, render, showcase};
///
/// let scene = showcase();
/// let (_, camera) = scene.cameras()[0];
/// let frame = render(&scene, &camera, &RenderSettings::new(100, 60))?;
/// assert_eq!(frame.color.len(), 100 * 60 * 4);
/// # Ok::<(), trigon_scene::RenderError>(())
/// ```
#[must_use]
pub fn showcase() -> Scene {
    let mut scene = Scene::new();
    add_floor(&mut scene);
    let spot = scene.add_texture("spot", floor::spot());
    for exhibit in exhibits() {
        exhibit.add(&mut scene, spot);
    }
    add_lights(&mut scene);
    add_camera(&mut scene);
    scene
}

/// An object that stands on the floor.
struct Exhibit {
    name: &'static str,
    mesh: Mesh,
    /// X and Z of its middle, in metres.
    position: DVec2,
    /// About +Y, in degrees.
    turn: f64,
    /// sRGB, as in a paint program.
    color: [u8; 3],
    shading: Shading,
    /// Half the width and half the depth of its spot on the floor, in metres.
    spot: Vec2,
}

/// What stands on the floor.
fn exhibits() -> Vec<Exhibit> {
    let knot =
        TorusKnot { major_radius: 0.42, minor_radius: 0.19, tube_radius: 0.11, ..TorusKnot::default() };
    let upright = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y));
    vec![
        Exhibit {
            name: "teapot",
            mesh: primitives::teapot(12).transformed(&DAffine3::from_scale(DVec3::splat(0.4))),
            position: DVec2::new(-0.05, 0.65),
            turn: 24.0,
            color: [214, 92, 58],
            shading: glossy(0.6, 80.0),
            spot: Vec2::new(1.25, 1.25),
        },
        Exhibit {
            name: "sphere",
            mesh: primitives::uv_sphere(0.46, 64, 32),
            position: DVec2::new(1.95, 0.35),
            turn: 0.0,
            color: [38, 74, 150],
            shading: glossy(1.2, 250.0),
            spot: Vec2::new(0.7, 0.7),
        },
        Exhibit {
            name: "icosahedron",
            mesh: resting(&primitives::icosahedron(0.72)),
            position: DVec2::new(-2.15, -0.55),
            turn: 10.0,
            color: [28, 140, 138],
            shading: glossy(0.25, 30.0),
            spot: Vec2::new(1.0, 1.0),
        },
        Exhibit {
            name: "dodecahedron",
            mesh: resting(&primitives::dodecahedron(0.33)),
            position: DVec2::new(-1.6, 1.5),
            turn: 32.0,
            color: [226, 164, 52],
            shading: Shading::Lambert,
            spot: Vec2::new(0.7, 0.7),
        },
        Exhibit {
            name: "torus knot",
            mesh: primitives::torus_knot(&knot).transformed(&upright),
            position: DVec2::new(1.4, -1.35),
            turn: -18.0,
            color: [236, 226, 206],
            shading: glossy(0.5, 60.0),
            spot: Vec2::new(0.8, 0.5),
        },
        Exhibit {
            name: "cone",
            mesh: primitives::cone(0.42, 1.15, 64),
            position: DVec2::new(-0.95, -1.7),
            turn: 0.0,
            color: [122, 158, 88],
            shading: Shading::Lambert,
            spot: Vec2::new(0.7, 0.7),
        },
        Exhibit {
            name: "torus",
            mesh: primitives::torus(0.33, 0.13, 64, 24),
            position: DVec2::new(1.4, 1.65),
            turn: 0.0,
            color: [132, 62, 110],
            shading: glossy(0.5, 60.0),
            spot: Vec2::new(0.6, 0.6),
        },
    ]
}

fn glossy(specular: f32, shininess: f32) -> Shading {
    Shading::blinn_phong(Vec3::splat(specular), shininess)
}

impl Exhibit {
    fn add(self, scene: &mut Scene, spot: TextureId) {
        let ground = -self.mesh.bounds().min.y;
        let material = Material::from_color(linear(self.color)).with_shading(self.shading);
        let mut transform = Transform::from_translation(DVec3::new(self.position.x, ground, self.position.y));
        transform.rotate(DVec3::Y, self.turn.to_radians());
        let object = scene.add_object(self.name, self.mesh, material);
        if let Some(node) = scene.node_mut(object) {
            node.transform = transform;
        }
        add_spot(scene, spot, self.position, self.spot);
    }
}

/// The soft dark spot where an object keeps the light of the sky off the floor.
fn add_spot(scene: &mut Scene, texture: TextureId, position: DVec2, reach: Vec2) {
    /// A hair above the floor: high enough to win, too low to be seen.
    const HEIGHT: f64 = 0.002;
    let material = Material {
        base_color: Vec4::new(1.0, 1.0, 1.0, 0.8),
        base_color_texture: Some(TextureBinding::new(texture)),
        shading: Shading::Unlit,
        alpha_mode: AlphaMode::Blend,
        ..Material::default()
    };
    let spot = scene.add_object("spot", primitives::plane(2.0 * reach.x, 2.0 * reach.y), material);
    if let Some(node) = scene.node_mut(spot) {
        node.transform = Transform::from_translation(DVec3::new(position.x, HEIGHT, position.y));
    }
}

fn add_floor(scene: &mut Scene) {
    const RADIUS: f32 = 4.6;
    let texture = scene.add_texture("floor", floor::floor());
    let repeats = 2.0 * RADIUS / floor::METRES;
    // Turned by 30 degrees: fields that run into the depth askew look less like a grid.
    let (sine, cosine) = (0.5, 0.866_025_4);
    let turned = Mat2::from_cols_array(&[cosine, sine, -sine, cosine]) * repeats;
    let binding = TextureBinding { transform: Affine2::from_mat2(turned), ..TextureBinding::new(texture) };
    let material = Material {
        base_color: Vec4::ONE,
        base_color_texture: Some(binding),
        shading: glossy(0.12, 40.0),
        ..Material::default()
    };
    scene.add_object("floor", primitives::disc(RADIUS, 128), material);
}

/// Sun from the upper left, a warm lamp on the right, and the sky.
fn add_lights(scene: &mut Scene) {
    let sky = Light::ambient(0.26).with_color(Vec3::new(0.85, 0.93, 1.0));
    scene.add(Node::from_light(sky).with_name("sky"));
    let sun = Light::directional(0.72).with_color(Vec3::new(1.0, 0.96, 0.88));
    let shining = Camera::look_at(DVec3::new(-3.0, 5.0, 4.0), DVec3::ZERO, DVec3::Y).orientation;
    let from_above =
        Transform::from_scale_rotation_translation(DVec3::ONE, shining, DVec3::new(-3.0, 5.0, 4.0));
    scene.add(Node::from_light(sun).with_name("sun").with_transform(from_above));
    let lamp = Light::point(1.1).with_color(Vec3::new(1.0, 0.82, 0.6));
    scene.add(Node::from_light(lamp).with_name("lamp").at(DVec3::new(2.6, 2.4, 1.2)));
}

fn add_camera(scene: &mut Scene) {
    let projection =
        Projection::perspective(30f64.to_radians(), 0.1, None).expect("the numbers are in range");
    let camera = Camera::look_at(DVec3::new(0.3, 2.55, 6.9), DVec3::new(0.02, 0.42, 0.0), DVec3::Y);
    let transform =
        Transform::from_scale_rotation_translation(DVec3::ONE, camera.orientation, camera.position);
    scene.add(
        Node { camera: Some(Box::new(projection)), ..Node::default() }
            .with_name("camera")
            .with_transform(transform),
    );
}

/// The solid turned so that it lies on its lowest face.
fn resting(solid: &Mesh) -> Mesh {
    let corner =
        |face: usize, index: usize| solid.positions()[solid.face_vertices(face)[index] as usize].as_dvec3();
    let normal = |face| {
        (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0)).normalize_or_zero()
    };
    let downs = (0..solid.face_count()).map(normal);
    let lowest = downs.min_by(|a, b| a.y.total_cmp(&b.y)).unwrap_or(DVec3::NEG_Y);
    solid.transformed(&DAffine3::from_quat(DQuat::from_rotation_arc(lowest, DVec3::NEG_Y)))
}

/// Linear RGB of an sRGB colour.
fn linear(srgb: [u8; 3]) -> Vec3 {
    Vec3::from(srgb.map(color::srgb8_to_linear))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RenderSettings, render};

    #[test]
    fn every_exhibit_stands_on_the_floor() {
        let scene = showcase();
        let visible = scene.visible_transforms();
        let mut standing = 0;
        for (id, node) in scene.nodes().iter() {
            let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
            let lowest = asset.mesh().bounds().transformed(&visible[id.index()].expect("visible")).min.y;
            assert!(lowest.abs() < 0.003, "{} stands at {lowest}", node.name);
            standing += 1;
        }
        assert!(standing > 10, "exhibits, their spots and the floor, not {standing}");
    }

    #[test]
    fn spots_darken_the_floor_and_nothing_else() {
        let mut scene = showcase();
        let camera = scene.cameras()[0].1;
        let settings = RenderSettings::new(100, 60);
        let with = render(&scene, &camera, &settings).expect("drawn");
        scene.nodes_mut().filter(|(_, node)| node.name == "spot").for_each(|(_, node)| node.visible = false);
        let without = render(&scene, &camera, &settings).expect("drawn");
        let pairs = || with.color.iter().zip(&without.color);
        assert!(pairs().all(|(with, without)| with <= without), "nothing is brighter");
        let darker = pairs().filter(|(with, without)| with < without).count();
        assert!(darker > 1000, "{darker} bytes are darker");
    }

    #[test]
    fn solids_lie_on_a_face() {
        for solid in
            [primitives::icosahedron(1.0), primitives::dodecahedron(1.0), primitives::octahedron(1.0)]
        {
            let lying = resting(&solid);
            let floor = lying.bounds().min.y as f32;
            let touching = lying.positions().iter().filter(|at| (at.y - floor).abs() < 1e-5).count();
            assert!(touching >= 3, "a face touches the floor, not {touching} corners");
        }
    }
}
