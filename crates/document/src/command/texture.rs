//! Textures of materials.

use std::path::Path;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_io::{Limits, load_image};
use trigon_scene::{Scene, Texture, TextureBinding, TextureFormat, TextureId};

use super::material::named_or_first;
use super::{Action, MaterialName, Outcome, TextureSlot};
use crate::error::EditError;
use crate::state::Change;

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

#[cfg(test)]
mod tests {
    use serde_json::json;
    use trigon_mesh::primitives;
    use trigon_scene::{AlphaMode, Material, Shading};

    use super::*;
    use crate::document::Document;
    use crate::tests::commands::try_run as run;

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
}
