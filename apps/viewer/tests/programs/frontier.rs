//! `--frontier`: plots and tables of what settings cost, and how wrong they are.

use std::fs;

use crate::Folder;

const SMALL: &str = "--resolution 16,12 --threads 1";

#[test]
fn error_against_time_is_a_plot_or_a_table() {
    let folder = Folder::new();
    let output = folder.run(&format!("corner.obj --frontier {{model}}.svg --time-budget 5ms {SMALL}"));
    let printed = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success() && printed.starts_with("corner.obj\n  "), "{printed}");
    assert!(printed.contains("reference") && printed.contains("no error"), "the last of the best: {printed}");
    let svg = fs::read_to_string(folder.path("corner.svg")).expect("the plot");
    for text in ["corner.obj, 16×12, 1 thread", "what 5.0 ms per frame buy", "not to the exact image"] {
        assert!(svg.contains(text), "{text} is not in the plot");
    }
    let said = folder.said(&format!("corner.obj --frontier t.csv --shadows {SMALL}"), 0);
    assert!(said.starts_with("trigon-viewer: wrote t.csv ("), "{said}");
    let table = fs::read_to_string(folder.path("t.csv")).expect("the table");
    for preset in ["draft", "standard", "high", "reference"] {
        assert!(table.contains(&format!("\n\"{preset}\",{preset},")), "{preset} is measured: {table}");
    }
    assert!(table.contains(",rays,") && table.contains(",maps of 2048 texels,"), "flags count: {table}");
    // The settings that are in force have 3×3 samples and shadow maps, as without a preset.
    assert!(table.contains("\"3×3×1\",,3,1,"), "{table}");
}

#[test]
fn plots_that_cannot_be_written_are_refused_before_anything_is_measured() {
    let folder = Folder::new();
    folder.write("other.obj", crate::CORNER);
    assert!(folder.said("corner.obj --frontier plot.png", 2).contains(".svg for a plot"), "no such format");
    assert!(folder.said("corner.obj other.obj --frontier plot.svg", 2).contains("{model}"), "two of them");
    assert!(folder.said("corner.obj --frontier a.svg --output a.png", 2).contains("--output"), "one of both");
    assert!(folder.failed("corner.obj --frontier gone/a.svg").contains("the folder gone does not exist"));
    folder.write("in.csv", crate::CORNER);
    let said = folder.said("in.csv --force-reader=OBJ --frontier in.csv", 2);
    assert!(said.contains("read by this very command"), "{said}");
    assert!(fs::read_to_string(folder.path("in.csv")).is_ok_and(|text| text == crate::CORNER), "it is there");
}
