//! ROS logs written by hand: bags of ROS 1 and MCAP files in CDR.

use std::collections::BTreeMap;
use std::fs;
use std::io::Cursor;
use std::path::Path;

use vpl::geometry::Pose;
use vpl::sense::Observation;

use crate::scene::raw;

/// A message of a log.
pub struct Message {
    pub topic: &'static str,
    pub kind: &'static str,
    pub data: Vec<u8>,
}

/// Fields in ROS 1's form, or aligned as CDR has them.
struct Fields {
    bytes: Vec<u8>,
    cdr: bool,
}

impl Fields {
    fn new(cdr: bool) -> Self {
        Self { bytes: Vec::new(), cdr }
    }

    fn put(&mut self, bytes: &[u8]) -> &mut Self {
        if self.cdr {
            self.bytes.resize(self.bytes.len().next_multiple_of(bytes.len()), 0);
        }
        self.bytes.extend(bytes);
        self
    }

    fn u32(&mut self, n: u32) -> &mut Self {
        self.put(&n.to_le_bytes())
    }

    fn f64(&mut self, x: f64) -> &mut Self {
        self.put(&x.to_le_bytes())
    }

    fn string(&mut self, text: &str) -> &mut Self {
        self.u32(text.len() as u32 + u32::from(self.cdr));
        self.bytes.extend(text.as_bytes());
        self.bytes.extend(if self.cdr { &[0][..] } else { &[] });
        self
    }

    fn blob(&mut self, bytes: &[u8]) -> &mut Self {
        self.u32(bytes.len() as u32);
        self.bytes.extend(bytes);
        self
    }

    fn header(&mut self, k: usize, frame: &str) -> &mut Self {
        if !self.cdr {
            self.u32(k as u32);
        }
        self.u32(100 + k as u32).u32(500).string(frame)
    }

    fn done(&mut self) -> Vec<u8> {
        let head: &[u8] = if self.cdr { &[0, 1, 0, 0] } else { &[] };
        [head, &self.bytes].concat()
    }
}

/// Depth as `16UC1`, colour as `rgb8`, CameraInfo and tf of frames.
pub fn images(frames: &[Observation], cdr: bool, pose: impl Fn(&Pose) -> Pose) -> Vec<Message> {
    let mut messages = vec![tf(
        "/tf_static",
        0,
        ("base", "camera_link"),
        &Pose::translation(0.1, 0.2, 0.3),
        cdr,
    )];
    let base_from_link = Pose::translation(0.1, 0.2, 0.3);
    for (k, frame) in frames.iter().enumerate() {
        let world_from_camera = pose(&frame.world_from_camera);
        let world_from_base = world_from_camera * base_from_link.inverse();
        messages.push(tf("/tf", k, ("map", "base"), &world_from_base, cdr));
        let info = camera_info(k, frame, cdr);
        messages.push(Message {
            topic: "/camera/depth/camera_info",
            kind: "sensor_msgs/CameraInfo",
            data: info,
        });
        let depth: Vec<u8> = raw(frame, 1000.0).iter().flat_map(|z| z.to_le_bytes()).collect();
        let size = [frame.depth.width, frame.depth.height];
        messages.push(Message {
            topic: "/camera/depth/image_rect",
            kind: "sensor_msgs/Image",
            data: image(k, size, "16UC1", 2, &depth, cdr),
        });
        let colour = image(k, size, "rgb8", 3, frame.colour.pixels.as_flattened(), cdr);
        messages.push(Message {
            topic: "/camera/rgb/image_rect_color",
            kind: "sensor_msgs/Image",
            data: colour,
        });
    }
    messages
}

fn image(k: usize, [width, height]: [u32; 2], encoding: &str, bytes: u32, data: &[u8], cdr: bool) -> Vec<u8> {
    let mut f = Fields::new(cdr);
    f.header(k, "camera_link")
        .u32(height)
        .u32(width)
        .string(encoding)
        .put(&[0])
        .u32(width * bytes)
        .blob(data)
        .done()
}

fn camera_info(k: usize, frame: &Observation, cdr: bool) -> Vec<u8> {
    let c = &frame.camera.depth;
    let mut f = Fields::new(cdr);
    f.header(k, "camera_link")
        .u32(c.height)
        .u32(c.width)
        .string("plumb_bob")
        .u32(5);
    for _ in 0..5 {
        f.f64(0.0);
    }
    // K, R and P; OpenCV counts pixels from their centres.
    let (cx, cy) = (c.cx - 0.5, c.cy - 0.5);
    let k = [c.fx, 0.0, cx, 0.0, c.fy, cy, 0.0, 0.0, 1.0];
    let p = [c.fx, 0.0, cx, 0.0, 0.0, c.fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0];
    k.iter()
        .chain(&[1., 0., 0., 0., 1., 0., 0., 0., 1.])
        .chain(&p)
        .for_each(|x| {
            f.f64(*x);
        });
    f.done()
}

