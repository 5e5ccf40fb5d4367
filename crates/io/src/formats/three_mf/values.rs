//! Values of attributes: numbers, colours, transforms.

use trigon_math::{DAffine3, Vec4};

use super::properties::display_color;
use super::xml::{Xml, XmlElement};
use crate::error::LoadError;
use crate::numbers::number;
use crate::rows::words;

impl Xml<'_> {
    /// The number of a resource, if its element has one.
    pub(super) fn id(&self, element: &XmlElement<'_>) -> Result<Option<u32>, LoadError> {
        for attribute in element.attributes() {
            let attribute = self.checked(attribute)?;
            if attribute.key.as_ref() == b"id" {
                return self.index(&attribute.value, "id").map(Some);
            }
        }
        Ok(None)
    }

    /// A colour as linear light, with alpha.
    pub(super) fn color(&self, value: &[u8]) -> Result<Vec4, LoadError> {
        let wrong = || {
            let word = String::from_utf8_lossy(&value[..value.len().min(40)]).into_owned();
            self.fault(format!("the colour \"{word}\" is not #RRGGBB or #RRGGBBAA"))
        };
        display_color(value.trim_ascii()).ok_or_else(wrong)
    }

    /// Twelve numbers: the rows of a matrix that row vectors are multiplied with, the last one the translation.
    pub(super) fn transform(&self, value: &[u8]) -> Result<DAffine3, LoadError> {
        let numbers = words(value).map(|word| self.number(word)).collect::<Result<Vec<f64>, LoadError>>()?;
        let numbers: [f64; 12] = numbers.try_into().map_err(|numbers: Vec<f64>| {
            self.fault(format!("a transform has {} numbers instead of 12", numbers.len()))
        })?;
        // The rows of the file are the columns of a matrix that stands before a vector.
        Ok(DAffine3::from_cols_array(&numbers))
    }

    /// A finite number.
    pub(super) fn number(&self, word: &[u8]) -> Result<f64, LoadError> {
        match number(word.trim_ascii()) {
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) => Err(self.fault("a number is not finite")),
            Err(what) => Err(self.fault(what)),
        }
    }

    /// A number of something; `attribute` is for the message.
    pub(super) fn index(&self, word: &[u8], attribute: &str) -> Result<u32, LoadError> {
        let text = std::str::from_utf8(word.trim_ascii()).unwrap_or_default();
        text.parse().map_err(|_| {
            let word = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
            self.fault(format!("{attribute} is \"{word}\" instead of a number from 0 on"))
        })
    }
}
