//! The command of a slide along edges.

use trigon_document::{Command, SlideEdges, SlideVertices, TransformSpace};

use super::super::snap::rounded;
use super::TransformTool;

impl TransformTool {
    /// The command that slides what is selected.
    pub(super) fn slide_along(&mut self) -> Result<Command, String> {
        let Some(slide) = &self.slide else { return Err("nothing is selected that could slide".into()) };
        let (dragged, direction) = slide.follow(self.modal.pointer.way());
        let step = self.settings.snap.factor_step(self.modal.is_precise());
        let dragged = if self.snaps() { rounded(dragged, step) } else { dragged };
        let typed = self.modal.numeric.value_or(0.0).map_err(|error| error.to_string())?;
        let factor = typed.unwrap_or(dragged);
        self.text = format!("Slide {factor:.4}");
        Ok(if slide.edges {
            SlideEdges { factor }.into()
        } else {
            SlideVertices { factor, direction: direction.to_array(), space: TransformSpace::World }.into()
        })
    }
}
