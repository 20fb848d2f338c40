//! One step of the filter and its structure update, at sizes from the polygon's to 1000 features, beside the
//! matrix product that the machine does. Elements are floating-point operations, so that criterion's
//! "elem/s" are flop/s.
#![allow(clippy::unwrap_used, reason = "a bench stops where its numbers fail")]

mod common;
#[path = "common/eigenvectors.rs"]
mod eigenvectors;
#[path = "common/joint.rs"]
mod joint;
#[path = "../tests/common/mod.rs"]
mod textbook;

use std::hint::black_box;
use std::time::Duration;

use adslam_estimator::{
    Ekf, Estimator, FeatureMeasurement, Measurements, PairMeasurement, Parallelism,
    StructureMeasurements,
};
use adslam_models::FeatureId;
use common::{CASES, Case, NOISE, Step, belief};
use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use nalgebra::Vector3;

/// The smallest case that threads are tried on; smaller ones stay on one.
const THREADED: usize = 200;

/// Additions and multiplications to condition n entries on `rows` measured numbers: n² a row for the lower
/// triangle of P − VVᵀ, the least that any way needs. What making V and keeping P symmetric costs is
/// time that no operations are counted for.
fn conditioning(dim: usize, rows: usize) -> Throughput {
    Throughput::Elements((dim * dim * rows) as u64)
}

/// Of all pairs: three numbers for each contrast.
fn contrast_rows(case: Case) -> usize {
    3 * (case.features - 1)
}

fn matrix_product(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("matrix_product");
    for case in CASES {
        let n = case.dim();
        group.throughput(Throughput::Elements(2 * (n * n * n) as u64));
        let a = Mat::from_fn(n, n, |i, j| ((i * 7 + j * 13) % 101) as f64 / 101.0);
        let mut product = Mat::zeros(n, n);
        group.bench_function(BenchmarkId::new("fast", case.name), |bencher| {
            bencher.iter(|| {
                let product = black_box(product.as_mut());
                matmul(product, Accum::Replace, &a, &a, 1.0, Par::Seq);
            });
        });
    }
}

/// The filter on one thread and, where the state is large enough, on two.
fn filters(case: Case) -> Vec<(&'static str, rayon::ThreadPool, Ekf)> {
    let pool = |threads| {
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap()
    };
    let ekf = Ekf::new(NOISE).unwrap();
    let mut filters = vec![("fast", pool(1), ekf.clone())];
    if case.features >= THREADED {
        let two = ekf.with_parallelism(Parallelism::Rayon);
        filters.push(("fast_two_threads", pool(2), two));
    }
    filters
}

fn structure_update(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("structure_update");
    for case in CASES {
        let start = belief(case).unwrap();
        let step = Step::new(&start, case, 0);
        group.throughput(conditioning(case.dim(), contrast_rows(case)));
        for (variant, pool, mut ekf) in filters(case) {
            let mut belief = start.clone();
            group.bench_function(BenchmarkId::new(variant, case.name), |bencher| {
                pool.install(|| bencher.iter(|| step.update(&mut ekf, &mut belief, &[]).unwrap()));
            });
        }
        let mut p = joint::matrix(&start.covariance);
        group.bench_function(BenchmarkId::new("direct", case.name), |bencher| {
            bencher.iter(|| joint::update(&mut p, NOISE.structure_measurement_sigma).unwrap());
        });
        if case.name == "polygon" {
            bench_textbook(&mut group, case, &start, &[]);
        }
    }
}

/// A pair of features that is another one at each step, beside the whole update as it was before the elimination,
/// which took the eigenvectors of the new graph at each step.
fn changing_pair(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("changing_pair");
    for case in CASES {
        let start = belief(case).unwrap();
        group.throughput(conditioning(case.dim(), 3));
        let (mut ekf, mut belief) = (Ekf::new(NOISE).unwrap(), start.clone());
        let mut n = 0;
        group.bench_function(BenchmarkId::new("fast", case.name), |bencher| {
            bencher.iter(|| {
                n = (n + 1) % (case.features - 1);
                let features = &belief.state.features;
                let pair = PairMeasurement {
                    from: FeatureId(n),
                    to: FeatureId(n + 1),
                    z: features[n + 1] - features[n],
                };
                let measurements = Measurements {
                    features: &[],
                    structure: StructureMeasurements::Pairs(&[pair]),
                };
                ekf.update(&mut belief, &measurements).unwrap()
            });
        });
        let mut laplacian = Mat::<f64>::zeros(case.features, case.features);
        for (i, j, entry) in [(0, 0, 1.0), (1, 1, 1.0), (0, 1, -1.0), (1, 0, -1.0)] {
            laplacian[(i, j)] = entry;
        }
        let mut p = joint::matrix(&start.covariance);
        let sigma = NOISE.structure_measurement_sigma;
        group.bench_function(BenchmarkId::new("eigenvectors", case.name), |bencher| {
            bencher.iter(|| eigenvectors::update(&mut p, black_box(&laplacian), sigma).unwrap());
        });
    }
}

/// The propagation is linear in n but for keeping P symmetric, so this and the structure are the step.
fn feature_update(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("feature_update");
    for case in CASES {
        let start = belief(case).unwrap();
        let step = Step::new(&start, case, 0);
        let measurements = Measurements {
            features: &step.features,
            structure: StructureMeasurements::None,
        };
        group.throughput(conditioning(case.dim(), 3 * case.seen));
        for (variant, pool, mut ekf) in filters(case) {
            let mut belief = start.clone();
            let mut update = || ekf.update(&mut belief, &measurements).unwrap();
            group.bench_function(BenchmarkId::new(variant, case.name), |bencher| {
                pool.install(|| bencher.iter(&mut update));
            });
        }
    }
}

fn ekf_step(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("ekf_step");
    for case in CASES {
        let start = belief(case).unwrap();
        let step = Step::new(&start, case, 0);
        let rows = 3 * case.seen + contrast_rows(case);
        group.throughput(conditioning(case.dim(), rows));
        for (variant, pool, mut ekf) in filters(case) {
            let mut belief = start.clone();
            group.bench_function(BenchmarkId::new(variant, case.name), |bencher| {
                pool.install(|| bencher.iter(|| step.run(&mut ekf, &mut belief).unwrap()));
            });
        }
        if case.name == "polygon" {
            bench_textbook(&mut group, case, &start, &step.features);
        }
    }
}

/// Every row stacked, as Algorithm 1 is printed; with the propagation where features are seen.
fn bench_textbook(
    group: &mut BenchmarkGroup<'_, WallTime>,
    case: Case,
    belief: &adslam_estimator::Belief,
    features: &[FeatureMeasurement],
) {
    let p = textbook::covariance_matrix(belief);
    let step = Step::new(belief, case, 0);
    let pairs: Vec<PairMeasurement> = textbook::every_pair(case.features)
        .into_iter()
        .map(|(i, j)| PairMeasurement {
            from: FeatureId(i),
            to: FeatureId(j),
            z: Vector3::zeros(),
        })
        .collect();
    group.bench_function(BenchmarkId::new("textbook", case.name), |bencher| {
        bencher.iter(|| {
            if features.is_empty() {
                return textbook::update(&belief.state, &p, features, &pairs, &NOISE);
            }
            let (state, p) =
                textbook::propagate(&belief.state, &p, &step.control, &step.motion, &NOISE);
            textbook::update(&state, &p, features, &pairs, &NOISE)
        });
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600));
    targets = matrix_product, feature_update, structure_update, changing_pair, ekf_step
}
criterion_main!(benches);
