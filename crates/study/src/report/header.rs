//! When, where and of what the report was measured: one date, one commit and one machine for all tables.

use std::fs;
use std::process::Command;
use std::time::{Instant, SystemTime, UNIX_EPOCH};

/// What all tables have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// Year, month and day.
    pub date: String,
    /// The commit that was measured, with a note if files differed from it.
    pub commit: String,
    /// The processor and its threads.
    pub machine: String,
    /// From which the order of all runs follows.
    pub seed: u64,
    /// The sittings whose times were pooled.
    pub sittings: Vec<Load>,
}

/// How a sitting shared the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Seconds from its beginning to its end.
    pub wall: f64,
    /// Seconds of processors that it used.
    pub own: f64,
    /// Seconds of processors that all other programs used meanwhile.
    pub others: f64,
}

impl Load {
    /// How many processors other programs kept busy, on average.
    #[must_use]
    pub fn busy(&self) -> f64 {
        self.others / self.wall.max(1e-9)
    }
}

/// A moment from which a load is measured.
pub struct Moment {
    at: Instant,
    own: f64,
    all: f64,
}

impl Moment {
    /// Now.
    #[must_use]
    pub fn now() -> Self {
        Self { at: Instant::now(), own: own_seconds(), all: all_seconds() }
    }

    /// What happened since then, in this process and in those that it has started and awaited.
    #[must_use]
    pub fn load(&self) -> Load {
        let own = own_seconds() - self.own;
        let others = (all_seconds() - self.all - own).max(0.0);
        Load { wall: self.at.elapsed().as_secs_f64(), own, others }
    }
}

/// Times in these files are hundredths of seconds (proc(5), `USER_HZ`).
const TICK: f64 = 0.01;

/// User and system time of this process and its children that have ended; 0 where the system does not tell.
fn own_seconds() -> f64 {
    let text = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // The name, in brackets, may hold spaces. Behind it the fields 3 and on.
    let fields = text.rsplit_once(')').map_or("", |(_, fields)| fields).split_whitespace();
    fields.skip(11).take(4).filter_map(|ticks| ticks.parse::<f64>().ok()).sum::<f64>() * TICK
}

/// What all processors did but wait.
fn all_seconds() -> f64 {
    let text = fs::read_to_string("/proc/stat").unwrap_or_default();
    let line = text.lines().next().unwrap_or_default();
    let ticks: Vec<f64> = line.split_whitespace().skip(1).filter_map(|ticks| ticks.parse().ok()).collect();
    // User, nice, system, idle, waiting, interrupts, soft interrupts, stolen.
    let is_idle = |index: usize| index == 3 || index == 4;
    ticks
        .iter()
        .take(8)
        .enumerate()
        .filter(|(index, _)| !is_idle(*index))
        .map(|(_, ticks)| ticks)
        .sum::<f64>()
        * TICK
}

impl Header {
    /// Of this moment, this machine and the repository around the current folder.
    #[must_use]
    pub fn now(seed: u64) -> Self {
        let commit = git(&["rev-parse", "--short=8", "HEAD"]).unwrap_or_else(|| "unknown".to_owned());
        let changed = git(&["status", "--porcelain", "--", "crates", "tests", "Cargo.toml"]);
        let commit =
            if changed.is_some_and(|files| !files.is_empty()) { commit + " with changes" } else { commit };
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let date = date(since.as_secs() / 86400);
        Self { date, commit, machine: processor(), seed, sittings: Vec::new() }
    }

    /// Lines of a file, which begin with `#`.
    pub(super) fn lines(&self) -> String {
        let Self { date, commit, machine, seed, sittings } = self;
        let mut text = format!("# date: {date}\n# commit: {commit}\n# machine: {machine}\n# seed: {seed}\n");
        for Load { wall, own, others } in sittings {
            text += &format!("# sitting: {wall:.0} {own:.0} {others:.0}\n");
        }
        text
    }

    /// From such lines.
    pub(super) fn parse(text: &str) -> Option<Self> {
        let lines = || text.lines().filter_map(|line| line.strip_prefix("# ")?.split_once(": "));
        let find = |name: &str| Some(lines().find(|(key, _)| *key == name)?.1.to_owned());
        let load = |numbers: &str| {
            let numbers: Vec<f64> = numbers.split(' ').filter_map(|number| number.parse().ok()).collect();
            let [wall, own, others] = numbers[..] else { return None };
            Some(Load { wall, own, others })
        };
        let sittings = lines().filter(|(key, _)| *key == "sitting").map(|(_, numbers)| load(numbers));
        Some(Self {
            date: find("date")?,
            commit: find("commit")?,
            machine: find("machine")?,
            seed: find("seed")?.parse().ok()?,
            sittings: sittings.collect::<Option<_>>()?,
        })
    }

    /// In words, for the head of a page.
    pub(super) fn words(&self) -> String {
        let Self { date, commit, machine, seed, sittings } = self;
        let busy = sittings.iter().map(Load::busy);
        let (least, most) =
            busy.fold((f64::INFINITY, 0.0_f64), |(least, most), one| (least.min(one), most.max(one)));
        let quiet = if most < 0.1 { "quiet" } else { "busy" };
        format!(
            "Measured on {date} at commit {commit} on {machine}, in {}, in random order from seed {seed}. The \
             machine was {quiet}: meanwhile other programs used {least:.2} to {most:.2} processors.",
            if sittings.len() == 1 {
                "one sitting".to_owned()
            } else {
                format!("{} sittings", sittings.len())
            }
        )
    }
}

/// What git writes, without the last line's end.
pub(super) fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8_lossy(&output.stdout).trim_end().to_owned())
}

fn processor() -> String {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    let model = model.map_or("a processor that does not tell its name", |(_, name)| name.trim());
    format!("{model} ({threads} threads)")
}

/// The day so many days after 1970-01-01 (H. Hinnant, "chrono-Compatible Low-Level Date Algorithms", 2013).
fn date(days: u64) -> String {
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let date = day - (153 * month + 2) / 5 + 1;
    let (month, later) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{date:02}", year + 400 * era + later)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_have_dates() {
        for (days, expected) in
            [(0, "1970-01-01"), (59, "1970-03-01"), (11_016, "2000-02-29"), (20_787, "2026-11-30")]
        {
            assert_eq!(date(days), expected);
        }
    }

    #[test]
    fn a_header_is_read_as_it_was_written() {
        let load = |others| Load { wall: 60.0, own: 90.0, others };
        let header = Header { sittings: vec![load(3.0), load(30.0)], ..Header::now(7) };
        assert_eq!(Header::parse(&header.lines()), Some(header.clone()));
        assert!(
            header.words().contains("busy: meanwhile other programs used 0.05 to 0.50"),
            "{}",
            header.words()
        );
    }
}
