//! Why an effect is on or off.

use std::fmt;

/// Whether an effect is on, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// It is simulated.
    On(Cause),
    /// It is not, and costs nothing.
    Off(Absence),
}

/// Why an effect is on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cause {
    /// The settings ask for it.
    Asked,
    /// It is the background.
    Background,
    /// Lights of the scene shine on what is in view.
    Lights(usize),
    /// What is in view is lit, and the scene has no such light of its own.
    Studio,
    /// Objects in view have it.
    Objects(Named),
    /// Objects in view are metal, and nothing says what is around them.
    Metals(Named),
    /// The settings ask for it, and lamps meet what casts shadows.
    Shadows {
        /// Lights that shine.
        lamps: usize,
        /// Objects that are in their way.
        casters: usize,
    },
}

/// Why an effect is off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Absence {
    /// The settings ask for none.
    NotAsked,
    /// Nothing in the scene has it.
    Nowhere,
    /// What has it is outside the view.
    OutOfView(Named),
    /// Nothing in view is lit.
    NothingLit,
    /// The settings ask for it, but no lamp shines.
    NoLamp,
    /// The settings ask for it, but there is no ambient light.
    NoAmbientLight,
    /// The settings ask for it, but no object casts shadows.
    NoCaster,
    /// No metal is in view.
    NoMetal,
    /// Ambient light of the scene's own takes its place.
    OwnAmbientLight,
    /// The environment takes its place.
    Environment,
    /// The shading model leaves it out.
    ShadingModel,
    /// No faces are drawn.
    NoFaces,
    /// The picture is to hold no colours.
    NoColor,
}

/// Some objects, one of them by its name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Named {
    /// How many there are.
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
            Self::Asked => f.write_str("the settings request it"),
            Self::Background => f.write_str("it is the background"),
            Self::Lights(1) => f.write_str("one light shines on visible objects"),
            Self::Lights(count) => write!(f, "{count} lights shine on visible objects"),
            Self::Studio => f.write_str("the scene defines none, and lit surfaces are visible"),
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
            Self::Shadows { lamps, casters } => {
                let plural = |count: usize| if count == 1 { "" } else { "s" };
                let (lights, objects) = (plural(*lamps), plural(*casters));
                write!(
                    f,
                    "the settings request it, and {lamps} light{lights} and {casters} shadow caster{objects} are present"
                )
            }
        }
    }
}

impl fmt::Display for Absence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAsked => f.write_str("the settings do not request it"),
            Self::Nowhere => f.write_str("nothing in the scene has it"),
            Self::OutOfView(Named { count: 1, first }) => {
                write!(f, "the only object that has it, `{first}`, is outside the view")
            }
            Self::OutOfView(Named { count, first }) => {
                write!(f, "the {count} objects that have it, such as `{first}`, are outside the view")
            }
            Self::NothingLit => f.write_str("no visible surface is lit"),
            Self::NoLamp => f.write_str("no light casts shadows"),
            Self::NoAmbientLight => f.write_str("there is no ambient light"),
            Self::NoCaster => f.write_str("no object casts shadows"),
            Self::NoMetal => f.write_str("no metal is visible"),
            Self::OwnAmbientLight => f.write_str("the scene has ambient light of its own"),
            Self::Environment => f.write_str("the environment takes its place"),
            Self::ShadingModel => f.write_str("the shading model does not include it"),
            Self::NoFaces => f.write_str("no faces are drawn"),
            Self::NoColor => f.write_str("colour is not an output"),
        }
    }
}
