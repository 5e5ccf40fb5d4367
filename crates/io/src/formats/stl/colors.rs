//! The colours of a binary STL: one for all triangles in the header, and one in the attribute of each.
//!
//! Programs disagree about both, so their bytes are believed only where they make a picture. Materialise Magics
//! writes `COLOR=` and four bytes, and `MATERIAL=` and three times four. The first four of `MATERIAL` are the
//! colour of diffuse light and come before `COLOR`. In attributes bit 15 is set where a triangle has no colour of
//! its own, and red is in the lowest bits. VisCAM and SolidView write no header, set bit 15 where there is a
//! colour, and put blue into the lowest bits. MeshLab writes the header of Magics with spaces instead of alpha, no
//! attributes or, with red in the lowest bits, those with bit 15 set.

use trigon_math::color::srgb_to_linear;
use trigon_math::{Vec3, Vec4};

use crate::error::Location;
use crate::polygons::Polygons;
use crate::warning::Warnings;

/// Set where there is a colour, or where there is none.
const FLAG: u16 = 0x8000;
/// What Magics writes where there is none.
const FILLED: u16 = 0xffff;

const AGAIN: &str = "export the model again, or as PLY or GLB if its colours matter";

/// The attributes of triangles.
#[derive(Default)]
pub(super) struct Attributes {
    /// Empty until one is not 0.
    values: Vec<u16>,
    /// The triangles so far.
    count: usize,
}

/// What the attributes of a file mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    /// No triangle has a colour of its own.
    Nothing,
    /// Those without the flag have one.
    Unflagged,
    /// Those with it, red in the lowest bits.
    FlaggedRedLow,
    /// Those with it, blue in the lowest bits.
    FlaggedBlueLow,
}

impl Attributes {
    pub(super) fn push(&mut self, attribute: u16) {
        if attribute != 0 || !self.values.is_empty() {
            self.values.resize(self.count, 0);
            self.values.push(attribute);
        }
        self.count += 1;
    }

    /// Gives the triangles their colours.
    pub(super) fn color(&self, header: &[u8], polygons: &mut Polygons, warnings: &mut Warnings) {
        let of_all = color_of_all(header, warnings);
        let otherwise = of_all.unwrap_or(Vec4::ONE);
        let own = |red: u16, blue: u16, value: u16| {
            let channel = |shift: u16| f32::from((value >> shift) & 31) / 31.0;
            linear([channel(red), channel(5), channel(blue)]).extend(otherwise.w)
        };
        let color = |is_own: bool, color: Vec4| if is_own { color } else { otherwise };
        let color_of = |meaning: Meaning, value: u16| match meaning {
            Meaning::Nothing => otherwise,
            Meaning::Unflagged => color(value & FLAG == 0, own(0, 10, value)),
            Meaning::FlaggedRedLow => color(value & FLAG != 0, own(0, 10, value)),
            Meaning::FlaggedBlueLow => color(value & FLAG != 0, own(10, 0, value)),
        };
        match self.meaning(of_all.is_some(), warnings) {
            Meaning::Nothing => polygons.color = of_all,
            meaning => {
                polygons.face_colors = self.values.iter().map(|&value| color_of(meaning, value)).collect();
            }
        }
    }

    fn meaning(&self, has_header: bool, warnings: &mut Warnings) -> Meaning {
        let any = |is_it: fn(u16) -> bool| self.values.iter().any(|&value| is_it(value));
        let unflagged = any(|value| value & FLAG == 0 && value != 0);
        let flagged = any(|value| value & FLAG != 0 && value != FLAG && value != FILLED);
        let mut warn = |what: &str| warnings.push(Location::Whole, what, AGAIN);
        if has_header {
            // As Magics writes them: where others have no colour, 0 is black.
            if unflagged || (!flagged && any(|value| value & FLAG != 0)) && any(|value| value == 0) {
                return Meaning::Unflagged;
            }
            if flagged {
                warn(
                    "the colours of triangles have the bit that means none beside COLOR in the header, and are taken as colours",
                );
                return Meaning::FlaggedRedLow;
            }
            return Meaning::Nothing;
        }
        if !self.values.is_empty() && self.values.iter().all(|&value| value == FLAG) {
            warn("the attributes make every triangle black, and are not taken as colours");
            return Meaning::Nothing;
        }
        if any(|value| value & FLAG != 0) {
            return Meaning::FlaggedBlueLow;
        }
        if unflagged {
            warn("attributes of triangles lack the bit that marks a colour, and are not taken as colours");
        }
        Meaning::Nothing
    }
}

/// The colour that the header gives to all triangles.
fn color_of_all(header: &[u8], warnings: &mut Warnings) -> Option<Vec4> {
    let mut warn = |what: &str| warnings.push(Location::Whole, what, AGAIN);
    let (color, diffuse) = (Stated::after(header, b"COLOR="), Stated::after(header, b"MATERIAL="));
    let diffuse = diffuse.filter(|diffuse| diffuse.rgb != [0; 3]);
    if color.is_some_and(|color| diffuse.is_some_and(|diffuse| diffuse.rgb != color.rgb)) {
        warn("COLOR and MATERIAL in the header contradict each other, and MATERIAL counts");
    }
    let Stated { rgb, .. } = diffuse.or(color)?;
    let alpha = color.or(diffuse).map_or(Alpha::Given(u8::MAX), |stated| stated.alpha);
    let alpha = match alpha {
        Alpha::Given(alpha) => alpha,
        Alpha::Separator => {
            warn("the colour in the header has a separator in place of its alpha, and is taken as opaque");
            u8::MAX
        }
        Alpha::Invisible => {
            warn("the colour in the header would be invisible, and is taken as opaque");
            u8::MAX
        }
    };
    let unit = |byte: u8| f32::from(byte) / 255.0;
    Some(linear(rgb.map(unit)).extend(unit(alpha)))
}

/// A colour as a header has it.
#[derive(Clone, Copy)]
struct Stated {
    rgb: [u8; 3],
    alpha: Alpha,
}

#[derive(Clone, Copy)]
enum Alpha {
    Given(u8),
    /// A space, or the comma before the next word.
    Separator,
    Invisible,
}

impl Stated {
    /// What follows a word; nothing where only the filling of the header does.
    fn after(header: &[u8], word: &[u8]) -> Option<Self> {
        let start = header.windows(word.len()).position(|window| window == word)? + word.len();
        let &[red, green, blue, alpha] = header.get(start..start + 4)? else { return None };
        if [[b' '; 4], [0; 4]].contains(&[red, green, blue, alpha]) {
            return None;
        }
        let is_last = header.get(start + 4).is_none_or(|next| next.is_ascii_uppercase());
        let alpha = match alpha {
            0 => Alpha::Invisible,
            b' ' => Alpha::Separator,
            b',' if is_last => Alpha::Separator,
            alpha => Alpha::Given(alpha),
        };
        Some(Self { rgb: [red, green, blue], alpha })
    }
}

fn linear(color: [f32; 3]) -> Vec3 {
    Vec3::from(color.map(srgb_to_linear))
}
