//! Stable codes of warnings on scenes, for use by other programs.

/// Cubature bonds are too few to represent all bonds of an interface.
pub(crate) const FEW_BONDS: &str = "few-bonds";
/// A rod is so short that the direction of a load across it matters.
pub(crate) const SHORT_ROD: &str = "short-rod";
/// Segments are so long that bending is inaccurate.
pub(crate) const LONG_SEGMENTS: &str = "long-segments";
/// A softened stretch is resolved in part.
pub(crate) const PARTLY_RESOLVED: &str = "partly-resolved";
/// Loads act in full along a path that does not set them.
pub(crate) const PATH_LOADS: &str = "path-loads";
/// The law of a rod is unsuitable for this scene or agrees with few measured numbers.
pub(crate) const ROD_LAW: &str = "rod-law";
/// Filaments overlap with each other or with walls as built.
pub(crate) const OVERLAP: &str = "overlap";
/// Tangent correlations do not determine the persistence length.
pub(crate) const PERSISTENCE_LENGTH: &str = "no-persistence-length";
/// Tangent correlations are at distances at which monomers shorten the persistence length.
pub(crate) const NEAR_CORRELATION: &str = "near-correlation";
/// Sampled interfaces have a large error.
pub(crate) const SAMPLED_INTERFACES: &str = "sampled-interfaces";
/// Chosen sections do not meet the requested error.
pub(crate) const RESOLUTION: &str = "resolution-not-met";
