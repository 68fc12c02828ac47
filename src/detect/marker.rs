//! `marker_pose`: one pose from all looks at a marker.

use nalgebra::{Matrix3, Rotation3, Translation3, UnitQuaternion};

use super::evidence::{Look, MarkerEvidence};
use crate::geometry::{Pose, Vector};

/// Looks farther than this from the middle one are left out, metres.
const APART: f64 = 0.03;
/// Looks turned farther than this from the middle one are left out, radians.
const TURNED: f64 = 0.2;

/// The weighted mean of the looks that agree with the middle one; `None` without looks.
pub fn marker_pose(evidence: &MarkerEvidence) -> Option<Pose> {
    let looks = &evidence.looks;
    let cost = |a: &Look| {
        looks
            .iter()
            .map(|b| disagreement(&a.pose, &b.pose).min(1.0))
            .sum::<f64>()
    };
    let middle = looks.iter().min_by(|a, b| cost(a).total_cmp(&cost(b)))?;
    let agree = |l: &&Look| disagreement(&l.pose, &middle.pose) <= 1.0;
    let (mut place, mut axes, mut total) = (Vector::zeros(), Matrix3::zeros(), 0.0);
    for look in looks.iter().filter(agree) {
        place += look.pose.translation.vector * look.weight;
        axes += look.pose.rotation.to_rotation_matrix().into_inner() * look.weight;
        total += look.weight;
    }
    if total <= 0.0 {
        return Some(middle.pose);
    }
    let rotation = Rotation3::from_matrix(&(axes / total));
    Some(Pose::from_parts(
        Translation3::from(place / total),
        UnitQuaternion::from_rotation_matrix(&rotation),
    ))
}

/// 1 at the largest difference that counts as agreement.
fn disagreement(a: &Pose, b: &Pose) -> f64 {
    let apart = (a.translation.vector - b.translation.vector).norm() / APART;
    apart.max(a.rotation.angle_to(&b.rotation) / TURNED)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_outlying_look_does_not_pull_the_mean() {
        let look = |x: f64, angle: f64| Look {
            pose: Pose::new(Vector::new(x, 0.0, 1.0), Vector::new(0.0, 0.0, angle)),
            weight: 1000.0,
        };
        let evidence = MarkerEvidence {
            looks: vec![look(0.002, 0.01), look(-0.002, -0.01), look(0.3, 1.0)],
            size: 0.2,
        };
        let pose = marker_pose(&evidence).unwrap();
        assert!(pose.translation.vector.x.abs() < 1e-9);
        assert!(pose.rotation.angle() < 1e-6);
    }
}
