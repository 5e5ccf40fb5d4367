//! Recovery files: all actions since a document was opened, on disk while it is edited. After a
//! crash the document and its history are restored.
//!
//! A recovery file is the document as it was opened, followed by one record for each action. Records are only
//! ever appended, each with a checksum; a record that was being written during a power failure is dropped.
//! Commands are data and give the same bytes each time, so running them again restores the document, its
//! selection and its history.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::thread::JoinHandle;

use thiserror::Error;
use trigon_mesh::math::SplitMix64;

use super::document::{Document, Event};
use super::error::EditError;
use super::storage::Storage;

impl Document {
    /// Replays a recovery file on the document as it was opened.
    ///
    /// # Errors
    /// An event fails that succeeded before: then the base is another document. The events before
    /// it stay done.
    pub fn replay(&mut self, events: &[Event]) -> Result<(), EditError> {
        for event in events {
            match event {
                Event::Run(command) => drop(self.run((**command).clone())?),
                Event::Undo => self.undo()?,
                Event::Redo => self.redo()?,
            }
        }
        Ok(())
    }
}

const MAGIC: &[u8; 8] = b"TRGNREC1";
/// Length and checksum.
const HEADER: usize = 16;

/// The format of recovery files.
///
/// Eight bytes `TRGNREC1`; then records: the length of the payload (eight bytes, little-endian), its checksum
/// (eight bytes), the payload. The payload of the first record is the document as it was opened; those of the
/// others are events as JSON.
///
/// The contents of a recovery file.
#[derive(Debug, Clone, PartialEq)]
pub struct RecoveryLog {
    /// The document as it was opened: a native file.
    pub base: Vec<u8>,
    /// The events since.
    pub events: Vec<Event>,
    /// Whether the end of the file is damaged or incomplete: then the last action or actions are
    /// missing.
    pub is_cut_off: bool,
}

/// The file is not a recovery file, or nothing in it can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "this is not a recovery file of this version, or its first record is damaged; open the saved file instead"
)]
pub struct UnreadableRecovery;

impl RecoveryLog {
    /// Reads the intact part of a recovery file.
    ///
    /// # Errors
    /// Not even the document as it was opened can be read.
    pub fn read(bytes: &[u8]) -> Result<Self, UnreadableRecovery> {
        let mut rest = bytes.strip_prefix(MAGIC).ok_or(UnreadableRecovery)?;
        let (base, tail) = split_record(rest).ok_or(UnreadableRecovery)?;
        rest = tail;
        let mut events = Vec::new();
        while let Some((payload, tail)) = split_record(rest) {
            let Ok(event) = serde_json::from_slice(payload) else { break };
            events.push(event);
            rest = tail;
        }
        Ok(Self { base: base.to_vec(), events, is_cut_off: !rest.is_empty() })
    }
}

/// The start of a recovery file.
fn start(base: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(MAGIC.len() + HEADER + base.len());
    bytes.extend(MAGIC);
    append_record(&mut bytes, base);
    bytes
}

/// The record of an event.
fn record(event: &Event) -> Vec<u8> {
    let mut bytes = Vec::new();
    append_record(&mut bytes, &serde_json::to_vec(event).expect("events have string keys"));
    bytes
}

fn append_record(bytes: &mut Vec<u8>, payload: &[u8]) {
    bytes.extend((payload.len() as u64).to_le_bytes());
    bytes.extend(checksum(payload).to_le_bytes());
    bytes.extend(payload);
}

/// The first record and the rest; none if it is incomplete.
fn split_record(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk::<8>()?;
    let (sum, rest) = rest.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let (payload, rest) = rest.split_at_checked(length)?;
    (checksum(payload) == u64::from_le_bytes(*sum)).then_some((payload, rest))
}

/// Eight bytes at a time through the mixing function of SplitMix64. It detects damage, but does not prevent forgery.
fn checksum(bytes: &[u8]) -> u64 {
    let mut sum = SplitMix64::mix(bytes.len() as u64 ^ SplitMix64::INCREMENT);
    for chunk in bytes.chunks(8) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        sum = SplitMix64::mix(sum.wrapping_add(SplitMix64::INCREMENT) ^ u64::from_le_bytes(word));
    }
    sum
}

/// The state of the recovery file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecoveryStatus {
    /// How many events are on the disk, synced.
    pub written: usize,
    /// Why nothing more is written; show it to the user, who should save.
    pub error: Option<String>,
}

/// Appends events to a recovery file. Dropping it waits until everything is written.
#[derive(Debug)]
pub struct RecoveryWriter {
    path: PathBuf,
    /// Gone when the writer ends.
    events: Option<Sender<Event>>,
    thread: Option<JoinHandle<Box<dyn Storage + Send>>>,
    status: Arc<Mutex<RecoveryStatus>>,
}

impl RecoveryWriter {
    /// Starts a recovery file with the document as it was opened, a native file. It replaces another file of
    /// this name in one step, once it is complete.
    #[must_use]
    pub fn start(storage: Box<dyn Storage + Send>, path: &Path, base: Vec<u8>) -> Self {
        let (events, receiver) = channel();
        let status = Arc::new(Mutex::new(RecoveryStatus::default()));
        let writing = Writing { storage, path: path.to_owned(), status: Arc::clone(&status) };
        let thread = thread::spawn(move || writing.run(&base, &receiver));
        Self { path: path.to_owned(), events: Some(events), thread: Some(thread), status }
    }

