//! No ray gets out of a closed surface, wherever its corners and edges fall.

use proptest::prelude::*;

use super::*;

/// A cube's surface with every corner pulled along its ray from the centre.
fn star(n: usize, factors: &[f64]) -> Mesh {
    let mut mesh = welded(grid_cube(n));
    for (k, p) in mesh.vertices.iter_mut().enumerate() {
        *p = Point::from(p.coords * factors[k % factors.len()]);
    }
    mesh
}

/// The mesh with corners at the same place made one.
fn welded(mut mesh: Mesh) -> Mesh {
    let all = mesh.vertices.clone();
    let first = |i: u32| all.iter().position(|p| *p == all[i as usize]).unwrap() as u32;
    for triangle in &mut mesh.triangles {
        *triangle = triangle.map(first);
    }
    mesh
}

/// A camera at the centre: along an axis, where corners fall on pixel centres
/// if the image is as fine as the grid, or anyhow.
fn poses() -> impl Strategy<Value = Pose> {
    let targets = prop_oneof![
        Just([1.0, 0.0, 0.0]),
        Just([0.0, 0.0, -1.0]),
        Just([1.0, 1.0, 0.0]),
        Just([1.0, 1.0, 1.0]),
        prop::array::uniform3(-1.0..1.0),
    ];
    targets
        .prop_filter("a direction", |t: &[f64; 3]| Vector::from(*t).norm() > 0.1)
        .prop_map(|t| look_at(Point::origin(), Point::from(t)))
}

/// 90° wide; pixel centres are shifted by none, a half or some of a pixel.
fn images(n: usize) -> impl Strategy<Value = Intrinsics> {
    let sizes = prop_oneof![Just(n as u32), Just(2 * n as u32 + 1), 1..70_u32];
    let shift = prop_oneof![Just(0.0), Just(0.5), -1.0..1.0];
    (sizes, shift).prop_map(|(size, shift)| {
        let half = f64::from(size) / 2.0;
        Intrinsics {
            width: size,
            height: size,
            fx: half,
            fy: half,
            cx: half + shift,
            cy: half + shift,
        }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]
    #[test]
    fn no_ray_from_inside_a_star_gets_out(
        (n, image) in (1..9_usize).prop_flat_map(|n| (Just(n), images(n))),
        factors in prop::collection::vec(prop_oneof![Just(1.0), 0.3..3.0, 1e-3..1e-2], 1..40),
        pose in poses(),
    ) {
        let mesh = star(n, &factors);
        let seen = Visibility::of(&mesh, &image, &pose);
        let missed: Vec<usize> = (0..image.pixels()).filter(|&k| seen.depth(k).is_none()).collect();
        prop_assert!(missed.is_empty(), "{missed:?}");
    }

    /// From outside, every ray aimed exactly at a corner or at the middle of an
    /// edge of a surface that fills the view meets it.
    #[test]
    fn rays_aimed_at_corners_and_edges_meet_a_plane(
        depths in prop::collection::vec(0.05..4.0, 81),
        place in prop::array::uniform3(-1.0..1.0),
        half in any::<bool>(),
    ) {
        // Corners 8 px apart on pixel centres or, halved, on the borders between.
        let image = Intrinsics { width: 64, height: 64, fx: 50.0, fy: 50.0, cx: 32.0, cy: 32.0 };
        let pose = look_at(Point::from(place), Point::new(3.0, 2.0, 1.0));
        let off = if half { 0.0 } else { 0.5 };
        let corner = |k: usize| {
            let (i, j) = ((k % 9) as f64, (k / 9) as f64);
            pose * Point::from(image.ray(8.0 * i + off, 8.0 * j + off) * depths[k])
        };
        let mut mesh = Mesh { vertices: (0..81).map(corner).collect(), ..Mesh::default() };
        for k in (0..72).filter(|k| k % 9 < 8) {
            mesh.triangles.extend([[k, k + 1, k + 10], [k, k + 10, k + 9]]);
        }
        mesh.paints = vec![Paint::Flat([9; 3]); mesh.triangles.len()];
        let seen = Visibility::of(&mesh, &image, &pose);
        // The border of the sheet is the border of the image, give or take a step of the grid.
        let missed = (1..63).flat_map(|v| (1..63).map(move |u| v * 64 + u)).filter(|&k| seen.depth(k).is_none());
        prop_assert_eq!(missed.count(), 0);
    }
}
