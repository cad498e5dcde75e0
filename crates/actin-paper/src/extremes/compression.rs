//! Rods whose natural length follows their twist, pushed together up to and far past the bound of
//! their twist.

use super::row::{Outcome, Row};
use super::scenes::{Parts, either};
use actin_sim::rod_constants::{TABLE_4_SHEAR, XI_COEFFICIENTS};
use std::f64::consts::PI;

/// 40 nm, so that Euler's load between walls, 960 pN, is far.
const LENGTH: f64 = 40.0;
const SEGMENTS: usize = 20;

/// A law, the bound of the untwisted rod (pN), its natural length over the built one less 1, and
/// its stretching rigidity (pN).
struct Law {
    name: &'static str,
    bound: f64,
    natural: f64,
    stretch: f64,
}

/// Compressions as shares of the bound. The law `Fitted` takes the first three: it does not resist
/// small shear, so that further on its rods do not stay straight.
const SHARES: [f64; 5] = [0.1, 0.99, 1.02, 3.0, 10.0];

/// All of them.
pub(super) fn rows() -> Vec<Row> {
    let published = Law {
        name: "PublishedExtension",
        // 566.01 / (2 x 20.508)
        bound: 13.80,
        natural: XI_COEFFICIENTS[0],
        stretch: TABLE_4_SHEAR[2],
    };
    let fitted = Law {
        name: "Fitted",
        // 235.488 / (0.463366 / 6.02136e-3)
        bound: 3.060,
        natural: 0.0,
        stretch: 3.354_4e4,
    };
    let mut rows = Vec::new();
    for (law, shares) in [(published, &SHARES[..]), (fitted, &SHARES[..3])] {
        for &share in shares {
            let case = format!("rod, {}, {share} of its bound", law.name);
            let outcome = either(law.pushed(share));
            rows.push(Row::new("compression", case, outcome));
        }
    }
    rows
}

/// Modes of the twist that are unstable at a share of the bound: `docs/statics.md`.
fn unstable_modes(share: f64) -> usize {
    let softens = |m: usize| (m as f64 * PI / (2 * SEGMENTS) as f64).cos().powi(2);
    (1..SEGMENTS).filter(|&m| softens(m) * share > 1.0).count()
}

impl Law {
    /// The straight equilibrium: whether its run says that twist is unstable, from which bound on,
    /// and whether its certificate counts the modes that are. Under the law `Fitted` shear gives
    /// way as well, so that there the certificate counts more.
    fn pushed(&self, share: f64) -> Result<Outcome, Outcome> {
        let shift = LENGTH * (self.natural - share * self.bound / self.stretch);
        let parts = Parts {
            sections: format!("Rod(from_nm: 0.0, to_nm: {LENGTH:?}, segments: {SEGMENTS})"),
            models: format!("rod: RodModel(law: {}),", self.name),
            rest: format!(
                "clamps: [Clamp(end: Start), Clamp(end: End)],
                 path: [Stage(set: [Shift(end: End, shift_nm: (0.0, 0.0, {shift:?}))])],"
            ),
            task: "Equilibrium(leave_saddles: 0)".to_owned(),
        };
        let ran = parts.run_to_saddle()?;
        let said = ran.assembly.unstable_twist(ran.assembly.system.state());
        if (share > 1.0) == said.is_empty() {
            return Err(Outcome::Wrong(format!("the run says {said:?}")));
        }
        if self.name == "Fitted" {
            let told = said.first().map_or(self.bound, |said| said.bound_pn);
            let error = (told / self.bound - 1.0).abs();
            let what = "the run tells the bound, once it is passed";
            return Ok(Outcome::correct(what, error, 1e-3));
        }
        let found = ran.report.equilibrium.expect("an equilibrium").certificate;
        let error = found.negative.abs_diff(unstable_modes(share)) as f64;
        let what = "number of unstable modes, which the run tells of";
        Ok(Outcome::correct(what, error, 0.0))
    }
}
