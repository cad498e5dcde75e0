//! Rules of a sweep that do not involve its scene.

use crate::sweep::{Axis, Ron, Scale, Span, Sweep};
use actin_sim::{Override, SceneProblem};
use std::collections::BTreeSet;

/// Largest number of runs, each of which has a directory.
const MOST_RUNS: f64 = 1e6;

/// Largest number of set and varied keys, which are compared pairwise.
const MOST_KEYS: usize = 1000;

const MOST_PROBLEMS: usize = 20;

type Checked = Result<(), SceneProblem>;

pub(crate) fn problems(sweep: &Sweep) -> Vec<SceneProblem> {
    let mut found: Vec<SceneProblem> = Vec::new();
    let mut note = |checked: Checked| {
        let is_new = |p: &SceneProblem| found.iter().all(|f| f.key != p.key);
        let new = checked.err().filter(is_new);
        found.extend(new.filter(|_| found.len() < MOST_PROBLEMS));
    };
    for (i, value) in sweep.set.iter().enumerate() {
        note(check_path(&format!("set[{i}].key"), &value.key));
    }
    for (i, axis) in sweep.vary.iter().enumerate() {
        note(check_axis(&format!("vary[{i}]"), axis));
    }
    note(check_twice(sweep));
    note(some("results", sweep.results.len(), "result"));
    let mut before = BTreeSet::new();
    for (i, name) in sweep.results.iter().enumerate() {
        note(check_result(i, name, before.insert(name)));
    }
    note(check_samples(sweep));
    note(check_runs(sweep));
    found
}

fn check_samples(sweep: &Sweep) -> Checked {
    let Some(samples) = &sweep.samples else {
        return Ok(());
    };
    if samples.number == 0 {
        return Err(SceneProblem::new("samples.number", 0, "must be at least 1"));
    }
    if samples.of.is_empty() {
        let rule = "must name at least one of Bonds, Noise, Imperfections, Linkers";
        return Err(SceneProblem::new("samples.of", "[]", rule));
    }
    Ok(())
}

fn check_runs(sweep: &Sweep) -> Checked {
    let samples = sweep.samples.as_ref();
    let points = sweep.vary.iter().map(|axis| axis.len() as f64);
    let runs = points.product::<f64>() * samples.map_or(1.0, |samples| samples.number as f64);
    if runs > MOST_RUNS {
        let rule = format!("a sweep has at most {MOST_RUNS:e} runs, these are {runs:e}");
        return Err(SceneProblem::new("vary", "", rule));
    }
    Ok(())
}

fn check_axis(key: &str, axis: &Axis) -> Checked {
    let at = |name: &str| format!("{key}.{name}");
    match axis {
        Axis::List { key, values } => {
            check_path(&at("key"), key)?;
            some(&at("values"), values.len(), "value")
        }
        Axis::Grid {
            key,
            from,
            to,
            number,
            scale,
        } => {
            check_path(&at("key"), key)?;
            check_ends(&at(""), (*from, *to), *scale)?;
            let rule = "a grid must have at least two points";
            let few = || SceneProblem::new(at("number"), number, rule);
            (*number >= 2).then_some(()).ok_or_else(few)
        }
        Axis::Rows { keys, rows } => check_rows(key, keys, rows),
        Axis::Random { number, over, .. } => {
            some(&at("number"), *number, "point")?;
            some(&at("over"), over.len(), "key")?;
            let spans = over.iter().enumerate();
            spans
                .into_iter()
                .try_for_each(|(i, span)| check_span(&at(&format!("over[{i}]")), span))
        }
    }
}

fn check_rows(key: &str, keys: &[String], rows: &[Vec<Ron>]) -> Checked {
    some(&format!("{key}.keys"), keys.len(), "key")?;
    for (i, one) in keys.iter().enumerate() {
        check_path(&format!("{key}.keys[{i}]"), one)?;
    }
    some(&format!("{key}.rows"), rows.len(), "row")?;
    let wrong = rows.iter().position(|row| row.len() != keys.len());
    let Some(i) = wrong else { return Ok(()) };
    let rule = format!(
        "a row must have a value for each of the {} keys",
        keys.len()
    );
    let count = format!("{} values", rows[i].len());
    Err(SceneProblem::new(format!("{key}.rows[{i}]"), count, rule))
}

