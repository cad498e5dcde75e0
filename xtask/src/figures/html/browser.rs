//! The page in headless Chromium: nothing fails, every picture is there, every view is drawn and
//! turns, and nothing reaches beyond a phone's screen.
//!
//! Needs a browser: `CHROME`, or one of [`NAMES`] on the path. Without one the tests say loudly that
//! they were skipped; where `ACTIN_REQUIRE_BROWSER` is set, as `.ci/run` does, they fail.

use serde_json::Value;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const NAMES: [&str; 4] = [
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
];
const PROBE: &str = include_str!("probe.js");
/// Widths at which the page is looked at (pixels): a phone, a laptop.
const WIDTHS: [u32; 2] = [360, 1280];
/// Far longer than a browser takes on a busy machine.
const LIMIT: Duration = Duration::from_mins(4);

fn browser() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("CHROME") {
        return Some(named.into());
    }
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let candidates = NAMES
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    candidates.into_iter().find(|file| file.is_file())
}

/// What the probe finds in `page` at each width; nothing if there is no browser.
fn probed(page: &str, folder: &Path) -> Option<Vec<Value>> {
    let Some(browser) = browser() else {
        assert!(
            std::env::var_os("ACTIN_REQUIRE_BROWSER").is_none(),
            "ACTIN_REQUIRE_BROWSER is set and there is no browser"
        );
        eprintln!("SKIPPED: no Chromium on the path: the page was NOT tested in a browser");
        return None;
    };
    let probe = format!("<script>\n{PROBE}</script>");
    let copy = page.replacen("<head>", &format!("<head>{probe}"), 1);
    fs::write(folder.join("copy.html"), copy).unwrap();
    fs::write(folder.join("around.html"), around()).unwrap();
    let text = dumped(&browser, folder);
    let found = WIDTHS.iter().map(|width| {
        let begin = format!("<pre id=\"w{width}\">");
        let place = text.find(&begin).expect("the page around has its place") + begin.len();
        let json = &text[place..place + text[place..].find("</pre>").unwrap()];
        serde_json::from_str(json).unwrap_or_else(|e| panic!("{width}: {e}: `{json}`"))
    });
    Some(found.collect())
}

/// A page that shows the copy in a frame of each width and keeps what the probes tell it. A window
/// itself cannot be as narrow as a phone.
fn around() -> String {
    let frames = WIDTHS.map(|width| {
        format!(
            "<pre id=\"w{width}\"></pre><iframe name=\"w{width}\" src=\"copy.html\" \
             style=\"position:fixed;top:0;left:{}px;width:{width}px;height:900px;border:0\"></iframe>",
            if width == WIDTHS[0] { 0 } else { WIDTHS[0] + 10 }
        )
    });
    format!(
        "<!doctype html><meta charset=\"utf-8\"><script>\
         window.addEventListener('message', ({{ data }}) => {{\
         const json = JSON.stringify(data.found).replace(/[<>&]/g, (c) => '\\\\u00' + \
         c.charCodeAt(0).toString(16));\
         document.getElementById(data.name).textContent = json; }});</script>{}",
        frames.concat()
    )
}

/// The page around, as it stands when all that it waits for has happened.
fn dumped(browser: &Path, folder: &Path) -> String {
    let dump = folder.join("dump.html");
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .args(["--virtual-time-budget=60000", "--window-size=1700,1000"])
        .args(["--no-first-run", "--disable-dev-shm-usage"])
        .arg(format!(
            "--user-data-dir={}",
            folder.join("profile").display()
        ))
        .arg(format!("file://{}", folder.join("around.html").display()))
        .stdout(File::create(&dump).unwrap())
        .stderr(Stdio::null())
        .spawn()
        .expect("the browser starts");
    let began = Instant::now();
    while child.try_wait().unwrap().is_none() && began.elapsed() < LIMIT {
        std::thread::sleep(Duration::from_millis(50));
    }
    let ended = child.try_wait().unwrap().is_some();
    if !ended {
        child.kill().unwrap();
    }
    child.wait().unwrap();
    assert!(ended, "the browser did not end within {LIMIT:?}");
    fs::read_to_string(dump).unwrap()
}

