//! Parses the values of flags. Every error message says what would have been accepted.

use std::convert::Infallible;
use std::num::NonZeroUsize;
use std::time::Duration;

use trigon_camera::{UpAxis, Viewport};
use trigon_io::{Format, SceneChoice};
use trigon_math::glam::{Affine2, Vec2};
use trigon_math::{DVec3, Vec3, color, elementary};
use trigon_scene::{ColorError, Display, MAX_SIZE, SimdLevel, css_color};

use super::raw::{Check, CheckPurpose};

/// A switch: `--edges`, `--edges=false` and their spellings.
pub(crate) fn switch(text: &str) -> Result<bool, String> {
    match text.to_ascii_lowercase().as_str() {
        "true" | "on" | "yes" | "1" => Ok(true),
        "false" | "off" | "no" | "0" => Ok(false),
        _ => Err("write true or false (also on, off, yes, no, 1, 0)".to_owned()),
    }
}

/// What `--check` is for: a purpose, or a switch.
pub(crate) fn check(text: &str) -> Result<Check, String> {
    let purpose = |is_on: bool| is_on.then_some(CheckPurpose::Show);
    match text {
        "print" => Ok(Some(CheckPurpose::Print)),
        _ => switch(text).map(purpose).map_err(|_| "write true, false or print".to_owned()),
    }
}

/// What faces show, by its name.
pub(crate) fn display(text: &str) -> Result<Display, String> {
    Display::ALL.into_iter().find(|display| display.name() == text).ok_or_else(|| {
        let names: Vec<&str> = Display::ALL.into_iter().map(Display::name).collect();
        format!("write one of {}", names.join(", "))
    })
}

/// A model format by the ending of its files.
pub(crate) fn reader(text: &str) -> Result<Format, String> {
    Format::from_extension(text).ok_or_else(|| {
        let known: Vec<&str> = trigon_io::readers().map(|reader| reader.extensions[0]).collect();
        format!("write one of {}", known.join(", "))
    })
}

/// A size in pixels: `1000,600` or `1000x600`.
pub(crate) fn size(text: &str) -> Result<Viewport, String> {
    let (width, height) = text
        .split_once([',', 'x', 'X', '×'])
        .ok_or("write width and height with a comma between them, such as 1000,600")?;
    Ok(Viewport { width: side("width", width)?, height: side("height", height)? })
}

/// A pixel by its column and row.
pub(crate) fn pixel(text: &str) -> Result<[u32; 2], String> {
    let numbers = text.split_once(',').map(|(x, y)| [x, y].map(|number| number.trim().parse::<u32>()));
    match numbers {
        Some([Ok(x), Ok(y)]) => Ok([x, y]),
        _ => {
            Err("write column and row, counted from 0, with a comma between them, such as 320,200".to_owned())
        }
    }
}

fn side(what: &str, text: &str) -> Result<u32, String> {
    let number = text.trim().parse::<u32>().ok().filter(|side| (1..=MAX_SIZE).contains(side));
    number.ok_or_else(|| {
        format!("the {what} has to be a whole number from 1 to {MAX_SIZE}, not {:?}", text.trim())
    })
}

/// A colour, written in sRGB, as linear RGB.
pub(crate) fn color(text: &str) -> Result<Vec3, String> {
    const FORMS: &str = "write R,G,B with numbers from 0 to 1, #rgb, #rrggbb or a CSS name such as orange";
    if let Some(rgb) = named(text).or_else(|| cmyk(text)) {
        return Ok(to_linear(rgb));
    }
    if let Some(channels) = three_numbers(text) {
        let inside = channels.cmpge(DVec3::ZERO).all() && channels.cmple(DVec3::ONE).all();
        return if inside { Ok(to_linear(channels.as_vec3())) } else { Err(FORMS.to_owned()) };
    }
    let color = css_color(text).map_err(|error| match error {
        ColorError::Unknown => FORMS.to_owned(),
        outside => outside.to_string(),
    })?;
    if color.w < 1.0 {
        return Err(
            "the colour is translucent; use --opacity for a model, --no-background for none".to_owned()
        );
    }
    Ok(color.truncate())
}

