//! Table 4: rigidities of ellipsoid filaments in stretch, bending, shear and twist, and derived numbers of Appendix B.

use super::ensemble::{Kind, RISES, core};
use super::thermal;
use crate::figures::draft::{Column, Draft, number};
use crate::figures::texts::Values;
use crate::measure::{
    Curve, Evidence, MeasureError, Specimen, bend_by_couples, bend_by_tip_force, shear_by_force,
    stretch_by_force, stretch_by_shift,
};
use crate::published::{Table, entries, table};
use crate::statistics::{SampleStatistics, largest, sample};
use actin_draw::page::significant;
use actin_sim::{Monomers, ellipsoid_constants as monomer, rod_constants as rod};
use serde::Deserialize;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Axial forces (pN). S3 is compared at `PULL_PN`.
const FORCES_PN: [f64; 6] = [-10.0, -1.0, 1.0, 10.0, PULL_PN, 500.0];
const PULL_PN: f64 = 100.0;
const STRAINS: [f64; 2] = [-0.001, 0.003];
/// Curvatures (rad/nm). B at rest is measured at the first, B1 is compared at the last.
const CURVATURES: [f64; 4] = [AT_REST, 1e-3, 3e-3, BENT];
const AT_REST: f64 = 1e-4;
const BENT: f64 = 1e-2;
const TIP_PN: [f64; 3] = [0.1, 0.5, 2.0];
/// Tip force (pN) and length (nm) of the cantilever of the paper.
const CANTILEVER_PN: f64 = 2.0;
const CANTILEVER_NM: f64 = 160.0;
/// Transverse forces on the guided end (pN). At the largest force, nearly all of the shift is bending, so shear is only
/// evaluated below `MOST_SHEAR_PN`.
const SHEAR_PN: [f64; 3] = [0.01, 0.1, 1.0];
const MOST_SHEAR_PN: f64 = 0.5;
const AZIMUTHS_DEG: [f64; 4] = [0.0, 45.0, 90.0, 135.0];
/// Rises between the inner clamped monomers of bent filaments: 150.62 nm.
const BENT_RISES: f64 = 55.0;
/// Samplings in stretch, and in bending and shear, by default and with `--quick`.
const SEEDS: [u64; 2] = [16, 8];
const QUICK_SEEDS: [u64; 2] = [4, 2];
/// Young's modulus of Appendix B (pN/nm^2), ratio of the stretching rigidity to E A, and Poisson's ratio.
const YOUNG: f64 = 330.0;
const STIFFER: f64 = 2.7;
const POISSON: f64 = 0.4;

/// Load of a filament and evaluation of the rigidity.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
enum Protocol {
    StretchByForce,
    StretchByShift,
    Couples,
    TipLinear,
    TipElastica,
    CantileverLinear,
    CantileverElastica,
    /// `F L / d`, bending included.
    ShearApparent,
    /// `F / gamma` without the bending of a guided beam.
    ShearSecant,
    /// `F / gamma^3` without the bending of a guided beam.
    ShearCubic,
}

/// Measured rigidity: a line of `data/rigidities.csv`.
#[derive(Debug, Deserialize)]
struct Rigidity {
    quantity: String,
    unit: String,
    protocol: Protocol,
    /// Prescribed value of the compared rigidity; a row for every value if `None`.
    at: Option<f64>,
    words: String,
}

static RIGIDITIES: LazyLock<Vec<Rigidity>> =
    LazyLock::new(|| table(include_str!("../../../data/rigidities.csv")));

#[derive(Clone, Copy, Debug)]
struct Reading {
    protocol: Protocol,
    seed: u64,
    azimuth: f64,
    /// Prescribed value; `secant` is the secant rigidity.
    at: f64,
    secant: f64,
    evidence: Evidence,
}

#[derive(Clone, Debug, Default)]
struct Readings {
    all: Vec<Reading>,
    unreached: usize,
    /// Largest relative difference between the torques at both ends.
    mismatch: f64,
}

pub(in crate::figures) fn table4(draft: &mut Draft<'_>) -> Result<(), String> {
    let drawn = measure(draft, Kind::DEFAULT)?;
    let mean = measure(draft, Kind::MEAN)?;
    settings(draft, &drawn)?;
    rigidities(draft, &drawn, Kind::DEFAULT)?;
    derived(draft);
    if !draft.quick {
        thermal::rows(draft)?;
    }
    rigidities(draft, &mean, Kind::MEAN)?;
    draft.list()?;
    draft.table("table4_samplings.csv", &drawn.all, &COLUMNS)?;
    draft.table("table4_mean_filament.csv", &mean.all, &COLUMNS)
}

