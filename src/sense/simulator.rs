//! The built-in simulator: one object before a backdrop, seen by an RGB-D camera.

use std::path::Path;

use rayon::prelude::*;

use super::error::SceneError;
use super::noise::Noise;
use super::raster::{self, Visibility};
use super::{DepthImage, Mesh, Observation, shapes};
use crate::geometry::{Bounds, Camera, Point, Pose};
use crate::rules::{Backdrop, Marker, SceneObject, Space};

/// A scene that can be observed from anywhere.
#[derive(Clone, Debug)]
pub struct Simulator {
    mesh: Mesh,
    backdrop: Option<Backdrop>,
    space: Space,
}

/// How far a print must stand out of the surface behind it, metres.
const PROUD: f64 = 1e-4;
/// How much room a print needs in front of it, metres.
const ROOM: f64 = 5e-3;

/// Refuses a marker that the object itself hides: flush with its surface,
/// under it, or printed on its inside. It would silently never be seen.
fn shows(bare: &Mesh, marker: &Marker) -> Result<(), SceneError> {
    let steps = [-0.45, 0.0, 0.45];
    for (across, up) in steps
        .iter()
        .flat_map(|x| steps.map(|y| (x * marker.size, y * marker.size)))
    {
        for out in [-PROUD, ROOM] {
            let p = marker.object_from_marker * Point::new(across, up, out);
            if bare.bounds().contains(&p) && bare.winding_number(&p) > 0.5 {
                return Err(SceneError::Marker {
                    text: marker.text.clone(),
                    reason: "the object's own surface hides it; place it at least 1 mm outside, facing away".into(),
                });
            }
        }
    }
    Ok(())
}

impl Simulator {
    /// The scene of an object with its markers. `base` is the folder that mesh
    /// paths are relative to.
    ///
    /// # Errors
    /// The shape, a marker or the mesh file is unusable.
    pub fn new(
        object: &SceneObject,
        backdrop: Option<Backdrop>,
        space: &Space,
        base: &Path,
    ) -> Result<Self, SceneError> {
        let mut mesh = shapes::mesh(&object.shape, base)?;
        let bare = mesh.clone();
        for marker in &object.markers {
            shows(&bare, marker)?;
            mesh.append(shapes::plate(marker)?);
        }
        Ok(Self::from_mesh(mesh, object.world_from_object, backdrop, space))
    }

    /// The scene of a mesh placed by `world_from_object`.
    pub fn from_mesh(mesh: Mesh, world_from_object: Pose, backdrop: Option<Backdrop>, space: &Space) -> Self {
        Self {
            mesh: mesh.moved(&world_from_object),
            backdrop,
            space: *space,
        }
    }

    /// The object, world axes.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The model space.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The box around the object, world axes.
    pub fn bounds(&self) -> Bounds {
        self.mesh.bounds()
    }

    /// Whether a point lies inside the object. By winding number, so holes in
    /// the mesh and parts that overlap do no harm.
    pub fn contains(&self, eye: &Point) -> bool {
        self.bounds().contains(eye) && self.mesh.winding_number(eye) > 0.5
    }

    /// What a camera measures. `n` is the number of the view in its run; with
    /// `seed` it fixes the noise. Surfaces out of range give no reading.
    pub fn observe(&self, camera: &Camera, world_from_camera: &Pose, noise: Noise, seed: u64, n: u32) -> Observation {
        let drawn = Visibility::of(&self.mesh, &camera.colour, world_from_camera);
        Observation {
            camera: *camera,
            world_from_camera: *world_from_camera,
            colour: raster::shade(&drawn, self.backdrop_seen(world_from_camera), world_from_camera),
            depth: self.depth(camera, world_from_camera, noise, seed, n),
        }
    }

    /// The depth image of [`Simulator::observe`] alone.
    pub fn depth(&self, camera: &Camera, world_from_camera: &Pose, noise: Noise, seed: u64, n: u32) -> DepthImage {
        let seen = self.visibility(camera, world_from_camera);
        let backdrop = self.backdrop_seen(world_from_camera);
        let width = camera.depth.width as usize;
        let mut metres = seen.depths();
        metres.par_chunks_mut(width).enumerate().for_each(|(v, row)| {
            for (u, metre) in row.iter_mut().enumerate() {
                if let Some(backdrop) = backdrop.filter(|_| *metre == 0.0) {
                    *metre = backdrop.hit(&seen.ray(v * width + u)).map_or(0.0, |hit| hit.0 as f32);
                }
                if !camera.range.contains(f64::from(*metre)) {
                    *metre = 0.0;
                }
            }
        });
        DepthImage {
            width: camera.depth.width,
            height: camera.depth.height,
            metres: match noise {
                Noise::None => metres,
                _ => noise.apply(metres, width, incidence(&seen, backdrop), camera.range, seed, n),
            },
        }
    }

    /// The noise-free depth of the object alone, with the triangle of each pixel.
    pub(super) fn visibility(&self, camera: &Camera, world_from_camera: &Pose) -> Visibility<'_> {
        Visibility::of(&self.mesh, &camera.depth, world_from_camera)
    }

    fn backdrop_seen(&self, world_from_camera: &Pose) -> Option<raster::Backdrop> {
        self.backdrop.map(|b| raster::Backdrop {
            centre: world_from_camera.inverse_transform_point(&self.space.centre),
            radius: b.radius,
            colour: b.colour.0,
        })
    }
}

/// The angle between the ray of a pixel and the normal of what it meets, radians.
fn incidence(seen: &Visibility, backdrop: Option<raster::Backdrop>) -> impl Fn(usize) -> f64 {
    let facets = seen.facets();
    move |k| {
        let ray = seen.ray(k);
        let facet = facets.at(k).map(|facet| facet.cosine(&ray));
        let cosine = facet.or_else(|| Some(backdrop?.hit(&ray)?.1));
        cosine.unwrap_or(1.0).clamp(0.0, 1.0).acos()
    }
}

#[cfg(test)]
mod tests;
