//! Outlines of walls and of the periodic box.

use actin_sim::mechanics::{State, UnitQuaternion, Vector3};
use actin_sim::{Assembly, Cuboid, Cylinder, Plane, Sphere};
use std::f64::consts::{PI, TAU};

/// Segments of a circle.
const CIRCLE: u32 = 48;
/// Lines along a cylinder.
const ALONG: u32 = 4;

/// Corners on a path along all twelve edges of a box, some of them twice, in units of its edges.
const EDGES: [[f64; 3]; 16] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 0.0, 0.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, 0.0],
    [0.0, 1.0, 1.0],
    [0.0, 0.0, 1.0],
];

/// Line through points (nm, lab frame).
pub(crate) type Polyline = Vec<Vector3>;

/// Returns the edges of cuboids, circles on spheres and cylinders, and squares in planes. Planes and cylinders, which are
/// infinite, extend as far as the filaments in their initial state.
pub(crate) fn walls(assembly: &Assembly) -> Vec<Polyline> {
    let Some(repulsion) = &assembly.scene.repulsion else {
        return Vec::new();
    };
    let extent = extent(&assembly.rest);
    let planes = repulsion.planes.iter().map(|one| plane(one, extent));
    let spheres = repulsion.spheres.iter().flat_map(sphere);
    let cylinders = repulsion.cylinders.iter();
    let cylinders = cylinders.flat_map(|one| cylinder(one, extent));
    let cuboids = repulsion.cuboids.iter().map(cuboid);
    planes
        .chain(spheres)
        .chain(cylinders)
        .chain(cuboids)
        .collect()
}

fn plane(plane: &Plane, (centre, radius): (Vector3, f64)) -> Polyline {
    let turn = turn_to(plane.normal);
    let normal = turn * Vector3::z();
    let middle = centre - normal * normal.dot(&(centre - Vector3::from(plane.at_nm)));
    let corners = [
        [-1.0, -1.0],
        [1.0, -1.0],
        [1.0, 1.0],
        [-1.0, 1.0],
        [-1.0, -1.0],
    ];
    let corner = |[x, y]: [f64; 2]| middle + turn * Vector3::new(x, y, 0.0) * radius;
    corners.map(corner).to_vec()
}

fn sphere(sphere: &Sphere) -> [Polyline; 3] {
    let normals = [Vector3::x(), Vector3::y(), Vector3::z()];
    normals.map(|normal| {
        circle(
            sphere.at_nm.into(),
            turn_to(normal.into()),
            sphere.radius_nm,
        )
    })
}

fn cylinder(cylinder: &Cylinder, (centre, radius): (Vector3, f64)) -> Vec<Polyline> {
    let (at, turn) = (Vector3::from(cylinder.at_nm), turn_to(cylinder.axis));
    let axis = turn * Vector3::z();
    let middle = at + axis * axis.dot(&(centre - at));
    let ends = [middle - axis * radius, middle + axis * radius];
    let along = |k: u32| {
        let beside = turn * on_circle(k, ALONG) * cylinder.radius_nm;
        ends.map(|end| end + beside).to_vec()
    };
    let circles = ends.map(|end| circle(end, turn, cylinder.radius_nm));
    circles.into_iter().chain((0..ALONG).map(along)).collect()
}

fn cuboid(cuboid: &Cuboid) -> Polyline {
    let (at, size) = (Vector3::from(cuboid.at_nm), Vector3::from(cuboid.size_nm));
    let corner = |corner: [f64; 3]| {
        let from_centre = Vector3::from(corner) - Vector3::repeat(0.5);
        at + from_centre.component_mul(&size)
    };
    EDGES.map(corner).to_vec()
}

