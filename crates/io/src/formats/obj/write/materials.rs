//! The material library that is written beside an OBJ, with its images in their original encoding or as PNG.

use std::collections::BTreeMap;
use std::path::Path;

use trigon_math::Vec3;
use trigon_math::color::linear_to_srgb;
use trigon_scene::{AlphaMode, Material, MaterialTexture, Scene, Shading, TextureBinding, TextureId, Wrap};

use super::{MaterialNames, UniqueNames};
use crate::encode_image::{Pixels, encode_png};
use crate::error::Location;
use crate::export::Loss;
use crate::export::{ExportedFile, Gathered, Precision, plain_name, push_number};
use crate::formats::gltf::mime_type;
use crate::gltf_source::GltfSource;

/// The text of the library.
pub(super) fn write(
    gathered: &mut Gathered<'_>,
    names: &MaterialNames,
    images: &mut ImageFiles<'_>,
) -> String {
    let mut library =
        Library { text: "# written by trigon\n".to_owned(), images, losses: &mut gathered.losses };
    for (id, name) in names {
        let material = id.and_then(|id| gathered.scene.materials.get(id));
        library.material(name, material.unwrap_or(&Material::default()));
    }
    library.text
}

struct Library<'l, 'p> {
    text: String,
    images: &'l mut ImageFiles<'p>,
    losses: &'l mut Vec<Loss>,
}

impl Library<'_, '_> {
    fn material(&mut self, name: &str, material: &Material) {
        self.text += &format!("newmtl {name}\n");
        self.color("Kd", material.base_color.truncate());
        self.numbers("d", &[material.base_color.w.clamp(0.0, 1.0)]);
        self.numbers("Ni", &[material.ior]);
        if material.emissive != Vec3::ZERO {
            self.color("Ke", material.emissive);
        }
        self.shading(&material.shading);
        self.map("map_Kd", "", material.base_color_texture.as_ref());
        if material.alpha_mode != AlphaMode::Opaque {
            self.map("map_d", "", material.base_color_texture.as_ref());
        }
        self.map("map_Ke", "", material.emissive_texture.as_ref());
        if let Some(normal) = &material.normal_map {
            let scale = if normal.scale == 1.0 { String::new() } else { format!(" -bm {}", normal.scale) };
            self.map("norm", &scale, Some(&normal.binding));
        }
        for what in unheld(material) {
            let location = Location::Named(format!("material \"{}\"", material.name));
            self.losses.push(Loss { location, what: what.to_owned() });
        }
    }

    fn shading(&mut self, shading: &Shading) {
        match shading {
            Shading::Unlit => self.text += "illum 0\n",
            Shading::Lambert => self.text += "illum 1\n",
            Shading::BlinnPhong { specular, shininess, specular_texture } => {
                self.text += "illum 2\n";
                self.color("Ks", *specular);
                self.numbers("Ns", &[*shininess]);
                self.map("map_Ks", "", specular_texture.as_ref());
            }
            Shading::MetallicRoughness(model) => {
                self.text += "illum 2\n";
                self.numbers("Pr", &[model.roughness]);
                self.numbers("Pm", &[model.metallic]);
            }
        }
    }

    /// A colour as sRGB, as other programs have it.
    fn color(&mut self, keyword: &str, color: Vec3) {
        self.numbers(keyword, &color.to_array().map(|channel| linear_to_srgb(channel.clamp(0.0, 1.0))));
    }

    fn numbers(&mut self, keyword: &str, values: &[f32]) {
        self.text += keyword;
        for &value in values {
            self.text.push(' ');
            push_number(&mut self.text, value.into(), Precision::Single);
        }
        self.text.push('\n');
    }

    fn map(&mut self, keyword: &str, options: &str, binding: Option<&TextureBinding>) {
        let Some(binding) = binding else { return };
        let Some(file) = self.images.file(binding.texture) else { return };
        let (scale, offset) = (binding.transform.matrix2, binding.transform.translation);
        let mut line = format!("{keyword}{options}");
        let (u, v) = (scale.x_axis.x, scale.y_axis.y);
        if (u, v) != (1.0, 1.0) {
            line += &format!(" -s {u} {v} 1");
        }
        // OBJ counts v upwards.
        let up = 1.0 - v - offset.y;
        if offset.x != 0.0 || up != 0.0 {
            line += &format!(" -o {} {up} 0", offset.x);
        }
        if binding.sampler.wrap_u == Wrap::ClampToEdge {
            line += " -clamp on";
        }
        self.text += &format!("{line} {file}\n");
    }
}

