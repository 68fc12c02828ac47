//! The simulator as the sensor of a closed loop.

use super::closed_loop::Sensor;
use super::error::PlanError;
use crate::geometry::{Camera, Pose};
use crate::sense::{Noise, Observation, Simulator};

/// A simulator behind a camera; `seed` and the number of a view fix its noise.
pub struct Simulated<'a> {
    /// What is shown.
    pub simulator: &'a Simulator,
    /// The camera that looks at it.
    pub camera: Camera,
    /// What happens to depth.
    pub noise: Noise,
    /// Seed of the noise.
    pub seed: u64,
}

impl Sensor for Simulated<'_> {
    fn measure(&mut self, n: u32, _view: usize, world_from_camera: &Pose) -> Result<Observation, PlanError> {
        Ok(self
            .simulator
            .observe(&self.camera, world_from_camera, self.noise, self.seed, n))
    }
}
