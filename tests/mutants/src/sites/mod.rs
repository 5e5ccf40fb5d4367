//! Sources with switches: each mutant beside the original, and comments from which an error of the compiler is
//! traced to its mutant.

use std::ops::Range;

/// What a mutant changes.
#[derive(Debug)]
pub(crate) enum Change {
    /// A function returns this at once.
    Return(String),
    /// Another operator between the same operands. Textually, another precedence could group them anew.
    Operator { left: Range<usize>, operator: String, right: Range<usize> },
    /// The operand without its sign.
    Operand(Range<usize>),
    /// A struct expression without this field and its comma.
    Without(Range<usize>),
    /// An arm that never matches.
    NoArm,
    /// Another condition of an arm.
    Guard(String),
}

/// A place in a file, in bytes, with the mutants there. It is empty where something is put in.
#[derive(Debug)]
pub(crate) struct Site {
    pub(crate) range: Range<usize>,
    /// With their numbers.
    pub(crate) mutants: Vec<(u32, Change)>,
}

impl Site {
    /// Which site of the same range is within the other.
    pub(crate) fn depth(&self) -> u8 {
        match self.mutants[0].1 {
            Change::NoArm => 0,
            Change::Guard(_) => 1,
            Change::Return(_) | Change::Operator { .. } | Change::Operand(_) | Change::Without(_) => 2,
        }
    }
}

fn is_active(number: u32) -> String {
    format!("::trigon_mutants_switch::active({number})")
}

/// The source with all switches; the sites are sorted, outer ones first.
pub(crate) fn switched(source: &str, sites: &[Site]) -> String {
    Renderer { source, sites }.text(0..source.len(), 0)
}

struct Renderer<'a> {
    source: &'a str,
    sites: &'a [Site],
}

impl Renderer<'_> {
    /// The text of a range with the sites in it, of those from `first` on.
    fn text(&self, range: Range<usize>, first: usize) -> String {
        let mut text = String::new();
        let mut done = range.start;
        for (index, site) in self.sites.iter().enumerate().skip(first) {
            if site.range.start >= done && site.range.end <= range.end {
                text += &self.source[done..site.range.start];
                text += &self.site(index);
                done = site.range.end;
            }
        }
        text + &self.source[done..range.end]
    }

    fn site(&self, index: usize) -> String {
        let site = &self.sites[index];
        let numbers: Vec<String> = site.mutants.iter().map(|(number, _)| number.to_string()).collect();
        let original = self.text(site.range.clone(), index + 1);
        let switch = match &site.mutants[0].1 {
            Change::Return(_) => self.returns(site),
            Change::NoArm => no_arm(site, &original),
            Change::Operator { .. } | Change::Operand(_) | Change::Without(_) | Change::Guard(_) => {
                let cases: String =
                    site.mutants.iter().map(|mutant| self.case(mutant, site, index)).collect();
                format!("({cases}{{ ({original}) }})")
            }
        };
        format!("/*site {}*/{switch}/*end*/", numbers.join(","))
    }

    fn returns(&self, site: &Site) -> String {
        let returns = |(number, change): &(u32, Change)| match change {
            Change::Return(value) => {
                format!("if {} {{ return /*mutant {number}*/{value}/*end*/; }} ", is_active(*number))
            }
            _ => String::new(),
        };
        site.mutants.iter().map(returns).collect()
    }

    /// `if active { mutant } else`
    fn case(&self, (number, change): &(u32, Change), site: &Site, index: usize) -> String {
        let part = |range: &Range<usize>| self.text(range.clone(), index + 1);
        let mutant = match change {
            Change::Operator { left, operator, right } => {
                format!("({}) {operator} ({})", part(left), part(right))
            }
            Change::Operand(operand) => format!("({})", part(operand)),
            Change::Without(field) => {
                part(&(site.range.start..field.start)) + &part(&(field.end..site.range.end))
            }
            Change::Guard(value) | Change::Return(value) => value.clone(),
            Change::NoArm => "false".to_owned(),
        };
        format!("if {} {{ /*mutant {number}*/{mutant}/*end*/ }} else ", is_active(*number))
    }
}

fn no_arm(site: &Site, guard: &str) -> String {
    let (number, _) = site.mutants[0];
    if site.range.is_empty() {
        return format!(" if !{}", is_active(number));
    }
    format!("!{} && ({guard})", is_active(number))
}

/// What an error at a byte of a text with switches is about.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Blame {
    /// The code that a mutant puts in.
    Mutant(u32),
    /// The switch of these.
    Site(Vec<u32>),
    Nobody,
}

/// The innermost site or mutant around a byte.
pub(crate) fn blame(text: &str, byte: usize) -> Blame {
    let mut open: Vec<&str> = Vec::new();
    let before = &text[..byte.min(text.len())];
    for part in before.split("/*").skip(1) {
        let Some((comment, _)) = part.split_once("*/") else { continue };
        if comment == "end" {
            open.pop();
        } else if comment.starts_with("site ") || comment.starts_with("mutant ") {
            open.push(comment);
        }
    }
    let numbers = |list: &str| list.split(',').filter_map(|number| number.parse().ok()).collect();
    match open.last().and_then(|comment| comment.split_once(' ')) {
        Some(("mutant", number)) => number.parse().map_or(Blame::Nobody, Blame::Mutant),
        Some((_, list)) => Blame::Site(numbers(list)),
        None => Blame::Nobody,
    }
}

/// The first arm after a byte that a mutant leaves out: if a `match` there is not exhaustive, for its sake.
pub(crate) fn next_arm(text: &str, byte: usize) -> Option<u32> {
    let (_, rest) = text[byte.min(text.len())..].split_once("!::trigon_mutants_switch::active(")?;
    rest.split_once(')')?.0.parse().ok()
}

#[cfg(test)]
mod tests;
