//! Glass and variants of materials, as files have them.

use super::*;

/// The slide's triangle in red, with the variants "plain" and "night", which is blue; both are of glass.
fn variants() -> String {
    let colored = |color: &str| {
        format!(
            r#"{{"pbrMetallicRoughness": {{"baseColorFactor": {color}, "metallicFactor": 0}}, "doubleSided": true,
            "extensions": {{"KHR_materials_transmission": {{"transmissionFactor": 0.5}}}}}}"#
        )
    };
    let materials = [colored("[1, 0, 0, 1]"), colored("[0, 0, 1, 1]")].join(",");
    let mappings = r#""material": 0, "extensions": {"KHR_materials_variants": {"mappings": [
        {"material": 1, "variants": [1]}]}}, "attributes""#;
    let head = format!(
        r#""asset": {{"version": "2.0"}}, "extensionsRequired": ["KHR_materials_variants"],
        "extensionsUsed": ["KHR_materials_variants", "KHR_materials_transmission"], "materials": [{materials}],
        "extensions": {{"KHR_materials_variants": {{"variants": [{{"name": "plain"}}, {{"name": "night"}}]}}}}"#
    );
    let whole = moments::SLIDE.replacen(r#""asset": {"version": "2.0"}"#, &head, 1);
    whole.replacen(r#""attributes""#, mappings, 1)
}

#[test]
fn variants_are_chosen_and_listed() {
    let folder = Folder::new();
    folder.write("v.gltf", &variants());
    let fixed = "--background-color black --resolution 60x40 --output o.png";
    let shown = |flags: &str| {
        folder.said(&format!("v.gltf {fixed} {flags}"), 0);
        let rgba = image(&folder.path("o.png")).rgba;
        let sum = |channel: usize| rgba.chunks(4).map(|pixel| u64::from(pixel[channel])).sum::<u64>();
        [sum(0), sum(2)]
    };
    for (flags, is_red) in [("", true), ("--variant plain", true), ("--variant=night", false)] {
        let [red, blue] = shown(flags);
        assert_eq!(red > blue, is_red, "{flags}: {red} red, {blue} blue");
    }
    let unknown = folder.failed(&format!("v.gltf --variant day {fixed}"));
    assert!(unknown.contains("\"day\"") && unknown.contains("\"plain\", \"night\""), "{unknown}");
    let listed = String::from_utf8(folder.run("v.gltf --no-render").stdout).expect("text");
    assert!(listed.contains("variant   \"night\""), "{listed}");
    let facts = String::from_utf8(folder.run("v.gltf --no-render --json").stdout).expect("text");
    assert!(facts.contains(r#""variants":["plain","night"]"#), "{facts}");
    let checked = String::from_utf8(folder.run("v.gltf --check").stdout).expect("text");
    assert!(checked.contains("\"plain\", \"night\""), "{checked}");
}

/// Glass is never opaque without a word.
#[test]
fn glass_that_is_drawn_opaque_is_told() {
    let folder = Folder::new();
    folder.write("v.gltf", &variants());
    let said = |flags: &str| folder.said(&format!("v.gltf --resolution 60x40 --output o.png {flags}"), 0);
    assert!(!said("").contains("glass"), "what is behind it is drawn");
    for flags in ["--bounces=0", "--shading=flat", "--reflection=lambert"] {
        let warning = said(flags);
        assert!(
            warning.contains("as if it were opaque") && warning.contains("--bounces=0"),
            "{flags}: {warning}"
        );
    }
    let plan = String::from_utf8(folder.run("v.gltf --explain").stdout).expect("text");
    assert!(plan.contains("up to 8 surfaces"), "{plan}");
}
