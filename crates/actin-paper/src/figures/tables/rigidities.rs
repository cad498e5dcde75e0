//! Table 4: rigidities measured on ensembles of the ellipsoid filament.

use super::ensemble::{Ensemble, Kind, RISES, core};
use super::loads::{AZIMUTHS_DEG, CANTILEVER_PN, CURVATURES, Measured, PULL_PN};
use super::parameters::write_rows;
use super::statistics::Sample;
use super::thermal;
use crate::figures::Run;
use crate::published::{Table, entries};
use actin_draw::page::significant;
use actin_draw::report::{Artefact, Row};
use actin_sim::{Monomers, ellipsoid_constants as monomer};
use std::time::Instant;

/// Computes Table 4.
pub(in crate::figures) fn table4(run: Run<'_>) -> Result<Artefact, String> {
    let started = Instant::now();
    let ensemble = core(run)?;
    let measured = Measured::run(run, Kind::DEFAULT)?;
    let mean = Measured::run(run, Kind::MEAN)?;
    let mut rows = rigidities(&measured, ensemble, Kind::DEFAULT)?;
    rows.extend(interfaces());
    if !run.quick {
        rows.extend(thermal::rows(run)?);
    }
    let mean_rows = rigidities(&mean, ensemble, Kind::MEAN)?;
    rows.extend(mean_rows.into_iter().map(of_mean_filament));
    write_rows("table4", &rows, run.out)?;
    measured.write(run.out, "table4_samplings.csv")?;
    mean.write(run.out, "table4_mean_filament.csv")?;
    Ok(Artefact {
        id: "table4",
        title: "Rigidities of the multi-resolution model, measured on the monomers",
        settings: settings(&measured),
        rows,
        pictures: Vec::new(),
        views: Vec::new(),
        wall_s: started.elapsed().as_secs_f64(),
    })
}

/// All that was measured of one kind.
fn rigidities(measured: &Measured, ensemble: &Ensemble, kind: Kind) -> Result<Vec<Row>, String> {
    let mut rows = stretching(measured);
    rows.extend(bending(measured));
    rows.extend(shearing(measured));
    rows.extend(twisting(ensemble, kind)?);
    rows.extend(persistence(measured));
    Ok(rows)
}

/// The mean filament is ours: it stands beside the paper's numbers under a path of its own, without a
/// verdict and so without a tolerance.
fn of_mean_filament(mut row: Row) -> Row {
    if let Some(tolerance) = row.note.find("; tolerance") {
        row.note.truncate(tolerance);
    }
    row.quantity = format!("{}/{}", Kind::MEAN.name(), row.quantity);
    (row.tolerance, row.pass) = (None, None);
    row
}

fn settings(measured: &Measured) -> String {
    format!(
        "64 independent bonds per interface; the mean filament has 12 weighted ones that stand for all and \
         is one filament. Stretch: {} samplings (seeds from 0), {:.2} nm, turn blocked. \
         Bending and shear: {} samplings at azimuths {AZIMUTHS_DEG:?} deg, {:.2} nm, both ends \
         held in orientation, the far one slides freely. Two monomers are held at each end; \
         lengths are those between the inner ones. Seeds count from 0. {} of {} states are not stable beyond doubt; \
         {} loads were not reached.",
        measured.stretch_samplings,
        RISES * Monomers::default().rise_nm,
        measured.bend_samplings,
        measured.bend_length_nm,
        measured.unstable,
        measured.states,
        measured.unreached,
    )
}

fn row(quantity: impl Into<String>, unit: &'static str, ours: f64, note: impl Into<String>) -> Row {
    Row::measured("table4", quantity, unit, ours, note)
}

fn describe(sample: &Sample) -> String {
    if sample.count == 1 {
        return "one filament".to_owned();
    }
    format!(
        "mean of {}, sd {}, range {} to {}",
        sample.count,
        significant(sample.sd),
        significant(sample.low),
        significant(sample.high)
    )
}

