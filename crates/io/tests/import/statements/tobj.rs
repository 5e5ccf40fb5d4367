//! What tobj makes of a case, in a few words.

use std::panic::catch_unwind;

use super::row::{Format, Row, Sample};
use crate::oracle::{faces_of_scene, faces_of_tobj};

/// What tobj reads, beside what trigon reads.
pub(super) fn verdict(format: Format, row: &Row) -> String {
    let sample = Sample::with(format, &row.case);
    match format {
        Format::Obj => of_model(&sample),
        Format::Mtl => of_library(&sample.library, row),
    }
}

fn of_model(sample: &Sample) -> String {
    let ours = sample.load().map(|(loaded, _)| faces_of_scene(&loaded));
    match (faces_of_tobj(sample.model.as_bytes()), ours) {
        (Err(error), _) => format!("refuses it: {error}"),
        (Ok(_), Err(_)) => "reads it".to_owned(),
        (Ok(theirs), Ok(ours)) if theirs == ours => "the same faces".to_owned(),
        (Ok(theirs), Ok(ours)) if theirs.len() == ours.len() => "other corners".to_owned(),
        (Ok(theirs), Ok(ours)) => format!("faces: {}, not {}", theirs.len(), ours.len()),
    }
}

fn of_library(library: &str, row: &Row) -> String {
    let (materials, _) = match catch_unwind(|| tobj::load_mtl_buf(&mut library.as_bytes())) {
        Ok(Ok(found)) => found,
        Ok(Err(error)) => return format!("refuses it: {error}"),
        Err(_) => return "panics".to_owned(),
    };
    let keyword = row.keywords().first().copied().unwrap_or_default();
    if materials.iter().any(|material| material.unknown_param.contains_key(keyword)) {
        return "keeps the text".to_owned();
    }
    let files = materials.iter().flat_map(|material| {
        [
            &material.ambient_texture,
            &material.diffuse_texture,
            &material.specular_texture,
            &material.normal_texture,
            &material.shininess_texture,
            &material.dissolve_texture,
        ]
    });
    match files.flatten().find(|file| file.contains(' ')) {
        Some(file) => format!("takes `{file}` for the file"),
        None => "reads it".to_owned(),
    }
}
