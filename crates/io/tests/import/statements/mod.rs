//! Every statement of OBJ and MTL, and what comes of it: `docs/obj-statements.md` is
//! written from the rows of these modules, and each row is held to what the reader
//! does. `TRIGON_UPDATE_OBJ_STATEMENTS=1` writes the page anew.

mod curves;
mod elements;
mod map_options;
mod maps;
mod materials;
mod page;
mod row;
mod state;
mod tobj;
mod vertices;

use std::collections::BTreeSet;

use row::{Effect, Format, Row, Sample};

/// The rows under one heading.
struct Section {
    heading: &'static str,
    format: Format,
    rows: Vec<Row>,
}

/// The whole page, in order.
fn sections() -> Vec<Section> {
    let section = |heading, format, rows| Section { heading, format, rows };
    vec![
        section("OBJ: lines and vertices", Format::Obj, vertices::rows()),
        section("OBJ: points, lines and faces", Format::Obj, elements::rows()),
        section("OBJ: groups, materials and other state", Format::Obj, state::rows()),
        section("OBJ: curves and surfaces", Format::Obj, curves::rows()),
        section("MTL: materials and numbers", Format::Mtl, materials::rows()),
        section("MTL: textures", Format::Mtl, maps::rows()),
        section("MTL: options of textures", Format::Mtl, map_options::rows()),
    ]
}

/// What the specifications name: of OBJ version 3.0, appendix B1, of MTL version 4.2,
/// chapter 5, and of the extension for physically-based materials.
const KEYWORDS: [(Format, &str); 2] = [
    (
        Format::Obj,
        "v vt vn vp cstype deg bmat step p l f fo curv curv2 surf parm trim hole scrv sp end con g s mg o \
         bevel c_interp d_interp lod usemap maplib usemtl mtllib shadow_obj trace_obj ctech stech call csh \
         bsp bzp cdc cdp res #",
    ),
    (
        Format::Mtl,
        "newmtl Ka Kd Ks Ke Tf illum d Tr Ns sharpness Ni map_Ka map_Kd map_Ks map_Ke map_Ns map_d map_Tr \
         map_aat disp decal bump map_Bump refl Pr Pm Ps Pc Pcr aniso anisor map_Pr map_Pm map_Ps norm \
         map_RMA map_ORM -blendu -blendv -bm -boost -cc -clamp -imfchan -mm -o -s -t -texres -type \
         -colorspace",
    ),
];

#[test]
fn every_statement_of_the_specifications_has_a_row() {
    for (format, keywords) in KEYWORDS {
        let sections = sections().into_iter().filter(|section| section.format == format);
        let rows = sections.flat_map(|section| section.rows);
        let known: BTreeSet<&str> = rows.flat_map(|row| row.keywords()).collect();
        for keyword in keywords.split_whitespace() {
            assert!(known.contains(keyword), "{keyword} has a row whose file has it");
        }
    }
}

#[test]
fn every_row_says_what_the_reader_does() {
    let mut wrong = Vec::new();
    for section in sections() {
        for row in &section.rows {
            if let Err(why) = check(section.format, row) {
                wrong.push(format!("{} ({:?}): {why}", row.statement, row.case));
            }
        }
    }
    assert!(wrong.is_empty(), "{} rows are wrong:\n{}", wrong.len(), wrong.join("\n"));
}

fn check(format: Format, row: &Row) -> Result<(), String> {
    let with = Sample::with(format, &row.case).load();
    let messages = match &with {
        Ok((_, warnings)) => warnings.clone(),
        Err(error) => vec![error.clone()],
    };
    if messages != row.says {
        return Err(format!("it says {messages:#?}"));
    }
    let (Ok((loaded, _)), Effect::Read(..) | Effect::Left(_)) = (&with, &row.effect) else {
        let is_refusal = matches!((&with, &row.effect), (Err(_), Effect::Refused));
        return if is_refusal { Ok(()) } else { Err("it is refused, or should be".to_owned()) };
    };
    let without = Sample::without(format, &row.case).load();
    let changes = without.map_or(true, |(without, _)| scene(&without) != scene(loaded));
    match row.effect {
        Effect::Read(_, holds) if !holds(loaded) => Err(format!("the scene is {}", scene(loaded))),
        Effect::Read(..) if !changes => Err("the statement changes nothing".to_owned()),
        Effect::Left(_) if changes => Err("the statement changes the scene".to_owned()),
        _ => Ok(()),
    }
}

/// All that there is to know about a scene.
fn scene(loaded: &trigon_io::Loaded) -> String {
    format!("{:?}", loaded.scene)
}

#[test]
fn the_page_shows_the_rows() {
    page::check(&page::write(&sections()));
}
