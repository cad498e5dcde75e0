//! How bonds are stored for the hot loop: neighbouring pairs of monomers side by side.

use crate::Bond;
use actin_mechanics::{Matrix3, Vector3};

/// Pairs that stand side by side: a multiple of the lanes of every machine so far.
pub(crate) const GROUP: usize = 8;

/// One bond of each pair of a group: end on the lower body, end on the upper one (each in its
/// body's frame), rest length; all zero where there is no pair.
pub(crate) type Record = [[f64; GROUP]; 7];

/// The bonds of all interfaces of one kind in a run of bodies; every interface has equally many.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BondTable {
    /// Steps along the run from the lower to the upper body.
    pub(crate) step: usize,
    /// Bonds of each pair.
    pub(crate) bonds: usize,
    /// Stiffness of each bond.
    pub(crate) stiffness: f64,
    /// Number of pairs.
    pub(crate) pairs: usize,
    /// For each group of pairs one record per bond.
    records: Vec<Record>,
}

/// The upper body of a pair as the lower one now sees it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative {
    /// Rotation from the upper body's frame to the lower one's.
    pub(crate) rotation: Matrix3,
    /// Upper centre minus lower centre, lower body's frame.
    pub(crate) offset: Vector3,
}

impl BondTable {
    /// A table without pairs.
    pub(crate) fn new(step: usize, bonds: usize, stiffness: f64) -> Self {
        Self {
            step,
            bonds,
            stiffness,
            pairs: 0,
            records: Vec::new(),
        }
    }

    /// Appends the pair with the next lower body.
    pub(crate) fn push(&mut self, bonds: &[Bond]) {
        let lane = self.pairs % GROUP;
        if lane == 0 {
            let length = self.records.len() + self.bonds;
            self.records.resize(length, Record::default());
        }
        let start = self.records.len() - self.bonds;
        for (record, bond) in self.records[start..].iter_mut().zip(bonds) {
            let ends = bond.lower.iter().chain(bond.upper.iter());
            for (lanes, value) in record.iter_mut().zip(ends.chain([&bond.rest_length])) {
                lanes[lane] = *value;
            }
        }
        self.pairs += 1;
    }

    /// The records of the group that holds the pair of lower body `pair`.
    #[inline]
    pub(crate) fn group(&self, pair: usize) -> &[Record] {
        let start = pair / GROUP * self.bonds;
        &self.records[start..start + self.bonds]
    }

    /// The bonds of one pair.
    pub(crate) fn bonds_of(&self, pair: usize) -> impl Iterator<Item = Bond> + '_ {
        self.group(pair).iter().map(move |record| {
            let [ax, ay, az, bx, by, bz, rest_length] = record.map(|lanes| lanes[pair % GROUP]);
            Bond {
                lower: Vector3::new(ax, ay, az),
                upper: Vector3::new(bx, by, bz),
                rest_length,
            }
        })
    }
}
