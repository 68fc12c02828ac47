mod reference;
mod watertight;

use super::*;
use crate::geometry::{Point, look_at};
use crate::sense::Paint;
use crate::sense::shapes::testing::*;

/// A cube of edge 2 about the origin, each side a grid of n by n squares.
fn grid_cube(n: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for side in 0..6 {
        let turn = [
            nalgebra::UnitQuaternion::identity(),
            nalgebra::UnitQuaternion::from_axis_angle(&Vector::y_axis(), std::f64::consts::PI),
            nalgebra::UnitQuaternion::from_axis_angle(&Vector::y_axis(), std::f64::consts::FRAC_PI_2),
            nalgebra::UnitQuaternion::from_axis_angle(&Vector::y_axis(), -std::f64::consts::FRAC_PI_2),
            nalgebra::UnitQuaternion::from_axis_angle(&Vector::x_axis(), std::f64::consts::FRAC_PI_2),
            nalgebra::UnitQuaternion::from_axis_angle(&Vector::x_axis(), -std::f64::consts::FRAC_PI_2),
        ][side];
        let first = mesh.vertices.len() as u32;
        let step = |k: usize| 2.0 * k as f64 / n as f64 - 1.0;
        for j in 0..=n {
            for i in 0..=n {
                let p = turn * Point::new(step(i), step(j), 1.0);
                // Rounded, so that neighbouring sides share their corners exactly.
                mesh.vertices.push(p.map(|c| (c * 1024.0).round() / 1024.0));
            }
        }
        let at = |i: usize, j: usize| first + (j * (n + 1) + i) as u32;
        for j in 0..n {
            for i in 0..n {
                mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
                mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
            }
        }
    }
    mesh.paints = vec![Paint::Flat([200; 3]); mesh.triangles.len()];
    mesh
}

#[test]
fn no_ray_from_inside_a_closed_mesh_gets_out() {
    // Pixel centres, corners and edges fall on one another: 64 px over 90°.
    let image = Intrinsics::with_fields_of_view(65, 65, std::f64::consts::FRAC_PI_2, std::f64::consts::FRAC_PI_2);
    for n in [1, 8, 65] {
        let mesh = grid_cube(n);
        assert_eq!(mesh.open_edges(), 0);
        for (eye, target) in [
            (Point::origin(), Point::new(1.0, 0.0, 0.0)),
            (Point::origin(), Point::new(1.0, 1.0, 0.0)),
            (Point::new(0.25, 0.125, -0.5), Point::new(-1.0, 0.3, 0.9)),
        ] {
            let seen = Visibility::of(&mesh, &image, &look_at(eye, target));
            let missed = (0..image.pixels()).filter(|&k| seen.depth(k).is_none()).count();
            assert_eq!(missed, 0, "{n} squares from {eye}");
        }
    }
}

#[test]
fn depth_agrees_with_a_ray_caster_even_through_the_eye_plane() {
    let mesh = build(&deformed_prism()).unwrap();
    let image = camera(64, 48).depth;
    for (eye, target) in [
        (Point::new(0.5, 0.3, 0.2), Point::origin()),
        (Point::new(0.1, 0.9, -0.6), Point::origin()),
        // So close that the prism reaches behind the camera.
        (Point::new(0.102, 0.03, 0.0), Point::new(0.102, 1.0, 0.1)),
        (Point::origin(), Point::new(1.0, 0.2, 0.1)),
    ] {
        let world_from_camera = look_at(eye, target);
        let seen = Visibility::of(&mesh, &image, &world_from_camera);
        let mut differing = 0;
        for k in 0..image.pixels() {
            let ray = image.ray((k % 64) as f64 + 0.5, (k / 64) as f64 + 0.5);
            let truth = cast(&mesh, &eye, &(world_from_camera * ray));
            let agrees = match (truth, seen.depth(k)) {
                (Some(a), Some(b)) => (a - f64::from(b)).abs() < 1e-4,
                (a, b) => a.is_none() && b.is_none(),
            };
            differing += usize::from(!agrees);
        }
        assert_eq!(differing, 0, "from {eye}");
    }
}

#[test]
fn the_nearest_triangle_wins_and_its_face_is_told() {
    let mesh = grid_cube(2);
    let image = camera(33, 33).depth;
    let outside = Visibility::of(&mesh, &image, &look_at(Point::new(3.0, 0.0, 0.0), Point::origin()));
    let middle = 16 * 33 + 16;
    assert!((outside.depth(middle).unwrap() - 2.0).abs() < 1e-6);
    let facets = outside.facets();
    let facet = facets.at(middle).unwrap();
    assert!(facet.front);
    assert!((facet.cosine(&outside.ray(middle)) - 1.0).abs() < 1e-9);
    let ray = outside.ray(10 * 33 + 20);
    assert!((facets.at(10 * 33 + 20).unwrap().cosine(&ray) - 1.0 / ray.norm()).abs() < 1e-9);
    let inside = Visibility::of(&mesh, &image, &look_at(Point::origin(), Point::new(1.0, 0.0, 0.0)));
    assert!(!inside.facets().at(middle).unwrap().front);
}

#[test]
fn the_backdrop_is_met_from_inside() {
    let sphere = Backdrop {
        centre: Point::new(0.0, 0.0, 1.0),
        radius: 2.0,
        colour: [0; 3],
    };
    let (depth, cosine) = sphere.hit(&Vector::z()).unwrap();
    assert!((depth - 3.0).abs() < 1e-12 && (cosine - 1.0).abs() < 1e-12);
    let slanted = Vector::new(0.7, -0.2, 1.0);
    let (depth, _) = sphere.hit(&slanted).unwrap();
    assert!(((slanted * depth - sphere.centre.coords).norm() - 2.0).abs() < 1e-12);
    let far = Backdrop {
        centre: Point::new(0.0, 0.0, -9.0),
        ..sphere
    };
    assert_eq!(far.hit(&Vector::z()), None);
}
