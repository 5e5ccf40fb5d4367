//! Receipts: what a job read and wrote. A job without one was not finished.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;
use trigon_io::write_atomically;

use super::digest::{FileDigest, text_digest};
use crate::args::Job;
use crate::failure::Failure;

/// What a job read and wrote. The same on every machine.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Receipt {
    /// The version that drew it.
    pub(super) trigon: String,
    pub(super) job: Job,
    /// The models and all that they refer to, files of cameras, environments and configurations, by name.
    pub(super) read: Vec<FileDigest>,
    /// In the order in which they were written.
    pub(super) written: Vec<FileDigest>,
    /// What `--json` tells of each model but for times: nodes, materials, cameras.
    pub(super) facts: Vec<Value>,
}

/// Where the receipt of a job is.
#[derive(Clone, Debug)]
pub(super) struct ReceiptFile {
    pub(super) path: PathBuf,
}

pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");

impl ReceiptFile {
    /// In a folder. Another version may draw other bytes, so it has receipts of its own.
    pub(super) fn of(job: &Job, folder: &Path) -> Self {
        let hash = text_digest(&serde_json::json!([VERSION, job]).to_string());
        // Folders with a million files are slow.
        Self { path: folder.join(&hash[..2]).join(&hash).with_extension("json") }
    }

    /// The receipt; `None` if there is none, or none of this job.
    pub(super) fn read(&self, job: &Job) -> Option<Receipt> {
        let receipt: Receipt = serde_json::from_slice(&fs::read(&self.path).ok()?).ok()?;
        (receipt.trigon == VERSION && receipt.job == *job).then_some(receipt)
    }

    pub(super) fn write(&self, receipt: &Receipt) -> Result<(), Failure> {
        let text = serde_json::to_vec(receipt).map_err(Failure::work)?;
        let folder = self.path.parent().unwrap_or(Path::new(""));
        fs::create_dir_all(folder).map_err(|error| self.unwritten(&error))?;
        write_atomically(&self.path, |file| {
            file.write_all(&text)?;
            file.write_all(b"\n")
        })
        .map_err(Failure::work)
    }

    fn unwritten(&self, error: &io::Error) -> Failure {
        Failure::work(format!(
            "{}: its folder cannot be created ({error}); name another with --receipts",
            self.path.display()
        ))
    }
}

impl Receipt {
    /// Whether all that the job read and wrote is as it was.
    pub(super) fn is_current(&self, mut is_as_read: impl FnMut(&FileDigest) -> bool) -> bool {
        self.read.iter().all(&mut is_as_read) && self.written.iter().all(FileDigest::is_current)
    }
}

/// Facts without the times that it took.
pub(super) fn without_times(mut facts: Value) -> Value {
    let remove = |value: &mut Value| {
        if let Value::Object(members) = value {
            members.retain(|name, _| !matches!(name.as_str(), "load_seconds" | "draw_seconds"));
        }
    };
    remove(&mut facts);
    facts.get_mut("views").and_then(Value::as_array_mut).into_iter().flatten().for_each(remove);
    facts
}
