//! Whatever `docs/architecture.md` says is somewhere is there.

use std::fs;
use std::path::PathBuf;
use trigon_layers::workspace;

/// The page's text between backquotes, outside code blocks, each with what stands before it.
fn spans(page: &str) -> Vec<(&str, &str)> {
    let mut parts = page.split('`').map(|part| part.trim_end_matches(' '));
    let mut before = parts.next().unwrap_or_default();
    let mut spans = Vec::new();
    while let (Some(span), after) = (parts.next(), parts.next()) {
        spans.push((before, span));
        before = after.unwrap_or_default();
    }
    spans
}

/// The file or folder of a path as the page writes it: `raster/tile` is a folder, `raster/pass` may be the file of that
/// name. `None` if it begins with no folder of the workspace.
fn candidates(path: &str) -> Option<[PathBuf; 2]> {
    let root = workspace();
    let (first, rest) = path.split_once('/').filter(|(first, _)| !first.is_empty())?;
    let folder = match first {
        "crates" | "apps" | "tests" | "docs" => root.join(path),
        _ => {
            let mut packages = ["crates", "apps"].map(|kind| root.join(kind).join(first)).into_iter();
            packages.find(|package| package.is_dir())?.join("src").join(rest)
        }
    };
    let file = folder.with_extension("rs");
    Some([folder, file])
}

#[test]
fn the_architecture_names_files_that_exist_and_what_is_in_them() {
    let page = fs::read_to_string(workspace().join("docs/architecture.md")).expect("a page of the documents");
    let (mut wrong, mut count) = (Vec::new(), 0);
    let mut last = "";
    for (before, span) in spans(&page) {
        if let Some(paths) = candidates(span).filter(|_| !span.contains(char::is_whitespace)) {
            count += 1;
            let found = paths.iter().find(|path| path.exists());
            let item = last.rsplit("::").next().unwrap_or_default();
            match found {
                None => wrong.push(span.to_owned()),
                Some(path) if before == " in" && path.is_file() => {
                    let text = fs::read_to_string(path).expect("a source file");
                    let is_there = text.contains(item.trim_end_matches('!'));
                    wrong.extend((!is_there).then(|| format!("{last} in {span}")));
                }
                Some(_) => {}
            }
        }
        last = span;
    }
    assert!(count > 200, "{count} paths: is the page written in another way?");
    assert!(wrong.is_empty(), "not there: {wrong:#?}");
}
