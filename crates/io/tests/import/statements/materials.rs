//! Materials and their numbers.

use trigon_io::Loaded;
use trigon_math::Vec3;
use trigon_math::color::srgb_to_linear;
use trigon_scene::{AlphaMode, Material, MetallicRoughness, Shading};

use super::row::Case::{File, Lines};
use super::row::{Row, left, read};

pub(super) fn rows() -> Vec<Row> {
    let mut rows = names();
    rows.extend(colors());
    rows.extend(malformed_colors());
    rows.extend(highlights());
    rows.extend(illumination_models());
    rows.extend(opacity());
    rows.extend(physically_based());
    rows
}

pub(super) fn material(loaded: &Loaded) -> &Material {
    loaded.scene.materials.iter().next().expect("a material").1
}

fn base_color(loaded: &Loaded) -> Vec3 {
    material(loaded).base_color.truncate()
}

fn shading(loaded: &Loaded) -> Shading {
    material(loaded).shading
}

fn model(loaded: &Loaded) -> MetallicRoughness {
    match shading(loaded) {
        Shading::MetallicRoughness(model) => model,
        other => panic!("{other:?}"),
    }
}

fn is_red(loaded: &Loaded) -> bool {
    base_color(loaded) == Vec3::X
}

fn names() -> Vec<Row> {
    vec![
        read("newmtl name", File("> newmtl m\nKd 1 0 0"), "a material; names may have spaces", is_red),
        left("newmtl without a name", File("newmtl m\nKd 1 0 0\n> newmtl\n> Kd 0 0 1"), "nothing can refer to it")
            .says("m.mtl, line 3: a material has no name and is left out; fix the line, or export the material again"),
        read(
            "newmtl of a name that was there",
            File("newmtl m\nKd 0 0 1\n> newmtl m\n> Kd 1 0 0"),
            "the last definition",
            is_red,
        )
        .says("m.mtl, line 3: a material is defined a second time, and this definition counts; remove one, or give it another name"),
        left("newmtl of a name that was there, with the same contents", File("newmtl m\nKd 1 0 0\n> newmtl m\n> Kd 1 0 0"), "it is the same material"),
        left("a statement before the first newmtl", File("> Kd 1 0 0\nnewmtl m"), "it belongs to no material")
            .says("m.mtl, line 1: a statement stands before the first newmtl and is ignored; move it below the newmtl of its material"),
        read("a statement in another case", Lines("KD 1 0 0"), "the statement", is_red),
        read("a statement given twice", Lines("Kd 0 0 1\nKd 1 0 0"), "the last", is_red)
            .says("m.mtl, line 3: Kd is given twice in a material, and the last counts; remove one of them"),
        left("an unknown statement", Lines("Km 0.5"), "nobody knows what it means")
            .says("m.mtl, line 2: the statement \"Km\" is unknown and is ignored; check its spelling, or remove it"),
        left("# comment", Lines("# Kd 1 0 0"), "a comment"),
        read("numbers # comment", Lines("Kd 1 0 0 # 0 0 1"), "the numbers", is_red),
        read("statement \\ on two lines", Lines("Kd 1 \\\n 0 0"), "one statement", is_red),
        left("newmtl name # comment", File("newmtl m\n> newmtl n # wood\n> Kd 1 0 0"), "names may have spaces and #; usemtl warns where it finds no such name"),
    ]
}

