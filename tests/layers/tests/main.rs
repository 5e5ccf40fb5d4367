//! Checks of the source code and of the documents that name it.

mod extending;
mod glossary;
mod growth;
mod hard_cases;
mod layers;
mod packages;
mod signatures;
mod where_is;
