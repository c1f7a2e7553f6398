use super::{ActivationEntry, ActivationFile};
use crate::model::{ControllerName, FirmwareGeneration, FirmwareVersion, SerialNumber};

/// What an activation file means for the ticked controllers: what a dialog shows before anything is sent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ActivationPlan {
    /// One for each ticked controller, in their order.
    pub controllers: Vec<PlannedActivation>,
    /// Good lines that no ticked controller needs: number and serial number.
    pub unused: Vec<(usize, SerialNumber)>,
}

/// One ticked controller and what will happen to it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedActivation {
    /// Its name in the list of controllers.
    pub name: ControllerName,
    /// Its serial number, by which the file is searched.
    pub serial: SerialNumber,
    /// Whether it is activated, and why not.
    pub decision: ActivationDecision,
}

/// What will happen to one controller.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ActivationDecision {
    /// It gets the keys of this line.
    Activate {
        /// Line of the file with its keys, counted from 1.
        line: usize,
    },
    /// The file does not mention it: it fails alone, and nothing is sent to it.
    Missing,
    /// Its line gives no keys: as with a missing one.
    Mistake(super::LineMistake),
    /// Activated as a controller option, not by keys (manual 2.6.3).
    FirmwareTooNew,
}

impl ActivationPlan {
    /// How many controllers get keys.
    pub fn ready(&self) -> usize {
        self.controllers.iter().filter(|c| matches!(c.decision, ActivationDecision::Activate { .. })).count()
    }
}

/// Looks every ticked controller up in the file.
pub fn plan(file: &ActivationFile, controllers: &[(ControllerName, SerialNumber, FirmwareVersion)]) -> ActivationPlan {
    let decision = |serial, firmware: FirmwareVersion| match (firmware.generation(), file.find(serial)) {
        (FirmwareGeneration::Current, _) => ActivationDecision::FirmwareTooNew,
        (FirmwareGeneration::Legacy, ActivationEntry::Line(line)) => ActivationDecision::Activate { line: line.line },
        (FirmwareGeneration::Legacy, ActivationEntry::Mistake(mistake)) => ActivationDecision::Mistake(mistake.clone()),
        (FirmwareGeneration::Legacy, ActivationEntry::Missing) => ActivationDecision::Missing,
    };
    let controllers: Vec<PlannedActivation> = controllers
        .iter()
        .map(|(name, serial, firmware)| PlannedActivation {
            name: name.clone(),
            serial: serial.clone(),
            decision: decision(serial, *firmware),
        })
        .collect();
    let needed: std::collections::HashSet<usize> = controllers
        .iter()
        .filter_map(|c| match c.decision {
            ActivationDecision::Activate { line } => Some(line),
            _ => None,
        })
        .collect();
    let unused = file.lines().iter().filter(|line| !needed.contains(&line.line));
    let unused = unused.map(|line| (line.line, line.serial.clone())).collect();
    ActivationPlan { controllers, unused }
}

#[cfg(test)]
mod tests {
    use super::super::{ActivationMistake, parse};
    use super::*;

    #[test]
    fn every_ticked_controller_finds_its_line_or_learns_why_not() {
        let file = parse(
            b"OPCUA.Activation.Ver.1.0\n\
            R7A0000001,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
            R7A0000002,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX,x\n\
            R7A0000003,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
            RC80000001,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n",
        )
        .unwrap();
        let ticked = |name: &str, serial: &str, firmware: &str| {
            (name.parse().unwrap(), serial.parse().unwrap(), firmware.parse().unwrap())
        };
        let plan = plan(
            &file,
            &[
                ticked("weld", "R7A0000001", "7.5.4"),
                ticked("paint", "R7A0000002", "7.5.4"),
                ticked("press", "R7A0000009", "7.5.54"),
                ticked("pack", "RC80000001", "8.0.0"),
            ],
        );
        let verdicts: Vec<&ActivationDecision> = plan.controllers.iter().map(|c| &c.decision).collect();
        assert_eq!(verdicts[0], &ActivationDecision::Activate { line: 2 });
        assert!(
            matches!(verdicts[1], ActivationDecision::Mistake(m) if m.line == 3 && m.mistake == ActivationMistake::Fields(4))
        );
        assert_eq!(verdicts[2..], [&ActivationDecision::Missing, &ActivationDecision::FirmwareTooNew]);
        assert_eq!(plan.ready(), 1);
        assert_eq!(plan.unused, [(4, "R7A0000003".parse().unwrap()), (5, "RC80000001".parse().unwrap())]);
    }
}
