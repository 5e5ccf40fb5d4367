//! Images that are dropped onto the window: textures of what they are dropped on, or pictures in the scene. Also images to model
//! after.

use std::f64::consts::FRAC_1_SQRT_2;
use std::path::{Path, PathBuf};

use trigon_document::{
    AddMaterial, AddObject, AssignTexture, MaterialName, ObjectName, Rotation, SetMaterial, SetTransform,
    Shape, SurfaceAlpha, SurfaceShading, TextureSource,
};
use trigon_io::{Limits, load_image};
use trigon_window::Stage;
use trigon_window::scene::math::DQuat;

use super::dialog::IMAGES;
use super::editor::{Editor, Message};
use crate::request::{DisplayMode, SolidColor};

/// Of images to model after.
const OPACITY: f32 = 0.5;

/// Turns what lies on the floor to face along +Z: a quarter about x.
const UPRIGHT: DQuat = DQuat::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);

/// Whether a file is an image, by the ending of its name.
pub(super) fn is_image(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    IMAGES.contains(&ending.as_str())
}

impl Editor {
    /// The object under the pointer gets the image as its base colour; where there is none, a picture is added.
    pub(super) fn drop_image(&mut self, stage: &mut Stage, path: PathBuf) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let source = TextureSource::File { path: path.to_string_lossy().into_owned() };
        let under = self.pointer.and_then(|at| stage.pick(at)).map(|(hit, _)| hit.node);
        let scene = self.document.nodes();
        let material = under.and_then(|id| scene.node(id)?.materials.first().copied());
        let material = match (under, material) {
            (_, Some(material)) => Some(MaterialName::of(material)),
            (Some(object), None) => {
                let object = Some(ObjectName::of(object));
                self.run(AddMaterial { object, name, ..AddMaterial::default() }.into());
                None
            }
            (None, None) => {
                self.add_picture(&name, &path);
                None
            }
        };
        if !matches!(self.message, Message::Refusal(_)) || material.is_some() {
            self.run(AssignTexture { material, texture: Some(source), ..AssignTexture::default() }.into());
            self.show_images();
        }
        self.show(stage);
    }

    /// Shows textures, which edges and clay do not.
    pub(super) fn show_images(&mut self) {
        match self.view.display {
            DisplayMode::Solid => self.view.solid = SolidColor::Texture,
            DisplayMode::Wireframe | DisplayMode::Matcap => self.view.display = DisplayMode::Textured,
            DisplayMode::Textured | DisplayMode::Rendered => {}
        }
    }

    /// Adds an image to model after: half transparent, upright, and facing the view if that is a side.
    pub(super) fn add_reference(&mut self, stage: &mut Stage, path: &Path) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.add_picture(&name, path);
        if !matches!(self.message, Message::Refusal(_)) {
            let texture = Some(TextureSource::File { path: path.to_string_lossy().into_owned() });
            self.run(AssignTexture { texture, ..AssignTexture::default() }.into());
            let base_color = Some([1.0, 1.0, 1.0, OPACITY]);
            let look = SetMaterial {
                base_color,
                alpha: Some(SurfaceAlpha::Blend),
                double_sided: Some(true),
                ..SetMaterial::default()
            };
            self.run(look.into());
            let view =
                if stage.orbit.is_orthographic() { stage.camera().orientation } else { DQuat::IDENTITY };
            let xyzw = (view * UPRIGHT).to_array();
            let rotation = Some(Rotation::Quaternion { xyzw });
            self.run(SetTransform { rotation, ..SetTransform::default() }.into());
            self.show_images();
        }
        self.show(stage);
    }

    /// A plane as wide as 2 m and as high as its image, at the 3D cursor, which no light changes.
    fn add_picture(&mut self, name: &str, path: &Path) {
        let image = match load_image(path, &Limits::default()) {
            Ok(image) => image,
            Err(error) => return self.message = Message::Refusal(error.to_string()),
        };
        let depth = 2.0 * image.height as f32 / image.width as f32;
        let object = Shape::Plane { width: 2.0, depth };
        let position = self.tools.cursor.to_array();
        self.run(AddObject { object, name: Some(name.to_owned()), position }.into());
        let (name, shading) = (Some(name.to_owned()), Some(SurfaceShading::Unlit));
        let look = SetMaterial { name, shading, ..SetMaterial::default() };
        self.run(look.into());
    }
}
