//! The space that is searched, declared before the search.

use snowglobe::frost::{Inflow, RingTouchingIce};

use super::super::shape::{Shape, Start};

/// Everything that the paper does not print but its Table 1 needs, except the size of the sketch, which is fitted to
/// it. At threshold 0 neither the redraw of r nor the rule for gamma matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Family {
    pub inflow: Inflow,
    pub ring: RingTouchingIce,
    pub start: Start,
    pub shape: Shape,
    pub alpha: f64,
    pub gamma: f64,
    pub steps_per_frame: u32,
}

/// Reiter's alpha, and gamma of the paper's pictures: what is taken unless a family says otherwise.
pub const ALPHA: f64 = 1.0;
pub const GAMMA: f64 = 0.005;

/// Steps of the solver in a frame.
pub const STEPS: std::ops::RangeInclusive<u32> = 1..=12;
/// The same where another alpha, gamma, ring or Eq. (1) is tried, on the hexagon.
pub const FEW_STEPS: [u32; 6] = [4, 6, 8, 9, 10, 12];
/// Alphas and gammas.
pub const ALPHAS: [f64; 5] = [0.5, 0.75, 1.0, 1.25, 1.5];
pub const GAMMAS: [f64; 3] = [0.0025, 0.005, 0.01];
/// Half widths of the sketch, in spacings of the lattice.
pub const SIZES: (f64, f64) = (3.0, 56.0);

impl Family {
    const SIMPLEST: Self = Self {
        inflow: Inflow::ReiterGated,
        ring: RingTouchingIce::Zero,
        start: Start::Centre,
        shape: Shape::Hexagon,
        alpha: ALPHA,
        gamma: GAMMA,
        steps_per_frame: 1,
    };

    /// Whether it is Reiter's rule with his alpha and the pictures' gamma, and a ring that shows 0 to ice: nothing but
    /// the sketch and the frame is chosen.
    pub fn is_plain(&self) -> bool {
        let Self { inflow, ring, alpha, gamma, .. } = Self::SIMPLEST;
        (self.inflow, self.ring, self.alpha, self.gamma) == (inflow, ring, alpha, gamma)
    }

    /// Numbers that were chosen to fit, gamma at another threshold aside.
    pub fn fitted_numbers(&self) -> usize {
        self.shape.numbers()
            + usize::from(self.steps_per_frame != 1)
            + usize::from(self.alpha != ALPHA)
            + usize::from(self.gamma != GAMMA)
    }
}

/// The families that are searched. Readings of Eq. (1) that differ from `reiter-gated` only where r withholds gamma
/// share its fits of Table 1.
pub fn declared() -> Vec<Family> {
    let hexagon = Family::SIMPLEST;
    let mut all = Vec::new();
    for start in Start::ALL {
        for shape in Shape::ALL {
            all.extend(STEPS.map(|steps_per_frame| Family { steps_per_frame, shape, start, ..hexagon }));
        }
    }
    let mut others = Vec::new();
    others.extend(ALPHAS.iter().filter(|a| **a != ALPHA).map(|&alpha| Family { alpha, ..hexagon }));
    others.extend(GAMMAS.iter().filter(|g| **g != GAMMA).map(|&gamma| Family { gamma, ..hexagon }));
    others.extend([Shape::Disc, Shape::Hexagon, Shape::Square].map(|shape| Family {
        ring: RingTouchingIce::Mean,
        shape,
        ..hexagon
    }));
    others.push(Family { inflow: Inflow::AsPrinted, ..hexagon });
    for family in others {
        all.extend(FEW_STEPS.map(|steps_per_frame| Family { steps_per_frame, ..family }));
    }
    // This reading fills a sketch in so few steps that more than two in a frame would need one of 20,000 cells.
    for steps_per_frame in [1, 2] {
        all.extend(Shape::ALL.map(|shape| Family {
            inflow: Inflow::OnlyIceHidden,
            shape,
            steps_per_frame,
            ..hexagon
        }));
    }
    all
}
