//! The options of a `map_…` line: `-s 2 2 1 -clamp on folder/my wood.png`.

use trigon_math::Vec2;

/// A texture statement, taken apart.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapStatement {
    /// The rest of the line: names may have spaces.
    pub(crate) file: String,
    /// `-s`: the texture is repeated so often.
    pub(crate) scale: Vec2,
    /// `-o`: it starts so far along.
    pub(crate) offset: Vec2,
    pub(crate) clamp: bool,
    /// `-bm`: bumps are so much steeper.
    pub(crate) bump: f32,
    /// Options that change the image and that trigon does not follow.
    pub(crate) ignored: Vec<String>,
    /// Options whose arguments are not what they should be.
    pub(crate) malformed: Vec<String>,
}

/// Takes the options off; what is left is the file name. `holds_colors` says how the
/// image is read.
pub(crate) fn parse_map(rest: &str, holds_colors: bool) -> MapStatement {
    let mut map = MapStatement {
        file: String::new(),
        scale: Vec2::ONE,
        offset: Vec2::ZERO,
        clamp: false,
        bump: 1.0,
        ignored: Vec::new(),
        malformed: Vec::new(),
    };
    let mut rest = rest.trim();
    while let Some((option, after)) = split_option(rest) {
        let mut arguments = Vec::new();
        rest = take_arguments(option.arguments, after, &mut arguments);
        map.apply(option.name, &arguments, holds_colors);
    }
    map.file = rest.trim().to_owned();
    map
}

/// An option of the format.
struct MapOption {
    name: &'static str,
    /// The number of its arguments; three stands for one to three numbers.
    arguments: usize,
}

const OPTIONS: &[MapOption] = &[
    MapOption { name: "-blendu", arguments: 1 },
    MapOption { name: "-blendv", arguments: 1 },
    MapOption { name: "-bm", arguments: 1 },
    MapOption { name: "-boost", arguments: 1 },
    MapOption { name: "-cc", arguments: 1 },
    MapOption { name: "-clamp", arguments: 1 },
    MapOption { name: "-colorspace", arguments: 1 },
    MapOption { name: "-imfchan", arguments: 1 },
    MapOption { name: "-mm", arguments: 2 },
    MapOption { name: "-o", arguments: 3 },
    MapOption { name: "-s", arguments: 3 },
    MapOption { name: "-t", arguments: 3 },
    MapOption { name: "-texres", arguments: 1 },
    MapOption { name: "-type", arguments: 1 },
];

fn split_option(rest: &str) -> Option<(&'static MapOption, &str)> {
    let (word, after) = split_word(rest);
    OPTIONS.iter().find(|option| option.name == word).map(|option| (option, after))
}

fn split_word(rest: &str) -> (&str, &str) {
    let rest = rest.trim_start();
    rest.split_at(rest.find(char::is_whitespace).unwrap_or(rest.len()))
}

fn take_arguments<'a>(count: usize, mut rest: &'a str, into: &mut Vec<&'a str>) -> &'a str {
    for _ in 0..count {
        let (word, after) = split_word(rest);
        // Two of the three numbers may be missing.
        if word.is_empty() || (count == 3 && !into.is_empty() && word.parse::<f32>().is_err()) {
            break;
        }
        into.push(word);
        rest = after;
    }
    rest
}

impl MapStatement {
    /// Whether another texture is placed in the same way.
    pub(super) fn is_placed_like(&self, other: &Self) -> bool {
        (self.scale, self.offset, self.clamp) == (other.scale, other.offset, other.clamp)
    }

    fn apply(&mut self, option: &str, arguments: &[&str], holds_colors: bool) {
        let spelled = format!("{option} {}", arguments.join(" "));
        let numbers: Option<Vec<f32>> = arguments.iter().map(|word| finite(word)).collect();
        let first = arguments.first().copied().unwrap_or_default();
        let is_followed = match (option, numbers.as_deref()) {
            // Two of the three numbers may be missing, and the third is for images of
            // three dimensions.
            ("-s", Some(&[u, ref more @ ..])) => {
                self.scale = Vec2::new(u, more.first().copied().unwrap_or(1.0));
                true
            }
            ("-o", Some(&[u, ref more @ ..])) => {
                self.offset = Vec2::new(u, more.first().copied().unwrap_or(0.0));
                true
            }
            ("-bm", Some(&[bump])) => {
                self.bump = bump;
                true
            }
            ("-mm", Some(range)) => range == [0.0, 1.0],
            ("-t", Some(turbulence)) => turbulence.iter().all(|&value| value == 0.0),
            ("-boost", Some(&[boost])) => boost == 0.0,
            // Images keep their own resolution.
            ("-texres", Some(_)) => true,
            ("-s" | "-o" | "-bm" | "-mm" | "-t" | "-boost" | "-texres", _) => {
                return self.malformed.push(spelled);
            }
            ("-clamp" | "-cc" | "-blendu" | "-blendv", _) if !matches!(first, "on" | "off") => {
                return self.malformed.push(spelled);
            }
            ("-clamp", _) => {
                self.clamp = first == "on";
                true
            }
            ("-cc", _) => first == "off",
            ("-blendu" | "-blendv", _) => first == "on",
            ("-colorspace", _) => first.eq_ignore_ascii_case(if holds_colors { "srgb" } else { "linear" }),
            _ => false,
        };
        if !is_followed {
            self.ignored.push(spelled);
        }
    }
}

fn finite(word: &str) -> Option<f32> {
    word.parse().ok().filter(|value: &f32| value.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(rest: &str) -> MapStatement {
        parse_map(rest, true)
    }

    #[test]
    fn options_come_off_and_spaces_stay() {
        let map = parse(" -s 2 3 -bm 0.5 -clamp on -o 0.25 my wood.png ");
        assert_eq!(map.file, "my wood.png", "the name");
        assert_eq!(
            (map.scale, map.offset, map.clamp, map.bump),
            (Vec2::new(2.0, 3.0), Vec2::new(0.25, 0.0), true, 0.5),
            "the options"
        );
        assert_eq!(parse("-foo.png").file, "-foo.png", "a name may begin with a dash");
        assert_eq!(parse("-mm 0.1 0.9 a.png").ignored, ["-mm 0.1 0.9"], "named");
        assert_eq!(parse("-mm 0 1 -cc off -t 0 -boost 0 a.png").ignored, [""; 0], "the defaults");
        assert_eq!(parse("-colorspace linear -imfchan r a.png").ignored.len(), 2, "of a colour");
        assert_eq!(parse("-s x 2 a.png").malformed, ["-s x 2"], "no number");
        assert_eq!(parse("-o 0.5 nan 0 a.png").malformed, ["-o 0.5 nan 0"], "not finite");
        assert_eq!(parse("-clamp yes a.png").malformed, ["-clamp yes"], "neither on nor off");
        assert_eq!(parse("-s").file, "", "an option and nothing else");
    }
}
