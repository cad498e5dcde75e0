//! Reactions of clamps, and sums of the energies of an equilibrium.

use super::common::{free_bodies, settle};
use crate::common::ran;
use actin_mechanics::{Loads, Vector3};
use actin_rundir::RunDirectory;
use actin_sim::{End, Plan};
use std::collections::BTreeMap;

const FORCE: [f64; 3] = [3.0, -1.0, 4.0];
const TOLERANCE: f64 = 1e-5;

fn scene(sections: &str, clamped: &str, loaded: &str, task: &str) -> String {
    let [x, y, z] = FORCE;
    format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
            ),
            clamps: [Clamp(end: {clamped})],
            loads: [EndForce(end: {loaded}, force_pn: ({x:?}, {y:?}, {z:?}))],
            task: {task},
        )"
    )
}

const MONOMERS_THEN_ROD: &str =
    "Ellipsoids(from_nm: 0.0, to_nm: 30.0), Rod(from_nm: 30.0, to_nm: 60.0)";
const ROD_THEN_MONOMERS: &str =
    "Rod(from_nm: 0.0, to_nm: 30.0), Ellipsoids(from_nm: 30.0, to_nm: 60.0)";

#[test]
fn the_reaction_balances_the_load() {
    for (sections, clamped, loaded) in [
        (MONOMERS_THEN_ROD, "Start", End::End),
        (ROD_THEN_MONOMERS, "Start", End::End),
        (MONOMERS_THEN_ROD, "End", End::Start),
        (ROD_THEN_MONOMERS, "End", End::Start),
    ] {
        let task = format!("Equilibrium(force_pn: {TOLERANCE:?}, torque_pn_nm: {TOLERANCE:?})");
        let settled = settle(&scene(sections, clamped, &format!("{loaded:?}"), &task));
        let (assembly, state) = (&settled.assembly, &settled.last().state);
        let mut loads = Loads::zeros(state);
        for interaction in assembly.system.interactions() {
            interaction.add_loads(state, &mut loads);
        }
        let clamp = &assembly.clamps[0];
        let reaction = clamp.reaction(state, &loads);
        let force = Vector3::from(FORCE);
        let arm = assembly.tip_nm(state, loaded) - clamp.about_nm;
        let (points, frames) = free_bodies(state);
        let open_force = points as f64 * TOLERANCE;
        let open_torque = open_force * 60.0 + frames as f64 * TOLERANCE;
        let force_left = (reaction.force_pn + force).norm();
        let torque_left = (reaction.torque_pn_nm + arm.cross(&force)).norm();
        println!("{clamped} {loaded:?}: {force_left:e} pN, {torque_left:e} pN nm left");
        assert!(force_left < open_force, "{force_left} pN");
        assert!(torque_left < open_torque, "{torque_left} pN nm");
        assert!(
            reaction.torque_pn_nm.norm() > 10.0,
            "the torque must not vanish"
        );
    }
}

fn rows(text: &str) -> Vec<BTreeMap<String, f64>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let values = line.split(',').map(|value| value.parse().unwrap());
            names.iter().map(ToString::to_string).zip(values).collect()
        })
        .collect()
}

/// The energy of a dead load is minus the force times the displacement.
#[test]
fn the_columns_of_the_energies_add_up() {
    let task = "Dynamics(
        duration_ns: 2.0, record_every_ns: 0.1,
        drag: (translational_per_ns: 1.0, rotational_per_ns: 1.0),
    )";
    let (assembly, trajectory, report) = ran(&scene(MONOMERS_THEN_ROD, "Start", "End", task));
    let folder = tempfile::tempdir().unwrap();
    let directory = RunDirectory::create(folder.path().join("run"), false).unwrap();
    let plan = Plan::new(&assembly).unwrap();
    directory.write(&plan, &trajectory, &report).unwrap();
    let text = std::fs::read_to_string(directory.path().join("energies.csv")).unwrap();
    let rows = rows(&text);
    assert_eq!(rows.len(), trajectory.records.len());
    for row in &rows {
        let sum = |names: &[&str]| -> f64 {
            names.iter().map(|name| row[&format!("{name}_pn_nm")]).sum()
        };
        let same = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{row:?}");
        let potential = sum(&["potential"]);
        same(sum(&["bonds", "junction", "rod", "load"]), potential);
        same(
            sum(&["section_0", "junction_0_1", "section_1", "load_0"]),
            potential,
        );
        same(sum(&["elastic", "load"]), potential);
        same(sum(&["potential", "kinetic"]), sum(&["total"]));
        same(sum(&["bonds"]), sum(&["section_0"]));
    }
    let tip = |state| assembly.tip_nm(state, End::End);
    let last = &trajectory.records.last().unwrap().state;
    let work = Vector3::from(FORCE).dot(&(tip(last) - tip(&assembly.rest)));
    let load = rows[rows.len() - 1]["load_pn_nm"];
    assert!((load + work).abs() < 1e-12 * work, "{load} and {work}");
}
