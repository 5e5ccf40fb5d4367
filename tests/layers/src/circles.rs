//! Files that need each other.

use crate::module::Crate;
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

/// Files each of which needs all others, if by way of others.
#[derive(Debug)]
pub struct Circle {
    /// Sorted, relative to `src`.
    pub files: Vec<PathBuf>,
    /// How many folders they lie in.
    pub folder_count: usize,
    /// Which file names what of which, once for each pair.
    pub reasons: Vec<String>,
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} files in {} folders:", self.files.len(), self.folder_count)?;
        self.reasons.iter().try_for_each(|reason| writeln!(f, "  {reason}"))
    }
}

/// All circles of two files or more, the largest first.
#[must_use]
pub fn circles(of: &Crate) -> Vec<Circle> {
    let needs = needs(of);
    let mut graph = DiGraph::<(), ()>::new();
    let nodes: Vec<NodeIndex> = of.files.iter().map(|_| graph.add_node(())).collect();
    for &(from, to) in needs.keys() {
        graph.add_edge(nodes[from], nodes[to], ());
    }
    let mut circles: Vec<Circle> = tarjan_scc(&graph)
        .into_iter()
        .filter(|circle| circle.len() > 1)
        .map(|circle| of_files(of, &needs, circle.into_iter().map(NodeIndex::index).collect()))
        .collect();
    circles.sort_by(|a, b| b.files.len().cmp(&a.files.len()).then_with(|| a.files.cmp(&b.files)));
    circles
}

/// The circles of a crate's top-level modules, each with all that lies in it: their names, the largest circle first. The
/// crate's root is left out.
#[must_use]
pub fn module_circles(of: &Crate) -> Vec<Vec<String>> {
    let name = |file: usize| {
        let first = of.files[file].components().next()?;
        let name = Path::new(first.as_os_str()).file_stem()?.to_string_lossy().into_owned();
        (file != 0).then_some(name)
    };
    let mut graph = DiGraph::<String, ()>::new();
    let mut nodes = BTreeMap::new();
    for (from, to) in needs(of).into_keys() {
        let (Some(from), Some(to)) = (name(from), name(to)) else { continue };
        let [from, to] =
            [from, to].map(|name| *nodes.entry(name.clone()).or_insert_with(|| graph.add_node(name)));
        graph.update_edge(from, to, ());
    }
    let mut circles: Vec<Vec<String>> = tarjan_scc(&graph)
        .into_iter()
        .filter(|circle| circle.len() > 1)
        .map(|circle| circle.into_iter().map(|node| graph[node].clone()).collect())
        .collect();
    circles.iter_mut().for_each(|circle| circle.sort());
    circles.sort_by(|a, b| b.len().cmp(&a.len()).then_with(|| a.cmp(b)));
    circles
}

impl Crate {
    /// Every item that a file needs of another, as `tile/area.rs -> simd.rs (Simd)`, sorted.
    #[must_use]
    pub fn needs(&self) -> Vec<String> {
        let mut needs = BTreeSet::new();
        for (number, module) in self.modules.iter().enumerate() {
            for path in &module.references {
                let Some(definition) = self.definition(number, path) else { continue };
                let [from, to] = [module.file, self.modules[definition].file];
                if from != to {
                    let [from, to] = [from, to].map(|file| self.files[file].display());
                    needs.insert(format!("{from} -> {to} ({})", path.join("::")));
                }
            }
        }
        needs.into_iter().collect()
    }
}

/// Which file needs which, and an item for which it does.
fn needs(of: &Crate) -> BTreeMap<(usize, usize), String> {
    let mut needs = BTreeMap::new();
    for (number, module) in of.modules.iter().enumerate() {
        for path in &module.references {
            let Some(definition) = of.definition(number, path) else { continue };
            let (from, to) = (module.file, of.modules[definition].file);
            if from != to {
                needs.entry((from, to)).or_insert_with(|| path.join("::"));
            }
        }
    }
    needs
}

fn of_files(of: &Crate, needs: &BTreeMap<(usize, usize), String>, files: BTreeSet<usize>) -> Circle {
    let name = |file: usize| of.files[file].display();
    let within = needs.iter().filter(|((from, to), _)| files.contains(from) && files.contains(to));
    let reasons =
        within.map(|(&(from, to), item)| format!("{} -> {} ({item})", name(from), name(to))).collect();
    let folders: BTreeSet<PathBuf> = files.iter().map(|&file| of.folder(file)).collect();
    let mut files: Vec<PathBuf> = files.into_iter().map(|file| of.files[file].clone()).collect();
    files.sort();
    Circle { files, folder_count: folders.len(), reasons }
}
