//! What the settings of a path mean: the values of a control at the ends of its stages. What moves,
//! and how, is no business of this file.

use super::{Setting, Stage};

/// Values of a control at the ends of the stages, the first of them before the path; `None` if no
/// stage sets it.
///
/// It begins at zero and stays where a stage does not set it; of several settings in one stage the
/// last counts. `find` gives the value that a setting has for the control.
pub(crate) fn values<T: Copy + Default>(
    path: &[Stage],
    find: impl Fn(&Setting) -> Option<T>,
) -> Option<Vec<T>> {
    let mut values = vec![T::default()];
    let mut is_set = false;
    for stage in path {
        let set = stage.set.iter().rev().find_map(&find);
        is_set |= set.is_some();
        values.push(set.unwrap_or(values[values.len() - 1]));
    }
    is_set.then_some(values)
}

/// Factors of the load `index` at the ends of the stages, as [`values`]; `None` of a load that no
/// stage sets, whose factor is [`UNSET`].
pub(crate) fn load_factors(path: &[Stage], index: usize) -> Option<Vec<f64>> {
    values(path, |setting| match *setting {
        Setting::LoadFactor { load, factor } if load == index => Some(factor),
        _ => None,
    })
}

/// Factor of a load that no stage sets.
pub(crate) const UNSET: f64 = 1.0;

#[cfg(test)]
mod tests {
    use super::*;

    fn stage(factors: &[(usize, f64)]) -> Stage {
        let set = |&(load, factor): &(usize, f64)| Setting::LoadFactor { load, factor };
        Stage {
            set: factors.iter().map(set).collect(),
            duration_ns: None,
        }
    }

    /// Zero before the path, the last of a stage, what it was where a stage sets others; nothing for a
    /// load that is never set.
    #[test]
    fn factors_by_hand() {
        let path = [
            stage(&[(0, 0.5)]),
            stage(&[(1, 3.0), (0, 7.0), (1, 4.0)]),
            stage(&[(1, -1.0)]),
        ];
        assert_eq!(load_factors(&path, 0).unwrap(), [0.0, 0.5, 7.0, 7.0]);
        assert_eq!(load_factors(&path, 1).unwrap(), [0.0, 0.0, 4.0, -1.0]);
        assert_eq!(load_factors(&path, 2), None);
        assert_eq!(load_factors(&[], 0), None);
    }
}