/// Standard deviation of a single filament, which tolerances are made of.
fn scatter(of: &str, unit: &'static str, sd: f64) -> Row {
    row(
        format!("{of}/sd"),
        unit,
        sd,
        "standard deviation of a single filament",
    )
}

fn stretching(measured: &Measured) -> Vec<Row> {
    let mut rows = Vec::new();
    for (force, sample) in &measured.by_force {
        let note = format!("secant F L/dL at {force} pN, {}", describe(sample));
        if force.total_cmp(&PULL_PN).is_eq() {
            let main = row("s3", "pN", sample.mean, note.clone());
            rows.push(main.against_printed("3.4e4", sample.sd));
            rows.push(scatter("s3", "pN", sample.sd));
        }
        rows.push(row(format!("s3/by-force/{force}"), "pN", sample.mean, note));
    }
    for (strain, sample) in &measured.by_shift {
        let note = format!(
            "secant F L/dL at held strain {strain}, {}",
            describe(sample)
        );
        rows.push(row(
            format!("s3/by-shift/{strain}"),
            "pN",
            sample.mean,
            note,
        ));
    }
    rows
}

fn bending(measured: &Measured) -> Vec<Row> {
    let mut rows = Vec::new();
    for (curvature, sample) in &measured.by_couples {
        let note = format!(
            "secant M/kappa at {curvature} rad/nm, {}; couples at the two ends agree to {:.0e}",
            describe(sample),
            measured.couple_mismatch
        );
        if curvature
            .total_cmp(&CURVATURES[CURVATURES.len() - 1])
            .is_eq()
        {
            let main = row("b1", "pN nm^2", sample.mean, note.clone());
            rows.push(main.against_printed("3.9e4", sample.sd));
            rows.push(scatter("b1", "pN nm^2", sample.sd));
            let share = measured.anisotropy;
            let note = "largest difference between two azimuths of one sampling over its mean";
            rows.push(row("b1/anisotropy", "", share, note));
        }
        let quantity = format!("b1/couples/{curvature}");
        rows.push(row(quantity, "pN nm^2", sample.mean, note));
    }
    rows.extend(tip_forces(measured));
    rows.extend(cantilever(measured));
    rows
}

/// B1 as the paper defines it, at the force and the length that it names.
fn cantilever(measured: &Measured) -> [Row; 2] {
    let (length, [linear, elastica]) = (measured.cantilever_nm, &measured.by_cantilever);
    let note = |theory: &str, sample: &Sample| {
        format!(
            "{theory}; {CANTILEVER_PN} pN at the tip of {length:.2} nm, {}",
            describe(sample)
        )
    };
    let paper = "the paper's own way, F L^3 / 3 Delta of the cantilever of Section 4.1, which holds for \
                 small deflections only";
    let exact = "the same deflection by the exact elastica";
    [
        row("b1/cantilever", "pN nm^2", linear.mean, note(paper, linear))
            .against_printed("3.9e4", linear.sd),
        row(
            "b1/cantilever/elastica",
            "pN nm^2",
            elastica.mean,
            note(exact, elastica),
        ),
    ]
}

fn tip_forces(measured: &Measured) -> Vec<Row> {
    let mut rows = Vec::new();
    for (force, linear, elastica) in &measured.by_tip_force {
        for (name, sample) in [("linear", linear), ("elastica", elastica)] {
            let note = format!(
                "cantilever at {force} pN, {name} theory without shear, which adds to the \
                 deflection; {}",
                describe(sample)
            );
            let quantity = format!("b1/tip-force-{name}/{force}");
            rows.push(row(quantity, "pN nm^2", sample.mean, note));
        }
    }
    rows
}

const NO_SHEARING_RIGIDITY: &str = "the rod's S1 is an assumption of the paper, which scaled \
    4GA/3 by 2.7, and has no support in the monomers: at rest they shear without resistance, and \
    the force grows with the cube of the shear";

