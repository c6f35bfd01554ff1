//! What is fuzzed, and how inputs are varied. The tests of the crates take
//! these files in as well, and run them on stable without libFuzzer.

pub mod mutation;
pub mod readers;

use kin_codegen::random::Random;
use libfuzzer_sys::fuzzer_mutate;

/// For libFuzzer: one of our changes, or one of its own, of what is in a buffer.
/// Returns the new length.
pub fn mutate(data: &mut [u8], size: usize, most: usize, random: &mut Random) -> usize {
    let Some(text) = std::str::from_utf8(&data[..size])
        .ok()
        .filter(|_| random.below(3) > 0)
    else {
        return fuzzer_mutate(data, size, most);
    };
    let changed = mutation::mutate(text, text, random);
    let end = (0..=changed.len().min(most))
        .rev()
        .find(|&i| changed.is_char_boundary(i));
    let changed = &changed.as_bytes()[..end.unwrap_or(0)];
    data[..changed.len()].copy_from_slice(changed);
    changed.len()
}
