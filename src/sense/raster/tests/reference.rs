//! Depth and colour against a ray caster that tries every triangle.

use proptest::prelude::*;

use super::*;
use crate::sense::Texture;

/// Nearest hit of a ray, and how clear it is of every edge: the least weight of a
/// corner, over the triangles that the ray meets or narrowly misses.
fn cast_clear(mesh: &Mesh, eye: &Point, ray: &Vector) -> (Option<(f64, usize, [f64; 3])>, f64) {
    let (mut best, mut clear) = (None::<(f64, usize, [f64; 3])>, f64::INFINITY);
    for k in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(k).map(|p| p - eye);
        let parts = [b.cross(&c), c.cross(&a), a.cross(&b)].map(|n| n.dot(ray));
        let volume = a.dot(&b.cross(&c));
        let total: f64 = parts.iter().sum();
        let weights = parts.map(|p| p / total);
        let least = weights.into_iter().fold(f64::INFINITY, f64::min);
        let depth = volume / total;
        clear = clear.min(least.abs());
        if least >= 0.0 && depth > 0.0 && best.is_none_or(|(nearest, ..)| depth < nearest) {
            best = Some((depth, k, weights));
        }
    }
    (best, clear)
}

fn soup() -> impl Strategy<Value = Mesh> {
    let corner = || prop::array::uniform3(-1.0..1.0_f64).prop_map(Point::from);
    let triangle = prop::array::uniform3(corner());
    prop::collection::vec((triangle, any::<[u8; 3]>()), 1..12).prop_map(|triangles| {
        let mut mesh = Mesh::default();
        for (corners, colour) in triangles {
            let first = mesh.vertices.len() as u32;
            mesh.vertices.extend(corners);
            mesh.triangles.push([first, first + 1, first + 2]);
            let uv = [
                [0.0, 0.0],
                [f64::from(colour[0] % 4), 0.3],
                [0.2, f64::from(colour[1] % 3)],
            ];
            mesh.paints.push(match colour[2] % 3 {
                0 => Paint::Flat(colour),
                1 => Paint::Corners([colour, [255; 3], [0; 3]]),
                _ => Paint::Image {
                    texture: 0,
                    uv,
                    tint: colour,
                },
            });
        }
        mesh.textures = vec![Texture {
            width: 4,
            height: 4,
            pixels: (0..16).map(|k| [k * 16, 255 - k * 16, k]).collect(),
        }];
        mesh
    })
}

/// The colour of a triangle at corner weights, without light; `None` on the border
/// of two texels.
fn paint(mesh: &Mesh, triangle: usize, weights: [f64; 3]) -> Option<[f64; 3]> {
    let mix = |at: &dyn Fn(usize) -> f64| (0..3).map(|k| weights[k] * at(k)).sum::<f64>();
    Some(match &mesh.paints[triangle] {
        Paint::Flat(colour) => colour.map(f64::from),
        Paint::Corners(colours) => [0, 1, 2].map(|c| mix(&|k| f64::from(colours[k][c]))),
        Paint::Image { texture, uv, tint } => {
            let (u, v) = (mix(&|k| uv[k][0]), mix(&|k| uv[k][1]));
            if [u, v].iter().any(|x| (4.0 * x - (4.0 * x).round()).abs() < 1e-6) {
                return None;
            }
            let texel = mesh.textures[*texture as usize].at(u, v);
            [0, 1, 2].map(|c| f64::from(texel[c]) * f64::from(tint[c]) / 255.0)
        }
    })
}

/// Half-Lambert: 0.8 to 1, brightest where the outside faces (0.36, −0.48, 0.8).
fn light(mesh: &Mesh, triangle: usize) -> f64 {
    let cosine = mesh
        .vector_area(triangle)
        .normalize()
        .dot(&Vector::new(0.36, -0.48, 0.8));
    0.8 + 0.2 * (0.5 + 0.5 * cosine)
}

#[derive(Debug)]
struct Scene {
    mesh: Mesh,
    image: Intrinsics,
    pose: Pose,
}

fn scenes() -> impl Strategy<Value = Scene> {
    (
        soup(),
        prop::array::uniform3(-1.5..1.5),
        prop::array::uniform3(-0.5..0.5),
    )
        .prop_map(|(mesh, eye, target)| Scene {
            mesh,
            image: camera(24, 18).depth,
            pose: look_at(Point::from(eye), Point::from(target)),
        })
}

impl Scene {
    fn cast(&self, u: f64, v: f64) -> (Option<(f64, usize, [f64; 3])>, f64) {
        let eye = Point::from(self.pose.translation.vector);
        cast_clear(&self.mesh, &eye, &(self.pose * self.image.ray(u, v)))
    }

    /// The triangle that all of a pixel and its neighbours show, clear of edges.
    fn alone(&self, u: u32, v: u32) -> Option<usize> {
        let (u, v) = (f64::from(u), f64::from(v));
        let mut shown = None;
        for (i, j) in (0..13).flat_map(|i| (0..13).map(move |j| (i, j))) {
            let (hit, clear) = self.cast(u - 1.0 + f64::from(i) / 4.0, v - 1.0 + f64::from(j) / 4.0);
            let triangle = hit.filter(|_| clear > 1e-6)?.1;
            if *shown.get_or_insert(triangle) != triangle {
                return None;
            }
        }
        shown
    }

    /// The mean colour of a triangle over a grid of rays through a pixel; `None`
    /// where a sliver of another one hides, or where the colour is not sure.
    fn colour(&self, u: u32, v: u32, alone: usize) -> Option<[f64; 3]> {
        let grid = if matches!(self.mesh.paints[alone], Paint::Image { .. }) {
            4
        } else {
            1
        };
        let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(grid);
        let mut sum = [0.0; 3];
        for k in 0..grid * grid {
            let (_, triangle, weights) = self
                .cast(f64::from(u) + offset(k % grid), f64::from(v) + offset(k / grid))
                .0?;
            let colour = paint(&self.mesh, triangle, weights).filter(|_| triangle == alone)?;
            sum = [0, 1, 2].map(|c| sum[c] + colour[c] * light(&self.mesh, triangle));
        }
        Some(sum.map(|c| c / f64::from(grid * grid)))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn depth_is_what_a_ray_caster_measures(scene in scenes()) {
        let seen = Visibility::of(&scene.mesh, &scene.image, &scene.pose);
        for k in 0..scene.image.pixels() {
            let (hit, clear) = scene.cast((k % 24) as f64 + 0.5, (k / 24) as f64 + 0.5);
            if clear > 1e-4 {
                let (truth, drawn) = (hit.map_or(0.0, |h| h.0), seen.depth(k).map_or(0.0, f64::from));
                prop_assert!((truth - drawn).abs() < 1e-4, "pixel {}: {} instead of {}", k, drawn, truth);
            }
        }
    }

    #[test]
    fn colour_is_what_a_ray_caster_sees(scene in scenes()) {
        let seen = Visibility::of(&scene.mesh, &scene.image, &scene.pose);
        let drawn = shade(&seen, None, &scene.pose);
        let inner = (1..17_u32).flat_map(|v| (1..23_u32).map(move |u| (u, v)));
        for ((u, v), triangle) in inner.filter_map(|(u, v)| Some(((u, v), scene.alone(u, v)?))) {
            let Some(truth) = scene.colour(u, v, triangle) else { continue };
            for (drawn, truth) in drawn.at(u, v).map(f64::from).into_iter().zip(truth) {
                prop_assert!((drawn - truth).abs() <= 1.001, "({}, {}): {} instead of {}", u, v, drawn, truth);
            }
        }
    }
}
