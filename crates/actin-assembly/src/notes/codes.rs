//! Stable codes of warnings, for use by other programs.

/// Rods exceed the data of their law; results there are extrapolated.
pub const LAW_RANGE: &str = "law-range";
/// Force along a rod makes its twist unstable.
pub const UNSTABLE_TWIST: &str = "unstable-twist";
/// Deformations exceed the validity of the model.
pub const MODEL_LIMIT: &str = "model-limit";
/// The equilibrium is a saddle.
pub const SADDLE: &str = "saddle";
/// Saddles were left or the path jumped: there are other stable states.
pub const OTHER_STATES: &str = "other-states";
/// The tolerance is below the round-off of the loads.
pub const RESIDUAL_FLOOR: &str = "residual-floor";
/// Cubature bonds are too few to represent all bonds of an interface.
pub const FEW_BONDS: &str = "few-bonds";
/// A rod is so short that the direction of a load across it matters.
pub const SHORT_ROD: &str = "short-rod";
/// Segments are so long that bending is inaccurate.
pub const LONG_SEGMENTS: &str = "long-segments";
/// Loads act in full along a path that does not set them.
pub const PATH_LOADS: &str = "path-loads";
/// The law of a rod is unsuitable for this scene or agrees with few measured numbers.
pub const ROD_LAW: &str = "rod-law";
/// Filaments overlap with each other or with walls as built.
pub const OVERLAP: &str = "overlap";
/// Tangent correlations have causes besides heat.
pub const PERSISTENCE_LENGTH: &str = "no-persistence-length";
/// Sampled interfaces have a large error.
pub const SAMPLED_INTERFACES: &str = "sampled-interfaces";
/// Chosen sections do not meet the requested error.
pub const RESOLUTION: &str = "resolution-not-met";
/// Monomers in place of a rod would have several states.
pub const MONOMER_STATES: &str = "monomer-states";
/// A loss of twist can be neither detected nor excluded.
pub const UNKNOWN_TWIST: &str = "unknown-twist";
/// The error of the resolution, or the scatter of sampled bonds, is unknown.
pub const UNKNOWN_ERROR: &str = "unknown-error";
/// The stability of the state at rest is unknown.
pub const UNKNOWN_STABILITY: &str = "unknown-stability";
/// The energy balance has a large time-stepping error.
pub const ENERGY_BALANCE: &str = "energy-balance";
/// Rates of linkers are fast compared with the time step.
pub const LINKER_RATES: &str = "linker-rates";
/// Time steps are longer than slow motion allows.
pub const LONG_STEPS: &str = "long-steps";
/// Energies differ in steps of half the length.
pub const STEP_ERROR: &str = "step-error";
/// Drag is strong within a time step.
pub const STRONG_DRAG: &str = "strong-drag";
/// Means cover fewer than two records.
pub const FEW_RECORDS: &str = "few-records";

/// All codes.
#[cfg(test)]
pub(super) const ALL: [&str; 25] = [
    LAW_RANGE,
    UNSTABLE_TWIST,
    MODEL_LIMIT,
    SADDLE,
    OTHER_STATES,
    RESIDUAL_FLOOR,
    FEW_BONDS,
    SHORT_ROD,
    LONG_SEGMENTS,
    PATH_LOADS,
    ROD_LAW,
    OVERLAP,
    PERSISTENCE_LENGTH,
    SAMPLED_INTERFACES,
    RESOLUTION,
    MONOMER_STATES,
    UNKNOWN_TWIST,
    UNKNOWN_ERROR,
    UNKNOWN_STABILITY,
    ENERGY_BALANCE,
    LINKER_RATES,
    LONG_STEPS,
    STEP_ERROR,
    STRONG_DRAG,
    FEW_RECORDS,
];
