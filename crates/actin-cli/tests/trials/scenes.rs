//! Scenes of trials: scenes of the repository, and random valid scenes.

use super::spoil::{below, between, one_of};
use actin_mechanics::{UnitQuaternion, Vector3};
use rand_chacha::ChaCha8Rng;
use std::fmt::Write;
use std::fs;
use std::path::Path;

pub(super) fn repository(folder: &Path) -> Vec<String> {
    let mut paths: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    paths.sort();
    let texts = paths.iter().flat_map(|path| {
        if path.is_dir() {
            repository(path)
        } else {
            vec![fs::read_to_string(path).unwrap()]
        }
    });
    texts.collect()
}

#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub(super) filament: String,
    /// Position (nm), direction (lab frame) and roll (deg) of the filament.
    pub(super) at: Vector3,
    pub(super) direction: Vector3,
    pub(super) roll: f64,
    /// Forces on its free end (pN, lab frame).
    pub(super) forces: Vec<Vector3>,
    /// The clamped and the loaded end.
    pub(super) ends: [&'static str; 2],
    pub(super) rest: String,
    pub(super) task: String,
}

impl Draft {
    /// Creates a filament of 20 to 60 nm, clamped at its start and loaded at its end by a few pN, which has only one
    /// equilibrium.
    pub(super) fn random(random: &mut ChaCha8Rng) -> Self {
        let [a, b] = [between(random, 15.0, 35.0), between(random, 15.0, 25.0)];
        let c = a + b;
        let sections = match below(random, 4) {
            0 => format!("Rod(from_nm: 0.0, to_nm: {c:?})"),
            1 => format!("Ellipsoids(from_nm: 0.0, to_nm: {c:?})"),
            2 => {
                format!("Ellipsoids(from_nm: 0.0, to_nm: {a:?}), Rod(from_nm: {a:?}, to_nm: {c:?})")
            }
            _ => {
                format!("Rod(from_nm: 0.0, to_nm: {a:?}), Ellipsoids(from_nm: {a:?}, to_nm: {c:?})")
            }
        };
        let law = one_of(
            random,
            &["Constant", "PublishedExtension", "CouplingEnergy", "Fitted"],
        );
        Self {
            filament: format!("sections: [{sections}], rod: RodModel(law: {law})"),
            at: Vector3::zeros(),
            direction: Vector3::z(),
            roll: 0.0,
            forces: vec![force(random)],
            ends: ["Start", "End"],
            rest: String::new(),
            task: "Equilibrium(force_pn: 1e-8, torque_pn_nm: 1e-8)".into(),
        }
    }

    /// Creates a rod of constant rigidities, which is symmetric under reversal.
    pub(super) fn rod(random: &mut ChaCha8Rng) -> Self {
        let length = between(random, 30.0, 90.0);
        Self {
            filament: format!("sections: [Rod(from_nm: 0.0, to_nm: {length:?})]"),
            ..Self::random(random)
        }
    }

    pub(super) fn moving(mut self, record_every_ns: f64) -> Self {
        self.task = format!(
            "Dynamics(duration_ns: 0.4, time_step_ns: 0.001, record_every_ns: {record_every_ns:?},
                drag: (translational_per_ns: 0.3, rotational_per_ns: 0.3))"
        );
        self
    }

    /// Returns the rotation from the lab axes to the axes of the filament.
    pub(super) fn turn(&self) -> UnitQuaternion {
        let lean = UnitQuaternion::rotation_between(&Vector3::z(), &self.direction);
        let lean = lean.unwrap_or_else(|| {
            UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)
        });
        lean * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.roll.to_radians())
    }

    pub(super) fn text(&self) -> String {
        let [held, loaded] = self.ends;
        let mut loads = String::new();
        for force in &self.forces {
            write!(
                loads,
                "EndForce(end: {loaded}, force_pn: {}), ",
                triple(force)
            )
            .expect("writing to a string cannot fail");
        }
        format!(
            "Scene(
    filaments: [{}],
    clamps: [Clamp(end: {held})],
    loads: [{loads}],
    {}
    task: {},
)
",
            self.filament_text(),
            self.rest,
            self.task
        )
    }

    pub(super) fn filament_text(&self) -> String {
        format!(
            "Filament({}, at_nm: {}, direction: {}, roll_deg: {:?})",
            self.filament,
            triple(&self.at),
            triple(&self.direction),
            self.roll
        )
    }
}

pub(super) fn force(random: &mut ChaCha8Rng) -> Vector3 {
    Vector3::from_fn(|_, _| between(random, -3.0, 3.0))
}

fn triple(v: &Vector3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

/// Returns a motion or a path of equilibria with a run time of about a second.
pub(super) fn long(random: &mut ChaCha8Rng) -> String {
    let draft = Draft::random(random);
    let draft = if below(random, 2) == 0 {
        let noise = ["", ", thermal: (temperature_k: 298.0, seed: 3)"][below(random, 2)];
        let duration = between(random, 20.0, 60.0);
        Draft {
            rest: format!(
                "path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)], duration_ns: {:?})],",
                0.4 * duration
            ),
            task: format!(
                "Dynamics(duration_ns: {duration:?}, record_every_ns: {:?},
                    drag: (translational_per_ns: 0.1, rotational_per_ns: 0.1){noise})",
                0.01 * duration
            ),
            ..draft
        }
    } else {
        Draft {
            rest: "path: [Stage(set: [LoadFactor(load: 0, factor: 1.0)])],".into(),
            task: "Equilibrium(largest_step: 0.004)".into(),
            ..draft
        }
    };
    draft.text()
}
