//! How bonds are stored for the hot loop: neighbouring pairs of monomers side by side.

use crate::Bond;
use actin_mechanics::{Matrix3, Vector3};

/// Pairs that stand side by side: a multiple of the lanes of every machine so far.
pub(crate) const GROUP: usize = 8;

/// One bond of each pair of a group: end on the lower body, end on the upper one (each in its
/// body's frame), rest length; where there is no pair all zero, or those that pairs share.
pub(crate) type Record = [[f64; GROUP]; 7];

/// The bonds of all interfaces of one kind in a run of bodies; every interface has equally many.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct BondTable {
    /// Steps along the run from the lower to the upper body.
    pub(crate) step: usize,
    /// Bonds of each pair.
    pub(crate) bonds: usize,
    /// Stiffness of each bond; of weighted ones that of all together.
    pub(crate) stiffness: f64,
    /// Number of pairs.
    pub(crate) pairs: usize,
    /// For each group of pairs one record per bond; one group for all if pairs share their bonds.
    records: Vec<Record>,
    /// Whether they do.
    shared: bool,
    /// Weights of the bonds of each pair; none where all are alike.
    weights: Vec<f64>,
}

/// The bonds of a group of pairs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group<'a> {
    /// One per bond.
    pub(crate) records: &'a [Record],
    /// One per bond, or none where all are alike.
    pub(crate) weights: &'a [f64],
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
    /// A table without pairs, each of which has alike bonds of its own.
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

    /// A table of so many pairs that share their bonds.
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

    /// The bonds of the group that holds the pair of lower body `pair`.
    #[inline]
    pub(crate) fn group(&self, pair: usize) -> Group<'_> {
        let group = if self.shared { 0 } else { pair / GROUP };
        let start = group * self.bonds;
        Group {
            records: &self.records[start..start + self.bonds],
            weights: &self.weights,
        }
    }

    /// The bonds of one pair.
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
