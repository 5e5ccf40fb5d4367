//! The command line of `trigon-viewer batch`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Parser;

use super::values;
use crate::report::Level;

/// Draw many jobs: each line of a file is one, an object of JSON with the models and the flags of a command that
/// writes images.
///
/// A flag is written without its dashes, "input" has the names of the models, and paths are relative to the folder in
/// which the command runs. A job that fails does not stop the others. A job that is done gets a receipt with the
/// SHA-256 of all files that it read and wrote.
#[derive(Debug, Parser)]
#[command(name = "trigon-viewer batch", version, after_help = AFTER_HELP, max_term_width = 100)]
pub(crate) struct BatchArgs {
    /// The list of jobs; - is standard input
    #[arg(value_name = "JOBS.jsonl")]
    pub(crate) jobs: PathBuf,

    /// Do every N-th job from number I on, counted from 0: a part for each of N processes or machines
    #[arg(long, value_name = "I/N", default_value = "0/1")]
    pub(crate) shard: Shard,

    /// Skip the jobs whose receipts are there and agree with the files that they name
    #[arg(long)]
    pub(crate) resume: bool,

    /// Draw the jobs again, and compare each file with the receipts instead of writing it: exit code 3 if one differs
    #[arg(long, conflicts_with = "resume")]
    pub(crate) verify: bool,

    /// The folder of the receipts [default: the name of the list with .receipts]
    #[arg(long, value_name = "FOLDER")]
    pub(crate) receipts: Option<PathBuf>,

    /// Use at most this many threads for an image; the images do not depend on it [default: one per core]
    #[arg(long, value_name = "N", value_parser = values::threads)]
    pub(crate) threads: Option<NonZeroUsize>,

    /// Print what became of each job to standard output, one JSON object per line
    #[arg(long)]
    pub(crate) json: bool,

    /// How much to print on standard error; info is a line for each job, debug one for each file
    #[arg(long, default_value = "info", value_name = "LEVEL")]
    pub(crate) verbose: Level,
}

const AFTER_HELP: &str = "\
Example of a line:
  {\"input\": \"chair.glb\", \"cameras\": \"rig.json\", \"output\": \"out/chair/{frame:3}.png\", \"outputs\": [\"depth\", \"object-ids\"]}

Exit codes: 0 all done; 1 a job failed; 2 the command line or a job is invalid; 3 a file differs from its receipt.
docs/scale.md has complete files for GNU parallel, Slurm and Kubernetes.";

/// A part of a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// Whether a job is in it, by its number in the list.
    pub(crate) fn contains(self, job: usize) -> bool {
        job % self.count == self.index
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(index, count)| {
            Some(Self { index: index.trim().parse().ok()?, count: count.trim().parse().ok()? })
        });
        let shard = numbers.ok_or("write the number of the part and how many there are, such as 0/4")?;
        if shard.index < shard.count {
            return Ok(shard);
        }
        Err(format!(
            "parts are counted from 0: of {0} parts the last is {1}/{0}",
            shard.count,
            shard.count.saturating_sub(1)
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_job_is_in_one_shard() {
        for count in 1..6 {
            let shards =
                (0..count).map(|index| format!("{index}/{count}").parse::<Shard>().expect("a shard"));
            let shards: Vec<Shard> = shards.collect();
            for job in 0..20 {
                assert_eq!(shards.iter().filter(|shard| shard.contains(job)).count(), 1, "{job} of {count}");
            }
        }
        for (text, word) in
            [("4/4", "the last is 3/4"), ("0/0", "counted from 0"), ("1", "such as 0/4"), ("-1/2", "such as")]
        {
            assert!(text.parse::<Shard>().expect_err("refused").contains(word), "{text}");
        }
    }
}
