//! Everyday words in the names that a crate defines, where an exact word exists, and names that two of its types share.

use crate::collect::is_for_tests;
use crate::module::Crate;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use syn::visit::{self, Visit};
use syn::{Attribute, Block, Field, File, Ident, ImplItemFn, Item, PatIdent, Signature, Variant};

/// Words that no identifier contains, with what to write instead. `place` may begin an identifier of several
/// words, where it is a verb: `place_nodes`.
const GLOSSARY: [(&str, &str); 8] = [
    ("asked", "requested"),
    ("centre", "center"),
    ("kept", "cached, retained or held"),
    ("place", "index, position, vertex, pixel or slot"),
    ("places", "indices, positions, vertices, pixels or slots"),
    ("room", "capacity, margin or free width"),
    ("seen", "visible, visited or known"),
    ("told", "reported"),
];

/// What is wrong with the names that a crate defines, tests left out.
#[derive(Debug, Default)]
pub struct NameFaults {
    /// Words of the glossary, as `file.rs: name: write …`.
    pub words: Vec<String>,
    /// Names of several types, as `Name: 2 types`. Types of one name in one file are variants of a type for
    /// different systems, and count once.
    pub shared_types: Vec<String>,
}

impl NameFaults {
    /// Reads the files of a crate.
    ///
    /// # Errors
    /// A file that cannot be read or parsed.
    pub fn of(of: &Crate) -> io::Result<Self> {
        let (mut faults, mut types) = (Self::default(), BTreeMap::<String, usize>::new());
        for path in &of.files {
            let invalid =
                |error| io::Error::new(io::ErrorKind::InvalidData, format!("{}: {error}", path.display()));
            let file = syn::parse_file(&fs::read_to_string(of.root.join(path))?).map_err(invalid)?;
            let names = Names::of(&file);
            faults.words.extend(names.violations().map(|fault| format!("{}: {fault}", path.display())));
            names.types.into_iter().for_each(|name| *types.entry(name).or_default() += 1);
        }
        let shared = types.into_iter().filter(|&(_, count)| count > 1);
        faults.shared_types = shared.map(|(name, count)| format!("{name}: {count} types")).collect();
        Ok(faults)
    }
}

/// The names that a file defines, tests left out. Names that a macro defines are not read.
#[derive(Default)]
struct Names {
    identifiers: BTreeSet<String>,
    types: BTreeSet<String>,
}

impl Names {
    fn add(&mut self, name: &Ident) {
        self.identifiers.insert(name.to_string());
    }

    fn of(file: &File) -> Self {
        let mut names = Self::default();
        names.visit_file(file);
        names
    }

    fn violations(&self) -> impl Iterator<Item = String> {
        self.identifiers.iter().filter_map(|name| Some(format!("{name}: write {}", instead(name)?)))
    }
}

impl Visit<'_> for Names {
    fn visit_item(&mut self, item: &Item) {
        let (attributes, name): (&[Attribute], Option<&Ident>) = match item {
            Item::Struct(item) => (&item.attrs, Some(&item.ident)),
            Item::Enum(item) => (&item.attrs, Some(&item.ident)),
            Item::Type(item) => (&item.attrs, Some(&item.ident)),
            Item::Trait(item) => (&item.attrs, Some(&item.ident)),
            Item::Mod(item) => (&item.attrs, Some(&item.ident)),
            Item::Const(item) => (&item.attrs, Some(&item.ident)),
            Item::Static(item) => (&item.attrs, Some(&item.ident)),
            Item::Fn(item) => (&item.attrs, None),
            Item::Impl(item) => (&item.attrs, None),
            _ => (&[], None),
        };
        if is_for_tests(attributes) {
            return;
        }
        name.into_iter().for_each(|name| self.add(name));
        if matches!(item, Item::Struct(_) | Item::Enum(_) | Item::Type(_) | Item::Trait(_)) {
            self.types.extend(name.map(Ident::to_string));
        }
        visit::visit_item(self, item);
    }

    fn visit_impl_item_fn(&mut self, item: &ImplItemFn) {
        if !is_for_tests(&item.attrs) {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_block(&mut self, block: &Block) {
        let types = self.types.clone();
        visit::visit_block(self, block);
        self.types = types;
    }

    fn visit_signature(&mut self, signature: &Signature) {
        self.add(&signature.ident);
        visit::visit_signature(self, signature);
    }

    fn visit_field(&mut self, field: &Field) {
        field.ident.iter().for_each(|name| self.add(name));
        visit::visit_field(self, field);
    }

    fn visit_variant(&mut self, variant: &Variant) {
        self.add(&variant.ident);
        visit::visit_variant(self, variant);
    }

    fn visit_pat_ident(&mut self, pattern: &PatIdent) {
        self.add(&pattern.ident);
        visit::visit_pat_ident(self, pattern);
    }
}

/// What to write instead of a word of the glossary in an identifier, if there is one.
fn instead(identifier: &str) -> Option<&'static str> {
    let words = words(identifier);
    let is_verb = words.len() > 1 && words[0] == "place";
    let nouns = &words[usize::from(is_verb)..];
    GLOSSARY.iter().find(|(word, _)| nouns.iter().any(|noun| noun == word)).map(|&(_, exact)| exact)
}

/// The words of an identifier in snake case, upper case or camel case, in lower case.
fn words(identifier: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut after_lower = false;
    for letter in identifier.chars() {
        if letter == '_' || (letter.is_uppercase() && after_lower) {
            words.push(String::new());
        }
        words
            .last_mut()
            .into_iter()
            .for_each(|word| word.extend(letter.to_lowercase().filter(|&c| c != '_')));
        after_lower = letter.is_lowercase();
    }
    words.retain(|word| !word.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_cut_into_words() {
        assert_eq!(words("kept_places"), ["kept", "places"], "snake case");
        assert_eq!(words("KeptPlaces"), ["kept", "places"], "camel case");
        assert_eq!(words("MAX_ROOM"), ["max", "room"], "upper case");
        assert_eq!(words("_placeholder"), ["placeholder"], "a word that only begins alike");
    }

    #[test]
    fn words_of_the_glossary_are_found_but_in_tests_comments_and_strings() {
        let code = "
            //! A place.
            struct Kept;
            fn find(place: u32) { let text = \"seen\"; let is_told = text.seen; text }
            fn place_nodes(placeholder: [u8; 2]) { /* room */ }
            #[cfg(test)]
            fn seen() {}
            #[cfg(test)]
            mod tests { fn asked() {} }
        ";
        let names = Names::of(&syn::parse_file(code).expect("it parses"));
        let found: Vec<String> = names.violations().collect();
        let found: Vec<&str> = found.iter().filter_map(|fault| fault.split(':').next()).collect();
        assert_eq!(found, ["Kept", "is_told", "place"], "and no others");
    }

    #[test]
    fn names_of_types_are_found_but_in_tests_and_functions() {
        let code = "
            struct Step;
            mod inner { type Row = u8; fn local() { struct Local; } impl Deref for Row { type Target = u8; } }
            #[cfg(test)]
            mod tests { struct Step; }
        ";
        let names = Names::of(&syn::parse_file(code).expect("it parses"));
        let types: Vec<&String> = names.types.iter().collect();
        assert_eq!(types, ["Row", "Step"], "neither associated types nor local ones");
    }
}
