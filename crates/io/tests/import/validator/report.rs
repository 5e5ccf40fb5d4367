//! What the validator reported, as `crates/io/tests/validator/record.mjs` wrote it.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The recorded reports.
pub(super) struct Report {
    /// Of the validator.
    pub(super) version: String,
    /// All codes, in the validator's own order.
    pub(super) codes: Vec<Code>,
    /// By the file's name.
    pub(super) files: BTreeMap<String, FileReport>,
}

/// A code that the validator can report.
pub(super) struct Code {
    pub(super) group: String,
    pub(super) severity: String,
    pub(super) name: String,
}

/// What was reported of a file.
#[derive(Default)]
pub(super) struct FileReport {
    /// Of its bytes, see [`fnv1a`].
    pub(super) hash: String,
    /// The errors and warnings: the code of each.
    pub(super) codes: Vec<String>,
}

/// The folder of the reports.
pub(super) fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/validator")
}

impl Report {
    pub(super) fn read() -> Self {
        let text = fs::read_to_string(folder().join("reports.txt")).expect("the reports are there");
        let mut report = Self { version: String::new(), codes: Vec::new(), files: BTreeMap::new() };
        let mut file = String::new();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            match line.split(' ').collect::<Vec<_>>()[..] {
                ["validator", version] => version.clone_into(&mut report.version),
                ["code", group, severity, name] => {
                    let [group, severity, name] = [group, severity, name].map(str::to_owned);
                    report.codes.push(Code { group, severity, name });
                }
                ["file", hash, name] => {
                    name.clone_into(&mut file);
                    let made = FileReport { hash: hash.to_owned(), codes: Vec::new() };
                    report.files.insert(file.clone(), made);
                }
                ["issue", _, code, ..] => {
                    report.files.entry(file.clone()).or_default().codes.push(code.to_owned());
                }
                _ => panic!("a line of another form: {line}"),
            }
        }
        report
    }

    /// The codes of errors and warnings.
    pub(super) fn serious(&self) -> impl Iterator<Item = &Code> {
        self.codes.iter().filter(|code| matches!(code.severity.as_str(), "Error" | "Warning"))
    }
}

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
pub(super) fn fnv1a(bytes: &[u8]) -> String {
    let step = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step))
}
