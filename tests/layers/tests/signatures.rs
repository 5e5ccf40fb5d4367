//! No function has more than six parameters, nor a tuple of three or more values as a parameter.

use std::path::Path;
use trigon_layers::long_signatures;

#[test]
fn parameters_are_few_and_named() {
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folders = ["crates", "apps"].map(|part| workspace.join(part).read_dir().expect("a folder of crates"));
    let mut crates = 0;
    let mut faults = String::new();
    for entry in folders.into_iter().flatten() {
        let folder = entry.expect("a folder that can be listed").path();
        let name = folder.file_name().expect("not the root").to_string_lossy().into_owned();
        let long = long_signatures(&folder).expect("files that parse");
        crates += 1;
        long.iter().for_each(|function| faults += &format!("{name}: {function}\n"));
    }
    assert!(crates >= 11, "nine crates and two apps, not {crates}");
    assert!(faults.is_empty(), "give the parameters names, in a struct:\n{faults}");
}
