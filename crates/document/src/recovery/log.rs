//! The format of recovery files.
//!
//! Eight bytes `TRGNREC1`; then records: the length of the payload (eight bytes, little-endian), its
//! checksum (eight bytes), the payload. The payload of the first record is the document as
//! it was opened; those of the others are events as JSON.

use thiserror::Error;
use trigon_mesh::math::SplitMix64;

use crate::document::Event;

const MAGIC: &[u8; 8] = b"TRGNREC1";
/// Length and checksum.
const HEADER: usize = 16;

/// The contents of a recovery file.
#[derive(Debug, Clone, PartialEq)]
pub struct RecoveryLog {
    /// The document as it was opened: a native file.
    pub base: Vec<u8>,
    /// The events since.
    pub events: Vec<Event>,
    /// Whether the end of the file is damaged or incomplete: then the last action or actions are
    /// missing.
    pub is_cut_off: bool,
}

/// The file is not a recovery file, or nothing in it can be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error(
    "this is not a recovery file of this version, or its first record is damaged; open the saved file instead"
)]
pub struct UnreadableRecovery;

impl RecoveryLog {
    /// Reads the intact part of a recovery file.
    ///
    /// # Errors
    /// Not even the document as it was opened can be read.
    pub fn read(bytes: &[u8]) -> Result<Self, UnreadableRecovery> {
        let mut rest = bytes.strip_prefix(MAGIC).ok_or(UnreadableRecovery)?;
        let (base, tail) = split_record(rest).ok_or(UnreadableRecovery)?;
        rest = tail;
        let mut events = Vec::new();
        while let Some((payload, tail)) = split_record(rest) {
            let Ok(event) = serde_json::from_slice(payload) else { break };
            events.push(event);
            rest = tail;
        }
        Ok(Self { base: base.to_vec(), events, is_cut_off: !rest.is_empty() })
    }
}

/// The start of a recovery file.
pub(super) fn start(base: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(MAGIC.len() + HEADER + base.len());
    bytes.extend(MAGIC);
    append_record(&mut bytes, base);
    bytes
}

/// The record of an event.
pub(super) fn record(event: &Event) -> Vec<u8> {
    let mut bytes = Vec::new();
    append_record(&mut bytes, &serde_json::to_vec(event).expect("events have string keys"));
    bytes
}

fn append_record(bytes: &mut Vec<u8>, payload: &[u8]) {
    bytes.extend((payload.len() as u64).to_le_bytes());
    bytes.extend(checksum(payload).to_le_bytes());
    bytes.extend(payload);
}

/// The first record and the rest; none if it is incomplete.
fn split_record(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (length, rest) = bytes.split_first_chunk::<8>()?;
    let (sum, rest) = rest.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let (payload, rest) = rest.split_at_checked(length)?;
    (checksum(payload) == u64::from_le_bytes(*sum)).then_some((payload, rest))
}

/// Eight bytes at a time through the mixing function of SplitMix64. It detects damage, but does not prevent forgery.
fn checksum(bytes: &[u8]) -> u64 {
    let mut sum = SplitMix64::mix(bytes.len() as u64 ^ SplitMix64::INCREMENT);
    for chunk in bytes.chunks(8) {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        sum = SplitMix64::mix(sum.wrapping_add(SplitMix64::INCREMENT) ^ u64::from_le_bytes(word));
    }
    sum
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn file() -> (Vec<u8>, Vec<Event>) {
        let command = serde_json::from_str(r#"{ "op": "select_all" }"#).expect("a command");
        let events = vec![Event::Run(Box::new(command)), Event::Undo, Event::Redo, Event::Undo];
        let mut bytes = start(b"the document as it was opened");
        events.iter().for_each(|event| bytes.extend(record(event)));
        (bytes, events)
    }

    #[test]
    fn every_beginning_of_a_file_gives_the_first_events() {
        let (bytes, events) = file();
        assert_eq!(RecoveryLog::read(&bytes).expect("whole").events, events, "all of it");
        let mut counts = Vec::new();
        for length in 0..=bytes.len() {
            if let Ok(log) = RecoveryLog::read(&bytes[..length]) {
                assert_eq!(log.events, events[..log.events.len()], "the first ones");
                counts.push(log.events.len());
            }
        }
        assert!(counts.is_sorted() && counts.first() == Some(&0) && counts.last() == Some(&4), "{counts:?}");
    }

    #[test]
    fn the_checksum_of_nothing_is_the_first_number_of_splitmix64() {
        assert_eq!(checksum(b""), 0xe220_a839_7b1d_cdaf, "as published, for the seed 0");
    }

    proptest! {
        #[test]
        fn damage_costs_what_comes_after_it_and_nothing_else(index in any::<prop::sample::Index>(), change in 1u8..) {
            let (mut bytes, events) = file();
            let index = index.index(bytes.len());
            bytes[index] ^= change;
            if let Ok(log) = RecoveryLog::read(&bytes) {
                prop_assert_eq!(&log.events[..], &events[..log.events.len()]);
                prop_assert!(log.is_cut_off, "it is said");
            }
        }
    }
}
