//! What is disputed in Eq. (1) and (4), and in the lifetime of clouds.

use crate::reading::Reading;

/// The first factor of Eq. (1).
///
/// Transcribed: `act && hum && (...)`. A cell must then be active already, though §2.1 says that these rules grow clouds;
/// Eq. (4), "after that of act", negates its own variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Activation {
    /// `act && hum && ...`.
    AsPrinted,
    /// `!act && hum && ...`, as Eq. (4) has it.
    Negated,
}

impl Reading for Activation {
    const QUANTITY: &'static str = "activation";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::Negated];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::Negated => "negated",
        }
    }
}

/// Where the bracket of Eq. (1) and (4) closes.
///
/// Transcribed: after the six near cells, and a stray one at the end. The five far cells then activate whatever is there,
/// vapour or none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Brackets {
    /// After the six near cells, the stray one dropped: `a && b && (near) || far`.
    AsPrinted,
    /// At the end: `a && b && (near || far)`.
    Mended,
}

impl Reading for Brackets {
    const QUANTITY: &'static str = "brackets";
    const ALL: &'static [Self] = &[Self::AsPrinted, Self::Mended];

    fn name(self) -> &'static str {
        match self {
            Self::AsPrinted => "as-printed",
            Self::Mended => "mended",
        }
    }
}

/// What "no change of state" holds for during the T_ext steps after cloud has come, §2.2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lock {
    /// The cloud: ext passes through it and leaves it.
    Cld,
    /// All four variables.
    All,
}

impl Reading for Lock {
    const QUANTITY: &'static str = "lock";
    const ALL: &'static [Self] = &[Self::Cld, Self::All];

    fn name(self) -> &'static str {
        match self {
            Self::Cld => "cld",
            Self::All => "all",
        }
    }
}

/// The rules of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// The first factor of Eq. (1).
    pub activation: Activation,
    /// The bracket of Eq. (1) and (4).
    pub brackets: Brackets,
    /// What the lifetime holds for.
    pub lock: Lock,
    /// T_ext: for so many steps after a cell has become cloud nothing changes; 0 is none.
    pub lifetime: u8,
}
