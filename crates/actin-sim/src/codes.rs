//! Stable codes of warnings on runs, for use by other programs.

/// Rods exceed the data of their law; results there are extrapolated.
pub(crate) const LAW_RANGE: &str = "law-range";
/// Force along a rod makes its twist unstable.
pub(crate) const UNSTABLE_TWIST: &str = "unstable-twist";
/// Deformations exceed the validity of the model.
pub(crate) const MODEL_LIMIT: &str = "model-limit";
/// The equilibrium is a saddle.
pub(crate) const SADDLE: &str = "saddle";
/// Saddles were left or the path jumped: there are other stable states.
pub(crate) const OTHER_STATES: &str = "other-states";
/// The tolerance is below the round-off of the loads.
pub(crate) const RESIDUAL_FLOOR: &str = "residual-floor";
/// Monomers in place of a rod would have several states.
pub(crate) const MONOMER_STATES: &str = "monomer-states";
/// A loss of twist can be neither detected nor excluded.
pub(crate) const UNKNOWN_TWIST: &str = "unknown-twist";
/// The error of the resolution, or the scatter of sampled bonds, is unknown.
pub(crate) const UNKNOWN_ERROR: &str = "unknown-error";
/// The stability of the state at rest is unknown.
pub(crate) const UNKNOWN_STABILITY: &str = "unknown-stability";
/// The energy balance has a large time-stepping error.
pub(crate) const ENERGY_BALANCE: &str = "energy-balance";
/// Averaged forces of linkers are late along a path.
pub(crate) const LINKER_AVERAGING: &str = "linker-averaging";
/// Rates of linkers are fast compared with the time step.
pub(crate) const LINKER_RATES: &str = "linker-rates";
/// Time steps are longer than slow motion allows.
pub(crate) const LONG_STEPS: &str = "long-steps";
/// Contacts act late in the time steps.
pub(crate) const CONTACT_STEPS: &str = "contact-steps";
/// Energies differ in steps of half the length.
pub(crate) const STEP_ERROR: &str = "step-error";
/// Drag is strong within a time step.
pub(crate) const STRONG_DRAG: &str = "strong-drag";
/// Means cover fewer than two records.
pub(crate) const FEW_RECORDS: &str = "few-records";

#[cfg(test)]
mod tests {
    /// Codes of scenes are in actin-assembly.
    #[test]
    fn codes_are_documented() {
        let page = include_str!("../../../docs/reference/troubleshooting.md");
        let files = [
            include_str!("codes.rs"),
            include_str!("../../actin-assembly/src/notes/codes.rs"),
        ];
        let lines = files.into_iter().flat_map(str::lines);
        let constants = lines.filter_map(|line| line.strip_prefix("pub(crate) const "));
        let mut codes: Vec<&str> = constants
            .filter_map(|line| line.split('"').nth(1))
            .collect();
        for code in &codes {
            assert!(page.contains(&format!("| `{code}` |")), "{code}");
        }
        let count = codes.len();
        codes.sort_unstable();
        codes.dedup();
        assert!(count > 20 && codes.len() == count, "{codes:?}");
    }
}
