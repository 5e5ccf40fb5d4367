//! Finds the mutants of a file in its syntax tree.

use crate::error::{Error, Result};
use crate::list::{Genre, Mutant, Position};
use crate::sites::{Change, Site};
use std::collections::HashMap;
use std::ops::Range;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

/// The sites of these mutants of one file, outer ones first. Mutants within macros have none, nor have values of
/// type `impl Trait`.
pub(crate) fn sites(file: &str, source: &str, mutants: &[(u32, &Mutant)]) -> Result<Vec<Site>> {
    let tree = syn::parse_file(source).map_err(|error| Error::Source { path: file.to_owned(), error })?;
    let mut wanted: HashMap<(Genre, usize), Vec<(u32, String)>> = HashMap::new();
    for (number, mutant) in mutants.iter().filter(|(_, mutant)| !is_opaque(mutant)) {
        let place = (mutant.genre, offset(source, mutant.start));
        wanted.entry(place).or_default().push((*number, mutant.replacement.clone()));
    }
    let mut finder = Finder { wanted, sites: Vec::new() };
    finder.visit_file(&tree);
    Ok(finder.into_sites())
}

/// Whether a function that is replaced returns `impl Trait`: one type, which the mutant's value does not have.
fn is_opaque(mutant: &Mutant) -> bool {
    let returned = mutant.identity.split_once(" -> ").map(|(_, returned)| returned);
    mutant.genre == Genre::FnValue && returned.is_some_and(|returned| returned.contains("impl "))
}

/// In bytes from the start of the file.
fn offset(source: &str, position: Position) -> usize {
    let line_start = source.split_inclusive('\n').take(position.line - 1).map(str::len).sum::<usize>();
    let line = &source[line_start..];
    line_start + line.chars().take(position.column - 1).map(char::len_utf8).sum::<usize>()
}

fn range(node: &impl Spanned) -> Range<usize> {
    node.span().byte_range()
}

struct Finder {
    /// Numbers and replacements by what they change and where that starts.
    wanted: HashMap<(Genre, usize), Vec<(u32, String)>>,
    sites: Vec<Site>,
}

impl Finder {
    fn take(&mut self, genre: Genre, node: &impl Spanned) -> Vec<(u32, String)> {
        self.wanted.remove(&(genre, range(node).start)).unwrap_or_default()
    }

    fn add(&mut self, range: Range<usize>, number: u32, change: Change) {
        self.sites.push(Site { range, mutants: vec![(number, change)] });
    }

    /// Sites in the order in which they nest, those of one expression put together.
    fn into_sites(mut self) -> Vec<Site> {
        let order = |site: &Site| (site.range.start, usize::MAX - site.range.end, site.depth());
        self.sites.sort_by_key(order);
        self.sites.dedup_by(|later, earlier| {
            let is_same = later.range == earlier.range && later.depth() == earlier.depth();
            if is_same {
                earlier.mutants.append(&mut later.mutants);
            }
            is_same
        });
        self.sites
    }
}

impl<'ast> Visit<'ast> for Finder {
    fn visit_block(&mut self, block: &'ast syn::Block) {
        if let Some(first) = block.stmts.first() {
            let start = range(first).start;
            for (number, value) in self.take(Genre::FnValue, first) {
                self.add(start..start, number, Change::Return(value));
            }
        }
        visit::visit_block(self, block);
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        for (number, operator) in self.take(Genre::BinaryOperator, &binary.op) {
            let (left, right) = (range(&binary.left), range(&binary.right));
            self.add(range(binary), number, Change::Operator { left, operator, right });
        }
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        for (number, _) in self.take(Genre::UnaryOperator, &unary.op) {
            self.add(range(unary), number, Change::Operand(range(&unary.expr)));
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_struct(&mut self, expression: &'ast syn::ExprStruct) {
        for pair in expression.fields.pairs() {
            for (number, _) in self.take(Genre::StructField, pair.value()) {
                self.add(range(expression), number, Change::Without(range(&pair)));
            }
        }
        visit::visit_expr_struct(self, expression);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        let pattern_end = range(&arm.pat).end;
        let guard = arm.guard.as_ref().map(|(_, guard)| range(guard));
        for (number, _) in self.take(Genre::MatchArm, arm) {
            self.add(guard.clone().unwrap_or(pattern_end..pattern_end), number, Change::NoArm);
        }
        if let (Some((_, guard)), Some(place)) = (&arm.guard, guard) {
            for (number, value) in self.take(Genre::MatchArmGuard, guard) {
                self.add(place.clone(), number, Change::Guard(value));
            }
        }
        visit::visit_arm(self, arm);
    }
}
