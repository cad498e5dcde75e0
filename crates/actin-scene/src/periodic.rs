//! Periodic box, its shear and their validation.

use super::problem::Problems;
use super::rules::show;
use super::{Factor, Flow, Linker, Repulsion, Scene, SceneProblem, Task, unit_vector};
use actin_mechanics::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Box that is repeated along x, y and z. Linkers and repulsion act across its faces: filaments are continuous, a
/// linker has the `image` of its second end, and filaments repel all images, including their own. Two facing planes of
/// `repulsion`, normal to an edge, make a layer; volumes are then those between the walls.
///
/// A shear strain displaces the images along x in proportion to their distance along z, and so does the fluid of
/// `Brownian`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PeriodicBox {
    /// Edges along x, y and z; positive.
    pub size_nm: [f64; 3],
    /// Shear strain `dx/dz`; finite, at most 1. Scenes are built without strain.
    #[serde(default)]
    pub strain: f64,
    /// Factor of the strain in time. `Shear` of a path sets another factor; both are multiplied.
    #[serde(default)]
    pub factor: Factor,
}

impl PeriodicBox {
    /// Returns true if the strain oscillates with an amplitude other than 0.
    pub fn oscillates(&self) -> bool {
        let amplitude = match self.factor {
            Factor::Sine { amplitude, .. } => amplitude,
            _ => 0.0,
        };
        self.strain * amplitude != 0.0
    }
}

/// Returns the indices of the origin of a cubic lattice and its 26 neighbours.
pub(super) fn neighbours() -> [[i32; 3]; 27] {
    let mut step = -1;
    [(); 27].map(|()| {
        step += 1;
        [step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1]
    })
}

/// Largest magnitude of the strain.
const MOST_STRAIN: f64 = 1.0;

impl PeriodicBox {
    /// Returns the displacement (nm) of an image, without strain.
    pub(crate) fn shift(&self, image: [i32; 3]) -> Vector3 {
        Vector3::from_fn(|k, _| f64::from(image[k]) * self.size_nm[k])
    }

    /// Checks that the edges are at least twice the contact distance (nm) of filaments.
    pub(super) fn check_size(&self, contact: f64) -> Result<(), SceneProblem> {
        let short = self.size_nm.into_iter().find(|edge| *edge < 2.0 * contact);
        let Some(edge) = short else {
            return Ok(());
        };
        let rule = format!(
            "must be at least twice the contact distance of filaments, {contact:?} nm, which repel their images"
        );
        Err(SceneProblem::new("periodic.size_nm", edge, rule))
    }

    /// Returns the image in which a position (nm) lies, and the position in the box without strain, from 0 to
    /// `size_nm`.
    pub(crate) fn wrap(&self, place: Vector3) -> ([i32; 3], Vector3) {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "saturates far outside of any filament"
        )]
        let image = std::array::from_fn(|k| (place[k] / self.size_nm[k]).floor() as i32);
        (image, place - self.shift(image))
    }

    /// Returns the displacements (nm) of the images of a sphere that may come within `reach` (nm) of a point, from the
    /// vector `d` (nm) of the point to the centre.
    pub(crate) fn shifts_within(&self, d: Vector3, reach: f64) -> Vec<Vector3> {
        let multiples = |k: usize| {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "saturates far outside of any filament"
            )]
            let [first, last] = [
                ((-reach - d[k]) / self.size_nm[k]).ceil(),
                ((reach - d[k]) / self.size_nm[k]).floor(),
            ]
            .map(|n| n as i32);
            first..=last
        };
        let planes = multiples(0).flat_map(|x| multiples(1).map(move |y| (x, y)));
        let images = planes.flat_map(|(x, y)| multiples(2).map(move |z| [x, y, z]));
        images.map(|image| self.shift(image)).collect()
    }

    /// Returns the images of a position in the box (nm) that lie in the box enlarged by `reach` on all sides.
    pub(crate) fn images_within(&self, place: Vector3, reach: f64) -> Vec<([i32; 3], Vector3)> {
        let images = neighbours().map(|image| (image, place + self.shift(image)));
        let is_near = |place: &Vector3| {
            (0..3).all(|k| (-reach..=self.size_nm[k] + reach).contains(&place[k]))
        };
        images
            .into_iter()
            .filter(|(_, place)| is_near(place))
            .collect()
    }
}

