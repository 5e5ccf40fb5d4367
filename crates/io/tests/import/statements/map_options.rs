//! Options of textures.

use trigon_io::Loaded;
use trigon_math::Vec2;
use trigon_scene::{TextureBinding, Wrap};

use super::materials::material;
use super::row::Case::{File, Lines};
use super::row::{Row, left, read};

pub(super) fn rows() -> Vec<Row> {
    let mut rows = placed();
    rows.extend(values());
    rows.extend(malformed());
    rows
}

fn binding(loaded: &Loaded) -> TextureBinding {
    material(loaded).base_color_texture.expect("a texture")
}

/// Where the image's coordinates (0.5, 0.25 upwards) end up, v upwards.
fn place(loaded: &Loaded) -> Vec2 {
    let down = binding(loaded).transform.transform_point2(Vec2::new(0.5, 0.75));
    Vec2::new(down.x, 1.0 - down.y)
}

fn placed() -> Vec<Row> {
    vec![
        read("-s u v w", Lines("map_Kd -s 2 4 1 color.png"), "the texture is repeated so often; w is for images of three dimensions", |loaded| {
            place(loaded) == Vec2::new(1.0, 1.0)
        }),
        read("-s u", Lines("map_Kd -s 2 color.png"), "v keeps 1", |loaded| place(loaded) == Vec2::new(1.0, 0.25)),
        read("-o u v w", Lines("map_Kd -o 0.25 0.5 0 color.png"), "the texture is moved", |loaded| {
            place(loaded) == Vec2::new(0.75, 0.75)
        }),
        read("-clamp on", Lines("map_Kd -clamp on color.png"), "the texture's rim goes on beyond it", |loaded| {
            binding(loaded).sampler.wrap_u == Wrap::ClampToEdge
        }),
        read("-clamp off", Lines("map_Kd -clamp off color.png"), "the texture is repeated", |loaded| {
            binding(loaded).sampler.wrap_u == Wrap::Repeat
        }),
        read(
            "-s, -o or -clamp that map_Kd and map_d, or map_Pr and map_Pm, give differently",
            File("newmtl m\nmap_Kd color.png\n> map_d -s 2 2 2 grey.png"),
            "one texture, placed as the first",
            |loaded| place(loaded) == Vec2::new(0.5, 0.25),
        )
        .says("m.mtl, line 3: texture \"grey.png\" is placed as \"color.png\" is, whatever its options say; give both the same -s, -o and -clamp"),
        drawn("-t u v w", "map_Kd -t 0.1 0 0 color.png", "the texture without turbulence")
            .says("m.mtl, line 2: the options -t 0.1 0 0 of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
        drawn("-t 0 0 0", "map_Kd -t 0 0 0 color.png", "there is no turbulence"),
        drawn("-type sphere", "map_Kd -type sphere color.png", "the texture by texture coordinates")
            .says("m.mtl, line 2: the options -type sphere of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
    ]
}

/// An option without which the texture is the same.
fn drawn(statement: &'static str, case: &'static str, becomes: &'static str) -> Row {
    read(statement, Lines(case), becomes, |loaded| {
        material(loaded).base_color_texture.is_some() && place(loaded) == Vec2::new(0.5, 0.25)
    })
}

fn values() -> Vec<Row> {
    vec![
        read("-bm factor", Lines("bump -bm 0.5 normals.png"), "how steep the bumps of a normal map are", |loaded| {
            material(loaded).normal_map.is_some_and(|map| map.scale == 0.5)
        }),
        drawn("-bm on another map", "map_Kd -bm 0.5 color.png", "it is for bumps only"),
        drawn("-mm base gain", "map_Kd -mm 0.1 0.9 color.png", "the texture as it is")
            .says("m.mtl, line 2: the options -mm 0.1 0.9 of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
        drawn("-mm 0 1", "map_Kd -mm 0 1 color.png", "that is the texture as it is"),
        drawn("-cc on", "map_Kd -cc on color.png", "the texture without correction")
            .says("m.mtl, line 2: the options -cc on of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
        drawn("-cc off", "map_Kd -cc off color.png", "that is how textures are drawn"),
        drawn("-imfchan r | g | b | m | l | z", "map_d -imfchan g grey.png", "alpha, or red if there is none")
            .says("m.mtl, line 2: the options -imfchan g of texture \"grey.png\" are not followed; apply them to the image, and remove them here"),
        drawn("-blendu on, -blendv on", "map_Kd -blendu on -blendv on color.png", "that is how textures are drawn"),
        drawn("-blendu off, -blendv off", "map_Kd -blendu off -blendv off color.png", "the texture is filtered")
            .says("m.mtl, line 2: the options -blendu off, -blendv off of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
        drawn("-boost value", "map_Kd -boost 5 color.png", "the texture is not sharpened")
            .says("m.mtl, line 2: the options -boost 5 of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
        drawn("-texres resolution", "map_Kd -texres 256 color.png", "an image keeps its own resolution"),
        drawn("-colorspace sRGB", "map_Kd -colorspace sRGB color.png", "that is how colours are read (an option of tinyobjloader)"),
        drawn("-colorspace linear", "map_Kd -colorspace linear color.png", "colours are read as sRGB")
            .says("m.mtl, line 2: the options -colorspace linear of texture \"color.png\" are not followed; apply them to the image, and remove them here"),
    ]
}

fn malformed() -> Vec<Row> {
    vec![
        drawn("-s with a word", "map_Kd -s x 2 2 color.png", "the texture, not repeated")
            .says("m.mtl, line 2: the options -s x 2 2 of texture \"color.png\" are malformed and not followed; fix the line, or export the material again"),
        drawn("-o that is not finite", "map_Kd -o nan 0 0 color.png", "the texture, not moved")
            .says("m.mtl, line 2: the options -o nan 0 0 of texture \"color.png\" are malformed and not followed; fix the line, or export the material again"),
        drawn("-clamp yes", "map_Kd -clamp yes color.png", "the texture is repeated")
            .says("m.mtl, line 2: the options -clamp yes of texture \"color.png\" are malformed and not followed; fix the line, or export the material again"),
        left("an unknown option", Lines("map_Kd -foo 1 color.png"), "it is taken as the name's beginning")
            .says("m.mtl, line 2: texture \"-foo 1 color.png\" is not drawn: there is no such file; put the file there, or export the model again with it"),
        left("an option in upper case", Lines("map_Kd -S 2 2 2 color.png"), "it is taken as the name's beginning")
            .says("m.mtl, line 2: texture \"-S 2 2 2 color.png\" is not drawn: there is no such file; put the file there, or export the model again with it"),
        left("an option behind the file", Lines("map_Kd color.png -s 2 2 2"), "it is taken as the name's end")
            .says("m.mtl, line 2: texture \"color.png -s 2 2 2\" is not drawn: there is no such file; put the file there, or export the model again with it"),
    ]
}
