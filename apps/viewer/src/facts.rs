//! `--json`: one line for each input. What is in a model, by which camera it was drawn, and what was
//! written. Why one failed is written by [`stdout`](crate::stdout).
//!
//! Nodes are written one by one as they are visited, so that a scene of a million nodes needs no copy.

use std::path::Path;

use serde::{Serialize, Serializer};
use trigon_camera::{Camera, FisheyeLens, PixelCenters, Projection, Viewport};
use trigon_math::{DAffine3, DMat4};
use trigon_scene::{AlphaMode, LightReading, Material, MaterialId, Node, NodeId, Scene};

use crate::model::{Model, Summary};

/// What is in a model.
#[derive(Serialize)]
pub(crate) struct ModelFacts<'a> {
    file: Option<String>,
    vertices: usize,
    edges: usize,
    faces: usize,
    nodes: usize,
    materials: usize,
    textures: usize,
    size: [f64; 3],
    center: Option<[f64; 3]>,
    scenes: &'a [String],
    variants: &'a [String],
    light: Option<LightFacts>,
    animations: Vec<AnimationFacts<'a>>,
    node_list: NodeList<'a>,
    material_list: Vec<MaterialFacts<'a>>,
}

/// What a light meter reads in it.
#[derive(Serialize)]
struct LightFacts {
    white: f32,
    stops: f32,
    in_range: bool,
}

#[derive(Serialize)]
struct AnimationFacts<'a> {
    name: &'a str,
    seconds: f64,
}

#[derive(Serialize)]
struct MaterialFacts<'a> {
    id: usize,
    name: &'a str,
    /// Linear red, green, blue, and alpha.
    base_color: [f32; 4],
    alpha_mode: &'static str,
}

/// A node, by the number that the output `object-ids` holds for it.
#[derive(Serialize)]
struct NodeFacts<'a> {
    id: usize,
    name: &'a str,
    parent: Option<usize>,
    visible: bool,
    /// From the node's space to the world, by columns, as in glTF.
    matrix: [f64; 16],
    mesh: Option<&'a str>,
    /// The ids of the materials of its mesh's slots.
    materials: Vec<usize>,
}

/// The nodes of a scene, each after its parent.
struct NodeList<'a>(&'a Scene);

/// A node on the path to the current one.
struct Ancestor {
    id: NodeId,
    to_world: DAffine3,
    visible: bool,
}

impl<'a> ModelFacts<'a> {
    /// `summary` is that of the model before anything was added to show it: the list of nodes also holds
    /// what was added, because the image's ids do.
    pub(crate) fn new(model: &'a Model, summary: &Summary) -> Self {
        let scene = &model.scene;
        let animations = scene.animations.iter();
        Self {
            file: model.source.first_file().map(|file| file.to_string_lossy().into_owned()),
            vertices: summary.vertices,
            edges: summary.edges,
            faces: summary.faces,
            nodes: summary.nodes,
            materials: summary.materials,
            textures: summary.textures,
            size: summary.size.to_array(),
            center: model.center().map(|center| center.to_array()),
            scenes: &model.scene_names,
            variants: &model.variant_names,
            light: scene.light_reading().map(LightFacts::new),
            animations: animations
                .map(|animation| AnimationFacts { name: &animation.name, seconds: animation.duration() })
                .collect(),
            node_list: NodeList(scene),
            material_list: scene
                .materials
                .iter()
                .map(|(id, material)| MaterialFacts::new(id, material))
                .collect(),
        }
    }
}

impl LightFacts {
    fn new(reading: LightReading) -> Self {
        Self { white: reading.white, stops: reading.stops, in_range: reading.is_in_range() }
    }
}

impl<'a> MaterialFacts<'a> {
    fn new(id: MaterialId, material: &'a Material) -> Self {
        let alpha_mode = match material.alpha_mode {
            AlphaMode::Opaque => "opaque",
            AlphaMode::Mask { .. } => "mask",
            AlphaMode::Blend => "blend",
        };
        Self { id: id.index(), name: &material.name, base_color: material.base_color.to_array(), alpha_mode }
    }
}

impl Serialize for NodeList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut path: Vec<Ancestor> = Vec::new();
        serializer.collect_seq(self.0.tree().into_iter().filter_map(|(id, depth)| {
            path.truncate(depth);
            let node = self.0.node(id)?;
            let (to_parent, shown) =
                path.last().map_or((DAffine3::IDENTITY, true), |parent| (parent.to_world, parent.visible));
            let ancestor = Ancestor {
                id,
                to_world: to_parent * node.transform.to_affine(),
                visible: shown && node.visible,
            };
            let facts = self.facts(node, &ancestor, path.last());
            path.push(ancestor);
            Some(facts)
        }))
    }
}

