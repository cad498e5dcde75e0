//! Moments of relative poses.

use super::{Link, Pose, QuasiHarmonic};
use crate::{Monomers, SixMatrix, SixVector};
use actin_mechanics::State;
use thiserror::Error;

/// Means of displacements of links, of their squares, and of their products with the link below,
/// over states of thermal motion.
#[derive(Clone, Debug)]
pub struct Fluctuations {
    monomers: Monomers,
    built: Vec<Pose>,
    sums: Vec<Sums>,
    states: u64,
}

#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    displacement: SixVector,
    product: SixMatrix,
    /// Displacement (rows) times displacement of the link below (columns).
    with_below: SixMatrix,
}

/// Error of a singular covariance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "the displacements of link {link} in {states} states span fewer than six directions or are not finite: use more states or shorter time steps"
)]
pub struct FluctuationsError {
    /// Index of the link in the run.
    pub link: usize,
    /// Number of states.
    pub states: u64,
}

impl Fluctuations {
    /// Empty statistics of a run of monomers, with the built state as reference.
    pub fn new(monomers: &Monomers, built: &State) -> Self {
        let links = 0..monomers.count.saturating_sub(1);
        let built: Vec<Pose> = links.map(|k| Pose::from_link(monomers, k, built)).collect();
        Self {
            monomers: *monomers,
            sums: vec![Sums::default(); built.len()],
            built,
            states: 0,
        }
    }

    /// Adds a state.
    pub fn add(&mut self, state: &State) {
        self.states += 1;
        let mut below = SixVector::zeros();
        for (k, (sums, built)) in self.sums.iter_mut().zip(&self.built).enumerate() {
            let own = Pose::from_link(&self.monomers, k, state).displacements(built);
            sums.displacement += own;
            sums.product += own * own.transpose();
            sums.with_below += own * below.transpose();
            below = own;
        }
    }

    /// Adds the states of other statistics of the same run.
    pub fn add_all(&mut self, other: &Self) {
        self.states += other.states;
        for (own, other) in self.sums.iter_mut().zip(&other.sums) {
            own.displacement += other.displacement;
            own.product += other.product;
            own.with_below += other.with_below;
        }
    }

    /// Root mean square relative deviation of the variances of strains from those of a chain at
    /// `thermal_energy` (pN nm), over all links and six directions.
    ///
    /// # Panics
    /// If the chain has a different number of monomers.
    pub fn distance_from(&self, chain: &QuasiHarmonic, thermal_energy: f64) -> f64 {
        assert_eq!(
            chain.links.len(),
            self.sums.len(),
            "numbers of monomers must agree"
        );
        let mut squares = 0.0;
        let mut below: Option<(Moments, SixMatrix)> = None;
        for (k, link) in chain.links.iter().enumerate() {
            let own = Moments {
                mean: self.mean(k),
                about: link.pose.displacements(&self.built[k]),
            };
            let product = own.product_with(&own, &self.mean_of(&self.sums[k].product));
            let mut strain = product;
            if let Some((moments, of_below)) = &below {
                let mixed = own.product_with(moments, &self.mean_of(&self.sums[k].with_below));
                let followed = mixed * link.follows.transpose();
                strain += link.follows * of_below * link.follows.transpose();
                strain -= followed + followed.transpose();
            }
            let root = (link.stiffness / thermal_energy).cholesky();
            let relative = root.map_or(strain, |root| root.l().tr_mul(&strain) * root.l());
            squares += relative.diagonal().add_scalar(-1.0).norm_squared();
            below = Some((own, product));
        }
        (squares / (6.0 * self.sums.len().max(1) as f64)).sqrt()
    }

    fn mean(&self, k: usize) -> SixVector {
        self.sums[k].displacement / self.states.max(1) as f64
    }

    fn mean_of(&self, sum: &SixMatrix) -> SixMatrix {
        sum / self.states.max(1) as f64
    }

    /// Chain with these moments at `thermal_energy` (pN nm).
    ///
    /// # Errors
    /// [`FluctuationsError`] if the number of states is too small.
    pub fn chain(&self, thermal_energy: f64) -> Result<QuasiHarmonic, FluctuationsError> {
        let mut links = Vec::with_capacity(self.sums.len());
        let mut below: Option<(Moments, SixMatrix)> = None;
        for (link, (sums, built)) in self.sums.iter().zip(&self.built).enumerate() {
            let refused = FluctuationsError {
                link,
                states: self.states,
            };
            let mean = self.mean(link);
            let own = Moments { mean, about: mean };
            let product = symmetric(&own.product_with(&own, &self.mean_of(&sums.product)));
            let (mut follows, mut left) = (SixMatrix::zeros(), product);
            if let Some((moments, of_below)) = &below {
                let mixed = own.product_with(moments, &self.mean_of(&sums.with_below));
                follows = mixed * of_below.cholesky().ok_or(refused)?.inverse();
                left = symmetric(&(product - follows * mixed.transpose()));
            }
            let left = left.cholesky().ok_or(refused)?;
            links.push(Link {
                pose: built.displaced(&mean),
                follows,
                stiffness: symmetric(&left.inverse()) * thermal_energy,
            });
            below = Some((own, product));
        }
        Ok(QuasiHarmonic::new(self.monomers, links))
    }
}

struct Moments {
    mean: SixVector,
    about: SixVector,
}

impl Moments {
    /// `<(u - a) (v - b)^T>` from `<u v^T>`.
    fn product_with(&self, other: &Self, product: &SixMatrix) -> SixMatrix {
        product - self.about * other.mean.transpose() - self.mean * other.about.transpose()
            + self.about * other.about.transpose()
    }
}

fn symmetric(m: &SixMatrix) -> SixMatrix {
    0.5 * (m + m.transpose())
}
