//! Task checks: what can be known before the robot moves, one file an analysis.

use super::diagnostics::Diagnostic;
use super::lower::Lowered;

/// Analyses everything that was lowered whole.
pub(super) fn check(_lowered: &Lowered) -> Vec<Diagnostic> {
    Vec::new()
}
