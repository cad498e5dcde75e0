//! Data from filaments of monomers: twisted, bent and sheared.

use super::table::FitData;
use crate::measure::{
    Curve, MeasureError, Specimen, TwistPoint, bend_by_couples, bend_by_tip_force, bend_twisted,
    over_samplings_and_azimuths, sampled_by, shear_by_force, stretch_by_force, twist,
};
use actin_sim::Monomers;

/// Rises between the inner held monomers of a twisted filament (73.94 nm, as in Table 3).
const SHORT: f64 = 27.0;
/// Rises between the inner held monomers of bent and sheared filaments (150.6 and 301.2 nm).
const LONG: [f64; 2] = [55.0, 110.0];
/// Angles (deg) in both senses, up to the largest reliable angle of the paper.
const TURNS_DEG: [f64; 13] = [
    5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 60.0, 80.0, 100.0, 125.0, 150.0, 175.0, 200.0,
];
const CURVATURES: [f64; 14] = [
    1e-4, 3e-4, 6e-4, 1e-3, 1.5e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6.5e-3, 8e-3, 1e-2, 1.25e-2, 1.5e-2,
];
/// Twists of bent filaments, and tilts per length (rad/nm).
const TWISTS: [f64; 6] = [-0.02, -0.01, -0.005, 0.005, 0.01, 0.02];
const TILTS: [f64; 2] = [1e-3, 1e-2];
/// Forces at the tip of a cantilever of 160 nm (pN).
pub(super) const TIP_FORCES: [f64; 9] = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0];
/// Axial forces (pN). The fit uses tension; compression is only printed.
const AXIAL_FORCES: [f64; 6] = [-20.0, -1.0, 1.0, 10.0, 100.0, 500.0];
/// Transverse forces at the guided end of long filaments (pN).
const SHEAR_FORCES: [f64; 7] = [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0];
const AZIMUTHS_DEG: [f64; 4] = [0.0, 90.0, 180.0, 270.0];

#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub length_nm: f64,
    /// Prescribed curvature (rad/nm) or force (pN).
    pub x: f64,
    /// Mean and standard error over azimuths.
    pub mean: f64,
    pub error: f64,
}

/// Data of the bending, shear and stretch fits.
#[derive(Clone, Debug)]
pub(crate) struct BendData {
    /// Secant bending rigidity (pN nm^2) against curvature (rad/nm).
    pub bend: Vec<Point>,
    /// Twist (rad/nm), curvature (rad/nm) and bending rigidity (pN nm^2) of twisted filaments.
    pub twisted: Vec<[f64; 3]>,
    /// Secant stretching rigidity (pN) against axial force (pN) at blocked turn.
    pub stretch: Vec<Point>,
    /// Tip deflection (nm) against force (pN).
    pub tips: Vec<Point>,
    /// Displacement (nm) of a guided end against force (pN).
    pub guided: Vec<Point>,
}

fn filament(rises: f64) -> Specimen {
    let monomers = Monomers::default();
    Specimen::ellipsoids(rises * monomers.rise_nm, monomers)
}

fn failed(what: &str) -> impl Fn(MeasureError) -> String + '_ {
    move |error| format!("{what}: {error}")
}

/// B3 and dL/L of the default filament with quadrature bonds.
pub(super) fn twisted() -> Result<FitData, String> {
    let turns: Vec<f64> = TURNS_DEG.iter().flat_map(|&turn| [-turn, turn]).collect();
    let curve = twist(&filament(SHORT), &turns).map_err(failed("twisting"))?;
    let column = |value: fn(&TwistPoint) -> f64| {
        let points = curve.points.iter();
        points.map(|p| (p.curvature_rad_per_nm, value(p))).collect()
    };
    Ok(FitData {
        source: "the mean filament, 73.9 nm, measured now".to_owned(),
        rigidity: column(|p| p.rigidity_pn_nm2),
        length: column(|p| p.relative_length_change),
        ..FitData::default()
    })
}

/// Measures the mean filament at all azimuths.
fn around<P: Send>(
    specimen: &Specimen,
    measure: impl Fn(&Specimen, f64) -> Result<Curve<P>, MeasureError> + Sync,
) -> Result<Vec<Curve<P>>, MeasureError> {
    over_samplings_and_azimuths(specimen, &[0], &AZIMUTHS_DEG, measure)
}

fn points<P>(curves: &[Curve<P>], x: impl Fn(&P) -> f64, y: impl Fn(&P) -> f64) -> Vec<Point> {
    let length_nm = curves.first().map_or(0.0, |curve| curve.length_nm);
    let samples = sampled_by(curves, x, y).into_iter();
    samples
        .map(|(x, sample)| Point {
            length_nm,
            x,
            mean: sample.mean,
            error: if sample.count > 1 { sample.error } else { 0.0 },
        })
        .collect()
}

impl BendData {
    pub(super) fn measure() -> Result<Self, String> {
        let bent = around(&filament(LONG[0]), |s, a| {
            bend_by_couples(s, &CURVATURES, a)
        });
        let bent = bent.map_err(failed("bending"))?;
        let tips = around(&Specimen::ellipsoids(160.0, Monomers::default()), |s, a| {
            bend_by_tip_force(s, &TIP_FORCES, a)
        });
        let tips = tips.map_err(failed("cantilevers"))?;
        let mut guided = Vec::new();
        for rises in LONG {
            let curves = around(&filament(rises), |s, a| shear_by_force(s, &SHEAR_FORCES, a));
            let curves = curves.map_err(failed("shearing"))?;
            guided.extend(points(&curves, |p| p.force_pn, |p| p.shift_nm));
        }
        let stretched = stretch_by_force(&filament(SHORT), &AXIAL_FORCES);
        let stretched = [stretched.map_err(failed("stretching"))?];
        Ok(Self {
            stretch: points(&stretched, |p| p.force_pn, |p| p.rigidity_pn),
            bend: points(&bent, |p| p.curvature_rad_per_nm, |p| p.rigidity_pn_nm2),
            twisted: twisted_bends()?,
            tips: points(&tips, |p| p.force_pn, |p| p.deflection_nm),
            guided,
        })
    }
}

/// Bending rigidities of twisted filaments. Filaments are short, since the turn grows with length.
fn twisted_bends() -> Result<Vec<[f64; 3]>, String> {
    let mut all = Vec::new();
    for k3 in TWISTS {
        let curves = around(&filament(SHORT), |s, a| bend_twisted(s, k3, &TILTS, a))
            .map_err(failed("bending of twisted filaments"))?;
        let rigidities = points(&curves, |p| p.tilt_rad_per_nm, |p| p.rigidity_pn_nm2);
        let curvatures = points(&curves, |p| p.tilt_rad_per_nm, |p| p.curvature_rad_per_nm);
        let pairs = rigidities.iter().zip(&curvatures);
        all.extend(pairs.map(|(b, k)| [k3, k.mean, b.mean]));
    }
    Ok(all)
}
