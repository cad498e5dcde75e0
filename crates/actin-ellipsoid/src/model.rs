//! Ellipsoid model.

use crate::{
    Ellipsoid, EllipsoidParameterError, EllipsoidParameters, Helix, Interface, InterfaceError,
    InterfaceKind, LatticeError, Monomers, Placement,
};
use actin_mechanics::{Inertia, State};

/// Ellipsoid model with validated parameters.
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
    /// Model with the given parameters.
    ///
    /// # Errors
    /// Invalid parameters (`EllipsoidParameters::validate`) or three different semi-axes.
    pub fn new(parameters: EllipsoidParameters) -> Result<Self, EllipsoidParameterError> {
        parameters.validate()?;
        let inertia = Ellipsoid::new(parameters.semi_axes).inertia(parameters.mass)?;
        Ok(Self {
            parameters,
            inertia,
        })
    }

    /// Parameters of the model.
    pub fn parameters(&self) -> &EllipsoidParameters {
        &self.parameters
    }

    /// Model with another turn per monomer (rad).
    #[must_use]
    pub fn with_turn(&self, turn: f64) -> Self {
        let mut model = self.clone();
        model.parameters.turn = turn;
        model
    }

    /// Helix of the monomers.
    pub fn helix(&self) -> Helix {
        Helix::new(&self.parameters)
    }

    /// Appends `count` monomers at rest, starting with lattice index `first_index`, to a state.
    ///
    /// # Errors
    /// [`LatticeError`] if `count` is 0, an index exceeds 2^53 in magnitude, or the placement is
    /// not finite.
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

    /// Interface of the given kind above the given lattice index.
    ///
    /// # Errors
    /// [`InterfaceError`] if too few samples give a bond or the quadrature fails.
    pub fn interface(&self, kind: InterfaceKind, index: i64) -> Result<Interface, InterfaceError> {
        Interface::new(&self.parameters, kind, index)
    }
}
