//! Storage of bonds, vectorised over neighbouring pairs.

use crate::Bond;
use actin_mechanics::{Matrix3, Vector3};

/// Pairs per group: a multiple of the lanes of all supported processors.
pub(crate) const GROUP: usize = 8;

/// Lower anchor, upper anchor (body frames) and rest length of one bond of each pair.
pub(crate) type Record = [[f64; GROUP]; 7];

/// Bonds of all interfaces of one kind in a run.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BondTable {
    pub(crate) step: usize,
    pub(crate) bonds: usize,
    /// Stiffness of each bond, or total stiffness of weighted bonds.
    pub(crate) stiffness: f64,
    pub(crate) pairs: usize,
    /// One record per bond for each group of pairs, or for a single group if bonds are shared.
    records: Vec<Record>,
    shared: bool,
    is_weighted: bool,
    /// Weights of the bonds in the order of the records; empty for equal weights.
    weights: Vec<[f64; GROUP]>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    pub(crate) records: &'a [Record],
    pub(crate) weights: &'a [[f64; GROUP]],
}

/// Current pose of the upper body in the frame of the lower one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative {
    pub(crate) rotation: Matrix3,
    pub(crate) offset: Vector3,
}

impl BondTable {
    /// Table without pairs, for interfaces of this rigidity (pN/nm).
    pub(crate) fn new(step: usize, bonds: usize, rigidity: f64, is_weighted: bool) -> Self {
        let share = if is_weighted { 1.0 } else { bonds as f64 };
        Self {
            step,
            bonds,
            stiffness: rigidity / share,
            pairs: 0,
            records: Vec::new(),
            shared: false,
            is_weighted,
            weights: Vec::new(),
        }
    }

    /// The same bonds for all pairs.
    pub(crate) fn shared_by(mut self, pairs: usize, bonds: &[Bond]) -> Self {
        for _ in 0..GROUP {
            self.push(bonds);
        }
        Self {
            pairs,
            shared: true,
            ..self
        }
    }

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
        if self.is_weighted {
            self.weights.resize(self.records.len(), [0.0; GROUP]);
            for (lanes, bond) in self.weights[start..].iter_mut().zip(bonds) {
                lanes[lane] = bond.weight;
            }
        }
        self.pairs += 1;
    }

    #[inline]
    pub(crate) fn group(&self, pair: usize) -> Group<'_> {
        let group = if self.shared { 0 } else { pair / GROUP };
        let bonds = group * self.bonds..(group + 1) * self.bonds;
        Group {
            records: &self.records[bonds.clone()],
            weights: self.weights.get(bonds).unwrap_or_default(),
        }
    }

    pub(crate) fn bonds_of(&self, pair: usize) -> impl Iterator<Item = Bond> + '_ {
        let Group { records, weights } = self.group(pair);
        let alike = 1.0 / self.bonds as f64;
        records.iter().enumerate().map(move |(k, record)| {
            let [ax, ay, az, bx, by, bz, rest_length] = record.map(|lanes| lanes[pair % GROUP]);
            Bond {
                lower: Vector3::new(ax, ay, az),
                upper: Vector3::new(bx, by, bz),
                rest_length,
                weight: weights.get(k).map_or(alike, |lanes| lanes[pair % GROUP]),
            }
        })
    }
}
