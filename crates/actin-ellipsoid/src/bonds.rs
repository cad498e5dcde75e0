//! Interaction of all bonds of a run of monomers.

mod energies;
mod stiffness;
mod sums;

use crate::kernel::AddLoads;
use crate::table::{BondTable, Relative};
use crate::{
    Anchors, Bond, EllipsoidModel, EllipsoidParameters, InterfaceError, InterfaceKind, Monomers,
};
use actin_mechanics::wide::{self, Arch};
use actin_mechanics::{Interaction, Loads, Matrix3, SecondOrder, State, Vector3};

/// Harmonic bonds of a run of consecutive monomers: term `bonds`, one element per interface.
///
/// ```text
/// E   = k/2 (|d| - L)^2
/// f   = k (1 - L/|d|) d             force of one bond on the lower monomer
/// F   = sum f,  T = sum a x f       force and torque on the lower monomer
/// -F, -(T - D x F)                  force and torque on the upper monomer
///
/// a, b   anchors on the lower and upper monomer (nm, body frames)
/// d      vector from a to b (nm)
/// D      vector between the centres (nm)
/// L      rest length (nm)
/// k      rigidity of the interface times the weight of the bond (pN/nm)
/// ```
///
/// Other vectors are in the body frame of the lower monomer.
///
/// Rounding leaves forces of about 1e-10 pN in the built filament 100 nm from the origin, in
/// proportion to the distance. The last digits of loads depend on the processor.
///
/// A bond of zero length exerts no force. Its second derivatives are then those of `k d^2 / 2`.
/// Near zero length the transverse stiffness diverges as `-k L / |d|`.
///
/// # Source
/// arXiv 2203.01284, Section 2.1.
#[derive(Clone, Debug)]
pub struct Bonds {
    monomers: Monomers,
    pairs: Vec<Pair>,
    tables: [BondTable; 2],
    arch: Arch,
}

/// Two bonded monomers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Kind of the interface between them.
    pub kind: InterfaceKind,
    /// Index of the lower monomer in the run.
    pub lower: usize,
    /// Index of the upper monomer in the run.
    pub upper: usize,
    /// Number of bonds.
    pub bonds: usize,
    /// Rigidity of the interface (pN/nm). The stiffness of a bond is this times its weight.
    pub rigidity: f64,
}

#[derive(Clone, Copy, Debug)]
struct Body {
    centre: Vector3,
    axes: Matrix3,
}

impl Bonds {
    /// Bonds of all interfaces whose lower monomer is among the first `lowers` of the run. Later
    /// monomers have the turn `next_turn`.
    pub(crate) fn new(
        model: &EllipsoidModel,
        monomers: Monomers,
        lowers: usize,
        next_turn: f64,
    ) -> Result<Self, InterfaceError> {
        let lowers = lowers.min(monomers.count);
        let [lateral, longitudinal] = InterfaceKind::ALL;
        let tabulate = |kind| Self::tabulate(model, kind, &monomers, (lowers, next_turn));
        let tables = [tabulate(lateral)?, tabulate(longitudinal)?];
        let mut pairs = Vec::new();
        for lower in 0..lowers {
            for (kind, table) in InterfaceKind::ALL.into_iter().zip(&tables) {
                let upper = lower + table.step;
                if upper < monomers.count {
                    pairs.push(Pair {
                        kind,
                        lower,
                        upper,
                        bonds: table.bonds,
                        rigidity: model.parameters().interface(kind).rigidity,
                    });
                }
            }
        }
        Ok(Self {
            monomers,
            pairs,
            tables,
            arch: wide::arch(),
        })
    }