/// F3D's own colour names, which CSS lacks.
fn named(text: &str) -> Option<Vec3> {
    const NAMES: [(&str, [u8; 3]); 7] = [
        ("f3d_red", [249, 67, 6]),
        ("f3d_green", [77, 179, 77]),
        ("f3d_blue", [59, 125, 216]),
        ("f3d_yellow", [250, 200, 0]),
        ("f3d_grey", [57, 57, 60]),
        ("f3d_black", [25, 25, 25]),
        ("f3d_white", [244, 244, 244]),
    ];
    let name = text.trim().to_ascii_lowercase();
    let found = NAMES.iter().find(|(known, _)| *known == name)?;
    Some(Vec3::from(found.1.map(f32::from)) / 255.0)
}

fn is_share(value: &f32) -> bool {
    (0.0..=1.0).contains(value)
}

/// `cmyk(0%, 50%, 100%, 0%)`: the fraction of white that inks leave, in sRGB.
fn cmyk(text: &str) -> Option<Vec3> {
    let inks = text.trim().to_ascii_lowercase();
    let inks = inks.strip_prefix("cmyk(")?.strip_suffix(')')?;
    let shares: Vec<f32> =
        inks.split(',').map(|ink| ratio(ink).map(|ink| ink as f32)).collect::<Option<_>>()?;
    let [c, m, y, k] = shares.try_into().ok().filter(|shares: &[f32; 4]| shares.iter().all(is_share))?;
    let left = Vec3::ONE - Vec3::new(c, m, y);
    Some(left * (1.0 - k))
}

/// A colour that may be brighter than white, as linear RGB.
pub(crate) fn bright_color(text: &str) -> Result<Vec3, String> {
    match three_numbers(text)
        .filter(|channels| channels.cmpge(DVec3::ZERO).all() && channels.max_element() <= 1e6)
    {
        Some(channels) => {
            let [r, g, b] = channels.as_vec3().to_array().map(bright_to_linear);
            Ok(Vec3::new(r, g, b))
        }
        None => color(text),
    }
}

/// sRGB's curve up to 1, and in proportion beyond.
fn bright_to_linear(channel: f32) -> f32 {
    if channel <= 1.0 { color::srgb_to_linear(channel) } else { channel }
}

fn to_linear(srgb: Vec3) -> Vec3 {
    Vec3::new(color::srgb_to_linear(srgb.x), color::srgb_to_linear(srgb.y), color::srgb_to_linear(srgb.z))
}

/// A direction: signed axes such as `+X` or `-y+z`, or three numbers. Never
/// zero, always finite; not normalized.
pub(crate) fn direction(text: &str) -> Result<DVec3, String> {
    const FORMS: &str = "write axes such as +X or -y+z, or three numbers such as 1,0,-0.5";
    let found = three_numbers(text).or_else(|| signed_axes(text)).ok_or(FORMS)?;
    if found == DVec3::ZERO { Err("a direction cannot be all zeros".to_owned()) } else { Ok(found) }
}

/// The axis that points up: any direction.
pub(crate) fn up(text: &str) -> Result<UpAxis, String> {
    direction(text).map(UpAxis::new)
}

/// `+X`, `x`, `-y+z`: every axis at most once, a sign before all but the first.
fn signed_axes(text: &str) -> Option<DVec3> {
    let (mut sum, mut used, mut sign) = (DVec3::ZERO, [false; 3], Some(1.0));
    let mut signed = false;
    for character in text.trim().chars() {
        match (character.to_ascii_lowercase(), sign) {
            ('+', _) if !signed => (sign, signed) = (Some(1.0), true),
            ('-', _) if !signed => (sign, signed) = (Some(-1.0), true),
            (axis @ 'x'..='z', Some(value)) => {
                let index = axis as usize - 'x' as usize;
                if std::mem::replace(&mut used[index], true) {
                    return None;
                }
                sum[index] = value;
                (sign, signed) = (None, false);
            }
            _ => return None,
        }
    }
    (sign.is_none() && !signed).then_some(sum)
}

