//! Counts of the work done for effects, noted where the work is done, and a switch that draws what cannot be seen. Only
//! tests use counts and switch; other builds contain none of this.

use crate::material::MaterialTexture;

/// Something that is done for effects only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Work {
    /// Light of a lamp on eight points.
    LampLight,
    /// Ambient light without an environment on eight points.
    AmbientLight,
    /// What eight points mirror of a lamp or of ambient light.
    Highlight,
    /// Eight look-ups in a texture.
    TextureLookUp(MaterialTexture),
    /// Eight colours are found that others show through.
    Blend,
    /// Eight alphas are compared with a mask's.
    Mask,
    /// Light of its own is added to eight colours.
    Emission,
    /// Eight vertices hand on tangents.
    Tangents,
    /// Eight colours of vertices are multiplied.
    VertexColors,
    /// The vertices of a mesh are posed.
    Pose,
    /// The lamps of an image are exposed by a light meter.
    LightMeter,
    /// A map of depths is drawn as a lamp sees them.
    ShadowMap,
    /// Eight look-ups in the shadow maps of a lamp.
    ShadowLookUp,
    /// A ray to a lamp.
    ShadowRay,
    /// Rays to a lamp with an extent.
    SoftShadowRay,
    /// The width of the shadow of such a lamp is found in its shadow map.
    PenumbraLookUp,
    /// A ray into the surroundings.
    OcclusionRay,
    /// A ray along the line of sight.
    SightRay,
    /// Light of the environment is looked up.
    EnvironmentLight,
    /// Light of the studio on eight points of metal.
    StudioLight,
    /// Eight colours are seen through fog.
    Fog,
    /// Tones of an image are mapped.
    ToneMapping,
    /// Outlines are drawn over an image.
    Outline,
}

/// Notes work that is being done.
#[inline(always)]
pub(crate) fn note(work: Work) {
    #[cfg(test)]
    done::add(work);
    #[cfg(not(test))]
    let _ = work;
}

#[cfg(test)]
pub(crate) mod done {
    //! What this thread has done: tests that look at it draw on one thread, which is their own.

    use super::Work;
    use std::cell::RefCell;

    thread_local! {
        static DONE: RefCell<Vec<Work>> = const { RefCell::new(Vec::new()) };
    }

    pub(super) fn add(work: Work) {
        DONE.with_borrow_mut(|done| {
            if !done.contains(&work) {
                done.push(work);
            }
        });
    }

    /// The kinds of work that were done since the last call.
    pub(crate) fn take() -> Vec<Work> {
        DONE.take()
    }
}

/// Whether what cannot be seen is drawn all the same: only in tests, which compare both images.
pub(crate) fn keeps_unseen() -> bool {
    #[cfg(test)]
    return kept::KEPT.get();
    #[cfg(not(test))]
    false
}

#[cfg(test)]
pub(crate) mod kept {
    //! Draws what cannot be seen, on the thread that asks for it.

    use std::cell::Cell;

    thread_local! {
        pub(super) static KEPT: Cell<bool> = const { Cell::new(false) };
    }

    /// Calls a function while nothing is left out.
    pub(crate) fn with_everything<T>(draw: impl FnOnce() -> T) -> T {
        KEPT.set(true);
        let drawn = draw();
        KEPT.set(false);
        drawn
    }
}