fn colors() -> Vec<Row> {
    vec![
        read("Kd r g b", Lines("Kd 1 0 0"), "the base colour, in sRGB", is_red),
        read("Kd r", Lines("Kd 0.5"), "a grey", |loaded| base_color(loaded) == Vec3::splat(srgb_to_linear(0.5))),
        read("Kd beside map_Kd", File("newmtl m\nmap_Kd color.png\n> Kd 1 0 0"), "what the texture is multiplied by", |loaded| {
            is_red(loaded) && material(loaded).base_color_texture.is_some()
        }),
        left(
            "Kd 0 0 0 beside map_Kd",
            File("newmtl m\nmap_Kd color.png\n> Kd 0 0 0"),
            "white: exporters write black where the image is to be seen as it is",
        ),
        left("Ka r g b", File("newmtl m\nKd 1 0 0\n> Ka 0.2 0 0"), "OBJ has no lights: ambient light is a choice of who looks at it, and Kd answers it; exporters write any number"),
        left("Ka without Kd", Lines("Ka 1 0 0"), "ambient light is answered by Kd")
            .says("m.mtl, line 2: a material has Ka and no Kd, and is drawn grey; write its colour as Kd"),
        read("Ks r g b", File("newmtl m\nNs 50\n> Ks 1 0 0"), "a Blinn-Phong highlight", |loaded| {
            matches!(shading(loaded), Shading::BlinnPhong { specular: Vec3::X, .. })
        }),
        read("Ke r g b", Lines("Ke 1 0 0"), "light that the surface sends out", |loaded| {
            material(loaded).emissive == Vec3::X
        }),
        left("Tf r g b, on an opaque material", Lines("Tf 0 0 0"), "no light passes through"),
        left("Tf 1 1 1", Lines("Tf 1 1 1"), "it colours nothing"),
        left("Tf r g b", Lines("Tf 1 0 0"), "light that passes through keeps its colour")
            .says("m.mtl, line 2: Tf or Kt colours the light that passes through, which is not drawn; write d for transparency, and Kd for its colour"),
        left("Kt r g b", Lines("Kt 1 0 0"), "tinyobjloader takes it for Tf")
            .says("m.mtl, line 2: Tf or Kt colours the light that passes through, which is not drawn; write d for transparency, and Kd for its colour"),
    ]
}

fn malformed_colors() -> Vec<Row> {
    const MEND: &str =
        "m.mtl, line 2: Kd has no number, and is ignored; fix the line, or export the material again";
    vec![
        left("Kd spectral file.rfl factor", Lines("Kd spectral wood.rfl 1"), "trigon draws in three colours")
            .says("m.mtl, line 2: Kd names a spectral curve, which is not read, and is ignored; fix the line, or export the material again"),
        left("Ks spectral file.rfl factor", Lines("Ks spectral wood.rfl"), "trigon draws in three colours")
            .says("m.mtl, line 2: Ks names a spectral curve, which is not read, and is ignored; fix the line, or export the material again"),
        left("Kd xyz x y z", Lines("Kd xyz 0.5 0.5 0.5"), "the format does not say which white it means")
            .says("m.mtl, line 2: Kd is in CIE XYZ, which is not read, and is ignored; fix the line, or export the material again"),
        left("Tf xyz x y z", Lines("Tf xyz 0.5"), "the format does not say which white it means")
            .says("m.mtl, line 2: Tf is in CIE XYZ, which is not read, and is ignored; fix the line, or export the material again"),
        left("Kd without numbers", Lines("Kd"), "it says nothing").says(MEND),
        left("Kd with 2 numbers", Lines("Kd 1 0"), "a channel is missing")
            .says("m.mtl, line 2: Kd has 2 numbers and needs 1 or 3, and is ignored; fix the line, or export the material again"),
        left("Kd with a word", Lines("Kd 0.5 x 0"), "a channel is missing")
            .says("m.mtl, line 2: Kd has \"x\", which is not a finite number, and is ignored; fix the line, or export the material again"),
        left("Kd that is not finite", Lines("Kd nan 0 0"), "a channel is missing")
            .says("m.mtl, line 2: Kd has \"nan\", which is not a finite number, and is ignored; fix the line, or export the material again"),
        read("Kd with more than 3 numbers", Lines("Kd 1 0 0 0.5"), "the first 3", is_red)
            .says("m.mtl, line 2: Kd has more than 3 numbers, and the first 3 count; fix the line, or export the material again"),
        read("Kd outside of 0 to 1", Lines("Kd 255 0 -1"), "a number within that range", is_red)
            .says("m.mtl, line 2: Kd is outside of 0 to 1 and is clamped; write a number within that range"),
        read("Ke above 1", Lines("Ke 5 0 0"), "1", |loaded| material(loaded).emissive == Vec3::X)
            .says("m.mtl, line 2: Ke is outside of 0 to 1 and is clamped; write a number within that range"),
    ]
}

