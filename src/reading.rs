//! A reading: one way to execute an equation on which page, units and figures disagree.

/// An enum of readings, which stands beside the function that evaluates the equation.
pub trait Reading: Copy + PartialEq + 'static {
    /// What is read, in kebab-case: `inflow`.
    const QUANTITY: &'static str;
    /// Every reading, `AsPrinted` first where the page can be executed.
    const ALL: &'static [Self];

    /// The variant, in kebab-case: `as-printed`.
    fn name(self) -> &'static str;

    /// The reading of this name.
    fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|reading| reading.name() == name)
    }

    /// The names of all readings, for a message.
    fn names() -> String {
        Self::ALL.iter().map(|reading| reading.name()).collect::<Vec<_>>().join(", ")
    }
}
