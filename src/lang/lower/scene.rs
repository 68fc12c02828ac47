//! Scenes: backdrops, objects and the markers that they carry.

use super::expand::Env;
use super::{LoweredLibrary, Lowering, Mark};
use crate::geometry::{Pose, Rotation, Vector};
use crate::lang::diagnostics::{Code, Diagnostic};
use crate::lang::types::typed;
use crate::rules::{Backdrop, Marker, Scene, SceneObject, Value};

impl<'a> Lowering<'a> {
    /// A scene, and what its objects are marked as.
    pub(super) fn scene(&mut self, scene: &'a typed::Scene, libraries: &[LoweredLibrary]) -> (Scene, Vec<Mark>) {
        let backdrop = scene.backdrop.as_ref().and_then(|b| self.backdrop(b));
        let (mut objects, mut marks) = (Vec::new(), Vec::new());
        for object in &scene.objects {
            let Some(lowered) = self.object(object, libraries) else {
                continue;
            };
            marks.extend(object.marked.as_ref().map(|marked| Mark {
                object: objects.len(),
                library: marked.library,
                layout: marked.layout,
                class: marked.class,
                span: marked.span,
            }));
            objects.push(lowered);
        }
        let scene = Scene {
            name: scene.name.clone(),
            backdrop,
            objects,
            place: self.place(scene.span),
        };
        (scene, marks)
    }

    pub(super) fn backdrop(&mut self, backdrop: &'a typed::Expr) -> Option<Backdrop> {
        let call = self.primitive(backdrop, &Env::default())?;
        Some(Backdrop {
            radius: call.length("radius").ok()?,
            colour: call.colour("colour").ok()?,
        })
    }

    fn object(&mut self, object: &'a typed::Object, libraries: &[LoweredLibrary]) -> Option<SceneObject> {
        let shape = self.primitive(&object.shape, &Env::default());
        let at = self.value(&object.at, &Env::default());
        let yaw = object.turned.as_ref().map(|t| self.value(t, &Env::default()));
        let markers = match &object.marked {
            None => Some(Vec::new()),
            Some(marked) => self.markers(marked, libraries),
        };
        let (Value::Point(at), Ok(yaw)) = (at?, angle(yaw)) else {
            return None;
        };
        Some(SceneObject {
            name: object.name.clone(),
            shape: shape?,
            world_from_object: Pose::from_parts(at.coords.into(), Rotation::from_axis_angle(&Vector::z_axis(), yaw)),
            markers: markers?,
            place: self.place(object.span),
        })
    }

    /// A print for every marker that the class has, where the layout puts it. What a
    /// library lacks is said where that library is whole otherwise.
    fn markers(&mut self, marked: &'a typed::Marked, libraries: &[LoweredLibrary]) -> Option<Vec<Marker>> {
        let LoweredLibrary {
            library,
            layouts,
            whole,
        } = libraries.get(marked.library)?;
        let class = library.classes.get(marked.class)?;
        let mut out = Vec::new();
        for (feature, object_from_marker, _) in &layouts.get(marked.layout)?.as_ref()?.places {
            if !class.presence.has(*feature) {
                continue;
            }
            let print = library
                .rules
                .iter()
                .filter(|r| r.consequent == *feature)
                .find_map(|r| Some((r.detect.text("text").ok()?, r.detect.length("size").ok()?)));
            let Some((text, size)) = print else {
                if !whole {
                    return None;
                }
                let name = &library.feature(*feature).name;
                let message = format!("no rule says what is printed on `{name}`");
                // Once, however many objects bear it.
                if !self.found.iter().any(|d| d.code == Code::E0502 && d.message == message) {
                    let help = "detect it with `qr(text: …, size: …)`";
                    self.report(Diagnostic::new(Code::E0502, marked.span, message).help(help));
                }
                return None;
            };
            out.push(Marker {
                text: text.to_owned(),
                size,
                object_from_marker: *object_from_marker,
            });
        }
        Some(out)
    }
}

/// No turn is a turn of zero.
fn angle(yaw: Option<Option<Value>>) -> Result<f64, ()> {
    match yaw {
        None => Ok(0.0),
        Some(Some(Value::Angle(yaw))) => Ok(yaw),
        Some(_) => Err(()),
    }
}
