//! Prints how many lines of code each crate has, without blank lines, comments and tests, and how many files:
//! `cargo run -p trigon-layers --example lines [-- CHECKOUT]`.
//!
//! Another checkout, an older commit's for instance, is counted by the same rules.

use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};
use trigon_layers::{rust_files, workspace};

/// What is counted of a crate.
#[derive(Default)]
struct Count {
    files: usize,
    lines: usize,
}

fn main() -> Result<(), Box<dyn Error>> {
    let root = env::args().nth(1).map_or_else(workspace, PathBuf::from);
    let mut crates = Vec::new();
    for part in ["crates", "apps"] {
        for entry in root.join(part).read_dir()? {
            crates.push(entry?.path());
        }
    }
    crates.sort();
    let mut out = io::stdout().lock();
    let mut all = Count::default();
    for folder in crates {
        let Count { files, lines } = count(&folder.join("src"))?;
        let name = folder.strip_prefix(&root)?.display();
        writeln!(out, "{lines:7} lines in {files:4} files  {name}")?;
        (all.files, all.lines) = (all.files + files, all.lines + lines);
    }
    writeln!(out, "{:7} lines in {:4} files  in all", all.lines, all.files)?;
    Ok(())
}

/// Counts the files of a folder that are not for tests.
fn count(source: &Path) -> io::Result<Count> {
    let mut count = Count::default();
    for path in rust_files(source)? {
        let within = path.strip_prefix(source).unwrap_or(&path);
        let is_tests =
            |part: &std::ffi::OsStr| Path::new(part).file_stem().is_some_and(|stem| stem == "tests");
        if !within.iter().any(is_tests) {
            count.files += 1;
            count.lines += code_lines(&fs::read_to_string(&path)?);
        }
    }
    Ok(count)
}

/// The lines of a formatted file that hold code outside of its modules of tests.
fn code_lines(text: &str) -> usize {
    let mut lines = text.lines();
    let mut count = 0;
    while let Some(line) = lines.next() {
        let code = line.trim_start();
        if code.starts_with("#[cfg(test)]") {
            // The formatter closes an item at the depth at which it opens it.
            let end = format!("{}}}", &line[..line.len() - code.len()]);
            if lines.next().is_some_and(|item| item.ends_with('{')) {
                lines.by_ref().take_while(|&line| line != end).for_each(drop);
            }
        } else if !code.is_empty() && !code.starts_with("//") {
            count += 1;
        }
    }
    count
}
