//! Shared by the stories. Each story uses a part of it.
#![allow(dead_code)]

pub mod pictures;
pub mod samples;
pub mod soft_renderer;
pub mod window;
