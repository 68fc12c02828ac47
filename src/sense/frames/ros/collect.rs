//! What the messages of a log say, put together as a recording.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::messages::{self, CameraInfo, Cloud, Compressed, Header, Image};
use super::{MOST_HELD, Message, cloud, cursor::Ended, images, tf::Tree};
use crate::geometry::{Intrinsics, Pose};
use crate::sense::frames::calibration::{Known, Pinhole, Stated};
use crate::sense::frames::error::FrameError;
use crate::sense::frames::frame::{Colour, Depth, Frame, Picture};
use crate::sense::frames::shots;
use crate::sense::frames::{Layout, Recording, Taken};
use crate::sense::{ColourImage, DepthImage};

/// Most seconds between a depth image and its colour image.
const APART: f64 = 0.05;

#[derive(Default)]
pub(super) struct Collection {
    depths: Vec<Shot>,
    colours: Vec<(Header, String, Arc<ColourImage>)>,
    /// By topic.
    cameras: BTreeMap<String, CameraInfo>,
    tree: Tree,
    held: usize,
    /// Topics of images in encodings that are not read.
    other: BTreeMap<String, String>,
    /// Clouds that are no depth images, with the reason for the first.
    unfit: Option<String>,
}

/// A depth image and, of a cloud, its own camera and colour.
struct Shot {
    header: Header,
    topic: String,
    depth: Arc<DepthImage>,
    cloud: Option<(Intrinsics, Option<Arc<ColourImage>>)>,
}

impl Collection {
    /// Takes a message in; what is wrong with it otherwise.
    pub fn take(&mut self, message: &Message) -> Result<(), String> {
        let (data, cdr, topic) = (message.data, message.cdr, message.topic);
        let wrong = |what: String| format!("in a message of `{topic}`: {what}");
        let ended = |_: Ended| wrong("it ends within its fields".to_owned());
        match message.kind {
            "sensor_msgs/PointCloud2" => self.cloud(&Cloud::read(data, cdr).map_err(ended)?, topic),
            "sensor_msgs/Image" => self
                .image(&Image::read(data, cdr).map_err(ended)?, topic)
                .map_err(wrong)?,
            "sensor_msgs/CompressedImage" => {
                let image = Compressed::read(data, cdr).map_err(ended)?;
                match images::unpack(&image).map_err(wrong)? {
                    Some(colour) => self.colour(image.header, topic, colour),
                    None => self.note_other(topic, &image.format),
                }
            }
            "sensor_msgs/CameraInfo" => {
                let info = CameraInfo::read(data, cdr).map_err(ended)?;
                self.cameras.entry(topic.to_owned()).or_insert(info);
            }
            "tf2_msgs/TFMessage" | "tf/tfMessage" => {
                let fixed = topic.ends_with("tf_static");
                for transform in messages::transforms(data, cdr).map_err(wrong)? {
                    self.tree.add(transform, fixed);
                }
            }
            _ => {}
        }
        match self.held > MOST_HELD {
            true => Err(format!(
                "its pictures take more than {} GiB; cut out the part that is needed",
                MOST_HELD >> 30
            )),
            false => Ok(()),
        }
    }

    fn cloud(&mut self, cloud: &Cloud, topic: &str) {
        match cloud::convert(cloud) {
            Ok(converted) => {
                self.held += converted.depth.metres.len() * 7;
                self.depths.push(Shot {
                    header: cloud.header.clone(),
                    topic: topic.to_owned(),
                    depth: Arc::new(converted.depth),
                    cloud: Some((converted.camera, converted.colour.map(Arc::new))),
                });
            }
            Err(why) => {
                self.unfit.get_or_insert(format!("`{topic}` has {why}"));
            }
        }
    }

    fn image(&mut self, image: &Image, topic: &str) -> Result<(), String> {
        match images::convert(image)? {
            images::Converted::Depth(depth) => {
                self.held += depth.metres.len() * 4;
                self.depths.push(Shot {
                    header: image.header.clone(),
                    topic: topic.to_owned(),
                    depth: Arc::new(depth),
                    cloud: None,
                });
            }
            images::Converted::Colour(colour) => self.colour(image.header.clone(), topic, colour),
            images::Converted::Other => self.note_other(topic, &image.encoding),
        }
        Ok(())
    }

