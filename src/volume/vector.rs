//! Vectors of three.

use super::VolumeError;

/// The inner product.
pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The outer product.
pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a` and `by` times `b`.
pub fn add(a: [f64; 3], by: f64, b: [f64; 3]) -> [f64; 3] {
    [a[0] + by * b[0], a[1] + by * b[1], a[2] + by * b[2]]
}

/// The vector of length 1; scaled by its largest part first, so that no square overflows.
pub fn unit(name: &'static str, value: [f64; 3]) -> Result<[f64; 3], VolumeError> {
    let largest = value.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let finite = value.iter().all(|x| x.is_finite());
    if !finite || largest == 0.0 {
        return Err(VolumeError::NoDirection { name, value });
    }
    let scaled = value.map(|x| x / largest);
    let length = dot(scaled, scaled).sqrt();
    Ok(scaled.map(|x| x / length))
}

/// A direction square to `along`, as near to `up` as can be; y, or z, in its place if it lies along it.
pub fn square(along: [f64; 3], up: [f64; 3]) -> [f64; 3] {
    for try_up in [up, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
        let rest = add(try_up, -dot(try_up, along), along);
        let length = dot(rest, rest).sqrt();
        if length > 1e-6 {
            // Once more: what is short has lost digits.
            let rest = add(rest, -dot(rest, along), along);
            let length = dot(rest, rest).sqrt();
            return rest.map(|x| x / length);
        }
    }
    unreachable!("nothing is along both y and z")
}
