//! Watches files for changes. Their folders are watched, not the files: editors write another file
//! and rename it, or delete and create it again.

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
            wait(&receiver, is_followed, || {
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

/// Passes on what concerns the files.
fn tell(event: notify::Result<Event>, files: &Mutex<HashSet<PathBuf>>, sender: &Sender<()>) {
    let Ok(event) = event else { return };
    if concerns(&event, &files.lock().unwrap_or_else(PoisonError::into_inner)) {
        // Fails when the viewer ends.
        let _ = sender.send(());
    }
}

/// Whether one of the files has changed. That it was read concerns nobody.
fn concerns(event: &Event, files: &HashSet<PathBuf>) -> bool {
    !event.kind.is_access() && event.paths.iter().any(|path| files.contains(path))
}

/// Calls `rest` whenever something has happened and, as `more` says, nothing follows it.
fn wait(happened: &Receiver<()>, more: impl Fn(&Receiver<()>) -> bool, rest: impl Fn()) {
    while happened.recv().is_ok() {
        while more(happened) {}
        rest();
    }
}

/// Whether something more happens before files count as being at rest.
fn is_followed(happened: &Receiver<()>) -> bool {
    happened.recv_timeout(QUIET).is_ok()
}

/// The path that the system reports: without links in its folder's path.
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
    use notify::EventKind;
    use notify::event::{AccessKind, CreateKind, ModifyKind, RemoveKind};
    use std::fs;
    use std::sync::atomic::AtomicU32;

    #[test]
    fn only_changes_of_the_files_themselves_concern_anybody() {
        let files = HashSet::from(["a.obj", "a.mtl"].map(PathBuf::from));
        let any = [EventKind::Any, EventKind::Access(AccessKind::Any)];
        let changes = [
            EventKind::Create(CreateKind::Any),
            EventKind::Modify(ModifyKind::Any),
            EventKind::Remove(RemoveKind::Any),
        ];
        for (kind, path, expected) in [
            (any[0], "a.obj", true),
            (changes[0], "a.mtl", true),
            (changes[1], "a.obj", true),
            (changes[2], "a.obj", true),
            (any[1], "a.obj", false),
            (changes[1], "b.obj", false),
        ] {
            let event = Event::new(kind).add_path(path.into());
            assert_eq!(concerns(&event, &files), expected, "{event:?}");
        }
        let moved = Event::new(changes[1]).add_path("draft".into()).add_path("a.obj".into());
        assert!(concerns(&moved, &files), "another file became one of them");
    }

    #[test]
    fn changes_that_follow_each_other_are_told_once() {
        let ((sender, happened), rests) = (channel(), AtomicU32::new(0));
        // Twice two changes; then the sender is gone.
        let following = Mutex::new(vec![false, true, false, true].into_iter());
        (0..4).for_each(|_| sender.send(()).expect("somebody listens"));
        drop(sender);
        let more = |happened: &Receiver<()>| {
            let follows = following.lock().expect("nobody panics").next_back().expect("asked four times");
            follows && happened.try_recv().is_ok()
        };
        wait(&happened, more, || {
            rests.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(rests.into_inner(), 2, "each time that nothing followed");
    }

    /// The changes that the system reports in a folder, up to a file that the test makes there to end them.
    fn told(events: &Receiver<notify::Result<Event>>, sign: &Path) -> Vec<Event> {
        fs::write(sign, "").expect("written");
        let events = events.iter().map(|event| event.expect("the system can watch"));
        let before = events.take_while(|event| !event.paths.iter().any(|path| path == sign)).collect();
        fs::remove_file(sign).expect("it was there");
        before
    }

    /// The system reports changes in their order, so that file comes after all earlier ones.
    #[cfg(target_os = "linux")]
    #[test]
    fn the_system_tells_of_writing_renaming_and_making_anew() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = real(folder.path());
        let [file, other, draft] = ["a.obj", "b.obj", "draft"].map(|name| folder.join(name));
        [&file, &other].iter().for_each(|path| fs::write(path, "1").expect("written"));
        let (sender, events) = channel();
        let mut watcher = notify::recommended_watcher(sender).expect("the system can watch");
        watcher.watch(&folder, RecursiveMode::NonRecursive).expect("the folder can be watched");
        let files = HashSet::from([file.clone()]);
        let mut signs = 0;
        let mut check = |what: &str, expected: bool, act: &dyn Fn() -> std::io::Result<()>| {
            act().unwrap_or_else(|error| panic!("{what}: {error}"));
            signs += 1;
            let told = told(&events, &folder.join(format!("sign {signs}")));
            assert_eq!(told.iter().any(|event| concerns(event, &files)), expected, "{what}: {told:?}");
        };
        check("writing", true, &|| fs::write(&file, "2"));
        check("renaming over", true, &|| fs::write(&draft, "3").and_then(|()| fs::rename(&draft, &file)));
        check("removing", true, &|| fs::remove_file(&file));
        check("making anew", true, &|| fs::write(&file, "4"));
        check("writing another file", false, &|| fs::write(&other, "5"));
        check("reading", false, &|| fs::read(&file).map(drop));
    }

    #[test]
    fn files_that_are_followed_wake_the_window() {
        let folder = tempfile::tempdir().expect("a folder");
        let files = ["a.obj", "a.mtl"].map(|name| folder.path().join(name));
        files.iter().for_each(|path| fs::write(path, "1").expect("written"));
        let (wake, woken) = channel();
        let wake = move || {
            // Fails when the test is over.
            let _ = wake.send(());
        };
        let mut watch = Watch::new(wake).expect("the system can watch");
        watch.follow(&files).expect("the folder can be watched");
        assert!(!watch.take_changed(), "nothing has happened");
        fs::write(&files[1], "2").expect("written");
        woken.recv().expect("it wakes when the file is at rest");
        assert!(watch.take_changed(), "and says why");
    }
}