fn measure(draft: &Draft<'_>, kind: Kind) -> Result<Readings, String> {
    let [stretched, bent] = if draft.quick { QUICK_SEEDS } else { SEEDS };
    let axial = kind.seeds(stretched).map(|seed| (seed, None));
    let across = kind
        .seeds(bent)
        .flat_map(|seed| AZIMUTHS_DEG.map(|azimuth| (seed, Some(azimuth))));
    let cases: Vec<(u64, Option<f64>)> = axial.chain(across).collect();
    let found = draft.solve(&cases, |&(seed, azimuth)| {
        let found =
            azimuth.map_or_else(|| stretch(kind, seed), |azimuth| bend(kind, seed, azimuth));
        found.map_err(|e| e.to_string())
    })?;
    let mut readings = Readings::default();
    for one in found {
        readings.all.extend(one.all);
        readings.unreached += one.unreached;
        readings.mismatch = readings.mismatch.max(one.mismatch);
    }
    readings.without_bending();
    Ok(readings)
}

fn stretch(kind: Kind, seed: u64) -> Result<Readings, MeasureError> {
    let specimen = kind.specimen(RISES, seed);
    let mut readings = Readings::default();
    let curve = stretch_by_force(&specimen, &FORCES_PN)?;
    let of = (Protocol::StretchByForce, seed, 0.0);
    readings.add(of, &FORCES_PN, &curve, |p| (p.rigidity_pn, p.evidence));
    let curve = stretch_by_shift(&specimen, &STRAINS)?;
    let of = (Protocol::StretchByShift, seed, 0.0);
    readings.add(of, &STRAINS, &curve, |p| (p.rigidity_pn, p.evidence));
    Ok(readings)
}

fn bend(kind: Kind, seed: u64, azimuth: f64) -> Result<Readings, MeasureError> {
    let specimen = kind.specimen(BENT_RISES, seed);
    let cantilever = Specimen::ellipsoids(CANTILEVER_NM, kind.monomers(seed));
    let of = |protocol| (protocol, seed, azimuth);
    let mut readings = Readings::default();
    let curve = bend_by_couples(&specimen, &CURVATURES, azimuth)?;
    let mismatch = |p: &crate::measure::CouplePoint| {
        ((p.couple_pn_nm + p.near_couple_pn_nm) / p.couple_pn_nm).abs()
    };
    readings.mismatch = largest(curve.points.iter().map(mismatch));
    let of_couples = of(Protocol::Couples);
    readings.add(of_couples, &CURVATURES, &curve, |p| {
        (p.rigidity_pn_nm2, p.evidence)
    });
    let tip = bend_by_tip_force(&specimen, &TIP_PN, azimuth)?;
    let long = bend_by_tip_force(&cantilever, &[CANTILEVER_PN], azimuth)?;
    for (curve, forces, linear, elastica) in [
        (tip, &TIP_PN[..], Protocol::TipLinear, Protocol::TipElastica),
        (
            long,
            &[CANTILEVER_PN],
            Protocol::CantileverLinear,
            Protocol::CantileverElastica,
        ),
    ] {
        readings.add(of(linear), forces, &curve, |p| {
            (p.linear_rigidity_pn_nm2, p.evidence)
        });
        readings.add(of(elastica), forces, &curve, |p| {
            (p.elastica_rigidity_pn_nm2, p.evidence)
        });
    }
    let curve = shear_by_force(&specimen, &SHEAR_PN, azimuth)?;
    let of_shear = of(Protocol::ShearApparent);
    readings.add(of_shear, &SHEAR_PN, &curve, |p| {
        (p.apparent_rigidity_pn, p.evidence)
    });
    Ok(readings)
}

impl Readings {
    /// Adds the points of a curve. A curve with unreached loads is omitted.
    fn add<P>(
        &mut self,
        (protocol, seed, azimuth): (Protocol, u64, f64),
        prescribed: &[f64],
        curve: &Curve<P>,
        read: impl Fn(&P) -> (f64, Evidence),
    ) {
        if !curve.unreached.is_empty() {
            self.unreached += curve.unreached.len();
            return;
        }
        let points = prescribed.iter().zip(&curve.points);
        self.all.extend(points.map(|(&at, point)| {
            let (secant, evidence) = read(point);
            Reading {
                protocol,
                seed,
                azimuth,
                at,
                secant,
                evidence,
            }
        }));
    }

