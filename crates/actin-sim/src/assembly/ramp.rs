//! The path of a scene in time: smooth ramps from stage to stage.

use super::{Assembly, Drive};
use actin_mechanics::State;

/// A [`Drive`] whose stages take their durations one after the other; behind the last, controls
/// stay where they are.
///
/// Within a stage the path parameter grows by `r(x) = x^3 (10 - 15 x + 6 x^2)`, x the share of its
/// time: velocity and acceleration of what is driven are zero at both ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ramp {
    drive: Drive,
    /// Duration of each stage (ns).
    durations: Vec<f64>,
}

impl Ramp {
    fn new(drive: Drive, durations: Vec<f64>) -> Self {
        Self { drive, durations }
    }

    /// The ramps of an assembly's path; none where there is no path.
    pub(crate) fn of(assembly: &Assembly) -> Option<Self> {
        if assembly.drive.is_still() {
            return None;
        }
        let stages = assembly.scene.path.iter();
        let durations = stages.filter_map(|stage| stage.duration_ns).collect();
        Some(Self::new(assembly.drive.clone(), durations))
    }

    /// Time that all stages take (ns).
    pub(crate) fn duration(&self) -> f64 {
        self.durations.iter().sum()
    }

    /// Path parameter at `time` (ns) and its rate (1/ns).
    pub(crate) fn parameter(&self, time: f64) -> (f64, f64) {
        let mut start = 0.0;
        for (stage, duration) in self.durations.iter().enumerate() {
            let x = (time - start) / duration;
            if x < 1.0 {
                let x = x.max(0.0);
                let smooth = x.powi(3) * (10.0 + x * (6.0 * x - 15.0));
                let rate = 30.0 * (x * (1.0 - x)).powi(2) / duration;
                return (stage as f64 + smooth, rate);
            }
            start += duration;
        }
        (self.durations.len() as f64, 0.0)
    }
}

impl actin_mechanics::Drive for Ramp {
    fn place(&self, state: &mut State, time: f64) {
        let (u, rate) = self.parameter(time);
        self.drive.place_moving(state, u, rate);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rate is the derivative of the parameter, and nothing jumps between stages.
    #[test]
    fn ramps_are_smooth() {
        let ramp = Ramp::new(Drive::default(), vec![2.0, 0.5]);
        assert_eq!(ramp.parameter(-1.0), (0.0, 0.0));
        assert!((ramp.parameter(1.0).0 - 0.5).abs() < 1e-15);
        assert_eq!(ramp.parameter(3.0), (2.0, 0.0));
        for time in [0.3, 1.7, 2.0, 2.1, 2.4] {
            let h = 1e-4;
            let slope = (ramp.parameter(time + h).0 - ramp.parameter(time - h).0) / (2.0 * h);
            // Third derivatives up to 60 / 0.5^3 times h^2/6.
            assert!((slope - ramp.parameter(time).1).abs() < 1e-6, "{time}");
        }
    }
}
