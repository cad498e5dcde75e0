//! Order, size, connections, linker forces and virial of all filaments.

use super::{Observe, StoredPositions, View};
use crate::{Assembly, Part};
use actin_mechanics::{Loads, Matrix3, Vector3};

/// Components of symmetric tensors, in the order of their columns.
const COMPONENTS: [(&str, usize, usize); 6] = [
    ("xx", 0, 0),
    ("yy", 1, 1),
    ("zz", 2, 2),
    ("xy", 0, 1),
    ("xz", 0, 2),
    ("yz", 1, 2),
];

/// Columns before those of the virial.
const SCALARS: [&str; 10] = [
    "order_parameter",
    "polarity",
    "gyration_radius_nm",
    "bound_linkers",
    "clusters",
    "largest_cluster",
    "linker_tension_mean_pn",
    "linker_tension_rms_pn",
    "linker_tension_smallest_pn",
    "linker_tension_largest_pn",
];

/// Properties of a network of filaments.
#[derive(Debug)]
pub(super) struct Network;

impl Observe for Network {
    fn columns(&self) -> Vec<String> {
        let scalars = SCALARS.iter().map(|name| format!("network_{name}"));
        let virial = COMPONENTS
            .iter()
            .map(|(name, ..)| format!("network_virial_{name}_pn_nm"));
        scalars.chain(virial).collect()
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        let Edges {
            order,
            mean,
            gyration_radius_nm,
        } = Edges::new(view);
        row.extend([order, mean, gyration_radius_nm]);
        let linkers = Linkers::new(view);
        row.extend([linkers.tensions.len() as f64]);
        let sizes = cluster_sizes(view.assembly.filaments.len(), &linkers.joined);
        let largest = sizes.iter().copied().max().unwrap_or_default();
        row.extend([sizes.len() as f64, largest as f64]);
        row.extend(statistics(&linkers.tensions));
        let virial = virial(view);
        row.extend(COMPONENTS.map(|(_, i, j)| 0.5 * (virial[(i, j)] + virial[(j, i)])));
    }
}

/// Averages over the edges of all centre lines, weighted by length.
struct Edges {
    /// Largest eigenvalue of `(3 <t t^T> - 1) / 2` with unit tangents `t`.
    order: f64,
    /// Length of the mean tangent.
    mean: f64,
    gyration_radius_nm: f64,
}

impl Edges {
    fn new(view: &View<'_>) -> Self {
        let (mut length, mut tangent, mut place) = (0.0, Vector3::zeros(), Vector3::zeros());
        let (mut tensor, mut square) = (Matrix3::zeros(), 0.0);
        for filament in 0..view.assembly.filaments.len() {
            for pair in view.ribbon(filament).points_nm.windows(2) {
                let edge = pair[1] - pair[0];
                let (weight, middle) = (edge.norm(), 0.5 * (pair[0] + pair[1]));
                length += weight;
                tangent += edge;
                tensor += edge * edge.transpose() / weight.max(f64::MIN_POSITIVE);
                place += weight * middle;
                square += weight * (middle.norm_squared() + weight * weight / 12.0);
            }
        }
        let order = 0.5 * (3.0 * tensor / length - Matrix3::identity());
        let centre = place / length;
        Self {
            order: order.symmetric_eigenvalues().max(),
            mean: tangent.norm() / length,
            gyration_radius_nm: (square / length - centre.norm_squared()).max(0.0).sqrt(),
        }
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
    let mut parent: Vec<usize> = (0..filaments).collect();
    for pair in joined {
        let [a, b] = pair.map(|filament| root(&mut parent, filament));
        parent[a] = b;
    }
    let mut sizes = vec![0; filaments];
    for filament in 0..filaments {
        sizes[root(&mut parent, filament)] += 1;
    }
    sizes.retain(|size| *size > 0);
    sizes
}

/// Returns the representative of a cluster; shortens the path to it.
fn root(parent: &mut [usize], mut filament: usize) -> usize {
    while parent[filament] != filament {
        parent[filament] = parent[parent[filament]];
        filament = parent[filament];
    }
    filament
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

/// Returns `-sum r f^T` over all points with the forces `f` of filaments, linkers between sites and contacts (pN nm).
///
/// These forces add up to zero, so that the tensor does not depend on the origin. Its symmetric part is the derivative of
/// their energy with respect to a uniform strain of all points at fixed orientations.
fn virial(view: &View<'_>) -> Matrix3 {
    let mut loads = Loads::zeros(view.state);
    let interactions = view.assembly.system.interactions();
    for (interaction, term) in interactions.iter().zip(&view.assembly.terms) {
        if is_internal(view.assembly, term.part) {
            interaction.add_loads(view.state, &mut loads);
        }
    }
    let points = 0..view.assembly.points.len();
    points.fold(Matrix3::zeros(), |sum, i| {
        sum - view.state.points.position.get(i) * loads.force.get(i).transpose()
    })
}

fn is_internal(assembly: &Assembly, part: Part) -> bool {
    match part {
        Part::Section(_) | Part::Junction(_) | Part::Contacts => true,
        Part::Linker(linker) => assembly.scene.linkers[linker].to.is_some(),
        Part::Load(_) | Part::Clamp(_) | Part::Plane(_) | Part::Sphere(_) => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{build, observe, value};
    use super::cluster_sizes;

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
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], at_nm: (500.0, 0.0, 0.0)),
                Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], at_nm: (512.0, 0.0, 0.0)),
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
        let radius = (300.0_f64.powi(2) / 12.0 + 6.0 / 7.0 * 144.0).sqrt();
        assert!((column("gyration_radius_nm") - radius).abs() < 1e-6);
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

    #[test]
    fn clusters_are_sets_of_joined_filaments() {
        let mut sizes = cluster_sizes(6, &[[0, 1], [4, 5], [1, 4], [5, 0]]);
        sizes.sort_unstable();
        assert_eq!(sizes, [1, 1, 4]);
    }
}
