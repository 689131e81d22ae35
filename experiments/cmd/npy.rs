//! Arrays as NumPy files.

use ndarray::ArrayViewD;
use ndarray_npy::{WritableElement, WriteNpyExt};
use snowglobe::lab::{Error, Result};

/// Values in C order with this shape, as `.npy`.
pub fn npy<T: WritableElement>(shape: &[usize], values: &[T]) -> Result<Vec<u8>> {
    let broken = || Error::broken("cannot write an array");
    let array = ArrayViewD::from_shape(shape, values).map_err(|cause| broken().because(cause))?;
    let mut bytes = Vec::new();
    array.write_npy(&mut bytes).map_err(|cause| broken().because(cause))?;
    Ok(bytes)
}
