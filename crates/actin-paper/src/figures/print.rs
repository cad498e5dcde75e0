//! Pictures for publications: SVG files of a report converted to PDF, with selectable text, and PNG.
//!
//! Chromium or Chrome makes the PDF files. It is searched in the variable `CHROME` and on the path.

use actin_draw::browser;
use actin_draw::report::{Artefact, Picture};
use rayon::prelude::*;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

/// Pixels of a PNG file per pixel of the SVG file. A picture of 900 pixels has 300 dpi at a width of 152 mm.
const FINER: f32 = 2.0;

/// Writes PDF and PNG files next to the pictures of all artefacts.
///
/// # Errors
/// No browser is found, it fails, or a file cannot be read or written.
pub(super) fn write(artefacts: &[Artefact], out: &Path) -> Result<usize, String> {
    let browser = browser().ok_or(
        "--print requires Chromium or Chrome, and none was found on the path: set the variable CHROME to its file",
    )?;
    let pictures: Vec<&Picture> = artefacts.iter().flat_map(|a| &a.pictures).collect();
    pictures
        .par_iter()
        .try_for_each(|picture| print(&browser, &out.join(&picture.file)))?;
    Ok(pictures.len())
}

fn print(browser: &Path, path: &Path) -> Result<(), String> {
    let at = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let svg = fs::read_to_string(path).map_err(|e| at(&e))?;
    let [width, height] =
        actin_draw::page::size(&svg).ok_or_else(|| at(&"the picture has no width and height"))?;
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
    let png = actin_draw::png(&svg, FINER).map_err(|e| at(&e))?;
    fs::write(path.with_extension("png"), png).map_err(|e| at(&e))?;
    run(browser, &to_pdf, &page, &pdf)
}

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
    Err(format!("{file}: {browser} did not write the file: {ended}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The PDF has one page of the size of the picture and contains text; the PNG has twice as many pixels.
    #[test]
    fn picture_is_printed() {
        let Some(browser) = browser() else {
            assert!(std::env::var_os("ACTIN_REQUIRE_BROWSER").is_none());
            eprintln!("SKIPPED: no Chromium on the path");
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
        // Chromium rounds page sizes up by less than a point.
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
