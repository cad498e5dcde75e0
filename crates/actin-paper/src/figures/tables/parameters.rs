//! Tables 1 and 2: parameters as published, as the crates hold them, and what follows from them.

use crate::figures::Run;
use actin_draw::report::{Artefact, Origin, Row, write_csv};
use actin_sim::{Material, Monomers, ellipsoid_constants as monomer, rod_constants as rod};
use std::f64::consts::PI;
use std::path::Path;
use std::time::Instant;

/// Computes Table 1.
pub(in crate::figures) fn table1(Run { out, .. }: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let mut rows = published_monomers();
    rows.extend(derived_monomers());
    finish(
        "table1",
        "Parameters of the ellipsoid model",
        "The defaults of a scene's monomers against the published numbers, and what follows from \
         them. Nothing is fitted, nothing is drawn at random.",
        rows,
        out,
        started,
    )
}

/// Computes Table 2.
pub(in crate::figures) fn table2(Run { out, .. }: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let mut rows = published_rod();
    rows.extend(derived_rod());
    finish(
        "table2",
        "Parameters of the preceding paper's Cosserat rod",
        "The rod that scenes name PrecedingPaper, with a section of 38.5 nm^2; the paper prints \
         formulas where it gives no number. None of the figures but the stiff cantilever uses it. Nothing is drawn at random.",
        rows,
        out,
        started,
    )
}