    fn colour(&mut self, header: Header, topic: &str, colour: ColourImage) {
        self.held += colour.pixels.len() * 3;
        self.colours.push((header, topic.to_owned(), Arc::new(colour)));
    }

    fn note_other(&mut self, topic: &str, encoding: &str) {
        self.other
            .entry(topic.to_owned())
            .or_insert_with(|| encoding.to_owned());
    }

    /// The frames of one depth topic: clouds where there are no depth images.
    pub fn recording(mut self, path: &Path, layout: Layout, stated: &Stated) -> Result<Recording, FrameError> {
        self.tree.settle();
        self.colours.sort_by(|a, b| a.0.time.total_cmp(&b.0.time));
        let mut topics: Vec<&str> = self.depths.iter().map(|s| s.topic.as_str()).collect();
        topics.sort_unstable();
        topics.dedup();
        let images_first = |topic: &&&str| self.depths.iter().any(|s| s.topic == **topic && s.cloud.is_some());
        let Some(topic) = topics.iter().min_by_key(images_first).map(|t| (*t).to_owned()) else {
            return Err(FrameError::empty(path, self.why_empty()));
        };
        let mut notes: Vec<String> = topics
            .iter()
            .filter(|t| **t != topic)
            .map(|t| format!("`{t}` is left out; the frames are those of `{topic}`"))
            .collect();
        let shots: Vec<&Shot> = self.depths.iter().filter(|s| s.topic == topic).collect();
        let mut roots: Vec<&str> = Vec::new();
        let (mut frames, mut lost, mut taken) = (Vec::new(), 0, None);
        for shot in &shots {
            let placed = self.tree.root_of(&shot.header.frame, shot.header.time);
            let world_from_camera = match placed {
                Some((root, pose)) => {
                    roots.push(root);
                    pose
                }
                None if self.tree.is_empty() && shots.len() == 1 => Pose::identity(),
                None => {
                    lost += 1;
                    continue;
                }
            };
            let (frame, what) = self.frame(shot, world_from_camera, path, layout, stated, frames.len())?;
            taken.get_or_insert(what);
            frames.push(frame);
        }
        roots.dedup();
        match roots.as_slice() {
            [] if !frames.is_empty() => notes.push(format!(
                "one frame without tf: the axes of `{}` are the world",
                shots[0].header.frame
            )),
            [] => {}
            [root] => notes.push(format!(
                "the world is `{root}`, the root of the tf tree above `{}`",
                shots[0].header.frame
            )),
            _ => {
                return Err(FrameError::malformed(
                    path,
                    "its tf tree has another root now and then; keep one tree",
                ));
            }
        }
        if lost > 0 {
            notes.push(format!(
                "{lost} of {} depth images have no pose by tf within 0.1 s and are left out",
                shots.len()
            ));
        }
        let Some(taken) = taken else {
            let why = format!(
                "tf never says where `{}` is; record `/tf` and `/tf_static` too",
                shots[0].header.frame
            );
            return Err(FrameError::empty(path, why));
        };
        notes.extend(self.distortion());
        Ok(Recording {
            path: path.to_owned(),
            taken,
            frames,
            notes,
            max_depth: stated.max_depth(),
        })
    }

