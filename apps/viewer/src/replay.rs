//! Replay mode: draws a capture again and reports whether the image is the same.

use std::path::Path;

use trigon_io::{Capture, Limits};
use trigon_scene::{RenderSettings, render};

use crate::args::{Destination, Request, Subject};
use crate::failure::Failure;
use crate::outlet::Outlet;
use crate::report::Reporter;

/// Draws a capture again; returns the exit code.
pub(crate) fn run(path: &Path, output: Option<&Destination>, request: &Request, reporter: Reporter) -> u8 {
    match replay(path, output, request, reporter) {
        Ok(()) => 0,
        Err(failure) => {
            reporter.error(&failure);
            failure.exit_code()
        }
    }
}

fn replay(
    path: &Path,
    output: Option<&Destination>,
    request: &Request,
    reporter: Reporter,
) -> Result<(), Failure> {
    let mut outlet = Outlet::new(output, request, reporter);
    outlet.refuse_terminal()?;
    let capture = Capture::read(path, &Limits::default()).map_err(Failure::work)?;
    let RenderSettings { threads, simd, .. } = request.settings;
    let settings = RenderSettings { threads, simd, ..capture.settings.clone() };
    let frame = render(&capture.scene, &capture.camera, &settings).map_err(Failure::work)?;
    outlet.put(Subject { model: Some(path), ..Subject::default() }, &frame)?;
    match capture.mismatch(&frame) {
        None => {
            let (path, hash) = (path.display(), capture.image_hash());
            reporter.info(format_args!("{path}: the same image, {hash:016x}"));
            Ok(())
        }
        Some(mismatch) => Err(Failure::Mismatch(format!(
            "{}: {mismatch}; it was captured by trigon {}, this is {}",
            path.display(),
            capture.program,
            env!("CARGO_PKG_VERSION")
        ))),
    }
}
