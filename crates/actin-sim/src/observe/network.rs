//! Order, size, connections, linker forces and virial of all filaments.

use super::{Checked, RecordTimes, View};
use crate::loads::loads_of;
use crate::scene::{Factor, Scene, Setting, lowest_joined};
use crate::{Assembly, Part};
use actin_mechanics::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Components of symmetric tensors, in the order of their columns.
const COMPONENTS: [(&str, usize, usize); 6] = [
    ("xx", 0, 0),
    ("yy", 1, 1),
    ("zz", 2, 2),
    ("xy", 0, 1),
    ("xz", 0, 2),
    ("yz", 1, 2),
];

/// Index of the shear component of a periodic box.
const XZ: usize = 4;

/// Columns before those of the virial.
const SCALARS: [&str; 16] = [
    "order_parameter",
    "polarity",
    "gyration_radius_nm",
    "mesh_size_nm",
    "bound_linkers",
    "clusters",
    "largest_cluster",
    "linker_tension_mean_pn",
    "linker_tension_rms_pn",
    "linker_tension_smallest_pn",
    "linker_tension_largest_pn",
    "linker_tension_p05_pn",
    "linker_tension_p25_pn",
    "linker_tension_p50_pn",
    "linker_tension_p75_pn",
    "linker_tension_p95_pn",
];

/// Percentages of the quantiles of tensions.
const PERCENT: [usize; 5] = [5, 25, 50, 75, 95];

/// Columns of the moduli of an oscillating periodic box.
const MODULI: [&str; 2] = ["network_storage_modulus_pa", "network_loss_modulus_pa"];

/// Pressure of 1 pN/nm^2 (Pa).
const PA: f64 = 1e6;

/// Fewest records per period for moduli.
const FEWEST: f64 = 4.0;

/// Relative tolerance of multiples of times.
const SAME: f64 = 1e-6;

/// Strain `amplitude sin(2 pi time / period + phase)`, without its mean.
#[derive(Debug)]
struct Oscillation {
    amplitude: f64,
    period_ns: f64,
    phase: f64,
    /// Time of the first record of means, which is not counted (ns).
    from_ns: f64,
}

impl Oscillation {
    fn new(scene: &Scene) -> Option<Self> {
        let periodic = scene.periodic.as_ref().filter(|one| one.oscillates())?;
        let is_sheared = |setting: &Setting| matches!(setting, Setting::Shear { .. });
        let mut settings = scene.path.iter().flat_map(|stage| &stage.set);
        match periodic.factor {
            Factor::Sine {
                period_ns,
                phase_deg,
                amplitude,
                ..
            } if !settings.any(is_sheared) => Some(Self {
                amplitude: amplitude * periodic.strain,
                period_ns,
                phase: phase_deg.to_radians(),
                from_ns: scene.burn_in().unwrap_or_default(),
            }),
            _ => None,
        }
    }

    /// Terms whose means over whole periods are the storage and loss modulus, for a stress at a time (ns): `2 stress
    /// sin(phase) / amplitude` and `2 stress cos(phase) / amplitude`. NaN before the means.
    fn moduli(&self, stress: f64, time: f64) -> [f64; 2] {
        if time - self.from_ns <= SAME * self.period_ns {
            return [f64::NAN; 2];
        }
        let (sine, cosine) = (TAU * time / self.period_ns + self.phase).sin_cos();
        [sine, cosine].map(|part| 2.0 * stress * part / self.amplitude)
    }

    /// Requires records at equal distances over whole periods, whose means are free of other harmonics.
    fn check(&self, times: &RecordTimes) -> Checked {
        let (every, duration) = (times.every_ns, times.duration_ns);
        let is_multiple =
            |of: f64, one: f64| (of / one - (of / one).round()).abs() <= SAME * of / one;
        let after = duration - self.from_ns;
        let is_sampled = self.period_ns >= FEWEST * every * (1.0 - SAME)
            && is_multiple(self.period_ns, every)
            && is_multiple(self.from_ns, every);
        if is_sampled && after > 0.0 && is_multiple(after, self.period_ns) {
            return Ok(());
        }
        let rule = format!(
            "is the period of the strain (periodic.factor). It must be a multiple of the time between records, {every:?} ns, at \
             least {FEWEST} times as long, and the time after burn_in_ns, {after:?} ns, a multiple of it (by default burn_in_ns \
             is a fifth of the duration)"
        );
        Err((MODULI[0], self.period_ns, rule))
    }
}

