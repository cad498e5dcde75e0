//! Random linkers between neighbouring filaments.

use super::periodic::neighbours;
use super::{Filament, Kinetics, Linker, LinkerSite, PeriodicBox, SceneProblem};
use actin_mechanics::{UnitQuaternion, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// Half the pitch of the long-pitch helix.
pub(super) const SITE_SPACING_NM: f64 = 36.0;

pub(super) const MOST_SITES: f64 = 1e7;

/// Linkers between random pairs of sites of different filaments. Sites lie on the axes at equal distances; each site
/// has at most one linker. The linkers follow the listed linkers.
///
/// The resolved scene lists each linker.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(crate) struct LinkersBetween {
    /// Number of linkers divided by the number of filaments; positive.
    pub per_filament: f64,
    /// Largest distance between two linked sites as built; positive.
    pub reach_nm: f64,
    /// Smallest distance between two linked sites as built; at least 0.
    #[serde(default)]
    pub least_reach_nm: f64,
    /// Distance between neighbouring sites of a filament; positive. The first site is half this distance from the
    /// start.
    #[serde(default = "site_spacing")]
    pub site_spacing_nm: f64,
    /// Distance of sites from the axis; at least 0. With a distance, each site has the azimuth of the nearest monomer:
    /// sites follow the helix.
    #[serde(default)]
    pub radius_nm: f64,
    /// Stiffness; positive.
    pub stiffness_pn_per_nm: f64,
    /// Rest length; at least 0. By default the distance between the two sites as built: linkers are initially free of
    /// force.
    #[serde(default)]
    pub rest_length_nm: Option<f64>,
    /// Stiffness of each linker against tilt, see `Linker`; at least 0.
    #[serde(default)]
    pub tilt_pn_nm: f64,
    /// Stiffness of each linker against twist, see `Linker`; at least 0.
    #[serde(default)]
    pub twist_pn_nm: f64,
    /// Rates of breaking, forming and stepping; by default linkers are permanent.
    #[serde(default)]
    pub kinetics: Option<Kinetics>,
    /// Seed of the choice of pairs.
    pub seed: u64,
}

fn site_spacing() -> f64 {
    SITE_SPACING_NM
}

#[derive(Clone, Copy)]
struct Site {
    site: LinkerSite,
    place: Vector3,
}

/// Sites of a linker.
#[derive(Clone, Copy)]
struct Pair {
    sites: [usize; 2],
    /// Periodic image of the second site.
    image: [i32; 3],
    distance: f64,
}

impl LinkersBetween {
    /// Returns the linkers of set `k` of a scene with these filaments.
    ///
    /// # Errors
    /// If a number breaks its rule, or if there are fewer pairs of sites within reach than linkers.
    pub(super) fn linkers(
        &self,
        k: usize,
        filaments: &[Filament],
        periodic: Option<&PeriodicBox>,
    ) -> Result<Vec<Linker>, SceneProblem> {
        self.check(k, filaments, periodic)?;
        let sites = self.sites(filaments);
        let mut pairs = self.pairs(&sites, periodic);
        let reachable = pairs.len();
        let chosen = self.choose(&mut pairs, (sites.len(), filaments.len()));
        chosen.map_err(|(found, wanted)| {
            let rule = format!(
                "{wanted} linkers are required, but only {found} pairs of unoccupied sites were found among {reachable} \
                 pairs of sites within reach: increase reach_nm or reduce site_spacing_nm"
            );
            let key = format!("linker_sets[{k}].per_filament");
            SceneProblem::new(key, self.per_filament, rule)
        })?;
        Ok(pairs
            .iter()
            .map(|pair| self.linker(&sites, *pair))
            .collect())
    }

