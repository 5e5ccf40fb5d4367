//! Animations: what is in the file stays there, and the rest is written.

use std::collections::BTreeSet;

use serde_json::value::RawValue;
use trigon_scene::Animation;

use super::SceneWriter;
use crate::error::Location;
use crate::formats::gltf::write::movement::write_animation;
use crate::formats::gltf::write::raw::RawObject;
use crate::loss::Loss;

impl SceneWriter<'_> {
    /// Animations that are in the file stay; others are written, and those that were removed go.
    pub(super) fn write_animations(&mut self) {
        let was: &[Animation] = self.retained.map_or(&[], |retained| &retained.scene.animations);
        let now = &self.scene.animations;
        if self.retained.is_some() && was == now {
            return;
        }
        let retained = self.retained;
        let origin = |index: usize| retained.and_then(|retained| retained.source.animation(index));
        let same_index = indices_of(was, now);
        let taken: BTreeSet<usize> = same_index.iter().flatten().copied().collect();
        let removed: BTreeSet<usize> =
            (0..was.len()).filter(|index| !taken.contains(index)).filter_map(origin).collect();
        for (animation, index) in now.iter().zip(&same_index) {
            if index.is_some_and(|index| was[index] == *animation && origin(index).is_some()) {
                continue;
            }
            let indices = &self.indices;
            let Some(written) = write_animation(&mut self.draft, animation, |id| indices.get(&id).copied())
            else {
                continue;
            };
            match index.and_then(origin) {
                Some(index) => self.change_animation(index, &written),
                None => drop(self.draft.push("animations", &written)),
            }
        }
        if !removed.is_empty() {
            let mut index = 0;
            self.draft.list_mut("animations").retain(|_| {
                index += 1;
                !removed.contains(&(index - 1))
            });
        }
    }

    fn change_animation(&mut self, index: usize, written: &RawObject) {
        let mut object = self.draft.object("animations", index);
        let channels = object.list("channels");
        let foreign = channels
            .iter()
            .filter(|channel| RawObject::parse(channel.get()).object("target").get("node").is_none());
        if foreign.count() > 0 {
            let what = "its channels that move something other than nodes".to_owned();
            self.losses.push(Loss { location: Location::Item("animation", index), what });
        }
        for name in ["name", "channels", "samplers"] {
            let text = written.get(name).map(|text| RawValue::from_string(text.to_owned()));
            let text = text.and_then(Result::ok);
            object.set_or_remove(name, text.as_ref());
        }
        self.draft.update("animations", index, &object);
    }
}

/// Where each animation was: the place of an equal one, else its own place if no other was there.
/// No two were at one place.
fn indices_of(was: &[Animation], now: &[Animation]) -> Vec<Option<usize>> {
    let mut indices: Vec<Option<usize>> =
        (0..now.len()).map(|index| (was.get(index) == Some(&now[index])).then_some(index)).collect();
    let mut taken: BTreeSet<usize> = indices.iter().flatten().copied().collect();
    for (index, found) in indices.iter_mut().enumerate().filter(|(_, found)| found.is_none()) {
        *found = (0..was.len()).find(|other| !taken.contains(other) && was[*other] == now[index]);
        taken.extend(*found);
    }
    for (index, found) in indices.iter_mut().enumerate().filter(|(_, found)| found.is_none()) {
        *found = Some(index).filter(|index| *index < was.len() && !taken.contains(index));
    }
    indices
}