fn highlights() -> Vec<Row> {
    vec![
        read("Ns exponent", File("newmtl m\nKs 1 1 1\n> Ns 50"), "how sharp the highlight is", |loaded| {
            shading(loaded) == Shading::blinn_phong(Vec3::ONE, 50.0)
        }),
        left("Ks without Ns", Lines("Ks 1 1 1"), "exporters write it for surfaces without a highlight")
            .says("m.mtl, line 2: Ks without Ns, or with Ns of at most 1, is a placeholder, and no highlight is drawn; write Ns, such as 30, or Ks 0"),
        left("Ns of at most 1", File("newmtl m\nKs 1 1 1\n> Ns 0.000000"), "a highlight as wide as diffuse light is a white veil, which nobody means")
            .says("m.mtl, line 3: Ks without Ns, or with Ns of at most 1, is a placeholder, and no highlight is drawn; write Ns, such as 30, or Ks 0"),
        left("Ns without Ks", Lines("Ns 50"), "without Ks there is no highlight"),
        read("Ns outside of 0 to 1000", File("newmtl m\nKs 1 1 1\n> Ns 5000"), "a number within that range", |loaded| {
            shading(loaded) == Shading::blinn_phong(Vec3::ONE, 1000.0)
        })
        .says("m.mtl, line 3: Ns is outside of 0 to 1000 and is clamped; write a number within that range"),
        left("Ns without a number", File("newmtl m\nKs 1 1 1\n> Ns"), "it says nothing")
            .says("m.mtl, line 3: Ns has no number, and is ignored; fix the line, or export the material again")
            .says("m.mtl, line 2: Ks without Ns, or with Ns of at most 1, is a placeholder, and no highlight is drawn; write Ns, such as 30, or Ks 0"),
        read("Ns with more than 1 number", File("newmtl m\nKs 1 1 1\n> Ns 50 60"), "the first", |loaded| {
            shading(loaded) == Shading::blinn_phong(Vec3::ONE, 50.0)
        })
        .says("m.mtl, line 3: Ns has more than 1 number, and the first counts; fix the line, or export the material again"),
        left("sharpness value", Lines("sharpness 60"), "it blurs reflection maps, each of which has a warning"),
        read("Ni index", Lines("Ni 1.3"), "the index of refraction; a highlight by Ks does not use it", |loaded| {
            material(loaded).ior == 1.3
        }),
        left("Ni 1 or less", Lines("Ni 0"), "exporters write 0 and 1 where they do not know it"),
    ]
}

