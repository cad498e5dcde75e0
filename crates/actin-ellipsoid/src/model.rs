//! The validated model: the one place where filaments of ellipsoids are made.

use crate::{
    Bonds, Ellipsoid, EllipsoidParameterError, EllipsoidParameters, Helix, Interface,
    InterfaceError, InterfaceKind, LatticeError, Monomers, Placement,
};
use actin_mechanics::{Inertia, State};

/// Parameters that have been validated, and what follows from them.
///
/// ```
/// use actin_ellipsoid::{EllipsoidModel, EllipsoidParameters, Placement};
/// use actin_mechanics::{Interaction, State};
/// let model = EllipsoidModel::new(EllipsoidParameters::default()).unwrap();
/// let mut state = State::default();
/// let monomers = model.build(&mut state, &Placement::default(), -1, 30).unwrap();
/// let bonds = model.bonds(&monomers).unwrap();
/// assert_eq!(bonds.elements(), 29 + 28); // one per lateral and longitudinal interface
/// assert_eq!(bonds.number_of_bonds(), (29 + 28) * 12);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct EllipsoidModel {
    parameters: EllipsoidParameters,
    inertia: Inertia,
}

impl EllipsoidModel {
    /// The model of the given parameters.
    ///
    /// # Errors
    /// What [`EllipsoidParameters::validate`] refuses, and semi-axes that all differ.
    pub fn new(parameters: EllipsoidParameters) -> Result<Self, EllipsoidParameterError> {
        parameters.validate()?;
        let inertia = Ellipsoid::new(parameters.semi_axes).inertia(parameters.mass)?;
        Ok(Self {
            parameters,
            inertia,
        })
    }

    /// The parameters.
    pub fn parameters(&self) -> &EllipsoidParameters {
        &self.parameters
    }

    /// The helix on which the monomers stand.
    pub fn helix(&self) -> Helix {
        Helix::new(&self.parameters)
    }

    /// The body of one monomer.
    pub fn ellipsoid(&self) -> Ellipsoid {
        Ellipsoid::new(self.parameters.semi_axes)
    }

    /// Inertia of one monomer.
    pub fn inertia(&self) -> Inertia {
        self.inertia
    }

    /// Pushes the `count` monomers from lattice index `first_index` on, at rest, where
    /// `placement` puts them.
    ///
    /// # Errors
    /// [`LatticeError`] if there are none, or if an index is beyond 2^53 either way.
    pub fn build(
        &self,
        state: &mut State,
        placement: &Placement,
        first_index: i64,
        count: usize,
    ) -> Result<Monomers, LatticeError> {
        let body = (self.parameters.mass, self.inertia);
        Monomers::push(&self.helix(), body, placement, (first_index, count), state)
    }

    /// The interface of the given kind whose lower monomer has the given lattice index.
    ///
    /// # Errors
    /// [`InterfaceError`] if no bond is short and long enough, or hardly any, or no weighted bonds are
    /// found.
    pub fn interface(&self, kind: InterfaceKind, index: i64) -> Result<Interface, InterfaceError> {
        Interface::new(&self.parameters, kind, index)
    }

    /// All bonds within a run of monomers.
    ///
    /// # Errors
    /// As [`Self::interface`].
    pub fn bonds(&self, monomers: &Monomers) -> Result<Bonds, InterfaceError> {
        Bonds::new(self, *monomers, monomers.count)
    }

    /// The bonds of a run whose lower monomers are among the first `lowers`: those of a stretch with its own
    /// parameters, whose last monomers are bonded to the first ones of the next.
    ///
    /// # Errors
    /// As [`Self::interface`].
    pub fn bonds_above(&self, monomers: &Monomers, lowers: usize) -> Result<Bonds, InterfaceError> {
        Bonds::new(self, *monomers, lowers)
    }
}