pub(super) fn columns(scene: &Scene) -> Vec<String> {
    let scalars = SCALARS.iter().map(|name| format!("network_{name}"));
    let virial = COMPONENTS
        .iter()
        .map(|(name, ..)| format!("network_virial_{name}_pn_nm"));
    let names = COMPONENTS.iter().filter(|_| scene.periodic.is_some());
    let stress = names.map(|(name, ..)| format!("network_stress_{name}_pa"));
    let moduli = Oscillation::new(scene).map(|_| MODULI.map(str::to_owned));
    let moduli = moduli.into_iter().flatten();
    scalars.chain(virial).chain(stress).chain(moduli).collect()
}

/// Period (ns) of the terms of a modulus, which vary within it also without noise; `None` for other columns.
pub(super) fn period_ns(scene: &Scene, column: &str) -> Option<f64> {
    let oscillation = Oscillation::new(scene).filter(|_| MODULI.contains(&column))?;
    Some(oscillation.period_ns)
}

/// Refuses records from which the moduli of an oscillating box cannot be averaged.
pub(super) fn check(scene: &Scene, times: Option<&RecordTimes>) -> Checked {
    match (Oscillation::new(scene), times) {
        (Some(oscillation), Some(times)) => oscillation.check(times),
        _ => Ok(()),
    }
}

/// Properties of a network of filaments.
pub(super) fn values(view: &View<'_>) -> Vec<f64> {
    let scene = &view.assembly.scene;
    let volume = scene.periodic_volume();
    let edges = Edges::new(view);
    let linkers = Linkers::new(view);
    let sizes = cluster_sizes(view.assembly.filaments.len(), &linkers.joined);
    let largest = sizes.iter().copied().max().unwrap_or_default();
    let mut row = vec![
        edges.order,
        edges.mean,
        edges.gyration.trace().sqrt(),
        edges.mesh_size_nm(volume),
        linkers.tensions.len() as f64,
        sizes.len() as f64,
        largest as f64,
    ];
    row.extend(statistics(&linkers.tensions));
    row.extend(quantiles(linkers.tensions));
    let virial = virial(view);
    let virial = COMPONENTS.map(|(_, i, j)| 0.5 * (virial[(i, j)] + virial[(j, i)]));
    row.extend(virial);
    if let Some(volume) = volume {
        let stress = virial.map(|one| one / volume * PA);
        row.extend(stress);
        if let Some(oscillation) = Oscillation::new(scene) {
            row.extend(oscillation.moduli(stress[XZ], view.state.time));
        }
    }
    row
}

/// Averages over the edges of all centre lines, weighted by length.
struct Edges {
    /// Largest eigenvalue of `(3 <t t^T> - 1) / 2` with unit tangents `t`.
    order: f64,
    /// Length of the mean tangent.
    mean: f64,
    /// Total length (nm).
    length: f64,
    /// Mean square distances from the centre (nm^2).
    gyration: Matrix3,
}

impl Edges {
    fn new(view: &View<'_>) -> Self {
        let (mut length, mut tangent, mut place) = (0.0, Vector3::zeros(), Vector3::zeros());
        let (mut tensor, mut squares) = (Matrix3::zeros(), Matrix3::zeros());
        for filament in 0..view.assembly.filaments.len() {
            for pair in view.ribbon(filament).points_nm.windows(2) {
                let edge = pair[1] - pair[0];
                let (weight, middle) = (edge.norm(), 0.5 * (pair[0] + pair[1]));
                length += weight;
                tangent += edge;
                let outer = edge * edge.transpose();
                tensor += outer / weight.max(f64::MIN_POSITIVE);
                place += weight * middle;
                squares += weight * (middle * middle.transpose() + outer / 12.0);
            }
        }
        let order = 0.5 * (3.0 * tensor / length - Matrix3::identity());
        let centre = place / length;
        Self {
            order: order.symmetric_eigenvalues().max(),
            mean: tangent.norm() / length,
            length,
            gyration: squares / length - centre * centre.transpose(),
        }
    }

    /// Distance `sqrt(3 V / L)` between filaments of the total length `L` in a volume `V` (nm^3), by default the volume
    /// of the ellipsoid with this gyration tensor.
    fn mesh_size_nm(&self, volume: Option<f64>) -> f64 {
        let of_ellipsoid = || {
            let product = self.gyration.determinant().max(0.0);
            4.0 / 3.0 * PI * (125.0 * product).sqrt()
        };
        (3.0 * volume.unwrap_or_else(of_ellipsoid) / self.length).sqrt()
    }
}

