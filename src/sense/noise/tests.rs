use super::*;

const RANGE: DepthRange = DepthRange { min: 0.5, max: 4.5 };

/// An image of 100 by 100 pixels at one incidence.
fn measured(truth: Vec<f32>, degrees: f64, seed: u64, n: u32) -> Vec<f32> {
    Noise::StructuredLight.apply(truth, 100, |_| degrees.to_radians(), RANGE, seed, n)
}

fn wall(depth: f32) -> Vec<f32> {
    vec![depth; 100 * 100]
}

fn lost(image: &[f32]) -> f64 {
    image.iter().filter(|&&z| z == 0.0).count() as f64 / image.len() as f64
}

#[test]
fn the_spread_on_a_wall_is_the_published_one() {
    for (z, expected) in [(1.0, 0.001884), (2.0, 0.006064)] {
        let image = measured(wall(z), 0.0, 1, 0);
        let read: Vec<f64> = image.iter().filter(|&&x| x > 0.0).map(|&x| f64::from(x)).collect();
        let mean = read.iter().sum::<f64>() / read.len() as f64;
        let spread = (read.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / read.len() as f64).sqrt();
        assert!((mean - f64::from(z)).abs() < 3e-4, "{mean}");
        assert!((spread / expected - 1.0).abs() < 0.05, "{spread}");
    }
    assert!((axial(1.0, 1.2) - (0.001884 + 0.0001 * 1.44 / 0.13751_f64)).abs() < 1e-5);
}

#[test]
fn readings_fade_at_grazing_incidence() {
    let share = |degrees| lost(&measured(wall(1.0), degrees, 1, 0));
    assert!(share(0.0) < 0.01);
    assert!((share(76.0) - 0.5).abs() < 0.03);
    assert_eq!(share(83.0), 1.0);
}

#[test]
fn readings_are_lost_beside_depth_edges() {
    let mut step = wall(1.0);
    for (k, reading) in step.iter_mut().enumerate() {
        if k % 100 >= 50 {
            *reading = 2.0;
        }
    }
    let image = measured(step, 0.0, 1, 0);
    let column = |u: usize| lost(&(0..100).map(|v| image[v * 100 + u]).collect::<Vec<_>>());
    assert!(column(49) > 0.2 && column(50) > 0.2 && column(20) < 0.05);
}

#[test]
fn noise_repeats_by_seed_and_view() {
    let apply = |seed, n| measured(wall(1.0), 30.0, seed, n);
    assert_eq!(apply(5, 2), apply(5, 2));
    assert_ne!(apply(5, 2), apply(5, 3));
    assert_ne!(apply(5, 2), apply(6, 2));
    let clean = Noise::None.apply(wall(1.25), 100, |_| 1.4, RANGE, 0, 0);
    assert_eq!(clean, wall(1.25));
}

#[test]
fn names_are_known_announced_or_refused() {
    assert_eq!("structured_light".parse(), Ok(Noise::StructuredLight));
    assert_eq!("none".parse(), Ok(Noise::None));
    let stereo = "stereo".parse::<Noise>().unwrap_err();
    assert_eq!(
        stereo.to_string(),
        "noise `stereo` is not available yet; known: `none`, `structured_light`"
    );
    assert!(matches!("gauss".parse::<Noise>(), Err(UnknownNoise::Unknown(_))));
}
