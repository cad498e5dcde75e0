//! Measuring protocols: stiffness of a filament in twist, stretch, bending and shear.
//!
//! A [`Specimen`] is a filament of any resolution and parameters. A protocol holds its ends and
//! prescribes angles, strains or forces. An end of monomers is held by its last two monomers; at
//! the far end they move as one rigid body. The result is a [`Curve`] with raw values, secant
//! rigidity and certificate of each equilibrium. [`over_samplings_and_azimuths`] measures many samplings
//! of the bonds, and [`sampled_by`] averages their curves.
//!
//! | protocol | held | moved | reads |
//! |---|---|---|---|
//! | [`twist`] | both ends, the far one slides along the axis | turn about the axis | `B3 = tau L / phi`, `dL / L` |
//! | [`stretch_by_force`] | the same, turn blocked | axial force | `S3 = F L / dL` |
//! | [`stretch_by_shift`] | both ends | axial displacement | `S3 = F L / dL` |
//! | [`bend_by_tip_force`] | the near end | transverse force at the free tip | `B = F L^3 / 3 d`, elastica |
//! | [`bend_by_couples`] | both ends in orientation, the far one slides freely | turn across the axis | `B = M / kappa` |
//! | [`bend_twisted`] | both ends in orientation, the far one slides freely | turn about the axis, then across it | `B = M_perp / kappa_perp` |
//! | [`shear_by_force`] | both ends in orientation, the far one slides freely | transverse force | `F / gamma` |
//!
//! [`RotationCorrelations`] averages the relative rotations of cross-sections of a filament in a heat bath.
//!
//! The length `L` is the distance of the clamped points, or of the inner held monomers.
//!
//! ```
//! use actin_paper::measure::{Specimen, twist};
//! use actin_sim::{RodLaw, RodModel};
//! // The rod of Table 4 has B3 = 1.3e4 pN nm^2 at every angle.
//! let rod = Specimen::rod(75.0, None, RodModel::with_law(RodLaw::Constant));
//! let curve = twist(&rod, &[-90.0, 180.0]).unwrap();
//! assert!((curve.points[0].rigidity_pn_nm2 / 1.3e4 - 1.0).abs() < 1e-9);
//! assert!((curve.points[1].torque_pn_nm - 1.3e4 * 3.14159265 / 75.0).abs() < 1e-4);
//! ```

mod axial;
mod elastica;
mod ensemble;
mod error;
mod follow;
mod rotations;
mod specimen;
mod sweep;
mod transverse;

pub use crate::statistics::SampleStatistics;
pub use actin_equilibrium::{Certificate, Stability};
pub use axial::{StretchPoint, TwistPoint, stretch_by_force, stretch_by_shift, twist};
pub use elastica::elastica_deflection;
pub use ensemble::{over_samplings_and_azimuths, sampled_by};
pub use error::MeasureError;
pub use follow::Evidence;
pub(crate) use follow::follow;
pub(crate) use rotations::{ROOM_PN_NM, far_lengths, turns_in_bath};
pub use rotations::{RotationCorrelations, jackknife, steps_in};
pub use specimen::Specimen;
pub use sweep::{Curve, MissingEquilibrium};
pub(crate) use sweep::{far_end_shift, reaction};
pub use transverse::{
    CouplePoint, HelixPoint, ShearPoint, TipForcePoint, bend_by_couples, bend_by_tip_force,
    bend_twisted, shear_by_force,
};

#[cfg(test)]
mod tests;

#[cfg(test)]
mod law_tests;
