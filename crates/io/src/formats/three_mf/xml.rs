//! The elements of a part, one after the other, with their namespaces. No document type is accepted, so that no entity
//! can be defined: what is unpacked is what is read.

use std::path::Path;

use quick_xml::XmlVersion;
use quick_xml::events::attributes::{AttrError, Attribute, Attributes};
use quick_xml::events::{BytesStart, Event};
use quick_xml::name::{Namespace, QName, ResolveResult};
use quick_xml::reader::NsReader;

use super::namespaces::{CORE, MATERIAL, PRODUCTION};
use crate::error::{LoadError, Location};

/// The namespace of a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Space {
    /// None, or that of the core specification.
    Core,
    Material,
    Production,
    /// One that is not read.
    Foreign,
}

impl Space {
    fn of(resolved: &ResolveResult<'_>) -> Self {
        match resolved {
            ResolveResult::Unbound => Self::Core,
            ResolveResult::Bound(Namespace(name)) if *name == CORE.as_bytes() => Self::Core,
            ResolveResult::Bound(Namespace(name)) if *name == MATERIAL.as_bytes() => Self::Material,
            ResolveResult::Bound(Namespace(name)) if *name == PRODUCTION.as_bytes() => Self::Production,
            _ => Self::Foreign,
        }
    }
}

/// What comes next.
pub(super) enum Step<'a> {
    /// An element begins.
    Start(XmlElement<'a>),
    /// An element with contents ends. One without has no end.
    End,
}

/// The start of an element.
pub(super) struct XmlElement<'a> {
    pub(super) space: Space,
    start: BytesStart<'a>,
    pub(super) is_empty: bool,
}

impl XmlElement<'_> {
    /// Without its prefix.
    pub(super) fn name(&self) -> &[u8] {
        self.start.local_name().into_inner()
    }

    pub(super) fn attributes(&self) -> Attributes<'_> {
        let mut attributes = self.start.attributes();
        // That no name occurs twice takes longer to check than everything else.
        attributes.with_checks(false);
        attributes
    }
}

/// A part while it is read.
pub(super) struct Xml<'a> {
    reader: NsReader<&'a [u8]>,
    text: &'a [u8],
    file: &'a Path,
    part: &'a str,
    /// How many elements with contents have begun and not ended.
    depth: usize,
}

impl<'a> Xml<'a> {
    pub(super) fn new(file: &'a Path, part: &'a str, text: &'a [u8]) -> Self {
        Self { reader: NsReader::from_reader(text), text, file, part, depth: 0 }
    }

    /// The next start or end of an element; none at the end of the part.
    pub(super) fn step(&mut self) -> Result<Option<Step<'a>>, LoadError> {
        loop {
            let (space, event) = match self.reader.read_resolved_event() {
                Ok((resolved, event)) => (Space::of(&resolved), event),
                Err(error) => return Err(self.fault(error.to_string())),
            };
            match event {
                Event::Start(start) => {
                    self.depth += 1;
                    return Ok(Some(Step::Start(XmlElement { space, start, is_empty: false })));
                }
                Event::Empty(start) => {
                    return Ok(Some(Step::Start(XmlElement { space, start, is_empty: true })));
                }
                Event::End(_) => {
                    self.depth -= 1;
                    return Ok(Some(Step::End));
                }
                Event::Eof if self.depth > 0 => return Err(self.fault("the part ends within an element")),
                Event::Eof => return Ok(None),
                Event::DocType(_) => return Err(self.fault("it has a document type, which 3MF forbids")),
                _ => {}
            }
        }
    }

    /// Goes past the contents and the end of an element.
    pub(super) fn pass(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        if element.is_empty {
            return Ok(());
        }
        self.depth -= 1;
        let passed = self.reader.read_to_end(element.start.to_end().name());
        passed.map(drop).map_err(|error| self.fault(error.to_string()))
    }

    /// An attribute that is written as XML wants it.
    pub(super) fn checked<'b>(
        &self,
        attribute: Result<Attribute<'b>, AttrError>,
    ) -> Result<Attribute<'b>, LoadError> {
        attribute.map_err(|error| self.fault(error.to_string()))
    }

    /// The value of an attribute as text.
    pub(super) fn text(&self, attribute: &Attribute<'_>) -> Result<String, LoadError> {
        let value = attribute.normalized_value(XmlVersion::Implicit1_0);
        value.map(|value| value.into_owned()).map_err(|error| self.fault(error.to_string()))
    }

    /// The namespace of an attribute.
    pub(super) fn space_of(&self, attribute: &Attribute<'_>) -> Space {
        Space::of(&self.reader.resolver().resolve_attribute(attribute.key).0)
    }

    /// The address that a name of an element or an attribute stands for, by its prefix; empty if there is none.
    pub(super) fn address_of(&self, name: &[u8]) -> String {
        match self.reader.resolver().resolve_element(QName(name)).0 {
            ResolveResult::Bound(Namespace(address)) => String::from_utf8_lossy(address).into_owned(),
            _ => String::new(),
        }
    }

    /// The address of an element's namespace.
    pub(super) fn address(&self, element: &XmlElement<'_>) -> String {
        self.address_of(element.start.name().into_inner())
    }

    /// The line that is being read.
    pub(super) fn location(&self) -> Location {
        let at = (self.reader.buffer_position() as usize).min(self.text.len());
        let line = 1 + memchr::memchr_iter(b'\n', &self.text[..at]).count();
        Location::Named(format!("{}, line {line}", self.part))
    }

    /// How much of the part was read, 0 to 1.
    pub(super) fn progress(&self) -> f32 {
        self.reader.buffer_position() as f32 / self.text.len().max(1) as f32
    }

    /// The error of something wrong where the reader is.
    pub(super) fn fault(&self, what: impl Into<String>) -> LoadError {
        LoadError::malformed(self.file, what, "export the model again").at(self.location())
    }
}
