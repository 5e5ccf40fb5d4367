//! The 2D path, against a painter in exact integers and f64; and what holds to
//! the byte.

mod hostile;
mod oracle;
mod reference;
mod same;
mod seams;
mod shapes;
mod texels;
