//! The cases of `docs/hard-cases.md` that no other module holds yet, one file for
//! each family.
