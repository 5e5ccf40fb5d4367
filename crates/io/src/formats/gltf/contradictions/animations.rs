//! Channels that contradict each other, or the node that they move.

use std::collections::HashSet;

use gltf::json::Animation;
use gltf::json::animation::{Channel, Property};

use super::remedy::REMEDY;
use crate::error::Location;
use crate::formats::gltf::accessor::valid;
use crate::formats::gltf::document::Document;
use crate::formats::gltf::hierarchy::Hierarchy;
use crate::warning::Warnings;

pub(super) fn warn_of_animations(document: &Document, hierarchy: &Hierarchy, warnings: &mut Warnings) {
    for (index, animation) in document.root.animations.iter().enumerate() {
        warn_of_animation(document, hierarchy, animation, index, warnings);
    }
}

fn warn_of_animation(
    document: &Document,
    hierarchy: &Hierarchy,
    animation: &Animation,
    index: usize,
    warnings: &mut Warnings,
) {
    let mut moved = HashSet::new();
    for (number, channel) in animation.channels.iter().enumerate() {
        let node = channel.target.node.value();
        let Some(property) = valid(&channel.target.path).filter(|_| hierarchy.included[node]) else {
            continue;
        };
        let location = || Location::Named(format!("animation {index}, channel {number}"));
        if !moved.insert((node, property as u8)) {
            let what = "an earlier channel moves the same property of the same node; the last one counts";
            warnings.push(location(), what, "remove one of them, or export the animation again");
        }
        if moves_a_matrix(document, channel) {
            let what =
                "its node has a matrix, which is split into translation, rotation and scale; shear is lost";
            warnings.push(location(), what, REMEDY);
        }
    }
}

fn moves_a_matrix(document: &Document, channel: &Channel) -> bool {
    let transform = document.transforms.get(channel.target.node.value());
    transform.is_some_and(|transform| transform.matrix.is_some())
        && valid(&channel.target.path) != Some(Property::MorphTargetWeights)
}