    fn frame(
        &self,
        shot: &Shot,
        world_from_camera: Pose,
        path: &Path,
        layout: Layout,
        stated: &Stated,
        number: usize,
    ) -> Result<(Frame, Taken), FrameError> {
        let size = [shot.depth.width, shot.depth.height];
        let own = match (&shot.cloud, self.info_of(&shot.topic, &shot.header.frame)) {
            (Some((camera, _)), _) => {
                let pinhole = Pinhole::of(camera.fx, camera.fy, camera.cx - 0.5, camera.cy - 0.5);
                Some(Known::new(pinhole, "by its points"))
            }
            (None, Some((topic, info))) => Some(Known::new(pinhole_of(info), topic)),
            (None, None) => None,
        };
        let known = stated.depth(size, own)?;
        let colour = match &shot.cloud {
            Some((_, colour)) => colour.clone().map(|image| Colour {
                picture: Picture::Held(image),
                camera: known.value,
                colour_from_depth: None,
            }),
            None => self.colour_of(shot, &known.value, path)?,
        };
        let depth_from_colour = colour
            .as_ref()
            .and_then(|c| c.colour_from_depth)
            .map(|p| Known::new(p.inverse(), "tf"));
        let taken = Taken {
            layout,
            colour: shots::described(colour.as_ref().map(|c| &c.camera), depth_from_colour.as_ref()),
            depth_scale: None,
            depth: known.clone(),
        };
        let frame = Frame {
            name: format!("{number}"),
            world_from_camera,
            depth_camera: known.value,
            depth: Depth::Held(shot.depth.clone()),
            colour,
        };
        Ok((frame, taken))
    }

    /// The colour image nearest in time and its camera.
    fn colour_of(&self, shot: &Shot, depth: &Intrinsics, path: &Path) -> Result<Option<Colour>, FrameError> {
        let time = shot.header.time;
        let after = self.colours.partition_point(|c| c.0.time < time);
        let near = self.colours[after.saturating_sub(1)..self.colours.len().min(after + 1)].iter();
        let nearest = near.min_by(|a, b| (a.0.time - time).abs().total_cmp(&(b.0.time - time).abs()));
        let Some((header, topic, image)) = nearest.filter(|c| (c.0.time - time).abs() <= APART) else {
            return Ok(None);
        };
        let size = [image.width, image.height];
        let same = header.frame == shot.header.frame;
        let own = self
            .info_of(topic, &header.frame)
            .map(|(_, info)| pinhole_of(info).sized(size));
        let wrong = |what: String| FrameError::malformed(path, format!("the CameraInfo of `{topic}`: {what}"));
        let camera = own
            .transpose()
            .map_err(wrong)?
            .or_else(|| shots::resized(depth, size).filter(|_| same));
        let between = self.tree.between(&header.frame, &shot.header.frame, time);
        Ok(camera.filter(|_| same || between.is_some()).map(|camera| Colour {
            picture: Picture::Held(image.clone()),
            camera,
            colour_from_depth: between.filter(|_| !same),
        }))
    }

    /// The CameraInfo beside a topic, or else of the same optical frame.
    fn info_of(&self, topic: &str, frame: &str) -> Option<(&str, &CameraInfo)> {
        let mut folder = topic;
        while let Some((above, _)) = folder.rsplit_once('/') {
            if let Some((name, info)) = self.cameras.get_key_value(&format!("{above}/camera_info")) {
                return Some((name, info));
            }
            folder = above;
        }
        self.cameras
            .iter()
            .find(|(_, info)| info.header.frame == frame)
            .map(|(name, info)| (name.as_str(), info))
    }

    fn distortion(&self) -> Option<String> {
        let distorting = self.cameras.iter().find(|(_, info)| info.distorts)?.0;
        Some(format!(
            "`{distorting}` states a lens that distorts, which is not undone; use rectified images"
        ))
    }

    fn why_empty(&self) -> String {
        if let Some(unfit) = &self.unfit {
            return unfit.clone();
        }
        match self.other.iter().next() {
            Some((topic, encoding)) => {
                format!("no image is depth; `{topic}` is `{encoding}`, and 16UC1 and 32FC1 are read")
            }
            None => "no message is a PointCloud2 or an Image of depth".to_owned(),
        }
    }
}

fn pinhole_of(info: &CameraInfo) -> Pinhole {
    let [width, height] = info.size.map(|side| Some(side).filter(|&s| s > 0));
    let [fx, _, cx, _, fy, cy, ..] = info.k;
    #[rustfmt::skip]
    let pinhole = Pinhole { width, height, fx, fy, cx, cy };
    pinhole
}
