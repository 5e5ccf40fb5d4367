//! `trigon-viewer batch`: draws the jobs of a list, or a part of them. Jobs are independent; each that is done has a
//! receipt, by which it is skipped or verified later.

mod digest;
mod drawing;
mod list;
mod receipt;

use std::collections::HashSet;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::Serialize;

use self::digest::{FileDigest, InputDigests};
use self::drawing::{JobDrawing, JobSettings, draw};
use self::list::ListedJob;
use self::receipt::{Receipt, ReceiptFile, VERSION, without_times};
use crate::args::{BatchArgs, STDIN};
use crate::failure::Failure;
use crate::outlet::Folders;
use crate::report::{Level, Reporter};
use crate::stdout::write_json;

/// Draws or verifies the jobs of the command line's shard; returns the worst exit code.
pub(crate) fn run(args: &BatchArgs) -> u8 {
    let reporter = Reporter::new(args.verbose);
    match Batch::new(args).and_then(|batch| Ok((batch, list::read(&args.jobs, args.shard)?))) {
        Ok((batch, jobs)) => batch.run(&jobs),
        Err(failure) => {
            reporter.error(&failure);
            failure.exit_code()
        }
    }
}

/// A run over a list.
struct Batch<'a> {
    args: &'a BatchArgs,
    reporter: Reporter,
    receipts: PathBuf,
    inputs: InputDigests,
    /// Of images that are named by their cameras: jobs must not replace each other's.
    taken: HashSet<PathBuf>,
}

/// What became of a job that did not fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum JobOutcome {
    Drawn,
    /// It was done before.
    Present,
    /// Drawn again, it is the same.
    Verified,
}

/// The line about a job on standard output.
#[derive(Serialize)]
struct JobFacts<'a> {
    line: usize,
    outcome: &'static str,
    receipt: &'a Path,
    exit_code: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    failure: Option<String>,
}

/// How many jobs had which outcome.
#[derive(Default)]
struct Tally {
    drawn: usize,
    present: usize,
    verified: usize,
    failed: usize,
    worst: u8,
}

impl<'a> Batch<'a> {
    fn new(args: &'a BatchArgs) -> Result<Self, Failure> {
        let receipts = match (&args.receipts, args.jobs.as_os_str() == STDIN) {
            (Some(folder), _) => folder.clone(),
            (None, false) => {
                let mut name = args.jobs.clone().into_os_string();
                name.push(".receipts");
                name.into()
            }
            (None, true) => {
                return Err(Failure::Usage(
                    "a list from standard input has no name; name a folder with --receipts".to_owned(),
                ));
            }
        };
        let reporter = Reporter::new(args.verbose);
        Ok(Self { args, reporter, receipts, inputs: InputDigests::default(), taken: HashSet::new() })
    }

    fn run(mut self, jobs: &[ListedJob]) -> u8 {
        let mut tally = Tally::default();
        for listed in jobs {
            let receipt_file = ReceiptFile::of(&listed.job, &self.receipts);
            let done = self.visit(listed, &receipt_file);
            tally.add(&done);
            if let Err(failure) = self.tell(listed, &receipt_file, done) {
                // Whoever reads standard output would miss jobs.
                self.reporter.error(&failure);
                return failure.exit_code();
            }
        }
        let Tally { drawn, present, verified, failed, worst } = tally;
        let (name, count) = (self.args.jobs.display(), jobs.len());
        self.reporter.info(match self.args.verify {
            true => format!("{name}: {count} jobs, {verified} verified, {failed} failed"),
            false => format!("{name}: {count} jobs, {drawn} drawn, {present} there already, {failed} failed"),
        });
        worst
    }

    fn visit(&mut self, listed: &ListedJob, receipt_file: &ReceiptFile) -> Result<JobOutcome, Failure> {
        if self.args.verify {
            return self.verify(listed, receipt_file).map(|()| JobOutcome::Verified);
        }
        if self.args.resume && self.is_present(listed, receipt_file) {
            return Ok(JobOutcome::Present);
        }
        let drawing = self.draw(listed, Folders::Created)?;
        let receipt = self.receipt(listed, drawing)?;
        receipt_file.write(&receipt)?;
        Ok(JobOutcome::Drawn)
    }

    /// Whether a job is done, and nothing has changed since.
    fn is_present(&mut self, listed: &ListedJob, receipt_file: &ReceiptFile) -> bool {
        let Some(receipt) = receipt_file.read(&listed.job) else { return false };
        let inputs = &mut self.inputs;
        let is_current = receipt.is_current(|file| inputs.is_current(file));
        // As if it had been drawn by this run.
        is_current
            && (!listed.job.names_cameras()
                || receipt.written.iter().all(|file| self.taken.insert((&file.file).into())))
    }

