//! stub
/// stub
pub struct Coverage;
