//! The inner loops of the staggered solver: a component of the velocity, row by row.

use multiversion::multiversion;

/// The constants of a step for one component, which moves `along` its own axis and is carried `across` by the other.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    pub(super) dt: f64,
    /// 1 / spacing along and across, 1/m.
    pub(super) per: [f64; 2],
    pub(super) viscosity: f64,
    /// Weights of the convection of this step and of the one before.
    pub(super) now: f64,
    pub(super) before: f64,
    pub(super) upwind: bool,
}

/// A component around a row of faces: each slice is as long as the row.
#[derive(Clone, Copy)]
pub(super) struct Around<'a> {
    pub(super) here: &'a [f64],
    /// The faces behind and ahead along the component's own axis.
    pub(super) behind: &'a [f64],
    pub(super) ahead: &'a [f64],
    /// The faces on both sides of it.
    pub(super) below: &'a [f64],
    pub(super) above: &'a [f64],
    /// Pairs of the other component, between here and below, and between here and above.
    pub(super) carry_below: [&'a [f64]; 2],
    pub(super) carry_above: [&'a [f64]; 2],
    /// The force over mass.
    pub(super) force: &'a [f64],
}

/// One row without pressure, Eq. (17); `convection` holds that of the step before and then that of this one.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn predict(rule: Rule, around: Around, convection: &mut [f64], next: &mut [f64]) {
    if rule.upwind {
        row::<true>(rule, around, convection, next)
    } else {
        row::<false>(rule, around, convection, next)
    }
}

#[inline(always)]
fn row<const UPWIND: bool>(rule: Rule, around: Around, convection: &mut [f64], next: &mut [f64]) {
    let n = next.len();
    let Around { here, behind, ahead, below, above, carry_below: [b0, b1], carry_above: [a0, a1], force } =
        around;
    // Equal lengths, so that nothing is checked below.
    let (here, behind, ahead, below, above) =
        (&here[..n], &behind[..n], &ahead[..n], &below[..n], &above[..n]);
    let (b0, b1, a0, a1, force) = (&b0[..n], &b1[..n], &a0[..n], &a1[..n], &force[..n]);
    let convection = &mut convection[..n];
    let [along, across] = rule.per;
    let (nu_along, nu_across) = (rule.viscosity * along * along, rule.viscosity * across * across);
    for i in 0..n {
        let q = here[i];
        let (to, from) = (q + ahead[i], q + behind[i]);
        let (up, down) = (a0[i] + a1[i], b0[i] + b1[i]);
        let carried = if UPWIND {
            0.5 * along * (donor(to, q, ahead[i]) - donor(from, behind[i], q))
                + 0.5 * across * (donor(up, q, above[i]) - donor(down, below[i], q))
        } else {
            0.25 * along * (to * to - from * from)
                + 0.25 * across * (up * (q + above[i]) - down * (q + below[i]))
        };
        let spread =
            nu_along * ((ahead[i] + behind[i]) - 2.0 * q) + nu_across * ((above[i] + below[i]) - 2.0 * q);
        let convected = rule.now * carried + rule.before * convection[i];
        convection[i] = carried;
        next[i] = q + rule.dt * ((spread - convected) + force[i]);
    }
}

/// What a flow carries from where it comes: twice the flux through a face whose speed is half of `speed`.
#[inline(always)]
fn donor(speed: f64, behind: f64, ahead: f64) -> f64 {
    // Not f64::max, which must mind what is not a number.
    let forth = if speed > 0.0 { speed } else { 0.0 };
    let back = if speed < 0.0 { speed } else { 0.0 };
    forth * behind + back * ahead
}

/// The right side of Eq. (18): divergence over dt in a row of cells.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn divergence(u: &[f64], below: &[f64], above: &[f64], per: [f64; 2], out: &mut [f64]) {
    let n = out.len();
    let (west, east, below, above) = (&u[..n], &u[1..n + 1], &below[..n], &above[..n]);
    for i in 0..n {
        out[i] = (east[i] - west[i]) * per[0] + (above[i] - below[i]) * per[1];
    }
}

/// Takes a pressure difference from a row of faces.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn push_back(faces: &mut [f64], behind: &[f64], ahead: &[f64], factor: f64) {
    let n = faces.len();
    let (behind, ahead) = (&behind[..n], &ahead[..n]);
    for i in 0..n {
        faces[i] -= factor * (ahead[i] - behind[i]);
    }
}
