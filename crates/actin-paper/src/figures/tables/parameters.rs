//! Tables 1 and 2: parameters of the crates and derived numbers. Published numbers and notes are in
//! `data/expected.csv`.

use crate::figures::draft::Draft;
use actin_sim::{Material, Monomers, ellipsoid_constants as monomer, rod_constants as rod};
use std::f64::consts::PI;

type Parameter = (&'static str, &'static str, f64);

pub(in crate::figures) fn table1(draft: &mut Draft<'_>) -> Result<(), String> {
    draft.describe("table1", &[])?;
    let monomers = Monomers::default();
    list(draft, &[published(&monomers), derived(&monomers)].concat())
}

pub(in crate::figures) fn table2(draft: &mut Draft<'_>) -> Result<(), String> {
    draft.describe("table2", &[])?;
    list(draft, &rods())
}

fn list(draft: &mut Draft<'_>, parameters: &[Parameter]) -> Result<(), String> {
    for &(name, unit, value) in parameters {
        draft.row(name, unit, value, "");
    }
    draft.list()
}

/// Parameters with published numbers.
fn published(m: &Monomers) -> Vec<Parameter> {
    let [radial, tangential, axial] = m.semi_axes_nm.map(|semi_axis| 2.0 * semi_axis);
    let [lateral, longitudinal] = [
        m.lateral_rigidity_pn_per_nm,
        m.longitudinal_rigidity_pn_per_nm,
    ]
    .map(|rigidity| rigidity / monomer::RIGIDITY_SCALE / monomer::THERMAL_ENERGY);
    let longest = m.longitudinal_max_bond_nm;
    vec![
        ("dimension/radial", "nm", radial),
        ("dimension/tangential", "nm", tangential),
        ("dimension/axial", "nm", axial),
        ("period", "nm", monomer::MONOMERS_PER_PERIOD * m.rise_nm),
        ("monomers_per_period", "", monomer::PERIOD / m.rise_nm),
        ("rise_per_strand_step", "nm", 2.0 * m.rise_nm),
        ("effective_interaction_radius", "nm", m.radius_nm),
        ("lateral_rigidity", "kBT/nm^2", lateral),
        ("longitudinal_rigidity", "kBT/nm^2", longitudinal),
        ("lateral_maximum_bond_length", "nm", m.lateral_max_bond_nm),
        ("longitudinal_maximum_bond_length", "nm", longest),
    ]
}

/// Chosen parameters, and numbers derived from the interfaces.
fn derived(m: &Monomers) -> Vec<Parameter> {
    let strand_turn = (2.0 * m.turn_deg).rem_euclid(360.0);
    // Relative change of length per twist for a constant distance over `steps` monomers.
    let slope = |steps: f64| {
        let turn = (steps * m.turn_deg).to_radians();
        m.radius_nm.powi(2) * turn.sin() / (steps * m.rise_nm)
    };
    let strands = 4.0 * m.longitudinal_rigidity_pn_per_nm * m.rise_nm;
    vec![
        ("rise", "nm", m.rise_nm),
        ("turn", "deg", m.turn_deg),
        ("strand_turn", "deg", strand_turn),
        ("bonds_per_interface", "", m.lateral_bonds as f64),
        ("mass", "ag", m.mass_ag),
        ("stretching_bound", "pN", strands),
        ("stretching_uniform", "pN", uniform_stretching(m)),
        ("twist_stretch_slope/fixed-radius", "nm", -slope(2.0)),
        ("twist_stretch_slope", "nm", slope(1.0)),
    ]
}

/// Stretching rigidity of springs between centres under uniform strain, with free radius `R` and fixed turn (pN).
///
/// ```text
/// S = (a1 b2 - a2 b1)^2 / (a1^2/k2 + a2^2/k1) / z
/// ```
///
/// `z` is the rise (nm), `k` the stiffness of a spring (pN/nm), and `a` and `b` are the derivatives of its length with
/// respect to `R dR` and to the strain. Indices 1 and 2 are the lateral and the longitudinal spring.
fn uniform_stretching(m: &Monomers) -> f64 {
    let spring = |steps: f64| {
        let across = 2.0 * (1.0 - (steps * m.turn_deg).to_radians().cos());
        let along = (steps * m.rise_nm).powi(2);
        let length = (m.radius_nm.powi(2) * across + along).sqrt();
        (across / length, along / length)
    };
    let ((a1, b1), (a2, b2)) = (spring(1.0), spring(2.0));
    let (k1, k2) = (
        m.lateral_rigidity_pn_per_nm,
        m.longitudinal_rigidity_pn_per_nm,
    );
    (a1 * b2 - a2 * b1).powi(2) / (a1 * a1 / k2 + a2 * a2 / k1) / m.rise_nm
}

fn rods() -> [Parameter; 12] {
    let rigidities = Material::PrecedingPaper.rigidities();
    let (young, poisson) = (
        rod::PRECEDING_PAPER_YOUNG_MODULUS,
        rod::PRECEDING_PAPER_POISSON_RATIO,
    );
    let inertia = rod::CROSS_SECTION_AREA.powi(2) / (4.0 * PI);
    let circle = |diameter: f64| PI * diameter * diameter / 4.0;
    [
        ("area", "nm^2", rod::CROSS_SECTION_AREA),
        ("area/least", "nm^2", circle(5.0)),
        ("area/most", "nm^2", circle(7.0)),
        ("young_modulus", "pN/nm^2", young),
        ("poisson_ratio", "", poisson),
        ("shear_modulus", "pN/nm^2", young / (2.0 * (1.0 + poisson))),
        ("i1", "nm^4", inertia),
        ("i3", "nm^4", 2.0 * inertia),
        ("s1", "pN", rigidities.shear.x),
        ("s3", "pN", rigidities.shear.z),
        ("b1", "pN nm^2", rigidities.bend.x),
        ("b3", "pN nm^2", rigidities.bend.z),
    ]
}
