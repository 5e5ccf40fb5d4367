//! The transform of a node as one word. Every number is read back with the same bits.

use std::fmt;
use std::str::FromStr;

use trigon_math::{DAffine3, DQuat, DVec3};
use trigon_scene::Transform;

/// A node that is not where its file has it, by its number in the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlacedNode {
    pub(crate) number: usize,
    pub(crate) transform: Transform,
}

/// How it is written.
const FORM: &str =
    "write the word that Ctrl+C in the window copies: number/translation/rotation/scale, or number/matrix";

/// How far the length of a rotation may be from 1.
const TOLERANCE: f64 = 1e-6;

impl fmt::Display for PlacedNode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        write!(f, "{}/", self.number)?;
        match self.transform {
            Transform::Decomposed { translation, rotation, scale } => {
                let [translation, scale] = [translation, scale].map(|vector| list(&vector.to_array()));
                write!(f, "{translation}/{}/{scale}", list(&rotation.to_array()))
            }
            Transform::Affine(affine) => f.write_str(&list(&affine.to_cols_array())),
        }
    }
}

impl FromStr for PlacedNode {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split('/').collect();
        let number = parts[0].parse().map_err(|_| FORM)?;
        let transform = match parts[1..] {
            [translation, rotation, scale] => Transform::Decomposed {
                translation: DVec3::from_array(numbers(translation)?),
                rotation: DQuat::from_array(numbers(rotation)?),
                scale: DVec3::from_array(numbers(scale)?),
            },
            [matrix] => Transform::Affine(DAffine3::from_cols_array(&numbers(matrix)?)),
            _ => return Err(FORM.to_owned()),
        };
        match transform {
            Transform::Decomposed { rotation, .. } if (rotation.length() - 1.0).abs() > TOLERANCE => {
                Err(format!("the length of the rotation is not 1; {FORM}"))
            }
            _ => Ok(Self { number, transform }),
        }
    }
}

/// Finite numbers.
fn numbers<const N: usize>(text: &str) -> Result<[f64; N], String> {
    let number = |number: &str| number.trim().parse().ok().filter(|number: &f64| number.is_finite());
    let read: Option<Vec<f64>> = text.split(',').map(number).collect();
    read.and_then(|read| read.try_into().ok()).ok_or_else(|| FORM.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_keep_their_bits() {
        let mut turned = Transform::from_translation(DVec3::new(0.1 + 0.2, -2e-9, 1e8));
        turned.rotate(DVec3::new(1.0, 2.0, 3.0), 0.7);
        let sheared = DAffine3::from_cols_array(&std::array::from_fn(|i| 1.0 / (i as f64 + 3.0)));
        for transform in [Transform::IDENTITY, turned, Transform::Affine(sheared)] {
            let placed = PlacedNode { number: 7, transform };
            assert_eq!(placed.to_string().parse(), Ok(placed), "{placed}");
        }
    }

    #[test]
    fn invalid_places_are_refused() {
        for text in [
            "",
            "1",
            "x/0,0,0/0,0,0,1/1,1,1",
            "-1/0,0,0/0,0,0,1/1,1,1",
            "1/0,0,0/0,0,0,2/1,1,1",
            "1/0,0,0/0,0,0,0/1,1,1",
            "1/0,0,0/0,0,0,1/1,1,NaN",
            "1/0,0,0/0,0,0,1",
            "1/0,0,0,0,0,0,0,0,0,0,0,inf",
        ] {
            assert!(text.parse::<PlacedNode>().is_err(), "{text:?}");
        }
    }
}
