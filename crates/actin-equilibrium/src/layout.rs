//! Map from unknowns to bodies.

use actin_mechanics::{Coordinates, Slider, State};
use std::ops::Range;
use thiserror::Error;

/// Position of each body along the filament, for a banded matrix.
///
/// Any monotone measure is suitable, for instance arc length (nm). Points and frames are sorted
/// together. The position of a slider is the largest position of its points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyOrder {
    /// One number per point.
    pub points: Vec<f64>,
    /// One number per frame.
    pub frames: Vec<f64>,
}

/// Error of the construction of a layout.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// A point is in two sliders, or twice in one.
    #[error(
        "point {point} belongs to slider {first} and to slider {second}: remove it from one of them"
    )]
    TiedTwice {
        /// Index of the point.
        point: usize,
        /// The first slider with the point.
        first: usize,
        /// The second.
        second: usize,
    },
    /// The length of the order differs from the number of bodies.
    #[error("the order has {given} numbers for {bodies} {kind}")]
    OrderLength {
        /// `points` or `frames`.
        kind: &'static str,
        /// Length of the order.
        given: usize,
        /// Number of bodies in the state.
        bodies: usize,
    },
    /// The order contains a non-finite number.
    #[error("the position of {body:?} in the order must be finite, but is {value}")]
    OrderValue {
        /// The body.
        body: Coordinates,
        /// Position of the body.
        value: f64,
    },
}

/// Bodies that share unknowns: a single body or a slider.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Node {
    Point(usize),
    Frame(usize),
    Slider(usize),
}

/// Map from unknowns to bodies.
///
/// A free point has three unknowns, its displacement (nm, lab frame). A free frame has three, its
/// rotation vector `phi` in `Q -> Q exp(phi)` (rad, body frame). A [`Slider`] of the state has one per
/// direction. Other held bodies have no unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    nodes: Vec<Node>,
    offsets: Vec<usize>,
    point_node: Vec<Option<usize>>,
    frame_node: Vec<Option<usize>>,
    sliders: Vec<Slider>,
    order: Order,
    /// Index of each node in the prescribed order.
    sequence: Vec<usize>,
    /// `true` if links may couple bodies.
    has_links: bool,
    gradients: GradientUse,
    has_gradients: bool,
}

/// Use of conjugate gradients for steps of linked chains.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum GradientUse {
    Never,
    IfCheaper,
    Always,
}

/// Source of the order of unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    /// Minimum degree, determined at the first assembly.
    Sought,
    /// Prescribed, or minimum degree if this reduces the fill; determined at the first assembly.
    Compared,
    /// Fixed.
    Settled,
}

impl Layout {
    /// All free bodies and sliders. The order is found by minimum degree at the first assembly.
    ///
    /// # Panics
    /// If two sliders of the state share a point.
    pub fn free(state: &State) -> Self {
        Self::new(state, None).expect("sliders of a state are consistent")
    }

    /// Free bodies and sliders in the given order, or ordered by minimum degree.
    ///
    /// # Errors
    /// If the order does not match the state, or sliders share a point.
    pub fn new(state: &State, order: Option<&BodyOrder>) -> Result<Self, LayoutError> {
        let sliders = state.sliders.to_vec();
        let ties = ties(&sliders, state.points.len())?;
        let mut nodes = nodes_of(state, &ties, sliders.len());
        if let Some(order) = order {
            check_order(state, order)?;
            nodes.sort_by(|a, b| key(*a, order, &sliders).total_cmp(&key(*b, order, &sliders)));
        }
        let mut layout = Self {
            nodes,
            offsets: Vec::new(),
            point_node: vec![None; state.points.len()],
            frame_node: vec![None; state.frames.len()],
            sliders,
            order: match order {
                Some(_) => Order::Settled,
                None => Order::Sought,
            },
            sequence: Vec::new(),
            has_links: false,
            gradients: GradientUse::Never,
            has_gradients: false,
        };
        layout.sequence = (0..layout.nodes.len()).collect();
        layout.number();
        Ok(layout)
    }

    /// Allows links between chains, such as linkers and contacts. Unknowns are eliminated by minimum
    /// degree if this costs less than the given order. The choice depends on the couplings at the
    /// first solve. Neighbours along a filament are determined by the given order in either case.
    ///
    /// Links are not stiffened to regularise a step, and their relative motion is not limited as a
    /// strain.
    #[must_use]
    pub fn with_links(mut self) -> Self {
        self.has_links = true;
        if self.order == Order::Settled {
            self.order = Order::Compared;
        }
        self
    }