/// Returns the edges of the periodic box in `state`, around the initial centre of the filaments; empty without one.
pub(crate) fn periodic_box(assembly: &Assembly, state: &State) -> Polyline {
    let Some(cell) = &assembly.cell else {
        return Vec::new();
    };
    let (centre, _) = extent(&assembly.rest);
    let first = centre - 0.5 * cell.displacement([1; 3], state);
    // Displacements of images are whole edges.
    let corner = |corner: [f64; 3]| {
        let index = corner.map(|x| i32::from(x > 0.5));
        first + cell.displacement(index, state)
    };
    EDGES.map(corner).to_vec()
}

/// Centre and radius of a ball around all points (nm).
fn extent(state: &State) -> (Vector3, f64) {
    let mut places = state.points.position.iter();
    let first = places.next().unwrap_or_default();
    let (low, high) = places.fold((first, first), |(low, high), x| (low.inf(&x), high.sup(&x)));
    (0.5 * (low + high), 0.5 * (high - low).norm())
}

/// Rotation from z to a direction.
fn turn_to(direction: [f64; 3]) -> UnitQuaternion {
    let direction = Vector3::from(direction);
    let opposite = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), PI);
    UnitQuaternion::rotation_between(&Vector3::z(), &direction).unwrap_or_else(opposite)
}

fn on_circle(k: u32, of: u32) -> Vector3 {
    let (sine, cosine) = (TAU * f64::from(k) / f64::from(of)).sin_cos();
    Vector3::new(cosine, sine, 0.0)
}

fn circle(centre: Vector3, turn: UnitQuaternion, radius: f64) -> Polyline {
    let points = 0..=CIRCLE;
    points
        .map(|k| centre + turn * on_circle(k, CIRCLE) * radius)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_sim::Scene;

    fn built(keys: &str) -> Assembly {
        let text = format!(
            "Scene(
                filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 90.0, segments: 3)], at_nm: (1.0, 2.0, 3.0)),
                clamps: [Clamp(end: Start)],
                {keys}
                task: Equilibrium(),
            )"
        );
        Assembly::build(&Scene::from_ron(&text).unwrap()).unwrap()
    }

    #[test]
    fn outlines_lie_on_walls() {
        let shapes = [
            "planes: [Plane(at_nm: (0.0, -9.0, 5.0), normal: (0.0, 1.0, 0.3))]",
            "planes: [Plane(at_nm: (0.0, 0.0, 99.0), normal: (0.0, 0.0, -2.0))]",
            "spheres: [Sphere(at_nm: (0.0, 5.0, 40.0), radius_nm: 80.0, side: Inside)]",
            "cylinders: [Cylinder(at_nm: (0.0, 0.0, 0.0), axis: (0.1, 0.1, 1.0), radius_nm: 30.0, side: Inside)]",
            "cuboids: [Cuboid(at_nm: (0.0, 0.0, 40.0), size_nm: (50.0, 60.0, 200.0))]",
        ];
        for shape in shapes {
            let assembly = built(&format!("repulsion: Repulsion({shape}),"));
            let surfaces = assembly.scene.repulsion.as_ref().unwrap().walls().unwrap();
            let lines = walls(&assembly);
            assert!(!lines.is_empty(), "{shape}");
            for point in lines.concat() {
                let distances = surfaces.iter().map(|(_, wall)| wall.nearest([point; 2]).1);
                // Rounding errors of 100 nm.
                assert!(distances.map(f64::abs).fold(f64::INFINITY, f64::min) < 1e-12);
            }
        }
    }

    #[test]
    fn the_periodic_box_surrounds_the_filaments() {
        let assembly = built("periodic: PeriodicBox(size_nm: (90.0, 80.0, 100.0), strain: 0.2),");
        let corners = periodic_box(&assembly, &assembly.rest);
        let (low, high) = corners
            .iter()
            .fold((corners[0], corners[0]), |(low, high), x| {
                (low.inf(x), high.sup(x))
            });
        // The upper face is displaced by 20 nm along x.
        assert!((high - low - Vector3::new(110.0, 80.0, 100.0)).norm() < 1e-12);
        assert!((0.5 * (high + low) - Vector3::new(1.0, 2.0, 48.0)).norm() < 1e-12);
    }
}
