use actin_mechanics::{ControlId, State, Vector3};

/// Periodic box with a shear of x along z. Its images are displaced by
///
/// ```text
/// r_n = (n_x L_x + c g n_z L_z, n_y L_y, n_z L_z)
/// ```
///
/// `n` are integers, `L` the edges (nm), `g` is the strain, and `c` its factor, a control of the state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicCell {
    /// Edges `L` (nm).
    pub size: Vector3,
    /// Strain `g`.
    pub strain: f64,
    /// Factor `c`.
    pub factor: ControlId,
}

/// Periodic image of a site.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodicImage {
    /// Periodic box.
    pub cell: PeriodicCell,
    /// Index `n` of the image, or `None` for the nearest image.
    pub index: Option<[i32; 3]>,
}

impl PeriodicCell {
    /// Displacement of an image (nm, lab frame).
    pub fn displacement(&self, index: [i32; 3], state: &State) -> Vector3 {
        self.lattice(state).shift(index.map(f64::from).into())
    }

    /// Position in the box, with fractions of the edges from 0 to 1 (nm, lab frame).
    pub fn wrap(&self, place: Vector3, state: &State) -> Vector3 {
        let lattice = self.lattice(state);
        place - lattice.shift(lattice.fractions(place).map(f64::floor))
    }

    /// Displacement of the image for which `d` plus the displacement is shortest, for vectors `d` (nm, lab frame) to
    /// images closer than half an edge.
    pub fn to_nearest(&self, d: Vector3, state: &State) -> Vector3 {
        let lattice = self.lattice(state);
        -lattice.shift(lattice.fractions(d).map(f64::round))
    }

    /// Lattice of the images in `state`.
    pub(crate) fn lattice(&self, state: &State) -> Lattice {
        Lattice {
            size: self.size,
            strain: self.strain * state.controls[self.factor],
        }
    }
}

/// Lattice of periodic images in one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lattice {
    /// Edges without strain (nm).
    pub(crate) size: Vector3,
    /// Shear strain `dx/dz`.
    pub(crate) strain: f64,
}

impl Lattice {
    /// Displacement of an image (nm, lab frame).
    pub(crate) fn shift(&self, index: Vector3) -> Vector3 {
        let unstrained = index.component_mul(&self.size);
        unstrained + Vector3::x() * (self.strain * unstrained.z)
    }

    /// Position without strain (nm).
    pub(crate) fn unstrained(&self, place: Vector3) -> Vector3 {
        place - Vector3::x() * (self.strain * place.z)
    }

    /// Position in units of the edges, without strain.
    pub(crate) fn fractions(&self, place: Vector3) -> Vector3 {
        self.unstrained(place).component_div(&self.size)
    }
}

impl PeriodicImage {
    /// Displacement of the image of a site at the vector `d` from another site (nm, lab frame).
    pub(crate) fn displacement(&self, d: Vector3, state: &State) -> Vector3 {
        match self.index {
            Some(index) => self.cell.displacement(index, state),
            None => self.cell.to_nearest(d, state),
        }
    }
}
