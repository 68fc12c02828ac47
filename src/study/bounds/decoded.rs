//! Which markers each candidate view decodes: rendered, and read by the real detectors.

use rayon::prelude::*;

use crate::plan::{Existence, Options, PlanError, Session};
use crate::sense::{Noise, Simulator};
use crate::study::design::Variant;

/// By candidate view: which features it finds, were all of them there.
///
/// Whether a print is decoded is taken not to depend on the other prints.
#[derive(Clone, Debug)]
pub struct Decoded {
    /// By view, then by feature in the library's order.
    pub found: Vec<Vec<bool>>,
}

impl Decoded {
    /// Looks at an object from every candidate view, each time knowing nothing.
    /// `None` where no view finds anything.
    ///
    /// # Errors
    /// The planner refuses the task or a measurement.
    pub fn new(simulator: &Simulator, variant: &Variant) -> Result<Option<Self>, PlanError> {
        let fresh = Session::new(&variant.rules, &variant.task.name, Options::default())?;
        let camera = variant.task.camera;
        let found = (0..fresh.views().len()).into_par_iter().map(|view| {
            let mut session = fresh.clone();
            let pose = session.views()[view];
            let update = session.observe(view, &simulator.observe(&camera, &pose, Noise::None, 0, 1))?;
            Ok(update.features.iter().map(|f| f.state == Existence::Detected).collect())
        });
        let found: Vec<Vec<bool>> = found.collect::<Result<_, PlanError>>()?;
        let any = found.iter().flatten().any(|f| *f);
        Ok(any.then_some(Self { found }))
    }
}
