//! OBJ statements that are not read: which of them change the image, and which words are not statements at
//! all. `docs/obj-statements.md` lists them all.

use super::oddities::{Oddity, Tally};
use crate::error::Location;
use crate::warning::Warnings;

/// What leaving a statement out means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unread {
    /// The image stays the same, or what changes it is noted elsewhere.
    Harmless,
    /// The image is another than the file asks for.
    Noted(Oddity),
    /// No version of the format has it.
    Unknown,
}

/// Judges a statement that the reader has no use for.
pub(super) fn judge(keyword: &[u8], rest: &[u8]) -> Unread {
    let is_off = matches!(rest.trim_ascii(), b"off");
    let unless = |harmless: bool, oddity: Oddity| match harmless {
        true => Unread::Harmless,
        false => Unread::Noted(oddity),
    };
    match keyword {
        b"curv" | b"surf" | b"bsp" | b"bzp" | b"cdc" | b"cdp" => Unread::Noted(Oddity::Surface),
        b"call" => Unread::Noted(Oddity::Call),
        b"csh" => Unread::Noted(Oddity::Shell),
        b"shadow_obj" => Unread::Noted(Oddity::ShadowObject),
        b"trace_obj" => Unread::Noted(Oddity::TraceObject),
        b"usemap" => unless(is_off, Oddity::TextureMap),
        b"bevel" => unless(is_off, Oddity::Bevel),
        b"c_interp" => unless(is_off, Oddity::ColorInterpolation),
        b"d_interp" => unless(is_off, Oddity::DissolveInterpolation),
        b"lod" => unless(matches!(rest.trim_ascii(), b"0"), Oddity::LevelOfDetail),
        // They describe curves and surfaces, each of which is noted.
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv2" | b"parm" | b"trim" | b"hole" | b"scrv"
        | b"sp" | b"end" | b"con" | b"mg" | b"ctech" | b"stech" | b"res" => Unread::Harmless,
        // Only `usemap` shows what is in it.
        b"maplib" => Unread::Harmless,
        _ => Unread::Unknown,
    }
}

/// Statements that are read, for the remedy of one in upper case.
const READ: &[&[u8]] = &[b"v", b"vt", b"vn", b"f", b"fo", b"l", b"p", b"o", b"g", b"s", b"usemtl", b"mtllib"];

/// So many unknown statements are named; a hostile file could have millions.
const MOST_KINDS: usize = 8;

/// So much of an unknown statement is kept and shown, in bytes.
const MOST_BYTES: usize = 40;

/// What stands where a statement should, by its first word.
#[derive(Debug, Default)]
pub(crate) struct Unknown {
    all: Tally,
    /// The first kinds; one above [`MOST_KINDS`] says that there are too many to name.
    kinds: Vec<(Vec<u8>, Tally)>,
}

impl Unknown {
    pub(crate) fn note(&mut self, keyword: &[u8], line: u64) {
        self.all.add(line);
        self.add_kind(&keyword[..keyword.len().min(MOST_BYTES)], Tally { count: 1, line });
    }

    fn add_kind(&mut self, keyword: &[u8], tally: Tally) {
        if let Some((_, known)) = self.kinds.iter_mut().find(|(known, _)| known == keyword) {
            known.add_all(tally);
        } else if self.kinds.len() <= MOST_KINDS {
            self.kinds.push((keyword.to_owned(), tally));
        }
    }

    /// Adds what was counted further on in the file.
    pub(super) fn add_all(&mut self, later: &Self) {
        self.all.add_all(later.all);
        for (keyword, tally) in &later.kinds {
            self.add_kind(keyword, *tally);
        }
    }

    /// What is wrong with the first, and what to do about it.
    pub(super) fn first(&self) -> Option<(String, &'static str)> {
        self.kinds.first().map(|(keyword, _)| (describe(keyword), remedy(keyword)))
    }

    pub(super) fn warn(&self, warnings: &mut Warnings) {
        if self.kinds.len() > MOST_KINDS {
            let what = format!("more than {MOST_KINDS} kinds of statements are unknown and are ignored");
            let remedy = "check that the file is an OBJ, and its spelling";
            warnings.push_counted(self.all.count, Location::Line(self.all.line), what, remedy);
            return;
        }
        for (keyword, tally) in &self.kinds {
            warnings.push_counted(
                tally.count,
                Location::Line(tally.line),
                describe(keyword),
                remedy(keyword),
            );
        }
    }
}

fn describe(keyword: &[u8]) -> String {
    format!("the statement \"{}\" is unknown and is ignored", String::from_utf8_lossy(keyword))
}

fn remedy(keyword: &[u8]) -> &'static str {
    let lower = keyword.to_ascii_lowercase();
    if READ.contains(&lower.as_slice()) || judge(&lower, b"") != Unread::Unknown {
        "write it in lower case"
    } else {
        "check its spelling, or remove it"
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn warned(unknown: &Unknown) -> Vec<String> {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        unknown.warn(&mut warnings);
        warnings.into_list().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_flood_of_unknown_statements_is_one_warning() {
        let mut unknown = Unknown::default();
        for line in 1..=MOST_KINDS as u64 {
            unknown.note(format!("x{line}").as_bytes(), line);
        }
        assert_eq!(warned(&unknown).len(), MOST_KINDS, "each is named");
        let mut later = Unknown::default();
        for line in 10..1000 {
            later.note(format!("y{line}").as_bytes(), line);
        }
        unknown.add_all(&later);
        let warnings = warned(&unknown);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].starts_with("a.obj, line 1: more than 8 kinds"), "{warnings:?}");
        assert!(warnings[0].contains("and 997 more"), "all are counted: {warnings:?}");
    }
}
