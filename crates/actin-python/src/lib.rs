//! Native module of the Python package `actin_filaments`.
//!
//! Exceptions, results and plots are Python modules in `python/actin_filaments`.

mod advance;
mod arrays;
mod callback;
mod directory;
mod driven;
mod errors;
mod fit;
mod links;
mod look;
mod pickle;
mod records;
mod rod;
mod run;
mod scene;
mod sweep;
mod system;
mod terms;
mod trade;
mod value;
mod watch;

/// Native module of the package `actin_filaments`.
#[pyo3::pymodule]
mod _actin {
    /// Rejects an invalid instruction set in the environment.
    #[pymodule_init]
    fn init(_module: &Bound<'_, PyModule>) -> PyResult<()> {
        let arch = actin_mechanics::wide::chosen_arch();
        arch.map(|_| ()).map_err(PyImportError::new_err)
    }

    use pyo3::exceptions::PyImportError;
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::directory::{export, page, profile, scene_schema, unfinished};
    #[pymodule_export]
    use crate::fit::{fit, fit_linear};
    #[pymodule_export]
    use crate::rod::Rod;
    #[pymodule_export]
    use crate::run::run;
    #[pymodule_export]
    use crate::scene::Scene;
    #[pymodule_export]
    use crate::sweep::{carry_out, emit_snakemake};
    #[pymodule_export]
    use crate::system::System;
    #[pymodule_export]
    use crate::trade::trade;
    #[pymodule_export]
    use crate::watch::Progress;

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "name in Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
