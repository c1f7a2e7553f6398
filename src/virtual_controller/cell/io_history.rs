use std::collections::VecDeque;

use super::time::CellTime;

/// The standard I/O over time, for the motion log.
#[derive(Debug)]
pub(super) struct IoHistory(VecDeque<IoMoment>);

/// The state from a moment on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct IoMoment {
    pub from: CellTime,
    pub inputs: u32,
    pub outputs: u32,
}

impl IoHistory {
    /// Changes kept at most.
    const MAX: usize = 4096;

    /// Everything off since power-on.
    pub fn new() -> Self {
        Self(VecDeque::from([IoMoment { from: CellTime::ZERO, inputs: 0, outputs: 0 }]))
    }

    /// Notes the state from `now` on.
    pub fn note(&mut self, now: CellTime, inputs: u32, outputs: u32) {
        let last = self.0[self.0.len() - 1];
        if (last.inputs, last.outputs) != (inputs, outputs) {
            if last.from == now {
                self.0.pop_back();
            }
            self.0.push_back(IoMoment { from: now, inputs, outputs });
        }
    }

    /// The state at this moment.
    pub fn at(&self, time: CellTime) -> IoMoment {
        let after = self.0.partition_point(|moment| moment.from <= time);
        self.0[after.saturating_sub(1)]
    }

    /// Drops what is not needed for moments from `time` on, and more where that is too much. Returns the earliest moment that
    /// is left.
    pub fn forget_before(&mut self, time: CellTime) -> CellTime {
        while self.0.len() > Self::MAX || self.0.get(1).is_some_and(|next| next.from <= time) {
            self.0.pop_front();
        }
        self.0[0].from
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_state_of_the_past_is_known_as_far_as_it_is_needed() {
        let mut history = IoHistory::new();
        for ms in 1..=10 {
            history.note(CellTime::from_millis(ms * 10), ms as u32, 0);
            history.note(CellTime::from_millis(ms * 10), ms as u32, 1);
            history.note(CellTime::from_millis(ms * 10 + 1), ms as u32, 1);
        }
        let at = |history: &IoHistory, ms| history.at(CellTime::from_millis(ms)).inputs;
        assert_eq!([0, 9, 10, 55, 500].map(|ms| at(&history, ms)), [0, 0, 1, 5, 10]);
        assert_eq!(history.0.len(), 11);
        assert_eq!(history.forget_before(CellTime::from_millis(55)), CellTime::from_millis(50));
        assert_eq!(at(&history, 55), 5);
        for ms in 1000..10_000 {
            history.note(CellTime::from_millis(ms), ms as u32, 0);
            history.forget_before(CellTime::ZERO);
        }
        assert_eq!(history.0.len(), IoHistory::MAX);
    }
}
