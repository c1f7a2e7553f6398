/// A state of the controller, one Boolean node each (manual 3.2.3.10). The names are those of the flags of the remote
/// command GetStatus, in its order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StatusFlag {
    /// TEST mode.
    Test,
    /// TEACH mode.
    Teach,
    /// Remote input is accepted.
    Auto,
    /// A warning; tasks continue.
    Warning,
    /// A system error: the controller must be restarted.
    SError,
    /// The safeguard is open.
    Safeguard,
    /// Emergency stop.
    EStop,
    /// An error that Reset clears.
    Error,
    /// Tasks are paused.
    Paused,
    /// Tasks run; off while they are paused.
    Running,
    /// Started up, and no task runs.
    Ready,
}

impl StatusFlag {
    /// Every flag, in the order of GetStatus.
    pub const ALL: [Self; 11] = [
        Self::Test,
        Self::Teach,
        Self::Auto,
        Self::Warning,
        Self::SError,
        Self::Safeguard,
        Self::EStop,
        Self::Error,
        Self::Paused,
        Self::Running,
        Self::Ready,
    ];

    /// The name, as the node and GetStatus spell it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Test => "Test",
            Self::Teach => "Teach",
            Self::Auto => "Auto",
            Self::Warning => "Warning",
            Self::SError => "SError",
            Self::Safeguard => "Safeguard",
            Self::EStop => "EStop",
            Self::Error => "Error",
            Self::Paused => "Paused",
            Self::Running => "Running",
            Self::Ready => "Ready",
        }
    }
}

/// Which states the controller is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct StatusFlags(u16);

impl StatusFlags {
    /// Whether the controller is in this state.
    pub const fn contains(self, flag: StatusFlag) -> bool {
        self.0 >> flag as u16 & 1 == 1
    }

    /// The flags as bits, as the vendor's remote clients number them: Ready is bit 0, Test is bit 10.
    pub fn bits(self) -> u16 {
        StatusFlag::ALL.into_iter().rev().zip(0..).map(|(flag, bit)| u16::from(self.contains(flag)) << bit).sum()
    }

    /// Enters or leaves a state.
    pub const fn set(&mut self, flag: StatusFlag, on: bool) {
        let mask = 1 << flag as u16;
        self.0 = if on { self.0 | mask } else { self.0 & !mask };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flags_are_set_one_by_one() {
        let mut flags = StatusFlags::default();
        for flag in StatusFlag::ALL {
            assert!(!flags.contains(flag));
            flags.set(flag, true);
            assert!(flags.contains(flag));
        }
        assert_eq!(flags.bits(), 0b111_1111_1111);
        flags.set(StatusFlag::Ready, false);
        assert_eq!(flags.bits(), 0b111_1111_1110);
        flags.set(StatusFlag::Ready, true);
        flags.set(StatusFlag::Error, false);
        let left = StatusFlag::ALL.into_iter().filter(|flag| flags.contains(*flag)).count();
        assert_eq!((left, flags.contains(StatusFlag::Error)), (10, false));
    }
}
