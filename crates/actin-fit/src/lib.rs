//! Linear and nonlinear least squares with uncertainties.
//!
//! [`fit_linear`] solves linear problems by QR, and [`Polynomial`] fits polynomials.
//! [`LevenbergMarquardt`] fits a [`Model`] within [`Bounds`] from several [`Starts`]. A fit
//! contains the covariance, the residuals, the termination of each search and a status of each
//! parameter.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod acceleration;
mod bounds;
mod data;
mod descent;
mod error;
mod factor;
mod gradient_check;
mod levenberg;
mod linear;
mod model;
mod observations;
mod options;
mod polynomial;
mod precision;
mod problem;
mod report;
mod search_report;
mod starts;
mod step;

pub use bounds::Bounds;
pub use data::Data;
pub use error::FitError;
pub use gradient_check::{GradientCheck, check_gradient};
pub use levenberg::LevenbergMarquardt;
pub use linear::{LinearFit, fit_linear};
pub use model::{ClosureModel, Model};
pub use observations::{Noise, Observations};
pub use options::Options;
pub use polynomial::Polynomial;
pub use precision::{Goodness, Precision};
pub use report::{Fit, Status};
pub use search_report::{Progress, StartReport, Termination};
pub use starts::Starts;

/// Matrix types of this crate, indexed as `matrix[(row, column)]`.
pub use faer::{Mat, MatRef};
