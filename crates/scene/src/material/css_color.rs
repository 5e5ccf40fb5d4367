//! Colours by their names in CSS.

use thiserror::Error;
use trigon_math::{Vec3, Vec4, color};

use crate::Material;

/// Why a text is no colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ColorError {
    /// The text is no colour of CSS.
    #[error("write a colour of CSS, such as orange, #f80, #ff8800 or rgb(255 136 0)")]
    Unknown,
    /// It is one of a larger space.
    #[error("the colour is outside of sRGB, whose channels go from 0 to 1")]
    OutsideSrgb,
}

/// A colour of CSS (Color Module Level 4), such as `orange`, `#f80`, `#ff8800cc` or `hsl(32 100% 50%)`: linear RGB and
/// straight alpha, as materials have it.
///
/// ```
/// use trigon_scene::css_color;
///
/// assert_eq!(css_color("white").unwrap().to_array(), [1.0; 4]);
/// let [red, green, blue, alpha] = css_color("#ff880080").unwrap().to_array();
/// assert!(red == 1.0 && (0.246..0.247).contains(&green) && blue == 0.0 && (0.50..0.51).contains(&alpha));
/// ```
///
/// # Errors
/// The text is no colour of CSS, or the colour is outside of sRGB.
pub fn css_color(text: &str) -> Result<Vec4, ColorError> {
    /// What is white in another colour space may be off by so much.
    const ROUNDING: f32 = 1e-3;
    let parsed = csscolorparser::parse(text).map_err(|_| ColorError::Unknown)?;
    let srgb = Vec3::new(parsed.r, parsed.g, parsed.b);
    let within = srgb.clamp(Vec3::ZERO, Vec3::ONE);
    let is_number = srgb.is_finite() && (0.0..=1.0).contains(&parsed.a);
    if !is_number || (srgb - within).abs().max_element() > ROUNDING {
        return Err(ColorError::OutsideSrgb);
    }
    let [red, green, blue] = within.to_array().map(color::srgb_to_linear);
    Ok(Vec4::new(red, green, blue, parsed.a))
}

impl Material {
    /// The default plastic in a [colour of CSS](css_color), such as `tomato`. A translucent one is blended.
    ///
    /// ```
    /// # use trigon_scene::{AlphaMode, Material};
    /// assert!(Material::from_css("tomato")?.base_color.x > 0.99);
    /// assert_eq!(Material::from_css("#0008")?.alpha_mode, AlphaMode::Blend);
    /// assert!(Material::from_css("tomatoe").is_err());
    /// # Ok::<(), trigon_scene::ColorError>(())
    /// ```
    ///
    /// # Errors
    /// As [`css_color`].
    pub fn from_css(text: &str) -> Result<Self, ColorError> {
        let base_color = css_color(text)?;
        let alpha_mode = if base_color.w < 1.0 { crate::AlphaMode::Blend } else { crate::AlphaMode::Opaque };
        Ok(Self { base_color, alpha_mode, ..Self::default() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes as the table of CSS has them.
    #[test]
    fn names_are_the_bytes_of_the_standard() {
        for (name, bytes) in [
            ("tomato", [255, 99, 71, 255]),
            ("rebeccapurple", [102, 51, 153, 255]),
            ("SteelBlue", [70, 130, 180, 255]),
            ("#123", [17, 34, 51, 255]),
            ("#12345678", [18, 52, 86, 120]),
            ("rgb(10 20 30 / 0)", [10, 20, 30, 0]),
            ("hsl(120 100% 50%)", [0, 255, 0, 255]),
        ] {
            assert_eq!(css_color(name).map(color::linear_to_srgba8), Ok(bytes), "{name}");
        }
    }

    #[test]
    fn what_is_no_colour_is_refused() {
        for text in ["", "nocolour", "#12", "rgb(1,2)", "#ggg"] {
            assert_eq!(css_color(text), Err(ColorError::Unknown), "{text}");
        }
        for text in
            ["rgb(nan 0 0)", "rgb(inf 0 0)", "rgb(0 0 0 / nan)", "hsl(nan 100% 50%)", "rgb(1 2 3 / -inf)"]
        {
            let color = css_color(text);
            assert!(color.is_err() || color.is_ok_and(|color| color.is_finite()), "{text}: {color:?}");
        }
        assert_eq!(css_color("oklch(0.7 0.4 150)"), Err(ColorError::OutsideSrgb), "more green than sRGB has");
    }
}