fn finish(
    id: &'static str,
    title: &'static str,
    settings: &str,
    rows: Vec<Row>,
    out: &Path,
    started: Instant,
) -> Result<Artefact, String> {
    write_rows(id, &rows, out)?;
    Ok(Artefact {
        id,
        title,
        settings: settings.to_owned(),
        rows,
        pictures: Vec::new(),
        views: Vec::new(),
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// Writes rows as a table of their own.
pub(super) fn write_rows(id: &str, rows: &[Row], out: &Path) -> Result<(), String> {
    let header = [
        "quantity",
        "unit",
        "paper",
        "ours",
        "tolerance",
        "pass",
        "note",
        "origin",
    ];
    let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.6e}"));
    let lines = rows.iter().map(|row| {
        vec![
            row.quantity.clone(),
            row.unit.to_owned(),
            number(row.paper),
            number(Some(row.ours)),
            number(row.tolerance),
            row.pass.map_or(String::new(), |pass| pass.to_string()),
            row.note.clone(),
            row.origin
                .map_or(String::new(), |origin| origin.name().to_owned()),
        ]
    });
    write_csv(out, &format!("{id}.csv"), &header, lines)
}

fn published_monomers() -> Vec<Row> {
    let mut rows = published_geometry();
    rows.extend(published_interfaces());
    rows
}

/// A published parameter that the crates hold as it is.
fn same(name: &str, unit: &'static str, ours: f64, paper: f64, note: &str) -> Row {
    Row::measured("table1", name, unit, ours, note).beside(paper, Origin::Parameter)
}

fn published_geometry() -> Vec<Row> {
    let m = Monomers::default();
    let (period, per_period) = (
        monomer::MONOMERS_PER_PERIOD * m.rise_nm,
        monomer::PERIOD / m.rise_nm,
    );
    let [radial, tangential, axial] = m.semi_axes_nm.map(|semi_axis| 2.0 * semi_axis);
    let axis = "the paper does not say which axis lies where: the thin one is radial here";
    let radius = "distance of centres from the axis";
    let rise = "printed as the rise per monomer, but every second monomer is meant; twice 71.2/26; \
        5.52 and the period of 71.2 differ by 0.8 %, an erratum";
    vec![
        same("dimension/radial", "nm", radial, 3.8, axis),
        same("dimension/tangential", "nm", tangential, 5.4, axis),
        same("dimension/axial", "nm", axial, 5.4, axis),
        same("period", "nm", period, 71.2, "26 rises"),
        same("monomers_per_period", "", per_period, 26.0, ""),
        Row::measured(
            "table1",
            "rise_per_strand_step",
            "nm",
            2.0 * m.rise_nm,
            rise,
        )
        .derived("5.52"),
        same(
            "effective_interaction_radius",
            "nm",
            m.radius_nm,
            1.8,
            radius,
        ),
    ]
}

fn published_interfaces() -> Vec<Row> {
    let m = Monomers::default();
    let unscaled = |rigidity: f64| rigidity / monomer::RIGIDITY_SCALE / monomer::THERMAL_ENERGY;
    let lateral = unscaled(m.lateral_rigidity_pn_per_nm);
    let longitudinal = unscaled(m.longitudinal_rigidity_pn_per_nm);
    let (short, long) = (m.lateral_max_bond_nm, m.longitudinal_max_bond_nm);
    let note = "without the factor 1.4 of Appendix B";
    vec![
        same("lateral_rigidity", "kBT/nm^2", lateral, 392.0, note),
        same(
            "longitudinal_rigidity",
            "kBT/nm^2",
            longitudinal,
            582.4,
            note,
        ),
        same("lateral_maximum_bond_length", "nm", short, 1.6, ""),
        same("longitudinal_maximum_bond_length", "nm", long, 2.2, ""),
    ]
}

fn derived_monomers() -> Vec<Row> {
    let m = Monomers::default();
    let row = |name: &str, unit, ours, note: &str| Row::measured("table1", name, unit, ours, note);
    let strand_turn = (2.0 * m.turn_deg).rem_euclid(360.0);
    let bonds = m.lateral_bonds as f64;
    let turn = "monomer to monomer, -360 x 12/26";
    let strand = "two monomers further, right-handed";
    let mut rows = vec![
        row("rise", "nm", m.rise_nm, "71.2/26"),
        row("turn", "deg", m.turn_deg, turn),
        row("strand_turn", "deg", strand_turn, strand),
        row(
            "bonds_per_interface",
            "",
            bonds,
            "a choice: the paper gives none",
        ),
        row("mass", "ag", m.mass_ag, "42 kDa; the paper gives none"),
    ];
    rows.extend(closed_forms(&m));
    rows
}

/// What the interfaces alone say of stretching and of twist-stretch.
fn closed_forms(m: &Monomers) -> Vec<Row> {
    let row = |name: &str, unit, ours, note: &str| Row::measured("table1", name, unit, ours, note);
    let strands = 4.0 * m.longitudinal_rigidity_pn_per_nm * m.rise_nm;
    let square = m.radius_nm.powi(2);
    let fixed = square * (2.0 * m.turn_deg).to_radians().sin() / (2.0 * m.rise_nm);
    let free = square * m.turn_deg.to_radians().sin() / m.rise_nm;
    vec![
        row(
            "stretching_bound",
            "pN",
            strands,
            "2 S_par z, two strands of springs S_par at steps z of 5.477 nm: bounds the stretching \
             rigidity from above",
        ),
        row(
            "stretching_uniform",
            "pN",
            uniform_stretching(m),
            "springs of both interfaces between centres, strained uniformly, radius free, turn \
             held: a closer upper bound (Table 4: 3.4e4)",
        ),
        row(
            "twist_stretch_slope/fixed-radius",
            "nm",
            -fixed,
            "dL/L over curvature if the longitudinal distances keep their length at constant \
             radius: -R0^2 sin(27.692 deg) / 5.477",
        ),
        row(
            "twist_stretch_slope",
            "nm",
            free,
            "the same if both distances keep theirs and the radius is free: \
             R0^2 sin(-166.154 deg) / 2.7385 (Table 5: -0.28 as the mean slope at 10 deg)",
        ),
    ]
}

/// Stretching rigidity (pN) of springs between centres, strained uniformly with the radius free and
/// the turn held: per rise `(a1 b2 - a2 b1)^2 / (a1^2/k2 + a2^2/k1)`, `a` and `b` the changes of a
/// spring's length by `R dR` and by the strain.
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

fn published_rod() -> Vec<Row> {
    let shear_modulus = modulus();
    vec![
        Row::measured(
            "table2",
            "area",
            "nm^2",
            rod::CROSS_SECTION_AREA,
            "the paper: 40 to 75 in Table 2, 38.5 in Appendix B; diameters of 5 to 7 nm give 20 to \
             38",
        ),
        area_of_diameter("least", 5.0).derived("40"),
        area_of_diameter("most", 7.0).derived("75"),
        Row::measured(
            "table2",
            "young_modulus",
            "pN/nm^2",
            rod::PRECEDING_PAPER_YOUNG_MODULUS,
            "",
        )
        .beside(2000.0, Origin::Parameter),
        Row::measured(
            "table2",
            "poisson_ratio",
            "",
            rod::PRECEDING_PAPER_POISSON_RATIO,
            "",
        )
        .beside(0.4, Origin::Parameter),
        Row::measured(
            "table2",
            "shear_modulus",
            "pN/nm^2",
            shear_modulus,
            "E / 2 (1 + nu); the paper rounds to 700, tolerance half a unit of its one digit; with \
             the E = 330 of Appendix B it would be 118",
        )
        .derived("700"),
    ]
}

/// The circular section of a diameter (nm) that Appendix A names.
fn area_of_diameter(which: &str, diameter: f64) -> Row {
    let note = format!(
        "section of a circle of {diameter} nm, from which Table 2 is said to follow: an erratum"
    );
    let area = PI * diameter * diameter / 4.0;
    Row::measured("table2", format!("area/{which}"), "nm^2", area, note)
}

fn derived_rod() -> Vec<Row> {
    let rigidities = Material::PrecedingPaper.rigidities();
    let area = rod::CROSS_SECTION_AREA;
    let inertia = area * area / (4.0 * PI);
    let shear = 4.0 / 3.0 * modulus() * area;
    let stretch = rod::PRECEDING_PAPER_YOUNG_MODULUS * area;
    let (bend, twist) = (
        rod::PRECEDING_PAPER_YOUNG_MODULUS * inertia,
        2.0 * modulus() * inertia,
    );
    let row = |name: &str, unit, ours, note: &str| Row::measured("table2", name, unit, ours, note);
    let given = |name, unit, ours, formula: f64, note| {
        row(name, unit, ours, note).beside(formula, Origin::Parameter)
    };
    let [s1, s3] = [rigidities.shear.x, rigidities.shear.z];
    let [b1, b3] = [rigidities.bend.x, rigidities.bend.z];
    let round = "A^2/4pi; Appendix B and Section 4.1 round to 120, tolerance half a digit";
    let six = "the paper gives E I1: six times the 3.9e4 of Table 4";
    let thirteen = "the paper gives G I3: thirteen times the 1.3e4 of Appendix B";
    vec![
        row("i1", "nm^4", inertia, round).derived("120"),
        row("i3", "nm^4", 2.0 * inertia, "A^2/2pi"),
        given("s1", "pN", s1, shear, "the paper gives 4 G A/3"),
        given("s3", "pN", s3, stretch, "the paper gives E A"),
        given("b1", "pN nm^2", b1, bend, six),
        given("b3", "pN nm^2", b3, twist, thirteen),
    ]
}

/// Shear modulus of the preceding paper's rod (pN/nm^2).
fn modulus() -> f64 {
    rod::PRECEDING_PAPER_YOUNG_MODULUS / (2.0 * (1.0 + rod::PRECEDING_PAPER_POISSON_RATIO))
}
