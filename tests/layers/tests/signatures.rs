//! No function has more than six parameters, nor a tuple as a parameter that is no point, size or place in a grid.

use trigon_layers::{long_signatures, packages};

#[test]
fn parameters_are_few_and_named() {
    let mut faults = String::new();
    for folder in packages().expect("folders that can be listed") {
        let name = folder.file_name().expect("not the root").to_string_lossy().into_owned();
        let long = long_signatures(&folder).expect("files that parse");
        faults.extend(long.iter().map(|function| format!("{name}: {function}\n")));
    }
    assert!(faults.is_empty(), "give the parameters names, in a struct:\n{faults}");
}
