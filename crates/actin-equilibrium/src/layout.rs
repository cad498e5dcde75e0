//! What may move: the map from unknowns to bodies, and the order in which unknowns stand.
//!
//! How a step moves a state, and how loads become residuals, is in `motion`.

use crate::group::{Group, orthonormal};
use actin_mechanics::{Coordinates, State, Vector3};
use std::collections::BTreeSet;
use std::ops::Range;
use thiserror::Error;

/// Where each body stands along the filament, for a banded matrix.
///
/// Any monotone measure will do, arc length (nm) for instance; points and frames are sorted
/// together by these numbers. A group stands at the largest number of its bodies.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyOrder {
    /// One number per point.
    pub points: Vec<f64>,
    /// One number per frame.
    pub frames: Vec<f64>,
}

/// What is wrong with a layout.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A group names a body that the state does not have.
    #[error("group {group} has {body:?}, which the state does not have")]
    UnknownBody {
        /// Index of the group.
        group: usize,
        /// The body.
        body: Coordinates,
    },
    /// A body is in two groups, or twice in one.
    #[error("{body:?} is tied twice: in group {first} and in group {second}")]
    TiedTwice {
        /// The body.
        body: Coordinates,
        /// The first group with the body.
        first: usize,
        /// The second.
        second: usize,
    },
    /// Directions of a group are zero, not finite, or not independent.
    #[error(
        "the {what} of group {group} must be independent, finite and not zero, but are {directions:?}"
    )]
    Directions {
        /// Index of the group.
        group: usize,
        /// `translations` or `rotations`.
        what: &'static str,
        /// The directions as given.
        directions: Vec<Vector3>,
    },
    /// New directions for a group would change the number of unknowns.
    #[error("group {group} has {present} unknowns and cannot be given {given}")]
    Count {
        /// Index of the group.
        group: usize,
        /// Unknowns so far.
        present: usize,
        /// Unknowns with the new directions.
        given: usize,
    },
    /// The order has not one number per body.
    #[error("the order has {given} numbers for {bodies} {kind}")]
    OrderLength {
        /// `points` or `frames`.
        kind: &'static str,
        /// Numbers given.
        given: usize,
        /// Bodies in the state.
        bodies: usize,
    },
    /// The order has a number that is not finite.
    #[error("the place of {body:?} along the filament must be finite, but is {value}")]
    OrderValue {
        /// The body.
        body: Coordinates,
        /// Its number.
        value: f64,
    },
}

/// Bodies that share their unknowns: a single body or a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    /// A free point.
    Point(usize),
    /// A free frame.
    Frame(usize),
    /// A group, by index.
    Group(usize),
}

/// The map from unknowns to bodies.
///
/// A free point has three unknowns, its displacement (nm, lab frame); a free frame three, its
/// turn `phi` in `Q -> Q exp(phi)` (rad, body frame); a [`Group`] one for each of its
/// directions. Held bodies have none unless a group moves them.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    nodes: Vec<Node>,
    offsets: Vec<usize>,
    point_node: Vec<Option<usize>>,
    frame_node: Vec<Option<usize>>,
    groups: Vec<Group>,
    order: Order,
    /// Places of the nodes in the order in which bodies follow one another.
    sequence: Vec<usize>,
    /// Pairs of bodies that are coupled but no neighbours, the lesser first.
    loose: BTreeSet<(Coordinates, Coordinates)>,
    /// Places of all bodies, and how far neighbours are apart at most.
    loose_beyond: Option<(BodyOrder, f64)>,
    allows_gradients: bool,
    has_gradients: bool,
}

/// Where the order of unknowns comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// By minimum degree, once the stiffness is seen.
    Sought,
    /// As it is, or by minimum degree if that fills less, once the stiffness is seen.
    Compared,
    /// As it is.
    Settled,
}