/// Checks the box and incompatible keys.
pub(super) fn check(scene: &Scene, problems: &mut Problems) {
    for (i, linker) in scene.linkers.iter().enumerate() {
        problems.note(check_image(scene, i, linker));
    }
    let Some(periodic) = &scene.periodic else {
        return;
    };
    let repulsion = scene.repulsion.as_ref();
    let contact = repulsion.map_or(0.0, Repulsion::contact_nm);
    problems.check("periodic.size_nm", || periodic.check_size(contact));
    problems.check("periodic", || check_strain(scene, periodic));
    problems.note(check_flow(scene));
    problems.check("repulsion", || check_walls(scene, periodic));
    problems.check("periodic.size_nm", || check_reach(scene, periodic));
}

/// Checks the factor of the strain in a path.
pub(super) fn check_factor(scene: &Scene, key: &str, factor: f64) -> Result<(), SceneProblem> {
    if scene.periodic.as_ref().is_some_and(|one| one.strain != 0.0) {
        return Ok(());
    }
    let rule = "requires a strain of the periodic box: write periodic with strain";
    Err(SceneProblem::new(key, factor, rule))
}

fn check_strain(scene: &Scene, periodic: &PeriodicBox) -> Result<(), SceneProblem> {
    let (key, strain) = ("periodic.strain", periodic.strain);
    periodic.factor.check("periodic.factor")?;
    if strain.abs() > MOST_STRAIN {
        let rule = format!("must be at most {MOST_STRAIN} in magnitude");
        return Err(SceneProblem::new(key, show(strain), rule));
    }
    match &scene.task {
        Task::Dynamics(_) if strain != 0.0 => {
            let rule = "has no effect on the fluid in Dynamics: use Brownian or Equilibrium";
            Err(SceneProblem::new(key, show(strain), rule))
        }
        Task::Equilibrium(_) if !periodic.factor.is_constant() => {
            let rule = "changes in time: use Brownian, or Shear(factor: ..) in a path";
            Err(SceneProblem::new("periodic.factor", "", rule))
        }
        _ => Ok(()),
    }
}

fn check_flow(scene: &Scene) -> Result<(), SceneProblem> {
    if let Task::Brownian(task) = &scene.task
        && matches!(task.flow, Flow::Shear { .. })
    {
        let rule = "does not displace the images of a periodic box: write strain and factor of periodic instead";
        return Err(SceneProblem::new("task.flow", "Shear", rule));
    }
    Ok(())
}

/// Allows the walls of a layer: pairs of planes that face each other, normal to an edge of the box that nothing passes.
fn check_walls(scene: &Scene, periodic: &PeriodicBox) -> Result<(), SceneProblem> {
    let Some(repulsion) = &scene.repulsion else {
        return Ok(());
    };
    let refused =
        |key: &str, rule: &str| Err(SceneProblem::new(format!("repulsion.{key}"), "", rule));
    let closed = [
        ("spheres", repulsion.spheres.is_empty()),
        ("cylinders", repulsion.cylinders.is_empty()),
        ("cuboids", repulsion.cuboids.is_empty()),
    ];
    if let Some((key, _)) = closed.into_iter().find(|(_, is_empty)| !is_empty) {
        let rule =
            "are not repeated: in a periodic box, only planes that face each other are allowed";
        return refused(key, rule);
    }
    // A strain displaces images along x and z, which walls normal to these axes separate.
    let axes = if periodic.strain == 0.0 { 0..3 } else { 1..2 };
    for (i, plane) in repulsion.planes.iter().enumerate() {
        let normal = unit_vector(plane.normal);
        if !axes.clone().any(|axis| normal[axis].abs() >= 1.0) {
            let rule = "in a periodic box, must be along y, or along x or z without strain";
            return refused(&format!("planes[{i}].normal"), rule);
        }
    }
    for axis in axes {
        let [low, high] = repulsion.layer(axis);
        match (low.is_finite(), high.is_finite()) {
            (true, true) => check_layer(scene, axis, (high - low, periodic.size_nm[axis]))?,
            (false, false) => {}
            _ => {
                let rule =
                    "in a periodic box, each plane requires another one with the opposite normal";
                return refused("planes", rule);
            }
        }
    }
    Ok(())
}

