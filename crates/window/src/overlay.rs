//! Text over the image: lines in the corners, set by applications, and temporary messages.
//! `interface` draws them.

use std::time::Duration;

/// The position of text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Corner {
    /// Top left.
    TopLeft,
    /// Top centre.
    Top,
    /// Top right.
    TopRight,
    /// Bottom left; messages are written above it.
    BottomLeft,
    /// Bottom right.
    BottomRight,
}

impl Corner {
    /// All corners.
    pub const ALL: [Self; 5] =
        [Self::TopLeft, Self::Top, Self::TopRight, Self::BottomLeft, Self::BottomRight];
}

/// How long a message stays.
const MESSAGE_TIME: Duration = Duration::from_secs(3);

/// The maximum number of messages shown, the newest ones.
const MESSAGES: usize = 4;

#[derive(Debug, Clone)]
struct Message {
    text: String,
    /// Set when it is first shown.
    until: Option<Duration>,
}

/// The text over the image.
#[derive(Debug, Clone, Default)]
pub struct Overlay {
    lines: [Vec<String>; Corner::ALL.len()],
    messages: Vec<Message>,
}

impl Overlay {
    /// Writes these lines into a corner, replacing the previous ones.
    pub fn set(&mut self, corner: Corner, lines: impl IntoIterator<Item = impl Into<String>>) {
        self.lines[corner as usize] = lines.into_iter().map(Into::into).collect();
    }

    /// Empties a corner.
    pub fn clear(&mut self, corner: Corner) {
        self.lines[corner as usize].clear();
    }

    /// The lines in a corner.
    #[must_use]
    pub fn lines(&self, corner: Corner) -> &[String] {
        &self.lines[corner as usize]
    }

    /// Shows a message for a few seconds, in the lower left corner. The same
    /// message again starts over.
    pub fn notify(&mut self, text: impl Into<String>) {
        let text = text.into();
        self.messages.retain(|message| message.text != text);
        self.messages.push(Message { text, until: None });
        let extra = self.messages.len().saturating_sub(MESSAGES);
        self.messages.drain(..extra);
    }

    /// The current messages, oldest first. Starts the time of new ones and drops expired ones.
    pub(crate) fn messages(&mut self, now: Duration) -> Vec<String> {
        self.messages.retain(|message| message.until.is_none_or(|until| until > now));
        for message in &mut self.messages {
            message.until.get_or_insert(now + MESSAGE_TIME);
        }
        self.messages.iter().map(|message| message.text.clone()).collect()
    }

    /// When the next message expires.
    pub(crate) fn next_expiry(&self) -> Option<Duration> {
        self.messages.iter().filter_map(|message| message.until).min()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_end_after_their_time() {
        let mut overlay = Overlay::default();
        overlay.notify("first");
        assert_eq!(overlay.next_expiry(), None, "time counts from the first showing");
        let start = Duration::from_secs(100);
        assert_eq!(overlay.messages(start), ["first"], "shown");
        assert_eq!(overlay.next_expiry(), Some(start + MESSAGE_TIME), "and to be taken away");
        overlay.notify("second");
        overlay.messages(start + Duration::from_secs(1));
        assert_eq!(overlay.messages(start + MESSAGE_TIME), ["second"], "the first is over");
        assert!(overlay.messages(start + 2 * MESSAGE_TIME).is_empty(), "and so is the other");
        assert_eq!(overlay.next_expiry(), None, "nothing is left to wait for");
    }

    #[test]
    fn messages_do_not_pile_up() {
        let mut overlay = Overlay::default();
        (0..20).for_each(|n| overlay.notify(format!("message {n}")));
        overlay.notify("message 18");
        let shown = overlay.messages(Duration::ZERO);
        assert_eq!(shown, ["message 16", "message 17", "message 19", "message 18"], "the newest, each once");
    }
}
