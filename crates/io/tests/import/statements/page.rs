//! The page `docs/obj-statements.md`.

use std::fmt::Write;
use std::path::Path;

use super::row::{Case, Effect, Row};
use super::{Section, tobj};

const HEAD: &str = "\
# Every statement of OBJ and MTL

What trigon does with each statement, and with the ways to get it wrong. The statements are those of Wavefront OBJ (version 3.0,
appendix B1 of the Advanced Visualizer's manual), of MTL (version 4.2, chapter 5 of the File Formats manual), and of the
extension for physically-based materials (Exocortex, 2014). Nothing that changes the image is left out in silence: a warning names
the file, the line and the remedy. Warnings of the same wording are one, which says how many more there are.

*Read* says what a statement becomes; with a message beside it, it is drawn, but not as it is written. *Not read* says why;
without a message, because the image is the same without it. *Refused* is a file that does not load.

The cases stand in a small file. In a model the case begins at line 8, after a library, four vertices (`v`), a texture coordinate
and a normal; a face with all of these follows. In a library the case begins at line 2, after `newmtl m`. Where a case is a
whole file, the statement's lines are the bold ones.

The last column is what [tobj](https://crates.io/crates/tobj) makes of the same file, compared by a test. Of a model it has the same
faces or others; of a library it reads the statement, keeps it as text, or refuses the file. Where only some corners of a file have
texture coordinates or normals, tobj repeats those of the corner before.

This page is written by a test from the rows that it checks, in `crates/io/tests/import/statements`:

    TRIGON_UPDATE_OBJ_STATEMENTS=1 cargo test -p trigon-io statements
";

/// The page for these rows.
pub(super) fn write(sections: &[Section]) -> String {
    let mut page = HEAD.to_owned();
    for section in sections {
        write!(page, "\n## {}\n\n", section.heading).expect("a string takes it");
        page += "| statement | case | what comes of it | message | tobj |\n|---|---|---|---|---|\n";
        for row in &section.rows {
            let cells = [
                code(row.statement),
                case(&row.case),
                effect(row),
                row.says.iter().map(|message| escaped(message)).collect::<Vec<_>>().join("<br>"),
                escaped(&tobj::verdict(section.format, row)),
            ];
            writeln!(page, "| {} |", cells.join(" | ")).expect("a string takes it");
        }
    }
    page
}

fn effect(row: &Row) -> String {
    match row.effect {
        Effect::Read(becomes, _) => format!("*Read:* {}", escaped(becomes)),
        Effect::Left(reason) => format!("*Not read:* {}", escaped(reason)),
        Effect::Refused => "*Refused*".to_owned(),
    }
}

fn case(case: &Case) -> String {
    let lines: Vec<String> = match case {
        Case::Lines(text) => text.split('\n').map(code).collect(),
        Case::File(text) => {
            let line = |line: &str| match line.strip_prefix("> ") {
                Some(marked) => format!("**{}**", code(marked)),
                None => code(line),
            };
            text.split('\n').map(line).collect()
        }
    };
    lines.join("<br>")
}

/// Markdown's code; a bar would end the cell.
fn code(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("`{}`", text.replace('|', "\\|").replace('\t', " ")) }
}

fn escaped(text: &str) -> String {
    text.replace('|', "\\|").replace('<', "&lt;").replace('*', "\\*")
}

/// Holds the page to the rows, or writes it.
pub(super) fn check(expected: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/obj-statements.md");
    if std::env::var_os("TRIGON_UPDATE_OBJ_STATEMENTS").is_some() {
        std::fs::write(&path, expected).expect("the page is writable");
    }
    let found = std::fs::read_to_string(&path).expect("the page is there");
    for (number, (found, expected)) in found.lines().zip(expected.lines()).enumerate() {
        assert_eq!(found, expected, "line {} of {}", number + 1, path.display());
    }
    assert_eq!(found.lines().count(), expected.lines().count(), "as many lines in {}", path.display());
}