/// What MTL has no statement for.
fn unheld(material: &Material) -> Vec<&'static str> {
    let bindings = [
        material.base_color_texture.as_ref(),
        material.emissive_texture.as_ref(),
        material.normal_map.as_ref().map(|normal| &normal.binding),
    ];
    let any = |has: fn(&TextureBinding) -> bool| bindings.iter().flatten().any(|binding| has(binding));
    let is_turned = |binding: &TextureBinding| {
        let map = binding.transform.matrix2;
        map.x_axis.y != 0.0 || map.y_axis.x != 0.0
    };
    let is_mixed = |binding: &TextureBinding| {
        binding.sampler.wrap_u != binding.sampler.wrap_v || binding.sampler.wrap_u == Wrap::MirroredRepeat
    };
    const WRITTEN: [MaterialTexture; 4] = [
        MaterialTexture::BaseColor,
        MaterialTexture::Highlight,
        MaterialTexture::Emissive,
        MaterialTexture::Normal,
    ];
    /// Named by what they belong to.
    const NAMED: [MaterialTexture; 2] = [MaterialTexture::Occlusion, MaterialTexture::Transmission];
    let has_more_textures =
        material.textures().any(|(slot, _)| !WRITTEN.contains(&slot) && !NAMED.contains(&slot));
    let lost = [
        (has_more_textures, "its textures of metal, roughness and highlights"),
        (material.occlusion.is_some(), "its occlusion"),
        (material.transmission != 0.0, "its transmission"),
        (material.emissive.max_element() > 1.0, "its emission beyond white"),
        (!material.double_sided, "that its back faces are not drawn"),
        (any(|binding| binding.uv_set != 0), "textures on other sets of coordinates"),
        (any(is_turned), "rotations of its textures"),
        (any(is_mixed), "mirrored textures, and other ways for u and v"),
        (
            material.alpha_mode == AlphaMode::Blend && material.base_color.w == 1.0,
            "that its texture is translucent",
        ),
    ];
    lost.into_iter().filter(|(is_lost, _)| *is_lost).map(|(_, what)| what).collect()
}

pub(super) struct ImageFiles<'a> {
    /// What all names begin with, so that none is that of another model's image.
    stem: &'a str,
    scene: &'a Scene,
    source: Option<&'a GltfSource>,
    names: UniqueNames,
    known: BTreeMap<TextureId, String>,
    files: Vec<ExportedFile>,
}

impl<'a> ImageFiles<'a> {
    pub(super) fn new(stem: &'a str, scene: &'a Scene, source: Option<&'a GltfSource>) -> Self {
        let (names, known, files) = Default::default();
        Self { stem, scene, source, names, known, files }
    }

    pub(super) fn into_files(self) -> Vec<ExportedFile> {
        self.files
    }

    /// The name of a texture's file; none if the texture is gone.
    pub(super) fn file(&mut self, id: TextureId) -> Option<String> {
        if let Some(name) = self.known.get(&id) {
            return Some(name.clone());
        }
        let asset = self.scene.textures.get(id)?;
        let origin = self.source.and_then(|source| source.image(source.images(id).next()?));
        let encoded = origin.and_then(|bytes| Some((bytes.to_vec(), ending(mime_type(bytes)?)?)));
        let (bytes, ending) = encoded.unwrap_or_else(|| {
            let texels: Vec<u8> = asset.texture.texels().flatten().collect();
            let mut png = Vec::new();
            let (width, height) = (asset.texture.width(), asset.texture.height());
            encode_png(&mut png, width, height, Pixels::Rgba8(&texels)).expect("memory takes an image");
            (png, "png")
        });
        let own = asset.name.replace('\\', "/");
        let own = Path::new(&own).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let name = self.names.unique(&format!("{}_{}", self.stem, plain_name(&own, "texture")), "texture");
        let name = format!("{name}.{ending}");
        self.files.push(ExportedFile { name: name.clone(), bytes });
        self.known.insert(id, name.clone());
        Some(name)
    }
}

/// The ending of a kind of image that other programs read in an MTL.
fn ending(mime_type: &str) -> Option<&'static str> {
    match mime_type {
        "image/png" => Some("png"),
        "image/jpeg" => Some("jpg"),
        "image/webp" => Some("webp"),
        _ => None,
    }
}
