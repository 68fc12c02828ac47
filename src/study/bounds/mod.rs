//! How good any planner could be: exact bounds, and an oracle.
//!
//! For reconstruction the least number of views from the same start that cover as much,
//! the shape being known ([`Sight`]); for recognition the best policy, layout and pose
//! and what each view decodes being known ([`Policy`]). Nothing here plans.

mod cover;
mod decoded;
mod policy;

pub use cover::{Least, Sight};
pub use decoded::Decoded;
pub use policy::Policy;
