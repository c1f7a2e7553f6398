use super::dynamics::{JointState, torques};
use super::kinematics::Joints;
use super::profile::{Profile, Progress};
use super::robot_model::RobotModel;
use super::time::CellTime;

/// A motion along a straight line between two places of the joints, or standstill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Motion {
    pub start: CellTime,
    pub from: Joints,
    /// From the start to the end.
    pub delta: Joints,
    pub profile: Profile,
}

impl Motion {
    pub fn progress(&self, time: CellTime) -> Progress {
        self.profile.at(time.nanos_since(self.start) as f64 * 1e-9)
    }

    pub fn joints(&self, time: CellTime) -> JointState {
        self.joints_at(self.progress(time))
    }

    fn joints_at(&self, Progress { place, speed, acceleration }: Progress) -> JointState {
        let mut position = self.from;
        for (position, way) in position.iter_mut().zip(&self.delta) {
            *position += way * place;
        }
        JointState {
            position,
            speed: self.delta.map(|way| way * speed),
            acceleration: self.delta.map(|way| way * acceleration),
        }
    }
}

/// The loads of the motions that came last: a program repeats its motions.
#[derive(Debug, Default)]
pub(super) struct LoadMemory {
    known: Vec<(Motion, f64, Joints)>,
    /// Which entry is replaced next.
    next: usize,
}

impl LoadMemory {
    const ENTRIES: usize = 16;
    /// Moments of a motion at which the torque is calculated.
    const MOMENTS: u32 = 24;

    /// The mean of each joint's squared torque over a motion with this payload.
    pub fn mean_squared(&mut self, model: RobotModel, motion: &Motion, payload: f64) -> Joints {
        let same = |known: &(Motion, f64, Joints)| {
            known.0.from == motion.from
                && known.0.delta == motion.delta
                && known.1 == payload
                && known.0.profile == motion.profile
        };
        if let Some((_, _, load)) = self.known.iter().find(|known| same(known)) {
            return *load;
        }
        let secs = motion.profile.millis() as f64 / 1000.0;
        let moments = if secs == 0.0 { 1 } else { Self::MOMENTS };
        let mut load = [0.0; 6];
        for moment in 0..moments {
            let at = (f64::from(moment) + 0.5) / f64::from(moments) * secs;
            let torque = torques(model, &motion.joints_at(motion.profile.at(at)), payload);
            for (load, torque) in load.iter_mut().zip(torque) {
                *load += (torque / 100.0).powi(2) / f64::from(moments);
            }
        }
        let entry = (*motion, payload, load);
        match self.known.get_mut(self.next) {
            Some(old) => *old = entry,
            None => self.known.push(entry),
        }
        self.next = (self.next + 1) % Self::ENTRIES;
        load
    }
}
