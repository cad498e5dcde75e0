//! Order, size, connections, linker forces and virial of all filaments.

use super::{Checked, RecordTimes, View, chain};
use crate::codes;
use crate::loads::loads_of;
use crate::scene::{Factor, Scene, Setting, lowest_joined};
use crate::{Assembly, Part};
use actin_assembly::Note;
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

/// Returns a note if the scene has an oscillating strain but no moduli, or moduli without an error.
pub(super) fn note_on_moduli(scene: &Scene) -> Option<Note> {
    let strain = scene.periodic.as_ref().filter(|one| one.oscillates())?;
    let Factor::Sine { period_ns, .. } = strain.factor else {
        return None;
    };
    if Oscillation::new(scene).is_none() {
        let note = "observe: no storage and loss modulus, because stages of the path change the amplitude (Shear)";
        return Some(note.to_owned().into());
    }
    let after = scene.task.motion()?.duration_ns - scene.burn_in()?;
    (after < 1.5 * period_ns).then(|| {
        let message = "observe: the storage and loss modulus of one period have no error estimate: use a longer duration_ns";
        Note::warning(codes::FEW_RECORDS, message)
    })
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
            for (_, [from, to]) in chain::edges(view, filament) {
                let edge = to - from;
                let (weight, middle) = (edge.norm(), 0.5 * (from + to));
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
mod tests;
