//! Explanations as text.

use super::{FragmentExplanation, PixelExplanation, PrimitiveKind, SampleExplanation, Verdict};
use std::fmt::{Display, Formatter, Result};

impl Display for PixelExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [x, y] = self.pixel;
        writeln!(f, "pixel ({x}, {y}): linear colour {}", self.color)?;
        for (i, sample) in self.samples.iter().enumerate() {
            write!(f, "{sample}")?;
            if i == self.reported && self.samples.len() > 1 {
                writeln!(f, "  depth and ids of the pixel come from this sample")?;
            }
        }
        Ok(())
    }
}

impl Display for SampleExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [x, y] = self.position.map(|v| f64::from(v) / 256.0);
        write!(f, " sample {} at ({x}, {y}): ", self.number)?;
        match self.visible() {
            Some(visible) => write!(f, "object {}, face {}", visible.object, visible.face)?,
            None => write!(f, "the background")?,
        }
        match self.layers().count() {
            0 => writeln!(f)?,
            1 => writeln!(f, " under 1 layer")?,
            layers => writeln!(f, " under {layers} layers")?,
        }
        self.fragments.iter().try_for_each(|fragment| write!(f, "{fragment}"))
    }
}

impl Display for FragmentExplanation {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let kind = match self.kind {
            PrimitiveKind::Triangle => "triangle",
            PrimitiveKind::Line => "line",
            PrimitiveKind::SquarePoint => "square point",
            PrimitiveKind::RoundPoint => "round point",
        };
        let cut = if self.is_cut { ", cut" } else { "" };
        write!(
            f,
            "  {kind} {} of draw {} (object {}, face {}{cut}): ",
            self.primitive, self.draw, self.object, self.face
        )?;
        write_verdict(self, f)?;
        let [a, b, c] = self.edges.map(|edge| (edge.value, if edge.owns_boundary { "≥" } else { ">" }));
        write!(f, "    edges {} ({} 0), {} ({} 0), {} ({} 0)", a.0, a.1, b.0, b.1, c.0, c.1)?;
        if let Some(depth) = self.depth {
            write!(f, "; depth {depth}")?;
        }
        writeln!(f)
    }
}

fn write_verdict(fragment: &FragmentExplanation, f: &mut Formatter<'_>) -> Result {
    let margin = fragment.margin.unwrap_or(0);
    match fragment.verdict {
        Verdict::Visible if fragment.margin.is_none() => writeln!(f, "visible; the only one here"),
        Verdict::Visible if margin == 0 => {
            writeln!(f, "visible; as near as the next, and its (object, face) is smaller")
        }
        Verdict::Visible => writeln!(f, "visible; nearer than the next by {margin} ulp"),
        Verdict::Hidden => writeln!(f, "hidden by {} ulp", -margin),
        Verdict::EqualDepth => {
            writeln!(f, "as near as the visible triangle, whose (object, face) is smaller")
        }
        Verdict::BehindFarPlane => writeln!(f, "behind the far plane"),
        Verdict::MaskedAway => writeln!(f, "masked away"),
        Verdict::Layer(number) => writeln!(f, "layer {number} from the back"),
        Verdict::LeftToJoint => writeln!(f, "left to a later segment of the polyline"),
        Verdict::OutsideEdge(edge) => {
            let distance = -fragment.edges[edge].distance;
            writeln!(f, "misses the sample: outside of edge {edge} by {distance:.4} pixel")
        }
        Verdict::OutsideDisc => writeln!(f, "misses the sample: outside of the disc"),
    }
}