/// A point: three finite numbers.
pub(crate) fn point(text: &str) -> Result<DVec3, String> {
    three_numbers(text).ok_or_else(|| "write three numbers such as 1,2.5,-3".to_owned())
}

/// Three finite numbers separated by commas.
fn three_numbers(text: &str) -> Option<DVec3> {
    let mut numbers =
        text.split(',').map(|number| number.trim().parse::<f64>().ok().filter(|n| n.is_finite()));
    let vector = DVec3::new(numbers.next()??, numbers.next()??, numbers.next()??);
    numbers.next().is_none().then_some(vector)
}

/// An angle in degrees, as radians.
pub(crate) fn angle(text: &str) -> Result<f64, String> {
    finite(text).map(f64::to_radians).ok_or_else(|| "write an angle in degrees, such as 45".to_owned())
}

/// An opening angle in degrees, as radians.
pub(crate) fn view_angle(text: &str) -> Result<f64, String> {
    let degrees = finite(text).filter(|degrees| (0.01..=179.0).contains(degrees));
    degrees.map(f64::to_radians).ok_or_else(|| "write an angle from 0.01 to 179 degrees".to_owned())
}

/// A zoom factor.
pub(crate) fn zoom(text: &str) -> Result<f64, String> {
    ratio(text)
        .filter(|factor| (1e-6..=1e6).contains(factor))
        .ok_or_else(|| "write a number from 0.000001 to 1000000, such as 0.9".to_owned())
}

/// A number from 0 to 1.
pub(crate) fn unit_ratio(text: &str) -> Result<f32, String> {
    share(text).map(|value| value as f32)
}

/// The same in double precision.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    let inside = ratio(text).filter(|value| (0.0..=1.0).contains(value));
    inside.ok_or_else(|| "write a number from 0 to 1, or 50%, or 1/2".to_owned())
}

/// A factor for light.
pub(crate) fn intensity(text: &str) -> Result<f32, String> {
    let inside = ratio(text).filter(|value| (0.0..=1e6).contains(value));
    inside.map(|value| value as f32).ok_or_else(|| "write a number from 0 up, such as 1.5 or 150%".to_owned())
}

/// A number of stops.
pub(crate) fn stops(text: &str) -> Result<f32, String> {
    let inside = finite(text).filter(|stops| (-20.0..=20.0).contains(stops));
    inside.map(|stops| stops as f32).ok_or_else(|| "write a number from -20 to 20, such as 1.5".to_owned())
}

/// A width in pixels.
pub(crate) fn line_width(text: &str) -> Result<f32, String> {
    const WIDEST: f64 = 1000.0;
    let inside = finite(text).filter(|width| *width > 0.0 && *width <= WIDEST);
    inside
        .map(|width| width as f32)
        .ok_or_else(|| format!("write a number of pixels greater than 0, up to {WIDEST}"))
}

/// A time in an animation.
pub(crate) fn seconds(text: &str) -> Result<f64, String> {
    finite(text).ok_or_else(|| "write a number of seconds, such as 1.5".to_owned())
}

/// A length of time greater than 0, with its unit.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    const LONGEST: f64 = 3600.0;
    let (number, unit) = match (text.trim().strip_suffix("ms"), text.trim().strip_suffix('s')) {
        (Some(number), _) => (number, 1e-3),
        (None, Some(number)) => (number, 1.0),
        (None, None) => (text, f64::NAN),
    };
    let seconds = finite(number).map(|number| number * unit);
    let inside = seconds.filter(|seconds| (1e-6..=LONGEST).contains(seconds));
    inside
        .map(Duration::from_secs_f64)
        .ok_or_else(|| "write a time with its unit, such as 16ms or 0.5s, up to an hour".to_owned())
}

