//! Programs that are told to end while they write: no temporary file stays behind, and the shell sees why they ended.
//!
//! Each run starts this program again as a child. The child writes the first half of a file, says so, and waits; no clock
//! is asked.

#[cfg(not(unix))]
fn main() {}

#[cfg(unix)]
fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [flag, path] if flag == "--child" => unix::child(std::path::Path::new(path)),
        // A harness would list its tests.
        [flag, ..] if flag == "--list" => {}
        _ => unix::parent(),
    }
}

#[cfg(unix)]
mod unix {
    use std::io::{BufRead, BufReader, Read};
    use std::os::unix::process::ExitStatusExt;
    use std::path::Path;
    use std::process::{Child, Command, Stdio};

    /// The numbers of POSIX, to which a shell adds 128.
    const SIGNALS: [(&str, i32); 3] = [("HUP", 1), ("INT", 2), ("TERM", 15)];

    #[expect(clippy::print_stdout, reason = "a test without a harness tells by itself what it did")]
    pub(super) fn parent() {
        let folder = std::env::temp_dir().join(format!("trigon-signals-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a temporary folder");
        let path = folder.join("a.txt");
        for (name, number) in SIGNALS {
            std::fs::write(&path, "old").expect("a file");
            if is_ignored(number) {
                // Whoever runs this test ignores it, and what is ignored stays ignored: see below.
                continue;
            }
            let status = end(start(&[], &path), name);
            assert_eq!(status.signal(), Some(number), "SIG{name}: ended by it, not by an exit of its own");
            assert_eq!(names(&folder), ["a.txt"], "SIG{name}: nothing else stays");
            assert_eq!(std::fs::read(&path).expect("there"), b"old", "SIG{name}: the old file");
        }
        // `nohup` starts programs that ignore hang-ups.
        let mut child = start(&["nohup"], &path);
        send(&child, "HUP");
        drop(child.stdin.take());
        assert!(child.wait().expect("a child").success(), "it goes on");
        assert_eq!(std::fs::read(&path).expect("there"), b"half and half", "the whole file");
        assert_eq!(names(&folder), ["a.txt"], "nothing else stays");
        std::fs::remove_dir_all(&folder).expect("it was made above");
        println!("{} signals, and one that is ignored: no temporary file stays", SIGNALS.len());
    }

    /// Whether this program, and so each child, ignores a signal: `nohup` and shells in the background see to that. Known
    /// on Linux alone.
    fn is_ignored(number: i32) -> bool {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
    }

    /// Starts the child, by another program if one is given, and waits until it has written a half.
    fn start(by: &[&str], path: &Path) -> Child {
        let program = std::env::current_exe().expect("this program");
        let mut words = by.iter().map(std::ffi::OsString::from).chain([program.into_os_string()]);
        let mut command = Command::new(words.next().expect("at least this program"));
        command.args(words).arg("--child").arg(path);
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("it can be started");
        let mut line = String::new();
        let stdout = child.stdout.as_mut().expect("a pipe");
        BufReader::new(stdout).read_line(&mut line).expect("the child says when it is ready");
        assert_eq!(line, "half\n", "it is ready");
        let folder = path.parent().expect("in a folder");
        assert_eq!(
            names(folder).iter().filter(|name| name.ends_with(".part")).count(),
            1,
            "a temporary file"
        );
        child
    }

    fn send(child: &Child, signal: &str) {
        let sent = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(sent.expect("there is `kill`").success(), "SIG{signal} is sent");
    }

    fn end(mut child: Child, signal: &str) -> std::process::ExitStatus {
        // Waiting closes the child's input, which would let it write the other half before the signal comes.
        let input = child.stdin.take();
        send(&child, signal);
        let status = child.wait().expect("a child");
        drop(input);
        status
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).expect("a folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// Writes a half, says so, and writes the other when its input ends.
    #[expect(clippy::print_stdout, reason = "the parent reads when it is ready")]
    pub(super) fn child(path: &Path) {
        trigon_io::end_on_signals().expect("the system tells of signals");
        let written = trigon_io::write_atomically(path, |file| {
            file.write_all(b"half ")?;
            file.flush()?;
            println!("half");
            std::io::stdin().lock().read_to_end(&mut Vec::new())?;
            file.write_all(b"and half")
        });
        written.expect("written");
    }
}
