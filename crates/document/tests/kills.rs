//! Programs that are killed while they save: whatever the moment, the file is whole afterwards, and a set of files is of
//! one version once its main file is opened.
//!
//! Each of 500 runs, and of 300 for sets, starts this program again as a child that saves the next version and aborts
//! itself before, in the middle of, or after one of the steps of saving. No clock is asked.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, abort};

use trigon_document::{Disk, SetFile, Storage, backup_path, finish_set, save, save_set};

const KILLS: u32 = 500;
/// Of the kills at least so many are between the first write and the folder's sync.
const INSIDE: u32 = 400;
const SET_KILLS: u32 = 300;
/// Of these kills at least so many leave a set that has to be completed.
const SETS_COMPLETED: u32 = 30;

/// A disk whose user is killed at a step.
struct Killing {
    disk: Disk,
    steps_left: u32,
    /// Which share of a write is done first, in eighths.
    eighths: usize,
}

impl Killing {
    /// Whether the program ends within this step; else it is counted.
    fn ends_here(&mut self) -> bool {
        if self.steps_left == 0 {
            return true;
        }
        self.steps_left -= 1;
        false
    }

    fn step(&mut self, step: impl FnOnce(&mut Disk) -> io::Result<()>) -> io::Result<()> {
        if self.ends_here() {
            abort();
        }
        step(&mut self.disk)
    }
}

impl Storage for Killing {
    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.disk.read(path)
    }

    fn exists(&self, path: &Path) -> bool {
        self.disk.exists(path)
    }

    fn resolve(&self, path: &Path) -> PathBuf {
        self.disk.resolve(path)
    }

    fn keep_permissions(&mut self, old: &Path, new: &Path) -> io::Result<()> {
        self.step(|disk| disk.keep_permissions(old, new))
    }

    fn create(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if self.ends_here() {
            self.disk.create(path, &bytes[..bytes.len() * self.eighths / 8])?;
            abort();
        }
        self.disk.create(path, bytes)
    }

    fn append(&mut self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.step(|disk| disk.append(path, bytes))
    }

    fn sync(&mut self, path: &Path) -> io::Result<()> {
        self.step(|disk| disk.sync(path))
    }

    fn link(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        self.step(|disk| disk.link(from, to))
    }

    fn rename(&mut self, from: &Path, to: &Path) -> io::Result<()> {
        self.step(|disk| disk.rename(from, to))
    }

    fn remove(&mut self, path: &Path) -> io::Result<()> {
        self.step(|disk| disk.remove(path))
    }

    fn sync_folder(&mut self, folder: &Path) -> io::Result<()> {
        self.step(|disk| disk.sync_folder(folder))
    }
}

/// Every byte of a version tells which one it is and where it stands.
fn contents(version: u32) -> Vec<u8> {
    let word = |index: u32| index.wrapping_mul(0x9e37_79b9) ^ version;
    let mut bytes = version.to_le_bytes().to_vec();
    bytes.extend((0..20_000 + version % 7).flat_map(|index| word(index).to_le_bytes()));
    bytes
}

/// The version of a whole file.
fn version_of(bytes: &[u8]) -> Option<u32> {
    let version = u32::from_le_bytes(bytes.get(..4)?.try_into().ok()?);
    (bytes == contents(version)).then_some(version)
}

/// Which share of the first write is done before a kill, in eighths.
fn share(version: u32) -> usize {
    version as usize % 9
}

fn child(path: &Path, version: u32, steps: u32) -> ExitCode {
    let mut storage = Killing { disk: Disk, steps_left: steps, eighths: share(version) };
    let is_set = path.extension().is_some_and(|ending| ending == "obj");
    let is_saved = match is_set {
        true => save_version(&mut storage, path, version),
        false => save(&mut storage, path, &contents(version)).is_ok(),
    };
    if is_saved { ExitCode::SUCCESS } else { ExitCode::from(3) }
}

/// The files of a set with this main file, which comes last.
fn set(path: &Path) -> [PathBuf; 3] {
    ["png", "mtl", "obj"].map(|ending| path.with_extension(ending))
}