    fn check(
        &self,
        k: usize,
        filaments: &[Filament],
        periodic: Option<&PeriodicBox>,
    ) -> Result<(), SceneProblem> {
        let key = |name: &str| format!("linker_sets[{k}].{name}");
        check_reach(&key("reach_nm"), self.reach_nm, periodic)?;
        let length: f64 = filaments.iter().map(Filament::length_nm).sum();
        let sites = length / self.site_spacing_nm;
        if sites.is_finite() && sites <= MOST_SITES {
            return Ok(());
        }
        let rule = format!("makes {sites:.0} sites, more than {MOST_SITES:.0}");
        let key = key("site_spacing_nm");
        Err(SceneProblem::new(key, self.site_spacing_nm, rule))
    }

    fn sites(&self, filaments: &[Filament]) -> Vec<Site> {
        let of_filament = |(filament, one): (usize, &Filament)| {
            let places = one.sites_nm(self.site_spacing_nm);
            let axes = one.axes_at(&places);
            let site = |(at_nm, (place, turn)): (f64, (Vector3, UnitQuaternion))| {
                let radius_nm = self.radius_nm;
                let azimuth_deg = one.azimuth_at_radius_deg(at_nm, radius_nm);
                let (sine, cosine) = azimuth_deg.to_radians().sin_cos();
                let site = LinkerSite {
                    filament,
                    at_nm,
                    radius_nm,
                    azimuth_deg,
                };
                let arm = Vector3::new(cosine, sine, 0.0) * radius_nm;
                let place = place + turn * arm;
                Site { site, place }
            };
            places.into_iter().zip(axes).map(site).collect::<Vec<_>>()
        };
        filaments.iter().enumerate().flat_map(of_filament).collect()
    }

    /// Finds pairs within reach with a grid of cubic cells. A site has images in a periodic box.
    fn pairs(&self, sites: &[Site], periodic: Option<&PeriodicBox>) -> Vec<Pair> {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "saturates far outside of any filament"
        )]
        let cell = |place: &Vector3| place.map(|x| (x / self.reach_nm).floor() as i64);
        let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
        let mut pairs = Vec::new();
        let wrap = |site: &Site| periodic.map_or(([0; 3], site.place), |one| one.wrap(site.place));
        let wrapped: Vec<_> = sites.iter().map(wrap).collect();
        for (i, site) in sites.iter().enumerate() {
            let (home, place) = wrapped[i];
            let images = periodic.map_or_else(
                || vec![([0; 3], place)],
                |one| one.images_within(place, self.reach_nm),
            );
            for (shift, place) in images {
                let centre = cell(&place);
                let around = neighbours()
                    .map(|step| centre.zip_map(&step.into(), |c, s: i32| c + i64::from(s)));
                let near = around
                    .iter()
                    .filter_map(|cell| cells.get(&<[i64; 3]>::from(*cell)));
                for &j in near.flatten() {
                    let distance = (place - wrapped[j].1).norm();
                    let is_near = distance <= self.reach_nm && distance >= self.least_reach_nm;
                    if is_near && sites[j].site.filament != site.site.filament {
                        let image = |k| shift[k] - home[k] + wrapped[j].0[k];
                        pairs.push(Pair {
                            sites: [j, i],
                            image: std::array::from_fn(image),
                            distance,
                        });
                    }
                }
            }
            cells.entry(cell(&place).into()).or_default().push(i);
        }
        pairs
    }

    /// Number of linkers of a scene with a number of filaments.
    pub(super) fn count(&self, filaments: usize) -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a positive number; more than the number of pairs is refused"
        )]
        let count = (self.per_filament * filaments as f64).round().max(1.0) as usize;
        count
    }

    /// Reduces `pairs` to a random subset without common sites. On failure returns the numbers found and
    /// required.
    fn choose(
        &self,
        pairs: &mut Vec<Pair>,
        (sites, filaments): (usize, usize),
    ) -> Result<(), (usize, usize)> {
        let wanted = self.count(filaments);
        let mut random = ChaCha8Rng::seed_from_u64(self.seed);
        let mut is_free = vec![true; sites];
        let mut chosen = 0;
        let mut next = 0;
        while chosen < wanted && next < pairs.len() {
            let drawn = random.random_range(next..pairs.len());
            pairs.swap(next, drawn);
            let [i, j] = pairs[next].sites;
            if is_free[i] && is_free[j] {
                (is_free[i], is_free[j]) = (false, false);
                pairs.swap(chosen, next);
                chosen += 1;
            }
            next += 1;
        }
        pairs.truncate(chosen);
        pairs.sort_by_key(|pair| (pair.sites, pair.image));
        if chosen < wanted {
            return Err((chosen, wanted));
        }
        Ok(())
    }

    fn linker(&self, sites: &[Site], pair: Pair) -> Linker {
        let [site, other] = pair.sites.map(|i| sites[i].site);
        Linker {
            to: Some(other),
            image: pair.image,
            rest_length_nm: self.rest_length_nm.unwrap_or(pair.distance),
            tilt_pn_nm: self.tilt_pn_nm,
            twist_pn_nm: self.twist_pn_nm,
            kinetics: self.kinetics,
            ..Linker::new(site, self.stiffness_pn_per_nm)
        }
    }
}

