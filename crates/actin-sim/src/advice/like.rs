//! Whether a scene is like one that was measured, so that what was found there may be expected here.

use crate::scene::{
    Clamp, ForceLaw, Linker, Load, Material, Monomers, Scene, Setting, Stage, Task,
};

/// How far a length, a displacement or a turn may be from that of the measured scene.
const NEAR: f64 = 0.1;
/// How far the azimuth of a site may be from that of the measured scene (deg).
const AZIMUTH_DEG: f64 = 4.0;

/// Whether `scene` asks what `measured` asks, however it is resolved: the same ends held, the same
/// loads, linkers and path within a tenth (forces within a factor of two), monomers and rods of the
/// default parameters but for azimuth and number of bonds. More than one filament was not measured.
pub(super) fn is_like(scene: &Scene, measured: &Scene) -> bool {
    scene.further.is_empty()
        && comes_to_rest(&scene.task)
        && (scene.linkers.is_empty() || scene.filament.roll_deg.abs() <= AZIMUTH_DEG)
        && scene.filament.axis() == measured.filament.axis()
        && near(length(scene), length(measured))
        && pairwise(&scene.clamps, &measured.clamps, same_clamp)
        && pairwise(&scene.loads, &measured.loads, Load::is_like)
        && pairwise(&scene.linkers, &measured.linkers, same_linker)
        && pairwise(&scene.path, &measured.path, same_stage)
        && has_default_models(scene)
}

/// All measured errors are those of states at rest.
fn comes_to_rest(task: &Task) -> bool {
    match task {
        Task::Equilibrium(_) => true,
        Task::Brownian(_) => false,
        Task::Dynamics(dynamics) => dynamics.stop.is_some() && dynamics.thermal.is_none(),
    }
}

/// Length of a scene's filament as written (nm).
pub(super) fn length(scene: &Scene) -> f64 {
    scene
        .filament
        .sections
        .last()
        .map_or(0.0, |s| s.span_nm().1)
}

fn pairwise<T>(some: &[T], others: &[T], alike: fn(&T, &T) -> bool) -> bool {
    some.len() == others.len() && some.iter().zip(others).all(|(a, b)| alike(a, b))
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= NEAR * b.abs()
}

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Whether two vectors differ by a tenth of the second at most.
fn near_vector(a: [f64; 3], b: [f64; 3]) -> bool {
    norm([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) <= NEAR * norm(b)
}

fn same_clamp(a: &Clamp, b: &Clamp) -> bool {
    (a.end, a.slides, a.hold, a.hinge) == (b.end, b.slides, b.hold, b.hinge)
}

fn same_linker(a: &Linker, b: &Linker) -> bool {
    let displaced = match (a.displaced_nm, b.displaced_nm) {
        (Some(a), Some(b)) => near_vector(a, b),
        _ => false,
    };
    displaced
        && near(a.at_nm, b.at_nm)
        && near(a.radius_nm, b.radius_nm)
        && (a.azimuth_deg - b.azimuth_deg).abs() <= AZIMUTH_DEG
        && near(a.stiffness_pn_per_nm, b.stiffness_pn_per_nm)
        && near(a.rest_length_nm, b.rest_length_nm)
}

fn same_stage(a: &Stage, b: &Stage) -> bool {
    pairwise(&a.set, &b.set, same_setting)
}

fn same_setting(a: &Setting, b: &Setting) -> bool {
    match (*a, *b) {
        (
            Setting::Turn {
                end, turn_deg: v, ..
            },
            Setting::Turn {
                end: other,
                turn_deg: w,
                ..
            },
        )
        | (
            Setting::Shift {
                end, shift_nm: v, ..
            },
            Setting::Shift {
                end: other,
                shift_nm: w,
                ..
            },
        ) => end == other && near_vector(v, w),
        _ => false,
    }
}

fn has_default_models(scene: &Scene) -> bool {
    let filament = &scene.filament;
    let given = &filament.monomers;
    let default = Monomers {
        azimuth_deg: given.azimuth_deg,
        lateral_bonds: given.lateral_bonds,
        longitudinal_bonds: given.longitudinal_bonds,
        ..Monomers::default()
    };
    *given == default
        && filament.shape.is_none()
        && filament.sections.iter().all(|s| !s.is_altered())
        && filament.rod.material == Material::default()
        && filament.rod.force_law == ForceLaw::EnergyGradient
}

#[cfg(test)]
mod tests {
    use super::super::scenes;
    use super::*;
    use crate::scene::End;

    /// Each scene is like itself and like no other: cantilevers differ in length, buckling in sign.
    #[test]
    fn every_scene_is_like_itself_alone() {
        let all = scenes::all();
        for (i, (name, scene)) in all.iter().enumerate() {
            for (k, (other, measured)) in all.iter().enumerate() {
                assert_eq!(is_like(scene, measured), i == k, "{name} and {other}");
            }
        }
    }

    #[test]
    fn what_differs_is_unlike() {
        let all = scenes::all();
        let cantilever = &all[0].1;
        let with = |force_pn: [f64; 3]| {
            let mut scene = cantilever.clone();
            scene.loads[0] = Load::EndForce {
                filament: 0,
                end: End::End,
                force_pn,
            };
            is_like(&scene, cantilever)
        };
        // Another direction across, twice the force; not along the filament, nor ten times as much.
        assert!(with([0.0, 2.0, 0.0]) && with([4.0, 0.0, 0.0]));
        assert!(!with([0.0, 0.0, -2.0]) && !with([20.0, 0.0, 0.0]) && !with([0.0; 3]));
        let mut scene = cantilever.clone();
        scene.filament.monomers.radius_nm = 1.7;
        assert!(!is_like(&scene, cantilever));
        scene = cantilever.clone();
        scene.clamps.clear();
        assert!(!is_like(&scene, cantilever));
    }
}
