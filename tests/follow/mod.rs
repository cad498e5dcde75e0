//! Resolution that follows a motion.

mod accuracy;
mod brownian;
mod heat;
mod interrupted;
mod kept;
mod windows;

use actin_sim::follow::{AdaptiveMotion, Cell, Criterion, Follower, ResolutionRequest};
use actin_sim::shape::Ribbon;
use actin_sim::{Assembly, Record, Scene};

/// Thermal energy at 298 K (pN nm).
const KT: f64 = 0.013_806_49 * 298.0;

/// Criterion that alternates cells between rod and monomers at equal time intervals; the first cell
/// stays a rod.
#[derive(Debug)]
struct ToAndFro {
    every_ns: f64,
}

impl Criterion for ToAndFro {
    fn request(&self, cell: &Cell<'_>) -> ResolutionRequest {
        let turn = (cell.filament.state.time / self.every_ns).floor();
        let place = (cell.span_nm[0] / 30.0).round();
        if place > 0.5 && (turn + place).rem_euclid(2.0) < 0.5 {
            ResolutionRequest::Monomers
        } else {
            ResolutionRequest::Rod
        }
    }
}

fn scene(length_nm: f64, least_ns: f64, rest: &str) -> Scene {
    let text = format!(
        "Scene(
            filament: Filament(
                sections: Following(
                    length_nm: {length_nm:?},
                    monomers_where: [Curvature(above_per_nm: 10.0, below_per_nm: 1.0)],
                    least_ns: {least_ns:?},
                ),
                rod: RodModel(law: Homogenised),
            ),
            {rest}
        )"
    );
    Scene::from_ron(&text).unwrap_or_else(|error| panic!("{error}"))
}

fn to_and_fro(scene: &Scene, every_ns: f64) -> AdaptiveMotion {
    let follower = Follower::new(scene).unwrap();
    let follower = follower.with_criterion(Box::new(ToAndFro { every_ns }));
    follower.run().unwrap_or_else(|error| panic!("{error}"))
}

type Recorded<'a> = (&'a Assembly, &'a Record);

fn records(run: &AdaptiveMotion) -> impl Iterator<Item = Recorded<'_>> {
    run.stretches.iter().flat_map(|ran| {
        let assembly = &ran.stretch.assembly;
        let records = ran.trajectory.records.iter();
        records.map(move |record| (assembly, record))
    })
}

/// Mean squared angle between the tangents at the ends (rad^2).
fn mean_square_angle<'a>(records: impl Iterator<Item = Recorded<'a>>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (assembly, record) in records {
        let tangents = Ribbon::new(assembly, &record.state).tangents();
        sum += tangents[0].angle(&tangents[tangents.len() - 1]).powi(2);
        count += 1.0;
    }
    sum / count
}

fn energy(record: &Record) -> f64 {
    record.potential_pn_nm() + record.kinetic_pn_nm
}