fn save_version(storage: &mut dyn Storage, path: &Path, version: u32) -> bool {
    let bytes = contents(version);
    let files = set(path).map(|path| SetFile { path, bytes: &bytes });
    save_set(storage, &files).is_ok()
}

#[expect(clippy::print_stdout, reason = "a test without a harness tells by itself what it did")]
fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, path, version, steps] = &arguments[..]
        && flag == "--child"
    {
        let number = |text: &String| text.parse().expect("the parent gives a number");
        return child(Path::new(path), number(version), number(steps));
    }
    let folder = std::env::temp_dir().join(format!("trigon-kills-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a temporary folder");
    let path = folder.join("model.glb");
    let (inside, saved) = run(&path);
    let completed = run_sets(&folder.join("model.obj"));
    std::fs::remove_dir_all(&folder).expect("it was made above");
    println!("{SET_KILLS} kills while saving sets, {completed} of which were completed at the next opening");
    assert!(completed >= SETS_COMPLETED, "only {completed} of {SET_KILLS} had to be completed");
    println!("{KILLS} kills, {inside} of them while saving, {saved} saves between them: whole each time");
    assert!(inside >= INSIDE, "only {inside} of {KILLS} were between the first write and the folder's sync");
    ExitCode::SUCCESS
}

/// How many of the children were killed between the first write and the folder's sync, and how many
/// saved.
fn run(path: &PathBuf) -> (u32, u32) {
    let program = std::env::current_exe().expect("this program");
    save(&mut Disk, path, &contents(0)).expect("a first version");
    let (mut killed, mut inside, mut saved, mut last) = (0, 0, 0, 0);
    let mut version = 0;
    while killed < KILLS {
        version += 1;
        // Saving takes up to eight steps; now and then none is left to be killed at.
        let steps = version * 5 % 9;
        let mut command = Command::new(&program);
        command.arg("--child").arg(path).args([version.to_string(), steps.to_string()]);
        let status = command.status().expect("this program can be started");
        if status.success() {
            (saved, last) = (saved + 1, version);
        } else {
            assert_ne!(status.code(), Some(3), "no step failed by itself");
            killed += 1;
            inside += u32::from(steps > 0 || share(version) > 0);
        }
        let bytes = std::fs::read(path).expect("there is always a file");
        let found = version_of(&bytes).unwrap_or_else(|| panic!("killed at step {steps}: a torn file"));
        assert!(found >= last, "killed at step {steps}: version {found} after {last} was saved");
        last = found;
        if let Ok(bytes) = std::fs::read(backup_path(path)) {
            assert!(version_of(&bytes).is_some(), "killed at step {steps}: a torn backup");
        }
    }
    (inside, saved)
}

/// How many sets had to be completed.
fn run_sets(path: &Path) -> u32 {
    let program = std::env::current_exe().expect("this program");
    assert!(save_version(&mut Disk, path, 0), "a first version");
    let (mut killed, mut completed, mut last, mut version) = (0, 0, 0, 0);
    while killed < SET_KILLS {
        version += 1;
        // Saving three files takes up to about thirty steps.
        let steps = version * 5 % 33;
        let mut command = Command::new(&program);
        command.arg("--child").arg(path).args([version.to_string(), steps.to_string()]);
        let status = command.status().expect("this program can be started");
        assert_ne!(status.code(), Some(3), "no step failed by itself");
        completed += u32::from(finish_set(&mut Disk, path).expect("nothing fails"));
        let found = set(path).map(|path| version_of(&std::fs::read(path).expect("there is always a file")));
        let [Some(one), ..] = found else { panic!("killed at step {steps}: a torn file") };
        assert_eq!(found, [Some(one); 3], "killed at step {steps}: a mixture");
        assert!(one >= last, "killed at step {steps}: version {one} after {last} was saved");
        last = if status.success() { version } else { one };
        killed += u32::from(!status.success());
        assert!(!status.success() || one == version, "what is said to be saved is saved");
    }
    completed
}
