//! Prints which file of a crate needs which item of which other file: `cargo run -p trigon-layers --example needs raster`.

use std::error::Error;
use std::{env, io};
use trigon_layers::{Crate, packages};

fn main() -> Result<(), Box<dyn Error>> {
    let wanted = env::args().nth(1).ok_or("the name of a crate's folder is missing")?;
    let folders = packages()?;
    let folder = folders.iter().find(|folder| folder.ends_with(&wanted)).ok_or("no such crate")?;
    let roots = ["lib.rs", "main.rs"].map(|root| folder.join("src").join(root));
    let root = roots.iter().find(|root| root.is_file()).ok_or("neither a library nor a program")?;
    let mut out = io::stdout().lock();
    for need in Crate::read(root)?.needs() {
        io::Write::write_fmt(&mut out, format_args!("{need}\n"))?;
    }
    Ok(())
}
