//! Six scenes for another renderer to draw, and what trigon makes of them:
//!
//! `cargo run --release -p trigon-study --example truth -- FOLDER`
//!
//! writes for each scene its meshes as PLY, its image of directions as PNG, what else belongs to it as
//! JSON, and trigon's image as NumPy arrays of linear light. `tests/peers/mitsuba_truth.py FOLDER` draws
//! the same with Mitsuba 3 and compares.

mod scenes;

use scenes::{Truth, all};
use serde_json::{Value, json};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use trigon_io::{ExportOptions, FaceExport, Format, Output, Pixels, export, write_npy, write_png};
use trigon_math::{DQuat, DVec3, Vec3};
use trigon_scene::camera::Projection;
use trigon_scene::{
    Background, LightKind, Lighting, Material, MetalReflection, NodeId, Outputs, RenderSettings, Renderer,
    Scene, Shading, Shadows,
};

const SIZE: [u32; 2] = [360, 240];

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from).ok_or("name a folder to write into")?;
    fs::create_dir_all(&folder)?;
    let described = all().iter().map(|truth| write(truth, &folder)).collect::<Result<Vec<Value>, _>>()?;
    fs::write(folder.join("scenes.json"), serde_json::to_string_pretty(&described)?)?;
    Ok(())
}

/// Writes all files of a scene, and tells what is in them.
fn write(truth: &Truth, folder: &Path) -> Result<Value, Box<dyn Error>> {
    let Truth { name, scene, camera, shadows } = truth;
    let mut objects = Vec::new();
    for (id, node) in scene.nodes().iter().filter(|(_, node)| node.mesh.is_some()) {
        let file = format!("{name}-{}.ply", node.name);
        let options =
            ExportOptions { nodes: Some(vec![id]), faces: FaceExport::Triangles, ..ExportOptions::default() };
        export(scene, &file, Format::Ply, &options)?.write(folder)?;
        let material = scene.materials.get(node.materials[0]).ok_or("each object has a material")?;
        objects.push(json!({ "mesh": file, "surface": surface(scene, material, name, folder)? }));
    }
    let mut images = Vec::new();
    for (suffix, shadows) in shadows {
        let file = format!("{name}{suffix}.npy");
        draw(truth, *shadows, &folder.join(&file))?;
        images.push(json!({ "file": file, "name": format!("{name}{suffix}") }));
    }
    let Projection::Perspective { vertical_fov, .. } = camera.projection else {
        return Err("all cameras are perspective".into());
    };
    Ok(json!({
        "name": name,
        "size": SIZE,
        "camera": {
            "position": camera.position.to_array(),
            "target": (camera.position + camera.forward()).to_array(),
            "up": camera.up().to_array(),
            "vertical_fov": vertical_fov.to_degrees(),
        },
        "objects": objects,
        "lights": scene.nodes().iter().filter_map(|(id, _)| light(scene, id)).collect::<Vec<Value>>(),
        "images": images,
    }))
}

/// Draws the light of a scene with as many samples as there can be.
fn draw(truth: &Truth, shadows: Shadows, file: &Path) -> Result<(), Box<dyn Error>> {
    let mut settings = RenderSettings {
        samples_per_axis: 4,
        samples: 16,
        background: Background::Transparent,
        lighting: Lighting::Scene,
        outputs: Outputs { radiance: true, ..Outputs::default() },
        ..RenderSettings::new(SIZE[0], SIZE[1])
    };
    settings.effects.shadows = shadows;
    settings.effects.metal_reflection = MetalReflection::Ambient;
    let frame = Renderer::new(settings).render(&truth.scene, &truth.camera)?;
    Ok(write_npy(file, &frame, Output::Radiance)?)
}

fn surface(scene: &Scene, material: &Material, name: &str, folder: &Path) -> Result<Value, Box<dyn Error>> {
    let color = material.base_color.truncate().to_array();
    let mut surface = match material.shading {
        Shading::Lambert => json!({ "kind": "lambert", "color": color }),
        Shading::MetallicRoughness(model) => json!({
            "kind": "metallic-roughness",
            "color": color,
            "metallic": model.metallic,
            "roughness": model.roughness,
        }),
        Shading::Unlit | Shading::BlinnPhong { .. } => return Err("no scene has such a surface".into()),
    };
    if let Some(map) = material.normal_map {
        let texture = &scene.textures.get(map.binding.texture).ok_or("the texture is in the scene")?.texture;
        let texels: Vec<u8> = texture.texels().flatten().collect();
        let file = format!("{name}-normals.png");
        write_png(folder.join(&file), texture.width(), texture.height(), Pixels::Rgba8(&texels))?;
        surface["normals"] = json!(file);
    }
    Ok(surface)
}

fn light(scene: &Scene, id: NodeId) -> Option<Value> {
    let light = scene.node(id)?.light.as_ref()?;
    let world = scene.world_transform(id);
    let along = world.transform_vector3(DVec3::NEG_Z).normalize().to_array();
    let place = world.translation.to_array();
    let intensity = light.intensity;
    Some(match light.kind {
        LightKind::Ambient => return None,
        LightKind::Directional => json!({ "kind": "directional", "intensity": intensity, "along": along }),
        LightKind::Point => json!({ "kind": "point", "intensity": intensity, "place": place }),
        LightKind::Spot { inner, outer } => json!({
            "kind": "spot",
            "intensity": intensity,
            "place": place,
            "along": along,
            "inner": inner.to_degrees(),
            "outer": outer.to_degrees(),
        }),
    })
}

/// Turns −Z into a direction.
fn looking(along: DVec3) -> DQuat {
    DQuat::from_rotation_arc(DVec3::NEG_Z, along.normalize())
}

/// The image of directions of a bumpy surface.
fn directions(side: u32) -> Vec<[u8; 4]> {
    let texel = |index: u32| {
        let at = |value: u32| (f64::from(value) + 0.5) / f64::from(side) * std::f64::consts::TAU * 4.0;
        let slope = |place: f64| 0.5 * trigon_math::elementary::sin(place);
        let (x, y) = (slope(at(index % side)), slope(at(index / side)));
        let normal = DVec3::new(x, y, 1.0).normalize().as_vec3();
        let byte = |value: f32| ((value * 0.5 + 0.5) * 255.0).round() as u8;
        let Vec3 { x, y, z } = normal;
        [byte(x), byte(y), byte(z), 255]
    };
    (0..side * side).map(texel).collect()
}
