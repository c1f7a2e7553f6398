use crate::model::{StatusFlag, StatusFlags};

/// The answer to GetStatus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RemoteStatus {
    /// The eleven states. Old firmware sends ten, without Test, which is then off.
    pub flags: StatusFlags,
    /// The number of the error or warning, 0 for none; at most 9999.
    pub code: u16,
}

/// The largest code that four digits hold.
pub(super) const MAX_STATUS_CODE: u16 = 9999;

impl RemoteStatus {
    /// One state after the other, first Test; `zero` and `zero + 1` for off and on.
    pub(super) fn flag_bytes(self, zero: u8) -> [u8; StatusFlag::ALL.len()] {
        StatusFlag::ALL.map(|flag| zero + u8::from(self.flags.contains(flag)))
    }

    /// Reads eleven states, or ten without Test; `None` for other bytes or another number of them.
    pub(super) fn flags_from(bytes: &[u8], zero: u8) -> Option<StatusFlags> {
        let first = StatusFlag::ALL.len().checked_sub(bytes.len()).filter(|missing| *missing <= 1)?;
        let mut flags = StatusFlags::default();
        for (flag, byte) in StatusFlag::ALL.into_iter().skip(first).zip(bytes) {
            flags.set(
                flag,
                match byte.checked_sub(zero)? {
                    0 => false,
                    1 => true,
                    _ => return None,
                },
            );
        }
        Some(flags)
    }

    /// The four digits of the code.
    pub(super) fn code_digits(self) -> [u8; 4] {
        let code = self.code.min(MAX_STATUS_CODE);
        [1000, 100, 10, 1].map(|unit| b'0' + u8::try_from(code / unit % 10).unwrap_or_default())
    }

    /// Reads four digits.
    pub(super) fn code_from(digits: &[u8]) -> Option<u16> {
        let is_code = digits.len() == 4 && digits.iter().all(u8::is_ascii_digit);
        is_code.then(|| digits.iter().fold(0, |code, digit| code * 10 + u16::from(digit - b'0')))
    }
}
