//! Additional outputs: their names and file formats.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use trigon_io::Output;

/// A requested output, and the format of its own file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Beside {
    pub(crate) output: Output,
    /// `None` if no format is given.
    format: Option<Format>,
}

/// The format of a file for one output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    /// A NumPy array.
    Npy,
    /// A PNG of 16 bits.
    Png16,
}

impl Beside {
    /// Whether the name has an extension, as in `depth.png`.
    pub(crate) fn names_format(self) -> bool {
        self.format.is_some()
    }

    pub(crate) fn format(self) -> Format {
        self.format.unwrap_or(Format::Npy)
    }

    /// The name of the file with what positions are relative to, as a NumPy array has no place for it:
    /// `chair.positions-origin.npy`. Other outputs have none.
    pub(crate) fn origin_path(self, image: &Path) -> Option<PathBuf> {
        (self.output == Output::Positions)
            .then(|| image.with_extension(format!("{}-origin.npy", self.output)))
    }

    /// The name of its file, next to the image's: `chair.png` and `chair.depth.npy`.
    pub(crate) fn path(self, image: &Path) -> PathBuf {
        let ending = match self.format() {
            Format::Npy => "npy",
            Format::Png16 => "png",
        };
        image.with_extension(format!("{}.{ending}", self.output))
    }
}

impl FromStr for Beside {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, format) = match text.split_once('.') {
            None => (text, None),
            Some((name, "npy")) => (name, Some(Format::Npy)),
            Some((name, "png")) => (name, Some(Format::Png16)),
            Some((_, ending)) => {
                return Err(format!(".{ending} is not a format for one output; write .npy or .png"));
            }
        };
        let output: Output = name.parse().map_err(|error: trigon_io::UnknownOutput| error.to_string())?;
        if format == Some(Format::Png16) && !output.fits_png16() {
            return Err(format!(
                "{output} does not fit into a 16-bit PNG; write it as {output}.npy or into an OpenEXR file"
            ));
        }
        Ok(Self { output, format })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_lie_next_to_the_image() {
        for (text, name) in [
            ("depth", "a/big.chair.depth.npy"),
            ("object-ids.npy", "a/big.chair.object-ids.npy"),
            ("normals.png", "a/big.chair.normals.png"),
        ] {
            let beside: Beside = text.parse().expect("an output");
            assert_eq!(beside.path(Path::new("a/big.chair.png")), Path::new(name), "{text}");
        }
    }

    #[test]
    fn mistakes_are_named() {
        for (text, words) in [
            ("dept", "geometric-normals"),
            ("depth.tiff", ".npy or .png"),
            ("", "albedo"),
            ("albedo.png", "albedo.npy"),
        ] {
            let error = text.parse::<Beside>().expect_err("refused");
            assert!(error.contains(words), "{text}: {error}");
        }
    }
}
