//! Captures: a scene, a camera, settings and the resulting image, in one file, so that any machine
//! can draw it again and compare.
//!
//! The input is stored bit by bit; derived data (triangles, normals, mip levels, blurred
//! environments, hierarchies, caches) is recomputed.
//!
//! # The file
//! Numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | `93 54 52 49 47 4f 4e 0a`: `TRIGON` between two bytes that text is not |
//! | 4 | the version of the format, [`VERSION`] |
//! | 1 + n | the version of the program that wrote it: its length, and text |
//! | 8 | the hash of what follows (FNV-1a, 64 bits) |
//! | rest | scene, settings, camera, the image's bytes, the up axis and further parameters of materials, compressed by zlib |
//!
//! Within the last part values follow each other without tags; the lists of fields in this folder
//! are its order. Any change of them is a new version.

mod looks;
mod mesh;
mod scene;
mod settings;
mod stored;

use std::fmt;
use std::io::Write;
use std::path::Path;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use stored::Stored;
use trigon_camera::Camera;
use trigon_scene::{Frame, RenderSettings, Scene};

use self::stored::{CaptureReader, CaptureWriter, Damage};
use super::error::{LoadError, LoadErrorKind};
use super::folder::{Folder, to_the_end};
use super::options::Limits;
use super::write::{WriteError, write_atomically};

const MAGIC: [u8; 8] = *b"\x93TRIGON\n";

/// The version of the format.
const VERSION: u32 = 8;

/// The oldest version that is read. Version 7 has no radii of lights and no soft shadows, which are those of lamps without
/// an extent then.
const OLDEST: u32 = 7;

/// A scene, a camera, settings and the resulting image.
///
/// ```
/// use trigon_io::{Capture, Limits};
/// use trigon_scene::{RenderSettings, render, showcase};
///
/// let scene = showcase();
/// let settings = RenderSettings::new(16, 9);
/// let camera = scene.overview(settings.aspect());
/// let frame = render(&scene, &camera, &settings)?;
/// let file = Capture::new(scene, camera, settings, &frame).to_bytes();
///
/// let capture = Capture::from_bytes("bug.trigon", &file, &Limits::default())?;
/// let again = render(&capture.scene, &capture.camera, &capture.settings)?;
/// assert_eq!(capture.mismatch(&again), None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Capture {
    /// The scene and camera.
    pub scene: Scene,
    /// From where.
    pub camera: Camera,
    /// The settings. The colours do not depend on other outputs, threads and SIMD level, so these
    /// are not captured.
    pub settings: RenderSettings,
    /// The image: four bytes per pixel, sRGB and straight alpha, rows from the top.
    pub color: Vec<u8>,
    /// The version of the program that captured it.
    pub program: String,
}

impl Capture {
    /// A capture of a frame drawn by this program.
    ///
    /// # Panics
    /// The frame does not have the size given by the settings, or has no colours.
    #[must_use]
    pub fn new(scene: Scene, camera: Camera, settings: RenderSettings, frame: &Frame) -> Self {
        let requested = (settings.width, settings.height);
        assert_eq!((frame.width, frame.height), requested, "the frame was drawn by these settings");
        let pixels = settings.width as usize * settings.height as usize;
        assert_eq!(frame.color.len(), 4 * pixels, "the frame holds colours");
        let program = env!("CARGO_PKG_VERSION").to_owned();
        Self { scene, camera, settings, color: frame.color.clone(), program }
    }

    /// The hash of the captured image: FNV-1a, 64 bits, over its bytes.
    #[must_use]
    pub fn image_hash(&self) -> u64 {
        fnv1a(&self.color)
    }

    /// How an image differs from the captured one; `None` if every byte is the same.
    #[must_use]
    pub fn mismatch(&self, drawn: &Frame) -> Option<Mismatch> {
        Mismatch::between([self.settings.width, drawn.width], &self.color, &drawn.color)
    }

    /// The file.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut to = CaptureWriter { bytes: Vec::new(), scene: &self.scene };
        self.scene.write(&mut to);
        self.settings.write(&mut to);
        self.camera.write(&mut to);
        self.color.write(&mut to);
        looks::write(&self.scene, &mut to);
        sealed(VERSION, &self.program, &to.bytes)
    }

    /// Writes the file atomically.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), WriteError> {
        write_atomically(path.as_ref(), |file| file.write_all(&self.to_bytes()))
    }

    /// Reads a file.
    ///
    /// # Errors
    /// It cannot be read, or as for [`Self::from_bytes`].
    pub fn read(path: impl AsRef<Path>, limits: &Limits) -> Result<Self, LoadError> {
        let path = path.as_ref();
        let bytes = Folder::none(limits).read_model(path, &to_the_end)?;
        Self::from_bytes(path, &bytes, limits)
    }

    /// The capture in a file's bytes; `name` stands for the file in messages.
    ///
    /// # Errors
    /// It is not a capture, was written in another version of the format (the message names both),
    /// is damaged, or exceeds the limits.
    pub fn from_bytes(name: impl AsRef<Path>, bytes: &[u8], limits: &Limits) -> Result<Self, LoadError> {
        let name = name.as_ref();
        let Opened { version, program, compressed } = opened(name, bytes)?;
        let reader = CaptureReader::new(version, compressed, limits);
        Self::read_parts(program, reader).map_err(|damage| match damage {
            Damage::Malformed(what) => LoadError::malformed(name, what, CAPTURE_AGAIN),
            Damage::Limit(what) => LoadError::limit(name, what),
        })
    }

    fn read_parts(program: String, mut from: CaptureReader<'_>) -> Result<Self, Damage> {
        let (mut scene, settings) = (Scene::read(&mut from)?, RenderSettings::read(&mut from)?);
        let (camera, color) = (Camera::read(&mut from)?, Vec::<u8>::read(&mut from)?);
        let pixels = u64::from(settings.width) * u64::from(settings.height);
        if pixels.checked_mul(4) != Some(color.len() as u64) {
            return Err(Damage::malformed("the image has another size than the settings"));
        }
        looks::read(&mut scene, &mut from)?;
        from.finish()?;
        Ok(Self { scene, camera, settings, color, program })
    }
}