impl Layout {
    /// Every free body on its own, with the sliding bodies of the state, in an order that the
    /// solver finds by minimum degree when it first sees the stiffness.
    ///
    /// # Panics
    /// If two sliding bodies of the state share a point, or one has dependent directions.
    pub fn free(state: &State) -> Self {
        Self::new(state, None, Vec::new()).expect("sliding bodies of a state are consistent")
    }

    /// Free bodies and groups, in the order given, or in one found by minimum degree.
    ///
    /// The sliding bodies of the state are groups as well; they stand after those given here.
    ///
    /// # Errors
    /// If a group or the order does not fit the state.
    pub fn new(
        state: &State,
        order: Option<&BodyOrder>,
        mut groups: Vec<Group>,
    ) -> Result<Self, LayoutError> {
        groups.extend(state.sliders.iter().map(Group::from_slider));
        let ties = Ties::new(state, &groups)?;
        let groups = with_orthonormal_directions(groups)?;
        let mut nodes = nodes_of(state, &ties, &groups);
        if let Some(order) = order {
            check_order(state, order)?;
            nodes.sort_by(|a, b| key(*a, order, &groups).total_cmp(&key(*b, order, &groups)));
        }
        let mut layout = Self {
            nodes,
            offsets: Vec::new(),
            point_node: vec![None; state.points.len()],
            frame_node: vec![None; state.frames.len()],
            groups,
            order: match order {
                Some(_) => Order::Settled,
                None => Order::Sought,
            },
            sequence: Vec::new(),
            loose: BTreeSet::new(),
            loose_beyond: None,
            allows_gradients: false,
            has_gradients: false,
        };
        layout.sequence = (0..layout.nodes.len()).collect();
        layout.number();
        Ok(layout)
    }

    /// The same bodies, eliminated in the order given or, if its factor costs less, in one found by
    /// minimum degree: for bodies that are not coupled along the order only. Which it is shows at
    /// the first solve and depends on which bodies are coupled, not on numbers.
    ///
    /// Bodies follow one another in the order given whichever it is.
    #[must_use]
    pub fn with_least_fill(mut self) -> Self {
        if self.order == Order::Settled {
            self.order = Order::Compared;
        }
        self
    }

    /// The same, where these pairs of bodies are coupled but no neighbours: what they do to each
    /// other is not stiffened to regularise a step, and no strain that would limit it. They swing
    /// about a soft coupling as far as a step leads them; the energy judges.
    #[must_use]
    pub fn with_loose(mut self, pairs: impl IntoIterator<Item = [Coordinates; 2]>) -> Self {
        let pairs = pairs.into_iter().map(|[a, b]| (a.min(b), a.max(b)));
        self.loose.extend(pairs);
        self
    }

    /// The same of all pairs whose places in an order of the bodies are farther apart than `reach`: of
    /// pairs that may come to be coupled, such as those in contact.
    #[must_use]
    pub fn with_loose_beyond(mut self, order: BodyOrder, reach: f64) -> Self {
        self.loose_beyond = Some((order, reach));
        self
    }

    /// Allows conjugate gradients for steps, preconditioned by chains of neighbours without loose couplings, if they cost
    /// less than the factorisation of the whole. The choice depends on the couplings at the first solve.
    #[must_use]
    pub fn with_conjugate_gradients(mut self) -> Self {
        self.allows_gradients = true;
        self
    }

    /// True if steps are solved by conjugate gradients; known after the first solve.
    pub(crate) fn has_gradients(&self) -> bool {
        self.has_gradients
    }

    /// Chooses conjugate gradients in the order given.
    pub(crate) fn choose_gradients(&mut self) {
        self.has_gradients = true;
        self.settle();
    }

    /// True if conjugate gradients may be chosen.
    pub(crate) fn allows_gradients(&self) -> bool {
        self.allows_gradients && self.order == Order::Compared && self.has_loose()
    }

    /// Whether coupled bodies may be no neighbours.
    pub(crate) fn has_loose(&self) -> bool {
        self.loose_beyond.is_some() || !self.loose.is_empty()
    }

