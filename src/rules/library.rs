//! Libraries: features, candidate classes and rules (paper, section 3.1).

use std::fmt;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::artefact::hex;
use super::{Call, Place};

/// Prior information about the objects that a task may meet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Library {
    /// Name.
    pub name: String,
    /// S_f, families expanded. [`FeatureId`] indexes this list.
    pub features: Vec<Feature>,
    /// S_class.
    pub classes: Vec<Class>,
    /// The rules in order: as written, families expanded where they stand,
    /// then the pairs of each layout.
    pub rules: Vec<Rule>,
    /// Where it was declared.
    pub place: Place,
}

/// Index of a feature in its library.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(transparent)]
pub struct FeatureId(pub u32);

impl FeatureId {
    /// As an index into [`Library::features`].
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A feature f_i.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Feature {
    /// Full name, e.g. `bottom` or `code[1]`.
    pub name: String,
    /// What kind of local surface it is.
    pub kind: FeatureKind,
    /// Whether an object can have several instances f_ij of it.
    pub many: bool,
    /// Where it was declared.
    pub place: Place,
}

/// The type of a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum FeatureKind {
    /// A planar local surface.
    Polygon,
    /// A flat square marker with a text.
    Marker,
    /// A rough shape: several faces together.
    Shell,
}

impl fmt::Display for FeatureKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Polygon => "polygon",
            Self::Marker => "marker",
            Self::Shell => "shell",
        })
    }
}

/// A candidate class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Class {
    /// Name.
    pub name: String,
    /// P(class); the priors of a library sum to 1.
    pub prior: f64,
    /// ext_i^m over the features.
    pub presence: Presence,
    /// Where it was declared.
    pub place: Place,
}

/// A presence vector, written like the paper's: `1010111`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[cfg_attr(test, schemars(extend("pattern" = "^[01]*$")))]
#[serde(into = "String", try_from = "String")]
pub struct Presence(pub Vec<bool>);

impl Presence {
    /// ext_i^m: whether the class has a feature.
    pub fn has(&self, feature: FeatureId) -> bool {
        self.0.get(feature.index()).copied().unwrap_or(false)
    }
}

impl From<Presence> for String {
    fn from(presence: Presence) -> Self {
        presence.0.iter().map(|&p| if p { '1' } else { '0' }).collect()
    }
}

impl TryFrom<String> for Presence {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.chars()
            .map(|c| match c {
                '0' => Ok(false),
                '1' => Ok(true),
                _ => Err(format!("`{text}` is not a row of 0 and 1")),
            })
            .collect::<Result<_, _>>()
            .map(Self)
    }
}

/// rule_k : { S_ant → f_cons, proof, cal, pred }.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Rule {
    /// `r1`, `r2`, … in the library's order.
    pub id: String,
    /// S_ant; empty for a definite rule.
    pub antecedents: Vec<FeatureId>,
    /// f_cons.
    pub consequent: FeatureId,
    /// The rule stands for one rule a combination of these, outermost first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub each: Vec<Each>,
    /// proof().
    pub detect: Call,
    /// cal().
    pub measure: Call,
    /// pred(); absent from definite rules.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub predict: Option<Call>,
    /// Where it was declared: the rule, or the layout that gave it.
    pub place: Place,
}

/// `for each edge in bottom.edges`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Each {
    /// The name that arguments use.
    pub variable: String,
    /// Whose parts; one of the antecedents.
    pub feature: FeatureId,
    /// Which list attribute (`edges`).
    pub attribute: String,
}

impl Rule {
    /// Its head as it is written: `bottom, prism_side -> prism_shape`.
    pub fn head(&self, library: &Library) -> String {
        let name = |id: &FeatureId| library.feature(*id).name.as_str();
        let antecedents: Vec<&str> = self.antecedents.iter().map(name).collect();
        let arrow = format!("-> {}", name(&self.consequent));
        if antecedents.is_empty() {
            arrow
        } else {
            format!("{} {arrow}", antecedents.join(", "))
        }
    }

    /// What tells it from other rules wherever it stands: the SHA-256 of its JSON
    /// without id and place, its features by their names; the first 16 digits.
    pub fn digest(&self, library: &Library) -> String {
        let mut rule = serde_json::to_value(self).unwrap_or_default();
        if let Some(fields) = rule.as_object_mut() {
            fields.retain(|name, _| name != "id" && name != "place");
        }
        by_name(&mut rule, library);
        let mut digits = hex(&Sha256::digest(rule.to_string().as_bytes()));
        digits.truncate(16);
        digits
    }
}

/// Puts names for the ids of features.
fn by_name(value: &mut serde_json::Value, library: &Library) {
    let name = |id: &mut serde_json::Value| {
        let feature = id.as_u64().and_then(|id| library.features.get(id as usize));
        if let Some(feature) = feature {
            *id = feature.name.clone().into();
        }
    };
    match value {
        serde_json::Value::Array(items) => items.iter_mut().for_each(|item| by_name(item, library)),
        serde_json::Value::Object(fields) => {
            for (key, value) in fields {
                match (key.as_str(), value) {
                    ("feature" | "consequent", id) if id.is_u64() => name(id),
                    ("antecedents", serde_json::Value::Array(ids)) => ids.iter_mut().for_each(name),
                    (_, other) => by_name(other, library),
                }
            }
        }
        _ => {}
    }
}

impl Library {
    /// The feature behind an id.
    pub fn feature(&self, id: FeatureId) -> &Feature {
        &self.features[id.index()]
    }

    /// Ids of all features in order.
    pub fn feature_ids(&self) -> impl Iterator<Item = FeatureId> + use<> {
        (0..self.features.len() as u32).map(FeatureId)
    }

    /// Ids that point nowhere, presence rows of a wrong width, priors that are none.
    pub(super) fn validate(&self) -> Result<(), String> {
        let n = self.features.len();
        for class in &self.classes {
            if class.presence.0.len() != n {
                return Err(format!(
                    "class `{}` has {} presences for {n} features",
                    class.name,
                    class.presence.0.len()
                ));
            }
            if !(class.prior.is_finite() && class.prior >= 0.0) {
                return Err(format!("class `{}` has no usable prior", class.name));
            }
        }
        for rule in &self.rules {
            let mut ids = rule
                .antecedents
                .iter()
                .chain([&rule.consequent])
                .chain(rule.each.iter().map(|e| &e.feature));
            if ids.any(|id| id.index() >= n) {
                return Err(format!("rule {} names a feature that is not here", rule.id));
            }
        }
        Ok(())
    }
}
