//! The workspace tests, one module per subject.
