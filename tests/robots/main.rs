//! Every robot of `robots/`, compiled by the macro, against the generic
//! product of exponentials and its numerical search.

mod aim;
#[path = "../cached.rs"]
mod cached;
mod descent;
mod measure;
#[path = "../random.rs"]
mod random;
mod subject;
#[macro_use]
mod zoo;

mod at_run_time;
mod batches;
mod book;
mod closest;
mod complete;
mod coupled;
mod forward;
mod hard_cases;
mod honest;
mod limits;
mod malformed;
mod near;
mod nearest;
mod noisy;
mod path;
mod posture;
mod recovered;
mod rounded;
mod sound;
mod table;
mod targets;
mod unreachable;
