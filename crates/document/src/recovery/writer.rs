//! Writing the recovery file on another thread, so that the caller never waits for a disk.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};

use super::log;
use crate::document::Event;
use crate::storage::Storage;

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
        if let Err(error) = crate::storage::replace(&mut *self.storage, &self.path, &log::start(base)) {
            self.give_up(&error.to_string());
            return self.storage;
        }
        while let Ok(event) = events.recv() {
            let mut bytes = log::record(&event);
            let mut count = 1;
            // Events that arrived meanwhile are written with one sync.
            while let Ok(event) = events.try_recv() {
                bytes.extend(log::record(&event));
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
    use super::super::RecoveryLog;
    use super::*;
    use crate::storage::Disk;

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
