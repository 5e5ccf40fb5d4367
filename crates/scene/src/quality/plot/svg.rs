//! Writes the few elements of SVG that plots consist of.

use std::fmt::Write;

use super::Color;

/// A point in pixels: to the right, and down.
pub(super) type PixelPoint = [f64; 2];

/// Which end of a text lies at its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line's colour, its width in pixels, and whether it is dashed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    pub(super) color: Color,
    pub(super) width: f64,
    pub(super) is_dashed: bool,
}

impl Stroke {
    pub(super) fn new(color: Color, width: f64) -> Self {
        Self { color, width, is_dashed: false }
    }
}

/// Letters: their height in pixels, their colour, and whether they go upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Letters {
    pub(super) size: u32,
    pub(super) color: Color,
    pub(super) anchor: Anchor,
    pub(super) goes_up: bool,
}

/// An image in the making.
pub(super) struct Svg {
    text: String,
}

impl Svg {
    /// A white image. Its title is what a screen reader says.
    pub(super) fn new([width, height]: [i32; 2], title: &str) -> Self {
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"sans-serif\">\n\
             <title>{}</title>\n<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
            escaped(title)
        );
        Self { text }
    }

    fn add(&mut self, element: std::fmt::Arguments<'_>) {
        // A string takes any text.
        let _ = self.text.write_fmt(element);
        self.text.push('\n');
    }

    pub(super) fn lines(&mut self, points: &[PixelPoint], stroke: Stroke) {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect();
        let dashes = if stroke.is_dashed { " stroke-dasharray=\"6 4\"" } else { "" };
        self.add(format_args!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{dashes}/>",
            points.join(" "),
            hex(stroke.color),
            stroke.width
        ));
    }

    /// A disc, with a rim in a colour.
    pub(super) fn circle(&mut self, [x, y]: PixelPoint, radius: f64, [fill, rim]: [Color; 2]) {
        self.add(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>",
            hex(fill),
            hex(rim)
        ));
    }

    /// A circle alone.
    pub(super) fn ring(&mut self, [x, y]: PixelPoint, radius: f64, color: Color) {
        self.add(format_args!(
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>",
            hex(color)
        ));
    }

    /// A rectangle of white, through which a little shows, with a thin border.
    pub(super) fn panel(&mut self, [left, top]: PixelPoint, [width, height]: [f64; 2]) {
        self.add(format_args!(
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#ffffff\" \
             fill-opacity=\"0.85\" stroke=\"#bbbbbb\"/>"
        ));
    }

    /// A text on one line; the point is at its foot.
    pub(super) fn text(&mut self, [x, y]: PixelPoint, letters: Letters, text: &str) {
        let anchor = match letters.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn =
            if letters.goes_up { format!(" transform=\"rotate(-90 {x:.1} {y:.1})\"") } else { String::new() };
        self.add(format_args!(
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{}\"{turn}>{}</text>",
            letters.size,
            hex(letters.color),
            escaped(text)
        ));
    }

    /// The whole file.
    pub(super) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }
}

fn hex([red, green, blue]: Color) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// Text for XML, where characters that it cannot hold are replaced.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            control if control.is_control() => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_text_can_be_written() {
        assert_eq!(
            escaped("a<b> & \"c\"\u{1b}\u{0}\n\u{ffff}é"),
            "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd}\u{fffd}\u{fffd}\u{fffd}é"
        );
    }
}