fn shearing(measured: &Measured) -> Vec<Row> {
    let mut rows = Vec::new();
    for (i, shear) in measured.by_shear.iter().enumerate() {
        let (force, secant) = (shear.force_pn, &shear.secant);
        let note = format!(
            "secant F/gamma at {force} pN on parallel ends, the bending of a guided beam with B \
             at 1e-4 rad/nm taken off, {}",
            describe(secant)
        );
        if i == 0 {
            let note = format!("{note}; {NO_SHEARING_RIGIDITY}");
            rows.push(row("s1", "pN", secant.mean, note).against_printed("1.6e4", secant.sd));
        }
        // At the largest force bending is nearly all of the shift, and the rest means little.
        if i + 1 < measured.by_shear.len() {
            rows.push(row(format!("s1/secant/{force}"), "pN", secant.mean, note));
            let (mean, sd) = (shear.cubic.mean, shear.cubic.sd);
            let note = format!("F/gamma^3 at {force} pN, sd {sd:.1e}; of a cubic law a constant");
            rows.push(row(format!("s1/cubic/{force}"), "pN", mean, note));
        }
        let note = format!(
            "F L/d at {force} pN, bending included, {}; a rod with Table 4's S1 and B1 reads {:.2}",
            describe(&shear.apparent),
            measured.rod_shear
        );
        let quantity = format!("s1/apparent/{force}");
        rows.push(row(quantity, "pN", shear.apparent.mean, note));
    }
    rows
}

fn twisting(ensemble: &Ensemble, kind: Kind) -> Result<Vec<Row>, String> {
    let entries = entries(Table::Rigidity)?;
    let largest = |direction: &str| {
        entries
            .iter()
            .filter(|entry| entry.direction() == direction)
            .map(|entry| {
                let sample = ensemble.sample(kind, entry, Table::Rigidity);
                (sample.mean, sample.sd, entry.phi_deg)
            })
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .expect("each direction has entries")
    };
    let rows = [
        ("b3_min", "under", "9.6e3", "rounded to 1.0e4 in Table 4"),
        ("b3_max", "over", "1.6e4", "as in Table 4"),
    ];
    let rows = rows.map(|(name, direction, paper, printed)| {
        let (value, sd, phi) = largest(direction);
        let note = format!(
            "largest mean secant in {direction}-twist, at the curvature of {phi} deg in Table 3; \
             the paper's is that of its Table 3, {printed}"
        );
        let main = row(name, "pN nm^2", value, note).against_printed(paper, sd);
        [main, scatter(name, "pN nm^2", sd)]
    });
    Ok(rows.into_iter().flatten().collect())
}

fn interfaces() -> [Row; 2] {
    let note = "published rigidity x 1.4 x kBT; printed in pN, pN/nm is meant; tolerance: rounding";
    [
        row("s_perp", "pN/nm", monomer::LATERAL_RIGIDITY, note).derived("2.3e3"),
        row("s_par", "pN/nm", monomer::LONGITUDINAL_RIGIDITY, note).derived("3.4e3"),
    ]
}

fn persistence(measured: &Measured) -> Vec<Row> {
    let length_um = |b: f64| b / monomer::THERMAL_ENERGY * 1e-3;
    let at = |i: usize| &measured.by_couples[i].1;
    let (b1, at_rest) = (at(CURVATURES.len() - 1), at(0));
    let (length, sd) = (length_um(b1.mean), length_um(b1.sd));
    let scale = monomer::RIGIDITY_SCALE;
    let note = "B1/kBT with B1 at 0.01 rad/nm; tolerance: half a digit, and twice the sd of B1";
    vec![
        row("persistence_length_um", "um", length, note).against_printed("9.8", sd),
        row(
            "persistence_length_unscaled_um",
            "um",
            length / scale,
            "the same with interfaces of the published rigidity: all energies are 1.4 times less",
        )
        .against_printed("7.0", sd / scale),
        row(
            "persistence_length_um/at-rest",
            "um",
            length_um(at_rest.mean),
            "B/kBT with B at 1e-4 rad/nm: a filament that is nearly straight bends more easily",
        ),
    ]
}
