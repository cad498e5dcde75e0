//! Factor of a load as a function of time.

use super::rules::show;
use super::{Load, Scene, SceneProblem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Time-dependent factor of a load, in `Dynamics` and `Brownian`. It multiplies the factor that the path sets.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Factor {
    /// 1 at all times.
    #[default]
    Constant,
    /// Smooth change from one value to another: velocity and acceleration are continuous at both ends.
    Ramp {
        /// Start of the change; finite.
        #[serde(default)]
        begin_ns: f64,
        /// Duration of the change; positive.
        duration_ns: f64,
        /// Initial factor; finite.
        #[serde(default)]
        from: f64,
        /// Final factor; finite.
        #[serde(default = "one")]
        to: f64,
    },
    /// `mean + amplitude sin(360 deg time / period + phase)`. Not allowed with `stop` of `Dynamics`.
    Sine {
        /// Period; positive.
        period_ns: f64,
        /// Phase at time 0; finite.
        #[serde(default)]
        phase_deg: f64,
        /// Amplitude; finite.
        #[serde(default = "one")]
        amplitude: f64,
        /// Mean; finite.
        #[serde(default)]
        mean: f64,
    },
    /// Linear interpolation between points; constant before the first and after the last.
    Table {
        /// Times; finite, ascending, at least one.
        time_ns: Vec<f64>,
        /// Factors at these times, one for each; finite.
        factor: Vec<f64>,
    },
}

fn one() -> f64 {
    1.0
}

/// Smooth step `x^3 (10 - 15 x + 6 x^2)` from 0 to 1, with vanishing first and second derivatives at both ends.
pub fn smooth(x: f64) -> f64 {
    x.powi(3) * (10.0 + x * (6.0 * x - 15.0))
}

impl Factor {
    /// Returns whether the factor is 1 at all times.
    pub fn is_constant(&self) -> bool {
        *self == Self::Constant
    }

    /// Returns the factor at a time (ns).
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Ramp {
                begin_ns,
                duration_ns,
                from,
                to,
            } => from + (to - from) * smooth(((time - begin_ns) / duration_ns).clamp(0.0, 1.0)),
            Self::Sine {
                period_ns,
                phase_deg,
                amplitude,
                mean,
            } => mean + amplitude * (TAU * (time / period_ns) + phase_deg.to_radians()).sin(),
            Self::Table { time_ns, factor } => between(time_ns, factor, time),
        }
    }

    /// Returns the time (ns) after which the factor is constant; infinite for `Sine`.
    pub fn settles_at(&self) -> f64 {
        match self {
            Self::Constant => 0.0,
            Self::Ramp {
                begin_ns,
                duration_ns,
                ..
            } => (begin_ns + duration_ns).max(0.0),
            Self::Sine { .. } => f64::INFINITY,
            Self::Table { time_ns, .. } => time_ns.last().map_or(0.0, |last| last.max(0.0)),
        }
    }

    /// Returns an upper bound of the magnitude of the factor.
    pub fn largest(&self) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Ramp { from, to, .. } => from.abs().max(to.abs()),
            Self::Sine {
                amplitude, mean, ..
            } => amplitude.abs() + mean.abs(),
            Self::Table { factor, .. } => factor.iter().fold(0.0, |most, f| most.max(f.abs())),
        }
    }

    /// Returns the shortest time scale of a change (ns), or `None` for a constant.
    pub fn shortest(&self) -> Option<f64> {
        match self {
            Self::Constant => None,
            Self::Ramp { duration_ns, .. } => Some(*duration_ns),
            Self::Sine { period_ns, .. } => Some(*period_ns),
            Self::Table { time_ns, .. } => {
                let times = time_ns.windows(2).map(|pair| pair[1] - pair[0]);
                times.reduce(f64::min)
            }
        }
    }

    pub(super) fn check(&self, key: &str) -> Result<(), SceneProblem> {
        let Self::Table { time_ns, factor } = self else {
            return Ok(());
        };
        check_table(&|name| format!("{key}.{name}"), time_ns, factor)
    }
}

impl Scene {
    /// Returns the times (ns) in which stages of the path, loads and the strain of the periodic box change.
    pub fn times_of_change(&self) -> impl Iterator<Item = f64> {
        let moving = self.path.iter().filter(|stage| !stage.set.is_empty());
        let stages = moving.filter_map(|stage| stage.duration_ns);
        let loads = self.loads.iter().map(Load::factor);
        let factors = loads.chain(self.periodic.iter().map(|periodic| &periodic.factor));
        stages.chain(factors.filter_map(Factor::shortest))
    }
}

fn check_table(
    key: &impl Fn(&str) -> String,
    times: &[f64],
    factors: &[f64],
) -> Result<(), SceneProblem> {
    let refused = |name: &str, value: String, rule: &str| {
        Err(SceneProblem::new(key(name), value, rule.to_owned()))
    };
    if times.is_empty() {
        return refused("time_ns", "[]".into(), "a table has at least one time");
    }
    if factors.len() != times.len() {
        let rule = format!(
            "must have as many values as time_ns, which has {}",
            times.len()
        );
        return refused("factor", format!("{} values", factors.len()), &rule);
    }
    match times.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(i) => refused(
            &format!("time_ns[{}]", i + 1),
            show(times[i + 1]),
            "must be greater than the previous time",
        ),
        None => Ok(()),
    }
}

fn between(places: &[f64], values: &[f64], x: f64) -> f64 {
    let above = places.partition_point(|place| *place <= x);
    if above == 0 || above == places.len() {
        return values[above.saturating_sub(1)];
    }
    let (x0, x1) = (places[above - 1], places[above]);
    let (y0, y1) = (values[above - 1], values[above]);
    y0 + (y1 - y0) * ((x - x0) / (x1 - x0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_near(factor: &Factor, time: f64, value: f64) -> bool {
        (factor.at(time) - value).abs() < 1e-15
    }

    #[test]
    fn factors_by_hand() {
        let ramp = Factor::Ramp {
            begin_ns: 1.0,
            duration_ns: 2.0,
            from: 3.0,
            to: 5.0,
        };
        assert!(is_near(&ramp, 0.5, 3.0) && is_near(&ramp, 2.0, 4.0) && is_near(&ramp, 9.0, 5.0));
        let sine = Factor::Sine {
            period_ns: 4.0,
            phase_deg: 90.0,
            amplitude: 2.0,
            mean: 0.5,
        };
        assert!(is_near(&sine, 0.0, 2.5) && is_near(&sine, 1.0, 0.5) && is_near(&sine, 2.0, -1.5));
        let table = Factor::Table {
            time_ns: vec![1.0, 2.0, 4.0],
            factor: vec![1.0, 0.0, 3.0],
        };
        for (time, value) in [(0.0, 1.0), (1.5, 0.5), (2.0, 0.0), (3.0, 1.5), (7.0, 3.0)] {
            assert!(is_near(&table, time, value), "{time}");
        }
        let settle = [&ramp, &sine, &table].map(Factor::settles_at);
        assert_eq!(
            settle.map(f64::to_bits),
            [3.0, f64::INFINITY, 4.0].map(f64::to_bits)
        );
    }
}
