//! Moments of the bonds of an interface that determine its energy.
//!
//! A relative motion of the monomers shears a bond of length `L` at transverse position `rho` by
//! `s` and extends it by `p`, both linear in `rho` for small rotations. Its length changes by
//!
//! ```text
//! p + s^2 / 2L - p s^2 / 2L^2 - s^4 / 8L^3 + ...
//! ```

use super::patch::Share;

/// Highest degree in `rho` for each power of `1 / L`.
const DEGREES: [usize; 4] = [2, 3, 4, 4];

/// Number of moments: 6 + 10 + 15 + 15.
pub(crate) const MOMENTS: usize = 46;

/// Position and inverse length of a bond, in units of their root mean squares.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Site {
    pub(crate) place: [f64; 2],
    pub(crate) inverse: f64,
}

pub(crate) type Features = [f64; MOMENTS];

#[derive(Clone, Debug)]
pub(crate) struct Moments {
    /// Root mean square distance from the line of centres (nm).
    pub(crate) distance: f64,
    /// Root mean square of the inverse length (1/nm).
    pub(crate) inverse: f64,
    averages: Features,
    sizes: Features,
}

type Powers = [f64; 5];

impl Site {
    pub(crate) fn features(&self) -> Features {
        let mut features = [0.0; MOMENTS];
        let ([x, y], u) = (self.place.map(powers), powers(self.inverse));
        for (feature, (i, j, k)) in features.iter_mut().zip(exponents()) {
            *feature = x[i] * y[j] * u[k];
        }
        features
    }

    pub(crate) fn slopes(&self) -> [Features; 3] {
        let mut slopes = [[0.0; MOMENTS]; 3];
        let ([x, y], u) = (self.place.map(powers), powers(self.inverse));
        let ([dx, dy], du) = ([x, y].map(falling), falling(u));
        for (f, (i, j, k)) in exponents().enumerate() {
            slopes[0][f] = dx[i] * y[j] * u[k];
            slopes[1][f] = x[i] * dy[j] * u[k];
            slopes[2][f] = x[i] * y[j] * du[k];
        }
        slopes
    }
}

fn powers(x: f64) -> Powers {
    let square = x * x;
    [1.0, x, square, square * x, square * square]
}

fn falling([one, x, square, cube, _]: Powers) -> Powers {
    [0.0, one, 2.0 * x, 3.0 * square, 4.0 * cube]
}

fn exponents() -> impl Iterator<Item = (usize, usize, usize)> {
    let of_power = |(k, degree): (usize, usize)| {
        (0..=degree).flat_map(move |i| (0..=degree - i).map(move |j| (i, j, k)))
    };
    DEGREES.into_iter().enumerate().flat_map(of_power)
}

impl Moments {
    pub(crate) fn new(shares: &[Share]) -> Self {
        let mean = |value: &dyn Fn(&Share) -> f64| -> f64 {
            shares.iter().map(|s| s.weight * value(s)).sum()
        };
        let square = |s: &Share| s.place[0] * s.place[0] + s.place[1] * s.place[1];
        let mut moments = Self {
            distance: mean(&square).sqrt(),
            inverse: mean(&|s| s.length.powi(-2)).sqrt(),
            averages: [0.0; MOMENTS],
            sizes: [0.0; MOMENTS],
        };
        for share in shares {
            let features = moments.site(share.place, share.length).features();
            for (f, feature) in features.into_iter().enumerate() {
                moments.averages[f] += share.weight * feature;
                moments.sizes[f] += share.weight * feature * feature;
            }
        }
        moments
            .sizes
            .iter_mut()
            .for_each(|size| *size = size.sqrt());
        moments
    }

    pub(crate) fn site(&self, place: [f64; 2], length: f64) -> Site {
        Site {
            place: place.map(|x| x / self.distance),
            inverse: 1.0 / (length * self.inverse),
        }
    }

    /// Deviations of the weighted sums, relative to the root mean squares.
    pub(crate) fn residuals(&self, sites: &[(Site, f64)]) -> Features {
        let mut sums = self.averages.map(|average| -average);
        for (site, weight) in sites {
            for (sum, feature) in sums.iter_mut().zip(site.features()) {
                *sum += weight * feature;
            }
        }
        for (sum, size) in sums.iter_mut().zip(self.sizes) {
            *sum /= size;
        }
        sums
    }

    pub(crate) fn sizes(&self) -> &Features {
        &self.sizes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_match_differences_of_the_features() {
        let site = |[x, y, inverse]: [f64; 3]| Site {
            place: [x, y],
            inverse,
        };
        let at = [0.7, -1.3, 0.9];
        for axis in 0..3 {
            const STEP: f64 = 1e-5;
            let [ahead, behind] = [STEP, -STEP].map(|step| {
                let mut there = at;
                there[axis] += step;
                site(there).features()
            });
            let slopes = site(at).slopes()[axis];
            for (f, slope) in slopes.iter().enumerate() {
                let difference = (ahead[f] - behind[f]) / (2.0 * STEP);
                assert!(
                    (slope - difference).abs() < 1e-8,
                    "{f}: {slope} {difference}"
                );
            }
        }
    }

    #[test]
    fn there_are_46_features() {
        let mut all: Vec<_> = exponents().collect();
        assert_eq!(all.len(), MOMENTS);
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), MOMENTS);
        assert!(all.iter().all(|(i, j, k)| i + j <= DEGREES[*k]));
    }

    #[test]
    fn bonds_meet_their_own_moments() {
        let share = |(weight, x, y, length)| Share {
            weight,
            place: [x, y],
            length,
        };
        let shares = [
            (0.2, 0.3, -1.0, 0.4),
            (0.5, -0.9, 0.2, 1.1),
            (0.3, 1.5, 0.7, 2.0),
        ]
        .map(share);
        let moments = Moments::new(&shares);
        let sites = shares.iter().rev();
        let sites: Vec<_> = sites
            .map(|s| (moments.site(s.place, s.length), s.weight))
            .collect();
        assert!(moments.residuals(&sites).iter().all(|r| r.abs() < 1e-15));
        let off = [(sites[0].0, 0.31), sites[1], sites[2]];
        assert!(moments.residuals(&off).iter().any(|r| r.abs() > 1e-3));
    }
}
