//! Skins and animations: what is in the file stays there, and the rest is written.

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;
use serde_json::json;
use serde_json::value::RawValue;
use trigon_math::DAffine3;
use trigon_scene::{Animation, Channel, Curve, Interpolation, NodeId, Property, Skin};

use super::draft::{Bounded, Draft};
use super::raw::RawObject;
use super::scene::SceneWriter;
use crate::error::Location;
use crate::export::Loss;

/// Changes the object of a skin to another skin. `joint` returns the index of a node.
pub(super) fn write_skin(
    draft: &mut Draft<'_>,
    object: &mut RawObject,
    skin: &Skin,
    joint: impl Fn(NodeId) -> usize,
) {
    if !skin.name.is_empty() {
        object.set("name", &skin.name);
    }
    let joints: Vec<usize> = skin.joints.iter().map(|&id| joint(id)).collect();
    object.set("joints", &joints);
    object.remove("inverseBindMatrices");
    if !skin.inverse_bind_matrices.is_empty() {
        let given = skin.inverse_bind_matrices.iter().chain(std::iter::repeat(&DAffine3::IDENTITY));
        let matrices: Vec<[f32; 16]> = given.take(joints.len()).map(columns).collect();
        object.set("inverseBindMatrices", &draft.floats(&matrices, None, Bounded::No));
    }
}

/// Four columns of four, the last row 0 0 0 1.
fn columns(map: &DAffine3) -> [f32; 16] {
    let [x, y, z, w] = [map.matrix3.x_axis, map.matrix3.y_axis, map.matrix3.z_axis, map.translation]
        .map(|column| column.to_array().map(|number| if number.is_finite() { number as f32 } else { 0.0 }));
    [x[0], x[1], x[2], 0.0, y[0], y[1], y[2], 0.0, z[0], z[1], z[2], 0.0, w[0], w[1], w[2], 1.0]
}

#[derive(Serialize)]
struct Sampler {
    input: usize,
    output: usize,
    interpolation: &'static str,
}

/// An animation of the nodes that `node` knows; `None` if it moves none of them.
pub(super) fn write_animation(
    draft: &mut Draft<'_>,
    animation: &Animation,
    node: impl Fn(NodeId) -> Option<usize>,
) -> Option<RawObject> {
    // Of several channels for one property the last counts.
    let mut last: BTreeMap<(usize, Property), &Channel> = BTreeMap::new();
    for channel in &animation.channels {
        if let Some(node) = node(channel.node) {
            last.insert((node, channel.property), channel);
        }
    }
    if last.is_empty() {
        return None;
    }
    let (mut times, mut samplers, mut channels) = (BTreeMap::new(), Vec::new(), Vec::new());
    for ((node, property), channel) in last {
        let input = input_of(draft, &mut times, &channel.curve);
        let output = write_values(draft, property, &channel.curve);
        let interpolation = match channel.curve.interpolation() {
            Interpolation::Step => "STEP",
            Interpolation::Linear => "LINEAR",
            Interpolation::CubicSpline => "CUBICSPLINE",
        };
        let path = match property {
            Property::Translation => "translation",
            Property::Rotation => "rotation",
            Property::Scale => "scale",
            Property::MorphWeights => "weights",
        };
        channels.push(json!({"sampler": samplers.len(), "target": {"node": node, "path": path}}));
        samplers.push(Sampler { input, output, interpolation });
    }
    let mut object = RawObject::default();
    if !animation.name.is_empty() {
        object.set("name", &animation.name);
    }
    object.set("channels", &channels);
    object.set("samplers", &samplers);
    Some(object)
}

/// The accessor of a curve's times; curves with the same times share one.
fn input_of(draft: &mut Draft<'_>, known: &mut BTreeMap<Vec<u32>, usize>, curve: &Curve) -> usize {
    let bits: Vec<u32> = curve.times().iter().map(|time| time.to_bits()).collect();
    let times: Vec<[f32; 1]> = curve.times().iter().map(|&time| [time]).collect();
    *known.entry(bits).or_insert_with(|| draft.floats(&times, None, Bounded::Yes))
}

fn write_values(draft: &mut Draft<'_>, property: Property, curve: &Curve) -> usize {
    match property {
        Property::Rotation => draft.floats(curve.values().as_chunks::<4>().0, None, Bounded::No),
        Property::Translation | Property::Scale => {
            draft.floats(curve.values().as_chunks::<3>().0, None, Bounded::No)
        }
        Property::MorphWeights => draft.floats(curve.values().as_chunks::<1>().0, None, Bounded::No),
    }
}

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
