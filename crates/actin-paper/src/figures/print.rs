//! Pictures for papers: every SVG file of a report again as PDF, with its letters as text, and as PNG.
//!
//! A Chromium makes them, which draws the pictures as the report page shows them; it is looked for in `CHROME`
//! and on the path.

use actin_draw::browser;
use actin_draw::report::{Artefact, Picture};
use rayon::prelude::*;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Pixels of a PNG file per pixel of the SVG file: a picture of 900 has 1800, which are 300 dpi on 152 mm.
const FINER: u32 = 2;

/// Writes PDF and PNG files beside the pictures of all artefacts.
///
/// # Errors
/// No browser, one that fails, a file that cannot be read or written.
pub(super) fn write(artefacts: &[Artefact], out: &Path) -> Result<usize, String> {
    let browser = browser().ok_or(
        "--print needs a Chromium or Chrome: there is none on the path; name one in the variable CHROME",
    )?;
    let pictures: Vec<&Picture> = artefacts.iter().flat_map(|a| &a.pictures).collect();
    pictures
        .par_iter()
        .try_for_each(|picture| print(&browser, &out.join(&picture.file)))?;
    Ok(pictures.len())
}

/// One picture as PDF and as PNG.
fn print(browser: &Path, path: &Path) -> Result<(), String> {
    let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let svg = fs::read_to_string(path).map_err(|e| at(&e))?;
    let [width, height] =
        actin_draw::page::size(&svg).ok_or_else(|| at(&"says nothing of its size"))?;
    let folder = tempfile::tempdir().map_err(|e| at(&e))?;
    let page = folder.path().join("page.html");
    let text = format!(
        "<!doctype html><meta charset=\"utf-8\"><style>@page {{ size: {width}px {height}px; margin: 0 }} \
         body {{ margin: 0; height: {height}px; overflow: hidden }} svg {{ display: block }}</style>{svg}"
    );
    fs::write(&page, text).map_err(|e| at(&e))?;
    let pdf = path.with_extension("pdf");
    let to_pdf = [
        format!("--print-to-pdf={}", pdf.display()),
        "--no-pdf-header-footer".into(),
    ];
    let png = path.with_extension("png");
    let to_png = [
        format!("--screenshot={}", png.display()),
        format!("--window-size={width},{height}"),
        format!("--force-device-scale-factor={FINER}"),
        "--hide-scrollbars".into(),
    ];
    run(browser, &to_pdf, &page, &pdf)?;
    run(browser, &to_png, &page, &png)
}

/// Has the browser make `file` of a page.
fn run(browser: &Path, arguments: &[String], page: &Path, file: &Path) -> Result<(), String> {
    let profile = page.with_file_name("profile");
    let ended = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--no-first-run",
        ])
        .args([
            "--disable-dev-shm-usage",
            "--blink-settings=preferredColorScheme=1",
        ])
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(arguments)
        .arg(format!("file://{}", page.display()))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|e| format!("{}: {e}", browser.display()))?;
    if ended.success() && file.is_file() {
        return Ok(());
    }
    let (file, browser) = (file.display(), browser.display());
    Err(format!("{file}: not written by {browser}: {ended}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One page of the picture's size with letters as text, and twice as many pixels.
    #[test]
    fn a_picture_is_printed() {
        let Some(browser) = browser() else {
            assert!(std::env::var_os("ACTIN_REQUIRE_BROWSER").is_none());
            eprintln!("SKIPPED: no Chromium on the path: no picture was printed");
            return;
        };
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.svg");
        let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"320\" height=\"200\" viewBox=\"0 0 320 200\">\
            <rect width=\"320\" height=\"200\" fill=\"#fff\"/><text x=\"9\" y=\"99\">Letters</text></svg>";
        fs::write(&path, svg).unwrap();
        print(&browser, &path).unwrap();
        let pdf = fs::read(path.with_extension("pdf")).unwrap();
        let text = String::from_utf8_lossy(&pdf);
        assert_eq!(text.matches("/Type /Page\n").count(), 1);
        // A pixel is three quarters of a point.
        let from = text.find("/MediaBox [0 0 ").expect("a page has a size") + 15;
        let sides: Vec<f64> = text[from..from + text[from..].find(']').unwrap()]
            .split(' ')
            .map(|side| side.parse().unwrap())
            .collect();
        // Chromium rounds pages up by less than a point.
        assert!(
            (sides[0] - 240.0).abs() < 1.0 && (sides[1] - 150.0).abs() < 1.0,
            "{sides:?}"
        );
        assert!(text.contains("/Font"));
        let png = fs::read(path.with_extension("png")).unwrap();
        let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
        assert_eq!((side(16), side(20)), (640, 400));
    }
}