    /// Whether two coupled bodies are no neighbours.
    pub(crate) fn is_loose(&self, a: Coordinates, b: Coordinates) -> bool {
        let are_apart = self.loose_beyond.as_ref().is_some_and(|(order, reach)| {
            let place = |body| match body {
                Coordinates::Point(i) => order.points[i],
                Coordinates::Frame(i) => order.frames[i],
            };
            (place(a) - place(b)).abs() > *reach
        });
        are_apart || self.loose.contains(&(a.min(b), a.max(b)))
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.offsets[self.nodes.len()]
    }

    /// The groups, their directions made orthonormal.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The unknowns of a body, or of the group that it belongs to; `None` if it does not move.
    pub fn unknowns_of(&self, body: Coordinates) -> Option<Range<usize>> {
        self.node_of(body).map(|node| self.range(node))
    }

    /// Gives a group new directions, as many as before.
    ///
    /// # Errors
    /// If they are dependent or more or fewer than before.
    ///
    /// # Panics
    /// If there is no such group.
    pub fn redirect(
        &mut self,
        group: usize,
        translations: Vec<Vector3>,
        rotations: Vec<Vector3>,
    ) -> Result<(), LayoutError> {
        let changed = Group {
            translations,
            rotations,
            ..self.groups[group].clone()
        };
        let (present, given) = (self.groups[group].unknowns(), changed.unknowns());
        if present != given {
            return Err(LayoutError::Count {
                group,
                present,
                given,
            });
        }
        self.groups[group] = orthonormalised(group, changed)?;
        Ok(())
    }

    /// All nodes in the order of their unknowns.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = (Node, Range<usize>)> + '_ {
        self.nodes
            .iter()
            .enumerate()
            .map(|(k, &node)| (node, self.range(k)))
    }

    /// Node `k`.
    pub(crate) fn node(&self, k: usize) -> Node {
        self.nodes[k]
    }

    /// Number of nodes.
    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The unknowns of node `k`.
    pub(crate) fn range(&self, k: usize) -> Range<usize> {
        self.offsets[k]..self.offsets[k + 1]
    }

    /// The node that a body belongs to.
    pub(crate) fn node_of(&self, body: Coordinates) -> Option<usize> {
        match body {
            Coordinates::Point(i) => self.point_node[i],
            Coordinates::Frame(i) => self.frame_node[i],
        }
    }

    /// Where the order comes from.
    pub(crate) fn order(&self) -> Order {
        self.order
    }

    /// Keeps the order for good.
    pub(crate) fn settle(&mut self) {
        self.order = Order::Settled;
    }

    /// Places of all nodes in the order in which bodies follow one another.
    pub(crate) fn sequence(&self) -> &[usize] {
        &self.sequence
    }

    /// Puts node `order[k]` in place `k`, for good.
    pub(crate) fn reorder(&mut self, order: &[usize]) {
        if self.order == Order::Compared {
            for (place, &node) in order.iter().enumerate() {
                self.sequence[node] = place;
            }
        }
        self.order = Order::Settled;
        self.nodes = order.iter().map(|&k| self.nodes[k]).collect();
        self.number();
    }

    /// Finds the offsets and the node of each body.
    fn number(&mut self) {
        self.offsets.clear();
        self.offsets.push(0);
        let mut unknowns = 0;
        for (k, &node) in self.nodes.iter().enumerate() {
            unknowns += match node {
                Node::Point(i) => {
                    self.point_node[i] = Some(k);
                    3
                }
                Node::Frame(i) => {
                    self.frame_node[i] = Some(k);
                    3
                }
                Node::Group(g) => {
                    let group = &self.groups[g];
                    group
                        .points
                        .iter()
                        .for_each(|&i| self.point_node[i] = Some(k));
                    group
                        .frames
                        .iter()
                        .for_each(|&i| self.frame_node[i] = Some(k));
                    group.unknowns()
                }
            };
            self.offsets.push(unknowns);
        }
    }
}

