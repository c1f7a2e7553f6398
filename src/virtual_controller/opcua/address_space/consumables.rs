use opcua::types::{DateTime, Variant};

use super::id::OWN;
use super::instances::{Instance, Instances};
use super::node::BrowseName;
use super::value::Source;
use super::vendor_types;
use crate::virtual_controller::cell::{CellSnapshot, ConsumableValues, Part};

/// Adds ConsumableStatus with one object a part to a controller, robot or axis (manual 3.2.3.7).
pub(super) fn consumable_status(
    space: &mut Instances,
    parent: &Instance,
    parts: &[Part],
    values: impl Fn(&CellSnapshot, Part) -> ConsumableValues + Copy + Send + Sync + 'static,
) {
    let folder = space.object(parent, BrowseName::new(OWN, "ConsumableStatus"), vendor_types::CONSUMABLE_STATUS);
    for part in parts.iter().copied() {
        let object = space.object(&folder, BrowseName::new(OWN, part.name()), vendor_types::CONSUMABLE_PART);
        space.set(&object, "Available", Source::live(move |cell| values(cell, part).available));
        // The manual's empty text is no DateTime: Null.
        let installed = move |cell: &CellSnapshot| match values(cell, part).installed {
            Some(installed) => Variant::from(DateTime::from(installed)),
            None => Variant::Empty,
        };
        space.set(&object, "InstallationDate", Source::live(installed));
        space.set(&object, "MonthRemaining", Source::live(move |cell| values(cell, part).months_remaining));
        space.set(&object, "ConsumptionRate", Source::live(move |cell| values(cell, part).consumption_rate));
    }
}
