//! Instructions of a part of a program, counted by callgrind, which knows no AVX-512, so that the level is AVX2.
//! The viewer's example `effects` compiles this file, too: benches and examples cannot depend on each other.

use std::error::Error;
use std::process::Command;

/// Runs this program again with these arguments, and counts what it does between [`switch_counting`] on and off.
pub(crate) fn instructions(arguments: &[&str]) -> Result<f64, Box<dyn Error>> {
    let mut valgrind = Command::new("valgrind");
    // Making a scene takes far longer than drawing it, and is not counted.
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--instr-atstart=no"]);
    valgrind.arg(std::env::current_exe()?).args(arguments);
    let output = valgrind.output().map_err(|error| format!("valgrind: {error}; it has to be installed"))?;
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    let counted = text.lines().find_map(|line| line.split_once("Collected : "));
    Ok(counted.ok_or_else(|| text.clone())?.1.trim().parse()?)
}

/// Tells callgrind, within which this process runs, to count or not.
pub(crate) fn switch_counting(to: &str) -> Result<(), Box<dyn Error>> {
    let process = std::process::id().to_string();
    let output = Command::new("callgrind_control").args(["--instr", to, &process]).output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    if output.status.success() && text.contains("OK") { Ok(()) } else { Err(text.into_owned().into()) }
}
