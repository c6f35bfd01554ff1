//! Values of a function that is asked for the same places again.

use alloc::vec::Vec;
use core::cell::RefCell;

/// Values that are kept at most: solutions take a kilobyte each.
const KEPT: usize = 4096;
/// Slots of the table: few of its entries are in the way of others.
const SLOTS: usize = 8192;
/// 2⁶⁴ over the golden ratio: the upper digits of its multiples are spread evenly (D. E. Knuth,
/// *The Art of Computer Programming*, volume 3, 1998, section 6.4).
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// The values of a function at numbers at which it was asked for.
pub(super) struct Memo<V> {
    known: RefCell<Known<V>>,
}

struct Known<V> {
    /// By the number's hash, one more than the place among the entries, or zero: open addressing
    /// with linear probing.
    slots: Vec<u16>,
    /// The digits of a number, and the value.
    entries: Vec<(u64, V)>,
}

impl<V: Copy> Memo<V> {
    pub fn new() -> Self {
        Self {
            known: RefCell::new(Known {
                slots: Vec::new(),
                entries: Vec::new(),
            }),
        }
    }

    /// The value at a number.
    pub fn at(&self, x: f64, value: impl FnOnce() -> V) -> V {
        let bits = x.to_bits();
        if let Some(known) = self.known.borrow().find(bits) {
            return known;
        }
        let value = value();
        self.known.borrow_mut().insert(bits, value);
        value
    }
}

impl<V: Copy> Known<V> {
    fn find(&self, bits: u64) -> Option<V> {
        if self.slots.is_empty() {
            return None;
        }
        let slots = probed(bits).map(|slot| self.slots[slot]);
        let taken = slots.take_while(|&place| place > 0);
        let mut entries = taken.map(|place| &self.entries[usize::from(place) - 1]);
        entries.find(|entry| entry.0 == bits).map(|entry| entry.1)
    }

    fn insert(&mut self, bits: u64, value: V) {
        if self.entries.len() == KEPT {
            return;
        }
        self.slots.resize(SLOTS, 0);
        self.entries.push((bits, value));
        let free = probed(bits).find(|&slot| self.slots[slot] == 0);
        if let Some(slot) = free {
            self.slots[slot] = self.entries.len() as u16;
        }
    }
}

/// The slots that a number may be in, the first one first.
fn probed(bits: u64) -> impl Iterator<Item = usize> {
    let first = (bits.wrapping_mul(SPREAD) >> 32) as usize;
    (0..SLOTS).map(move |i| (first + i) % SLOTS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::cell::Cell;

    /// Numbers whose digits differ in few places, more of them than are kept.
    #[test]
    fn values_are_those_of_the_number() {
        let memo = Memo::new();
        let asked = Cell::new(0);
        let ask = |i: usize| {
            let x = i as f64 / 64.0;
            memo.at(x, || {
                asked.set(asked.get() + 1);
                2.0 * x
            })
        };
        for _ in 0..2 {
            for i in 0..2 * KEPT {
                assert_eq!(ask(i), i as f64 / 32.0);
            }
        }
        assert_eq!(asked.get(), 3 * KEPT);
        assert_eq!(memo.at(-0.0, || -1.0), -1.0, "zeros of both signs are two");
    }
}
