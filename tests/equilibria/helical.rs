//! Localised helical buckling: a long rod whose ends are turned and brought together coils in its
//! middle.
//!
//! Lengths are in nm, `B` is the bending and `C` the twisting rigidity, `T` the tension and `M` the
//! moment along the axis. The tilt of an infinite rod against the axis obeys
//!
//! ```text
//! 1 - cos theta = (1 - cos theta_0) sech^2(mu s)
//! mu^2 = T/B - M^2/4B^2,  cos theta_0 = M^2/2TB - 1
//! ```
//!
//! and its tangent rotates about the axis at `M / B (1 + cos theta)`. Source: van der Heijden and
//! Thompson, Nonlinear Dynamics 21 (2000) 71; the case of Gazzola et al., R. Soc. Open Sci. 5
//! (2018) 171628, Section 4.

use super::common::to;
use crate::theory::second_order_limit;
use actin_cosserat::{End, EnergyGradient, Rigidities, RodLayout, RodMaterial, StraightRod, Walls};
use actin_equilibrium::{Layout, Newton};
use actin_mechanics::{Interaction, Loads, State, UnitQuaternion, Vector3, rotation};

/// Length (nm), slack (nm) and turns between the ends.
const LENGTH: f64 = 100.0;
const SLACK: f64 = 3.0;
const TURNS: f64 = 27.0;
/// Bending and twisting rigidity (pN nm^2).
const BEND: f64 = 1.345;
const TWIST: f64 = 0.789;
/// Shear and stretch rigidity (pN): the tension, 0.39 pN, strains by 4e-8.
const SHEAR: f64 = 1e7;
/// `M L / B`, `T L^2 / B` and the largest tilt (deg) for this slack and these turns. Source:
/// Gazzola et al. (2018); the tilt follows from the other two.
const MOMENT: f64 = 98.541_496_17;
const TENSION: f64 = 2_900.993_205_79;
const TILT_DEG: f64 = 47.651_5;

struct Coil {
    mu: f64,
    moment: f64,
    least_cosine: f64,
}

impl Coil {
    fn exact() -> Self {
        let (moment, tension) = (MOMENT / LENGTH, TENSION / LENGTH.powi(2));
        Self {
            mu: (tension - 0.25 * moment * moment).sqrt(),
            moment,
            least_cosine: 0.5 * moment * moment / tension - 1.0,
        }
    }

    fn cosine(&self, s: f64) -> f64 {
        1.0 - (1.0 - self.least_cosine) / (self.mu * s).cosh().powi(2)
    }

    fn rates(&self, s: f64) -> (f64, f64) {
        let cosine = self.cosine(s);
        let round = self.moment / (1.0 + cosine);
        (round, self.moment * BEND / TWIST - round * cosine)
    }

    fn tangent(&self, s: f64, azimuth: f64) -> Vector3 {
        let cosine = self.cosine(s);
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        Vector3::new(sine * azimuth.cos(), sine * azimuth.sin(), cosine)
    }
}

/// Positions and orientations of the solution at the nodes and in the middles of `n` segments.
fn lay(coil: &Coil, n: usize) -> (Vec<Vector3>, Vec<UnitQuaternion>) {
    const PARTS: usize = 200;
    let h = LENGTH / (n * PARTS * 2) as f64;
    let (mut x, mut azimuth, mut turn) = (Vector3::zeros(), 0.0, 0.0);
    let (mut nodes, mut frames) = (vec![x], Vec::new());
    for k in 0..2 * n {
        for part in 0..PARTS {
            let s = ((k * PARTS + part) as f64 + 0.5) * h - 0.5 * LENGTH;
            let (round, about) = coil.rates(s);
            x += coil.tangent(s, azimuth + 0.5 * h * round) * h;
            azimuth += h * round;
            turn += h * about;
        }
        let s = (k + 1) as f64 * 0.5 * LENGTH / n as f64 - 0.5 * LENGTH;
        if k % 2 == 1 {
            nodes.push(x);
        } else {
            let tilt = coil.cosine(s).acos();
            let q = rotation::exp(Vector3::z() * azimuth)
                * rotation::exp(Vector3::y() * tilt)
                * rotation::exp(Vector3::z() * turn);
            frames.push(q);
        }
    }
    (nodes, frames)
}

