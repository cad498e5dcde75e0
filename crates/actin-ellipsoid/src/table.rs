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
    /// Weights of the bonds of a pair; empty for equal weights.
    weights: Vec<f64>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    pub(crate) records: &'a [Record],
    pub(crate) weights: &'a [f64],
}

/// Current pose of the upper body in the frame of the lower one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relative {
    pub(crate) rotation: Matrix3,
    pub(crate) offset: Vector3,
}

impl BondTable {
    /// Table without pairs, for bonds of equal weight that differ between pairs.
    pub(crate) fn new(step: usize, bonds: usize, stiffness: f64) -> Self {
        Self {
            step,
            bonds,
            stiffness,
            pairs: 0,
            records: Vec::new(),
            shared: false,
            weights: Vec::new(),
        }
    }

    pub(crate) fn shared(step: usize, pairs: usize, rigidity: f64, bonds: &[Bond]) -> Self {
        let mut table = Self::new(step, bonds.len(), rigidity / bonds.len() as f64);
        for _ in 0..GROUP {
            table.push(bonds);
        }
        let is_alike = |pair: &[Bond]| pair[0].weight.to_bits() == pair[1].weight.to_bits();
        if !bonds.windows(2).all(is_alike) {
            table.weights = bonds.iter().map(|bond| bond.weight).collect();
            table.stiffness = rigidity;
        }
        Self {
            pairs,
            shared: true,
            ..table
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
        self.pairs += 1;
    }

    #[inline]
    pub(crate) fn group(&self, pair: usize) -> Group<'_> {
        let group = if self.shared { 0 } else { pair / GROUP };
        let start = group * self.bonds;
        Group {
            records: &self.records[start..start + self.bonds],
            weights: &self.weights,
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
                weight: weights.get(k).copied().unwrap_or(alike),
            }
        })
    }
}
