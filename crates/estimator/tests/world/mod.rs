//! A world to filter in for as long as one likes, whose noise is just what the filter assumes: every
//! feature walks at random, the robot circles among them, and what it measures is drawn anew each step.

use adslam_estimator::{
    Belief, EstimatorError, FeatureMeasurement, FilterNoise, Measurements, PairMeasurement,
    StructureMeasurements,
};
use adslam_models::{Control, FeatureId, Pose, State, feature_measurement, move_pose};
use nalgebra::{Matrix6, Point3, Vector3, Vector6};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

use crate::filters::Filter;

/// Which structure measurements a step brings.
#[derive(Clone, Copy, Debug)]
pub enum StructureKind {
    None,
    SomePairs,
    AllPairs,
}

/// What the filter gets at one step.
#[derive(Clone, Debug)]
pub struct Step {
    pub control: Control,
    pub motion: Vec<Vector3<f64>>,
    pub seen: Vec<FeatureMeasurement>,
    pub kind: StructureKind,
    pub pairs: Vec<PairMeasurement>,
    pub sums: Vec<Vector3<f64>>,
}

impl Step {
    /// Algorithm 1 for this step.
    pub fn run(&self, filter: &mut Filter, belief: &mut Belief) -> Result<(), EstimatorError> {
        filter.predict(belief, &self.control, &self.motion)?;
        let structure = match self.kind {
            StructureKind::None => StructureMeasurements::None,
            StructureKind::SomePairs => StructureMeasurements::Pairs(&self.pairs),
            StructureKind::AllPairs => StructureMeasurements::AllPairsSummed(&self.sums),
        };
        let features = &self.seen;
        let measurements = Measurements {
            features,
            structure,
        };
        filter.update(belief, &measurements).map(drop)
    }
}

/// The truth and its noise.
#[derive(Clone, Debug)]
pub struct World {
    pub truth: State,
    noise: FilterNoise,
    rng: ChaCha8Rng,
    steps: usize,
}

/// The robot's way: a circle around the origin, cm, of so many steps.
const RADIUS: f64 = 8.0;
const ROUND: usize = 40;

impl World {
    /// Features anywhere within 5 cm of the origin, the robot where its way begins.
    pub fn new(features: usize, noise: FilterNoise, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let features = (0..features)
            .map(|_| Point3::from(Vector3::from_fn(|_, _| rng.random_range(-5.0..5.0))))
            .collect();
        let pose = Pose::from_vector(&Vector6::new(0.0, 0.0, 0.0, RADIUS, 0.0, 0.0));
        Self {
            truth: State { pose, features },
            noise,
            rng,
            steps: 0,
        }
    }

    /// What the filter believes at first: the pose is known, and each feature to 0.1 cm.
    pub fn first_belief(&mut self) -> Result<Belief, EstimatorError> {
        const SIGMA: f64 = 0.1;
        let features = self.truth.features.clone();
        let features = features.iter().map(|p| p + self.gaussian(SIGMA)).collect();
        Belief::initial(self.truth.pose, features, &Matrix6::zeros(), SIGMA)
    }

    /// Moves on and measures: `seen` features, no two the same, and pairs as `kind` says.
    pub fn step(&mut self, seen: usize, kind: StructureKind) -> Step {
        self.steps += 1;
        let control = self.control();
        let motion = self.motion();
        self.advance(&control, &motion);
        let mut ids: Vec<usize> = (0..motion.len()).collect();
        for i in 0..seen {
            let other = self.rng.random_range(i..ids.len());
            ids.swap(i, other);
        }
        let features = self.truth.features.clone();
        let seen = ids[..seen]
            .iter()
            .map(|&i| FeatureMeasurement {
                feature: FeatureId(i),
                z: feature_measurement(&self.truth.pose, &features[i])
                    + self.gaussian(self.noise.feature_measurement_sigma),
            })
            .collect();
        let mut step = Step {
            control,
            motion,
            seen,
            kind,
            pairs: Vec::new(),
            sums: Vec::new(),
        };
        match kind {
            StructureKind::None => {}
            StructureKind::SomePairs => step.pairs = self.some_pairs(),
            StructureKind::AllPairs => step.sums = self.sums(),
        }
        step
    }

    fn gaussian(&mut self, sigma: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| sigma * self.rng.sample::<f64, _>(StandardNormal))
    }

    /// A turn at random, roll and pitch kept small as planners keep them, and the way to the next place on
    /// the circle.
    fn control(&mut self) -> Control {
        let angle = std::f64::consts::TAU * (self.steps % ROUND) as f64 / ROUND as f64;
        let height = self.rng.random_range(-1.0..1.0);
        let next = Point3::new(RADIUS * angle.cos(), RADIUS * angle.sin(), height);
        let turn = Vector3::from_fn(|_, _| self.rng.random_range(-0.3..0.3));
        let orientation = self.truth.pose.orientation;
        let back = Vector3::new(orientation.roll, orientation.pitch, 0.0) * 0.2;
        Control {
            rotation: turn - back,
            translation: self.truth.pose.body_from_world(&next),
        }
    }

    /// The object goes to and fro, and every feature a little on its own.
    fn motion(&mut self) -> Vec<Vector3<f64>> {
        let sign = if self.steps.is_multiple_of(2) {
            1.0
        } else {
            -1.0
        };
        (0..self.truth.features.len())
            .map(|i| Vector3::new(0.1, 0.02 * (i as f64).sin(), 0.02 * (i as f64).cos()) * sign)
            .collect()
    }

    fn advance(&mut self, control: &Control, motion: &[Vector3<f64>]) {
        let turned = self.gaussian(self.noise.rotation_sigma);
        let moved = self.gaussian(self.noise.translation_sigma);
        let noise = Vector6::from_fn(|k, _| if k < 3 { turned[k] } else { moved[k - 3] });
        self.truth.pose = move_pose(&self.truth.pose, control, &noise);
        for (i, known) in motion.iter().enumerate() {
            let walked = self.gaussian(self.noise.feature_motion_sigma);
            self.truth.features[i] += known + walked;
        }
    }

    /// Pairs at random, some of them perhaps more than once.
    fn some_pairs(&mut self) -> Vec<PairMeasurement> {
        let count = self.truth.features.len();
        let pairs = self.rng.random_range(1..=2 * count);
        (0..pairs)
            .map(|_| {
                let from = self.rng.random_range(0..count);
                let to = (from + self.rng.random_range(1..count)) % count;
                let true_z = self.truth.features[to] - self.truth.features[from];
                PairMeasurement {
                    from: FeatureId(from),
                    to: FeatureId(to),
                    z: true_z + self.gaussian(self.noise.structure_measurement_sigma),
                }
            })
            .collect()
    }

    /// Σⱼ (pᵢ − pⱼ + εᵢⱼ) for each i. As εⱼᵢ = −εᵢⱼ, the sums of the noise have the covariance
    /// σ² (M I − 1 1ᵀ), which √M (gᵢ − ḡ) has with independent gᵢ.
    fn sums(&mut self) -> Vec<Vector3<f64>> {
        let points = self.truth.features.clone();
        let count = points.len() as f64;
        let sigma = self.noise.structure_measurement_sigma * count.sqrt();
        let noise: Vec<Vector3<f64>> = points.iter().map(|_| self.gaussian(sigma)).collect();
        let (total, mean) = (
            points.iter().map(|p| p.coords).sum::<Vector3<f64>>(),
            noise.iter().sum::<Vector3<f64>>() / count,
        );
        points
            .iter()
            .zip(&noise)
            .map(|(p, noise)| p.coords * count - total + noise - mean)
            .collect()
    }
}
