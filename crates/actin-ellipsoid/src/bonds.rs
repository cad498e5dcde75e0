//! All bonds of a run of monomers: the term that acts on the state.
//!
//! The loop over bonds is in `kernel.rs`, second derivatives are in `bonds/stiffness.rs`; drawing
//! anchors is in `interface.rs`.

mod energies;
mod stiffness;
mod sums;

use crate::kernel::AddLoads;
use crate::table::{BondTable, Relative};
use crate::{Bond, EllipsoidModel, InterfaceError, InterfaceKind, Monomers};
use actin_mechanics::wide::{self, Arch};
use actin_mechanics::{Interaction, Loads, Matrix3, SecondOrder, State, Vector3};

/// The harmonic bonds of a run of consecutive monomers: term `bonds`, one element per interface.
///
/// A bond from anchor `a` of the lower monomer to anchor `b` of the upper one (body frames) has
/// the energy `k/2 (|d| - L)^2`, where `d` is the vector between the anchors, `L` its rest length
/// and `k` the interface's rigidity times the bond's weight, one over their number for drawn ones. With `d` in the lower body's
/// frame, `f = k (1 - L/|d|) d` acts on the lower monomer and `-f` on the upper one. With
/// `F = sum f`, `T = sum a x f` and `D` the vector between the centres, the torque on the lower
/// monomer is `T`, and that on the upper one, in the lower one's frame, `-(T - D x F)`.
///
/// In the built filament all of these vanish to round-off. Rest lengths are those of the ideal
/// helix, but positions and azimuths are stored to 1e-16 of their own size: with the default
/// parameters forces of about 1e-10 pN remain 100 nm from the origin, and in proportion beyond.
///
/// Loads are summed with as many lanes, and with fused products, as the processor offers; their
/// last digits may differ from one kind of processor to another.
///
/// A bond whose anchors coincide has no direction: it exerts no force then (its energy has a
/// kink there), and never a value that is not finite. Its second derivatives are then those of
/// `k d^2 / 2` alone; nearby, the stiffness across the bond diverges as `-k L / |d|`.
///
/// # Source
/// arXiv 2203.01284, Section 2.1.
#[derive(Clone, Debug)]
pub struct Bonds {
    monomers: Monomers,
    pairs: Vec<Pair>,
    /// Lateral bonds, longitudinal bonds.
    tables: [BondTable; 2],
    arch: Arch,
}

/// Two bonded monomers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Kind of the interface between them.
    pub kind: InterfaceKind,
    /// Place of the lower monomer in the run.
    pub lower: usize,
    /// Place of the upper monomer in the run.
    pub upper: usize,
    /// Number of bonds.
    pub bonds: usize,
    /// Rigidity that the bonds share (pN/nm): the stiffness of each is this times its weight.
    pub rigidity: f64,
}

/// One monomer where it now is.
#[derive(Clone, Copy, Debug)]
struct Body {
    centre: Vector3,
    axes: Matrix3,
}

impl Bonds {
    /// Draws all interfaces within the run whose lower monomer is among the first `lowers`, or looks up
    /// their weighted bonds.
    pub(crate) fn new(
        model: &EllipsoidModel,
        monomers: Monomers,
        lowers: usize,
    ) -> Result<Self, InterfaceError> {
        let lowers = lowers.min(monomers.count);
        let [lateral, longitudinal] = InterfaceKind::ALL;
        let tables = [
            Self::tabulate(model, lateral, &monomers, lowers)?,
            Self::tabulate(model, longitudinal, &monomers, lowers)?,
        ];
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
                        rigidity: kind.parameters(model.parameters()).rigidity,
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

    /// The bonds of all interfaces of one kind.
    fn tabulate(
        model: &EllipsoidModel,
        kind: InterfaceKind,
        monomers: &Monomers,
        lowers: usize,
    ) -> Result<BondTable, InterfaceError> {
        let parameters = kind.parameters(model.parameters());
        let (step, number) = (kind.steps(), parameters.bonds);
        let pairs = monomers.count.saturating_sub(step).min(lowers);
        if model.parameters().anchors.are_shared() && pairs > 0 {
            let interface = model.interface(kind, monomers.first_index)?;
            let rigidity = parameters.rigidity;
            return Ok(BondTable::shared(step, pairs, rigidity, &interface.bonds));
        }
        let mut table = BondTable::new(step, number, parameters.bond_stiffness());
        for lower in 0..pairs {
            let interface = model.interface(kind, monomers.index(lower))?;
            table.push(&interface.bonds);
        }
        Ok(table)
    }

    /// The run of monomers.
    pub fn monomers(&self) -> &Monomers {
        &self.monomers
    }

    /// The bonded pairs in the order of the elements: for each lower monomer the lateral
    /// interface, then the longitudinal one.
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// Number of bonds of all pairs.
    pub fn number_of_bonds(&self) -> usize {
        self.pairs.iter().map(|pair| pair.bonds).sum()
    }

    /// The bonds of one pair.
    pub fn bonds_of(&self, pair: &Pair) -> impl Iterator<Item = Bond> + '_ {
        self.table(pair.kind).bonds_of(pair.lower)
    }

    /// Both ends of every bond of one pair (nm, lab frame): on the lower, then on the upper
    /// monomer.
    pub fn ends_of(&self, pair: &Pair, state: &State) -> impl Iterator<Item = [Vector3; 2]> {
        let lower = self.body(state, pair.lower);
        let upper = self.body(state, pair.upper);
        self.bonds_of(pair)
            .map(move |bond| [lower.to_lab(bond.lower), upper.to_lab(bond.upper)])
    }

    /// The bonds of one kind.
    fn table(&self, kind: InterfaceKind) -> &BondTable {
        let [lateral, longitudinal] = &self.tables;
        match kind {
            InterfaceKind::Lateral => lateral,
            InterfaceKind::Longitudinal => longitudinal,
        }
    }

    /// Monomer `k` of the run.
    fn body(&self, state: &State, k: usize) -> Body {
        let orientation = state.frames.orientation.get(self.monomers.frame(k));
        Body {
            centre: state.points.position.get(self.monomers.point(k)),
            axes: orientation.to_rotation_matrix().into_inner(),
        }
    }
}

impl Body {
    /// A point of the body in the lab frame.
    fn to_lab(self, point: Vector3) -> Vector3 {
        self.centre + self.axes * point
    }

    /// This body as `lower` sees it.
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

#[cfg(test)]
mod tests;