fn count(value: &Value) -> u64 {
    value
        .as_u64()
        .unwrap_or_else(|| panic!("no count: {value}"))
}

/// A page of cheap artefacts by the command's own code: three-dimensional pictures with views, and a
/// table.
#[test]
fn the_page_works_in_a_browser() {
    let folder = tempfile::tempdir().unwrap();
    let options = crate::figures::Options {
        ids: ["fig1", "fig3", "table1"].map(String::from).into(),
        out: folder.path().to_path_buf(),
        quick: true,
        threads: None,
        fresh: false,
        palette: crate::figures::Palette::default(),
    };
    crate::figures::reproduce(&options).unwrap();
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    let Some(found) = probed(&page, folder.path()) else {
        return;
    };
    for (width, found) in WIDTHS.iter().zip(&found) {
        assert_eq!(found["errors"], serde_json::json!([]), "{width}");
        assert_eq!(found["innerWidth"], *width);
        assert_eq!(found["beyond"], serde_json::json!([]), "{width}");
        assert!(count(&found["scrollWidth"]) <= u64::from(*width), "{width}");
        let pictures = found["pictures"].as_array().unwrap();
        assert_eq!(pictures.len(), 2);
        for picture in pictures {
            assert_eq!(picture["loaded"], true, "{width}: {picture}");
            assert!(
                picture["width"].as_f64() > Some(100.0) && picture["height"].as_f64() > Some(100.0)
            );
        }
        let views = found["views"].as_array().unwrap();
        assert_eq!(views.len(), 2);
        for view in views {
            assert_is_alive(view, *width);
        }
    }
}

/// A view is drawn, every act changes it, and after the button it is as at first.
fn assert_is_alive(view: &Value, width: u32) {
    let pixels: u64 = view["size"].as_array().unwrap().iter().map(count).product();
    // A filament and its axes cover between a hundredth and all but some of the view.
    let some = pixels / 100..pixels * 9 / 10;
    assert!(some.contains(&count(&view["painted"])), "{width}: {view}");
    for act in ["turned", "zoomed", "keyed", "compared"] {
        assert!(view[act].as_i64() > Some(1000), "{width}, {act}: {view}");
    }
    assert_eq!(view["after_reset"], 0, "{width}: {view}");
    assert!(count(&view["lines"]) > 1000, "{width}: {view}");
    let states = view["states"].as_array().unwrap();
    assert_eq!(states.len(), 3, "{width}: {view}");
    assert!(states.iter().all(|s| some.contains(&count(s))), "{view}");
    assert!(count(&view["legend"]) >= 2);
}

/// The probe finds what is wrong with a page that is: else the test above would prove nothing.
#[test]
fn the_probe_finds_what_is_wrong() {
    let page = "<!doctype html><html><head></head><body><img src=\"missing.png\">\
        <figure><svg width=\"200\" height=\"100\"></svg></figure>\
        <div style=\"width:3000px\">wide</div><script>console.error('told'); \
        Promise.reject('not kept'); undefined_name();</script></body></html>";
    let folder = tempfile::tempdir().unwrap();
    let Some(found) = probed(page, folder.path()) else {
        return;
    };
    for found in found {
        let errors = found["errors"].to_string();
        for what in ["missing.png", "told", "not kept", "undefined_name"] {
            assert!(errors.contains(what), "{what} is not among {errors}");
        }
        assert!(count(&found["scrollWidth"]) >= 3000);
        assert_eq!(found["beyond"].as_array().unwrap().len(), 1, "{found}");
        let pictures = found["pictures"].as_array().unwrap();
        assert!(pictures.iter().all(|picture| picture["loaded"] == false));
    }
}
