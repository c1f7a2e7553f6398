/// How far along its path a motion is, as a function of time: from 0 (start) to 1 (end) with a trapezoidal speed, or from
/// anywhere to a stop. Pure; times in seconds since the motion's start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Profile {
    phases: [Phase; 3],
    count: usize,
    /// Where the path ends, exactly.
    end: f64,
    /// Rounded up to whole milliseconds, so that every event of a cell lies on one.
    millis: u64,
}

/// Constant acceleration from a moment on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Phase {
    from: f64,
    place: f64,
    speed: f64,
    acceleration: f64,
}

/// Place, speed and acceleration along the path, in 1, 1/s and 1/s².
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Progress {
    pub place: f64,
    pub speed: f64,
    pub acceleration: f64,
}

impl Profile {
    /// Stands at the start of its path.
    pub const REST: Self = Self {
        phases: [Phase { from: 0.0, place: 0.0, speed: 0.0, acceleration: 0.0 }; 3],
        count: 1,
        end: 0.0,
        millis: 0,
    };

    /// From rest at 0 to rest at 1. Limits in 1/s and 1/s², above 0.
    pub fn rest_to_rest(max_speed: f64, acceleration: f64) -> Self {
        let speed = max_speed.min(acceleration.sqrt());
        let ramp = speed / acceleration;
        let cruise = 1.0 / speed - ramp;
        let ramped = speed * ramp / 2.0;
        let phases = [
            Phase { from: 0.0, place: 0.0, speed: 0.0, acceleration },
            Phase { from: ramp, place: ramped, speed, acceleration: 0.0 },
            Phase { from: ramp + cruise, place: 1.0 - ramped, speed, acceleration: -acceleration },
        ];
        Self { phases, count: 3, end: 1.0, millis: millis(2.0 * ramp + cruise) }
    }

    /// Slows down to a stop from where a motion is.
    pub fn brake(from: Progress, deceleration: f64) -> Self {
        let time = from.speed / deceleration;
        let first = Phase { from: 0.0, place: from.place, speed: from.speed, acceleration: -deceleration };
        let end = from.place + from.speed * time / 2.0;
        Self { phases: [first; 3], count: 1, end, millis: millis(time) }
    }

    /// How long the motion takes.
    pub const fn millis(&self) -> u64 {
        self.millis
    }

    /// The state after so many seconds. From the end on: at rest.
    pub fn at(&self, seconds: f64) -> Progress {
        let phases = &self.phases[..self.count];
        let phase = phases.iter().rev().find(|phase| phase.from <= seconds).unwrap_or(&phases[0]);
        let time = seconds - phase.from;
        let speed = phase.speed + phase.acceleration * time;
        let is_over = seconds * 1000.0 >= self.millis as f64;
        // Between the exact end and the whole millisecond after it the speed would turn negative.
        if is_over || (speed <= 0.0 && phase.acceleration < 0.0) {
            return Progress { place: self.end, speed: 0.0, acceleration: 0.0 };
        }
        let place = phase.place + phase.speed * time + phase.acceleration * time * time / 2.0;
        Progress { place, speed, acceleration: phase.acceleration }
    }
}

fn millis(seconds: f64) -> u64 {
    // Motions last seconds, so nothing is cut off.
    (seconds * 1000.0).ceil() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_smooth(profile: &Profile, max_speed: f64, acceleration: f64) {
        let mut before = profile.at(0.0);
        for at in 1..=profile.millis() + 2 {
            let now = profile.at(at as f64 / 1000.0);
            assert!(now.place >= before.place - 1e-12, "goes back at {at} ms");
            assert!(now.speed <= max_speed + 1e-9, "{} at {at} ms", now.speed);
            assert!((now.speed - before.speed).abs() <= acceleration * 0.001 + 1e-9, "jumps at {at} ms");
            let mean = (now.speed + before.speed) / 2.0;
            assert!((now.place - before.place - mean * 0.001).abs() < acceleration * 1e-6, "not its speed at {at} ms");
            before = now;
        }
        assert_eq!(before.speed, 0.0);
    }

    #[test]
    fn long_and_short_motions_keep_their_limits() {
        for (speed, acceleration) in [(0.5, 3.0), (10.0, 4.0), (0.01, 1.0), (2.0, 4.0)] {
            let profile = Profile::rest_to_rest(speed, acceleration);
            assert_smooth(&profile, speed, acceleration);
            assert_eq!(profile.at(0.0).place, 0.0);
            assert_eq!(profile.at(profile.millis() as f64 / 1000.0).place, 1.0);
        }
    }

    #[test]
    fn braking_ends_at_rest_where_the_speed_allows() {
        let from = Profile::rest_to_rest(0.5, 3.0).at(0.9);
        let profile = Profile::brake(from, 3.0);
        assert_smooth(&profile, 0.5, 3.0);
        assert_eq!(profile.at(0.0), Progress { acceleration: -3.0, ..from });
        assert!((profile.at(9.0).place - (from.place + 0.5 * 0.5 / 6.0)).abs() < 1e-12);
        assert_eq!(Profile::brake(Progress { place: 0.3, ..Progress::default() }, 1.0).at(0.0).place, 0.3);
    }

    #[test]
    fn rest_stays() {
        assert_eq!(Profile::REST.at(0.0), Progress::default());
        assert_eq!(Profile::REST.at(1e6), Progress::default());
    }
}
