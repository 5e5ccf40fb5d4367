//! Tables of bindings that can be read, searched and extended.

use std::borrow::Cow;

use super::action::{Action, ClickAction, DragAction};
use super::defaults;
use crate::input::{Chord, Modifiers, PointerButton};

/// The heading of keys that have none of their own.
const OTHER_SECTION: &str = "More";

/// A key and what it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Binding {
    /// Names the action for configuration and for [`crate::Handler::command`].
    pub name: Cow<'static, str>,
    /// What is pressed.
    pub chord: Chord,
    /// What it does.
    pub action: Action,
    /// What the cheat sheet says. Neighbours with the same text share a line.
    pub description: Cow<'static, str>,
    /// The heading of the cheat sheet that it stands under.
    pub section: Cow<'static, str>,
}

/// A drag and what it does.
#[derive(Debug, Clone, PartialEq)]
pub struct DragBinding {
    /// The button that is held.
    pub button: PointerButton,
    /// The modifiers that were down when it was pressed.
    pub modifiers: Modifiers,
    /// What it does.
    pub action: DragAction,
    /// What the cheat sheet says.
    pub description: Cow<'static, str>,
}

/// A click and what it does.
#[derive(Debug, Clone, PartialEq)]
pub struct ClickBinding {
    /// The button that is pressed and released.
    pub button: PointerButton,
    /// The modifiers that were down when it was pressed.
    pub modifiers: Modifiers,
    /// What it does.
    pub action: ClickAction,
    /// What the cheat sheet says.
    pub description: Cow<'static, str>,
}

/// An entry of the menu.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MenuEntry {
    /// Does what the binding of a name does.
    Command {
        /// The binding's name.
        name: &'static str,
        /// What the menu calls it.
        label: &'static str,
    },
    /// A line between others.
    Line,
}

/// All bindings of a window. The default ones follow F3D; those for objects
/// are on Alt, where F3D has none.
#[derive(Debug, Clone, PartialEq)]
pub struct Keymap {
    bindings: Vec<Binding>,
    drags: Vec<DragBinding>,
    clicks: Vec<ClickBinding>,
    menu: Vec<MenuEntry>,
}

impl Default for Keymap {
    fn default() -> Self {
        Self {
            bindings: defaults::bindings(),
            drags: defaults::drags(),
            clicks: defaults::clicks(),
            menu: defaults::menu(),
        }
    }
}

impl Keymap {
    /// No binding at all.
    #[must_use]
    pub fn empty() -> Self {
        Self { bindings: Vec::new(), drags: Vec::new(), clicks: Vec::new(), menu: Vec::new() }
    }

    /// Binds a key; whatever was on it is unbound.
    pub fn bind(
        &mut self,
        chord: impl Into<Chord>,
        name: impl Into<Cow<'static, str>>,
        action: Action,
        description: impl Into<Cow<'static, str>>,
    ) {
        let (name, chord, description) = (name.into(), chord.into(), description.into());
        self.add(Binding { name, chord, action, description, section: OTHER_SECTION.into() });
    }

    /// Binds a key as [`bind`](Self::bind) does, under a heading of its own choice. Headings stand in
    /// the order in which they first come up.
    pub fn add(&mut self, binding: Binding) {
        self.unbind(binding.chord);
        let section = |other: &Binding| other.section == binding.section;
        let index = self.bindings.iter().rposition(section).map_or(self.bindings.len(), |last| last + 1);
        self.bindings.insert(index, binding);
    }

    /// What the menu offers.
    pub fn set_menu(&mut self, entries: impl Into<Vec<MenuEntry>>) {
        self.menu = entries.into();
    }

    /// The entries of the menu with what they do; those that nothing is bound to are left out.
    pub fn menu(&self) -> impl Iterator<Item = (&MenuEntry, Option<&Binding>)> {
        let named = |name: &str| self.bindings.iter().find(|binding| binding.name == name);
        self.menu.iter().filter_map(move |entry| match entry {
            MenuEntry::Line => Some((entry, None)),
            MenuEntry::Command { name, .. } => named(name).map(|binding| (entry, Some(binding))),
        })
    }

    /// Frees a key.
    pub fn unbind(&mut self, chord: impl Into<Chord>) {
        let chord = chord.into();
        self.bindings.retain(|binding| binding.chord != chord);
    }

    /// Binds a drag; whatever was on it is unbound.
    pub fn bind_drag(&mut self, drag: DragBinding) {
        self.drags.retain(|other| (other.button, other.modifiers) != (drag.button, drag.modifiers));
        self.drags.push(drag);
    }

    /// Binds a click; whatever was on it is unbound.
    pub fn bind_click(&mut self, click: ClickBinding) {
        self.clicks.retain(|other| (other.button, other.modifiers) != (click.button, click.modifiers));
        self.clicks.push(click);
    }

    /// All keys, in the order of the cheat sheet.
    #[must_use]
    pub fn bindings(&self) -> &[Binding] {
        &self.bindings
    }

    /// All drags, in the order of the cheat sheet.
    #[must_use]
    pub fn drags(&self) -> &[DragBinding] {
        &self.drags
    }

    /// All clicks, in the order of the cheat sheet.
    #[must_use]
    pub fn clicks(&self) -> &[ClickBinding] {
        &self.clicks
    }

    /// What a key does.
    #[must_use]
    pub fn find(&self, chord: Chord) -> Option<&Binding> {
        self.bindings.iter().find(|binding| binding.chord == chord)
    }

    /// What a drag does.
    #[must_use]
    pub fn find_drag(&self, button: PointerButton, modifiers: Modifiers) -> Option<DragAction> {
        let drag = self.drags.iter().find(|drag| drag.button == button && drag.modifiers == modifiers);
        drag.map(|drag| drag.action)
    }

    /// What a click does: of the bindings whose modifiers are all held, the one with most of them.
    #[must_use]
    pub fn find_click(&self, button: PointerButton, modifiers: Modifiers) -> Option<ClickAction> {
        let possible =
            self.clicks.iter().filter(|click| click.button == button && modifiers.contains(click.modifiers));
        possible.max_by_key(|click| click.modifiers.count()).map(|click| click.action)
    }
}