/// Requires that no linker or contact passes through the walls normal to an edge (nm) of the box.
fn check_layer(
    scene: &Scene,
    axis: usize,
    (distance, edge): (f64, f64),
) -> Result<(), SceneProblem> {
    let refused = |rule: &str| SceneProblem::new("periodic.size_nm", edge, rule);
    let contact = scene.repulsion.as_ref().map_or(0.0, Repulsion::contact_nm);
    let reach = longest_reach(scene).max(contact);
    if edge < distance + reach {
        let rule = format!(
            "must exceed the distance of the walls normal to this edge, {distance:?}, by the reach of contacts and \
             crosslinkers, {reach:.2}"
        );
        return Err(refused(&rule));
    }
    if scene.linkers.iter().any(|one| one.image[axis] != 0) {
        let rule = "linkers pass through the walls normal to this edge: increase it to their distance and the reach of \
                    linkers";
        return Err(refused(rule));
    }
    Ok(())
}

impl Scene {
    /// Volume (nm^3) of the periodic box, or of the layer between its walls; `None` without a box.
    pub fn periodic_volume(&self) -> Option<f64> {
        let edges = self.periodic.as_ref()?.size_nm.into_iter().enumerate();
        let thickness = |(axis, edge): (usize, f64)| {
            let walls = self.repulsion.as_ref().map(|one| one.layer(axis));
            walls.map_or(edge, |[low, high]| edge.min(high - low))
        };
        Some(edges.map(thickness).product())
    }
}

/// Largest distance (nm) of two sites that a crosslinker of a pool joins.
fn longest_reach(scene: &Scene) -> f64 {
    let reach = |linker: &Linker| {
        let forms = linker.kinetics.filter(|k| k.roams.is_some())?.forms?;
        Some(linker.rest_length_nm + forms.reach_nm)
    };
    scene.linkers.iter().filter_map(reach).fold(0.0, f64::max)
}

/// Requires that the nearest image of a site is the only one within reach of a crosslinker.
fn check_reach(scene: &Scene, periodic: &PeriodicBox) -> Result<(), SceneProblem> {
    let longest = longest_reach(scene);
    let shortest = periodic
        .size_nm
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min);
    if 4.0 * longest <= shortest {
        return Ok(());
    }
    let rule = format!(
        "must be at least four times the reach of crosslinkers, {longest:?} nm, which bind to nearest images"
    );
    Err(SceneProblem::new("periodic.size_nm", shortest, rule))
}

