//! Reads a crate's files.

use crate::module::{Crate, Module, Names};
use proc_macro2::{TokenStream, TokenTree};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use syn::punctuated::Punctuated;
use syn::visit::{self, Visit};
use syn::{Attribute, Expr, Item, ItemMod, ItemUse, Macro, Token, UseTree, Visibility};

impl Crate {
    /// Reads all modules from a root file, as `src/lib.rs`.
    ///
    /// # Errors
    /// A file that cannot be read or parsed.
    pub fn read(root_file: &Path) -> io::Result<Self> {
        let root = root_file.parent().map(PathBuf::from).unwrap_or_default();
        let name = root_file.file_name().map(PathBuf::from).unwrap_or_default();
        let mut this = Self { root, files: vec![name.clone()], modules: vec![Module::default()] };
        let items = this.parse(&name)?;
        this.fill(0, &items, Path::new(""))?;
        Ok(this)
    }

    fn parse(&self, file: &Path) -> io::Result<Vec<Item>> {
        let path = self.root.join(file);
        let text = fs::read_to_string(&path)?;
        let invalid =
            |error| io::Error::new(io::ErrorKind::InvalidData, format!("{}: {error}", path.display()));
        syn::parse_file(&text).map(|file| file.items).map_err(invalid)
    }

    /// Adds the items of a module, whose submodules lie in `folder`.
    fn fill(&mut self, module: usize, items: &[Item], folder: &Path) -> io::Result<()> {
        for item in items {
            match item {
                Item::Mod(inner) if is_for_tests(&inner.attrs) => {}
                Item::Mod(inner) => self.submodule(module, inner, folder)?,
                _ => Collector { module: &mut self.modules[module] }.visit_item(item),
            }
        }
        Ok(())
    }

    fn submodule(&mut self, parent: usize, inner: &ItemMod, folder: &Path) -> io::Result<()> {
        let name = inner.ident.to_string();
        let number = self.modules.len();
        let inside = folder.join(&name);
        let file = self.modules[parent].file;
        self.modules.push(Module { file, parent: Some(parent), ..Module::default() });
        self.modules[parent].children.insert(name, number);
        if let Some((_, items)) = &inner.content {
            return self.fill(number, items, &inside);
        }
        let beside = inside.with_extension("rs");
        let path = if self.root.join(&beside).is_file() { beside } else { inside.join("mod.rs") };
        let items = self.parse(&path)?;
        self.files.push(path);
        self.modules[number].file = self.files.len() - 1;
        self.fill(number, &items, &inside)
    }
}

/// Whether an item is compiled for tests only.
pub(crate) fn is_for_tests(attributes: &[Attribute]) -> bool {
    let is_test = |attribute: &Attribute| {
        attribute.path().is_ident("cfg")
            && attribute.meta.require_list().is_ok_and(|list| {
                let mut conditions = list.tokens.to_string();
                conditions.retain(|letter| !letter.is_whitespace());
                ["test", "doctest"].contains(&conditions.as_str()) || conditions.starts_with("all(test,")
            })
    };
    attributes.iter().any(is_test)
}

/// Puts what it meets into a module.
struct Collector<'a> {
    module: &'a mut Module,
}

impl Visit<'_> for Collector<'_> {
    fn visit_item(&mut self, item: &Item) {
        if is_for_tests(attributes(item)) {
            return;
        }
        if let Some(name) = name(item) {
            self.module.items.insert(name);
        }
        if let Item::Macro(item) = item {
            // What a macro of this module defines under a name of its own.
            self.module.items.extend(defined_types(item.mac.tokens.clone()));
        }
        visit::visit_item(self, item);
    }

    fn visit_item_use(&mut self, item: &ItemUse) {
        let is_private = matches!(item.vis, Visibility::Inherited);
        self.import(&item.tree, &mut Names::new(), is_private);
    }

    fn visit_path(&mut self, path: &syn::Path) {
        self.module.references.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, call: &Macro) {
        visit::visit_path(self, &call.path);
        // Macros that take expressions, as `vec!` and `format!`; others are not looked into.
        if let Ok(arguments) = call.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated) {
            arguments.iter().for_each(|argument| self.visit_expr(argument));
        }
    }
}

impl Collector<'_> {
    fn import(&mut self, tree: &UseTree, path: &mut Names, is_private: bool) {
        let (name, known_as) = match tree {
            UseTree::Path(step) => {
                path.push(step.ident.to_string());
                self.import(&step.tree, path, is_private);
                path.pop();
                return;
            }
            UseTree::Group(group) => {
                group.items.iter().for_each(|tree| self.import(tree, path, is_private));
                return;
            }
            UseTree::Glob(_) => {
                self.module.globs.push(path.clone());
                return;
            }
            UseTree::Name(name) => (name.ident.to_string(), name.ident.to_string()),
            UseTree::Rename(rename) => (rename.ident.to_string(), rename.rename.to_string()),
        };
        let mut whole = path.clone();
        // `use tile::{self}` brings in `tile`.
        let known_as = if name == "self" { path.last().cloned().unwrap_or_default() } else { known_as };
        if name != "self" {
            whole.push(name);
        }
        if is_private {
            self.module.references.push(whole.clone());
        }
        self.module.imports.insert(known_as, whole);
    }
}

/// The names behind `struct` and `enum` in the rules of a macro, unless they are parameters.
fn defined_types(tokens: TokenStream) -> Vec<String> {
    let (mut names, mut is_next) = (Vec::new(), false);
    for token in tokens {
        let was_next = std::mem::take(&mut is_next);
        match token {
            TokenTree::Group(group) => names.extend(defined_types(group.stream())),
            TokenTree::Ident(ident) if was_next => names.push(ident.to_string()),
            TokenTree::Ident(ident) => is_next = ident == "struct" || ident == "enum",
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    names
}

fn name(item: &Item) -> Option<String> {
    let ident = match item {
        Item::Const(item) => &item.ident,
        Item::Enum(item) => &item.ident,
        Item::Fn(item) => &item.sig.ident,
        Item::Macro(item) => item.ident.as_ref()?,
        Item::Static(item) => &item.ident,
        Item::Struct(item) => &item.ident,
        Item::Trait(item) => &item.ident,
        Item::TraitAlias(item) => &item.ident,
        Item::Type(item) => &item.ident,
        Item::Union(item) => &item.ident,
        _ => return None,
    };
    Some(ident.to_string())
}

fn attributes(item: &Item) -> &[Attribute] {
    match item {
        Item::Const(item) => &item.attrs,
        Item::Enum(item) => &item.attrs,
        Item::Fn(item) => &item.attrs,
        Item::Impl(item) => &item.attrs,
        Item::Macro(item) => &item.attrs,
        Item::Static(item) => &item.attrs,
        Item::Struct(item) => &item.attrs,
        Item::Trait(item) => &item.attrs,
        Item::Type(item) => &item.attrs,
        Item::Use(item) => &item.attrs,
        _ => &[],
    }
}