/// Bound linkers.
struct Linkers {
    /// Tension of each (pN); negative for a compressed linker.
    tensions: Vec<f64>,
    /// Pairs of filaments that they join.
    joined: Vec<[usize; 2]>,
}

impl Linkers {
    fn new(view: &View<'_>) -> Self {
        let mut found = Self {
            tensions: Vec::new(),
            joined: Vec::new(),
        };
        for (i, written) in view.assembly.scene.linkers.iter().enumerate() {
            let (linker, is_bound) = view.assembly.linker_in(i, view.state);
            if is_bound {
                let extension = linker.extension(view.state);
                found.tensions.push(written.stiffness_pn_per_nm * extension);
                let (filament, other) = view.assembly.linked_filaments(i, view.state);
                found.joined.extend(other.map(|other| [filament, other]));
            }
        }
        found
    }
}

/// Returns the number of filaments of each cluster of joined filaments.
fn cluster_sizes(filaments: usize, joined: &[[usize; 2]]) -> Vec<usize> {
    let mut sizes = vec![0; filaments];
    for representative in lowest_joined(filaments, joined.iter().copied()) {
        sizes[representative] += 1;
    }
    sizes.retain(|size| *size > 0);
    sizes
}

/// Returns mean, root mean square, smallest and largest tension; NaN without linkers.
fn statistics(tensions: &[f64]) -> [f64; 4] {
    let count = tensions.len() as f64;
    let mean = tensions.iter().sum::<f64>() / count;
    let square = tensions.iter().map(|t| t * t).sum::<f64>() / count;
    let smallest = tensions.iter().copied().fold(f64::NAN, f64::min);
    let largest = tensions.iter().copied().fold(f64::NAN, f64::max);
    [mean, square.sqrt(), smallest, largest]
}

/// Quantiles of tensions, linear between neighbouring values; NaN without linkers.
fn quantiles(mut tensions: Vec<f64>) -> [f64; PERCENT.len()] {
    tensions.sort_by(f64::total_cmp);
    let Some(last) = tensions.len().checked_sub(1) else {
        return [f64::NAN; PERCENT.len()];
    };
    PERCENT.map(|percent| {
        let (below, rest) = (percent * last / 100, percent * last % 100);
        let [lower, upper] = [below, last.min(below + 1)].map(|k| tensions[k]);
        lower + (upper - lower) * rest as f64 / 100.0
    })
}

/// Returns `-sum r f^T` over all points with the forces `f` of filaments, linkers between sites and contacts (pN nm).
/// Linkers to periodic images and contacts with them add the displacement of the image times their force.
///
/// These forces add up to zero, so that the tensor does not depend on the origin. Its symmetric part is the derivative of
/// their energy with respect to a uniform strain of all points at fixed orientations.
fn virial(view: &View<'_>) -> Matrix3 {
    let interactions = view.assembly.system.interactions();
    let terms = interactions.iter().zip(&view.assembly.terms);
    let internal = terms.filter(|(_, term)| is_internal(view.assembly, term.part));
    let loads = loads_of(internal.map(|(interaction, _)| interaction), view.state);
    let points = 0..view.assembly.points.len();
    let of_points = points.fold(Matrix3::zeros(), |sum, i| {
        sum - view.state.points.position.get(i) * loads.force.get(i).transpose()
    });
    if view.assembly.cell.is_none() {
        return of_points;
    }
    let repelled = view.assembly.repelled.as_ref();
    let of_contacts =
        repelled.and_then(|one| Some(one.contacts.as_ref()?.periodic_virial(view.state)));
    let of_others = of_points + of_contacts.unwrap_or_else(Matrix3::zeros);
    (0..view.assembly.linkers.len()).fold(of_others, |sum, i| {
        let (linker, is_bound) = view.assembly.linker_in(i, view.state);
        let image = linker.periodic_displacement(view.state);
        sum + image * linker.force(view.state).transpose() * f64::from(u8::from(is_bound))
    })
}

