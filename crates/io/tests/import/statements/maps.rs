//! Textures: what each is for, and images that are not there.

use trigon_io::Loaded;
use trigon_scene::{AlphaMode, Shading};

use super::materials::material;
use super::row::Case::{File, Lines};
use super::row::{Row, left, read};

pub(super) fn rows() -> Vec<Row> {
    let mut rows = drawn();
    rows.extend(bumps());
    rows.extend(not_drawn());
    rows.extend(files());
    rows
}

fn has_base_color(loaded: &Loaded) -> bool {
    material(loaded).base_color_texture.is_some()
}

fn has_normal_map(loaded: &Loaded) -> bool {
    material(loaded).normal_map.is_some()
}

fn has_metallic_roughness(loaded: &Loaded) -> bool {
    matches!(material(loaded).shading, Shading::MetallicRoughness(model) if model.texture.is_some())
}

fn drawn() -> Vec<Row> {
    vec![
        read("map_Kd file", Lines("map_Kd color.png"), "the base colour's texture", has_base_color),
        read("map_Ks file", Lines("map_Ks color.png"), "the highlight's texture", |loaded| {
            matches!(material(loaded).shading, Shading::BlinnPhong { specular_texture: Some(_), .. })
        }),
        left(
            "map_Ks beside Pr or Pm",
            File("newmtl m\nPr 0.5\n> map_Ks color.png"),
            "roughness and metal set the highlight",
        )
        .says("m.mtl, line 3: map_Ks \"color.png\" is not drawn beside Pr or Pm; write map_Pm instead"),
        left(
            "map_Ks beside illum 0 or 1",
            File("newmtl m\nillum 1\n> map_Ks color.png"),
            "illum 1 has no highlight",
        ),
        read(
            "map_Ke file",
            Lines("map_Ke color.png"),
            "the texture of light that the surface sends out",
            |loaded| material(loaded).emissive_texture.is_some(),
        ),
        read(
            "map_d file",
            Lines("map_d grey.png"),
            "holes where the image's alpha is below a half, or its red if it has no alpha; with d below 1, opacity",
            |loaded| has_base_color(loaded) && material(loaded).alpha_mode == AlphaMode::Mask { cutoff: 0.5 },
        ),
        read("map_Pr file", Lines("map_Pr grey.png"), "a texture of roughness", has_metallic_roughness),
        read("map_Pm file", Lines("map_Pm grey.png"), "a texture of metal", has_metallic_roughness),
        left(
            "Ks 0 0 0 beside map_Ks",
            File("newmtl m\nmap_Ks color.png\n> Ks 0 0 0"),
            "white: exporters write black where the image is to be seen as it is",
        ),
        left("Ke 0 0 0 beside map_Ke", File("newmtl m\nmap_Ke color.png\n> Ke 0 0 0"), "white, likewise"),
        left(
            "Pr 0 beside map_Pr, Pm 0 beside map_Pm",
            File("newmtl m\nmap_Pm grey.png\n> Pm 0"),
            "1, likewise",
        ),
        read("map_KD file", Lines("map_KD color.png"), "the statement: case does not matter", has_base_color),
        read("map_Kd given twice", Lines("map_Kd gone.png\nmap_Kd color.png"), "the last", has_base_color)
            .says(
                "m.mtl, line 3: map_Kd is given twice in a material, and the last counts; remove one of them",
            ),
    ]
}

fn bumps() -> Vec<Row> {
    const HEIGHTS: &str = "m.mtl, line 2: image \"heights.png\" is left out: it is a height map, which is not drawn; only normal maps are; bake it into a normal map, and name that with norm";
    vec![
        read("norm file", Lines("norm normals.png"), "a normal map", has_normal_map),
        read(
            "bump file, of directions",
            Lines("bump normals.png"),
            "a normal map: many exporters write one so",
            has_normal_map,
        ),
        read("map_Bump file, of directions", Lines("map_Bump normals.png"), "the same", has_normal_map),
        left("bump file, of heights", Lines("bump heights.png"), "heights are not drawn").says(HEIGHTS),
        left("map_Bump file, of heights", Lines("map_Bump heights.png"), "heights are not drawn")
            .says(HEIGHTS),
        left(
            "bump beside norm",
            File("newmtl m\nnorm normals.png\n> bump heights.png"),
            "norm says it better",
        )
        .says("m.mtl, line 3: bump \"heights.png\" is not drawn beside norm; put both into one normal map"),
        left(
            "bump beside norm, of the same file",
            File("newmtl m\nnorm normals.png\n> bump normals.png"),
            "norm says it",
        ),
    ]
}

