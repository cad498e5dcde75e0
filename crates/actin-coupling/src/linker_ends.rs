use crate::{PeriodicImage, Site};
use actin_mechanics::{ControlId, Coordinates, Loads, Matrix3, State, Stiffness, Vector3};

/// External point at one end of a linker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Position without displacement (nm, lab frame).
    pub position: Vector3,
    /// Components of the displacement (nm, lab frame), or `None` for a fixed anchor.
    pub controls: Option<[ControlId; 3]>,
}

impl Anchor {
    /// Creates a fixed anchor at `position` (nm, lab frame).
    pub fn fixed(position: Vector3) -> Self {
        Self {
            position,
            controls: None,
        }
    }

    /// Creates a movable anchor at `position` (nm, lab frame) and adds the three controls of its
    /// displacement to the state.
    pub fn movable(state: &mut State, position: Vector3) -> Self {
        Self {
            position,
            controls: Some([0.0; 3].map(|component| state.add_control(component))),
        }
    }

    /// Current position (nm, lab frame).
    pub(crate) fn position(&self, state: &State) -> Vector3 {
        let displacement = self
            .controls
            .map(|c| c.map(|component| state.controls[component]));
        self.position + displacement.map_or_else(Vector3::zeros, Vector3::from)
    }
}

/// Second end of a linker.
#[derive(Clone, Debug, PartialEq)]
pub enum LinkerEnd {
    /// External point.
    Anchor(Anchor),
    /// Site of the same or another filament.
    Site(Site),
}

/// Both ends of a linker.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LinkerEnds {
    pub(crate) site: Site,
    pub(crate) end: LinkerEnd,
    /// Image of the second end, or `None` for the end itself.
    pub(crate) image: Option<PeriodicImage>,
}

impl LinkerEnds {
    /// Position of the second end or of its image (nm, lab frame).
    pub(crate) fn second(&self, state: &State) -> Vector3 {
        let end = match &self.end {
            LinkerEnd::Anchor(anchor) => anchor.position(state),
            LinkerEnd::Site(site) => site.position(state),
        };
        end + self.image_displacement(end, state)
    }

    /// Displacement of the image of the second end from this end (nm, lab frame); zero without periodic images.
    pub(crate) fn periodic_displacement(&self, state: &State) -> Vector3 {
        match &self.end {
            LinkerEnd::Site(site) => self.image_displacement(site.position(state), state),
            LinkerEnd::Anchor(_) => Vector3::zeros(),
        }
    }

    fn image_displacement(&self, end: Vector3, state: &State) -> Vector3 {
        self.image.map_or_else(Vector3::zeros, |image| {
            image.displacement(end - self.site.position(state), state)
        })
    }

    /// Vector from the first to the second end (nm, lab frame).
    #[inline]
    pub(crate) fn reach(&self, state: &State) -> Vector3 {
        self.second(state) - self.site.position(state)
    }

    /// Derivatives of the linker vector with respect to the bodies of each end.
    pub(crate) fn slopes_of_ends(&self, state: &State) -> [Vec<(Coordinates, Matrix3)>; 2] {
        let first = self.site.slopes(state).map(|(c, j)| (c, -j)).collect();
        let second = match &self.end {
            LinkerEnd::Site(other) => other.slopes(state).collect(),
            LinkerEnd::Anchor(_) => Vec::new(),
        };
        [first, second]
    }

    /// Adds a force on the first end and the opposite force on the second one (pN, lab frame).
    pub(crate) fn add_force(&self, force: Vector3, state: &State, loads: &mut Loads) {
        self.site.add_force(force, state, loads);
        if let LinkerEnd::Site(other) = &self.end {
            other.add_force(-force, state, loads);
        }
    }

    /// Adds `J^T K J` and the geometric stiffness of the arms. `J` is the derivative of the linker
    /// vector and `K` the tangent of the force.
    pub(crate) fn push_stiffness(
        &self,
        (force, spring): (Vector3, Matrix3),
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let [mut slopes, second] = self.slopes_of_ends(state);
        let of_site = slopes.len();
        slopes.extend(second);
        for (k, &(a, slope_a)) in slopes.iter().enumerate() {
            stiffness.push(a, a, symmetric(slope_a.transpose() * spring * slope_a));
            for (l, &(b, slope_b)) in slopes.iter().enumerate().skip(k + 1) {
                let block = slope_a.transpose() * spring * slope_b;
                if a == b {
                    // Both sites follow this body: block and transpose are on the diagonal.
                    stiffness.push(a, a, block + block.transpose());
                } else if k < of_site && l >= of_site {
                    stiffness.push_link(a, b, block);
                } else {
                    stiffness.push(a, b, block);
                }
            }
        }
        self.push_curvature(force, state, stiffness);
    }

    /// Adds the geometric stiffness of the arms under a force on the first end (pN, lab frame).
    pub(crate) fn push_curvature(&self, force: Vector3, state: &State, stiffness: &mut Stiffness) {
        let geometric = |site: &Site, g: Vector3, stiffness: &mut Stiffness| {
            if site.has_arm() {
                let frame = Coordinates::Frame(site.frame());
                stiffness.push(frame, frame, site.curvature_of_work(g, state));
            }
        };
        geometric(&self.site, -force, stiffness);
        if let LinkerEnd::Site(other) = &self.end {
            geometric(other, force, stiffness);
        }
    }
}

fn symmetric(m: Matrix3) -> Matrix3 {
    0.5 * (m + m.transpose())
}
