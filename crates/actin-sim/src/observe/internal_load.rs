//! Internal forces and moments at an arc length, and their extreme values.

use super::View;
use crate::shape::{SectionLoad, SectionLoads};

/// Columns at one arc length.
const LOCAL: [&str; 6] = [
    "shear_x_pn",
    "shear_y_pn",
    "tension_pn",
    "moment_x_pn_nm",
    "moment_y_pn_nm",
    "torque_pn_nm",
];

/// Extreme value along a filament.
struct Extreme {
    name: &'static str,
    unit: &'static str,
    value: fn(&SectionLoad) -> f64,
    /// Key that is maximal at the extreme value.
    rank: fn(f64) -> f64,
}

const EXTREMES: [Extreme; 5] = [
    Extreme {
        name: "largest_tension",
        unit: "pn",
        value: SectionLoad::tension_pn,
        rank: std::convert::identity,
    },
    Extreme {
        name: "smallest_tension",
        unit: "pn",
        value: SectionLoad::tension_pn,
        rank: std::ops::Neg::neg,
    },
    Extreme {
        name: "largest_shear",
        unit: "pn",
        value: SectionLoad::shear_pn,
        rank: f64::abs,
    },
    Extreme {
        name: "largest_moment",
        unit: "pn_nm",
        value: SectionLoad::bending_moment_pn_nm,
        rank: f64::abs,
    },
    Extreme {
        name: "largest_torque",
        unit: "pn_nm",
        value: SectionLoad::torque_pn_nm,
        rank: f64::abs,
    },
];

pub(super) fn columns(filament: usize, at_nm: Option<f64>) -> Vec<String> {
    let name = format!("internal_load[{filament}]");
    match at_nm {
        Some(at) => LOCAL
            .map(|column| format!("{name}_at_{at}nm_{column}"))
            .into(),
        None => EXTREMES
            .iter()
            .flat_map(|one| [one.unit, "at_nm"].map(|end| format!("{name}_{}_{end}", one.name)))
            .collect(),
    }
}

/// Internal load at an arc length (nm), or the extreme values of the filament.
pub(super) fn values(view: &View<'_>, filament: usize, at_nm: Option<f64>) -> Vec<f64> {
    let loads = SectionLoads::new(view.assembly, filament, view.state);
    if let Some(at) = at_nm {
        let SectionLoad {
            force_pn,
            couple_pn_nm,
        } = loads.at(at);
        return force_pn.iter().chain(&couple_pn_nm).copied().collect();
    }
    let places = view.ribbon(filament).s_nm.iter();
    let local: Vec<(f64, SectionLoad)> = places.map(|&s| (s, loads.at(s))).collect();
    let extremes = EXTREMES.iter().flat_map(|Extreme { value, rank, .. }| {
        let rank = |one: &(f64, SectionLoad)| rank(value(&one.1));
        let extreme = local.iter().max_by(|a, b| rank(a).total_cmp(&rank(b)));
        let (s_nm, load) = extreme.copied().unwrap_or_default();
        [value(&load), s_nm]
    });
    extremes.collect()
}

#[cfg(test)]
mod tests {
    use crate::{Scene, Solve};

    /// A force at the tip is transmitted by monomers, junction and rod. The bending moment is the force times the
    /// lever arm, and largest at the wall.
    #[test]
    fn a_force_at_the_tip_is_transmitted() {
        let text = "Scene(
            filament: Filament(
                sections: [Ellipsoids(from_nm: 0.0, to_nm: 40.0), Rod(from_nm: 40.0, to_nm: 100.0)],
            ),
            clamps: [Clamp(end: Start)],
            loads: [EndForce(end: End, force_pn: (0.6, 0.0, -0.8))],
            observe: [InternalLoad(at_nm: 20.0), InternalLoad(at_nm: 73.0), InternalLoad()],
            task: Equilibrium(force_pn: 1e-9, torque_pn_nm: 1e-8),
        )";
        let solution = Scene::from_ron(text).unwrap().solve().unwrap();
        let (assembly, record) = (&solution.assembly, solution.last());
        let columns = crate::observed_columns(assembly);
        let get = |name: &str| {
            let found = columns.iter().position(|column| column == name);
            record.observed[found.unwrap_or_else(|| panic!("no column {name}: {columns:?}"))]
        };
        for at in ["20", "73"] {
            let local = |end: &str| get(&format!("internal_load[0]_at_{at}nm_{end}"));
            let force = [
                local("shear_x_pn"),
                local("shear_y_pn"),
                local("tension_pn"),
            ];
            let force = force.iter().map(|f| f * f).sum::<f64>().sqrt();
            assert!((force - 1.0).abs() < 1e-6, "{at}: {force}");
            assert!(local("tension_pn") < -0.7);
        }
        let largest = |name: &str| get(&format!("internal_load[0]_largest_{name}"));
        assert!(largest("moment_at_nm") < 2.8);
        // The interface between the held monomers has the load of the start, the free end the load of the tip.
        let profile = crate::shape::profile(assembly, &record.state);
        for point in &profile {
            let force = point.load.force_pn.norm();
            assert!((force - 1.0).abs() < 1e-6, "{}: {force}", point.s_nm);
        }
        // The lever arm is the length of 100 nm plus the displacement under compression.
        let moment = largest("moment_pn_nm");
        assert!((60.0..66.0).contains(&moment), "{moment}");
        let compression = get("internal_load[0]_smallest_tension_pn");
        assert!((-0.82..-0.79).contains(&compression), "{compression}");
    }
}