fn is_internal(assembly: &Assembly, part: Part) -> bool {
    match part {
        Part::Section(_) | Part::Junction(_) | Part::Contacts => true,
        Part::Linker(linker) => assembly.scene.linkers[linker].to.is_some(),
        Part::Load(_) | Part::Clamp(_) | Part::Wall(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{build, observe, value};
    use super::cluster_sizes;
    use super::quantiles;
    use crate::Assembly;
    use std::f64::consts::PI;

    const BUNDLE: &str = "Scene(
        arrangements: [Bundle(
            filament: Filament(
                sections: [Rod(from_nm: 0.0, to_nm: 300.0)], rod: (law: Constant), direction: (0.0, 1.0, 1.0),
            ),
            count: 7, spacing_nm: 12.0, mixed_polarity: true, seed: 2,
        )],
        linker_sets: [LinkersBetween(
            per_filament: 2.0, reach_nm: 15.0, stiffness_pn_per_nm: 3.0, rest_length_nm: 11.0, seed: 1,
        )],
        observe: [Network],
        task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
    )";

    /// Bound crosslinkers join the filaments of their hands.
    #[test]
    fn crosslinkers_form_clusters() {
        let text = "Scene(
            filaments: [
                Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)]),
                Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)], at_nm: (500.0, 0.0, 0.0)),
                Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)], at_nm: (512.0, 0.0, 0.0)),
            ],
            crosslinkers: [Crosslinkers(count: 3, stiffness_pn_per_nm: 0.2, rest_length_nm: 10.0,
                attach_per_ns: 1e-4, bind_per_ns: 1e-4, unbinds: Breaking(rate_per_ns: 1e-7), seed: 8)],
            clamps: [Clamp(end: Start), Clamp(filament: 1, end: Start), Clamp(filament: 2, end: Start)],
            observe: [Network],
            task: Brownian(duration_ms: 0.1, temperature_k: 298.0, time_step_ns: 500.0, seed: 1),
        )";
        let assembly = build(text);
        let (trajectory, _) = crate::Plan::new(&assembly).unwrap().run().unwrap();
        let last = &trajectory.records.last().unwrap().state;
        let observed = observe(&assembly, last);
        assert!(value(&assembly, &observed, "network_bound_linkers") > 0.0);
        assert!((value(&assembly, &observed, "network_clusters") - 2.0).abs() < 1e-12);
    }

    /// Crosslinkers bind across a face of a periodic box, to sites 20 nm away.
    #[test]
    fn crosslinkers_bind_to_nearest_images() {
        let text = "Scene(
            filaments: [
                Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)]),
                Filament(rod: (law: Constant), sections: [Rod(from_nm: 0.0, to_nm: 100.0, segments: 2)], at_nm: (180.0, 0.0, 400.0)),
            ],
            crosslinkers: [Crosslinkers(count: 3, stiffness_pn_per_nm: 0.2, rest_length_nm: 20.0, reach_nm: 20.0,
                attach_per_ns: 1e-4, bind_per_ns: 1e-4, unbinds: Breaking(rate_per_ns: 1e-7), seed: 8)],
            periodic: PeriodicBox(size_nm: (200.0, 200.0, 200.0)),
            clamps: [Clamp(end: Start), Clamp(filament: 1, end: Start)],
            observe: [Network],
            task: Brownian(duration_ms: 0.1, temperature_k: 298.0, time_step_ns: 500.0, seed: 1),
        )";
        let assembly = build(text);
        let (trajectory, _) = crate::Plan::new(&assembly).unwrap().run().unwrap();
        let row = &trajectory.records.last().unwrap().row.observed;
        assert!(value(&assembly, row, "network_bound_linkers") > 0.0);
        // 0.2 pN/nm times at most the reach and thermal motion.
        assert!(value(&assembly, row, "network_linker_tension_largest_pn") < 8.0);
    }

    /// A bundle has order parameter 1, the polarity of its directions, and linkers with known tensions.
    #[test]
    fn a_bundle_is_ordered_and_linked() {
        let assembly = build(BUNDLE);
        let row = observe(&assembly, &assembly.rest);
        let column = |name: &str| value(&assembly, &row, &format!("network_{name}"));
        assert!((column("order_parameter") - 1.0).abs() < 1e-9);
        let directions = assembly
            .scene
            .filaments()
            .map(|one| one.direction[2].signum());
        let polarity = directions.sum::<f64>().abs() / 7.0;
        assert!((column("polarity") - polarity).abs() < 1e-9);
        assert!((column("bound_linkers") - 14.0).abs() < 0.5);
        // Sites at equal arc length are 12 nm apart, others further, up to the reach.
        assert!((column("linker_tension_smallest_pn") - 3.0).abs() < 1e-6);
        assert!(column("linker_tension_largest_pn") <= 12.0);
        let [along, across] = [300.0_f64.powi(2) / 12.0, 3.0 / 7.0 * 144.0];
        let radius = (along + 2.0 * across).sqrt();
        assert!((column("gyration_radius_nm") - radius).abs() < 1e-6);
        let volume = 4.0 / 3.0 * PI * (125.0 * along * across * across).sqrt();
        // Cancellation in the gyration tensor: 1e-16 of 1e4 nm^2 relative to 60 nm^2.
        let mesh = (volume / 700.0).sqrt();
        assert!((column("mesh_size_nm") / mesh - 1.0).abs() < 1e-9);
    }

    #[test]
    fn quantiles_are_linear_between_values() {
        let found = quantiles(vec![4.0, 1.0, 2.0, 3.0, 0.0]);
        let errors = found.iter().zip([0.2, 1.0, 2.0, 3.0, 3.8]);
        assert!(errors.map(|(a, b)| (a - b).abs()).all(|e| e < 1e-15));
        assert!(
            quantiles(vec![7.0])
                .iter()
                .all(|value| (value - 7.0).abs() < 1e-15)
        );
        assert!(quantiles(Vec::new()).iter().all(|value| value.is_nan()));
    }

    /// The virial is the derivative of the energy with respect to a uniform strain of all points.
    #[test]
    fn the_virial_is_a_derivative_with_respect_to_strain() {
        let assembly = build(BUNDLE);
        let row = observe(&assembly, &assembly.rest);
        let energy = |i: usize, j: usize, strain: f64| {
            let mut state = assembly.rest.clone();
            for k in 0..state.points.len() {
                let mut place = state.points.position.get(k);
                let (x, y) = (place[i], place[j]);
                place[i] += 0.5 * strain * y;
                place[j] += 0.5 * strain * x;
                state.points.position.set(k, place);
            }
            let interactions = assembly.system.interactions().iter();
            interactions.map(|one| one.energy(&state)).sum::<f64>()
        };
        // Central differences of energies near 100 pN nm are exact to 1e-16 * 100 / h from rounding and h^2 / 6 times a
        // third derivative of 1e6 pN nm.
        let h = 1e-5;
        for (name, i, j) in super::COMPONENTS {
            let slope = (energy(i, j, h) - energy(i, j, -h)) / (2.0 * h);
            let virial = value(&assembly, &row, &format!("network_virial_{name}_pn_nm"));
            assert!((slope - virial).abs() < 1e-4, "{name}: {slope} {virial}");
        }
    }

    const SHEARED: &str = "Scene(
        arrangements: [Random(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 200.0, segments: 5)], rod: (law: Constant)),
            count: 8, box_nm: (150.0, 150.0, 150.0), seed: 1,
        )],
        linker_sets: [LinkersBetween(
            per_filament: 7.0, reach_nm: 60.0, site_spacing_nm: 9.0, stiffness_pn_per_nm: 3.0, radius_nm: 4.0, seed: 1,
        )],
        periodic: PeriodicBox(size_nm: (150.0, 150.0, 150.0), strain: 0.05),
        path: [Stage(set: [Shear(factor: 0.99)]), Stage(set: [Shear(factor: 1.0)]), Stage(set: [Shear(factor: 1.01)])],
        observe: [Network],
        task: Equilibrium(),
    )";

    /// The shear stress times the volume is the derivative of the energy of equilibria with respect to the strain.
    #[test]
    fn the_shear_stress_is_a_derivative_of_the_energy() {
        let assembly = build(SHEARED);
        let mut linkers = assembly.linkers.iter();
        assert!(linkers.any(|linker| linker.image().is_some()));
        check_shear_stress(&assembly);
        let angular = SHEARED.replace(
            "radius_nm: 4.0,",
            "radius_nm: 4.0, tilt_pn_nm: 2000.0, twist_pn_nm: 1000.0,",
        );
        let assembly = build(&angular);
        let mut linkers = assembly.linkers.iter();
        assert!(linkers.all(|linker| linker.angles().is_some()));
        check_shear_stress(&assembly);
        let repelled = SHEARED
            .replace(
                "seed: 1,\n        )],\n        linker_sets",
                "seed: 1, apart_nm: 15.0,\n        )],\n        linker_sets",
            )
            .replace(
                "observe:",
                "repulsion: Repulsion(radius_nm: 10.0), observe:",
            );
        let assembly = build(&repelled);
        let contacts = assembly.repelled.as_ref().unwrap().contacts.as_ref();
        let across = contacts.unwrap().periodic_virial(&assembly.rest);
        assert!(across.amax() > 100.0, "{across}");
        check_shear_stress(&assembly);
    }

    fn check_shear_stress(assembly: &Assembly) {
        let (trajectory, _) = crate::Plan::new(assembly).unwrap().run().unwrap();
        let records = &trajectory.records;
        let record = |path: f64| {
            let mut all = records.iter();
            let found = all.find(|record| (record.at.value() - path).abs() < 1e-9);
            found.expect("a stage ends here")
        };
        let energy = |path: f64| record(path).row.potential_pn_nm();
        let slope = (energy(3.0) - energy(1.0)) / (0.02 * 0.05);
        let row = &record(2.0).row.observed;
        let virial = value(assembly, row, "network_virial_xz_pn_nm");
        let stress = value(assembly, row, "network_stress_xz_pa");
        println!("{slope} {virial} pN nm, {stress} Pa");
        // Truncation: strains differ by 1 %.
        assert!((slope / virial - 1.0).abs() < 1e-3 && stress > 0.0);
        assert!((stress * 150.0_f64.powi(3) / (virial * 1e6) - 1.0).abs() < 1e-12);
    }

    /// Two rods across the plane of shear, joined by symmetric linkers to images, are a Maxwell element:
    ///
    /// ```text
    /// G' = G x^2 / (1 + x^2),   G'' = G x / (1 + x^2),   G = k h^2 / V
    /// ```
    ///
    /// `x` is the frequency in units of the relaxation rate, and `h` the distance of the joined sites along z.
    #[test]
    fn moduli_of_a_maxwell_element() {
        let text = "Scene(
            filaments: [
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 2)], rod: (law: Constant),
                    direction: (0.0, 1.0, 0.0), at_nm: (0.0, 0.0, 40.0)),
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 40.0, segments: 2)], rod: (law: Constant),
                    direction: (0.0, 1.0, 0.0), at_nm: (-30.0, 0.0, 0.0)),
            ],
            linkers: [
                Linker(at_nm: 20.0, to: Site(filament: 1, at_nm: 20.0), image: (0, 0, 1), stiffness_pn_per_nm: 0.02,
                    rest_length_nm: 50.0),
                Linker(at_nm: 20.0, to: Site(filament: 1, at_nm: 20.0), image: (1, 0, 1), stiffness_pn_per_nm: 0.02,
                    rest_length_nm: 50.0),
            ],
            periodic: PeriodicBox(size_nm: (60.0, 100.0, 80.0), strain: 0.01, factor: Sine(period_ns: 40000.0)),
            observe: [Network],
            task: Brownian(
                duration_ms: 0.4, temperature_k: 0.0, time_step_ns: 100.0, record_every_ns: 2000.0,
                drag: Water(viscosity_mpa_s: 1.0),
            ),
        )";
        let assembly = build(text);
        let (trajectory, _) = crate::Plan::new(&assembly).unwrap().run().unwrap();
        let records = &trajectory.records;
        let mean = |column: &str| {
            let periods = &records[records.len() - 40..];
            let values = periods
                .iter()
                .map(|one| value(&assembly, &one.row.observed, column));
            values.sum::<f64>() / 40.0
        };
        let [storage, loss] = super::MODULI.map(mean);
        // Two linkers at slopes of 3 : 4, k = 2 * 0.02 * 0.36 pN/nm, h = 40 nm.
        let plateau = 2.0 * 0.02 * 0.36 * 40.0_f64.powi(2) / (60.0 * 100.0 * 80.0) * 1e6;
        let frequency = storage / loss;
        println!("{storage} {loss} Pa, plateau {plateau} Pa, relative frequency {frequency}");
        assert!((0.2..5.0).contains(&frequency));
        // The linkers turn by 0.02 rad. Rods bend by 0.1 % of their displacement.
        let expected = plateau * frequency.powi(2) / (1.0 + frequency.powi(2));
        assert!((storage / expected - 1.0).abs() < 3e-3, "{expected}");
    }

    #[test]
    fn clusters_are_sets_of_joined_filaments() {
        let mut sizes = cluster_sizes(6, &[[0, 1], [4, 5], [1, 4], [5, 0]]);
        sizes.sort_unstable();
        assert_eq!(sizes, [1, 1, 4]);
    }
}
