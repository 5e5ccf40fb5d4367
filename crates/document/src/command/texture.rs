//! Textures of materials, by their slots, and laying out texture coordinates.

use std::collections::BTreeMap;
use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_io::{Limits, load_image};
use trigon_mesh::math::{DAffine3, DVec3};
use trigon_modelling::{BoxProjection, PlanarProjection};
use trigon_scene::{
    Material, MeshId, MetallicRoughness, NormalMap, Occlusion, Scene, Shading, Texture, TextureBinding,
    TextureFormat, TextureId,
};

use super::material::named_or_first;
use super::{Action, MaterialName, Outcome, TransformSpace};
use crate::error::EditError;
use crate::state::{AfterEdit, Change};

/// The source of a texture.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "from", rename_all = "snake_case", deny_unknown_fields)]
pub enum TextureSource {
    /// A file: PNG, JPEG or WebP.
    File {
        /// Its path.
        path: String,
    },
    /// A texture that the scene already has.
    Scene {
        /// Its number.
        texture: u32,
    },
}

/// Sets or removes a texture of a material.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AssignTexture {
    /// The material. Default: the first one of the active object.
    pub material: Option<MaterialName>,
    /// The use of the texture.
    pub slot: TextureSlot,
    /// The texture; without one the slot is cleared.
    pub texture: Option<TextureSource>,
    /// The set of texture coordinates that places it, from 0.
    pub uv_set: u32,
}

impl Action for AssignTexture {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let id = named_or_first(change, self.material.as_ref(), "assigning a texture")?;
        let texture = match &self.texture {
            None => None,
            Some(TextureSource::Scene { texture }) => Some(self.known(change.scene(), *texture)?),
            Some(TextureSource::File { path }) => {
                let (name, texture) = self.load(Path::new(path))?;
                Some(change.scene_mut().add_texture(name, texture))
            }
        };
        let binding = texture
            .map(|texture| TextureBinding { uv_set: self.uv_set as usize, ..TextureBinding::new(texture) });
        self.slot.bind(change.scene_mut().materials.get_mut(id).expect("it was just found"), binding);
        Ok(Outcome::silent())
    }
}

impl AssignTexture {
    /// A texture of the scene, if it has the content that the slot needs.
    fn known(&self, scene: &Scene, number: u32) -> Result<TextureId, EditError> {
        let id = scene.textures.id_at(number as usize);
        let id = id.ok_or_else(|| EditError::Texture(format!("there is no texture number {number}")))?;
        let asset = scene.textures.get(id).expect("its id was just found");
        if asset.texture.format() == self.slot.format() {
            return Ok(id);
        }
        let (has, needs) = match self.slot.format() {
            TextureFormat::Srgb => ("data", "colours"),
            TextureFormat::Linear => ("colours", "data"),
        };
        let name = &asset.name;
        Err(EditError::Texture(format!("{name:?} holds {has}, not {needs}; assign its file again")))
    }

    fn load(&self, path: &Path) -> Result<(String, Texture), EditError> {
        let image =
            load_image(path, &Limits::default()).map_err(|error| EditError::Texture(error.to_string()))?;
        let texels =
            image.rgba.chunks_exact(4).map(|texel| [texel[0], texel[1], texel[2], texel[3]]).collect();
        let texture = Texture::new(image.width, image.height, texels, self.slot.format())
            .map_err(|error| EditError::Texture(format!("{}: {error}", path.display())))?;
        let name = path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        Ok((name, texture))
    }
}

/// The use of a texture in a material.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TextureSlot {
    /// Colour and alpha.
    #[default]
    BaseColor,
    /// Green: roughness. Blue: metalness.
    MetallicRoughness,
    /// A normal map.
    Normal,
    /// Red: the fraction of ambient light that arrives.
    Occlusion,
    /// The colour of emitted light.
    Emissive,
}

impl TextureSlot {
    /// Whether its textures hold colours or data.
    pub(super) fn format(self) -> TextureFormat {
        match self {
            Self::BaseColor | Self::Emissive => TextureFormat::Srgb,
            Self::MetallicRoughness | Self::Normal | Self::Occlusion => TextureFormat::Linear,
        }
    }

    /// The texture of a material in this slot.
    #[must_use]
    pub fn of(self, material: &Material) -> Option<TextureBinding> {
        match self {
            Self::BaseColor => material.base_color_texture,
            Self::MetallicRoughness => match material.shading {
                Shading::MetallicRoughness(model) => model.texture,
                Shading::Unlit | Shading::Lambert | Shading::BlinnPhong { .. } => None,
            },
            Self::Normal => material.normal_map.map(|map| map.binding),
            Self::Occlusion => material.occlusion.map(|map| map.binding),
            Self::Emissive => material.emissive_texture,
        }
    }

