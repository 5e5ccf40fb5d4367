//! Counts of the work done for effects, noted where it is done. Only tests read them; other builds contain
//! none of this.

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
