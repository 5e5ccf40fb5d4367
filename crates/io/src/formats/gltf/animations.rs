//! Animations: samplers become curves, and channels name the properties that they change.

use gltf::json::animation::{
    Channel as JsonChannel, Interpolation as JsonInterpolation, Property as JsonProperty,
};
use trigon_scene::{Animation, Channel, Curve, Interpolation, Property};

use super::accessor::{Accessors, valid};
use super::buffers::Unplaced;
use super::formats::AccessorReader;
use super::formats::{MORPH_WEIGHTS, ROTATIONS, TIMES, Usage, VECTORS};
use super::nodes::{Placed, ROTATION_TOLERANCE};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::warning::{Warnings, counted};

/// What helps against most of it.
const REMEDY: &str = "export the animation again";

/// Adds the animations that move something in the scene.
pub(crate) fn add_animations(
    import: &mut Import<'_>,
    reader: &mut AccessorReader<'_>,
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
        import.warnings.push(Location::Whole, what, "animate nodes or morph targets instead");
    }
    Ok(())
}

/// Reads an animation. Channels that make no sense are left out with a
/// warning, and those of nodes that the scene does not show without one; none
/// when nothing is left.
fn read_animation(
    accessors: &mut Accessors<'_>,
    placed: &Placed<'_>,
    index: usize,
    warnings: &mut Warnings,
) -> Result<Option<Animation>, Unplaced> {
    let from = &accessors.root.animations[index];
    let mut channels = Vec::new();
    for (number, channel) in from.channels.iter().enumerate() {
        let target = channel.target.node.value();
        let Some(node) = placed.ids[target] else { continue };
        let location = Location::Named(format!("animation {index}, channel {number}"));
        let width_of_weights = placed.target_counts[target];
        let why = match read_channel(accessors, index, channel, width_of_weights, &location, warnings) {
            Ok(Ok((property, curve))) => {
                channels.push(Channel { node, property, curve });
                continue;
            }
            Ok(Err(why)) => why,
            Err(Unplaced(location, unread)) if unread.kind == LoadErrorKind::Limit => {
                return Err(Unplaced(location, unread));
            }
            // The model can be shown without it.
            Err(Unplaced(location, unread)) => format!("{}{location}", unread.what),
        };
        warnings.push(location, format!("it is not played: {why}"), REMEDY);
    }
    let name = from.name.clone().unwrap_or_else(|| format!("animation {index}"));
    Ok((!channels.is_empty()).then_some(Animation { name, channels }))
}

type Played = Result<(Property, Curve), String>;

fn read_channel(
    accessors: &mut Accessors<'_>,
    animation: usize,
    channel: &JsonChannel,
    width_of_weights: usize,
    location: &Location,
    warnings: &mut Warnings,
) -> Result<Played, Unplaced> {
    let sampler = &accessors.root.animations[animation].samplers[channel.sampler.value()];
    let Some(interpolation) = valid(&sampler.interpolation).map(interpolation) else {
        return Ok(Err("its interpolation is unknown".to_owned()));
    };
    let Some(path) = valid(&channel.target.path) else {
        return Ok(Err("its path is unknown".to_owned()));
    };
    let (property, width, usage) = match path {
        JsonProperty::Translation => (Property::Translation, 3, VECTORS),
        JsonProperty::Rotation => (Property::Rotation, 4, ROTATIONS),
        JsonProperty::Scale => (Property::Scale, 3, VECTORS),
        JsonProperty::MorphTargetWeights => (Property::MorphWeights, width_of_weights, MORPH_WEIGHTS),
    };
    if width == 0 {
        return Ok(Err("the node's mesh has no morph targets".to_owned()));
    }
    let (input, output) = (sampler.input.value(), sampler.output.value());
    accessors.spend(accessors.count(input).saturating_add(accessors.count(output)) as usize, location)?;
    let times = accessors.vectors::<1>(input, TIMES.types)?.into_flattened();
    let values = match property {
        Property::Translation | Property::Scale => {
            accessors.vectors::<3>(output, usage.types)?.into_flattened()
        }
        Property::Rotation => accessors.vectors::<4>(output, usage.types)?.into_flattened(),
        Property::MorphWeights => accessors.vectors::<1>(output, usage.types)?.into_flattened(),
    };
    let broken = values.iter().filter(|value| !value.is_finite()).count();
    let curve = match new_curve(interpolation, width, times, values) {
        Ok(curve) => curve,
        Err(why) => return Ok(Err(why)),
    };
    warn_of_formats(accessors, [(input, TIMES), (output, usage)], location, warnings);
    warn_of_values(property, &curve, broken, location, warnings);
    Ok(Ok((property, curve)))
}

fn interpolation(from: JsonInterpolation) -> Interpolation {
    match from {
        JsonInterpolation::Linear => Interpolation::Linear,
        JsonInterpolation::Step => Interpolation::Step,
        JsonInterpolation::CubicSpline => Interpolation::CubicSpline,
    }
}

/// The curve, or why there is none.
fn new_curve(
    interpolation: Interpolation,
    width: usize,
    times: Vec<f32>,
    values: Vec<f32>,
) -> Result<Curve, String> {
    let (keys, numbers) = (times.len(), values.len());
    let increase =
        times.windows(2).all(|pair| pair[0] < pair[1]) && times.iter().all(|time| time.is_finite());
    Curve::new(interpolation, width, times, values).ok_or_else(|| {
        if !increase {
            return "its times must increase and be finite".to_owned();
        }
        let each = if interpolation == Interpolation::CubicSpline { 3 * width } else { width };
        let (keys, each) = (counted(keys, "keyframe"), counted(each, "number"));
        format!("it has {keys}, each of which needs {each}, and {} in all", counted(numbers, "number"))
    })
}

/// Says when an accessor holds what glTF does not allow there.
fn warn_of_formats(
    accessors: &mut Accessors<'_>,
    used: [(usize, Usage); 2],
    location: &Location,
    warnings: &mut Warnings,
) {
    for (accessor, usage) in used {
        accessors.doubt_stride(accessor);
        if let Some(what) = usage.fault(accessors.root, accessor) {
            warnings.push(location.clone(), what, REMEDY);
        }
    }
}

/// Says how many values of a curve are not what they must be. Those that were
/// not finite are 0 in the curve, so their number comes from before.
fn warn_of_values(
    property: Property,
    curve: &Curve,
    broken: usize,
    location: &Location,
    warnings: &mut Warnings,
) {
    let what = "a value of its curve is not finite and counts as 0";
    warnings.push_counted(broken, location.clone(), what, REMEDY);
    if property == Property::Rotation {
        let what = "a rotation of its curve is not a unit quaternion; it is normalized";
        warnings.push_counted(bent_rotations(curve), location.clone(), what, REMEDY);
    }
}

/// How many of the keyframes' quaternions are not of unit length.
fn bent_rotations(curve: &Curve) -> usize {
    let is_bent = |turn: &[f32; 4]| {
        let square: f64 = turn.iter().map(|&value| f64::from(value) * f64::from(value)).sum();
        (square.sqrt() - 1.0).abs() > ROTATION_TOLERANCE
    };
    // Of the three vectors of a spline's keyframe, the outer two are tangents.
    let (first, each) = if curve.interpolation() == Interpolation::CubicSpline { (1, 3) } else { (0, 1) };
    let (turns, _) = curve.values().as_chunks::<4>();
    turns.iter().skip(first).step_by(each).filter(|turn| is_bent(turn)).count()
}
