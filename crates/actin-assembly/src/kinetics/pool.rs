//! Linkers that bind to any site of any filament.

use super::{HandEvent, LinkerEventKind, Switching};
use crate::whole::{to_count, to_index};
use actin_mechanics::{Interaction, State, Vector3};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Separates the random choice of sites from other uses of the seed.
const PURPOSE: [u8; 8] = *b"sites\0\0\0";

/// Occupied sites of the roaming linkers during the events of a step, and a search for sites.
pub(super) struct Pool {
    /// Table, identified by its address, and site.
    occupied: HashSet<(usize, usize)>,
    /// By table and search distance.
    grids: HashMap<(usize, u64), Grid>,
}

/// Sites by cubic cells.
struct Grid {
    cell: f64,
    cells: HashMap<[i64; 3], Vec<usize>>,
    positions: Vec<Vector3>,
    /// Smallest and largest coordinates of all sites.
    bounds: [Vector3; 2],
}

fn table_of(switching: &Switching) -> usize {
    Arc::as_ptr(&switching.table.sites).cast::<()>() as usize
}

impl Pool {
    pub(super) fn new(all: &[Switching], state: &State) -> Self {
        let roaming = all.iter().filter(|one| one.rates.roams.is_some());
        let occupied = roaming.flat_map(|one| {
            let hands = one.linker.hands().filter(|hand| hand.is_bound(state));
            hands.map(|hand| (table_of(one), hand.site(state)))
        });
        Self {
            occupied: occupied.collect(),
            grids: HashMap::new(),
        }
    }

    pub(super) fn is_occupied(&self, switching: &Switching, site: usize) -> bool {
        self.occupied.contains(&(table_of(switching), site))
    }

    /// Updates the occupied sites. The hand of a step leaves the preceding site.
    pub(super) fn apply(&mut self, switching: &Switching, event: &HandEvent) {
        if switching.rates.roams.is_none() {
            return;
        }
        let table = table_of(switching);
        match event.what {
            LinkerEventKind::Broke | LinkerEventKind::Left | LinkerEventKind::Detached => {
                self.occupied.remove(&(table, event.site));
            }
            LinkerEventKind::Formed | LinkerEventKind::Attached => {
                self.occupied.insert((table, event.site));
            }
            LinkerEventKind::Stepped => {
                self.occupied.remove(&(table, event.site - 1));
                self.occupied.insert((table, event.site));
            }
        }
    }

    /// Sites of a table within a distance (nm) of a position, ascending.
    fn near(
        &mut self,
        switching: &Switching,
        state: &State,
        (at, within): (Vector3, f64),
    ) -> Vec<usize> {
        let cell = switching.linker.image().map(|image| image.cell);
        let key = (table_of(switching), within.to_bits());
        let grid = self.grids.entry(key).or_insert_with(|| {
            let sites = switching
                .table
                .sites
                .iter()
                .map(|site| site.position(state));
            let wrap = |place| cell.map_or(place, |cell| cell.wrap(place, state));
            Grid::new(sites.map(wrap).collect(), within)
        });
        let Some(cell) = cell else {
            return grid.near(at);
        };
        let home = cell.wrap(at, state);
        let images = (0..27).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]);
        let near = images.flat_map(|index| grid.near(home + cell.displacement(index, state)));
        let mut found: Vec<usize> = near.collect();
        found.sort_unstable();
        found
    }
}

impl Grid {
    fn new(positions: Vec<Vector3>, cell: f64) -> Self {
        let infinite = Vector3::repeat(f64::INFINITY);
        let bounds = positions
            .iter()
            .fold([infinite, -infinite], |[low, high], x| {
                [low.inf(x), high.sup(x)]
            });
        let mut grid = Self {
            cell,
            bounds,
            cells: HashMap::new(),
            positions,
        };
        for (i, position) in grid.positions.iter().enumerate() {
            grid.cells
                .entry(cell_of(position, cell))
                .or_default()
                .push(i);
        }
        grid
    }

