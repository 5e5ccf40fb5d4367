//! Why an effect is on or off.

use std::fmt;

use crate::light::LightReading;

/// Whether an effect is on, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// It is on.
    On(Cause),
    /// It is off, and costs nothing.
    Off(Absence),
}

/// Why an effect is on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The settings request it.
    Requested,
    /// It is the background.
    Background,
    /// Lights of the scene shine on visible objects.
    Lights(usize),
    /// Visible objects are lit, and the scene does not define this light.
    Studio,
    /// A display could not show what the scene's lamps light.
    Metered(LightReading),
    /// Visible objects have it.
    Objects(Named),
    /// Visible objects are metal, and nothing defines their surroundings.
    Metals(Named),
    /// Visible objects transmit light.
    Glass {
        /// These objects.
        objects: Named,
        /// The maximum number of surfaces that a ray meets.
        bounces: u32,
    },
    /// The settings request it, and there are lamps and shadow casters.
    Shadows {
        /// The number of lights that shine.
        lamps: usize,
        /// The number of shadow casters.
        casters: usize,
    },
    /// So many of the lamps that cast shadows have an extent.
    Extent(usize),
}

/// Why an effect is off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Absence {
    /// The settings do not request it.
    NotRequested,
    /// Nothing in the scene has it.
    Nowhere,
    /// Only objects outside the view have it.
    OutOfView(Named),
    /// Objects have it in a way that nobody could see.
    Invisible(Invisible, Named),
    /// None of the scene's lights reaches what is drawn.
    IdleLamps {
        /// The number of lights without intensity, or of black colour.
        dark: usize,
        /// The number of those whose range or cone ends before any lit surface.
        out_of_reach: usize,
    },
    /// The settings turn all lights off.
    NoIntensity,
    /// No visible surface is lit.
    NothingLit,
    /// The settings request it, but no lamp shines.
    NoLamp,
    /// Nothing in view has ambient light that it could change.
    NoAmbientLight,
    /// No lamp that casts shadows has an extent.
    NoExtent,
    /// The settings request it, but there are no shadow casters.
    NoCaster,
    /// No metal is visible.
    NoMetal,
    /// The scene's own ambient light replaces it.
    OwnAmbientLight,
    /// The environment replaces it.
    Environment,
    /// The shading model does not include it.
    ShadingModel,
    /// No faces are drawn.
    NoFaces,
    /// The settings set the exposure.
    FixedExposure,
    /// No lamp of the scene shines.
    NoOwnLamp,
    /// No lamp reaches any face.
    Unreached,
    /// A display shows it as it is.
    InRange(LightReading),
    /// Colour is not an output.
    NoColor,
    /// Faces show something else than their materials in light.
    Display,
    /// A fisheye lens draws surfaces alone.
    FisheyeLens,
    /// The settings turn off the rays that show what is behind these visible objects.
    GlassNotRequested(Named),
    /// The settings light surfaces otherwise than per pixel by their own materials, which glass
    /// needs.
    GlassLitOtherwise(Named),
}

/// Why nobody could see an effect that objects have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Invisible {
    /// The objects multiply it by 0.
    Zero,
    /// The objects are unlit, and need none.
    Unlit,
    /// Neither the light nor the shading model shows anything of it.
    Light,
    /// Their vertex colours are white.
    White,
    /// Their alpha is nowhere below the mask's cutoff.
    NoHole,
    /// Their alpha is 1 everywhere.
    Opaque,
}

/// Some objects, one of them by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Named {
    /// Their number.
    pub count: usize,
    /// The name of the first.
    pub first: String,
}

impl Named {
    pub(super) fn add(&mut self, name: &str) {
        if self.count == 0 {
            name.clone_into(&mut self.first);
        }
        self.count += 1;
    }
}

impl fmt::Display for Decision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::On(cause) => write!(f, "on, because {cause}"),
            Self::Off(absence) => write!(f, "off, because {absence}"),
        }
    }
}

impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Requested => f.write_str("the settings request it"),
            Self::Background => f.write_str("it is the background"),
            Self::Lights(1) => f.write_str("one light shines on visible objects"),
            Self::Lights(count) => write!(f, "{count} lights shine on visible objects"),
            Self::Studio => f.write_str("the scene defines none, and lit surfaces are visible"),
            Self::Metered(reading) => write!(
                f,
                "a white surface in the light of the lamps would have {} times the display's white; they are exposed by {} stops",
                reading.white_text(),
                reading.stops
            ),
            Self::Objects(Named { count: 1, first }) => write!(f, "`{first}` has it"),
            Self::Objects(Named { count, first }) => write!(f, "{count} objects have it, such as `{first}`"),
            Self::Metals(Named { count: 1, first }) => {
                write!(f, "`{first}` is metal, and the scene has no environment")
            }
            Self::Metals(Named { count, first }) => {
                write!(
                    f,
                    "{count} objects in view are metal, such as `{first}`, and the scene has no environment"
                )
            }
            Self::Glass { objects, bounces } => write!(
                f,
                "{}: for each sample in front of it a ray that meets up to {bounces} surfaces; what is behind \
                 shows its matt colour, without highlights, and blended surfaces, lines and points are missing; rough glass \
                 spreads the rays of neighbouring samples",
                Self::Objects(objects.clone())
            ),
            Self::Shadows { lamps, casters } => {
                let plural = |count: usize| if count == 1 { "" } else { "s" };
                let (lights, objects) = (plural(*lamps), plural(*casters));
                write!(
                    f,
                    "the settings request it, and {lamps} light{lights} and {casters} shadow caster{objects} are present"
                )
            }
            Self::Extent(1) => f.write_str("one light that casts shadows has an extent"),
            Self::Extent(count) => write!(f, "{count} lights that cast shadows have an extent"),
        }
    }
}

