//! Rows of numbers.

use crate::numbers::{first_number, number};
use crate::rows::Words;

/// The numbers of a row.
#[derive(Default)]
pub(super) struct Numbers {
    pub(super) values: Vec<f64>,
}

impl Numbers {
    pub(super) fn read(&mut self, line: &[u8]) -> Result<(), String> {
        self.values.clear();
        self.add(line)
    }

    /// Adds those of a line.
    pub(super) fn add(&mut self, line: &[u8]) -> Result<(), String> {
        let mut rest = line.trim_ascii_start();
        while !rest.is_empty() {
            let (value, length) = first_number(rest)?;
            self.values.push(value);
            rest = rest[length..].trim_ascii_start();
        }
        Ok(())
    }

    /// Adds so many, whatever lines they stand on, or those up to the end; how many that were.
    pub(super) fn read_on(&mut self, text: &mut Words<'_>, count: usize) -> Result<usize, String> {
        for read in 0..count {
            let Some(word) = text.next() else { return Ok(read) };
            self.values.push(number(word)?);
        }
        Ok(count)
    }

    /// A row of a face: how many vertices, these, and what else there is: a colour.
    pub(super) fn face(&self) -> Result<(&[f64], &[f64]), String> {
        let (&count, rest) = self.values.split_first().ok_or("is empty")?;
        // No row has as many numbers as an f64 could round.
        if count >= 0.0 && count.fract() == 0.0 && count <= rest.len() as f64 {
            return Ok(rest.split_at(count as usize));
        }
        Err(format!("claims {count} vertices and has {} numbers", rest.len()))
    }
}
