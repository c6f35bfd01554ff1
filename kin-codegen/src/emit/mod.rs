//! From expressions to source: the only room that knows languages. What is written in which
//! order and under which names is decided for all of them alike; each has a folder for the
//! rest.

pub mod c;
pub(crate) mod header;
mod headings;
mod lanes;
mod language;
mod postures;
pub mod rust;
mod straight;
mod text;
