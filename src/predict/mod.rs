//! Predictors: from measured features to the place of one not yet seen.
