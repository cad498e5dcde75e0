//! Pickles of a `System` of a scene.

use crate::advance::read_scheme;
use crate::errors;
use crate::scene::Scene;
use crate::system::{Clock, System};
use actin_mechanics::Motion;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use serde::{Deserialize, Serialize};

/// Arguments of `_restored`.
type Arguments = (Py<Scene>, Vec<u8>);

/// Changes since the creation from the scene.
#[derive(Serialize, Deserialize)]
struct Saved {
    motion: Motion,
    free_points: Vec<bool>,
    free_frames: Vec<bool>,
    force: Vec<[f64; 3]>,
    torque: Vec<[f64; 3]>,
    clock: Clock,
    scheme: String,
    step: Option<f64>,
    drag: [f64; 2],
    thermal_energy: Option<f64>,
    seed: u64,
}

impl System {
    fn saved(&self) -> Saved {
        let (state, settings) = (self.state(), &self.settings);
        let [force, torque] = self.applied.loads();
        Saved {
            motion: state.motion(),
            free_points: (0..state.points.len())
                .map(|i| state.points.is_free(i))
                .collect(),
            free_frames: (0..state.frames.len())
                .map(|i| state.frames.is_free(i))
                .collect(),
            force,
            torque,
            clock: self.clock,
            scheme: settings.scheme.name().into(),
            step: settings.step,
            drag: settings.drag,
            thermal_energy: settings.thermal_energy,
            seed: settings.seed,
        }
    }

    fn restore(&mut self, saved: Saved) -> PyResult<()> {
        let state = self.mechanics.state_mut();
        for (i, is_free) in saved.free_points.into_iter().enumerate() {
            if is_free {
                state.points.release(i);
            } else {
                state.points.hold(i);
            }
        }
        for (i, is_free) in saved.free_frames.into_iter().enumerate() {
            if is_free {
                state.frames.release(i);
            } else {
                state.frames.hold(i);
            }
        }
        self.applied.set_force(saved.force);
        self.applied.set_torque(saved.torque);
        self.clock = saved.clock;
        let settings = &mut self.settings;
        settings.scheme = read_scheme(&saved.scheme)?;
        settings.step = saved.step;
        settings.drag = saved.drag;
        settings.thermal_energy = saved.thermal_energy;
        settings.seed = saved.seed;
        self.mechanics.restore(&saved.motion, false, 0);
        Ok(())
    }
}

#[pymethods]
impl System {
    /// Supports pickles of a system of a scene without additions.
    fn __reduce__(&self, py: Python<'_>) -> PyResult<(Py<PyAny>, Arguments)> {
        let is_unchanged = self.removable.is_empty() && self.motions.own.is_empty();
        let scene = self
            .scene
            .as_ref()
            .filter(|_| is_unchanged && self.has_bodies_of_scene());
        let scene = scene.ok_or_else(|| {
            PyTypeError::new_err(
                "only a System of a scene without added bodies, terms or drives can be pickled: use copy(), or build it \
                 again and assign position, velocity, quaternion and angular_momentum",
            )
        })?;
        let saved = postcard::to_allocvec(&self.saved()).map_err(errors::value)?;
        let restored = py.get_type::<Self>().getattr("_restored")?;
        Ok((restored.unbind(), (scene.clone_ref(py), saved)))
    }

    /// Restores a pickle.
    #[staticmethod]
    fn _restored(py: Python<'_>, scene: &Bound<'_, Scene>, saved: &[u8]) -> PyResult<Self> {
        let mut system = Self::from_scene(py, scene)?;
        system.restore(postcard::from_bytes(saved).map_err(errors::value)?)?;
        Ok(system)
    }
}