impl fmt::Display for Absence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotRequested => f.write_str("the settings do not request it"),
            Self::Nowhere => f.write_str("nothing in the scene has it"),
            Self::OutOfView(Named { count: 1, first }) => {
                write!(f, "the only object that has it, `{first}`, is outside the view")
            }
            Self::OutOfView(Named { count, first }) => {
                write!(f, "the {count} objects that have it, such as `{first}`, are outside the view")
            }
            Self::Invisible(why, objects) => tell_invisible(f, *why, objects),
            Self::IdleLamps { dark, out_of_reach: 0 } => match dark {
                1 => f.write_str("the only light is dark (its intensity or colour is 0)"),
                count => write!(f, "all {count} lights are dark (their intensity or colour is 0)"),
            },
            Self::IdleLamps { dark: 0, out_of_reach } => match out_of_reach {
                1 => f.write_str(
                    "the only light reaches nothing that is visible (its range or cone ends before)",
                ),
                count => write!(
                    f,
                    "none of {count} lights reaches anything that is visible (their ranges or cones end before)"
                ),
            },
            Self::IdleLamps { dark, out_of_reach } => write!(
                f,
                "of {} lights {dark} are dark (their intensity or colour is 0), and the others reach nothing that is visible",
                dark + out_of_reach
            ),
            Self::NoIntensity => f.write_str("the settings multiply all light by 0"),
            Self::NothingLit => f.write_str("no visible surface is lit"),
            Self::NoLamp => f.write_str("no light casts shadows"),
            Self::NoExtent => f.write_str("no light that casts shadows has an extent"),
            Self::NoAmbientLight => f.write_str("there is no ambient light"),
            Self::NoCaster => f.write_str("no object casts shadows"),
            Self::NoMetal => f.write_str("no metal is visible"),
            Self::OwnAmbientLight => f.write_str("the scene has ambient light of its own"),
            Self::Environment => f.write_str("the environment takes its place"),
            Self::ShadingModel => f.write_str("the shading model does not include it"),
            Self::NoFaces => f.write_str("no faces are drawn"),
            Self::FixedExposure => f.write_str("the settings set the exposure"),
            Self::NoOwnLamp => f.write_str("no lamp of the scene shines"),
            Self::Unreached => f.write_str("no lamp reaches any face"),
            Self::InRange(reading) => write!(
                f,
                "a white surface in the light of the lamps has {} times the display's white",
                reading.white_text()
            ),
            Self::NoColor => f.write_str("colour is not an output"),
            Self::Display => f.write_str("the display mode leaves it out"),
            Self::FisheyeLens => f.write_str("a fisheye lens is drawn by rays, which meet surfaces alone"),
            Self::GlassNotRequested(objects) => {
                write!(f, "the settings turn it off: {}", Opaque(objects))
            }
            Self::GlassLitOtherwise(objects) => {
                let what = "it needs lighting per pixel and the materials' own reflection";
                write!(f, "{what}: {}", Opaque(objects))
            }
        }
    }
}

/// Glass that is drawn as if it were opaque.
struct Opaque<'a>(&'a Named);

impl fmt::Display for Opaque<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Named { count: 1, first } => write!(f, "`{first}` is glass, and is drawn as if it were opaque"),
            Named { count, first } => {
                write!(
                    f,
                    "{count} objects are glass, such as `{first}`, and are drawn as if they were opaque"
                )
            }
        }
    }
}

fn tell_invisible(f: &mut fmt::Formatter<'_>, why: Invisible, objects: &Named) -> fmt::Result {
    let Named { count, first } = objects;
    let (who, is_one) = match count {
        1 => (format!("the only object that has it, `{first}`,"), true),
        _ => (format!("the {count} objects that have it, such as `{first}`,"), false),
    };
    let what = match (why, is_one) {
        (Invisible::Zero, true) => "multiplies it by 0",
        (Invisible::Zero, false) => "multiply it by 0",
        (Invisible::Unlit, true) => "is unlit and needs none",
        (Invisible::Unlit, false) => "are unlit and need none",
        (Invisible::Light, true) => "shows nothing of it in this light",
        (Invisible::Light, false) => "show nothing of it in this light",
        (Invisible::White, true) => "has nothing but white",
        (Invisible::White, false) => "have nothing but white",
        (Invisible::NoHole, true) => "has no alpha below the cutoff",
        (Invisible::NoHole, false) => "have no alpha below the cutoff",
        (Invisible::Opaque, true) => "has an alpha of 1 everywhere",
        (Invisible::Opaque, false) => "have an alpha of 1 everywhere",
    };
    write!(f, "{who} {what}")
}
