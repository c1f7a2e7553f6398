//! What stories ask of the window, beside what [`super::harness`] does to it.

use std::time::{Duration, Instant};

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::ui::backend::Backend;

use super::harness::is_control;
pub use super::harness::{SIZE, Window, choose, click, now, settle, type_into, window, window_in};

/// Clicks the main button of the dialog on top, the one beside its Cancel.
pub fn agree<B: Backend>(window: &mut Window<B>) {
    let buttons: Vec<_> = window.query_all_by_role(Role::Button).collect();
    let cancel = buttons.iter().rposition(|node| node.accesskit_node().label().as_deref() == Some("Cancel"));
    let main = cancel.and_then(|at| at.checked_sub(1)).map(|at| buttons[at]);
    main.unwrap_or_else(|| panic!("no dialog asks for an agreement")).click();
    settle(window);
}

pub fn shows<B: Backend>(window: &Window<B>, label: &str) -> bool {
    window.query_all_by_label_contains(label).next().is_some()
}

pub fn is_enabled<B: Backend>(window: &Window<B>, label: &str) -> bool {
    window
        .query_all_by_label(label)
        .rfind(|node| is_control(node.accesskit_node().role()))
        .is_some_and(|node| !node.accesskit_node().is_disabled())
}

/// Runs frames until something holds.
pub fn wait_until<B: Backend>(window: &mut Window<B>, timeout: Duration, holds: impl Fn(&Window<B>) -> bool) {
    let end = Instant::now() + timeout;
    while !holds(window) {
        let model = &window.state().model;
        assert!(Instant::now() < end, "waited in vain; dialogs: {:?}, job: {:?}", model.dialogs, model.job);
        std::thread::sleep(Duration::from_millis(5));
        window.step();
    }
    settle(window);
}