    /// Allows conjugate gradients for steps, preconditioned by chains of neighbours, if they cost
    /// less than a factorisation. The choice depends on the couplings at the first solve.
    #[must_use]
    pub fn with_conjugate_gradients(mut self) -> Self {
        self.gradients = GradientUse::IfCheaper;
        self
    }

    /// Selects conjugate gradients for steps in any case if there may be links, because links change
    /// from one iteration to the next, as contacts do.
    #[must_use]
    pub fn with_changing_links(mut self) -> Self {
        self.gradients = GradientUse::Always;
        self
    }

    pub(crate) fn has_gradients(&self) -> bool {
        self.has_gradients
    }

    pub(crate) fn choose_gradients(&mut self) {
        self.has_gradients = true;
        self.settle();
    }

    /// Permitted use of conjugate gradients; none without links.
    pub(crate) fn gradient_use(&self) -> GradientUse {
        if self.has_links {
            self.gradients
        } else {
            GradientUse::Never
        }
    }

    pub(crate) fn has_links(&self) -> bool {
        self.has_links
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.offsets[self.nodes.len()]
    }

    pub(crate) fn sliders(&self) -> &[Slider] {
        &self.sliders
    }

    /// Unknowns of a body or its slider; `None` if it does not move.
    pub fn unknowns_of(&self, body: Coordinates) -> Option<Range<usize>> {
        self.node_of(body).map(|node| self.range(node))
    }

    pub(crate) fn nodes(&self) -> impl Iterator<Item = (Node, Range<usize>)> + '_ {
        self.nodes
            .iter()
            .enumerate()
            .map(|(k, &node)| (node, self.range(k)))
    }

    pub(crate) fn node(&self, k: usize) -> Node {
        self.nodes[k]
    }

    pub(crate) fn len(&self) -> usize {
        self.nodes.len()
    }

    pub(crate) fn range(&self, k: usize) -> Range<usize> {
        self.offsets[k]..self.offsets[k + 1]
    }

    pub(crate) fn node_of(&self, body: Coordinates) -> Option<usize> {
        match body {
            Coordinates::Point(i) => self.point_node[i],
            Coordinates::Frame(i) => self.frame_node[i],
        }
    }

    pub(crate) fn order(&self) -> Order {
        self.order
    }

    pub(crate) fn settle(&mut self) {
        self.order = Order::Settled;
    }

    /// Index of each node in the prescribed order.
    pub(crate) fn sequence(&self) -> &[usize] {
        &self.sequence
    }

    /// Moves node `order[k]` to position `k`.
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
                Node::Slider(s) => {
                    let slider = &self.sliders[s];
                    let points = slider.points.iter();
                    points.for_each(|&i| self.point_node[i] = Some(k));
                    slider.directions.len()
                }
            };
            self.offsets.push(unknowns);
        }
    }
}

/// Returns the slider of each point, if any.
fn ties(sliders: &[Slider], points: usize) -> Result<Vec<Option<usize>>, LayoutError> {
    let mut tied = vec![None; points];
    for (second, slider) in sliders.iter().enumerate() {
        for &point in &slider.points {
            if let Some(first) = tied[point].replace(second) {
                return Err(LayoutError::TiedTwice {
                    point,
                    first,
                    second,
                });
            }
        }
    }
    Ok(tied)
}

fn nodes_of(state: &State, ties: &[Option<usize>], sliders: usize) -> Vec<Node> {
    let points = (0..ties.len()).filter(|&i| state.points.is_free(i) && ties[i].is_none());
    let frames = (0..state.frames.len()).filter(|&i| state.frames.is_free(i));
    let single = points.map(Node::Point).chain(frames.map(Node::Frame));
    single.chain((0..sliders).map(Node::Slider)).collect()
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

/// Sliders have the position of their last point, so they fill few rows.
fn key(node: Node, order: &BodyOrder, sliders: &[Slider]) -> f64 {
    match node {
        Node::Point(i) => order.points[i],
        Node::Frame(i) => order.frames[i],
        Node::Slider(s) => {
            let points = sliders[s].points.iter().map(|&i| order.points[i]);
            points.fold(f64::NEG_INFINITY, f64::max)
        }
    }
}
