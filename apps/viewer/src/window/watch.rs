//! Telling when files change. Their folders are watched, not the files: editors write
//! another file and give it the old one's name, or delete and make anew.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use notify::{Event, RecommendedWatcher, RecursiveMode, Watcher};

/// Files are at rest when nothing has happened to them for this long: a file that is
/// half written is not worth loading.
const QUIET: Duration = Duration::from_millis(150);

/// Watches the files of one model.
pub(super) struct Watch {
    watcher: RecommendedWatcher,
    files: Arc<Mutex<HashSet<PathBuf>>>,
    folders: HashSet<PathBuf>,
    changed: Arc<AtomicBool>,
}

impl Watch {
    /// Watches nothing yet. `wake` is called when files have changed and are at rest.
    ///
    /// # Errors
    /// When the system cannot watch files.
    pub(super) fn new(wake: impl Fn() + Send + 'static) -> notify::Result<Self> {
        let files = Arc::new(Mutex::new(HashSet::new()));
        let changed = Arc::new(AtomicBool::new(false));
        let (sender, receiver) = channel();
        let watched = Arc::clone(&files);
        let watcher = notify::recommended_watcher(move |event| tell(event, &watched, &sender))?;
        let flag = Arc::clone(&changed);
        thread::Builder::new().name("trigon-watch".into()).spawn(move || {
            wait(&receiver, || {
                flag.store(true, Ordering::Relaxed);
                wake();
            });
        })?;
        Ok(Self { watcher, files, folders: HashSet::new(), changed })
    }

    /// Watches these files instead of those before.
    ///
    /// # Errors
    /// For a folder that cannot be watched; the others are.
    pub(super) fn follow(&mut self, files: &[PathBuf]) -> notify::Result<()> {
        let files: HashSet<PathBuf> = files.iter().map(|file| real(file)).collect();
        let folders: HashSet<PathBuf> =
            files.iter().filter_map(|file| file.parent()).map(Path::to_owned).collect();
        *self.files.lock().unwrap_or_else(PoisonError::into_inner) = files;
        for folder in self.folders.difference(&folders) {
            // It may be gone.
            let _ = self.watcher.unwatch(folder);
        }
        let new = folders.difference(&self.folders);
        let refused = new.filter_map(|folder| self.watcher.watch(folder, RecursiveMode::NonRecursive).err());
        let refused = refused.last();
        self.folders = folders;
        refused.map_or(Ok(()), Err)
    }

    /// Whether files have changed since this was last asked.
    pub(super) fn take_changed(&self) -> bool {
        self.changed.swap(false, Ordering::Relaxed)
    }
}

/// Passes on what concerns the files. That a file was read concerns nobody.
fn tell(event: notify::Result<Event>, files: &Mutex<HashSet<PathBuf>>, sender: &Sender<()>) {
    let Ok(event) = event else { return };
    let files = files.lock().unwrap_or_else(PoisonError::into_inner);
    if !event.kind.is_access() && event.paths.iter().any(|path| files.contains(path)) {
        // Fails when the viewer ends.
        let _ = sender.send(());
    }
}

/// Calls `rest` whenever something has happened and then nothing for a while.
fn wait(happened: &Receiver<()>, rest: impl Fn()) {
    while happened.recv().is_ok() {
        while happened.recv_timeout(QUIET).is_ok() {}
        rest();
    }
}

/// As the system tells of it: without links in its folder's path.
fn real(file: &Path) -> PathBuf {
    let file = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    match (file.parent().and_then(|folder| folder.canonicalize().ok()), file.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => file,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Longer than any machine takes to tell of a change.
    const PATIENCE: Duration = Duration::from_secs(30);

    #[test]
    fn files_are_watched_through_writing_renaming_and_making_anew() {
        let folder = tempfile::tempdir().expect("a folder");
        let [file, part, other] = ["a.obj", "a.mtl", "b.obj"].map(|name| folder.path().join(name));
        [&file, &part, &other].iter().for_each(|path| fs::write(path, "1").expect("written"));
        let (wake, woken) = channel();
        let mut watch = Watch::new(move || {
            let _ = wake.send(());
        })
        .expect("the system can watch");
        watch.follow(&[file.clone(), part.clone()]).expect("the folder can be watched");
        let told = |what: &str| {
            woken.recv_timeout(PATIENCE).unwrap_or_else(|_| panic!("not told of {what}"));
            assert!(watch.take_changed() && !watch.take_changed(), "once, of {what}");
        };
        fs::write(&part, "2").expect("written");
        told("writing");
        let draft = folder.path().join("draft");
        fs::write(&draft, "3").expect("written");
        fs::rename(&draft, &file).expect("renamed");
        told("renaming over");
        fs::remove_file(&file).expect("removed");
        told("removing");
        fs::write(&file, "4").expect("written");
        told("making anew");
        fs::write(&other, "5").expect("written");
        assert!(woken.recv_timeout(4 * QUIET).is_err(), "another file is nobody's concern");
        let reading = fs::read(&file).expect("read");
        assert!(woken.recv_timeout(4 * QUIET).is_err(), "nor is reading {} bytes", reading.len());
    }
}