    /// Appends events. Returns at once.
    pub fn add(&self, event: Event) {
        if let Some(events) = &self.events {
            // A thread that gave up has recorded the reason in the status.
            drop(events.send(event));
        }
    }

    /// The state of the file.
    #[must_use]
    pub fn status(&self) -> RecoveryStatus {
        self.status.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Waits until everything is written, then removes the file: the document was closed and does
    /// not need one.
    pub fn remove(mut self) {
        if let Some(mut storage) = self.end() {
            // A file that is left over is offered at the next start, which does no harm.
            drop(storage.remove(&self.path));
        }
    }

    fn end(&mut self) -> Option<Box<dyn Storage + Send>> {
        self.events = None;
        self.thread.take()?.join().ok()
    }
}

impl Drop for RecoveryWriter {
    fn drop(&mut self) {
        drop(self.end());
    }
}

/// The data of the thread.
struct Writing {
    storage: Box<dyn Storage + Send>,
    path: PathBuf,
    status: Arc<Mutex<RecoveryStatus>>,
}

impl Writing {
    fn run(mut self, base: &[u8], events: &Receiver<Event>) -> Box<dyn Storage + Send> {
        if let Err(error) = crate::storage::replace(&mut *self.storage, &self.path, &start(base)) {
            self.give_up(&error.to_string());
            return self.storage;
        }
        while let Ok(event) = events.recv() {
            let mut bytes = record(&event);
            let mut count = 1;
            // Events that arrived meanwhile are written with one sync.
            while let Ok(event) = events.try_recv() {
                bytes.extend(record(&event));
                count += 1;
            }
            let written =
                self.storage.append(&self.path, &bytes).and_then(|()| self.storage.sync(&self.path));
            if let Err(error) = written {
                self.give_up(&error.to_string());
                return self.storage;
            }
            self.status.lock().unwrap_or_else(PoisonError::into_inner).written += count;
        }
        self.storage
    }

    fn give_up(&self, why: &str) {
        let message = format!("{}: recovery is off ({why}); save to keep your work", self.path.display());
        self.status.lock().unwrap_or_else(PoisonError::into_inner).error = Some(message);
    }
}

#[cfg(test)]
mod tests {
    use super::{RecoveryLog, *};
    use crate::storage::Disk;
    use proptest::prelude::*;

    fn file() -> (Vec<u8>, Vec<Event>) {
        let command = serde_json::from_str(r#"{ "op": "select_all" }"#).expect("a command");
        let events = vec![Event::Run(Box::new(command)), Event::Undo, Event::Redo, Event::Undo];
        let mut bytes = start(b"the document as it was opened");
        events.iter().for_each(|event| bytes.extend(record(event)));
        (bytes, events)
    }

    #[test]
    fn every_beginning_of_a_file_gives_the_first_events() {
        let (bytes, events) = file();
        assert_eq!(RecoveryLog::read(&bytes).expect("whole").events, events, "all of it");
        let mut counts = Vec::new();
        for length in 0..=bytes.len() {
            if let Ok(log) = RecoveryLog::read(&bytes[..length]) {
                assert_eq!(log.events, events[..log.events.len()], "the first ones");
                counts.push(log.events.len());
            }
        }
        assert!(counts.is_sorted() && counts.first() == Some(&0) && counts.last() == Some(&4), "{counts:?}");
    }

    #[test]
    fn the_checksum_of_nothing_is_the_first_number_of_splitmix64() {
        assert_eq!(checksum(b""), 0xe220_a839_7b1d_cdaf, "as published, for the seed 0");
    }

    proptest! {
        #[test]
        fn damage_costs_what_comes_after_it_and_nothing_else(index in any::<prop::sample::Index>(), change in 1u8..) {
            let (mut bytes, events) = file();
            let index = index.index(bytes.len());
            bytes[index] ^= change;
            if let Ok(log) = RecoveryLog::read(&bytes) {
                prop_assert_eq!(&log.events[..], &events[..log.events.len()]);
                prop_assert!(log.is_cut_off, "it is said");
            }
        }
    }

    #[test]
    fn what_was_added_is_in_the_file_when_the_writer_is_gone() {
        let folder = std::env::temp_dir().join(format!("trigon-recovery-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a temporary folder");
        let path = folder.join("a.recovery");
        let writer = RecoveryWriter::start(Box::new(Disk), &path, b"base".to_vec());
        (0..1000).for_each(|_| writer.add(Event::Undo));
        drop(writer);
        let log = RecoveryLog::read(&std::fs::read(&path).expect("written")).expect("whole");
        assert_eq!(
            (log.base.as_slice(), log.events.len(), log.is_cut_off),
            (&b"base"[..], 1000, false),
            "all"
        );
        RecoveryWriter::start(Box::new(Disk), &path, b"base".to_vec()).remove();
        assert!(!path.exists(), "a document that was closed needs none");
        std::fs::remove_dir_all(&folder).expect("it was made above");
    }

    #[test]
    fn a_folder_that_is_not_there_is_said_and_nothing_stops() {
        let path = Path::new("/nowhere/at/all/a.recovery");
        let mut writer = RecoveryWriter::start(Box::new(Disk), path, b"base".to_vec());
        writer.add(Event::Undo);
        drop(writer.end());
        let status = writer.status();
        assert!(status.error.expect("said").contains("save"), "with the remedy");
        assert_eq!(status.written, 0, "nothing was written");
    }
}
