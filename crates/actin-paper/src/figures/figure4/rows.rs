//! Numbers of Figure 4 as rows of the report.

use super::case::{ROD_SEGMENTS, Resolved, Result4, SWING_DRAG_PER_NS};
use super::variant::{Variant, stiffness_ratio};
use crate::figures::settles::energy_decays;
use actin_draw::report::Row;
use actin_sim::ForceLaw;

/// Exact inextensible elastica of 160 nm under 2 pN with B = 3.9e4 pN nm^2 (nm).
const ELASTICA_NM: f64 = 59.8;
/// F L^3 / 3B with the preceding paper's B = E A^2/4pi = 2.359e5 pN nm^2 (nm).
const STIFF_LINEAR_NM: f64 = 11.575;
/// The deflection that the paper's text states (nm).
const PAPER_DEFLECTION_NM: &str = "10";

/// All rows of the figure.
pub(super) fn rows(results: &[Result4]) -> Vec<Row> {
    let mut all: Vec<Row> = results.iter().map(tip_drop).collect();
    all.extend(results.iter().map(energy));
    all.extend(
        variants(results)
            .into_iter()
            .flat_map(|v| spreads(results, v)),
    );
    all.push(mesh_error(results));
    all.extend(newton_rows(results));
    all.extend(sampling(results));
    all.extend(results.iter().flat_map(ring_down));
    all.extend(moved(results));
    all
}

/// Those of the results, in their order.
fn variants(results: &[Result4]) -> Vec<Variant> {
    let mut all: Vec<Variant> = Vec::new();
    for result in results {
        if !all.contains(&result.case.variant) {
            all.push(result.case.variant);
        }
    }
    all
}

/// What only motions show: that their energies fall, and what they cost.
fn moved(results: &[Result4]) -> Vec<Row> {
    let moved: Vec<&Result4> = results.iter().filter(|r| r.moved).collect();
    if moved.is_empty() {
        return Vec::new();
    }
    let with_energy = moved.iter().filter(|r| r.newton.is_some());
    let energies = with_energy.map(|r| r.total.iter().copied());
    let mut rows = vec![energy_decays("fig4", energies)];
    let costs = moved
        .iter()
        .filter(|r| [Variant::SHARED, Variant::MEAN].contains(&r.case.variant));
    rows.extend(costs.map(|r| {
        let note = "evaluations of bonds and segments until the stop rule is met";
        let quantity = format!("work/{}", r.case.path());
        Row::measured("fig4", quantity, "", r.work, note)
    }));
    rows
}

fn tip_drop(result: &Result4) -> Row {
    let case = &result.case;
    let quantity = format!("tip_drop/{}", case.path());
    let note = ending(result);
    let row = |note| Row::measured("fig4", quantity.as_str(), "nm", result.tip_drop_nm, note);
    match (case.variant, case.resolved) {
        (Variant::STIFF, Resolved::Rod(_)) => row(format!(
            "the text says about 10; F L^3 / 3B is {STIFF_LINEAR_NM} with A = 38.5 nm^2 and 11.38 \
             with the text's I = 120 nm^4: an erratum of the paper; {note}"
        ))
        .against_printed(PAPER_DEFLECTION_NM, 0.0),
        (variant, _) if variant.is_stiff() => row(format!(
            "rod of the preceding paper's parameters, bonds {:.3} times as stiff, which is the ratio \
             of the rods' bending rigidities; {note}",
            stiffness_ratio()
        )),
        (Variant::SHARED, Resolved::Rod(_)) => row(format!(
            "exact inextensible elastica {ELASTICA_NM}, expected 59 to 61; {note}"
        )),
        _ => row(note),
    }
}

/// How a case came to rest, and under which loads.
fn ending(result: &Result4) -> String {
    let end = if !result.moved {
        "by Newton's method"
    } else if result.converged {
        "stop rule met"
    } else {
        "ended by time"
    };
    let balance = match (result.case.variant.balance, result.case.resolved) {
        (ForceLaw::EnergyGradient, _) => "",
        (ForceLaw::PaperBalance, Resolved::Mixed(_)) => {
            "; the rod's balance as printed, and a junction of full weight that keeps to the gradient \
             of its energy"
        }
        (ForceLaw::PaperBalance, _) => "; the rod's balance as printed",
    };
    format!(
        "{end} at {:.0} ns, residual {:.1e} pN and {:.1e} pN nm, {} force evaluations{balance}",
        result.time_ns, result.residual.0, result.residual.1, result.force_evaluations
    )
}

fn energy(result: &Result4) -> Row {
    let how = match result.newton {
        Some(_) => "by Newton's method",
        None => {
            "the printed energy where the damped motion ends, since the printed balance has no potential"
        }
    };
    let note = format!(
        "elastic energy of monomers, junctions and rod at equilibrium, without that of the load; {how}"
    );
    let quantity = format!("energy/{}", result.case.path());
    Row::measured("fig4", quantity, "pN nm", result.elastic_pn_nm(), note)
}