/// A scene of a file: digits are its number, anything else its name.
pub(crate) fn scene(text: &str) -> Result<SceneChoice, Infallible> {
    Ok(text.parse().map_or_else(|_| SceneChoice::Name(text.to_owned()), SceneChoice::Index))
}

/// A number of MiB, as bytes; a negative one means no limit.
pub(crate) fn mebibytes(text: &str) -> Result<u64, String> {
    const MIB: f64 = 1_048_576.0;
    // Float to integer saturates, beyond the size of any file.
    finite(text)
        .map(|mib| if mib < 0.0 { u64::MAX } else { (mib * MIB) as u64 })
        .ok_or_else(|| "write a number of MiB, such as 100".to_owned())
}

/// The speed factor of an animation; negative plays backwards.
pub(crate) fn speed(text: &str) -> Result<f64, String> {
    let inside = ratio(text).filter(|speed| (1e-3..=1e3).contains(&speed.abs()));
    inside.ok_or_else(|| "write a number such as 2, 50% or -1; from 0.001 to 1000 times".to_owned())
}

/// Frames per second.
pub(crate) fn frame_rate(text: &str) -> Result<f64, String> {
    let inside = finite(text).filter(|rate| (0.02..=1000.0).contains(rate));
    inside.ok_or_else(|| "write a number of frames a second from 0.02 to 1000".to_owned())
}

/// An index of refraction.
pub(crate) fn refraction(text: &str) -> Result<f32, String> {
    let inside = finite(text).filter(|index| (1.0..=2.5).contains(index));
    inside
        .map(|index| index as f32)
        .ok_or_else(|| "write a number from 1 to 2.5, such as 1.5 for glass".to_owned())
}

/// Any factor.
pub(crate) fn factor(text: &str) -> Result<f32, String> {
    let inside = ratio(text).filter(|factor| factor.abs() <= 1e6);
    inside.map(|factor| factor as f32).ok_or_else(|| "write a number such as 2 or 50%".to_owned())
}

/// A length greater than 0.
pub(crate) fn length(text: &str) -> Result<f64, String> {
    let inside = finite(text).filter(|length| (1e-12..=1e12).contains(length));
    inside.ok_or_else(|| "write a length greater than 0, such as 0.5".to_owned())
}

/// A text size.
pub(crate) fn text_scale(text: &str) -> Result<f32, String> {
    let inside = ratio(text).filter(|scale| (0.5..=4.0).contains(scale));
    inside.map(|scale| scale as f32).ok_or_else(|| "write a number from 0.5 to 4, such as 1.5".to_owned())
}

/// A regular expression.
pub(crate) fn regex(text: &str) -> Result<regex_lite::Regex, String> {
    regex_lite::Regex::new(text).map_err(|error| error.to_string())
}

/// A texture transform: `scale:2;angle:45;translation:0.5,0` in any order, scaled first and
/// translated last, or a matrix of nine numbers, row by row.
pub(crate) fn transform(text: &str) -> Result<Affine2, String> {
    let numbers: Option<Vec<f32>> =
        text.split(',').map(|number| finite(number).map(|number| number as f32)).collect();
    if let Some([a, b, c, d, e, f, _, _, _]) = numbers.as_deref() {
        return Ok(Affine2::from_cols(Vec2::new(*a, *d), Vec2::new(*b, *e), Vec2::new(*c, *f)));
    }
    let (mut scale, mut angle, mut moved) = (Vec2::ONE, 0.0, Vec2::ZERO);
    for part in text.split(';') {
        let (name, value) = part.split_once(':').ok_or(TRANSFORM)?;
        let pair = value.split(',').map(finite).collect::<Option<Vec<f64>>>().ok_or(TRANSFORM)?;
        let pair: Vec<f32> = pair.into_iter().map(|number| number as f32).collect();
        match (name.trim(), pair.as_slice()) {
            ("scale", &[x, y]) => scale = Vec2::new(x, y),
            ("scale", &[both]) => scale = Vec2::splat(both),
            ("translation", &[x, y]) => moved = Vec2::new(x, y),
            ("angle", &[degrees]) => angle = f64::from(degrees).to_radians(),
            _ => return Err(TRANSFORM.to_owned()),
        }
    }
    let (sin, cos) = elementary::sin_cos(angle);
    let (sin, cos) = (sin as f32, cos as f32);
    Ok(Affine2::from_cols(Vec2::new(cos, sin) * scale.x, Vec2::new(-sin, cos) * scale.y, moved))
}