    fn tabulate(
        model: &EllipsoidModel,
        kind: InterfaceKind,
        monomers: &Monomers,
        (lowers, next_turn): (usize, f64),
    ) -> Result<BondTable, InterfaceError> {
        let EllipsoidParameters { anchors, turn, .. } = *model.parameters();
        let parameters = model.parameters().interface(kind);
        let (step, number) = (kind.steps(), parameters.bonds);
        let pairs = monomers.count.saturating_sub(step).min(lowers);
        let is_weighted = anchors == Anchors::Cubature;
        let mut table = BondTable::new(step, number, parameters.rigidity, is_weighted);
        let inside = if next_turn.to_bits() == turn.to_bits() {
            pairs
        } else {
            pairs.min(lowers.saturating_sub(step))
        };
        let shared = (anchors.are_shared() && inside > 0)
            .then(|| model.interface(kind, monomers.first_index))
            .transpose()?;
        if let Some(shared) = shared.as_ref().filter(|_| inside == pairs) {
            return Ok(table.shared_by(pairs, &shared.bonds));
        }
        for lower in 0..pairs {
            let index = monomers.index(lower);
            let beyond = (lower + step + 1).saturating_sub(lowers) as f64 - 0.5;
            match &shared {
                Some(shared) if lower < inside => table.push(&shared.bonds),
                _ if lower < inside => table.push(&model.interface(kind, index)?.bonds),
                _ => {
                    let mean = turn + (next_turn - turn) * beyond / step as f64;
                    table.push(&model.with_turn(mean).interface(kind, index)?.bonds);
                }
            }
        }
        Ok(table)
    }

    /// The run of monomers.
    pub fn monomers(&self) -> &Monomers {
        &self.monomers
    }

    /// Bonded pairs in the order of the elements: the lateral interface of each lower monomer, then
    /// the longitudinal one.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// Number of bonds of all pairs.
    pub fn number_of_bonds(&self) -> usize {
        self.pairs.iter().map(|pair| pair.bonds).sum()
    }

    /// Bonds of one pair.
    pub fn bonds_of(&self, pair: &Pair) -> impl Iterator<Item = Bond> + '_ {
        self.table(pair.kind).bonds_of(pair.lower)
    }

    /// Ends of every bond of one pair (nm, lab frame): on the lower monomer, then on the upper one.
    pub fn ends_of(&self, pair: &Pair, state: &State) -> impl Iterator<Item = [Vector3; 2]> {
        let lower = self.body(state, pair.lower);
        let upper = self.body(state, pair.upper);
        self.bonds_of(pair)
            .map(move |bond| [lower.to_lab(bond.lower), upper.to_lab(bond.upper)])
    }

    fn table(&self, kind: InterfaceKind) -> &BondTable {
        let [lateral, longitudinal] = &self.tables;
        match kind {
            InterfaceKind::Lateral => lateral,
            InterfaceKind::Longitudinal => longitudinal,
        }
    }

    fn body(&self, state: &State, k: usize) -> Body {
        let orientation = state.frames.orientation.get(self.monomers.frame(k));
        Body {
            centre: state.points.position.get(self.monomers.point(k)),
            axes: orientation.to_rotation_matrix().into_inner(),
        }
    }
}

impl Body {
    fn to_lab(self, point: Vector3) -> Vector3 {
        self.centre + self.axes * point
    }

    fn relative_to(&self, lower: &Self) -> Relative {
        Relative {
            rotation: lower.axes.tr_mul(&self.axes),
            offset: lower.axes.tr_mul(&(self.centre - lower.centre)),
        }
    }
}

impl Interaction for Bonds {
    fn term(&self) -> &'static str {
        "bonds"
    }

    fn add_loads(&self, state: &State, loads: &mut Loads) {
        self.arch.dispatch(AddLoads {
            monomers: self.monomers,
            tables: &self.tables,
            state,
            loads,
        });
    }

    fn second_order(&self) -> Option<&dyn SecondOrder> {
        Some(self)
    }

    fn elements(&self) -> usize {
        self.pairs.len()
    }

    fn write_energies(&self, state: &State, energies: &mut [f64]) {
        assert_eq!(energies.len(), self.elements(), "one energy per interface");
        self.write_pairs(state, energies);
    }
}

impl EllipsoidModel {
    /// All bonds within a run of monomers.
    ///
    /// # Errors
    /// As [`Self::interface`].
    pub fn bonds(&self, monomers: &Monomers) -> Result<Bonds, InterfaceError> {
        self.bonds_above(monomers, monomers.count, self.parameters().turn)
    }

    /// Bonds of a run whose lower monomers are among the first `lowers`. They join a section with
    /// its own parameters to the first monomers of the next section, whose turn per monomer (rad) is
    /// `next_turn`. The turn changes in the middle between the sections.
    ///
    /// # Errors
    /// As [`Self::interface`].
    pub fn bonds_above(
        &self,
        monomers: &Monomers,
        lowers: usize,
        next_turn: f64,
    ) -> Result<Bonds, InterfaceError> {
        Bonds::new(self, *monomers, lowers, next_turn)
    }
}

#[cfg(test)]
mod tests;
