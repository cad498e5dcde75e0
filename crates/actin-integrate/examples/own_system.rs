//! Integration of a custom system: a planet on an elliptic orbit.

use actin_integrate::{IntegrationError, PEFRL, Run, Split, Vector3};
use std::ops::ControlFlow;

/// `x'' = -x / |x|^3`
struct Planet {
    place: Vector3,
    velocity: Vector3,
    kicks: u64,
}

impl Split for Planet {
    fn drift(&mut self, h: f64) {
        self.place += self.velocity * h;
    }
    fn kick(&mut self, h: f64, _rotation: f64) {
        self.velocity -= self.place * (h / self.place.norm().powi(3));
        self.kicks += 1;
    }
    fn damp(&mut self, factor: f64, _rotation: f64) {
        self.velocity *= factor;
    }
    fn force_evaluations(&self) -> u64 {
        self.kicks
    }
}

fn main() -> Result<(), IntegrationError> {
    // Semi-major axis 1 and eccentricity 0.5, from the pericentre, over one period.
    let (place, velocity) = (Vector3::x() * 0.5, Vector3::y() * 3.0_f64.sqrt());
    let mut planet = Planet {
        place,
        velocity,
        kicks: 0,
    };
    let mut farthest = 0.0_f64;
    let run = Run::from_duration(&PEFRL, 0.005, std::f64::consts::TAU)?.observing_every(1)?;
    let outcome = run.execute_split(&mut planet, |moment| {
        farthest = farthest.max(moment.system.place.norm());
        ControlFlow::Continue(())
    })?;
    let missed = (planet.place - place).norm();
    println!("farthest {farthest:.6}, Kepler 1.5; back to within {missed:.1e}");
    println!(
        "{} steps, {} evaluations",
        outcome.steps, outcome.force_evaluations
    );
    assert!((farthest - 1.5).abs() < 1e-5 && missed < 1e-5);
    Ok(())
}
