//! The kinds of transforms.

/// What a transform does to the selection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TransformKind {
    Translate,
    Rotate,
    /// Turns about both axes of the image.
    Trackball,
    Scale,
    ShrinkFatten,
    /// Away from the middle.
    PushPull,
    ToSphere,
    /// Along edges; a tool that starts so needs [`TransformTool::sliding`](super::TransformTool::sliding).
    Slide,
}

impl TransformKind {
    /// In the status line before anything has moved.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Translate => "Move",
            Self::Rotate => "Rotate",
            Self::Trackball => "Trackball",
            Self::Scale => "Scale",
            Self::ShrinkFatten => "Shrink/Fatten",
            Self::PushPull => "Push/Pull",
            Self::ToSphere => "To Sphere",
            Self::Slide => "Slide",
        }
    }
}
