//! Arrays as files of NumPy.

use crate::table::npy_head;

/// An array of doubles in C order.
pub fn encode(shape: &[usize], values: &[f64]) -> Vec<u8> {
    assert_eq!(shape.iter().product::<usize>(), values.len());
    let extents: String = shape.iter().map(|extent| format!("{extent}, ")).collect();
    let mut bytes = npy_head("'<f8'", &format!("({extents})"), 0);
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    bytes
}
