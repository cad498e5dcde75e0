//! Linkers and their validation.

use super::rules::{check_on_filament, show};
use super::{Kinetics, Scene, SceneProblem, kinetics};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Hookean linker between a site of a filament and another site or a fixed anchor.
///
/// A site has an arc length, a distance from the axis and an azimuth in the filament as built, independent of the
/// model at the site. Exactly one of `to`, `anchor_nm` and `displaced_nm` defines the other end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Linker {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Arc length of the site; from 0 to the length of the filament.
    pub at_nm: f64,
    /// Distance of the site from the axis; at least 0.
    #[serde(default)]
    pub radius_nm: f64,
    /// Azimuth of the site in the filament as built; finite. 0 is lab +x for a filament along lab +z.
    #[serde(default)]
    pub azimuth_deg: f64,
    /// Site at the other end; it must differ from this one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub to: Option<LinkerSite>,
    /// Position of the anchor (lab frame); finite.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub anchor_nm: Option<[f64; 3]>,
    /// Periodic image of the second site: its position is shifted by this number of edges of the periodic box.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub image: [i32; 3],
    /// Displacement of the anchor from the site in the filament as built (lab frame); finite, and not zero if the
    /// rest length is positive.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub displaced_nm: Option<[f64; 3]>,
    /// Stiffness; positive.
    pub stiffness_pn_per_nm: f64,
    /// Rest length; at least 0.
    #[serde(default)]
    pub rest_length_nm: f64,
    /// Stiffness `k` against tilt at both ends: the energy of each end is `k (1 - cos a)` for the angle `a` between the
    /// linker and its direction as built, which follows the monomer or segment; at least 0. Requires `to`, no
    /// `steps`, and two sites apart in different monomers or segments. For linkers that roam, see `Crosslinkers`.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tilt_pn_nm: f64,
    /// Stiffness `k` against twist: the energy is `k (1 - cos b)` for the angle `b` between two directions across the linker,
    /// one in each monomer or segment, which are parallel as built; at least 0. Requires the same as `tilt_pn_nm`.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub twist_pn_nm: f64,
    /// Rates of breaking, forming and stepping; by default the linker is permanent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kinetics: Option<Kinetics>,
}

/// Site of a linker on a filament.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename = "Site")]
pub struct LinkerSite {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Arc length; from 0 to the length of the filament.
    pub at_nm: f64,
    /// Distance from the axis; at least 0.
    #[serde(default)]
    pub radius_nm: f64,
    /// Azimuth in the filament as built; finite.
    #[serde(default)]
    pub azimuth_deg: f64,
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the signature that serde requires"
)]
fn is_zero(value: &f64) -> bool {
    value.abs() <= 0.0
}

fn is_origin(image: &[i32; 3]) -> bool {
    *image == [0; 3]
}

impl Linker {
    /// Creates a linker at a site with this stiffness (pN/nm) and rest length 0, without another end.
    pub fn new(site: LinkerSite, stiffness_pn_per_nm: f64) -> Self {
        Self {
            filament: site.filament,
            at_nm: site.at_nm,
            radius_nm: site.radius_nm,
            azimuth_deg: site.azimuth_deg,
            to: None,
            anchor_nm: None,
            image: [0; 3],
            displaced_nm: None,
            stiffness_pn_per_nm,
            rest_length_nm: 0.0,
            tilt_pn_nm: 0.0,
            twist_pn_nm: 0.0,
            kinetics: None,
        }
    }

    /// Returns the site at the first end.
    pub fn site(&self) -> LinkerSite {
        LinkerSite {
            filament: self.filament,
            at_nm: self.at_nm,
            radius_nm: self.radius_nm,
            azimuth_deg: self.azimuth_deg,
        }
    }

    /// Returns the stiffness against tilt and twist (pN nm), with the keys.
    pub fn angular(&self) -> [(&'static str, f64); 2] {
        [
            ("tilt_pn_nm", self.tilt_pn_nm),
            ("twist_pn_nm", self.twist_pn_nm),
        ]
    }

    /// Returns whether both ends bind to any site of any filament.
    pub fn roams(&self) -> bool {
        self.kinetics
            .is_some_and(|kinetics| kinetics.roams.is_some())
    }

    /// Returns the key of the other end.
    pub fn end_key(&self) -> &'static str {
        match (self.to, self.anchor_nm) {
            (Some(_), _) => "to",
            (None, Some(_)) => "anchor_nm",
            (None, None) => "displaced_nm",
        }
    }