fn check_reach(key: &str, reach: f64, periodic: Option<&PeriodicBox>) -> Result<(), SceneProblem> {
    let edges = periodic.iter().flat_map(|one| one.size_nm);
    let shortest = edges.fold(f64::INFINITY, f64::min);
    if reach <= shortest {
        return Ok(());
    }
    let rule = format!("must be at most the shortest edge of the periodic box, {shortest:?}");
    Err(SceneProblem::new(key, reach, rule))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Factor, Scene};
    use actin_mechanics::segments;
    use std::collections::HashSet;

    const NETWORK: &str = "Scene(
        arrangements: [Random(
            filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 1000.0)]),
            count: 40, box_nm: (1500.0, 1500.0, 1500.0), seed: 3,
        )],
        linker_sets: [LinkersBetween(
            per_filament: 2.5, reach_nm: 100.0, least_reach_nm: 5.0, stiffness_pn_per_nm: 0.2, seed: 4,
        )],
        task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
    )";

    fn site_of(scene: &Scene, site: LinkerSite) -> Vector3 {
        let filament = scene.filament_at(site.filament).expect("it exists");
        filament.place_at(site.at_nm)
    }

    #[test]
    fn linkers_of_a_random_network_are_within_reach() {
        let scene = Scene::from_ron(NETWORK).expect("the scene is valid");
        assert_eq!(
            (scene.number_of_filaments(), scene.linkers.len()),
            (40, 100)
        );
        let mut sites = HashSet::new();
        for linker in &scene.linkers {
            let to = linker.to.expect("it joins two sites");
            assert_ne!(linker.filament, to.filament);
            let distance = (site_of(&scene, linker.site()) - site_of(&scene, to)).norm();
            assert!((5.0..=100.0).contains(&distance));
            assert!((distance - linker.rest_length_nm).abs() < 1e-9);
            for site in [linker.site(), to] {
                assert!(sites.insert((site.filament, site.at_nm.to_bits())));
            }
        }
        let again = Scene::from_ron(&scene.to_ron()).expect("the resolved scene is valid");
        assert_eq!(again, scene);
    }

    #[test]
    fn pairs_agree_with_a_direct_search() {
        let scene = Scene::from_ron(NETWORK).expect("the scene is valid");
        let filaments: Vec<Filament> = scene.filaments().cloned().collect();
        let set = LinkersBetween {
            per_filament: 1.0,
            reach_nm: 80.0,
            least_reach_nm: 10.0,
            site_spacing_nm: 50.0,
            stiffness_pn_per_nm: 1.0,
            rest_length_nm: None,
            radius_nm: 4.0,
            tilt_pn_nm: 0.0,
            twist_pn_nm: 0.0,
            kinetics: None,
            seed: 1,
        };
        let sites = set.sites(&filaments);
        assert_eq!(sites.len(), 40 * 20);
        let periodic = PeriodicBox {
            size_nm: [1400.0, 1500.0, 1600.0],
            strain: 0.0,
            factor: Factor::Constant,
        };
        for periodic in [None, Some(&periodic)] {
            let pairs = set.pairs(&sites, periodic).into_iter();
            let found: HashSet<_> = pairs.map(|pair| (pair.sites, pair.image)).collect();
            let direct = direct_search(&sites, periodic);
            assert!(direct.len() > 100);
            assert_eq!(found, direct);
        }
    }

    /// Pairs of sites at distances from 10 to 80 nm, with up to two images in each direction.
    fn direct_search(
        sites: &[Site],
        periodic: Option<&PeriodicBox>,
    ) -> HashSet<([usize; 2], [i32; 3])> {
        let most = if periodic.is_some() { 2 } else { 0 };
        let range = -most..=most;
        let planes = range.flat_map(|x| (-most..=most).map(move |y| (x, y)));
        let images = planes.flat_map(|(x, y)| (-most..=most).map(move |z| [x, y, z]));
        let images: Vec<[i32; 3]> = images.collect();
        let all = (0..sites.len()).flat_map(|j| (0..j).map(move |i| [i, j]));
        all.filter(|[i, j]| sites[*i].site.filament != sites[*j].site.filament)
            .flat_map(|pair| images.iter().map(move |image| (pair, *image)))
            .filter(|([i, j], image)| {
                let shift = periodic.map_or_else(Vector3::zeros, |one| one.shift(*image));
                let distance = (sites[*j].place + shift - sites[*i].place).norm();
                (10.0..=80.0).contains(&distance)
            })
            .collect()
    }

    /// Smallest distance of 60 filaments of 300 nm and their images in a box of 300 nm.
    fn closest_of(text: &str, images: std::ops::RangeInclusive<i32>) -> f64 {
        let scene = Scene::from_ron(text).expect("the scene is valid");
        let axes: Vec<[Vector3; 2]> = scene
            .filaments()
            .map(|one| [one.place_at(0.0), one.place_at(300.0)])
            .collect();
        let range = || images.clone().map(|n| 300.0 * f64::from(n));
        let shifts = range()
            .flat_map(|x| range().flat_map(move |y| range().map(move |z| Vector3::new(x, y, z))));
        let pairs =
            shifts.flat_map(|shift| (0..60).flat_map(move |j| (0..=j).map(move |i| (i, j, shift))));
        let pairs = pairs.filter(|(i, j, shift)| i != j || *shift != Vector3::zeros());
        let squares = pairs.map(|(i, j, shift)| {
            segments::nearest_points(axes[i], axes[j].map(|x| x + shift)).squared
        });
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    #[test]
    fn random_filaments_that_repel_each_other_are_apart() {
        let text = |more: &str, edge: &str| {
            format!(
                "Scene(
                    arrangements: [Random(
                        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 300.0)]),
                        count: 60, box_nm: ({edge}, {edge}, {edge}), seed: 3{more},
                    )],
                    repulsion: Repulsion(),
                    task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
                )"
            )
        };
        let closest = |more: &str| closest_of(&text(more, "300.0"), 0..=0);
        assert!(closest(", apart_nm: 0.0") < 7.4);
        assert!(closest("") >= 7.4 && closest("") < 12.0);
        assert!(closest(", apart_nm: 12.0") >= 12.0);
        let periodic = "periodic: PeriodicBox(size_nm: (300.0, 300.0, 300.0)), repulsion:";
        let periodic = text("", "300.0").replace("repulsion:", periodic);
        assert!(closest_of(&text("", "300.0"), -3..=3) < 7.4);
        assert!(closest_of(&periodic, -3..=3) >= 7.4);
        let refused = Scene::from_ron(&text(", apart_nm: 400.0", "10.0"))
            .expect_err("no room")
            .to_string();
        assert!(refused.contains("arrangements[0].apart_nm"), "{refused}");
    }

    fn scene_within(walls: &str) -> String {
        format!(
            "Scene(
                    arrangements: [Random(
                        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 300.0)]),
                        count: 30, box_nm: (200.0, 200.0, 400.0), seed: 3,
                    )],
                    repulsion: Repulsion({walls}),
                    task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
                )"
        )
    }

    /// Smallest and largest distance of ends from the z axis.
    fn from_axis(walls: &str) -> [f64; 2] {
        let scene = Scene::from_ron(&scene_within(walls)).expect("the scene is valid");
        let ends = scene
            .filaments()
            .flat_map(|one| [0.0, 300.0].map(|s| one.place_at(s)));
        let distances: Vec<f64> = ends.map(|x| x.x.hypot(x.y)).collect();
        [f64::min, f64::max].map(|of| distances.iter().copied().reduce(of).expect("filaments"))
    }

    /// Without walls, filaments of 300 nm extend beyond a cylinder of radius 100 nm.
    #[test]
    fn random_filaments_are_within_walls() {
        let cylinder = |radius: f64, side: &str| {
            format!(
                "cylinders: [(at_nm: (0.0, 0.0, 5.0), axis: (0.0, 0.0, 3.0), radius_nm: {radius:?}, side: {side})]"
            )
        };
        assert!(from_axis("")[1] > 150.0);
        let inside = from_axis(&cylinder(100.0, "Inside"))[1];
        assert!((80.0..=96.3).contains(&inside), "{inside}");
        let outside = from_axis(&cylinder(50.0, "Outside"))[0];
        assert!((53.7..80.0).contains(&outside), "{outside}");
        let refused = Scene::from_ron(&scene_within(
            "cuboids: [(at_nm: (0.0, 0.0, 0.0), size_nm: (90.0, 90.0, 90.0))]",
        ));
        let refused = refused.expect_err("no room").to_string();
        assert!(refused.contains("arrangements[0].box_nm"), "{refused}");
        let refused =
            Scene::from_ron(&scene_within(&cylinder(-1.0, "Inside"))).expect_err("radius");
        assert!(
            refused
                .to_string()
                .contains("repulsion.cylinders[0].radius_nm"),
            "{refused}"
        );
    }

    #[test]
    fn bundles_are_hexagonal() {
        let scene = Scene::from_ron(
            "Scene(
                arrangements: [
                    Bundle(
                        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 300.0)], direction: (1.0, 2.0, 2.0)),
                        count: 7, spacing_nm: 12.0, stagger_nm: 30.0, mixed_polarity: true, seed: 2,
                    ),
                    Copies(
                        filament: Filament(sections: [Rod(from_nm: 0.0, to_nm: 300.0)], at_nm: (500.0, 0.0, 0.0)),
                        count: 3, shift_nm: (0.0, 20.0, 0.0),
                    ),
                ],
                task: Brownian(duration_ms: 0.001, temperature_k: 298.0, seed: 1),
            )",
        );
        let scene = scene.expect("the scene is valid");
        let filaments: Vec<&Filament> = scene.filaments().collect();
        let axis = Vector3::new(1.0, 2.0, 2.0) / 3.0;
        let across = |i: usize, j: usize| {
            let shift = filaments[i].place_at(150.0) - filaments[j].place_at(150.0);
            let along = shift.dot(&axis);
            assert!(along.abs() <= 30.0);
            (shift - axis * along).norm()
        };
        for i in 1..7 {
            assert!((across(0, i) - 12.0).abs() < 1e-9);
            let neighbours = (1..7).filter(|j| *j != i && (across(i, *j) - 12.0).abs() < 1e-9);
            assert_eq!(neighbours.count(), 2);
        }
        let reversed = filaments[..7]
            .iter()
            .filter(|one| one.axis().dot(&axis) < 0.0);
        assert!((1..7).contains(&reversed.count()));
        let third = Vector3::from(filaments[9].at_nm);
        assert!((third - Vector3::new(500.0, 40.0, 0.0)).norm() < 1e-12);
    }
}
