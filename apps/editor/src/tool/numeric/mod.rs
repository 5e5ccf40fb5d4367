//! Numbers typed while a tool runs, as in Blender: `G 2 Enter`.
//!
//! Digits and `.` extend the number, `-` negates all of it, `/` takes its reciprocal, Tab goes to the next
//! component, and Backspace removes a character, then the signs, then the whole entry. `=` starts an
//! expression, in which everything typed is text; Ctrl+`=` ends it.

#[cfg(test)]
mod tests;

use trigon_window::{Key, Modifiers};

use super::expression::{ExpressionError, Quantity, evaluate};

/// The text typed so far.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NumericEntry {
    quantity: Quantity,
    components: Vec<Component>,
    current: usize,
    /// Whether anything was typed: numbers count instead of the pointer.
    active: bool,
}

#[derive(Debug, Clone, PartialEq, Default)]
struct Component {
    text: String,
    negated: bool,
    reciprocal: bool,
    is_expression: bool,
}

/// What a typed text at most has of characters: more than anybody types, and quick to read again at each
/// key.
const MOST_CHARACTERS: usize = 200;

impl NumericEntry {
    /// Nothing typed yet; `count` components are expected.
    pub(crate) fn new(quantity: Quantity, count: usize) -> Self {
        Self { quantity, components: vec![Component::default(); count.max(1)], current: 0, active: false }
    }

    /// Whether numbers count instead of the pointer.
    pub(crate) fn is_active(&self) -> bool {
        self.active
    }

    /// What the numbers stand for.
    pub(crate) fn quantity(&self) -> Quantity {
        self.quantity
    }

    /// Asks for another number of components; what was typed into those that stay is kept.
    pub(crate) fn set_count(&mut self, count: usize) {
        self.components.resize(count.max(1), Component::default());
        self.current = self.current.min(self.components.len() - 1);
    }

    /// Takes a key. Whether it was one of the entry; others are the tool's. Keys come
    /// without what Shift makes of them, so symbols are found as on a US keyboard.
    pub(crate) fn key(&mut self, key: Key, modifiers: Modifiers) -> bool {
        let control = modifiers.contains(Modifiers::CTRL);
        match key {
            Key::Character('=') if control && self.is_expression() => {
                self.component().is_expression = false;
                true
            }
            _ if control || modifiers.contains(Modifiers::ALT) => false,
            Key::Character(character) => self.character(typed(character, modifiers)),
            Key::Space if self.is_expression() => self.character(' '),
            Key::Tab if self.active => {
                self.next(modifiers.contains(Modifiers::SHIFT));
                true
            }
            Key::Backspace if self.active => {
                self.backspace();
                true
            }
            _ => false,
        }
    }

    fn is_expression(&self) -> bool {
        self.active && self.components[self.current].is_expression
    }

    fn component(&mut self) -> &mut Component {
        &mut self.components[self.current]
    }

    /// Takes a character that was typed.
    pub(crate) fn character(&mut self, character: char) -> bool {
        if self.is_expression() {
            let component = self.component();
            if component.text.chars().count() < MOST_CHARACTERS && !character.is_control() {
                component.text.push(character);
            }
            return true;
        }
        match character {
            '0'..='9' => self.digit(character),
            '.' | ',' => self.digit('.'),
            '-' => self.component().negated ^= true,
            '/' if self.active => self.component().reciprocal ^= true,
            '=' | '*' => self.start_expression(),
            _ => return false,
        }
        self.active = true;
        true
    }

    fn digit(&mut self, character: char) {
        let text = &mut self.component().text;
        let is_second_point = character == '.' && text.contains('.');
        if text.len() < MOST_CHARACTERS && !is_second_point {
            text.push(character);
        }
    }

    /// The text typed so far is kept as an expression.
    fn start_expression(&mut self) {
        let component = self.component();
        component.text = component.written();
        *component = Component { text: component.text.clone(), is_expression: true, ..Component::default() };
    }

    fn next(&mut self, backwards: bool) {
        let count = self.components.len();
        self.current = (self.current + if backwards { count - 1 } else { 1 }) % count;
    }

    fn backspace(&mut self) {
        let component = self.component();
        if component.text.pop().is_some() {
            return;
        }
        if *component == Component::default() {
            *self = Self::new(self.quantity, self.components.len());
        } else {
            *component = Component::default();
        }
    }

    /// The values, in metres or degrees: `None` for components into which nothing was typed.
    ///
    /// # Errors
    /// What was typed into one of them is no number yet.
    pub(crate) fn values(&self) -> Result<Vec<Option<f64>>, ExpressionError> {
        self.components.iter().map(|component| component.value(self.quantity)).collect()
    }

    /// One value for each expected component; `missing` for those without text. `None` if the pointer
    /// decides.
    ///
    /// # Errors
    /// As [`Self::values`].
    pub(crate) fn value_or(&self, missing: f64) -> Result<Option<f64>, ExpressionError> {
        if !self.active {
            return Ok(None);
        }
        Ok(Some(self.values()?[0].unwrap_or(missing)))
    }

    /// For the status line: as `[-2.5] m`, with the component that is being typed in brackets.
    pub(crate) fn status(&self) -> String {
        let shown = self.components.iter().enumerate().map(|(index, component)| {
            let text = component.written();
            let text = if text.is_empty() { "–".to_owned() } else { text };
            if index == self.current { format!("[{text}]") } else { text }
        });
        let all = shown.collect::<Vec<_>>().join(", ");
        match self.values() {
            Ok(_) => format!("{all}{}", self.quantity.unit()),
            Err(error) => format!("{all}: {error}"),
        }
    }
}

impl Component {
    fn value(&self, quantity: Quantity) -> Result<Option<f64>, ExpressionError> {
        if self.text.is_empty() {
            return Ok(None);
        }
        // A point alone is the beginning of a number.
        let value = if self.text == "." { 0.0 } else { evaluate(&self.text, quantity)? };
        let value = if self.reciprocal { 1.0 / value } else { value };
        if !value.is_finite() {
            return Err(ExpressionError { index: 1, what: "zero has no reciprocal".into() });
        }
        Ok(Some(if self.negated { -value } else { value }))
    }

    /// As a text that can be evaluated.
    fn written(&self) -> String {
        let text = if self.reciprocal { format!("1/{}", self.text) } else { self.text.clone() };
        if self.negated { format!("-{text}") } else { text }
    }
}

/// What a key types on a US keyboard.
fn typed(character: char, modifiers: Modifiers) -> char {
    if !modifiers.contains(Modifiers::SHIFT) {
        return character;
    }
    match character {
        '=' => '+',
        '8' => '*',
        '9' => '(',
        '0' => ')',
        '6' => '^',
        other => other,
    }
}
