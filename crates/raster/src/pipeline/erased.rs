//! Pipelines of different types side by side: the type is erased once per draw. A virtual call restores it, once
//! for all pixels of a draw in a tile.

use super::{run, scalar};
use crate::LanePipeline;
use crate::fragments::{Columns, ShadeContext, ShadeOutput, Task};
use crate::simd::{Token, at_level};
use crate::vertex::VertexProgram;

/// A pipeline without its type.
pub(crate) trait AnyPipeline: VertexProgram {
    /// Whether it reads the whole fragment, depth and 1/w included.
    fn reads_all(&self) -> bool;

    /// Whether a triangle has the same colour all over.
    fn is_flat(&self) -> bool;

    /// Shades pixels of the draw; of a flat one, one of each triangle.
    fn shade(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        output: &mut ShadeOutput<'_>,
    );

    /// Evaluates the masks of a list of fragments: 1 or 0 for each, at its output's index.
    fn mask(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        passed: &mut [u8],
    );
}

impl<P: LanePipeline> AnyPipeline for P {
    fn reads_all(&self) -> bool {
        P::SCALAR
    }

    fn is_flat(&self) -> bool {
        P::FLAT
    }

    fn shade(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        output: &mut ShadeOutput<'_>,
    ) {
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            scalar::shade(token, pipeline, context, task, columns, output);
        } else {
            at_level!(token, simd => run::shade(simd, self, context, task, columns, output));
        }
    }

    fn mask(
        &self,
        token: Token,
        context: &ShadeContext<'_>,
        task: &Task<'_>,
        columns: &mut [Columns; 2],
        passed: &mut [u8],
    ) {
        if P::SCALAR {
            let pipeline = self.as_scalar().expect("a scalar pipeline");
            scalar::mask(token, pipeline, context, task, columns, passed);
        } else if P::MASKED {
            at_level!(token, simd => run::mask(simd, self, context, task, columns, passed));
        } else {
            passed.fill(1);
        }
    }
}