fn illumination_models() -> Vec<Row> {
    const REFLECTS: &str = "m.mtl, line 4: illum 3 to 9 asks for reflections of what is around, and only highlights are drawn; write Pm and Pr for a surface that reflects";
    const GLASS: &str = "m.mtl, line 3: illum 4, 6, 7 or 9 asks for glass, and the surface is drawn clear without bending light; export the model as GLB, which keeps glass";
    let mirror = |statement: &'static str, case: &'static str| {
        left(statement, File(case), "it is drawn as illum 2").says(REFLECTS)
    };
    let glass = |statement: &'static str, case: &'static str| {
        left(statement, File(case), "it is drawn as illum 2").says(GLASS)
    };
    vec![
        read("illum 0", Lines("illum 0"), "the colour alone, whatever the light", |loaded| {
            shading(loaded) == Shading::Unlit
        }),
        read("illum 1", File("newmtl m\nKs 1 1 1\nNs 50\n> illum 1"), "no highlight", |loaded| {
            shading(loaded) == Shading::Lambert
        }),
        left("illum 2", File("newmtl m\nKs 1 1 1\nNs 50\n> illum 2"), "what Ks and Ns say, as without it"),
        mirror("illum 3", "newmtl m\nKs 1 1 1\nNs 50\n> illum 3"),
        mirror("illum 4", "newmtl m\nKs 1 1 1\nNs 50\n> illum 4"),
        mirror("illum 5", "newmtl m\nKs 1 1 1\nNs 50\n> illum 5"),
        mirror("illum 6", "newmtl m\nKs 1 1 1\nNs 50\n> illum 6"),
        mirror("illum 7", "newmtl m\nKs 1 1 1\nNs 50\n> illum 7"),
        mirror("illum 8", "newmtl m\nKs 1 1 1\nNs 50\n> illum 8"),
        mirror("illum 9", "newmtl m\nKs 1 1 1\nNs 50\n> illum 9"),
        left("illum 3 to 9 without Ks", Lines("illum 4"), "reflections are as strong as Ks, and the surface is opaque"),
        glass("illum 4 on a transparent material", "newmtl m\nd 0.5\n> illum 4"),
        glass("illum 6 on a transparent material", "newmtl m\nd 0.5\n> illum 6"),
        glass("illum 7 on a transparent material", "newmtl m\nd 0.5\n> illum 7"),
        glass("illum 9 on a transparent material", "newmtl m\nd 0.5\n> illum 9"),
        left("illum 10", Lines("illum 10"), "no surface shows shadows alone")
            .says("m.mtl, line 2: illum 10 asks for a surface that shows nothing but shadows, and it is drawn whole; remove the surface, or write another illum"),
        left("illum above 10", Lines("illum 42"), "there is no such model")
            .says("m.mtl, line 2: illum 42 is not an illumination model (0 to 10), and is ignored; fix the line, or export the material again"),
        read("illum with more than 1 number", File("newmtl m\nKs 1 1 1\nNs 50\n> illum 1 2"), "the first", |loaded| {
            shading(loaded) == Shading::Lambert
        })
        .says("m.mtl, line 4: illum has more than 1 number, and the first counts; fix the line, or export the material again"),
        left("illum without a number", Lines("illum"), "it says nothing")
            .says("m.mtl, line 2: illum has no number, and is ignored; fix the line, or export the material again"),
    ]
}

fn opacity() -> Vec<Row> {
    const HIDDEN: &str =
        "m.mtl, line 1: every material is invisible (d 0 or Tr 1), and all are drawn opaque; write d 1";
    let half = |loaded: &Loaded| {
        let Material { base_color, alpha_mode, .. } = material(loaded);
        base_color.w == 0.5 && *alpha_mode == AlphaMode::Blend
    };
    vec![
        read("d factor", Lines("d 0.5"), "opacity", half),
        left("d 0, in all materials", Lines("d 0"), "nobody exports a model that is not seen; one of several materials may be hidden")
            .says(HIDDEN),
        left("d outside of 0 to 1", Lines("d 1.5"), "a number within that range, which is opaque")
            .says("m.mtl, line 2: d is outside of 0 to 1 and is clamped; write a number within that range"),
        left("d 0 beside map_d", File("newmtl m\nmap_d grey.png\n> d 0"), "the image alone says what is seen")
            .says("m.mtl, line 3: d 0 beside map_d would be invisible, and map_d counts alone; write d 1"),
        left("d that is not finite", Lines("d nan"), "it says nothing")
            .says("m.mtl, line 2: d has \"nan\", which is not a finite number, and is ignored; fix the line, or export the material again"),
        read("d -halo factor", Lines("d -halo 0.5"), "opacity, the same all over", half)
            .says("m.mtl, line 2: d -halo is drawn as d: the same all over; remove -halo if that will do"),
        read("Tr factor", Lines("Tr 0.5"), "1 − Tr is the opacity", half),
        left("Tr 1", Lines("Tr 1"), "some exporters write it for opaque")
            .says("m.mtl, line 2: Tr 1 would be invisible and is read as opaque; write d instead of Tr"),
        left("Tr below 0", Lines("Tr -1"), "0 is opaque")
            .says("m.mtl, line 2: Tr is below 0 and is clamped; write a number within that range"),
        left("Tr without a number", Lines("Tr x"), "it says nothing")
            .says("m.mtl, line 2: Tr has \"x\", which is not a finite number, and is ignored; fix the line, or export the material again"),
        left("Tr beside the d that it means", File("newmtl m\nd 0.7\n> Tr 0.3"), "both say the same"),
        left("Tr beside another d", File("newmtl m\nd 0.5\n> Tr 0.9"), "d is the format's own")
            .says("m.mtl, line 3: d and Tr contradict each other (Tr is 1 − d), and d counts; remove one of them"),
        read("Tr beside d 0", File("newmtl m\nd 0\n> Tr 0.5"), "of two readings the one that shows the surface", half)
            .says("m.mtl, line 3: d 0 and Tr contradict each other (Tr is 1 − d), and Tr counts; remove one of them"),
        left("Tr 1 beside d 0", File("newmtl m\nd 0\n> Tr 1"), "both say the same").says(HIDDEN),
    ]
}

