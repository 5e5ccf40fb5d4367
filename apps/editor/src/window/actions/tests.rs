use std::collections::BTreeSet;

use trigon_document::command_reference;
use trigon_window::Chord;

use super::*;

#[test]
fn every_row_of_the_table_can_be_used() {
    let mut names = BTreeSet::new();
    for action in all() {
        assert!(names.insert(action.name), "{} stands there twice", action.name);
        assert!(!action.label.is_empty() && action.help.ends_with('.'), "{} has a help text", action.name);
        let menu = action.menu.split('/').next().expect("split gives at least one");
        assert!(MENUS.contains(&menu), "{} is in a menu that is not there: {menu}", action.name);
        drop(action.request());
        for key in action.keys.split_whitespace() {
            assert!(key.parse::<Chord>().is_ok(), "{}: {key}", action.name);
        }
    }
}

#[test]
fn every_tool_of_the_bar_has_an_icon_of_its_own() {
    let icons: Vec<Icon> = tools().map(|tool| tool.icon).collect();
    assert_eq!(icons.len(), TOOLS.len(), "each name is that of an action");
    for (index, icon) in icons.iter().enumerate() {
        assert!(!icons[..index].contains(icon), "{icon:?} stands for two tools");
    }
}

#[test]
fn no_chord_means_two_things_in_one_mode() {
    for is_editing in [false, true] {
        let mut known = std::collections::BTreeMap::new();
        for action in all().filter(|action| action.fits_mode(is_editing)) {
            for key in action.keys.split_whitespace() {
                let other = known.insert(key, action.name);
                assert_eq!(other, None, "{key} is also {}", action.name);
            }
        }
    }
}

/// Those that an element of the window runs with values of its own: clicks, tools, panels.
const BY_OTHER_MEANS: [&str; 15] = [
    "paste",
    "import_file",
    "select_elements",
    "edit_objects",
    "leave_edit_mode",
    "set_element_kind",
    "select",
    "rename_object",
    "translate",
    "rotate",
    "scale",
    "shear",
    "to_sphere",
    "shrink_fatten",
    "push_pull",
];

/// Those of the panels.
const BY_PANELS: [&str; 11] = [
    "set_modifier",
    "show_modifier",
    "move_modifier",
    "remove_modifier",
    "reorder_object",
    "set_transform",
    "set_light",
    "add_material",
    "set_material",
    "set_material_slot",
    "assign_texture",
];

/// Those that a tool of this name in the table runs.
const BY_TOOLS: [&str; 11] = [
    "knife",
    "extrude",
    "inset",
    "bevel",
    "loop_cut",
    "slide_edges",
    "slide_vertices",
    "rip",
    "translate_uvs",
    "rotate_uvs",
    "scale_uvs",
];

#[test]
fn every_command_is_reachable() {
    let reference = command_reference();
    let commands = reference.lines().filter_map(|line| line.strip_prefix("## `")?.strip_suffix('`'));
    let run: BTreeSet<String> = all()
        .filter_map(|action| match action.does {
            Does::Run(json) => {
                let value: serde_json::Value = serde_json::from_str(json).expect("JSON");
                Some(value["op"].as_str().expect("every command has a name").to_owned())
            }
            _ => None,
        })
        .collect();
    let mut count = 0;
    for command in commands {
        count += 1;
        let others = [&BY_OTHER_MEANS[..], &BY_TOOLS, &BY_PANELS].concat();
        let reachable = run.contains(command) || others.contains(&command);
        assert!(reachable, "{command} is in no menu");
    }
    assert!(count > 50, "the reference lists the commands: {count}");
}

#[test]
fn what_cannot_run_says_why() {
    let document = Document::default();
    for (name, word) in [
        ("edit.undo", "nothing to undo"),
        ("mesh.inset", "Tab"),
        ("edit.join", "two objects"),
        ("edit.delete", "click one"),
    ] {
        let refusal = named(name).and_then(|action| action.refusal(&document)).expect(name);
        assert!(refusal.contains(word), "{name}: {refusal}");
    }
    assert_eq!(named("select.all").and_then(|action| action.refusal(&document)), None, "always possible");
}