impl<'a> NodeList<'a> {
    fn facts(&self, node: &'a Node, ancestor: &Ancestor, parent: Option<&Ancestor>) -> NodeFacts<'a> {
        NodeFacts {
            id: ancestor.id.index(),
            name: &node.name,
            parent: parent.map(|parent| parent.id.index()),
            visible: ancestor.visible,
            matrix: DMat4::from(ancestor.to_world).to_cols_array(),
            mesh: node.mesh.and_then(|mesh| self.0.meshes().get(mesh)).map(|mesh| mesh.name.as_str()),
            materials: node.materials.iter().map(|material| material.index()).collect(),
        }
    }
}

/// A camera, in the frame of the file.
#[derive(Serialize)]
pub(crate) struct CameraFacts {
    /// Where the eye is.
    position: [f64; 3],
    /// From the camera's space (looking along −Z, +Y up) to the world: a unit quaternion x, y, z, w.
    rotation: [f64; 4],
    projection: &'static str,
    /// From the lower to the upper edge of a perspective view, in degrees.
    vertical_fov: Option<f64>,
    /// The same in radians, which gives back the camera to the bit.
    vertical_fov_radians: Option<f64>,
    /// The height of a parallel view, in the units of the file.
    view_height: Option<f64>,
    /// Left, right, bottom and top of a view off the centre, on the near plane.
    frustum: Option<[f64; 4]>,
    near: f64,
    /// `null` is at infinity.
    far: Option<f64>,
    /// By rows; Y down, Z forward, the centre of the first pixel at (0.5, 0.5). `null` for a parallel view.
    #[serde(rename = "K")]
    intrinsics: Option<[[f64; 3]; 3]>,
    /// The coefficients of a fisheye lens, and the full angle that it shows, in radians.
    #[serde(skip_serializing_if = "Option::is_none")]
    fisheye: Option<[f64; 4]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fov_radians: Option<f64>,
}

impl CameraFacts {
    pub(crate) fn new(camera: &Camera, lens: Option<&FisheyeLens>, image: Viewport) -> Self {
        let projection = camera.projection;
        let intrinsics = match lens {
            Some(lens) => Some(lens.intrinsics(image, PixelCenters::AtHalves)),
            None => projection.intrinsics(image, PixelCenters::AtHalves),
        };
        let (mut vertical_fov, mut view_height, mut frustum) = (None, None, None);
        let projection_name = match projection {
            _ if lens.is_some() => "fisheye",
            Projection::Perspective { vertical_fov: angle, .. } => {
                vertical_fov = Some(angle);
                "perspective"
            }
            Projection::Orthographic { height: whole, .. } => {
                view_height = Some(whole);
                "orthographic"
            }
            Projection::Frustum { left, right, bottom, top, .. } => {
                frustum = Some([left, right, bottom, top]);
                "frustum"
            }
            Projection::Pinhole { .. } => "pinhole",
        };
        Self {
            position: camera.position.to_array(),
            rotation: camera.orientation.to_array(),
            projection: projection_name,
            vertical_fov: vertical_fov.map(f64::to_degrees),
            vertical_fov_radians: vertical_fov,
            view_height,
            frustum,
            near: projection.near(),
            far: projection.far(),
            intrinsics: intrinsics
                .map(|k| [[k.focal.x, 0.0, k.center.x], [0.0, k.focal.y, k.center.y], [0.0, 0.0, 1.0]]),
            fisheye: lens.map(FisheyeLens::distortion),
            fov_radians: lens.map(|lens| 2.0 * lens.greatest_angle()),
        }
    }
}

/// What was drawn of a model, and where it was written.
#[derive(Serialize)]
pub(crate) struct ImageFacts<'a> {
    #[serde(flatten)]
    pub(crate) model: ModelFacts<'a>,
    /// `None` for a series of images.
    #[serde(flatten)]
    pub(crate) drawing: Option<DrawingFacts>,
    /// The images of a series; empty for a single one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) views: Vec<ViewFacts>,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) load_seconds: f64,
    pub(crate) written: Vec<String>,
}

/// How one image was drawn.
#[derive(Serialize)]
pub(crate) struct DrawingFacts {
    pub(crate) camera: CameraFacts,
    /// What is to be added to the output of positions, if it was asked for.
    pub(crate) positions_origin: Option<[f64; 3]>,
    pub(crate) draw_seconds: f64,
    pub(crate) pixels_shaded: u64,
    /// How far the image is from that of `--reference`.
    pub(crate) error: Option<f64>,
}

/// How one image of a series was drawn.
#[derive(Serialize)]
pub(crate) struct ViewFacts {
    /// The number in its name, from 0.
    pub(crate) frame: u32,
    /// The name of its camera.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub(crate) name: String,
    pub(crate) camera: CameraFacts,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) positions_origin: Option<[f64; 3]>,
    pub(crate) draw_seconds: f64,
    pub(crate) pixels_shaded: u64,
    pub(crate) written: Vec<String>,
    /// Why a part of it, or all, is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) failure: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) exit_code: Option<u8>,
}

impl ViewFacts {
    /// Of a view that is not drawn yet.
    pub(crate) fn new(frame: u32, name: &str, camera: CameraFacts, image: Viewport) -> Self {
        Self {
            frame,
            name: name.to_owned(),
            camera,
            width: image.width,
            height: image.height,
            positions_origin: None,
            draw_seconds: 0.0,
            pixels_shaded: 0,
            written: Vec::new(),
            failure: None,
            exit_code: None,
        }
    }
}

/// The names of files as text.
pub(crate) fn names<P: AsRef<Path>>(files: &[P]) -> Vec<String> {
    files.iter().map(|file| file.as_ref().to_string_lossy().into_owned()).collect()
}
