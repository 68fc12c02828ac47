//! Small suites: coarse maps, small images, few views.

/// Reconstruction of two solids, with the program in the same file.
pub const SOLIDS: &str = r#"vpl 1

use std.detect.coloured_plane
use std.views.sphere

library boxes {
  feature bottom : polygon
  class box { bottom }
  rule -> bottom {
    detect  coloured_plane(red)
    measure outline()
  }
}

let small = rgbd_camera(
  depth: [128, 106], depth_fov: [70.6 deg, 60 deg], colour: [128, 106], colour_fov: [70.6 deg, 60 deg],
  nearest: 500 mm, farthest: 4.5 m,
)

task reconstruct {
  library    boxes
  goal       exhausted
  camera     small
  space      cube(600 mm) at [0 mm, 0 mm, 300 mm] voxel 20 mm
  views      sphere(radius: 1.4 m, count: 12)
  thresholds { near: 20 mm, absent: 95 %, confidence: 99 % }
  limit      6 views
}

scene bench {
  backdrop sphere(radius: 2 m, colour: grey)
  object crate = prism(sides: 4, radius: 150 mm, height: 280 mm) at [0 mm, 0 mm, 300 mm] turned 20 deg
  object spire = pyramid(sides: 3, radius: 180 mm, height: 240 mm) at [0 mm, 0 mm, 300 mm]
}

study solids {
  objects crate, spire
  methods gn, random
  starts 4
  published "table.csv"
}
"#;

/// Boxes told apart by two codes.
pub const TANKS: &str = r#"vpl 1

use std.cameras.kinect_v2
use std.markers.large_qr
use std.views.sphere

library boxes {
  feature code[1..3] : marker

  classes by code[1..3] {
    front 1 0 1
    back  0 1 1
    both  1 1 1
  }

  rule -> code[i] {
    detect  large_qr("b{i}")
    measure marker_pose()
  }

  layout sides {
    code[1] at [202 mm, 0 mm, 0 mm] facing +x
    code[2] at [-202 mm, 0 mm, 0 mm] facing -x
    code[3] at [0 mm, 202 mm, 0 mm] facing +y
  }
}

task recognise {
  library    boxes
  goal       confident
  camera     kinect_v2
  space      cube(700 mm) at [0 mm, 0 mm, 350 mm] voxel 20 mm
  views      sphere(radius: 1.4 m, count: 10)
  thresholds { near: 40 mm, absent: 90 %, confidence: 99 % }
  limit      5 views
}

scene bench {
  object front = prism(sides: 4, radius: 283 mm, height: 400 mm) at [0 mm, 0 mm, 350 mm] marked boxes.sides as front
  object both  = prism(sides: 4, radius: 283 mm, height: 400 mm) at [0 mm, 0 mm, 350 mm] marked boxes.sides as both
  object stranger = prism(sides: 4, radius: 283 mm, height: 400 mm) at [0 mm, 0 mm, 350 mm]
}
"#;

/// A suite in a file of its own.
pub const RECOGNITION: &str = r#"vpl 1

study recognition {
  program "boxes.vpl"
  methods gn, random
  starts 2
}
"#;