    /// Returns the anchor or displacement as written, or `None` for a linker between sites.
    pub fn anchor(&self) -> Option<[f64; 3]> {
        self.anchor_nm.or(self.displaced_nm)
    }
}

impl LinkerSite {
    /// Returns whether both sites have the same position in the same filament.
    fn is_at(&self, other: &Self) -> bool {
        let same = |a: f64, b: f64| (a - b).abs() <= 0.0;
        let same_side = (self.azimuth_deg - other.azimuth_deg).rem_euclid(360.0) <= 0.0;
        self.filament == other.filament
            && same(self.at_nm, other.at_nm)
            && same(self.radius_nm, other.radius_nm)
            && (self.radius_nm <= 0.0 || same_side)
    }
}

/// Checks linker `i`. The sections of the scene must be valid.
pub(super) fn check(scene: &Scene, i: usize, linker: &Linker) -> Result<(), SceneProblem> {
    let key = |name: &str| format!("linkers[{i}].{name}");
    check_site(scene, &format!("linkers[{i}]"), &linker.site())?;
    check_one_end(i, linker)?;
    check_angular(i, linker)?;
    if let Some(other) = &linker.to {
        check_site(scene, &key("to"), other)?;
        if other.is_at(&linker.site()) && linker.image == [0; 3] {
            let rule = "is the site of the first end: write another site";
            return Err(SceneProblem::new(key("to"), "", rule));
        }
    }
    kinetics::check(scene, i, linker)
}

fn check_angular(i: usize, linker: &Linker) -> Result<(), SceneProblem> {
    let [tilt, twist] = linker.angular();
    let refused = |(name, stiffness): (&str, f64), rule: &str| {
        let key = format!("linkers[{i}].{name}");
        Err(SceneProblem::new(key, show(stiffness), rule))
    };
    let has_steps = linker
        .kinetics
        .is_some_and(|kinetics| kinetics.steps.is_some());
    for one in [tilt, twist] {
        if one.1 > 0.0 && (linker.to.is_none() || has_steps && !linker.roams()) {
            let rule = "requires a linker between two sites (`to`) without `steps`";
            return refused(one, rule);
        }
    }
    if tilt.1 > 0.0 && linker.roams() && linker.radius_nm <= 0.0 {
        let rule = "requires a positive radius_nm: sites on the axis have no normal";
        return refused(tilt, rule);
    }
    if tilt.1 > 0.0 && linker.kinetics.is_some() && linker.rest_length_nm <= 0.0 {
        let rule = "requires a positive rest_length_nm: rates depend on the force along the linker";
        return refused(tilt, rule);
    }
    Ok(())
}

fn check_one_end(i: usize, linker: &Linker) -> Result<(), SceneProblem> {
    let first = linker.end_key();
    let rule = || format!("the other end is already given by `{first}`: write one of the two keys");
    let ends = [
        ("anchor_nm", linker.anchor_nm),
        ("displaced_nm", linker.displaced_nm),
    ];
    for (name, value) in ends {
        if let Some(value) = value.filter(|_| name != first) {
            let key = format!("linkers[{i}].{name}");
            return Err(SceneProblem::new(key, show(value), rule()));
        }
    }
    if linker.to.is_none() && linker.anchor().is_none() {
        let rule = "has no other end: write one of the keys `anchor_nm`, `displaced_nm` or `to`";
        return Err(SceneProblem::new(format!("linkers[{i}]"), "", rule));
    }
    Ok(())
}

/// Checks a site. Its keys begin with `key`.
pub(super) fn check_site(scene: &Scene, key: &str, site: &LinkerSite) -> Result<(), SceneProblem> {
    let filament = scene.named_filament(&format!("{key}.filament"), site.filament)?;
    check_on_filament(&format!("{key}.at_nm"), site.at_nm, filament.length_nm())
}
