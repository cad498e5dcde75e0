//! Summaries of runs.

use serde_json::Value;
use std::path::Path;

pub(crate) fn summary(directory: &Path) -> Option<Value> {
    let text = std::fs::read_to_string(directory.join("summary.json")).ok()?;
    let summary: Value = serde_json::from_str(&text).ok()?;
    (summary["status"] != "interrupted").then_some(summary)
}
