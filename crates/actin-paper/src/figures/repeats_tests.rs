//! Tests of reproducibility: independence of threads and agreement with the committed reports.

use super::page::browser_tests::assert_page_works;
use super::*;
use std::collections::BTreeMap;
use std::path::Path;
use tempfile::TempDir;

/// Artefacts that take a few seconds together and cover all kinds of computations.
const CHEAP: [&str; 8] = [
    "fig1", "fig2", "fig3", "fig4", "fig7", "fig9", "table1", "table3",
];

/// Environment variables of [`run_in_separate_process`]: artefacts, output folder and number of threads.
const IDS: &str = "ACTIN_FIGURES_IDS";
const OUT: &str = "ACTIN_FIGURES_OUT";
const THREADS: &str = "ACTIN_FIGURES_THREADS";

/// Runs in a separate process, because tables of one process share their computations.
#[test]
#[ignore = "started by the test below"]
fn run_in_separate_process() {
    // The variables are missing if all ignored tests are run.
    let [Ok(ids), Ok(out), Ok(threads)] = [IDS, OUT, THREADS].map(std::env::var) else {
        return;
    };
    let options = Options {
        ids: ids.split(',').map(String::from).collect(),
        out: out.into(),
        quick: true,
        threads: Some(threads.parse().unwrap()),
        fresh: false,
        print: false,
        palette: Palette::default(),
    };
    reproduce(&options, &|line| println!("{line}")).unwrap();
}

fn run(ids: &[&str], threads: usize) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let output = std::process::Command::new(std::env::current_exe().unwrap())
        .args([
            "figures::repeats_tests::run_in_separate_process",
            "--exact",
            "--ignored",
        ])
        .env(IDS, ids.join(","))
        .env(OUT, folder.path())
        .env(THREADS, threads.to_string())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success() && told.contains("1 passed"),
        "{told}"
    );
    folder
}

fn files(out: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(out).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    let written = paths.filter(|path| path.is_file()).map(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read(path).unwrap())
    });
    written.filter(|(name, _)| name != "report.html").collect()
}

fn record(out: &Path, id: &str) -> serde_json::Value {
    let path = out.join(".artefacts").join(format!("{id}.json"));
    let mut record: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap();
    let artefact = record["artefact"].as_object_mut().unwrap();
    assert!(artefact.remove("wall_s").unwrap().as_f64() >= Some(0.0));
    record
}

/// Asserts agreement with `docs/report-quick.json` and, for shared numbers, with `docs/report.json`.
fn assert_current(out: &Path) {
    let rows = report::read(&out.join("report.json")).unwrap();
    let stale = crate::committed::stale(&rows).unwrap();
    assert!(
        stale.is_empty(),
        "{} rows are stale:\n{}",
        stale.len(),
        stale.join("\n")
    );
}

#[test]
fn committed_numbers_are_reproduced() {
    let folder = run(&EXPERIMENTS.map(|e| e.0), 2);
    assert_current(folder.path());
    assert_page_works(folder.path());
}

/// Compares processes with one and two threads. Guards against unordered results, unordered sums, unseeded random
/// numbers and iteration in hash order.
#[test]
fn results_are_independent_of_threads() {
    let first = run(&CHEAP, 1);
    assert_current(first.path());
    let expected = files(first.path());
    let count = |kind: &str| expected.keys().filter(|name| name.ends_with(kind)).count();
    assert!(expected.contains_key("report.json"));
    assert!(count(".svg") >= 9 && count(".csv") >= 7 && count("_view.json") >= 5);
    let again = run(&CHEAP, 2);
    let written = files(again.path());
    assert!(expected.keys().eq(written.keys()));
    for (name, bytes) in &expected {
        assert!(*bytes == written[name], "{name} on two threads");
    }
    for id in CHEAP {
        let [one, other] = [&first, &again].map(|folder| record(folder.path(), id));
        assert!(one == other, "record of {id} on two threads");
    }
}