    /// Draws a job again, and compares what would be written with its receipt.
    fn verify(&mut self, listed: &ListedJob, receipt_file: &ReceiptFile) -> Result<(), Failure> {
        let Some(receipt) = receipt_file.read(&listed.job) else {
            return Err(Failure::work(format!(
                "{}: there is no such receipt of trigon {VERSION}; draw the job first",
                receipt_file.path.display()
            )));
        };
        if let Some(changed) = receipt.read.iter().find(|file| !self.inputs.is_current(file)) {
            return Err(Failure::Mismatch(format!(
                "{}: is not the file that the images were drawn from",
                changed.file
            )));
        }
        // Files may be on another machine; those that are here must be the right ones.
        let is_here = |file: &&FileDigest| Path::new(&file.file).exists();
        if let Some(changed) = receipt.written.iter().filter(is_here).find(|file| !file.is_current()) {
            return Err(Failure::Mismatch(format!(
                "{}: is not what was drawn; draw it again with --resume",
                changed.file
            )));
        }
        let folder = tempfile::tempdir()
            .map_err(|error| Failure::work(format!("there is no temporary folder ({error}); set TMPDIR")))?;
        let drawing = self.draw(listed, Folders::Only(folder.path()))?;
        let again = self.receipt(listed, drawing)?;
        let [before, now] = [&receipt, &again].map(|receipt| receipt.written.iter());
        match before
            .clone()
            .find(|file| !again.written.contains(file))
            .or(now.clone().find(|file| !receipt.written.contains(file)))
        {
            None => Ok(()),
            Some(different) => Err(Failure::Mismatch(format!(
                "{}: drawn again, it is not the same ({} of {} files differ)",
                different.file,
                before.filter(|file| !again.written.contains(file)).count(),
                receipt.written.len()
            ))),
        }
    }

    fn draw(&mut self, listed: &ListedJob, folders: Folders<'_>) -> Result<JobDrawing, Failure> {
        // At debug each file is told, else only warnings.
        let level = if self.args.verbose == Level::Debug {
            Level::Debug
        } else {
            self.args.verbose.min(Level::Warning)
        };
        let words: Vec<OsString> =
            self.args.threads.iter().map(|threads| format!("--threads={threads}").into()).collect();
        let settings = JobSettings { words: &words, folders, reporter: Reporter::new(level) };
        // The list tells all other names apart.
        let (mut own, is_shared) = (HashSet::new(), listed.job.names_cameras());
        draw(&listed.job, &settings, if is_shared { &mut self.taken } else { &mut own })
    }

    fn receipt(&mut self, listed: &ListedJob, drawing: JobDrawing) -> Result<Receipt, Failure> {
        let unread = |path: &Path, error: &std::io::Error| {
            Failure::work(format!("{}: cannot be read again ({error}); draw the job again", path.display()))
        };
        let digest = |path: &PathBuf| self.inputs.of(path).map_err(|error| unread(path, &error));
        let read = drawing.read.iter().map(digest).collect::<Result<_, _>>()?;
        let written = drawing
            .written
            .iter()
            .map(|file| FileDigest::of(&file.stored, &file.name).map_err(|error| unread(&file.name, &error)));
        Ok(Receipt {
            trigon: VERSION.to_owned(),
            job: listed.job.clone(),
            read,
            written: written.collect::<Result<_, _>>()?,
            facts: drawing.facts.into_iter().map(without_times).collect(),
        })
    }

    /// Says what became of a job.
    fn tell(
        &self,
        listed: &ListedJob,
        receipt_file: &ReceiptFile,
        done: Result<JobOutcome, Failure>,
    ) -> Result<(), Failure> {
        let name = format!("{}, line {}", self.args.jobs.display(), listed.line);
        match &done {
            Ok(JobOutcome::Present) => self.reporter.debug(format_args!("{name}: is there already")),
            Ok(JobOutcome::Verified) => self.reporter.info(format_args!("{name}: the same bytes")),
            Ok(_) => self.reporter.info(format_args!("{name}: drawn")),
            Err(failure) => self.reporter.error(format_args!("{name}: {failure}")),
        }
        if !self.args.json {
            return Ok(());
        }
        let (line, receipt) = (listed.line, receipt_file.path.as_path());
        write_json(&match done {
            Ok(outcome) => JobFacts { line, outcome: outcome.name(), receipt, exit_code: 0, failure: None },
            Err(failure) => JobFacts {
                line,
                outcome: "failed",
                receipt,
                exit_code: failure.exit_code(),
                failure: Some(failure.to_string()),
            },
        })
    }
}

impl JobOutcome {
    fn name(self) -> &'static str {
        match self {
            Self::Drawn => "drawn",
            Self::Present => "present",
            Self::Verified => "verified",
        }
    }
}

impl Tally {
    fn add(&mut self, done: &Result<JobOutcome, Failure>) {
        match done {
            Ok(JobOutcome::Drawn) => self.drawn += 1,
            Ok(JobOutcome::Present) => self.present += 1,
            Ok(JobOutcome::Verified) => self.verified += 1,
            Err(_) => self.failed += 1,
        }
        self.worst = self.worst.max(done.as_ref().err().map_or(0, Failure::exit_code));
    }
}
