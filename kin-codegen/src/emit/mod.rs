//! From expressions to source: the only room that knows languages. What is written in which
//! order and under which names is decided for all of them alike; each has a folder for the
//! rest.

pub mod c;
mod curly;
pub(crate) mod header;
mod headings;
pub(crate) mod js;
mod lanes;
mod language;
pub mod postures;
pub mod rust;
mod straight;
mod text;
