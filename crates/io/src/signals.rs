//! Programs that are told to end: no temporary file stays behind.

use std::io;

/// From now on, a program that is interrupted (Ctrl+C), terminated or hung up removes its [temporary
/// files](crate::create_unfinished) before it ends as it would have ended anyway. A shell sees the exit codes
/// 130, 143 and 129. Signals that the program was started to ignore stay ignored. For programs, not for
/// libraries; to be called once, at their start. Does nothing where there are no such signals.
///
/// # Errors
/// The system refuses to tell of signals, or has no room for a thread.
pub fn end_on_signals() -> io::Result<()> {
    #[cfg(unix)]
    unix::end_on_signals()?;
    Ok(())
}

#[cfg(unix)]
mod unix {
    use std::{io, thread};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    use crate::unfinished::remove_unfinished;

    pub(super) fn end_on_signals() -> io::Result<()> {
        let ignored = ignored();
        let is_ignored = |signal: i32| ignored >> (signal - 1) & 1 == 1;
        let wanted = [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|&signal| !is_ignored(signal));
        let mut signals = Signals::new(wanted)?;
        let end = move || {
            for signal in signals.forever() {
                // Nothing is finished or created any more while the program ends.
                let _nothing_more = remove_unfinished();
                // It fails for signals only that do not exist.
                let _ = emulate_default_handler(signal);
            }
        };
        thread::Builder::new().name("trigon-signals".into()).spawn(end).map(drop)
    }

    /// A bit for each signal that is ignored, such as hang-ups under `nohup`. Where the system does not tell it in this
    /// file, none counts as ignored.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
    }
}