fn tf(topic: &'static str, k: usize, (parent, child): (&str, &str), pose: &Pose, cdr: bool) -> Message {
    let (t, q) = (&pose.translation.vector, &pose.rotation);
    let mut f = Fields::new(cdr);
    f.u32(1).header(k, parent).string(child);
    for x in [t.x, t.y, t.z, q.i, q.j, q.k, q.w] {
        f.f64(x);
    }
    Message {
        topic,
        kind: "tf2_msgs/TFMessage",
        data: f.done(),
    }
}

/// An organised cloud of a frame, NaN where there is no reading, with packed colour.
pub fn cloud(frame: &Observation) -> Message {
    let (w, h) = (frame.depth.width, frame.depth.height);
    let mut data = Vec::new();
    for (v, u) in (0..h).flat_map(|v| (0..w).map(move |u| (v, u))) {
        let ray = frame.camera.depth.ray(f64::from(u) + 0.5, f64::from(v) + 0.5);
        let point = frame.depth.at(u, v).map(|z| ray * z);
        for k in 0..3 {
            data.extend((point.map_or(f32::NAN, |p| p[k] as f32)).to_le_bytes());
        }
        let [r, g, b] = frame.colour.at(u, v);
        data.extend([b, g, r, 0]);
    }
    let mut f = Fields::new(false);
    f.header(0, "camera_link").u32(h).u32(w).u32(4);
    for (k, name) in ["x", "y", "z", "rgb"].iter().enumerate() {
        f.string(name).u32(4 * k as u32).put(&[7]).u32(1);
    }
    f.put(&[0]).u32(16).u32(16 * w).blob(&data).put(&[0]);
    Message {
        topic: "/points",
        kind: "sensor_msgs/PointCloud2",
        data: f.done(),
    }
}

/// Writes an uncompressed bag.
pub fn write_bag(path: &Path, messages: &[Message]) {
    let mut connections: BTreeMap<&str, (u32, &str)> = BTreeMap::new();
    for message in messages {
        let id = connections.len() as u32;
        connections.entry(message.topic).or_insert((id, message.kind));
    }
    let connection = |topic: &str, (id, kind): (u32, &str)| {
        let md5 = "0".repeat(32);
        let inner = [
            field("topic", topic.as_bytes()),
            field("type", kind.as_bytes()),
            field("md5sum", md5.as_bytes()),
            field("message_definition", b""),
        ]
        .concat();
        record(
            &[
                field("op", &[7]),
                field("conn", &id.to_le_bytes()),
                field("topic", topic.as_bytes()),
            ],
            &inner,
        )
    };
    let all: Vec<u8> = connections
        .iter()
        .flat_map(|(topic, c)| connection(topic, *c))
        .collect();
    let mut chunk = all.clone();
    for m in messages {
        let id = connections[m.topic].0.to_le_bytes();
        chunk.extend(record(
            &[field("op", &[2]), field("conn", &id), field("time", &[0; 8])],
            &m.data,
        ));
    }
    let head = [
        field("op", &[5]),
        field("compression", b"none"),
        field("size", &(chunk.len() as u32).to_le_bytes()),
    ];
    let chunk = record(&head, &chunk);
    let magic = b"#ROSBAG V2.0\n";
    let header = |index: u64| {
        let count = (connections.len() as u32).to_le_bytes();
        let fields = [
            field("chunk_count", &1_u32.to_le_bytes()),
            field("conn_count", &count),
            field("index_pos", &index.to_le_bytes()),
            field("op", &[3]),
        ];
        let padding = vec![b' '; 4096 - 8 - fields.concat().len()];
        record(&fields, &padding)
    };
    let index = (magic.len() + 4096 + chunk.len()) as u64;
    fs::write(path, [&magic[..], &header(index), &chunk, &all].concat()).unwrap();
}

fn field(name: &str, value: &[u8]) -> Vec<u8> {
    let text = [name.as_bytes(), b"=", value].concat();
    [&(text.len() as u32).to_le_bytes()[..], &text].concat()
}

fn record(header: &[Vec<u8>], data: &[u8]) -> Vec<u8> {
    let header = header.concat();
    let (h, d) = ((header.len() as u32).to_le_bytes(), (data.len() as u32).to_le_bytes());
    [&h[..], &header, &d, data].concat()
}

/// Writes an MCAP file of ROS 2 messages, uncompressed.
pub fn write_mcap(path: &Path, messages: &[Message]) {
    let mut bytes = Vec::new();
    let options = mcap::WriteOptions::new().compression(None).profile("ros2");
    let mut writer = options.create(Cursor::new(&mut bytes)).unwrap();
    let mut channels: BTreeMap<&str, u16> = BTreeMap::new();
    for (n, message) in messages.iter().enumerate() {
        let id = *channels.entry(message.topic).or_insert_with(|| {
            let name = message.kind.replace('/', "/msg/");
            let schema = writer.add_schema(&name, "ros2msg", b"").unwrap();
            writer
                .add_channel(schema, message.topic, "cdr", &BTreeMap::new())
                .unwrap()
        });
        let header = mcap::records::MessageHeader {
            channel_id: id,
            sequence: n as u32,
            log_time: n as u64,
            publish_time: n as u64,
        };
        writer.write_to_known_channel(&header, &message.data).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    fs::write(path, bytes).unwrap();
}