fn coiled(n: usize) -> (State, RodLayout, Vec<Box<dyn Interaction>>) {
    let mut state = State::default();
    let rod = StraightRod {
        walls: Walls {
            start: true,
            end: true,
        },
        ..StraightRod::uniform(n, LENGTH / n as f64)
    };
    let layout = rod.push(&mut state).unwrap();
    let (nodes, frames) = lay(&Coil::exact(), n);
    // Middle on the axis between the walls, rotations as far apart as theirs.
    let wall = |turns: f64| rotation::exp(Vector3::z() * (turns * std::f64::consts::PI));
    let shift = Vector3::z() * (LENGTH - SLACK) - nodes[n];
    for (k, node) in nodes.iter().enumerate() {
        let along = shift * (k as f64 / n as f64);
        state
            .points
            .position
            .set(layout.points().start + k, node + along);
    }
    for (k, frame) in frames.iter().enumerate() {
        let i = layout.frames().start + k;
        state.frames.orientation.set(i, wall(-TURNS) * *frame);
    }
    for (end, turns) in [(End::Start, -TURNS), (End::End, TURNS)] {
        state.points.hold(layout.end_point(end));
        let frame = layout.wall(end).unwrap();
        state.frames.orientation.set(frame, wall(turns));
    }
    let material = RodMaterial::new(Rigidities {
        shear: Vector3::repeat(SHEAR),
        bend: Vector3::new(BEND, BEND, TWIST),
    })
    .unwrap();
    let law = EnergyGradient::new(layout.clone(), material);
    (state, layout, vec![Box::new(law)])
}

struct Coiled {
    tilt: f64,
    /// `M L / B`.
    moment: f64,
    /// `T L^2 / B`.
    tension: f64,
    /// Largest difference of `cos theta` from the infinite rod, aligned at the largest tilt.
    envelope: f64,
}

fn solved(n: usize) -> Coiled {
    let (mut state, layout, terms) = coiled(n);
    let mut newton = Newton::new(Layout::free(&state), to(1e-9)).unwrap();
    let found = newton.solve(&mut state, &terms).unwrap();
    // The coil slides along the rod and rotates about it at almost constant energy.
    let certificate = found.certificate.unwrap();
    assert_eq!((certificate.negative, certificate.unresolved), (0, 2));
    let h = LENGTH / n as f64;
    let cosines: Vec<f64> = layout
        .frames()
        .map(|i| (state.frames.orientation.get(i) * Vector3::z()).z)
        .collect();
    let (middle, least) = lowest(&cosines);
    let exact = Coil::exact();
    let off = |(k, cosine): (usize, &f64)| (cosine - exact.cosine((k as f64 - middle) * h)).abs();
    let mut loads = Loads::zeros(&state);
    terms[0].add_loads(&state, &mut loads);
    let force = loads.force.get(layout.end_point(End::End));
    let wall = layout.wall(End::End).unwrap();
    let couple = state.frames.orientation.get(wall) * loads.torque.get(wall);
    Coiled {
        tilt: least.acos().to_degrees(),
        moment: -couple.z * LENGTH / BEND,
        tension: -force.z * LENGTH.powi(2) / BEND,
        envelope: cosines.iter().enumerate().map(off).fold(0.0, f64::max),
    }
}

/// Position, in numbers of frames, and value of the minimum of the parabola through the least value
/// and its neighbours.
fn lowest(values: &[f64]) -> (f64, f64) {
    let (k, _) = values
        .iter()
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(b.1))
        .unwrap();
    let [before, at, after] = [values[k - 1], values[k], values[k + 1]];
    let (slope, bend) = (0.5 * (after - before), after - 2.0 * at + before);
    (k as f64 - slope / bend, at - 0.5 * slope * slope / bend)
}

#[test]
fn a_twisted_rod_coils_up_in_its_middle() {
    let meshes = [300, 600, 1200].map(solved);
    let limit = |what: &str, value: fn(&Coiled) -> f64, exact: f64| {
        let values = [0, 1, 2].map(|k| value(&meshes[k]));
        let limit = second_order_limit(what, values, exact, 0.1);
        // Fourth-order terms and, for the tilt, the rounding of the source.
        assert!(limit.abs() < 2e-5, "{what}: {limit:e}");
    };
    limit("coil, largest tilt", |m| m.tilt, TILT_DEG);
    limit("coil, moment", |m| m.moment, MOMENT);
    limit("coil, tension", |m| m.tension, TENSION);
    let envelopes = [0, 1, 2].map(|k: usize| meshes[k].envelope);
    println!("coil, envelope: {envelopes:?}");
    for pair in envelopes.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{envelopes:?}");
    }
}
