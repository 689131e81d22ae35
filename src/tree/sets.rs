//! Three ways to read the whole paper, side by side.

use super::readings::{
    AirSpeed, Damping, Drag, Exchange, Gravity, Position, SharedSymbol, Target, VelocityAfterLength,
};
use super::{Linearised, Parameters, Skeleton, TreeError};
use crate::navier_stokes::{Convection, Forcing, Scheme, WallPressure};
use crate::reading::Reading;

/// A reading of every disputed place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Readings {
    /// Eq. (10).
    pub position: Position,
    /// Eq. (9).
    pub damping: Damping,
    /// Eq. (6) and (9).
    pub shared_symbol: SharedSymbol,
    /// Eq. (7).
    pub gravity: Gravity,
    /// Eq. (5).
    pub target: Target,
    /// Eq. (3).
    pub air_speed: AirSpeed,
    /// Eq. (11).
    pub velocity: VelocityAfterLength,
    /// Eq. (3).
    pub drag: Drag,
    /// §5.2.
    pub exchange: Exchange,
    /// §4.2.1, where the unknowns of the wind are.
    pub scheme: Scheme,
    /// Not given: how convection is differenced.
    pub convection: Convection,
    /// Eq. (15); the staggered wind has no use for it.
    pub wall_pressure: WallPressure,
    /// Eq. (17); the staggered wind has f inside.
    pub forcing: Forcing,
}

impl Readings {
    /// A sound reading that stays near the page: only what cannot be meant is changed.
    pub const PAPER: Self = Self {
        position: Position::AsPrinted,
        damping: Damping::PerStep,
        shared_symbol: SharedSymbol::TwoNumbers,
        gravity: Gravity::RestPose,
        target: Target::Rotated,
        air_speed: AirSpeed::AsPrinted,
        velocity: VelocityAfterLength::Kept,
        drag: Drag::AsPrinted,
        exchange: Exchange::Speed,
        scheme: Scheme::Collocated,
        convection: Convection::Upwind,
        wall_pressure: WallPressure::Linear,
        forcing: Forcing::InsideStep,
    };

    /// Mechanics: time steps, gravity, damping and momentum as they are in nature. Its restoring coefficient must be
    /// above the critical one ([`Linearised::critical_restoring`](super::Linearised::critical_restoring)).
    pub const PHYSICAL: Self = Self {
        position: Position::TimesDt,
        damping: Damping::Rate,
        gravity: Gravity::AsPrinted,
        air_speed: AirSpeed::PerTime,
        velocity: VelocityAfterLength::Corrected,
        exchange: Exchange::Consistent,
        scheme: Scheme::Staggered,
        ..Self::PAPER
    };

    /// What the page says, word for word, gravity included.
    pub const LITERAL: Self = Self {
        gravity: Gravity::AsPrinted,
        wall_pressure: WallPressure::AsPrinted,
        forcing: Forcing::AsPrinted,
        ..Self::PAPER
    };
}

impl Readings {
    /// Every way to read one place otherwise than here: its name, `quantity=variant`, and the whole.
    pub fn neighbours(self) -> Vec<(String, Self)> {
        let mut all = Vec::new();
        macro_rules! places {
            ($($place:ident: $reading:ident),+ $(,)?) => { $(
                for variant in <$reading as Reading>::ALL.iter().filter(|variant| **variant != self.$place) {
                    let name = format!("{}={}", $reading::QUANTITY, variant.name());
                    all.push((name, Self { $place: *variant, ..self }));
                }
            )+ };
        }
        places! {
            position: Position,
            damping: Damping,
            shared_symbol: SharedSymbol,
            gravity: Gravity,
            target: Target,
            air_speed: AirSpeed,
            velocity: VelocityAfterLength,
            drag: Drag,
            exchange: Exchange,
            scheme: Scheme,
            convection: Convection,
            wall_pressure: WallPressure,
            forcing: Forcing,
        }
        all
    }
}

/// The restoring coefficient that the physical set is run with, N/m2: twice the critical one to two digits, so that the
/// tree stands with as much to spare as gravity takes.
///
/// # Errors
///
/// What [`Parameters::check`] refuses; a tree that no coefficient holds up.
pub fn physical_restoring(
    skeleton: &Skeleton,
    given: Parameters,
    readings: Readings,
) -> Result<f64, TreeError> {
    let critical = Linearised::critical_restoring(skeleton, given, readings)?;
    let critical = critical.ok_or(TreeError::Shape("no restoring coefficient holds this tree up"))?;
    if critical <= 0.0 {
        return Ok(given.restoring);
    }
    let digit = libm::exp10(libm::floor(libm::log10(2.0 * critical)) - 1.0);
    Ok(libm::round(2.0 * critical / digit) * digit)
}

/// One of the three sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReadingSet {
    /// [`Readings::PAPER`].
    Paper,
    /// [`Readings::PHYSICAL`].
    Physical,
    /// [`Readings::LITERAL`].
    Literal,
}

impl ReadingSet {
    /// Its readings.
    pub const fn readings(self) -> Readings {
        match self {
            Self::Paper => Readings::PAPER,
            Self::Physical => Readings::PHYSICAL,
            Self::Literal => Readings::LITERAL,
        }
    }
}

impl Reading for ReadingSet {
    const QUANTITY: &'static str = "set";
    const ALL: &'static [Self] = &[Self::Paper, Self::Physical, Self::Literal];

    fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Physical => "physical",
            Self::Literal => "literal",
        }
    }
}
