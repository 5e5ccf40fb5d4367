//! Which tables are older than the code that they measure.

use std::fs;
use std::io;
use std::path::Path;

use super::chapters::CHAPTERS;
use super::header::{Header, git};

/// A table, and the commits since it was measured that changed what it measures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Age {
    /// The question's name.
    pub question: &'static str,
    /// How many commits changed the question's own code.
    pub own: usize,
    /// How many changed the renderer.
    pub renderer: usize,
}

/// What draws the images of nearly all questions.
const RENDERER: [&str; 4] = ["crates/math/src", "crates/mesh/src", "crates/raster/src", "crates/scene/src"];

/// The ages of the tables of a file, `accuracy.csv`, in the repository around the current folder.
///
/// # Errors
/// The file cannot be read, has no header, or git does not know its commit.
pub fn ages(file: &Path) -> io::Result<Vec<Age>> {
    let text = fs::read_to_string(file)?;
    let header =
        Header::parse(&text).ok_or_else(|| io::Error::other("the file does not say when it was measured"))?;
    let commit = header.commit.split(' ').next().unwrap_or_default();
    let since = |paths: &[&str]| {
        let range = format!("{commit}..HEAD");
        let arguments = [&["rev-list", "--count", &range, "--"], paths].concat();
        let count = git(&arguments).and_then(|count| count.parse().ok());
        count.ok_or_else(|| io::Error::other(format!("git does not know the commit {commit}")))
    };
    let renderer = since(&RENDERER)?;
    let age = |question: &'static str| {
        let own = format!("crates/study/src/{}", question.replace('-', "_"));
        Ok(Age { question, own: since(&[&own, "crates/classic/src"])?, renderer })
    };
    CHAPTERS.iter().map(|question| age(question.name)).collect()
}