const CAPTURE_AGAIN: &str = "capture the image again, or copy the file again";

/// A file with uncompressed parts.
fn sealed(version: u32, program: &str, parts: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    let compressed = encoder.write_all(parts).and_then(|()| encoder.finish());
    let compressed = compressed.expect("memory takes every byte");
    let length = program.len().min(usize::from(u8::MAX));
    let program = &program.as_bytes()[..length];
    let hash = fnv1a(&compressed).to_le_bytes();
    [&MAGIC[..], &version.to_le_bytes(), &[length as u8], program, &hash, &compressed].concat()
}

/// A file whose hash is right.
struct Opened<'a> {
    version: u32,
    /// That wrote it.
    program: String,
    compressed: &'a [u8],
}

fn opened<'a>(name: &Path, bytes: &'a [u8]) -> Result<Opened<'a>, LoadError> {
    let no_capture = || {
        let remedy = "name a file that --capture wrote";
        LoadError::new(LoadErrorKind::Unsupported, name, "it is not a capture", remedy)
    };
    let rest = bytes.strip_prefix(&MAGIC).ok_or_else(no_capture)?;
    let (version, rest) = rest.split_first_chunk().ok_or_else(no_capture)?;
    let (&length, rest) = rest.split_first().ok_or_else(no_capture)?;
    let (program, rest) = rest.split_at_checked(usize::from(length)).ok_or_else(no_capture)?;
    let program = String::from_utf8_lossy(program).into_owned();
    let version = u32::from_le_bytes(*version);
    if !(OLDEST..=VERSION).contains(&version) {
        let what = format!(
            "it is a capture in version {version} of the format, by trigon {program}; this is trigon {}, which reads versions {OLDEST} to {VERSION}",
            env!("CARGO_PKG_VERSION")
        );
        let remedy = format!("replay it with trigon {program}");
        return Err(LoadError::new(LoadErrorKind::Unsupported, name, what, remedy));
    }
    match rest.split_first_chunk() {
        Some((hash, compressed)) if u64::from_le_bytes(*hash) == fnv1a(compressed) => {
            Ok(Opened { version, program, compressed })
        }
        _ => Err(LoadError::malformed(name, "its bytes are not those that were written", CAPTURE_AGAIN)),
    }
}

fn fnv1a(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// The difference between an image and the captured one. Its `Display` is one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Mismatch {
    /// The hash of the captured image.
    pub captured_hash: u64,
    /// The hash of the new image.
    pub drawn_hash: u64,
    /// Where they differ; `None` if their sizes do.
    pub pixels: Option<PixelMismatch>,
}

/// The pixels that differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct PixelMismatch {
    /// How many.
    pub count: usize,
    /// Out of this many.
    pub total: usize,
    /// The position of the first one, in rows from the top: x and y.
    pub first: [u32; 2],
    /// Red, green, blue and alpha of the first one in the captured image.
    pub captured: [u8; 4],
    /// And in the new image.
    pub drawn: [u8; 4],
}

impl Mismatch {
    /// Compares two images of four bytes per pixel, each with its width.
    fn between(widths: [u32; 2], captured: &[u8], drawn: &[u8]) -> Option<Self> {
        let has_one_width = widths[0] == widths[1];
        if has_one_width && captured == drawn {
            return None;
        }
        let has_one_size = has_one_width && captured.len() == drawn.len();
        let pixels = has_one_size.then(|| PixelMismatch::between(widths[0], captured, drawn)).flatten();
        Some(Self { captured_hash: fnv1a(captured), drawn_hash: fnv1a(drawn), pixels })
    }
}

impl PixelMismatch {
    fn between(width: u32, captured: &[u8], drawn: &[u8]) -> Option<Self> {
        let (captured, drawn) = (captured.as_chunks().0, drawn.as_chunks().0);
        let differs = |&index: &usize| captured[index] != drawn[index];
        let mut different = (0..captured.len()).filter(differs);
        let first = different.next()?;
        Some(Self {
            count: 1 + different.count(),
            total: captured.len(),
            first: [first as u32 % width, first as u32 / width],
            captured: captured[first],
            drawn: drawn[first],
        })
    }
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { captured_hash, drawn_hash, pixels } = self;
        write!(f, "the image differs from the captured one: ")?;
        match pixels {
            Some(PixelMismatch { count, total, first: [x, y], captured, drawn }) => write!(
                f,
                "{count} of {total} pixels, the first at ({x}, {y}), which was {captured:?} and is {drawn:?}"
            )?,
            None => write!(f, "it has another size")?,
        }
        write!(f, "; its hash was {captured_hash:016x} and is {drawn_hash:016x}")
    }
}

#[cfg(test)]
mod tests;
