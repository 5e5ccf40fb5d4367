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

/// The circles among the parts of each folder. A part is a file or a folder with all that lies in it; the head of a folder
/// (`mod.rs`, and `lib.rs` or `main.rs` in the crate's own) is left out. In the crate's own folder no parts may need each other; in
/// others only files may, which [`circles`] lists.
#[must_use]
pub fn folder_circles(of: &Crate) -> Vec<String> {
    let needs = needs(of);
    let folders: BTreeSet<&Path> = of.files.iter().flat_map(|file| file.ancestors().skip(1)).collect();
    let mut found = Vec::new();
    for folder in folders {
        let mut graph = DiGraph::<&str, ()>::new();
        let mut nodes = BTreeMap::new();
        for &(from, to) in needs.keys() {
            let [from, to] = [from, to].map(|file| of.part(file, folder));
            let (Some(from), Some(to)) = (from, to) else { continue };
            let [from, to] =
                [from, to].map(|name| *nodes.entry(name).or_insert_with(|| graph.add_node(name)));
            graph.update_edge(from, to, ());
        }
        for circle in tarjan_scc(&graph).into_iter().filter(|circle| circle.len() > 1) {
            let mut names: Vec<&str> = circle.into_iter().map(|node| graph[node]).collect();
            names.sort_unstable();
            let is_folder = |name: &&str| of.root.join(folder).join(name).is_dir();
            if folder.as_os_str().is_empty() || names.iter().any(is_folder) {
                found.push(format!("{}: {}", folder.display(), names.join(" ")));
            }
        }
    }
    found
}

impl Crate {
    /// The part of a folder that a file belongs to: a file without its extension, or a folder.
    fn part(&self, file: usize, folder: &Path) -> Option<&str> {
        let within = self.files[file].strip_prefix(folder).ok()?;
        let name = Path::new(within.components().next()?.as_os_str()).file_stem()?.to_str()?;
        (file != 0 && name != "mod").then_some(name)
    }

    /// Every item that a file needs of another, as `tile_buffer/area.rs -> simd.rs (Simd)`, sorted.
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
