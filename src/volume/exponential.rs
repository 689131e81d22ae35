//! e to a power, the same bits on every processor, quick enough for every cell of every ray.

/// 1 / n!.
const INVERSE: [f64; 13] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
];
/// Adding it leaves the nearest whole number in the lowest bits.
pub(super) const WHOLE: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts; a power of two below 2^11 times the first is exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// e^x within a relative 1e-15; below -700 as at -700, about 1e-304, and above 700 as at 700.
///
/// x = k ln 2 + r with |r| <= ln 2 / 2; e^r is Taylor's polynomial of degree 12, whose rest is below 2e-16.
#[inline]
pub fn exp(x: f64) -> f64 {
    let x = x.clamp(-700.0, 700.0);
    let shifted = x * std::f64::consts::LOG2_E + WHOLE;
    let k = shifted - WHOLE;
    let r = (x - k * LN_2[0]) - k * LN_2[1];
    let (r2, c) = (r * r, INVERSE);
    let r4 = r2 * r2;
    // Pairs, so that few of the products wait for one another.
    let low = (c[2] + c[3] * r) + (c[4] + c[5] * r) * r2;
    let middle = (c[6] + c[7] * r) + (c[8] + c[9] * r) * r2;
    let high = (c[10] + c[11] * r) + c[12] * r2;
    let power = 1.0 + (r + r2 * (low + r4 * (middle + r4 * high)));
    power * f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52)
}

/// The mean of e^-y over y between `x0` and `x1`, of which `a0` and `a1` are e^-x0 and e^-x1.
#[inline]
pub fn mean(a0: f64, a1: f64, x0: f64, x1: f64) -> f64 {
    let x = x1 - x0;
    // Where the difference has lost digits, the row to the third power: 4e-14 are left out.
    let row = a0 * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0))));
    let quotient = (a0 - a1) / x;
    if x.abs() < 1e-3 { row } else { quotient }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1e-15: two or three roundings at 1.1e-16 each and the rest of the row.
    #[test]
    fn it_is_exp_to_1e_15() {
        let mut worst = 0.0_f64;
        for k in -140_000..=40_000_i32 {
            let x = f64::from(k) * 0.005 + 1e-4 / (1.0 + f64::from(k.abs()));
            let known = libm::exp(x.max(-700.0));
            worst = worst.max((exp(x) / known - 1.0).abs());
        }
        assert!(worst <= 1e-15, "{worst}");
        assert_eq!((exp(0.0), exp(-0.0)), (1.0, 1.0));
        assert_eq!((exp(-1e9), exp(f64::NEG_INFINITY)), (exp(-700.0), exp(-700.0)));
    }

    /// 1e-11: what is lost where the difference is 1e-3, at 1e-15 each.
    #[test]
    fn the_mean_is_continuous() {
        for x0 in [0.0, 0.3, 7.0] {
            for k in -400..400 {
                let x = f64::from(k) * 1.7e-5 + f64::from(k * k * k) * 2e-7;
                let known = if x == 0.0 { exp(-x0) } else { -libm::exp(-x0) * libm::expm1(-x) / x };
                let got = mean(exp(-x0), exp(-(x0 + x)), x0, x0 + x);
                assert!((got / known - 1.0).abs() < 1e-11, "{x0} {x}");
            }
        }
    }
}
