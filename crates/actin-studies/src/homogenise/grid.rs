//! Energy, loads and tangent of the mean filament on a grid of strains.
//!
//! Each slice, with one twist and one extension, is a file. A file with the same parameters and axes is reused.

use super::axes::Axes;
use super::rows::{self, Row};
use actin_paper::cells::{self, relax, shortening, strain, twisted};
use actin_sim::ellipsoid::{Cell, CellResponse, Control, EllipsoidParameters};
use rayon::prelude::*;
use std::path::Path;

/// Changed when results for the same parameters change.
const VERSION: u32 = 3;

/// Relative difference of the energies of two distinct minima at the same strains.
const SAME: f64 = 1e-7;

pub(super) fn compute(out: &Path, axes: &Axes) -> Result<Vec<Row>, String> {
    let folder = out.join("grid");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let cell = cells::mean()?;
    let parameters = EllipsoidParameters::default();
    let places = (0..axes.twist.len()).flat_map(|i| (0..axes.extension.len()).map(move |j| (i, j)));
    let places: Vec<(usize, usize)> = places.collect();
    let slices = places.par_iter().map(|&(i, j)| {
        let (twist, extension) = (axes.twist[i], axes.extension[j]);
        let key = format!("version {VERSION}, {parameters:?}, {axes:?}, {twist}, {extension}");
        let path = folder.join(format!("slice-{i:02}-{j:02}.csv"));
        rows::cached(&path, &key, Some(axes.points()), || {
            let (rows, branches) = slice(&cell, axes, twist, extension)?;
            println!(
                "twist {twist} /nm, extension {extension}: {} points, {branches} with two minima",
                rows.len(),
            );
            Ok(rows)
        })
    });
    let all = slices.collect::<Result<Vec<_>, String>>()?.concat();
    rows::write(&out.join("grid.csv"), "all slices", &all)?;
    let stable = all.iter().filter(|row| row.least_stiffness() > 0.0).count();
    println!("grid: {} points, tangent positive at {stable}", all.len());
    Ok(all)
}

fn slice(
    cell: &Cell,
    axes: &Axes,
    twist: f64,
    extension: f64,
) -> Result<(Vec<Row>, usize), String> {
    let natural = twisted(cell, twist)?;
    let longest = natural.strain[5] + extension;
    let (mut rows, mut branches) = (Vec::new(), 0);
    for &angle in &axes.angle_deg {
        let mut lower: Vec<CellResponse> = Vec::new();
        for &shear in &axes.shear {
            let mut line: Vec<CellResponse> = Vec::new();
            for (k, &curvature) in axes.curvature.iter().enumerate() {
                let stretch = longest - shortening(curvature, shear);
                let point = [curvature, twist, shear, stretch, angle];
                let starts = [line.last(), lower.get(k)];
                let starts: Vec<&CellResponse> = starts.into_iter().flatten().collect();
                let starts = if starts.is_empty() {
                    vec![&natural]
                } else {
                    starts
                };
                let (response, differ) = least(cell, point, &starts)?;
                let is_first = angle.total_cmp(&axes.angle_deg[0]).is_eq();
                if is_first || (shear > 0.0 && curvature > 0.0) {
                    rows.push(Row::new(point, extension, &response));
                    branches += usize::from(differ);
                }
                line.push(response);
            }
            lower = line;
        }
    }
    Ok((rows, branches))
}

fn least(
    cell: &Cell,
    [curvature, twist, shear, stretch, angle]: [f64; 5],
    starts: &[&CellResponse],
) -> Result<(CellResponse, bool), String> {
    let strain = strain([curvature, twist, shear, stretch, angle.to_radians()]);
    let controls = std::array::from_fn(|k| Control::Strain(strain[k]));
    let found = starts
        .iter()
        .map(|start| relax(cell, controls, Some(start)));
    let found: Vec<CellResponse> = found.collect::<Result<_, _>>()?;
    let most = found.iter().map(|r| r.energy).fold(0.0, f64::max);
    let least = found
        .into_iter()
        .min_by(|a, b| a.energy.total_cmp(&b.energy));
    let least = least.ok_or("a point without a start")?;
    let differ = most > (1.0 + SAME) * least.energy + 1e-12;
    Ok((least, differ))
}
