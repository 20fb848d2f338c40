//! Which features each candidate sees, and candidates grouped by what they see.

use std::iter;

use adslam_models::{FeatureId, Sensor};
use adslam_surface::{Fan, Surface};
use nalgebra::Vector3;

use crate::{ActionSet, Candidate};

/// The visible sets of the candidates of a decision, as bits. A line of sight from one position to one
/// feature is looked along once, however many orientations share the position.
///
/// Keeps its room from decision to decision.
#[derive(Clone, Debug, Default)]
pub struct VisibleSets {
    /// Words of 64 features in a set.
    words: usize,
    /// The set of each candidate, one after the other.
    bits: Vec<u64>,
    /// For each position the features whose line of sight was looked along, then those in sight.
    positions: Vec<u64>,
    /// Candidates, those that see most first, equal sets together.
    order: Vec<usize>,
    fan: Fan,
}

impl VisibleSets {
    /// Finds out what each candidate sees of the object whose surface will be `surface`.
    pub fn find(
        &mut self,
        candidates: &[Candidate],
        actions: &ActionSet,
        sensor: &Sensor,
        surface: &Surface,
    ) {
        let features = surface.points();
        let words = features.len().div_ceil(64);
        self.words = words;
        self.bits.clear();
        self.positions.clear();
        self.positions
            .resize(2 * words * (actions.position_count() + 1), 0);
        for candidate in candidates {
            let start = self.bits.len();
            self.bits.resize(start + words, 0);
            let set = &mut self.bits[start..];
            let eye = candidate.pose.position;
            let forward = candidate.pose.orientation.rotation() * Vector3::x();
            for (id, point) in features.iter().enumerate() {
                insert_if(sensor.in_view_from(&eye, &forward, point), set, id);
            }
            // Staying has the last place where the set has no such action.
            let place = candidate
                .index
                .map_or(actions.position_count(), |index| actions.position_of(index));
            let position = 2 * words * place;
            let (looked, in_sight) = self.positions[position..][..2 * words].split_at_mut(words);
            let unknown = set.iter().zip(&*looked).map(|(set, looked)| set & !looked);
            for &id in self.fan.seen(surface, &eye, members(unknown)) {
                insert_if(true, in_sight, id);
            }
            for ((set, looked), in_sight) in set.iter_mut().zip(looked).zip(in_sight) {
                *looked |= *set;
                *set &= *in_sight;
            }
        }
        self.sort();
    }

    fn sort(&mut self) {
        let Self {
            words, bits, order, ..
        } = self;
        order.clear();
        order.extend(0..bits.len().checked_div(*words).unwrap_or(0));
        let set = |candidate: usize| &bits[candidate * *words..][..*words];
        let size = |candidate: usize| set(candidate).iter().map(|w| w.count_ones()).sum::<u32>();
        order.sort_unstable_by(|&a, &b| {
            size(b)
                .cmp(&size(a))
                .then_with(|| set(a).cmp(set(b)))
                .then(a.cmp(&b))
        });
    }

    /// Of how many candidates the sets are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.order.len()
    }

    /// The set of a candidate, by its place in the list that was given: feature j is bit j mod 64 of
    /// word j / 64.
    ///
    /// # Panics
    /// If there is no such candidate.
    #[must_use]
    pub fn set(&self, candidate: usize) -> &[u64] {
        &self.bits[candidate * self.words..][..self.words]
    }

    /// Candidates that see the same, group after group; those that see most come first.
    pub fn groups(&self) -> impl Iterator<Item = &[usize]> {
        self.order.chunk_by(|&a, &b| self.set(a) == self.set(b))
    }

    /// The features that any candidate sees, in `ids`.
    pub fn union(&self, ids: &mut Vec<FeatureId>) {
        let any = |word| {
            let of_each = self.bits.iter().skip(word).step_by(self.words);
            of_each.fold(0, |all, bits| all | bits)
        };
        ids.clear();
        ids.extend(members((0..self.words).map(any)).map(FeatureId));
    }

    /// The features of a set, in `ids`.
    pub fn features(set: &[u64], ids: &mut Vec<FeatureId>) {
        ids.clear();
        ids.extend(members(set.iter().copied()).map(FeatureId));
    }

    /// Whether every feature of `part` is in `whole`.
    pub fn contains(whole: &[u64], part: &[u64]) -> bool {
        whole
            .iter()
            .zip(part)
            .all(|(whole, part)| part & !whole == 0)
    }
}

