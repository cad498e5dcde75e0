//! What is asked of each scene, and which settings it is resolved with.

use actin_sim::advice::{FilamentSetting, scenes};
use actin_sim::{JunctionWeight, RodLaw, Scene};

/// What is varied; each has a colour of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Factor {
    /// Every monomer resolved.
    Reference,
    /// How much is resolved, law Homogenised.
    ShareHomogenised,
    /// How much is resolved, law Fitted.
    ShareFitted,
    /// How much is resolved, law Constant.
    ShareConstant,
    /// Where the resolved part lies.
    Place,
    /// Length of segments.
    Segment,
    /// Bonds per interface.
    Bonds,
    /// The rod's law.
    Law,
    /// Weight of the junction's bonds, and their number.
    Junction,
    /// Several at once.
    Combination,
}

impl Factor {
    /// All, in the order of legends.
    pub(super) const ALL: [Self; 10] = [
        Self::Reference,
        Self::ShareHomogenised,
        Self::ShareFitted,
        Self::ShareConstant,
        Self::Place,
        Self::Segment,
        Self::Bonds,
        Self::Law,
        Self::Junction,
        Self::Combination,
    ];

    /// Name in tables and legends.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::ShareHomogenised => "share, Homogenised",
            Self::ShareFitted => "share, Fitted",
            Self::ShareConstant => "share, Constant",
            Self::Place => "place",
            Self::Segment => "segment length",
            Self::Bonds => "bonds",
            Self::Law => "law",
            Self::Junction => "junction",
            Self::Combination => "combination",
        }
    }
}

/// What is compared as displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Displacement {
    /// The tip's, as a vector.
    Tip,
    /// That of the far end along the axis.
    Axial,
    /// The largest distance between centre lines at equal arc length.
    CentreLine,
    /// The largest distance from the axis.
    Height,
}

/// What is compared as force and torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reaction {
    /// Torque of the wall at the start, as a vector; the force is that of the load.
    WallTorque,
    /// Force and couple about the axis at the end.
    EndAxial,
    /// The couple about the axis alone, at an end that slides.
    EndCouple,
    /// Forces of all linkers, and their moments about the centre line.
    Linkers,
    /// Forces of all linkers; their moments are noise where they lie in one plane.
    LinkerForces,
}

/// Which local field is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Field {
    Curvature,
    Twist,
}

/// A scene, what is compared, and how it is resolved.
#[derive(Clone, Debug)]
pub(super) struct Study {
    pub name: &'static str,
    /// Every monomer resolved.
    pub scene: Scene,
    pub displacement: Displacement,
    pub reaction: Reaction,
    pub field: Field,
    /// Where the field is compared (nm).
    pub window: [f64; 2],
    /// Whether filaments are compared at several azimuths of the lattice, as filaments on a wall have them.
    pub turned: bool,
    /// Turns from which equilibria of a free filament are sought (deg): the lowest counts.
    pub starts_deg: &'static [f64],
    /// The first is the reference.
    pub settings: Vec<Varied>,
    /// Azimuths of the lattice.
    pub azimuths: u64,
    /// Samplings of drawn bonds, for the scatter.
    pub samplings: u64,
}

/// A setting, its name, and what is varied in it.
pub(super) type Varied = (Factor, String, FilamentSetting);

/// Stretches of monomers, with a name.
type Stretch = (&'static str, Vec<[f64; 2]>);

/// How one scene is asked about.
struct Question {
    name: &'static str,
    displacement: Displacement,
    reaction: Reaction,
    field: Field,
    window: [f64; 2],
    /// Around the site, from little to much.
    shares: Vec<Stretch>,
    /// Which of them is the default.
    default: usize,
    /// As much as the default, elsewhere.
    places: Vec<Stretch>,
    free: bool,
}

/// Weighted bonds per interface that are tried; 12 is the default.
const BONDS: [usize; 3] = [8, 16, 24];
/// Lengths of segments that are tried (nm); 10 is the default.
const SEGMENTS_NM: [f64; 3] = [20.0, 5.0, 2.5];
/// The same of rods without monomers.
const ROD_SEGMENTS_NM: [f64; 3] = [5.0, 20.0, 40.0];

/// The studies named, or all; fewer settings, azimuths and samplings if `quick`.
pub(super) fn studies(names: &[String], quick: bool) -> Vec<Study> {
    let wanted = |name: &str| names.is_empty() || names.iter().any(|n| n == name);
    let scenes = scenes::all().into_iter();
    let chosen = scenes.filter(|(name, _)| wanted(name));
    chosen
        .map(|(name, scene)| question(name, length(&scene)).study(scene, quick))
        .collect()
}

/// Names of all studies.
pub(super) fn names() -> Vec<&'static str> {
    scenes::all().into_iter().map(|(name, _)| name).collect()
}

fn length(scene: &Scene) -> f64 {
    scene
        .filament
        .sections
        .last()
        .map_or(0.0, |s| s.span_nm().1)
}

