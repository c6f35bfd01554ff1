//! Every subproblem: its answers solve it, the solutions it was made from is among
//! them, none is missing, and degenerate input is named as such.

mod circles;
mod components;
mod distances;
mod extremes;
mod parallel;
mod rotation;
mod sampling;
mod screw;
mod three_axes;
mod translation;
