//! Animations: samplers become curves, channels say what they move.

use gltf::json::accessor::Type;
use gltf::json::animation::{
    Channel as JsonChannel, Interpolation as JsonInterpolation, Property as JsonProperty,
};
use trigon_scene::{Animation, Channel, Curve, Interpolation, Property};

use super::accessor::{Accessors, valid};
use super::buffers::Unplaced;
use super::nodes::Placed;
use super::reader::Reader;
use crate::error::{LoadError, LoadErrorKind, Place};
use crate::import::Import;
use crate::warning::{Warnings, counted};

/// Adds the animations that move something in the scene.
pub(crate) fn add_animations(
    import: &mut Import<'_>,
    reader: &mut Reader<'_, '_>,
    placed: &Placed<'_>,
) -> Result<(), LoadError> {
    for index in 0..reader.root.animations.len() {
        let animation =
            reader.read(import, |accessors, warnings| read_animation(accessors, placed, index, warnings))?;
        if animation.is_some()
            && let Some(source) = &mut import.source
        {
            source.note_animation(index);
        }
        import.scene.animations.extend(animation);
    }
    if placed.document.foreign_channels > 0 {
        let what = counted(placed.document.foreign_channels, "animation channel");
        let what = format!("{what} of something other than nodes left out");
        import.warnings.push(Place::Whole, what, "animate nodes or morph targets instead");
    }
    Ok(())
}

/// Reads an animation. Channels that make no sense are left out with a
/// warning, and those of nodes that the scene does not show without one; none
/// when nothing is left.
fn read_animation(
    accessors: &mut Accessors<'_, '_>,
    placed: &Placed<'_>,
    index: usize,
    warnings: &mut Warnings,
) -> Result<Option<Animation>, Unplaced> {
    let from = &accessors.root.animations[index];
    let mut channels = Vec::new();
    for (number, channel) in from.channels.iter().enumerate() {
        let target = channel.target.node.value();
        let Some(node) = placed.ids[target] else { continue };
        let place = Place::Named(format!("animation {index}, channel {number}"));
        let width_of_weights = placed.target_counts[target];
        let why = match read_channel(accessors, index, channel, width_of_weights, &place) {
            Ok(Ok((property, curve))) => {
                channels.push(Channel { node, property, curve });
                continue;
            }
            Ok(Err(why)) => why,
            Err(Unplaced(place, unread)) if unread.kind == LoadErrorKind::Limit => {
                return Err(Unplaced(place, unread));
            }
            // The model can be shown without it.
            Err(Unplaced(place, unread)) => format!("{}{place}", unread.what),
        };
        warnings.push(place, format!("it is not played: {why}"), "export the animation again");
    }
    let name = from.name.clone().unwrap_or_else(|| format!("animation {index}"));
    Ok((!channels.is_empty()).then_some(Animation { name, channels }))
}

type Played = Result<(Property, Curve), String>;

fn read_channel(
    accessors: &mut Accessors<'_, '_>,
    animation: usize,
    channel: &JsonChannel,
    width_of_weights: usize,
    place: &Place,
) -> Result<Played, Unplaced> {
    let sampler = &accessors.root.animations[animation].samplers[channel.sampler.value()];
    let interpolation = match valid(&sampler.interpolation) {
        Some(JsonInterpolation::Linear) => Interpolation::Linear,
        Some(JsonInterpolation::Step) => Interpolation::Step,
        Some(JsonInterpolation::CubicSpline) => Interpolation::CubicSpline,
        None => return Ok(Err("its interpolation is unknown".to_owned())),
    };
    let (property, width) = match valid(&channel.target.path) {
        Some(JsonProperty::Translation) => (Property::Translation, 3),
        Some(JsonProperty::Rotation) => (Property::Rotation, 4),
        Some(JsonProperty::Scale) => (Property::Scale, 3),
        Some(JsonProperty::MorphTargetWeights) => (Property::MorphWeights, width_of_weights),
        None => return Ok(Err("its path is unknown".to_owned())),
    };
    if width == 0 {
        return Ok(Err("the node's mesh has no morph targets".to_owned()));
    }
    let (input, output) = (sampler.input.value(), sampler.output.value());
    accessors.spend(accessors.count(input).saturating_add(accessors.count(output)) as usize, place)?;
    let times = accessors.vectors::<1>(input, &[Type::Scalar])?.into_flattened();
    let values = match property {
        Property::Translation | Property::Scale => {
            accessors.vectors::<3>(output, &[Type::Vec3])?.into_flattened()
        }
        Property::Rotation => accessors.vectors::<4>(output, &[Type::Vec4])?.into_flattened(),
        Property::MorphWeights => accessors.vectors::<1>(output, &[Type::Scalar])?.into_flattened(),
    };
    let (keys, numbers) = (times.len(), values.len());
    let curve = Curve::new(interpolation, width, times, values);
    Ok(curve.map(|curve| (property, curve)).ok_or_else(|| {
        format!("{keys} times that must increase and {numbers} numbers make no {interpolation:?} curve of {width} each")
    }))
}
