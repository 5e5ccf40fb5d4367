//! The numbers of `v`, `vt` and `vn` lines, cleaned for the parser behind.
//!
//! Nearly every line is plain and passes through as it is, after one look at
//! each byte. The rest is spelled anew: `1.#IND` and `-nan(ind)` as `nan`,
//! without comments and surplus numbers.

use super::lines::words;

/// What a line of numbers holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Tally {
    /// How many numbers were written out.
    pub(crate) count: usize,
    /// Whether one of them is not finite.
    pub(crate) non_finite: bool,
    /// Whether numbers were left out at the end.
    pub(crate) surplus: bool,
}

/// Appends the numbers of a line, at most `most`, or says which word is no
/// number.
pub(crate) fn copy_numbers(rest: &[u8], most: usize, out: &mut Vec<u8>) -> Result<Tally, String> {
    if let Some(count) = count_plain(rest).filter(|&count| count <= most) {
        out.extend_from_slice(rest);
        return Ok(Tally { count, non_finite: false, surplus: false });
    }
    let mut tally = Tally { count: 0, non_finite: false, surplus: false };
    for word in words(rest) {
        if tally.count == most {
            tally.surplus = true;
            break;
        }
        out.push(b' ');
        match spell(word)? {
            Some(word) => out.extend_from_slice(word),
            None => {
                out.extend_from_slice(b"nan");
                tally.non_finite = true;
            }
        }
        tally.count += 1;
    }
    Ok(tally)
}

/// How many numbers, when every byte is part of a short plain number or a
/// space. Letters other than an exponent's, and numbers that could overflow,
/// are not plain.
fn count_plain(rest: &[u8]) -> Option<usize> {
    let (mut count, mut inside) = (0, false);
    for &byte in rest {
        match byte {
            b'0'..=b'9' | b'.' | b'-' => {
                count += usize::from(!inside);
                inside = true;
            }
            b' ' | b'\t' => inside = false,
            _ => return None,
        }
    }
    // 300 digits fit in f64; a longer line may hold a longer number.
    (rest.len() <= 300).then_some(count)
}

/// The word as it is when it is a finite number; `None` when it is one of the
/// ways to write infinity or no number.
fn spell(word: &[u8]) -> Result<Option<&[u8]>, String> {
    let text = std::str::from_utf8(word).unwrap_or_default();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(Some(word)),
        Ok(_) => Ok(None),
        Err(_) if is_c_spelling_of_non_finite(word) => Ok(None),
        Err(_) => {
            Err(format!("\"{}\" is not a number", String::from_utf8_lossy(&word[..word.len().min(40)])))
        }
    }
}

/// `1.#INF`, `-1.#IND00`, `1.#QNAN`, `nan(ind)`, `-nan(snan)` …
fn is_c_spelling_of_non_finite(word: &[u8]) -> bool {
    let word = word.strip_prefix(b"-").or(word.strip_prefix(b"+")).unwrap_or(word).to_ascii_lowercase();
    word.starts_with(b"1.#") || word.starts_with(b"nan(") || word.starts_with(b"inf")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn copied(rest: &str, most: usize) -> Result<(String, Tally), String> {
        let mut out = Vec::new();
        let tally = copy_numbers(rest.as_bytes(), most, &mut out)?;
        Ok((String::from_utf8(out).expect("ASCII"), tally))
    }

    #[test]
    fn plain_numbers_pass_unchanged() {
        let (text, tally) = copied(" 1 -2.5\t3", 3).expect("numbers");
        assert_eq!((text.as_str(), tally.count, tally.surplus), (" 1 -2.5\t3", 3, false), "as it was");
    }

    #[test]
    fn odd_numbers_are_spelled_anew() {
        let (text, tally) = copied(" 1e400 1.#IND -nan(ind) # x", 3).expect("numbers");
        assert_eq!((text.as_str(), tally.count, tally.non_finite), (" nan nan nan", 3, true), "not finite");
        let (text, tally) = copied(" 1e-3 2 3 4 5", 3).expect("numbers");
        assert_eq!((text.as_str(), tally.surplus), (" 1e-3 2 3", true), "cut");
        copied(" 1,5 2 3", 3).expect_err("a decimal comma");
        copied(" \0 2 3", 3).expect_err("a NUL");
    }
}
