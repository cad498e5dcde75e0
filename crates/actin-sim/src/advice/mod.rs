//! What is known of the trade of accuracy for speed: settings, the scenes they were measured on,
//! the table of what came out, and the one change that would save a scene most.
//!
//! The measurements are those of `cargo xtask tradeoff`; nothing here runs a scene.

mod change;
mod like;
pub mod scenes;
mod setting;
pub mod table;

pub use change::{Change, Expected};
pub use setting::Setting;
pub use table::Measured;

use crate::scene::{Problem, Scene};
use std::fmt;

/// Largest expected error of the displacement that a change may bring.
pub const AT_MOST: f64 = 0.02;

/// What is known of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Advice {
    /// This change saves most.
    Change(Box<Change>),
    /// The scene is like a measured one, on which no change saved anything at so small an error.
    Nothing {
        /// The measured scene.
        like: &'static str,
    },
    /// Nothing like it was measured.
    Unknown,
}

impl Advice {
    /// The single change that would save `scene` most time at an expected error of the displacement
    /// of [`AT_MOST`].
    ///
    /// # Errors
    /// A scene that cannot be built, or whose time step is refused.
    pub fn of(scene: &Scene) -> Result<Self, Problem> {
        let known = scenes::all();
        let like = known.iter().find(|(_, m)| like::is_like(scene, m));
        let Some((name, measured)) = like else {
            return Ok(Self::Unknown);
        };
        let best = change::best(scene, name, like::length(measured))?;
        Ok(best.map_or(Self::Nothing { like: name }, |change| {
            Self::Change(Box::new(change))
        }))
    }
}

impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Change(change) => write!(f, "{change}"),
            Self::Nothing { like } => write!(
                f,
                "no single change is known to save time at an error of {:.0} % or less (measured \
                 on {like})",
                100.0 * AT_MOST
            ),
            Self::Unknown => f.write_str(
                "nothing like this scene was measured: what cheaper resolutions would cost in \
                 accuracy is not known",
            ),
        }
    }
}
