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
    /// Options that change the picture and that trigon does not follow.
    pub(crate) ignored: Vec<String>,
}

/// Takes the options off; what is left is the file name.
pub(crate) fn parse_map(rest: &str) -> MapStatement {
    let mut map = MapStatement {
        file: String::new(),
        scale: Vec2::ONE,
        offset: Vec2::ZERO,
        clamp: false,
        ignored: Vec::new(),
    };
    let mut rest = rest.trim();
    while let Some((option, after)) = split_option(rest) {
        let mut arguments = Vec::new();
        rest = take_arguments(option, after, &mut arguments);
        map.apply(option, &arguments);
    }
    map.file = rest.trim().to_owned();
    map
}

/// The options of the format, each with the number of its arguments; three
/// stands for one to three numbers.
const OPTIONS: &[(&str, usize)] = &[
    ("-blendu", 1),
    ("-blendv", 1),
    ("-bm", 1),
    ("-boost", 1),
    ("-cc", 1),
    ("-clamp", 1),
    ("-colorspace", 1),
    ("-imfchan", 1),
    ("-mm", 2),
    ("-o", 3),
    ("-s", 3),
    ("-t", 3),
    ("-texres", 1),
    ("-type", 1),
];

fn split_option(rest: &str) -> Option<((&'static str, usize), &str)> {
    let (word, after) = split_word(rest);
    OPTIONS.iter().find(|(name, _)| *name == word).map(|&option| (option, after))
}

fn split_word(rest: &str) -> (&str, &str) {
    let rest = rest.trim_start();
    rest.split_at(rest.find(char::is_whitespace).unwrap_or(rest.len()))
}

fn take_arguments<'a>((_, count): (&str, usize), mut rest: &'a str, into: &mut Vec<&'a str>) -> &'a str {
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
    fn apply(&mut self, (option, _): (&str, usize), arguments: &[&str]) {
        let number = |index: usize, default: f32| {
            arguments
                .get(index)
                .and_then(|word| word.parse().ok())
                .filter(|value: &f32| value.is_finite())
                .unwrap_or(default)
        };
        let first = arguments.first().copied().unwrap_or_default();
        match option {
            "-s" => self.scale = Vec2::new(number(0, 1.0), number(1, 1.0)),
            "-o" => self.offset = Vec2::new(number(0, 0.0), number(1, 0.0)),
            "-clamp" => self.clamp = first == "on",
            "-mm" | "-t" | "-cc" | "-type" => self.ignored.push(format!("{option} {}", arguments.join(" "))),
            // These say how to filter, or belong to bump maps and channels.
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_come_off_and_spaces_stay() {
        let map = parse_map(" -s 2 3 -bm 0.5 -clamp on -o 0.25 my wood.png ");
        assert_eq!(map.file, "my wood.png", "the name");
        assert_eq!(
            (map.scale, map.offset, map.clamp),
            (Vec2::new(2.0, 3.0), Vec2::new(0.25, 0.0), true),
            "the options"
        );
        assert_eq!(parse_map("-foo.png").file, "-foo.png", "a name may begin with a dash");
        assert_eq!(parse_map("-mm 0.1 0.9 a.png").ignored, ["-mm 0.1 0.9"], "named");
        assert_eq!(parse_map("-s").file, "", "an option and nothing else");
    }
}
