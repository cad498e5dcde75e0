//! A filament of two strands whose interfaces are bundles of bonds parallel to the line of
//! centres: floppy at rest, stiff once deformed.

use super::{Bond, Bonds, frame, point};
use actin_mechanics::Xorshift;
use actin_mechanics::{State, Vector3, rotation};
use std::f64::consts::TAU;

const RADIUS: f64 = 1.8;
const RISE: f64 = 71.2 / 26.0;
const TURN: f64 = -TAU * 12.0 / 26.0;

/// `n` monomers along z, the first two held, `bonds` per interface with draws of their own.
pub(crate) fn filament(n: usize, bonds: usize, seed: u64) -> (State, Bonds) {
    let mut state = State::default();
    for i in 0..n {
        let angle = TURN * i as f64;
        let z = RISE * i as f64;
        point(
            &mut state,
            Vector3::new(RADIUS * angle.cos(), RADIUS * angle.sin(), z),
        );
        frame(&mut state, rotation::exp(Vector3::z() * angle));
    }
    let mut noise = Xorshift::new(seed);
    let mut all = Vec::new();
    for (step, stiffness, gap) in [(1, 2258.0, [0.0, 1.6]), (2, 3354.0, [0.14, 2.2])] {
        for i in 0..n.saturating_sub(step) {
            for _ in 0..bonds {
                let bond = bond(&state, i, i + step, &mut noise, gap);
                all.push(Bond {
                    stiffness: stiffness / bonds as f64,
                    ..bond
                });
            }
        }
    }
    for i in 0..2 {
        state.points.hold(i);
        state.frames.hold(i);
    }
    (state, Bonds(all))
}

/// A bond parallel to the line of centres at a place drawn from a disc of radius 1.8 nm; the gap
/// grows from the centre to the rim.
fn bond(state: &State, i: usize, j: usize, noise: &mut Xorshift, gap: [f64; 2]) -> Bond {
    let (xi, xj) = (state.points.position.get(i), state.points.position.get(j));
    let axis = (xj - xi).normalize();
    let across = axis.cross(&Vector3::x()).normalize();
    let other = axis.cross(&across);
    let (u, v) = loop {
        let (u, v) = (noise.sample(), noise.sample());
        if u * u + v * v <= 1.0 {
            break (u, v);
        }
    };
    let rest = gap[0] + (gap[1] - gap[0]) * (u * u + v * v) + 1e-3;
    let middle = 0.5 * (xi + xj) + 1.8 * (u * across + v * other);
    let body = |k: usize, place: Vector3| {
        state.frames.orientation.get(k).inverse() * (place - state.points.position.get(k))
    };
    Bond {
        i,
        j,
        a: body(i, middle - 0.5 * rest * axis),
        b: body(j, middle + 0.5 * rest * axis),
        stiffness: 0.0,
        rest,
    }
}