fn check_span(key: &str, span: &Span) -> Checked {
    check_path(&format!("{key}.key"), &span.key)?;
    check_ends(&format!("{key}."), (span.from, span.to), span.scale)?;
    if span.to <= span.from {
        let rule = format!("must be greater than from = {:?}", span.from);
        let value = format!("{:?}", span.to);
        return Err(SceneProblem::new(format!("{key}.to"), value, rule));
    }
    Ok(())
}

fn check_ends(prefix: &str, (from, to): (f64, f64), scale: Scale) -> Checked {
    for (name, value) in [("from", from), ("to", to)] {
        let rule = match scale {
            _ if !value.is_finite() => "must be finite",
            Scale::Logarithmic if value <= 0.0 => "must be positive on a logarithmic scale",
            _ => continue,
        };
        let value = format!("{value:?}");
        return Err(SceneProblem::new(format!("{prefix}{name}"), value, rule));
    }
    Ok(())
}

fn some(key: &str, count: usize, what: &str) -> Checked {
    let rule = || format!("must have at least one {what}");
    let none = || SceneProblem::new(key, count, rule());
    (count > 0).then_some(()).ok_or_else(none)
}

fn check_path(at: &str, key: &str) -> Checked {
    let parsed = format!("{key}=0").parse::<Override>();
    let rule = "must be the path of a key, such as loads[0].force_pn[2]";
    match parsed {
        Ok(one) if one.key == key => Ok(()),
        _ => Err(SceneProblem::new(at, format!("{key:?}"), rule)),
    }
}

/// Checks that no key is varied twice, directly or through a parent key, or replaces a set value.
fn check_twice(sweep: &Sweep) -> Checked {
    let set = sweep.set.iter().enumerate();
    let set = set.map(|(i, value)| (format!("set[{i}]"), value.key.as_str(), false));
    let vary = sweep.vary.iter().enumerate().flat_map(|(i, axis)| {
        let keys = axis.keys().into_iter();
        keys.map(move |key| (format!("vary[{i}]"), key, true))
    });
    let mut seen: Vec<(String, &str, bool)> = Vec::new();
    for (place, key, is_varied) in set.chain(vary) {
        if seen.len() == MOST_KEYS {
            let rule = format!("a sweep sets and varies at most {MOST_KEYS} keys");
            return Err(SceneProblem::new(place, key, rule));
        }
        for (other_place, other, other_is_varied) in &seen {
            let replaces = is_within(other, key);
            if replaces && !other_is_varied {
                let rule = format!(
                    "would replace {other_place}, which sets {other} for all runs: remove one of the two"
                );
                return Err(SceneProblem::new(place, key, rule));
            }
            if *other_is_varied && (replaces || is_within(key, other)) {
                let rule = format!("is varied already, as {other}");
                return Err(SceneProblem::new(place, key, rule));
            }
        }
        seen.push((place, key, is_varied));
    }
    Ok(())
}

/// Returns whether a key equals `above` or lies below it; `filament` equals `filaments[0]`, and `[*]` any index.
fn is_within(key: &str, above: &str) -> bool {
    let own = |key: &str| match key.strip_prefix("filament") {
        Some(rest) if rest.is_empty() || rest.starts_with('.') => format!("filaments[0]{rest}"),
        _ => key.to_owned(),
    };
    let (key, above) = (own(key), own(above));
    let mut steps = key.split(['.', '[']);
    let is_index = |step: &str| step.ends_with(']');
    above.split(['.', '[']).all(|above| {
        steps.next().is_some_and(|step| {
            step == above || ([step, above].contains(&"*]") && is_index(step) && is_index(above))
        })
    })
}

fn check_result(i: usize, name: &str, is_new: bool) -> Checked {
    let rule = if name == "wall_s" {
        "is a run time, which is not reproducible: remove it"
    } else if !is_new {
        "is in the list already"
    } else {
        return Ok(());
    };
    Err(SceneProblem::new(format!("results[{i}]"), name, rule))
}