/// What spreads: its quantity, the unit of the value, and the value.
type Pick = (&'static str, &'static str, fn(&Result4) -> f64);

/// Largest minus smallest tip drop and energy of the mixed resolutions, relative to their mean.
fn spreads(results: &[Result4], variant: Variant) -> [Row; 2] {
    let mixed: Vec<&Result4> = results
        .iter()
        .filter(|r| r.case.variant == variant && matches!(r.case.resolved, Resolved::Mixed(_)))
        .collect();
    let path = variant.path();
    let name = match path.trim_end_matches('/') {
        "" => "shared",
        name => name,
    };
    let picks: [Pick; 2] = [
        ("tip_spread", "nm", |r| r.tip_drop_nm),
        ("energy_spread", "pN nm", Result4::elastic_pn_nm),
    ];
    picks.map(|(quantity, unit, pick)| {
        let values = || mixed.iter().map(|r| pick(r));
        let largest = values().fold(f64::NEG_INFINITY, f64::max);
        let smallest = values().fold(f64::INFINITY, f64::min);
        let mean = values().sum::<f64>() / mixed.len() as f64;
        let note = format!(
            "(max - min)/mean over {} mixed resolutions, {smallest:.3} to {largest:.3} {unit}",
            mixed.len()
        );
        let quantity = format!("{quantity}/{name}");
        Row::measured("fig4", quantity, "", (largest - smallest) / mean, note)
    })
}

/// Damped dynamics against Newton's method, and the certificates of the latter.
fn newton_rows(results: &[Result4]) -> [Row; 2] {
    let found = || results.iter().filter_map(|r| Some((r, r.newton?)));
    let differences = found().map(|(r, newton)| (r.tip_drop_nm - newton.tip_drop_nm).abs());
    let unstable = found().filter(|(_, newton)| !newton.certified).count();
    [
        Row::measured(
            "fig4",
            "newton_difference/largest",
            "nm",
            differences.fold(0.0, f64::max),
            "largest difference of the tip between the end of damped dynamics and Newton's method \
             over all cases; what is left is the residual at which the dynamics stopped, or a second \
             equilibrium close by",
        ),
        Row::measured(
            "fig4",
            "not_certified_stable",
            "",
            unstable as f64,
            "equilibria found by Newton's method whose stiffness is not positive definite",
        ),
    ]
}

/// How far 10 nm segments are from the limit of fine ones.
fn mesh_error(results: &[Result4]) -> Row {
    let rod = |segments: usize| {
        results
            .iter()
            .filter(|r| r.case.variant == Variant::SHARED)
            .find(|r| r.case.resolved == Resolved::Rod(segments))
            .map_or(f64::NAN, |r| r.tip_drop_nm)
    };
    let (coarse, fine) = (rod(64), rod(128));
    // The error falls with the square of the segment length.
    let limit = fine + (fine - coarse) / 3.0;
    Row::measured(
        "fig4",
        "rod_mesh_error",
        "",
        rod(ROD_SEGMENTS) / limit - 1.0,
        format!(
            "10 nm segments against the limit {limit:.4} nm of 2.5 and 1.25 nm; wall clamp; expected within 0.005"
        ),
    )
}

/// Mean and standard deviation of the fully resolved filament over bond samplings.
fn sampling(results: &[Result4]) -> Vec<Row> {
    let drops: Vec<f64> = results
        .iter()
        .filter(|r| r.case.variant == Variant::SHARED)
        .filter(|r| matches!(r.case.resolved, Resolved::Ellipsoids(_)))
        .map(|r| r.tip_drop_nm)
        .collect();
    if drops.len() < 2 {
        return Vec::new();
    }
    let n = drops.len() as f64;
    let mean = drops.iter().sum::<f64>() / n;
    let variance = drops.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / (n - 1.0);
    let note = format!("{n} seeds of the bonds, 64 independent bonds per interface");
    vec![
        Row::measured("fig4", "tip_drop/ellipsoids/mean", "nm", mean, note.clone()),
        Row::measured(
            "fig4",
            "tip_drop/ellipsoids/sd",
            "nm",
            variance.sqrt(),
            note,
        ),
    ]
}

fn ring_down(result: &Result4) -> Vec<Row> {
    let Some(ring) = result.ring_down else {
        return Vec::new();
    };
    let path = result.case.path();
    let note = format!(
        "damped frequency from the tip's extrema, drag rates {SWING_DRAG_PER_NS} per ns; expected \
         decay half of that; theory for small motion of the rod: 0.170 rad/ns"
    );
    vec![
        Row::measured(
            "fig4",
            format!("frequency/{path}"),
            "rad/ns",
            ring.frequency_rad_per_ns,
            note.clone(),
        ),
        Row::measured(
            "fig4",
            format!("decay/{path}"),
            "1/ns",
            ring.decay_per_ns,
            note,
        ),
    ]
}
