//! Stories about whole controllers, told over their management protocol.

mod bench;
mod certificates;
mod changes;
mod crowd;
mod persistence;
mod sessions;
mod starting;
mod whole_or_nothing;