    pub(super) fn bind(self, material: &mut Material, binding: Option<TextureBinding>) {
        match self {
            Self::BaseColor => material.base_color_texture = binding,
            Self::MetallicRoughness => bind_metallic_roughness(&mut material.shading, binding),
            Self::Normal => {
                let scale = material.normal_map.map_or(1.0, |map| map.scale);
                material.normal_map = binding.map(|binding| NormalMap { binding, scale });
            }
            Self::Occlusion => {
                let strength = material.occlusion.map_or(1.0, |map| map.strength);
                material.occlusion = binding.map(|binding| Occlusion { binding, strength });
            }
            Self::Emissive => material.emissive_texture = binding,
        }
    }
}

fn bind_metallic_roughness(shading: &mut Shading, binding: Option<TextureBinding>) {
    match shading {
        Shading::MetallicRoughness(model) => model.texture = binding,
        // The texture multiplies both.
        _ if binding.is_some() => {
            let model =
                MetallicRoughness { metallic: 1.0, roughness: 1.0, texture: binding, ..Default::default() };
            *shading = Shading::MetallicRoughness(model);
        }
        _ => {}
    }
}

const FACES: &str = "at least one selected face";

/// Projects texture coordinates onto the selected faces, from one side.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectUvs {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// The point at the centre of the image, in metres.
    pub center: [f64; 3],
    /// Towards the viewer.
    pub normal: [f64; 3],
    /// The upward direction in the image.
    pub up: [f64; 3],
    /// The height of the image, in metres.
    pub height: f64,
    /// Its aspect ratio, width divided by height.
    pub aspect: f64,
    /// The space of all of these.
    pub space: TransformSpace,
}

impl Default for ProjectUvs {
    fn default() -> Self {
        let PlanarProjection { center, normal, up, height, aspect } = PlanarProjection::default();
        let space = TransformSpace::Local;
        Self { uv_set: 0, center: center.into(), normal: normal.into(), up: up.into(), height, aspect, space }
    }
}

impl Action for ProjectUvs {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let projection = PlanarProjection {
            center: DVec3::from(self.center),
            normal: DVec3::from(self.normal),
            up: DVec3::from(self.up),
            height: self.height,
            aspect: self.aspect,
        };
        let to_world: BTreeMap<MeshId, DAffine3> = match self.space {
            TransformSpace::Local => BTreeMap::new(),
            TransformSpace::World => {
                let meshes = change.selection().meshes();
                meshes.map(|(id, _)| (id, change.state().mesh_transform(id))).collect()
            }
        };
        let kind = change.selection().kind();
        change.edit_selected_meshes("projecting texture coordinates", FACES, |id, mesh, selection| {
            let map = to_world.get(&id).copied().unwrap_or(DAffine3::IDENTITY);
            let faces = selection.faces(mesh, kind);
            mesh.project_uvs_mapped(&faces, self.uv_set as usize, &projection, &map)?;
            Ok(AfterEdit::Keep)
        })?;
        Ok(Outcome::silent())
    }
}

/// Projects texture coordinates onto the selected faces from the six sides of a box, each face from the side
/// that it faces most.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ProjectUvsOnBox {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: u32,
    /// The point at the centre of each image, in metres.
    pub center: [f64; 3],
    /// The height of the image, in metres.
    pub height: f64,
    /// Its aspect ratio, width divided by height.
    pub aspect: f64,
}

impl Default for ProjectUvsOnBox {
    fn default() -> Self {
        let BoxProjection { center, height, aspect } = BoxProjection::default();
        Self { uv_set: 0, center: center.into(), height, aspect }
    }
}

impl Action for ProjectUvsOnBox {
    fn run(&self, change: &mut Change<'_>) -> Result<Outcome, EditError> {
        let (center, height, aspect) = (DVec3::from(self.center), self.height, self.aspect);
        let projection = BoxProjection { center, height, aspect };
        change.edit_selected_faces("projecting texture coordinates", FACES, |mesh, faces| {
            mesh.project_uvs_on_box(faces, self.uv_set as usize, &projection)
        })?;
        Ok(Outcome::silent())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::tests::commands::try_run as run;
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{AlphaMode, Material, Scene, Shading, Texture};

    fn document() -> Document {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(1.0), Material::default().with_name("plastic"));
        let texture = |format| Texture::new(1, 1, vec![[255; 4]], format).expect("one texel");
        scene.add_texture("colours", texture(TextureFormat::Srgb));
        scene.add_texture("bumps", texture(TextureFormat::Linear));
        Document::new(scene)
    }

    fn material(document: &Document, name: &str) -> Material {
        let materials = document.nodes().materials.iter();
        materials
            .map(|(_, material)| material)
            .find(|material| material.name == name)
            .expect("it exists")
            .clone()
    }