fn question(name: &'static str, length: f64) -> Question {
    match name {
        "cantilever-160" => cantilever(name, length, &[20, 40, 60, 80, 120, 140], 3),
        "cantilever-1600" => cantilever(name, length, &[20, 40, 80, 160, 400, 800], 2),
        "linkers-planar" => Question {
            window: [10.0, 40.0],
            shares: vec![
                ("none", vec![]),
                ("one-end-40", vec![[0.0, 40.0]]),
                ("ends-20", ends(20.0, length)),
                ("ends-40", ends(40.0, length)),
                ("ends-65", ends(65.0, length)),
            ],
            default: 3,
            places: vec![
                ("middle-80", vec![[40.0, 120.0]]),
                ("far-end-80", vec![[length - 80.0, length]]),
            ],
            ..linked(name, Reaction::LinkerForces)
        },
        "linkers-round" => Question {
            window: [60.0, 90.0],
            shares: vec![
                ("none", vec![]),
                ("site-40", vec![[55.0, 95.0]]),
                ("ends-40", ends(40.0, length)),
                ("ends-60", ends(60.0, length)),
                ("ends-90", ends(90.0, length)),
            ],
            default: 4,
            places: vec![
                ("middle-180", vec![[15.0, 195.0]]),
                ("far-end-180", vec![[length - 180.0, length]]),
            ],
            ..linked(name, Reaction::Linkers)
        },
        "twist" => twist(name, length),
        "mid-linker" => mid_linker(name, length),
        _ => buckling(name, length),
    }
}

/// Both ends of a filament.
fn ends(each: f64, length: f64) -> Vec<[f64; 2]> {
    vec![[0.0, each], [length - each, length]]
}

/// The middle of a filament.
fn middle(share: f64, length: f64) -> Vec<[f64; 2]> {
    vec![[0.5 * (length - share), 0.5 * (length + share)]]
}

/// A name that lives as long as the program: there are a few of them.
fn named(name: String) -> &'static str {
    Box::leak(name.into_boxed_str())
}

fn cantilever(name: &'static str, length: f64, walls: &[u32], default: usize) -> Question {
    let wall = |&nm: &u32| (named(format!("wall-{nm}")), vec![[0.0, f64::from(nm)]]);
    let mut shares = vec![("none", vec![])];
    shares.extend(walls.iter().map(wall));
    let as_much = f64::from(walls[default - 1]);
    Question {
        name,
        displacement: Displacement::Tip,
        reaction: Reaction::WallTorque,
        field: Field::Curvature,
        window: [0.0, 20.0],
        shares,
        default,
        places: vec![
            (named(format!("middle-{as_much}")), middle(as_much, length)),
            (
                named(format!("tip-{as_much}")),
                vec![[length - as_much, length]],
            ),
        ],
        free: false,
    }
}

fn linked(name: &'static str, reaction: Reaction) -> Question {
    Question {
        name,
        displacement: Displacement::CentreLine,
        reaction,
        field: Field::Curvature,
        window: [0.0, 0.0],
        shares: Vec::new(),
        default: 0,
        places: Vec::new(),
        free: true,
    }
}

fn twist(name: &'static str, length: f64) -> Question {
    Question {
        name,
        displacement: Displacement::Axial,
        reaction: Reaction::EndCouple,
        field: Field::Twist,
        window: [0.5 * length - 10.0, 0.5 * length + 10.0],
        shares: vec![
            ("none", vec![]),
            ("middle-20", middle(20.0, length)),
            ("middle-37", middle(37.0, length)),
            ("middle-55", middle(55.0, length)),
        ],
        default: 2,
        places: vec![
            ("start-37", vec![[0.0, 37.0]]),
            ("ends-18", ends(18.5, length)),
        ],
        free: false,
    }
}

fn mid_linker(name: &'static str, length: f64) -> Question {
    Question {
        name,
        displacement: Displacement::CentreLine,
        reaction: Reaction::Linkers,
        field: Field::Twist,
        window: [0.5 * length - 15.0, 0.5 * length + 15.0],
        shares: vec![
            ("none", vec![]),
            ("middle-20", middle(20.0, length)),
            ("middle-40", middle(40.0, length)),
            ("middle-88", middle(88.0, length)),
            ("middle-140", middle(140.0, length)),
        ],
        default: 3,
        places: vec![
            ("start-88", vec![[0.0, 75.0]]),
            ("ends-44", ends(44.0, length)),
        ],
        free: false,
    }
}

fn buckling(name: &'static str, length: f64) -> Question {
    Question {
        name,
        displacement: Displacement::Height,
        reaction: Reaction::EndAxial,
        field: Field::Curvature,
        window: [0.5 * length - 20.0, 0.5 * length + 20.0],
        shares: vec![
            ("none", vec![]),
            ("middle-40", middle(40.0, length)),
            ("middle-80", middle(80.0, length)),
            ("middle-160", middle(160.0, length)),
            ("middle-240", middle(240.0, length)),
        ],
        default: 3,
        places: vec![("ends-80", ends(80.0, length))],
        free: false,
    }
}

