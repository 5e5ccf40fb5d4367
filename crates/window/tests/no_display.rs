//! On a machine without a display, opening a window is an error that says so,
//! from any thread, and never a panic.
#![cfg(target_os = "linux")]

use std::process::Command;

use trigon_window::{Application, WindowError};

/// Tells the inner test that it runs without a display.
const INNER: &str = "TRIGON_TEST_WITHOUT_DISPLAY";

#[test]
fn no_display_is_a_typed_error() {
    // The environment is a process' own: a child of this test gets one without a display.
    let this = std::env::current_exe().expect("a test has a path");
    let output = Command::new(this)
        .args(["--exact", "inner_run_without_display", "--nocapture"])
        .env(INNER, "1")
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .output()
        .expect("the test starts itself");
    let text = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    assert!(text.contains("refused as expected"), "the inner test ran: {text}");
}

#[test]
fn inner_run_without_display() {
    if std::env::var_os(INNER).is_none() {
        return;
    }
    let error = Application::new("never seen").run().expect_err("there is no display");
    assert!(matches!(error, WindowError::NoDisplay { .. }), "{error:?}");
    let text = error.to_string();
    assert!(text.contains("DISPLAY"), "the message names the remedy: {text}");
    println!("refused as expected: {text}");
}