    #[test]
    fn a_material_changes_what_is_given_and_is_undone() {
        let mut document = document();
        let before = material(&document, "plastic");
        run(
            &mut document,
            json!({ "op": "set_material", "material": "plastic", "metallic": 1.0,
            "alpha": "mask", "base_color": [1.0, 0.0, 0.0, 1.0] }),
        )
        .expect("it exists");
        let metal = material(&document, "plastic");
        let Shading::MetallicRoughness(model) = metal.shading else { panic!("it became one: {metal:?}") };
        assert_eq!((model.metallic, model.roughness), (1.0, 0.5), "the other is the usual one");
        assert_eq!(
            (metal.alpha_mode, metal.ior),
            (AlphaMode::Mask { cutoff: 0.5 }, before.ior),
            "glTF's cutoff"
        );
        document.undo().expect("one");
        assert_eq!(material(&document, "plastic"), before, "undone");
        assert!(
            run(&mut document, json!({ "op": "set_material", "material": "gold" })).is_err(),
            "there is none"
        );
    }

    #[test]
    fn a_new_material_takes_a_new_slot_and_a_slot_another_material() {
        let mut document = document();
        run(&mut document, json!({ "op": "add_material", "object": "cube", "name": "gold" }))
            .expect("possible");
        run(&mut document, json!({ "op": "set_material_slot", "object": "cube", "material": "gold" }))
            .expect("possible");
        let (_, cube) = document.nodes().nodes().iter().next().expect("the cube");
        assert_eq!(cube.materials.len(), 2, "a slot more");
        assert_eq!(cube.materials[0], cube.materials[1], "the first shows the new one, too");
    }

    #[test]
    fn an_image_goes_where_its_kind_belongs() {
        let mut document = document();
        let assign = |slot: &str, texture: u32| {
            json!({ "op": "assign_texture", "material": "plastic", "slot": slot,
                "texture": { "from": "scene", "texture": texture } })
        };
        run(&mut document, assign("base_color", 0)).expect("colours");
        run(&mut document, assign("normal", 1)).expect("data");
        let refused = run(&mut document, assign("emissive", 1)).expect_err("data are no colours").to_string();
        assert!(refused.contains("bumps") && refused.contains("colours"), "{refused}");
        let plastic = material(&document, "plastic");
        assert!(
            TextureSlot::BaseColor.of(&plastic).is_some() && TextureSlot::Normal.of(&plastic).is_some(),
            "both"
        );
        run(&mut document, json!({ "op": "assign_texture", "material": "plastic", "slot": "normal" }))
            .expect("off");
        assert_eq!(TextureSlot::Normal.of(&material(&document, "plastic")), None, "taken off");
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/corpus/image/ok_checker.png");
        let from_file = json!({ "op": "assign_texture", "material": "plastic", "slot": "emissive",
            "texture": { "from": "file", "path": file } });
        run(&mut document, from_file).expect("an image");
        let id = TextureSlot::Emissive.of(&material(&document, "plastic")).expect("assigned").texture;
        let asset = document.nodes().textures.get(id).expect("added").clone();
        assert_eq!(
            (asset.name.as_str(), asset.texture.format()),
            ("ok_checker", TextureFormat::Srgb),
            "as colours"
        );
        document.undo().expect("one");
        assert!(document.nodes().textures.get(id).is_none(), "undone with its image");
        let missing = json!({ "op": "assign_texture", "material": "plastic",
            "texture": { "from": "file", "path": "no/such/image.png" } });
        let refused = run(&mut document, missing).expect_err("there is none").to_string();
        assert!(refused.contains("image.png"), "{refused}");
    }

    #[test]
    fn a_texture_of_metalness_leaves_the_factors_of_a_metal_as_they_are() {
        let metal = MetallicRoughness { metallic: 0.25, roughness: 0.75, ..Default::default() };
        let texture = Texture::new(1, 1, vec![[0, 128, 128, 255]], TextureFormat::Linear).expect("one texel");
        let binding = TextureBinding::new(Scene::new().add_texture("metal", texture));
        for (shading, factors) in
            [(Shading::MetallicRoughness(metal), [0.25, 0.75]), (Shading::Lambert, [1.0, 1.0])]
        {
            let mut material = Material { shading, ..Material::default() };
            TextureSlot::MetallicRoughness.bind(&mut material, Some(binding));
            assert_eq!(TextureSlot::MetallicRoughness.of(&material), Some(binding), "{shading:?}");
            let Shading::MetallicRoughness(model) = material.shading else {
                panic!("{shading:?} has no metal")
            };
            assert_eq!([model.metallic, model.roughness], factors, "{shading:?}");
        }
    }
}