fn not_drawn() -> Vec<Row> {
    let bake = |statement: &'static str, case: &'static str, message: &'static str| {
        left(statement, Lines(case), "it is not drawn").says(message)
    };
    vec![
        left(
            "map_Ka of the file of map_Kd",
            File("newmtl m\nmap_Kd color.png\n> map_Ka color.png"),
            "map_Kd answers ambient light",
        ),
        bake(
            "map_Ka of another file",
            "map_Ka color.png",
            "m.mtl, line 2: map_Ka \"color.png\" is not drawn; bake it into map_Kd if it matters",
        ),
        bake(
            "map_Ns file",
            "map_Ns grey.png",
            "m.mtl, line 2: map_Ns \"grey.png\" is not drawn; write Ns, or map_Pr with an image of roughness",
        ),
        bake(
            "map_Tr file",
            "map_Tr grey.png",
            "m.mtl, line 2: map_Tr \"grey.png\" is not drawn; write map_d, with the image inverted if it shows transparency",
        ),
        bake(
            "map_Ps file",
            "map_Ps grey.png",
            "m.mtl, line 2: map_Ps \"grey.png\" is not drawn; bake the effect into map_Kd if it matters",
        ),
        bake(
            "map_RMA file",
            "map_RMA color.png",
            "m.mtl, line 2: map_RMA \"color.png\" is not drawn; split the image into map_Pr and map_Pm",
        ),
        bake(
            "map_ORM file",
            "map_ORM color.png",
            "m.mtl, line 2: map_ORM \"color.png\" is not drawn; split the image into map_Pr and map_Pm",
        ),
        bake(
            "map_ and anything else",
            "map_snow grey.png",
            "m.mtl, line 2: map_snow \"grey.png\" is not drawn; bake the effect into map_Kd if it matters",
        ),
        bake(
            "disp file",
            "disp heights.png",
            "m.mtl, line 2: disp \"heights.png\" is not drawn; displace the mesh before exporting it",
        ),
        bake(
            "decal file",
            "decal grey.png",
            "m.mtl, line 2: decal \"grey.png\" is not drawn; bake the effect into map_Kd if it matters",
        ),
        bake(
            "refl -type sphere file",
            "refl -type sphere color.png",
            "m.mtl, line 2: refl \"color.png\" is not drawn; light the model with an environment image instead",
        ),
        bake(
            "refl -type cube_top file",
            "refl -type cube_top color.png",
            "m.mtl, line 2: refl \"color.png\" is not drawn; light the model with an environment image instead",
        ),
        left("map_aat on", Lines("map_aat on"), "textures are always filtered"),
    ]
}

fn files() -> Vec<Row> {
    vec![
        left("map_Kd of a missing file", Lines("map_Kd gone.png"), "the colour alone is drawn")
            .says("m.mtl, line 2: texture \"gone.png\" is not drawn: there is no such file; put the file there, or export the model again with it"),
        read("map_Kd of a file that is no image", Lines("map_Kd a.obj"), "a checkerboard that nobody overlooks", has_base_color)
            .says("m.mtl, line 2: image \"a.obj\" is shown as a checkerboard: its first bytes match no known image format; save it as PNG, JPEG or WebP"),
        left("map_Ks of a file that is no image", File("newmtl m\nKs 1 1 1\nNs 50\n> map_Ks a.obj"), "the number alone is drawn")
            .says("m.mtl, line 4: image \"a.obj\" is left out: its first bytes match no known image format; save it as PNG, JPEG or WebP"),
        read("map_Kd file of another case, or by another folder", Lines("map_Kd C:\\art\\COLOR.png"), "the file beside the model", has_base_color)
            .says("m.mtl, line 2: texture \"C:\\art\\COLOR.png\" was not found; \"color.png\" is used instead; correct the name there"),
        left("map_Kd without a file", Lines("map_Kd"), "it names nothing")
            .says("m.mtl, line 2: map_Kd names no file, and is ignored; fix the line, or export the material again"),
        left("map_Kd with options and no file", Lines("map_Kd -s 2 2 2"), "it names nothing")
            .says("m.mtl, line 2: map_Kd names no file, and is ignored; fix the line, or export the material again"),
        left("map_Kd file # comment", Lines("map_Kd color.png # wood"), "names may have spaces and #")
            .says("m.mtl, line 2: texture \"color.png # wood\" is not drawn: there is no such file; put the file there, or export the model again with it"),
    ]
}
