//! Tests of the page in headless Chromium, in light and dark mode: errors, pictures, views and page width.
//!
//! The module `chromium` describes the required browser.

#[path = "../../../../actin-view/tests/chromium/mod.rs"]
mod chromium;

use chromium::{Mode, browser, count};
use rayon::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::Path;

const PROBE: &str = include_str!("probe.js");
const WIDTHS: [u32; 2] = [360, 1280];

fn probed(browser: &Path, page: &str, (mode, widths): (Mode, &[u32]), folder: &Path) -> Vec<Value> {
    chromium::probed(browser, (page, PROBE), widths, mode, folder)
}

/// Asserts that the page in a folder of figures works; only where there is a browser.
pub(in crate::figures) fn assert_page_works(folder: &Path) {
    let Some(browser) = browser() else {
        return;
    };
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    // The layout does not depend on the mode.
    let modes = [(Mode::Light, &WIDTHS[..]), (Mode::Dark, &WIDTHS[1..])];
    modes.into_par_iter().for_each(|(mode, widths)| {
        let scratch = tempfile::tempdir().unwrap();
        let found = probed(&browser, &page, (mode, widths), scratch.path());
        for (width, found) in widths.iter().zip(&found) {
            assert_works(found, mode, *width);
            let number = |of: &str| found[of].as_array().unwrap().len();
            let pictures = page.matches("<div class=\"picture\"").count();
            let views = page.matches("<figure class=\"viewer\"><script").count();
            let is_operated = (*width < 500) == (mode == Mode::Light);
            let views = if is_operated { views } else { 0 };
            assert_eq!([number("pictures"), number("views")], [pictures, views]);
        }
    });
}

fn assert_works(found: &Value, mode: Mode, width: u32) {
    assert_eq!(found["errors"], serde_json::json!([]), "{width}");
    assert_eq!(found["innerWidth"], width);
    assert_eq!(found["dark"], mode == Mode::Dark);
    assert_eq!(found["beyond"], serde_json::json!([]), "{width}");
    assert!(count(&found["scrollWidth"]) <= u64::from(width), "{width}");
    for picture in found["pictures"].as_array().unwrap() {
        assert_eq!(picture["loaded"], true, "{width}: {picture}");
        let sides = [&picture["width"], &picture["height"]];
        assert!(sides.into_iter().all(|side| side.as_f64() > Some(100.0)));
        assert_eq!(picture["clipped"], serde_json::json!([]), "{width}");
        assert_legible(picture, mode);
    }
    for view in found["views"].as_array().unwrap() {
        assert_is_alive(view, width);
    }
}

/// Asserts contrast of all letters with the background, dark on light in light mode.
fn assert_legible(picture: &Value, mode: Mode) {
    let ground = brightness(&picture["ground"]);
    let letters = picture["letters"].as_array().unwrap();
    assert!(!letters.is_empty(), "{picture}");
    for letters in letters.iter().map(brightness) {
        let brighter = if mode == Mode::Light { ground } else { letters };
        assert!(
            (ground - letters).abs() > 500 && brighter > 600,
            "{letters} on {ground}: {picture}"
        );
    }
}

fn brightness(colour: &Value) -> i64 {
    let components = colour.as_array().unwrap().iter();
    components.take(3).map(|c| c.as_i64().unwrap()).sum()
}

/// Asserts that a view is drawn, responds to every input and returns to its initial state on reset.
fn assert_is_alive(view: &Value, width: u32) {
    let pixels: u64 = view["size"].as_array().unwrap().iter().map(count).product();
    // A filament and its axes cover between 1 % and 90 % of the view.
    let some = pixels / 100..pixels * 9 / 10;
    assert!(some.contains(&count(&view["painted"])), "{width}: {view}");
    for act in ["turned", "zoomed", "keyed", "compared"] {
        assert!(view[act].as_i64() > Some(1000), "{width}, {act}: {view}");
    }
    assert_eq!(view["after_reset"], 0, "{width}: {view}");
    assert!(count(&view["lines"]) > 1000, "{width}: {view}");
    let states = view["states"].as_array().unwrap();
    // Views of a single state have no menu.
    assert!(states.len() != 1, "{width}: {view}");
    assert!(states.iter().all(|s| some.contains(&count(s))), "{view}");
    assert!(count(&view["legend"]) >= 2);
}

#[test]
fn probe_finds_errors() {
    let page = "<!doctype html><html><head></head><body><img src=\"missing.png\">\
        <figure><svg width=\"200\" height=\"100\"></svg></figure>\
        <figure><svg width=\"200\" height=\"100\"><text x=\"190\" y=\"50\">out</text></svg></figure>\
        <div style=\"width:3000px\">wide</div><script>console.error('told'); \
        Promise.reject('not kept'); undefined_name();</script></body></html>";
    let Some(browser) = browser() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let found = probed(&browser, page, (Mode::Light, &WIDTHS[..]), folder.path());
    for found in found {
        let errors = found["errors"].to_string();
        for what in ["missing.png", "told", "not kept", "undefined_name"] {
            assert!(errors.contains(what), "{what} is not among {errors}");
        }
        assert!(count(&found["scrollWidth"]) >= 3000);
        assert_eq!(found["beyond"].as_array().unwrap().len(), 1, "{found}");
        let pictures = found["pictures"].as_array().unwrap();
        let loaded = pictures.iter().filter(|picture| picture["loaded"] == true);
        let clipped: Vec<&Value> = loaded.map(|picture| &picture["clipped"]).collect();
        assert_eq!(clipped, [&serde_json::json!(["out"])]);
    }
}
