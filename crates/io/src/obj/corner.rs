//! Corners written out for tobj.

use super::index::{Corner, Counts};

/// Writes a corner for tobj. Every corner gets every index that the file has
/// at all: tobj would otherwise repeat the one before. Index 1 is the "none"
/// that the feed put in front, so all others are one higher than in the file.
pub(crate) fn write_corner(out: &mut Vec<u8>, corner: &Corner, total: Counts) {
    out.push(b' ');
    write_number(out, corner.position);
    if total.coordinates > 0 {
        out.push(b'/');
        write_number(out, corner.coordinate + 1);
    }
    if total.normals > 0 {
        out.extend_from_slice(if total.coordinates > 0 { b"/" } else { b"//" });
        write_number(out, corner.normal + 1);
    }
}

/// Decimal digits; `write!` takes three times as long, and this is a third of
/// the work on a large file.
fn write_number(out: &mut Vec<u8>, mut number: usize) {
    let mut digits = [0; 20];
    let mut at = digits.len();
    loop {
        at -= 1;
        digits[at] = b'0' + (number % 10) as u8;
        number /= 10;
        if number == 0 {
            break;
        }
    }
    out.extend_from_slice(&digits[at..]);
}