const TRANSFORM: &str = "write scale:2;angle:45;translation:0.5,0 in any order, or nine numbers";

/// A whole number within limits.
pub(crate) fn count<const LEAST: u32, const MOST: u32>(text: &str) -> Result<u32, String> {
    let inside = text.trim().parse::<u32>().ok().filter(|count| (LEAST..=MOST).contains(count));
    inside.ok_or_else(|| format!("write a whole number from {LEAST} to {MOST}"))
}

/// A number of threads.
pub(crate) fn threads(text: &str) -> Result<NonZeroUsize, String> {
    text.parse().map_err(|_| "write a whole number from 1 up".to_owned())
}

/// A set of vector instructions that this build and this processor support.
pub(crate) fn simd(text: &str) -> Result<SimdLevel, String> {
    let level = text.parse::<SimdLevel>().ok().filter(|level| level.is_supported());
    level.ok_or_else(|| {
        let levels = SimdLevel::ALL.into_iter().filter(|level| level.is_supported());
        let levels: Vec<String> = levels.map(|level| level.to_string()).collect();
        format!("{text} is not available here; write one of {}", levels.join(", "))
    })
}

fn finite(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|number| number.is_finite())
}

/// `0.5`, `50%`, `1:2` or `1/2`.
fn ratio(text: &str) -> Option<f64> {
    if let Some(percent) = text.trim().strip_suffix('%') {
        return finite(percent).map(|percent| percent / 100.0);
    }
    let Some((above, below)) = text.split_once([':', '/']) else { return finite(text) };
    Some(finite(above)? / finite(below)?).filter(|ratio| ratio.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn srgb(text: &str) -> Option<[u8; 3]> {
        color(text).ok().map(|c| [c.x, c.y, c.z].map(color::linear_to_srgb8))
    }

    #[test]
    fn colors_come_in_every_form() {
        assert_eq!(srgb("lab(100% 0 0)"), Some([255; 3]), "white but for rounding");
        for text in ["1,0.5019608,0", "#ff8000", "#FF8000", "rgb(255,128,0)", " #ff8000 "] {
            assert_eq!(srgb(text), Some([255, 128, 0]), "{text}");
        }
        assert_eq!(srgb("#f80"), Some([255, 136, 0]), "short");
        assert_eq!(srgb("Orange"), Some([255, 165, 0]), "a name in any case");
        assert_eq!(srgb("f3d_red"), Some([249, 67, 6]), "F3D's");
        for text in
            ["hsl(30, 100%, 50%)", "hsv(30, 100%, 100%)", "hwb(30, 0%, 0%)", "cmyk(0%, 50%, 100%, 0%)"]
        {
            let [r, g, b] = srgb(text).expect("a colour");
            assert!(r == 255 && (127..=128).contains(&g) && b == 0, "{text}: {r}, {g}, {b}");
        }
        for text in [
            "",
            "1,2,3",
            "1,0",
            "0,0,0,0",
            "nan,0,0",
            "#ff80",
            "#12345",
            "orangish",
            "transparent",
            "#ff800080",
            "color(srgb 1.5 0 0)",
            "cmyk(150%, 0%, 0%, 0%)",
            "cmyk(0%, 0%, 0%, -20%)",
        ] {
            assert!(color(text).is_err(), "{text:?} is no opaque colour");
        }
    }

    #[test]
    fn sizes_have_two_sides() {
        let expected = Viewport { width: 1000, height: 600 };
        for text in ["1000,600", "1000x600", "1000X600", "1000, 600"] {
            assert_eq!(size(text), Ok(expected), "{text}");
        }
        for text in ["", "1000", "0,600", "1000,-1", "1e3,600", "1000,600,2", "99999,1"] {
            assert!(size(text).is_err(), "{text:?} is no size");
        }
    }

    #[test]
    fn directions_are_axes_or_numbers() {
        let cases = [
            ("+X", DVec3::X),
            ("x", DVec3::X),
            ("-Z", DVec3::NEG_Z),
            ("-y+z", DVec3::new(0.0, -1.0, 1.0)),
            ("+X-Y+Z", DVec3::new(1.0, -1.0, 1.0)),
            ("1,0,-0.5", DVec3::new(1.0, 0.0, -0.5)),
        ];
        for (text, expected) in cases {
            assert_eq!(direction(text), Ok(expected), "{text}");
        }
        for text in ["", "+", "--x", "+x+x", "xy", "x+", "w", "0,0,0", "1,2", "nan,0,1", "inf,0,0"] {
            assert!(direction(text).is_err(), "{text:?} is no direction");
        }
    }

    #[test]
    fn ratios_are_fractions_too() {
        for text in ["0.5", "50%", "1:2", "1/2", " 0.5 "] {
            assert_eq!(unit_ratio(text), Ok(0.5), "{text}");
        }
        for text in ["", "1.5", "-1", "150%", "1/0", "nan", "half"] {
            assert!(unit_ratio(text).is_err(), "{text:?} is no ratio");
        }
    }

    #[test]
    fn times_have_a_unit() {
        for (text, milliseconds) in [("16ms", 16), ("0.5s", 500), (" 2 ms ", 2), ("3600s", 3_600_000)] {
            assert_eq!(duration(text), Ok(Duration::from_millis(milliseconds)), "{text}");
        }
        for text in ["16", "0ms", "-1s", "nans", "infms", "2h", "ms", "", "3601s"] {
            assert!(duration(text).is_err(), "{text:?} is no time");
        }
    }

    /// 1e-7 is "greater than 0", which was the only condition.
    #[test]
    fn a_refused_zoom_names_the_limits() {
        for text in ["0", "1e-7", "1e7"] {
            let message = zoom(text).expect_err("out of range");
            assert!(message.contains("from 0.000001 to 1000000"), "{text}: {message}");
        }
    }

    #[test]
    fn transforms_of_textures_have_two_forms() {
        let near = |text: &str, point: [f32; 2], expected: [f32; 2]| {
            let mapped = transform(text).expect("a transform").transform_point2(Vec2::from(point));
            // Sines are rounded to f32.
            assert!(mapped.abs_diff_eq(Vec2::from(expected), 1e-6), "{text}: {mapped}");
        };
        near("scale:2,3", [1.0, 1.0], [2.0, 3.0]);
        near("angle:90;translation:1,0;scale:2", [1.0, 0.0], [1.0, 2.0]);
        near("1,0,5, 0,1,6, 0,0,1", [1.0, 1.0], [6.0, 7.0]);
        for text in ["", "scale", "scale:a", "turn:3", "1,2,3"] {
            assert!(transform(text).is_err(), "{text:?} is none");
        }
    }

    #[test]
    fn simd_levels_are_those_of_the_processor() {
        assert_eq!(simd(&SimdLevel::best().to_string()), Ok(SimdLevel::best()), "the best is one of them");
        let message = simd("sse9").expect_err("nobody has it");
        assert!(message.contains(&SimdLevel::best().to_string()), "what there is: {message}");
        for level in SimdLevel::ALL {
            assert_eq!(simd(&level.to_string()).is_ok(), level.is_supported(), "{level}");
        }
    }

    #[test]
    fn switches_have_many_spellings() {
        assert!(["true", "on", "1", "YES"].iter().all(|text| switch(text) == Ok(true)), "on");
        assert!(["false", "off", "0", "no"].iter().all(|text| switch(text) == Ok(false)), "off");
        assert!(switch("maybe").is_err(), "neither");
    }
}
