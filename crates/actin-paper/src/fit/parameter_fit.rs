//! Result of a parameter search, and the checks before it becomes a law.

use super::catalogue::Form;
use actin_fit::{Bounds, Data, Fit, FitError, LevenbergMarquardt, Model, Starts, Status};

#[derive(Clone, Debug)]
pub(crate) struct ParameterFit {
    pub fit: Fit,
    pub(super) form: &'static Form,
    pub(super) bounds: Vec<(f64, f64)>,
}

/// A parameter that is undetermined or at a bound.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Fault {
    key: &'static str,
    message: String,
    /// `true` if `--allow-bounds` can accept it.
    is_bound: bool,
}

impl ParameterFit {
    /// Searches within bounds with the default settings.
    pub(super) fn search(
        form: &'static Form,
        model: &dyn Model,
        data: &Data,
        bounds: Vec<(f64, f64)>,
        starts: &Starts,
    ) -> Result<Self, String> {
        let method = LevenbergMarquardt::default();
        Self::search_by(method, form, model, data, bounds, starts)
    }

    /// Searches within bounds with the settings of `method`.
    pub(super) fn search_by(
        method: LevenbergMarquardt,
        form: &'static Form,
        model: &dyn Model,
        data: &Data,
        bounds: Vec<(f64, f64)>,
        starts: &Starts,
    ) -> Result<Self, String> {
        let fit =
            || -> Result<Fit, FitError> { method.fit(model, data, &Bounds::new(&bounds)?, starts) };
        let fit = fit().map_err(|e| format!("{}: {e}", form.what))?;
        if fit.parameters.len() != form.parameters.len() {
            let (found, named) = (fit.parameters.len(), form.parameters.len());
            return Err(format!(
                "{}: {found} parameters, but {named} names",
                form.what
            ));
        }
        Ok(Self { fit, form, bounds })
    }

    /// Parameters that are at a bound or that the data do not determine.
    pub(super) fn faults(&self) -> Vec<Fault> {
        let parameters = self.form.parameters.iter().enumerate();
        let faults = parameters.filter_map(|(j, (key, unit))| {
            let (what, value) = (&self.form.what, self.fit.parameters[j]);
            let (lower, upper) = self.bounds[j];
            let at = |side: &str, bound: f64| {
                Some(format!(
                    "{what}: {key} = {value:e} {unit} is at its {side} bound, {bound:e} {unit}"
                ))
            };
            let message = match self.fit.statuses[j] {
                Status::AtLowerBound => at("lower", lower),
                Status::AtUpperBound => at("upper", upper),
                Status::Undetermined => Some(format!("{what}: the data do not determine {key}")),
                Status::Determined | Status::Weak | Status::Held => None,
            };
            message.map(|message| Fault {
                key,
                message,
                is_bound: self.fit.statuses[j] != Status::Undetermined,
            })
        });
        faults.collect()
    }
}

/// Returns an error with one line for each fault, except for the bounds in `allowed`.
pub(super) fn accept(faults: &[Fault], allowed: &[String]) -> Result<(), String> {
    let refused: Vec<&Fault> = faults
        .iter()
        .filter(|fault| !(fault.is_bound && allowed.iter().any(|key| key == fault.key)))
        .collect();
    if refused.is_empty() {
        return Ok(());
    }
    let lines: Vec<&str> = refused.iter().map(|fault| fault.message.as_str()).collect();
    let keys: Vec<&str> = refused
        .iter()
        .filter(|f| f.is_bound)
        .map(|f| f.key)
        .collect();
    let hint = if keys.is_empty() {
        String::new()
    } else {
        let keys = keys.join(",");
        format!("; check the data, or accept these bounds with --allow-bounds {keys}")
    };
    Err(format!("no law is written: {}{hint}", lines.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(key: &'static str, is_bound: bool) -> Fault {
        let message = format!("{key} is bad");
        Fault {
            key,
            message,
            is_bound,
        }
    }

    #[test]
    fn bounds_are_allowed_by_key() {
        let faults = [fault("b3.rest", true), fault("bend.rise", true)];
        assert_eq!(accept(&[], &[]), Ok(()));
        let both = ["b3.rest".to_owned(), "bend.rise".to_owned()];
        assert_eq!(accept(&faults, &both), Ok(()));
        let message = accept(&faults, &both[..1]).unwrap_err();
        assert!(
            message.starts_with("no law is written: bend.rise is bad; "),
            "{message}"
        );
        assert!(message.ends_with("--allow-bounds bend.rise"), "{message}");
        let message = accept(&[fault("b3.rest", false)], &both).unwrap_err();
        assert_eq!(message, "no law is written: b3.rest is bad");
    }
}
