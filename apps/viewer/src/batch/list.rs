//! The list of jobs: one object of JSON a line.

use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use crate::args::{Job, STDIN, Shard};
use crate::failure::Failure;

/// The bytes of a line. Whoever writes longer ones names a configuration or a file of cameras instead.
const LONGEST: u64 = 1 << 20;

/// A job, and its line in the list, from 1.
pub(super) struct ListedJob {
    pub(super) line: usize,
    pub(super) job: Job,
}

/// Reads the jobs of a shard. All of the list is checked, so that a mistake is found before anything is drawn, by
/// whichever process comes first.
pub(super) fn read(path: &Path, shard: Shard) -> Result<Vec<ListedJob>, Failure> {
    if path.as_os_str() == STDIN {
        return jobs(io::stdin().lock(), "standard input", shard);
    }
    let name = path.display().to_string();
    let file = File::open(path)
        .map_err(|error| Failure::work(format!("{name}: cannot be read ({error}); check the name")))?;
    jobs(BufReader::new(file), &name, shard)
}

fn jobs(mut text: impl BufRead, name: &str, shard: Shard) -> Result<Vec<ListedJob>, Failure> {
    let (mut jobs, mut number) = (Vec::new(), 0);
    // By the name of an image, the line that draws it.
    let mut taken: HashMap<String, usize> = HashMap::new();
    for line in 1.. {
        let located = |why: String| Failure::Usage(format!("{name}, line {line}: {why}"));
        let mut bytes = Vec::new();
        let read = text.by_ref().take(LONGEST + 1).read_until(b'\n', &mut bytes);
        if read.map_err(|error| Failure::work(format!("{name}: cannot be read ({error}); try it again")))?
            == 0
        {
            break;
        }
        if bytes.len() as u64 > LONGEST {
            return Err(located(format!(
                "it has more than {LONGEST} bytes; name files of cameras and configurations instead"
            )));
        }
        let written =
            str::from_utf8(&bytes).map_err(|_| located("it is not UTF-8; write it again".to_owned()))?;
        if written.trim().is_empty() {
            continue;
        }
        let job = Job::parse(written).map_err(located)?;
        for image in job.names() {
            if let Some(other) = taken.insert(image.clone(), line) {
                return Err(located(format!(
                    "it writes {image}, as line {other} does; name the images of each job differently"
                )));
            }
        }
        if shard.contains(number) {
            jobs.push(ListedJob { line, job });
        }
        number += 1;
    }
    Ok(jobs)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str, shard: &str) -> Result<Vec<usize>, String> {
        let read = jobs(text.as_bytes(), "list", shard.parse().expect("a shard"));
        read.map(|jobs| jobs.iter().map(|job| job.line).collect()).map_err(|failure| failure.to_string())
    }

    #[test]
    fn shards_divide_the_jobs_and_empty_lines_are_none() {
        let text = "{\"output\": \"a.png\"}\n\n{\"output\": \"b.png\"}\r\n{\"output\": \"c.png\"}";
        assert_eq!(lines(text, "0/1"), Ok(vec![1, 3, 4]), "all");
        assert_eq!(lines(text, "0/2"), Ok(vec![1, 4]), "even");
        assert_eq!(lines(text, "1/2"), Ok(vec![3]), "odd");
        assert_eq!(lines("", "0/1"), Ok(vec![]), "an empty list");
    }

    #[test]
    fn a_mistake_is_found_in_every_shard() {
        let clash = "{\"output\": \"a.png\"}\n{\"output\": \"b.png\"}\n{\"output\": \"a.png\"}";
        for shard in ["0/2", "1/2"] {
            let why = lines(clash, shard).expect_err("refused");
            assert!(why.contains("list, line 3: it writes a.png, as line 1 does"), "{why}");
            assert!(
                lines("{\"output\": \"a.png\"}\nx", shard).expect_err("refused").contains("list, line 2")
            );
        }
        let long = format!("{{\"output\": \"{}.png\"}}", "a".repeat(1 << 20));
        assert!(lines(&long, "0/1").expect_err("refused").contains("more than 1048576 bytes"));
        let read = jobs(&b"\xff\n"[..], "list", "0/1".parse().expect("a shard"));
        assert!(read.err().expect("refused").to_string().contains("line 1: it is not UTF-8"));
    }
}