/// Which group each body is tied to.
struct Ties {
    points: Vec<Option<usize>>,
    frames: Vec<Option<usize>>,
}

impl Ties {
    fn new(state: &State, groups: &[Group]) -> Result<Self, LayoutError> {
        let mut points = vec![None; state.points.len()];
        let mut frames = vec![None; state.frames.len()];
        for (g, group) in groups.iter().enumerate() {
            for &i in &group.points {
                tie(&mut points, i, g, Coordinates::Point(i))?;
            }
            for &i in &group.frames {
                tie(&mut frames, i, g, Coordinates::Frame(i))?;
            }
            if let crate::Pivot::Point(i) = group.pivot
                && i >= points.len()
            {
                let body = Coordinates::Point(i);
                return Err(LayoutError::UnknownBody { group: g, body });
            }
        }
        Ok(Self { points, frames })
    }
}

/// Marks body `i` as tied to `group`.
fn tie(
    ties: &mut [Option<usize>],
    i: usize,
    group: usize,
    body: Coordinates,
) -> Result<(), LayoutError> {
    let place = ties
        .get_mut(i)
        .ok_or(LayoutError::UnknownBody { group, body })?;
    if let Some(first) = place.replace(group) {
        return Err(LayoutError::TiedTwice {
            body,
            first,
            second: group,
        });
    }
    Ok(())
}

fn with_orthonormal_directions(groups: Vec<Group>) -> Result<Vec<Group>, LayoutError> {
    groups
        .into_iter()
        .enumerate()
        .map(|(g, group)| orthonormalised(g, group))
        .collect()
}

fn orthonormalised(index: usize, mut group: Group) -> Result<Group, LayoutError> {
    for (what, directions) in [
        ("translations", &mut group.translations),
        ("rotations", &mut group.rotations),
    ] {
        *directions = orthonormal(directions).ok_or_else(|| LayoutError::Directions {
            group: index,
            what,
            directions: directions.clone(),
        })?;
    }
    Ok(group)
}

/// Free bodies that are not tied, by index, and groups.
fn nodes_of(state: &State, ties: &Ties, groups: &[Group]) -> Vec<Node> {
    let points = (0..state.points.len())
        .filter(|&i| state.points.is_free(i) && ties.points[i].is_none())
        .map(Node::Point);
    let frames = (0..state.frames.len())
        .filter(|&i| state.frames.is_free(i) && ties.frames[i].is_none())
        .map(Node::Frame);
    let tied = (0..groups.len()).map(Node::Group);
    points.chain(frames).chain(tied).collect()
}

fn check_order(state: &State, order: &BodyOrder) -> Result<(), LayoutError> {
    let of = |kind, given: &[f64], bodies, body: fn(usize) -> Coordinates| {
        if given.len() != bodies {
            return Err(LayoutError::OrderLength {
                kind,
                given: given.len(),
                bodies,
            });
        }
        match given.iter().position(|value| !value.is_finite()) {
            Some(i) => Err(LayoutError::OrderValue {
                body: body(i),
                value: given[i],
            }),
            None => Ok(()),
        }
    };
    of(
        "points",
        &order.points,
        state.points.len(),
        Coordinates::Point,
    )?;
    of(
        "frames",
        &order.frames,
        state.frames.len(),
        Coordinates::Frame,
    )
}

/// Where a node stands along the filament.
///
/// A group that ties bodies far apart stands with the last of them, so that it is eliminated
/// late and fills a few rows only.
fn key(node: Node, order: &BodyOrder, groups: &[Group]) -> f64 {
    match node {
        Node::Point(i) => order.points[i],
        Node::Frame(i) => order.frames[i],
        Node::Group(g) => {
            let points = groups[g].points.iter().map(|&i| order.points[i]);
            let frames = groups[g].frames.iter().map(|&i| order.frames[i]);
            points.chain(frames).fold(f64::NEG_INFINITY, f64::max)
        }
    }
}
