//! Functions with too many parameters, or with parameters that are packed into tuples.

use crate::collect::is_for_tests;
use crate::workspace::rust_files;
use std::fs;
use std::io;
use std::path::Path;
use syn::visit::{self, Visit};
use syn::{
    Attribute, FnArg, ImplItemFn, ItemFn, ItemImpl, ItemMod, Pat, PatType, Signature, TraitItemFn, Type,
};

/// The most parameters that a function may have, `self` not counted.
const MOST_PARAMETERS: usize = 6;
/// What the values of a tuple may be named that is a parameter: a point, a size, or a place in a grid.
const COORDINATES: [&str; 9] = ["x", "y", "z", "u", "v", "row", "column", "width", "height"];

/// The functions of a crate, tests left out, that have more than six parameters or a tuple as a parameter, but
/// for named coordinates: as `src/file.rs: name`, sorted. A function that expects the lint
/// `too_many_arguments`, with its reason, may have more parameters.
///
/// # Errors
/// A file that cannot be read or parsed.
pub fn long_signatures(crate_folder: &Path) -> io::Result<Vec<String>> {
    let mut found = Vec::new();
    for path in rust_files(&crate_folder.join("src"))? {
        let within = path.strip_prefix(crate_folder).unwrap_or(&path);
        if is_of_tests(within) {
            continue;
        }
        let invalid =
            |error| io::Error::new(io::ErrorKind::InvalidData, format!("{}: {error}", path.display()));
        let file = syn::parse_file(&fs::read_to_string(&path)?).map_err(invalid)?;
        let mut visitor = Signatures { long: Vec::new() };
        visitor.visit_file(&file);
        found.extend(visitor.long.iter().map(|name| format!("{}: {name}", within.display())));
    }
    found.sort();
    Ok(found)
}

/// Whether a file or one of its folders within the crate is named `tests`.
fn is_of_tests(path: &Path) -> bool {
    path.components().any(|part| Path::new(part.as_os_str()).file_stem().is_some_and(|stem| stem == "tests"))
}

struct Signatures {
    long: Vec<String>,
}

impl Signatures {
    fn check(&mut self, signature: &Signature, attributes: &[Attribute]) {
        let parameters = signature.inputs.iter().filter_map(|input| match input {
            FnArg::Typed(parameter) => Some(parameter),
            FnArg::Receiver(_) => None,
        });
        let parameters: Vec<&PatType> = parameters.collect();
        let is_long = parameters.len() > MOST_PARAMETERS && !attributes.iter().any(expects_many);
        if is_long || parameters.iter().any(|&parameter| is_packed(parameter)) {
            self.long.push(signature.ident.to_string());
        }
    }
}

/// Whether an attribute is `expect(clippy::too_many_arguments, …)`.
fn expects_many(attribute: &Attribute) -> bool {
    let text = |list: &syn::MetaList| list.tokens.to_string().contains("too_many_arguments");
    attribute.path().is_ident("expect") && attribute.meta.require_list().is_ok_and(text)
}

/// Whether a parameter is a tuple of values that are no coordinates.
fn is_packed(parameter: &PatType) -> bool {
    is_tuple(&parameter.ty) && !are_coordinates(&parameter.pat)
}

fn is_tuple(ty: &Type) -> bool {
    match ty {
        Type::Tuple(tuple) => tuple.elems.len() > 1,
        Type::Reference(reference) => is_tuple(&reference.elem),
        Type::Paren(inner) => is_tuple(&inner.elem),
        _ => false,
    }
}

fn are_coordinates(pattern: &Pat) -> bool {
    let is_coordinate =
        |name: &Pat| matches!(name, Pat::Ident(name) if COORDINATES.iter().any(|known| name.ident == known));
    matches!(pattern, Pat::Tuple(names) if names.elems.iter().all(is_coordinate))
}

impl Visit<'_> for Signatures {
    fn visit_item_mod(&mut self, item: &ItemMod) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_fn(&mut self, item: &ItemFn) {
        if !is_for_tests(&item.attrs) {
            self.check(&item.sig, &item.attrs);
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &ItemImpl) {
        if !is_for_tests(&item.attrs) {
            visit::visit_item_impl(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &ImplItemFn) {
        self.check(&item.sig, &item.attrs);
        visit::visit_impl_item_fn(self, item);
    }

    fn visit_trait_item_fn(&mut self, item: &TraitItemFn) {
        self.check(&item.sig, &item.attrs);
        visit::visit_trait_item_fn(self, item);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seven_parameters_and_tuples_are_found() {
        let code = "
            fn six(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8) {}
            fn seven(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8, g: u8) {}
            #[expect(clippy::too_many_arguments, reason = \"a kernel\")]
            fn expected(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8, g: u8) {}
            fn pair((a, b): (u8, u8)) {}
            fn triple((a, b, c): (u8, u8, u8)) {}
            fn by_reference(triple: &(u8, u8, u8)) {}
            fn pixel((x, y): (u32, u32), (width, height): (u32, u32)) {}
            fn nothing(unit: ()) {}
            fn closure(visit: impl Fn((u8, u8)) -> (u8, u8)) {}
            #[cfg(test)]
            mod tests { fn triple((a, b, c): (u8, u8, u8)) {} }
        ";
        let mut visitor = Signatures { long: Vec::new() };
        visitor.visit_file(&syn::parse_file(code).expect("it parses"));
        assert_eq!(visitor.long, ["seven", "pair", "triple", "by_reference"], "and no others");
    }
}
