//! Shapes for scenes, and their deformations.

use super::{Parameter, Primitive, Type};
use crate::rules::{Colour, Value};

const SIDES: Parameter = Parameter::required("sides", Type::Count, "Sides of the base, 3 to 12.");
const RADIUS: Parameter = Parameter::required(
    "radius",
    Type::Length,
    "Radius of the circle through the base's corners.",
);
const HEIGHT: Parameter = Parameter::required("height", Type::Length, "Height.");
const STRETCH: Parameter = Parameter::or(
    "stretch",
    Type::Number,
    || Value::Number(1.0),
    "Factor on the base along x.",
);
const LEAN: Parameter = Parameter::or(
    "lean",
    Type::Angle,
    || Value::Angle(0.0),
    "How far the axis leans towards +x.",
);
const DEFORMED: Parameter =
    Parameter::optional("deformed", Type::List(&Type::Deformation), "Dents, bumps and notches.");
const BOTTOM: Parameter = Parameter::or(
    "bottom",
    Type::Colour,
    || Value::Colour(Colour([200, 30, 30])),
    "Colour of the bottom.",
);
const GREEN_SIDE: Parameter = Parameter::or(
    "side",
    Type::Colour,
    || Value::Colour(Colour([30, 160, 50])),
    "Colour of the sides.",
);
const BLUE_SIDE: Parameter = Parameter::or(
    "side",
    Type::Colour,
    || Value::Colour(Colour([40, 70, 200])),
    "Colour of the sides.",
);
const TOP: Parameter = Parameter::or(
    "top",
    Type::Colour,
    || Value::Colour(Colour([200, 200, 200])),
    "Colour of the top.",
);

const fn face(name: &'static str, doc: &'static str) -> Parameter {
    Parameter::optional(name, Type::Colour, doc)
}

pub(super) const ALL: &[Primitive] = &[
    Primitive {
        name: "box",
        result: Type::Shape,
        features: &[],
        parameters: &[
            Parameter::required("width", Type::Length, "Size along x."),
            Parameter::required("depth", Type::Length, "Size along y."),
            Parameter::required("height", Type::Length, "Size along z."),
            Parameter::or(
                "colour",
                Type::Colour,
                || Value::Colour(Colour([200, 200, 200])),
                "Colour of every face that has none of its own.",
            ),
            face("front", "Colour of the face towards +x."),
            face("back", "Colour of the face towards -x."),
            face("left", "Colour of the face towards +y."),
            face("right", "Colour of the face towards -y."),
            face("top", "Colour of the face towards +z."),
            face("bottom", "Colour of the face towards -z."),
        ],
        doc: "A box, origin at its middle, with a colour of its own for any face.",
    },
    Primitive {
        name: "prism",
        result: Type::Shape,
        features: &[],
        parameters: &[
            SIDES,
            RADIUS,
            HEIGHT,
            STRETCH,
            LEAN,
            Parameter::or(
                "taper",
                Type::Angle,
                || Value::Angle(0.0),
                "How far each side leans inwards; negative: outwards.",
            ),
            DEFORMED,
            BOTTOM,
            GREEN_SIDE,
            TOP,
        ],
        doc: "A prism that stands on its bottom, origin at the centre of its height.\n\nSides are numbered from 1, counter-clockwise from above, side 1 facing +x. All sides have one colour: a box with one coloured side is a `box`.",
    },
    Primitive {
        name: "pyramid",
        result: Type::Shape,
        features: &[],
        parameters: &[SIDES, RADIUS, HEIGHT, STRETCH, LEAN, DEFORMED, BOTTOM, BLUE_SIDE],
        doc: "A pyramid that stands on its bottom, origin at the centre of its height.",
    },
    Primitive {
        name: "tank",
        result: Type::Shape,
        features: &[],
        parameters: &[
            Parameter::or("length", Type::Length, || Value::Length(0.90), "Length of the hull."),
            Parameter::or("width", Type::Length, || Value::Length(0.60), "Width over the tracks."),
            Parameter::or(
                "turret",
                Type::Length,
                || Value::Length(0.44),
                "Diameter of the turret.",
            ),
            Parameter::or("gun", Type::Length, || Value::Length(0.35), "Length of the gun."),
            Parameter::or(
                "colour",
                Type::Colour,
                || Value::Colour(Colour([84, 98, 60])),
                "Colour of the hull.",
            ),
        ],
        doc: "A tank: hull, turret, gun and tracks; the gun points along +x.\n\nThe origin lies on the ground under the hull's middle, +y is its left. Heights go with the width. The default has flat places for seven 276 mm plates: front, rear, two on each skirt, rear deck and turret roof.",
    },
    Primitive {
        name: "mesh",
        result: Type::Shape,
        features: &[],
        parameters: &[
            Parameter::required(
                "file",
                Type::Text,
                "An STL, OBJ, PLY, glTF or GLB file, relative to the program.",
            ),
            Parameter::optional(
                "units",
                Type::Choice(&["mm", "cm", "m", "in"]),
                "What one unit of the file is; glTF says so itself.",
            ),
            Parameter::optional(
                "up",
                Type::Choice(&["x", "y", "z"]),
                "Which axis of the file points up; glTF says so itself.",
            ),
        ],
        doc: "A triangle mesh from a file, with its colours.\n\nColours are those of the file where it has any: of its vertices or faces (PLY, OBJ), materials and textures (glTF, OBJ); else it is grey.",
    },
    Primitive {
        name: "dent",
        result: Type::Deformation,
        features: &[],
        parameters: DEFORMATION,
        doc: "A pocket pressed into a side; its walls lean 8° from the side's normal.",
    },
    Primitive {
        name: "bump",
        result: Type::Deformation,
        features: &[],
        parameters: DEFORMATION,
        doc: "A block that stands out of a side; its walls lean 8° from the side's normal.",
    },
    Primitive {
        name: "notch",
        result: Type::Deformation,
        features: &[],
        parameters: &[
            Parameter::required("side", Type::Count, "The side that it is cut into."),
            Parameter::or(
                "at",
                Type::Share,
                || Value::Share(0.5),
                "Where along the side its middle lies.",
            ),
            Parameter::required("width", Type::Length, "Its width."),
            Parameter::required("depth", Type::Length, "Its depth."),
        ],
        doc: "A groove over the whole height of a side; on a pyramid it narrows towards the apex.",
    },
];

const DEFORMATION: &[Parameter] = &[
    Parameter::required("side", Type::Count, "The side; 0 is the bottom."),
    Parameter::or(
        "across",
        Type::Share,
        || Value::Share(0.5),
        "Where along the side's width its middle lies.",
    ),
    Parameter::or(
        "up",
        Type::Share,
        || Value::Share(0.5),
        "Where along the side's height its middle lies.",
    ),
    Parameter::required("width", Type::Length, "Its width."),
    Parameter::required("height", Type::Length, "Its height."),
    Parameter::required("depth", Type::Length, "How far it goes in or out."),
];
