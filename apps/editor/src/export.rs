//! Exports the result as a file for other programs.

use std::path::{Path, PathBuf};

use trigon_document::{Disk, Document, SetFile, save_set};
use trigon_io::{Encoding, ExportOptions, FaceExport, FileIdentity, Format, UpAxis, writers};

use crate::arguments::Arguments;
use crate::report;

/// What a file for other programs gets of a document, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ExportChoices {
    /// The axis that is up in the file; none for that of its format.
    pub(crate) up: Option<UpAxis>,
    /// Units of the file per metre.
    pub(crate) scale: f64,
    /// Whether it gets only what is selected.
    pub(crate) selection_only: bool,
    pub(crate) triangulate: bool,
    /// Whether meshes are written as their modifiers make them, instead of as they are edited.
    pub(crate) modifiers: bool,
    /// Whether numbers are written as text where a format has both.
    pub(crate) text: bool,
}

impl ExportChoices {
    /// Those of the command line.
    pub(crate) fn new(arguments: &Arguments) -> Self {
        Self {
            up: arguments.up,
            scale: arguments.scale.unwrap_or(1.0),
            selection_only: arguments.selection_only,
            triangulate: arguments.triangulate,
            modifiers: !arguments.no_modifiers,
            text: arguments.ascii,
        }
    }

    /// The same for a file of a format: one that states its unit holds true sizes.
    pub(crate) fn for_format(self, format: Format) -> Self {
        if states_unit(format) { Self { scale: 1.0, ..self } } else { self }
    }

    pub(crate) fn options(&self, document: &Document) -> ExportOptions<'static> {
        let selected = || document.selection().objects.iter().copied().collect();
        ExportOptions {
            nodes: self.selection_only.then(selected),
            up: self.up,
            scale: self.scale,
            faces: if self.triangulate { FaceExport::Triangles } else { FaceExport::Polygons },
            modifiers: self.modifiers,
            encoding: if self.text { Encoding::Text } else { Encoding::Binary },
            ..ExportOptions::default()
        }
    }
}

/// Whether files of a format say what unit their numbers have, and the writer sees to it.
pub(crate) fn states_unit(format: Format) -> bool {
    format == Format::ThreeMf
}

/// The format of the result; none if it is the editor's own file.
pub(crate) fn format_of(arguments: &Arguments, output: &Path) -> Result<Option<Format>, String> {
    let format = format_by_ending(output)?;
    let is_changed = arguments.up.is_some() || arguments.scale.is_some();
    let is_part = arguments.selection_only || arguments.no_modifiers;
    Ok((format != Format::Glb || is_changed || is_part).then_some(format))
}

/// The format that a file's ending names.
pub(crate) fn format_by_ending(output: &Path) -> Result<Format, String> {
    let ending = output.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let Some(writer) = writers().find(|writer| writer.extensions.contains(&ending.as_str())) else {
        let known: Vec<String> = writers().map(|writer| format!(".{}", writer.extensions[0])).collect();
        let known = known.join(", ");
        return Err(format!(
            "{}: cannot be written; name a file that ends in one of {known}",
            output.display()
        ));
    };
    Ok(writer.format)
}

/// Writes the document; what the format cannot hold is said.
pub(crate) fn write(
    document: &Document,
    format: Format,
    output: &Path,
    arguments: &Arguments,
) -> Result<(), String> {
    let options = ExportChoices::new(arguments).for_format(format).options(document);
    let losses = write_as(document, format, output, &options)?;
    if !arguments.quiet {
        losses.iter().for_each(|loss| report("warning", loss));
        if arguments.scale.is_some() && states_unit(format) {
            report("warning", "--scale is left out: the format states its unit, and sizes are true");
        }
    }
    Ok(())
}

/// The same with other options. Returns what the format cannot hold.
pub(crate) fn write_as(
    document: &Document,
    format: Format,
    output: &Path,
    options: &ExportOptions<'_>,
) -> Result<Vec<String>, String> {
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    let export = document.export(&name, format, options).map_err(|error| error.to_string())?;
    let losses = export.what_would_be_lost().iter().map(|loss| format!("not in {name}: {loss}")).collect();
    let folder = output.parent().unwrap_or(Path::new(""));
    let files = || export.files.iter().map(|file| folder.join(&file.name));
    refuse_to_replace(document, output, files())?;
    let set = export.files.iter().map(|file| SetFile { path: folder.join(&file.name), bytes: &file.bytes });
    save_set(&mut Disk, &set.collect::<Vec<_>>()).map_err(|error| error.to_string())?;
    Ok(losses)
}

/// Refuses to replace a file that the document was read from, such as a texture: its contents would be lost. Only the
/// model itself may be, with its material library; a backup of it stays.
pub(crate) fn refuse_to_replace(
    document: &Document,
    output: &Path,
    mut files: impl Iterator<Item = PathBuf>,
) -> Result<(), String> {
    let identity = |path: &Path| FileIdentity::of(path).ok();
    let read: Vec<_> = document.files().iter().map(|path| (path, identity(path))).collect();
    let target = identity(output);
    let is_over_model = read.first().is_some_and(|(_, model)| model.is_some() && *model == target);
    let is_library = |path: &Path| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("mtl"));
    let refusal = files.find_map(|file| {
        let own = identity(&file)?;
        let (path, _) = read.iter().find(|(_, known)| known.as_ref() == Some(&own))?;
        let may_be = is_over_model && (Some(&own) == target.as_ref() || is_library(path));
        (!may_be).then(|| {
            format!(
                "{}: the document was read from it ({}), and it would be lost; write under another name or to another folder",
                file.display(),
                path.display()
            )
        })
    });
    refusal.map_or(Ok(()), Err)
}