fn physically_based() -> Vec<Row> {
    vec![
        read("Pr roughness", Lines("Pr 0.25"), "a metallic-roughness material of that roughness", |loaded| {
            model(loaded).roughness == 0.25
        }),
        read("Pm metal", Lines("Pm 0.75"), "a metallic-roughness material, so much of a metal", |loaded| {
            model(loaded).metallic == 0.75
        }),
        read("Pr outside of 0 to 1", Lines("Pr 3"), "a number within that range", |loaded| model(loaded).roughness == 1.0)
            .says("m.mtl, line 2: Pr is outside of 0 to 1 and is clamped; write a number within that range"),
        left("Pr without a number", Lines("Pr x"), "it says nothing")
            .says("m.mtl, line 2: Pr has \"x\", which is not a finite number, and is ignored; fix the line, or export the material again"),
        left("Ks beside Pr or Pm", File("newmtl m\nPr 0.5\n> Ks 1 0 0"), "roughness and metal set the highlight")
            .says("m.mtl, line 3: Ks is not drawn beside Pr or Pm, which set the highlight; write Pm 1 for a metal, whose highlights are coloured"),
        left("Ns beside Pr or map_Pr", File("newmtl m\nPr 0.5\n> Ns 50"), "the roughness says how sharp the highlight is"),
        left("Ns beside Pm alone", File("newmtl m\nPm 1\n> Ns 50"), "the two models measure it differently")
            .says("m.mtl, line 3: Ns is not drawn beside Pm, and the roughness is 0.5; write Pr"),
        left("Ks 0.5 0.5 0.5 beside Pr or Pm", File("newmtl m\nPr 0.5\n> Ks 0.5 0.5 0.5"), "what exporters write for a reflection of 4 %, which is drawn"),
        left("Ni 1 or less beside Pr or Pm", File("newmtl m\nPr 0.5\n> Ni 1"), "1.5, which reflects 4 %")
            .says("m.mtl, line 3: Ni is not above 1, and 1.5 is taken; write the index of refraction, such as 1.5"),
        left("Ps sheen", Lines("Ps 0.5"), "sheen is not drawn")
            .says("m.mtl, line 2: Ps (sheen) is not drawn; set it to 0 if it matters little"),
        left("Pc thickness", Lines("Pc 0.5"), "clear coats are not drawn")
            .says("m.mtl, line 2: Pc (clear coat) is not drawn; set it to 0 if it matters little"),
        left("Pcr roughness", Lines("Pcr 0.5"), "of the clear coat by Pc, which has a warning"),
        left("aniso amount", Lines("aniso 0.5"), "highlights are round")
            .says("m.mtl, line 2: aniso (brushed metal) is not drawn; set it to 0 if it matters little"),
        left("anisor angle", Lines("anisor 0.5"), "of aniso, which has a warning"),
        left("Ps 0, Pc 0, aniso 0", Lines("Ps 0\nPc 0.0\naniso 0"), "they ask for nothing"),
    ]
}
