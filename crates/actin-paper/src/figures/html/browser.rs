//! The page in headless Chromium, light and dark: nothing fails, every picture is there and follows
//! the page's colours, every view is drawn and turns, and nothing reaches beyond a phone's screen.
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
/// Widths at which the page is looked at (pixels): a phone, a tablet, a laptop.
const WIDTHS: [u32; 3] = [360, 800, 1280];
/// Far longer than a browser takes on a busy machine.
const LIMIT: Duration = Duration::from_mins(8);

/// The browser; nothing, told loudly, if there is none and none is required.
fn browser() -> Option<PathBuf> {
    let found = find_browser();
    if found.is_none() {
        assert!(
            std::env::var_os("ACTIN_REQUIRE_BROWSER").is_none(),
            "ACTIN_REQUIRE_BROWSER is set and there is no browser"
        );
        eprintln!("SKIPPED: no Chromium on the path: the page was NOT tested in a browser");
    }
    found
}

fn find_browser() -> Option<PathBuf> {
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

/// What a reader has asked the system for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Mode {
    Light,
    Dark,
}

/// What the probe finds in `page` at each width.
fn probed(browser: &Path, page: &str, mode: Mode, folder: &Path) -> Vec<Value> {
    let probe = format!("<script>\n{PROBE}</script>");
    let copy = page.replacen("<head>", &format!("<head>{probe}"), 1);
    fs::write(folder.join("copy.html"), copy).unwrap();
    fs::write(folder.join("around.html"), around()).unwrap();
    let text = dumped(browser, mode, folder);
    let found = WIDTHS.iter().map(|width| {
        let begin = format!("<pre id=\"w{width}\">");
        let place = text.find(&begin).expect("the page around has its place") + begin.len();
        let json = &text[place..place + text[place..].find("</pre>").unwrap()];
        serde_json::from_str(json).unwrap_or_else(|e| panic!("{width}: {e}: `{json}`"))
    });
    found.collect()
}

/// A page that shows the copy in a frame of each width and keeps what the probes tell it. A window
/// itself cannot be as narrow as a phone.
fn around() -> String {
    let mut left = 0;
    let frames = WIDTHS.map(|width| {
        let frame = format!(
            "<pre id=\"w{width}\"></pre><iframe name=\"w{width}\" src=\"copy.html\" \
             style=\"position:fixed;top:0;left:{left}px;width:{width}px;height:900px;border:0\"></iframe>",
        );
        left += width + 10;
        frame
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
fn dumped(browser: &Path, mode: Mode, folder: &Path) -> String {
    let dump = folder.join("dump.html");
    // Blink counts: 0 is dark, 1 light.
    let scheme = u8::from(mode == Mode::Light);
    let mut child = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .args(["--virtual-time-budget=240000", "--window-size=2500,1000"])
        .arg(format!("--blink-settings=preferredColorScheme={scheme}"))
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

/// Artefacts of every kind, by the command's own code: three-dimensional pictures with views,
/// motions, linkers, a filament turned in its middle, buckled filaments, fits, a list, samplings.
const KINDS: [&str; 8] = [
    "fig1", "fig4", "fig6", "fig7", "fig8", "fig9", "table1", "table3",
];
/// Views among them: those of the figures, but of that of the fits.
const VIEWS: usize = 5;

#[test]
fn the_page_works_in_a_browser() {
    let Some(browser) = browser() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let options = crate::figures::Options {
        ids: KINDS.map(String::from).into(),
        out: folder.path().to_path_buf(),
        quick: true,
        threads: None,
        fresh: false,
        palette: crate::figures::Palette::default(),
    };
    crate::figures::reproduce(&options, &|line| println!("{line}")).unwrap();
    let page = fs::read_to_string(folder.path().join("report.html")).unwrap();
    for mode in [Mode::Light, Mode::Dark] {
        let found = probed(&browser, &page, mode, folder.path());
        for (width, found) in WIDTHS.iter().zip(&found) {
            assert_works(found, mode, *width);
            let pictures = found["pictures"].as_array().unwrap();
            assert_eq!(
                pictures.len(),
                page.matches("<div class=\"picture\"").count()
            );
        }
    }
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
    let views = found["views"].as_array().unwrap();
    assert_eq!(views.len(), VIEWS);
    for view in views {
        assert_is_alive(view, width);
    }
}

/// All letters are far from their ground, and the right way round.
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

/// The sum of the components of a colour, at most 765.
fn brightness(colour: &Value) -> i64 {
    let components = colour.as_array().unwrap().iter();
    components.take(3).map(|c| c.as_i64().unwrap()).sum()
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
    assert!(states.len() >= 2, "{width}: {view}");
    assert!(states.iter().all(|s| some.contains(&count(s))), "{view}");
    assert!(count(&view["legend"]) >= 2);
}

/// The probe finds what is wrong with a page that is: else the test above would prove nothing.
#[test]
fn the_probe_finds_what_is_wrong() {
    let page = "<!doctype html><html><head></head><body><img src=\"missing.png\">\
        <figure><svg width=\"200\" height=\"100\"></svg></figure>\
        <figure><svg width=\"200\" height=\"100\"><text x=\"190\" y=\"50\">out</text></svg></figure>\
        <div style=\"width:3000px\">wide</div><script>console.error('told'); \
        Promise.reject('not kept'); undefined_name();</script></body></html>";
    let Some(browser) = browser() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let found = probed(&browser, page, Mode::Light, folder.path());
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
