//! Independent random streams of one seed.

use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;

/// What a stream of random numbers is for. Each purpose has a stream of its own, so that every planner
/// meets the same noise at the same seed, however much of another kind was drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// The robot's motion noise.
    Motion = 0,
    /// The features' motion and deformation noise.
    Deformation = 1,
    /// The errors of the first estimate and of all measurements.
    Sensor = 2,
    /// The draws of the planners.
    Planner = 3,
    /// Outliers, missed detections and dropped structure measurements.
    Faults = 4,
}

/// The generator of one purpose at one seed.
#[must_use]
pub fn stream(seed: u64, purpose: Stream) -> ChaCha12Rng {
    let mut generator = ChaCha12Rng::seed_from_u64(seed);
    // Only right after seeding: changing the stream keeps the position in it.
    generator.set_stream(purpose as u64);
    generator
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;

    #[test]
    fn streams_differ_and_repeat() {
        let purposes = [
            Stream::Motion,
            Stream::Deformation,
            Stream::Sensor,
            Stream::Planner,
            Stream::Faults,
        ];
        let first = |seed, purpose| stream(seed, purpose).next_u64();
        let mut draws: Vec<u64> = purposes.iter().map(|&p| first(1, p)).collect();
        draws.push(first(2, Stream::Motion));
        assert_eq!(first(1, Stream::Sensor), draws[2]);
        draws.sort_unstable();
        draws.dedup();
        assert_eq!(draws.len(), 6);
    }
}