    /// Adds readings of shear, without the bending of a guided beam with the rigidity of the filament at rest.
    fn without_bending(&mut self) {
        let bending = self.sample(Protocol::Couples, AT_REST).mean;
        let length = BENT_RISES * Monomers::default().rise_nm;
        let sheared = self
            .of(Protocol::ShearApparent)
            .filter(|r| r.at < MOST_SHEAR_PN);
        let without = sheared.flat_map(|r| {
            let shear = r.at / r.secant - r.at * length.powi(2) / (12.0 * bending);
            [
                (Protocol::ShearSecant, r.at / shear),
                (Protocol::ShearCubic, r.at / shear.powi(3)),
            ]
            .map(|(protocol, secant)| Reading {
                protocol,
                secant,
                ..*r
            })
        });
        let without: Vec<Reading> = without.collect();
        self.all.extend(without);
    }

    fn of(&self, protocol: Protocol) -> impl Iterator<Item = &Reading> {
        self.all.iter().filter(move |r| r.protocol == protocol)
    }

    fn sample(&self, protocol: Protocol, at: f64) -> SampleStatistics {
        let own = self.of(protocol).filter(|r| is_at(r, at));
        sample(own.map(|r| r.secant))
    }

    /// Prescribed values in the order of the protocol.
    fn prescribed(&self, protocol: Protocol) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::new();
        for reading in self.of(protocol) {
            if !values.iter().any(|&at| is_at(reading, at)) {
                values.push(reading.at);
            }
        }
        values
    }

    /// Largest relative spread of the bending rigidity over the azimuths of a sampling.
    fn anisotropy(&self) -> f64 {
        let bent = self.of(Protocol::Couples).filter(|r| is_at(r, BENT));
        let bent: Vec<&Reading> = bent.collect();
        let samplings = bent.chunk_by(|a, b| a.seed == b.seed);
        largest(samplings.map(|s| sample(s.iter().map(|r| r.secant)).spread()))
    }
}

fn is_at(reading: &Reading, at: f64) -> bool {
    reading.at.total_cmp(&at).is_eq()
}

fn settings(draft: &mut Draft<'_>, readings: &Readings) -> Result<(), String> {
    let count = |protocol, at| readings.sample(protocol, at).count;
    let bent = count(Protocol::Couples, BENT) / AZIMUTHS_DEG.len();
    let unstable = readings.all.iter().filter(|r| !r.evidence.is_stable());
    let length = |rises: f64| format!("{:.2}", rises * Monomers::default().rise_nm);
    let values: Values<'_> = &[
        ("stretched", &count(Protocol::StretchByForce, PULL_PN)),
        ("stretched_nm", &length(RISES)),
        ("bent", &bent),
        ("azimuths", &format!("{AZIMUTHS_DEG:?}")),
        ("bent_nm", &length(BENT_RISES)),
        ("unstable", &unstable.count()),
        ("count", &readings.all.len()),
        ("unreached", &readings.unreached),
        ("mismatch", &format!("{:.0e}", readings.mismatch)),
    ];
    draft.describe("table4", values)
}

fn describe(sample: &SampleStatistics) -> String {
    if sample.count == 1 {
        return "one filament".to_owned();
    }
    format!(
        "mean of {}, sd {}, range {} to {}",
        sample.count,
        significant(sample.sd()),
        significant(sample.low),
        significant(sample.high)
    )
}