impl Question {
    fn study(&self, scene: Scene, quick: bool) -> Study {
        let turned = self.displacement == Displacement::Tip;
        Study {
            name: self.name,
            displacement: self.displacement,
            reaction: self.reaction,
            field: self.field,
            window: self.window,
            turned,
            starts_deg: if self.free {
                &[0.0, 90.0, 180.0, 270.0]
            } else {
                &[0.0]
            },
            settings: self.settings(length(&scene), quick),
            scene,
            azimuths: match (turned, quick) {
                (false, _) => 1,
                (true, true) => 2,
                (true, false) => 6,
            },
            samplings: if quick { 2 } else { 6 },
        }
    }

    /// The reference, shares under three laws, then one change of the default at a time.
    fn settings(&self, length: f64, quick: bool) -> Vec<Varied> {
        let whole = FilamentSetting::of(vec![[0.0, length]], RodLaw::Constant);
        let mut all = vec![(Factor::Reference, "all monomers".into(), whole.clone())];
        for (law, factor) in [
            (RodLaw::Homogenised, Factor::ShareHomogenised),
            (RodLaw::Fitted, Factor::ShareFitted),
            (RodLaw::Constant, Factor::ShareConstant),
        ] {
            let shares = self.shares.iter().enumerate();
            let kept = shares.filter(|(i, _)| !quick || i % 2 == 0 || *i == self.default);
            all.extend(kept.map(|(_, (name, monomers))| {
                let name = format!("{name}/{law:?}");
                (
                    factor,
                    name,
                    FilamentSetting::of(monomers.clone(), law.clone()),
                )
            }));
        }
        if !quick {
            all.extend(self.single_changes());
            all.extend(self.combinations(&whole));
        }
        all
    }

    /// The default with one thing changed, and as much resolved elsewhere.
    fn single_changes(&self) -> Vec<Varied> {
        let (name, monomers) = &self.shares[self.default];
        let default = || FilamentSetting::of(monomers.clone(), RodLaw::Homogenised);
        let mut changes: Vec<Varied> = Vec::new();
        for segment_nm in SEGMENTS_NM {
            let (mut to, what) = (default(), format!("segments-{segment_nm}"));
            to.segment_nm = segment_nm;
            changes.push((Factor::Segment, what, to));
        }
        changes.extend(fewer_bonds(&default()));
        let (mut published, what) = (default(), "PublishedExtension".to_owned());
        published.law = RodLaw::PublishedExtension;
        changes.push((Factor::Law, what, published));
        let mut full = default();
        full.weight = JunctionWeight::Full;
        changes.push((Factor::Junction, "Full".into(), full));
        let mut one = default();
        one.attached = 1;
        changes.push((Factor::Junction, "one-attached".into(), one));
        let mut all = named_after(name, changes);
        all.extend(self.places.iter().map(|(name, monomers)| {
            let setting = FilamentSetting::of(monomers.clone(), RodLaw::Homogenised);
            (Factor::Place, format!("{name}/Homogenised"), setting)
        }));
        all
    }

    /// Several changes at once, pure rods, and fewer bonds where all is resolved.
    fn combinations(&self, whole: &FilamentSetting) -> Vec<Varied> {
        let (name, monomers) = &self.shares[self.default - 1];
        let less = || FilamentSetting::of(monomers.clone(), RodLaw::Homogenised);
        let (mut cheap, mut coarse) = (less(), less());
        (cheap.segment_nm, cheap.bonds) = (5.0, 8);
        (coarse.segment_nm, coarse.attached) = (20.0, 1);
        let combined = Factor::Combination;
        let mut rigid_ends = less();
        (rigid_ends.segment_nm, rigid_ends.rigid_segments) = (20.0, true);
        let mixed = vec![
            (combined, "segments-5+bonds-8".into(), cheap),
            (combined, "segments-20+one-attached".into(), coarse),
            (combined, "segments-20+RigidSegment".into(), rigid_ends),
        ];
        let rods = ROD_SEGMENTS_NM.map(|segment_nm| {
            let mut rod = FilamentSetting::of(Vec::new(), RodLaw::Homogenised);
            rod.segment_nm = segment_nm;
            let what = format!("Homogenised+segments-{segment_nm}");
            (combined, what, rod)
        });
        let rigid = |(factor, what, setting): &Varied| {
            let rigid_segments = true;
            let setting = FilamentSetting {
                rigid_segments,
                ..setting.clone()
            };
            (*factor, format!("{what}+RigidSegment"), setting)
        };
        let rods: Vec<Varied> = rods.iter().cloned().chain(rods.iter().map(rigid)).collect();
        let mut all = named_after(name, mixed);
        all.extend(named_after("none", rods));
        all.extend(named_after("all monomers", fewer_bonds(whole)));
        all
    }
}

/// A setting with other numbers of weighted bonds.
fn fewer_bonds(setting: &FilamentSetting) -> Vec<Varied> {
    let with = |bonds| FilamentSetting {
        bonds,
        ..setting.clone()
    };
    let each = BONDS.map(|bonds| (Factor::Bonds, format!("bonds-{bonds}"), with(bonds)));
    each.into()
}

/// Changes under the name of what they change.
fn named_after(name: &str, changes: Vec<Varied>) -> Vec<Varied> {
    let named = |(factor, what, setting)| (factor, format!("{name}/{what}"), setting);
    changes.into_iter().map(named).collect()
}
