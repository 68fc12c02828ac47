//! What readings that ended in a brick left there, beside occupancy.

use super::layout::{Address, VOXELS};
use super::points::Points;
use super::readings::Reading;

/// Points and seen sides of a brick.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surface {
    /// What was measured there.
    pub points: Points,
    /// Faces turned away from an eye that hit the voxel: bits −x +x −y +y −z +z.
    far: [u8; VOXELS],
}

impl Surface {
    /// Keeps a reading; `far` are the faces of its voxel that its eye did not see.
    pub fn keep(&mut self, reading: &Reading, far: u8) {
        self.far[reading.address.local()] |= far;
        self.points.keep(reading.address, reading.octant, reading.point);
    }

    /// Bytes on the heap, its own included.
    pub fn bytes(&self) -> usize {
        size_of::<Self>() + self.points.bytes()
    }

    /// Faces of a voxel turned away from an eye that hit it.
    pub fn far(&self, address: Address) -> u8 {
        self.far[address.local()]
    }
}

impl Default for Surface {
    fn default() -> Self {
        Self {
            points: Points::default(),
            far: [0; VOXELS],
        }
    }
}