/// Rows of all measurements of one kind. Names of the mean filament begin with `mean-filament/`.
fn rigidities(draft: &mut Draft<'_>, readings: &Readings, kind: Kind) -> Result<(), String> {
    let path = match kind {
        Kind::MEAN => "mean-filament/",
        _ => "",
    };
    for rigidity in RIGIDITIES.iter() {
        let (unit, words) = (rigidity.unit.as_str(), &rigidity.words);
        let name = format!("{path}{}", rigidity.quantity);
        let sample = |at| readings.sample(rigidity.protocol, at);
        let note = |s: &SampleStatistics| format!("{words}, {}", describe(s));
        let Some(at) = rigidity.at else {
            for at in readings.prescribed(rigidity.protocol) {
                let s = sample(at);
                draft.row(format!("{name}/{at}"), unit, s.mean, note(&s));
            }
            continue;
        };
        let s = sample(at);
        if ["s3", "b1"].contains(&&*rigidity.quantity) {
            scatter(draft, &name, unit, s.sd());
        }
        draft.scattered(name, unit, (s.mean, s.sd()), note(&s));
    }
    let note = "largest difference between two azimuths of one sampling, divided by its mean";
    let anisotropy = readings.anisotropy();
    draft.row(format!("{path}b1/anisotropy"), "", anisotropy, note);
    let per_um = 1e-3 / monomer::THERMAL_ENERGY;
    let unscaled = per_um / monomer::RIGIDITY_SCALE;
    for (name, at, scale) in [
        ("persistence_length_um", BENT, per_um),
        ("persistence_length_unscaled_um", BENT, unscaled),
        ("persistence_length_um/at-rest", AT_REST, per_um),
    ] {
        let b1 = readings.sample(Protocol::Couples, at);
        let length = (b1.mean * scale, b1.sd() * scale);
        draft.scattered(format!("{path}{name}"), "um", length, "");
    }
    twisting(draft, path, kind)
}

fn scatter(draft: &mut Draft<'_>, of: &str, unit: &'static str, sd: f64) {
    let note = "standard deviation of a single filament";
    draft.row(format!("{of}/sd"), unit, sd, note);
}

/// Rows of the largest twisting rigidity in each direction.
fn twisting(draft: &mut Draft<'_>, path: &str, kind: Kind) -> Result<(), String> {
    let ensemble = core(draft)?;
    let entries = entries(Table::Rigidity);
    for (name, direction) in [("b3_min", "under"), ("b3_max", "over")] {
        let own = entries
            .iter()
            .filter(|entry| entry.direction() == direction);
        let samples =
            own.map(|entry| (entry.phi_deg, ensemble.sample(kind, entry, Table::Rigidity)));
        let (phi, s) = samples
            .max_by(|a, b| a.1.mean.total_cmp(&b.1.mean))
            .ok_or("no entries")?;
        let note = format!(
            "largest mean secant in {direction}-twist, at the twist of {phi} deg in Table 3"
        );
        draft.scattered(format!("{path}{name}"), "pN nm^2", (s.mean, s.sd()), note);
        scatter(draft, &format!("{path}{name}"), "pN nm^2", s.sd());
    }
    Ok(())
}

fn derived(draft: &mut Draft<'_>) {
    let area = rod::CROSS_SECTION_AREA;
    let inertia = area.powi(2) / (4.0 * PI);
    let known = |name: &str| draft.value(name).unwrap_or(f64::NAN);
    let (young, stretching) = (known("b1") / inertia, known("s3"));
    let b3_mean = 0.5 * (known("b3_min") + known("b3_max"));
    let shear_modulus = YOUNG / (2.0 * (1.0 + POISSON));
    let shearing = STIFFER * 4.0 / 3.0 * shear_modulus * area;
    for (name, unit, value) in [
        ("young_modulus", "pN/nm^2", young),
        ("s3_over_ea", "", stretching / (young * area)),
        ("b3_mean", "pN nm^2", b3_mean),
        ("printed/ea", "pN", YOUNG * area),
        ("printed/s1", "pN", shearing),
        ("rigidity_scale", "", monomer::RIGIDITY_SCALE),
        ("s_perp", "pN/nm", monomer::LATERAL_RIGIDITY),
        ("s_par", "pN/nm", monomer::LONGITUDINAL_RIGIDITY),
    ] {
        draft.row(name, unit, value, "");
    }
}

const COLUMNS: [Column<Reading>; 10] = [
    ("protocol", |r| format!("{:?}", r.protocol)),
    ("seed", |r| r.seed.to_string()),
    ("azimuth_deg", |r| r.azimuth.to_string()),
    ("prescribed", |r| number(r.at)),
    ("secant", |r| number(r.secant)),
    ("residual_pn", |r| number(r.evidence.residual_force_pn)),
    ("negative_eigenvalues", |r| {
        r.evidence.certificate.negative.to_string()
    }),
    ("unresolved_eigenvalues", |r| {
        r.evidence.certificate.unresolved.to_string()
    }),
    ("saddles_left", |r| r.evidence.saddles_left.to_string()),
    ("jumps", |r| r.evidence.jumps.to_string()),
];