fn check_image(scene: &Scene, i: usize, linker: &Linker) -> Result<(), SceneProblem> {
    if linker.image == [0; 3] {
        return Ok(());
    }
    let refused = |rule: &str| {
        let key = format!("linkers[{i}].image");
        Err(SceneProblem::new(key, show(linker.image), rule))
    };
    match (&scene.periodic, &linker.to) {
        (None, _) => refused("requires a periodic box: write periodic, or omit this key"),
        (_, None) => refused("requires a site at the second end: write to, or omit this key"),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use crate::Scene;

    fn refused(planes: &str, strain: f64, height: f64) -> Option<String> {
        let text = format!(
            "Scene(
                arrangements: [Random(
                    filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 200.0)]), count: 4,
                    box_nm: (300.0, 300.0, 50.0), centre_nm: (150.0, 150.0, 100.0), orientation: Planar, seed: 1,
                )],
                crosslinkers: [Crosslinkers(count: 5, stiffness_pn_per_nm: 1.0, reach_nm: 20.0, attach_per_ns: 1e-5,
                    bind_per_ns: 1e-5, unbinds: Breaking(rate_per_ns: 1e-6), seed: 2)],
                repulsion: Repulsion(planes: [{planes}]),
                periodic: PeriodicBox(size_nm: (300.0, 300.0, {height:?}), strain: {strain:?}),
                task: Brownian(duration_ms: 0.01, temperature_k: 298.0, seed: 3),
            )"
        );
        Scene::from_ron(&text).err().map(|error| error.to_string())
    }

    #[test]
    fn layers_of_periodic_boxes_have_two_walls() {
        let plane = |[x, y, z]: [f64; 3], axis: usize, sign: f64| {
            let mut normal = [0.0; 3];
            normal[axis] = 2.0 * sign;
            let [a, b, c] = normal;
            format!("Plane(at_nm: ({x:?}, {y:?}, {z:?}), normal: ({a:?}, {b:?}, {c:?})),")
        };
        let z = |at, sign| plane([7.0, 8.0, at], 2, sign);
        let layer = z(50.0, 1.0) + &z(150.0, -1.0);
        assert_eq!(refused(&layer, 0.0, 120.0), None);
        let along_y = plane([-200.0; 3], 1, 1.0) + &plane([500.0; 3], 1, -1.0);
        let message = refused(&along_y, 0.2, 300.0);
        assert!(message.is_some_and(|text| {
            text.contains("700.0, by the reach of contacts and crosslinkers, 20.00")
        }));
        let oblique = layer.clone() + "Plane(at_nm: (0.0, 0.0, 0.0), normal: (0.0, 0.1, 1.0))";
        for (planes, strain, height, what) in [
            (layer.clone(), 0.0, 119.0, "must exceed the distance"),
            (layer, 0.2, 120.0, "or along x or z without strain"),
            (z(50.0, 1.0), 0.0, 300.0, "with the opposite normal"),
            (oblique, 0.0, 300.0, "planes[2].normal"),
        ] {
            let message = refused(&planes, strain, height);
            assert!(message.is_some_and(|text| text.contains(what)), "{planes}");
        }
    }

    const SHEARED: &str = "Scene(
        filaments: [
            Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)]),
            Filament(sections: [Rod(from_nm: 0.0, to_nm: 100.0)], at_nm: (20.0, 0.0, 0.0)),
        ],
        linkers: [Linker(at_nm: 90.0, to: Site(filament: 1, at_nm: 5.0), image: (0, 0, 1), stiffness_pn_per_nm: 1.0)],
        periodic: PeriodicBox(size_nm: (50.0, 50.0, 90.0), strain: 0.1),
        path: [Stage(set: [Shear(factor: 1.0)])],
        task: Equilibrium(),
    )";

    #[test]
    fn a_periodic_scene_survives_the_round_trip() {
        let scene = Scene::from_ron(SHEARED).expect("the scene is valid");
        let printed = scene.to_ron();
        assert_eq!(Scene::from_ron(&printed).expect("it is valid"), scene);
        let periodic = scene.periodic.expect("the scene is periodic");
        assert!((periodic.shift([3, -1, 2]).z - 180.0).abs() < 1e-12);
        let (image, place) = periodic.wrap([-1.0, 120.0, 90.0].into());
        assert_eq!(image, [-1, 2, 1]);
        assert!((place.x - 49.0).abs() < 1e-12 && (place.y - 20.0).abs() < 1e-12);
    }
}
