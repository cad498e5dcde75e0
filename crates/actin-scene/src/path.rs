//! Values of controls at the ends of the stages of a path.

use super::{Setting, Stage};

/// Values of a control at the ends of stages. Stage 0 is the state before the path, where the value is zero.
///
/// The value is constant in stages that do not set the control. Memory grows with the number of settings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Values<T> {
    set: Vec<(usize, T)>,
}

impl<T: Copy + Default> Values<T> {
    /// Returns the value at the end of a stage.
    pub fn after(&self, stages: usize) -> T {
        let known = self.set.partition_point(|(end, _)| *end <= stages);
        known.checked_sub(1).map_or(T::default(), |k| self.set[k].1)
    }

    /// Returns the ends of stages at which the control is set, in ascending order.
    pub fn ends(&self) -> impl Iterator<Item = usize> + '_ {
        self.set.iter().map(|(end, _)| *end)
    }

    /// Sets the value at the end of a stage. Stages must be in ascending order; the last setting of a stage
    /// counts.
    fn push(&mut self, end: usize, value: T) {
        match self.set.last_mut() {
            Some((last, known)) if *last == end => *known = value,
            _ => self.set.push((end, value)),
        }
    }
}

/// Returns the values of each of `count` controls, or `None` for controls that no stage sets. `find` returns
/// the index and value of a setting of one of these controls.
pub fn values<T: Copy + Default>(
    path: &[Stage],
    count: usize,
    find: impl Fn(&Setting) -> Option<(usize, T)>,
) -> Vec<Option<Values<T>>> {
    let mut values: Vec<Option<Values<T>>> = (0..count).map(|_| None).collect();
    for (stage, end) in path.iter().zip(1..) {
        for (index, value) in stage.set.iter().filter_map(&find) {
            if let Some(control) = values.get_mut(index) {
                control.get_or_insert_with(Values::default).push(end, value);
            }
        }
    }
    values
}

/// Returns the factors of `count` loads, as [`values`]. Loads that no stage sets have the factor [`UNSET`].
pub fn load_factors(path: &[Stage], count: usize) -> Vec<Option<Values<f64>>> {
    values(path, count, |setting| match *setting {
        Setting::LoadFactor { load, factor } => Some((load, factor)),
        _ => None,
    })
}

/// Returns the factor of the strain of the periodic box, or `None` if no stage sets it.
pub fn strain_factor(path: &[Stage]) -> Option<Values<f64>> {
    let mut all = values(path, 1, |setting| match *setting {
        Setting::Shear { factor } => Some((0, factor)),
        _ => None,
    });
    all.pop().flatten()
}

/// Factor of a load that no stage sets.
pub const UNSET: f64 = 1.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn stage(factors: &[(usize, f64)]) -> Stage {
        let set = |&(load, factor): &(usize, f64)| Setting::LoadFactor { load, factor };
        Stage {
            set: factors.iter().map(set).collect(),
            duration_ns: None,
            pace: crate::TimeCourse::Smooth,
        }
    }

    #[test]
    fn factors_by_hand() {
        let path = [
            stage(&[(0, 0.5)]),
            stage(&[(1, 3.0), (0, 7.0), (1, 4.0)]),
            stage(&[(1, -1.0)]),
        ];
        let factors = load_factors(&path, 3);
        let of = |load: usize| {
            let values = factors[load].as_ref().unwrap();
            [0, 1, 2, 3].map(|stages| values.after(stages))
        };
        assert_eq!(
            of(0).map(f64::to_bits),
            [0.0, 0.5, 7.0, 7.0].map(f64::to_bits)
        );
        assert_eq!(
            of(1).map(f64::to_bits),
            [0.0, 0.0, 4.0, -1.0].map(f64::to_bits)
        );
        assert_eq!(factors[2], None);
        assert_eq!(load_factors(&[], 1), [None]);
    }

    #[test]
    fn memory_grows_with_the_settings() {
        let count = 300;
        let path: Vec<Stage> = (0..count).map(|i| stage(&[(i, 1.0)])).collect();
        let factors = load_factors(&path, count);
        let length = |values: &Option<Values<f64>>| values.as_ref().map_or(0, |v| v.set.len());
        assert_eq!(factors.iter().map(length).sum::<usize>(), count);
    }
}