/// Adds `id` to a set where the condition holds.
fn insert_if(condition: bool, set: &mut [u64], id: usize) {
    set[id / 64] |= u64::from(condition) << (id % 64);
}

/// The members of a set given by its words, in order.
fn members(words: impl Iterator<Item = u64>) -> impl Iterator<Item = usize> {
    words.enumerate().flat_map(|(word, bits)| {
        let rest = |bits: &u64| Some(bits & (bits - 1)).filter(|&bits| bits != 0);
        iter::successors(Some(bits).filter(|&bits| bits != 0), rest)
            .map(move |bits| 64 * word + bits.trailing_zeros() as usize)
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use adslam_models::{Pose, predicted_pose};
    use adslam_surface::Topology;
    use nalgebra::{Point3, Vector6};
    use proptest::prelude::*;

    use super::*;
    use crate::features_seen_in_pose;

    proptest! {
        #[test]
        fn sets_are_those_found_one_by_one_and_groups_hold_every_candidate_once(
            points in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 6..80),
            pose in prop::array::uniform6(-1.5..1.5),
        ) {
            let points: Vec<Point3<f64>> = points.into_iter().map(Point3::from).collect();
            let Ok(topology) = Topology::convex_hull(&points) else { return Ok(()) };
            let surface = Surface::new(&Arc::new(topology), &points)?;
            let sensor = Sensor { min_range: 0.1, max_range: 1.8 };
            let turn = [-0.5, 0.0, 0.5];
            let step = [-0.4, 0.0, 0.4];
            let actions = ActionSet::grid([&turn, &turn, &turn], [&step, &step], 9.0, 9.0);
            let start = Pose::from_vector(&Vector6::from(pose));
            let candidates: Vec<Candidate> = actions
                .controls()
                .iter()
                .enumerate()
                .map(|(index, control)| Candidate {
                    index: Some(index),
                    control: *control,
                    pose: predicted_pose(&start, control),
                })
                .collect();
            let mut sets = VisibleSets::default();
            sets.find(&candidates, &actions, &sensor, &surface);

            let (mut ids, mut any) = (Vec::new(), Vec::new());
            for (i, candidate) in candidates.iter().enumerate() {
                VisibleSets::features(sets.set(i), &mut ids);
                let one_by_one = features_seen_in_pose(&sensor, &candidate.pose, &surface);
                prop_assert_eq!(&ids, &one_by_one);
                any.extend(one_by_one);
            }
            sets.union(&mut ids);
            any.sort_unstable();
            any.dedup();
            prop_assert_eq!(&ids, &any);

            let mut members: Vec<usize> = Vec::new();
            let mut sizes = Vec::new();
            for group in sets.groups() {
                prop_assert!(group.iter().all(|&i| sets.set(i) == sets.set(group[0])));
                VisibleSets::features(sets.set(group[0]), &mut ids);
                sizes.push(ids.len());
                members.extend(group);
            }
            prop_assert!(sizes.is_sorted_by(|a, b| a >= b), "those that see most come first");
            members.sort_unstable();
            prop_assert_eq!(members, (0..candidates.len()).collect::<Vec<_>>());
        }
    }

    /// What lies exactly beside the robot is not ahead of it.
    #[test]
    fn beside_is_not_ahead() {
        let points = [[0.0, 1.0], [0.5, 1.0], [0.5, 2.0], [0.0, 2.0]];
        let points: Vec<Point3<f64>> = [-0.5, 0.5]
            .into_iter()
            .flat_map(|z| points.map(|[x, y]| Point3::new(x, y, z)))
            .collect();
        let topology = Arc::new(Topology::convex_hull(&points).unwrap());
        let surface = Surface::new(&topology, &points).unwrap();
        let sensor = Sensor {
            min_range: 0.1,
            max_range: 9.0,
        };
        let still = [0.0];
        let actions = ActionSet::grid([&still; 3], [&still; 2], 1.0, 1.0);
        let (index, control) = actions.staying();
        let here = Candidate {
            index,
            control,
            pose: Pose::default(),
        };
        let mut sets = VisibleSets::default();
        sets.find(&[here], &actions, &sensor, &surface);
        let mut ids = Vec::new();
        VisibleSets::features(sets.set(0), &mut ids);
        assert_eq!(ids, [FeatureId(1), FeatureId(5)]);
    }

    #[test]
    fn containment_is_of_every_word() {
        assert!(VisibleSets::contains(&[0b111, 0b1], &[0b101, 0b1]));
        assert!(!VisibleSets::contains(&[0b111, 0b0], &[0b101, 0b1]));
    }
}