    /// Sites within the edge of a cell.
    fn near(&self, at: Vector3) -> Vec<usize> {
        let [low, high] = self.bounds;
        if (0..3).any(|k| at[k] < low[k] - self.cell || at[k] > high[k] + self.cell) {
            return Vec::new();
        }
        let centre = cell_of(&at, self.cell);
        let around = -1..=1;
        let mut found = Vec::new();
        for x in around.clone() {
            for y in around.clone() {
                for z in around.clone() {
                    let cell = [centre[0] + x, centre[1] + y, centre[2] + z];
                    let own = self.cells.get(&cell).into_iter().flatten();
                    found.extend(own.filter(|&&i| (self.positions[i] - at).norm() <= self.cell));
                }
            }
        }
        found.sort_unstable();
        found
    }
}

fn cell_of(position: &Vector3, cell: f64) -> [i64; 3] {
    position.map(|x| to_index((x / cell).floor())).into()
}

impl Switching {
    /// Events of a roaming linker with their rates (1/ns).
    pub(super) fn choices_of_pool(
        &self,
        state: &State,
        step: u64,
        pool: &mut Pool,
        thermal_energy: f64,
    ) -> Vec<(Option<HandEvent>, f64)> {
        let bound: Vec<usize> = (0..2)
            .filter(|&hand| self.hand(hand).is_bound(state))
            .collect();
        match bound[..] {
            [] => self.attaching(step, pool).into_iter().collect(),
            [hand] => {
                let mut choices = self.choices_of_hand(hand, state, pool);
                choices.extend(self.binding(hand, state, pool, thermal_energy));
                choices
            }
            _ => {
                let hands = bound.into_iter();
                hands
                    .flat_map(|hand| self.choices_of_hand(hand, state, pool))
                    .collect()
            }
        }
    }

    /// Attachment of one hand to a random site. Attempts at occupied sites fail.
    fn attaching(&self, step: u64, pool: &Pool) -> Option<(Option<HandEvent>, f64)> {
        let roams = self.rates.roams?;
        let [place, side] = self.uniform(PURPOSE, step);
        let sites = self.table.sites.len();
        let site = to_count(place * sites as f64).min(sites - 1);
        let event = (!pool.is_occupied(self, site)).then_some(HandEvent {
            what: LinkerEventKind::Attached,
            hand: usize::from(side >= 0.5),
            site,
        });
        Some((event, roams.attach_per_ns))
    }

    /// Binding of the free hand to sites of other filaments within reach.
    fn binding(
        &self,
        bound: usize,
        state: &State,
        pool: &mut Pool,
        thermal_energy: f64,
    ) -> Vec<(Option<HandEvent>, f64)> {
        let (Some(forms), Some(breaks)) = (self.rates.forms, self.rates.breaks) else {
            return Vec::new();
        };
        let (hand, site) = (1 - bound, self.hand(bound).site(state));
        let at = self.table.sites[site].position(state);
        let rest_length = self.linker.linker(state).spring().rest_length;
        let near = pool.near(self, state, (at, rest_length + forms.reach_nm));
        let filament = self.table.places[site].0;
        let is_free = |other: &usize| {
            self.table.places[*other].0 != filament && !pool.is_occupied(self, *other)
        };
        let mut choices = Vec::new();
        for other in near.into_iter().filter(is_free) {
            let mut sites = [site; 2];
            sites[hand] = other;
            let linker = self.linker.linker_at(&sites);
            let extension = linker.extension(state);
            if extension.abs() > forms.reach_nm {
                continue;
            }
            // The averaged force of a linker that forms is zero. The present force is a fluctuation.
            let factor = if self.average.is_instantaneous() {
                let tension = (linker.spring().stiffness * extension).max(0.0);
                breaks.rate(tension) / breaks.rate(0.0)
            } else {
                1.0
            };
            let rate = forms.rate_per_ns * (-linker.energy(state) / thermal_energy).exp() * factor;
            if rate.is_nan() {
                continue;
            }
            let event = HandEvent {
                what: LinkerEventKind::Formed,
                hand,
                site: other,
            };
            choices.push((Some(event), rate));
        }
        choices
    }
}
