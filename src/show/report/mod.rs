//! The run report: one HTML page that shows a run and opens offline.
//!
//! What was seen, predicted and decided is gathered a view at a time from the
//! session, as plain data; the page's script draws it. The page holds everything
//! that it needs, its drawing library included, and its policy forbids it to load
//! anything. It writes nothing itself.

mod picture;
mod scene;

use plotly::Plot;
use serde::Serialize;

use self::picture::Picture;
use self::scene::{Face, Place, Space, Surface};
use super::log;
use crate::plan::{Session, Step};

/// A report in the making.
pub struct Report {
    head: log::Start,
    space: Space,
    /// Candidate views, metres.
    candidates: Vec<[f64; 3]>,
    surface: Surface,
    frames: Vec<Frame>,
}

/// What one measurement changed, and what it led to.
#[derive(Serialize)]
struct Frame {
    /// The record of the run log.
    view: log::View,
    /// The line that a terminal shows.
    line: String,
    /// Unvisited views and what each gains.
    gains: Vec<(usize, f64)>,
    /// Measured instances.
    found: Vec<Face>,
    /// Predicted instances.
    predicted: Vec<Place>,
    /// What the camera saw; `None` where it could not be drawn.
    picture: Option<Picture>,
}

/// All that the page draws.
#[derive(Serialize)]
struct Data<'a> {
    head: &'a log::Start,
    end: Option<&'a log::End>,
    space: &'a Space,
    candidates: &'a [[f64; 3]],
    surface: scene::Drawn,
    frames: &'a [Frame],
}

impl Report {
    /// The report of a run before its first measurement.
    pub fn begin(head: log::Start, session: &Session) -> Self {
        let eyes = session.views().iter().map(|pose| pose.translation.vector.into());
        Self {
            space: Space::of(session.map().grid()),
            candidates: eyes.collect(),
            surface: Surface::default(),
            frames: Vec::new(),
            head,
        }
    }

    /// Takes in a measurement: the session as it stands after it.
    pub fn view(&mut self, session: &Session, step: &Step, ms: log::Milliseconds) {
        let view = log::View::of(step, ms);
        let found = scene::found(session);
        let picture = Picture::of(
            &step.observation,
            &found,
            self.frames.last().map(|f| f.found.as_slice()),
        );
        self.surface.update(session.map(), &step.observation, self.frames.len());
        self.frames.push(Frame {
            line: super::view_line(self.frames.last().map(|f| &f.view), &view),
            gains: session.gains(),
            predicted: scene::predicted(session),
            found,
            picture,
            view,
        });
    }

    /// The page. `end` is `None` where the run was cut off.
    pub fn page(&self, end: Option<&log::End>) -> String {
        let data = Data {
            head: &self.head,
            end,
            space: &self.space,
            candidates: &self.candidates,
            surface: self.surface.drawn(),
            frames: &self.frames,
        };
        let data = serde_json::to_string(&data).unwrap_or_else(|error| unreachable!("a report is plain data: {error}"));
        include_str!("page.html")
            .replace("/* style */", include_str!("style.css"))
            .replace("<!-- library -->", &library())
            .replace("/* data */", &within_script(&data))
            .replace("/* script */", include_str!("page.js"))
    }
}

/// The drawing library as a script element; of what its crate brings, the first.
fn library() -> String {
    const END: &str = "</script>";
    let scripts = Plot::offline_js_sources();
    let end = scripts.find(END).map_or(scripts.len(), |at| at + END.len());
    scripts[..end].to_owned()
}

/// JSON that cannot end the element that it stands in.
fn within_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_is_one_whole_script() {
        let script = library();
        assert!(script.starts_with("<script") && script.ends_with("</script>"));
        assert_eq!(script.matches("</script>").count(), 1);
        assert!(script.contains("plotly.js"));
    }

    #[test]
    fn no_name_ends_the_script_that_holds_it() {
        let held = within_script(r#"{"file":"</script><b>.vpl"}"#);
        assert!(!held.contains('<'));
        let back: serde_json::Value = serde_json::from_str(&held).unwrap();
        assert_eq!(back["file"], "</script><b>.vpl");
    }
}
