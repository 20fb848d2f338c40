//! What planning asks of a surface: the polygon of 14 features, and hulls of features picked from the
//! heart. Variants: `fast`, all lines of sight from one place at once; `one_by_one`.
#![allow(
    clippy::unwrap_used,
    reason = "a failed preparation is a failed benchmark"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;
use std::time::Duration;

use adslam_surface::{DEFAULT_PHANTOM_SPACING_CM, Fan, Surface, heart_phantom, pick_features};
use common::Point;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn objects() -> [(&'static str, Surface); 4] {
    let heart = heart_phantom(DEFAULT_PHANTOM_SPACING_CM).unwrap();
    let hull_of = |count| {
        let picked = pick_features(&heart, count, 1).unwrap();
        let features: Vec<Point> = picked.iter().map(|&i| heart.vertices[i]).collect();
        common::hull(&features)
    };
    [
        ("polygon", common::hull(&common::polygon())),
        ("heart50", hull_of(50)),
        ("heart200", hull_of(200)),
        ("heart500", hull_of(500)),
    ]
}

/// A lattice of 5 × 5 × 5 positions in the surface's box, enlarged twice; none inside of it.
fn viewpoints(surface: &Surface) -> Vec<Point> {
    let first = surface.points()[0];
    let (low, high) = surface
        .points()
        .iter()
        .fold((first, first), |(low, high), p| (low.inf(p), high.sup(p)));
    let shares: Vec<f64> = (0..5).map(|i| -0.5 + 0.5 * f64::from(i)).collect();
    let mut all = Vec::new();
    for &x in &shares {
        for &y in &shares {
            for &z in &shares {
                let share = nalgebra::Vector3::new(x, y, z);
                all.push(low + (high - low).component_mul(&share));
            }
        }
    }
    all.retain(|v| surface.signed_distance(v) > 0.0);
    all
}

/// All lines of sight from all viewpoints.
fn visibility(c: &mut Criterion) {
    let mut group = c.benchmark_group("visibility");
    for (name, surface) in &objects() {
        let viewpoints = viewpoints(surface);
        let points = surface.points().len();
        group.throughput(Throughput::Elements((viewpoints.len() * points) as u64));
        group.bench_function(BenchmarkId::new("fast", name), |b| {
            let mut fan = Fan::default();
            b.iter(|| {
                let seen = |v| fan.seen(surface, black_box(v), 0..points).len();
                viewpoints.iter().map(seen).sum::<usize>()
            });
        });
        group.bench_function(BenchmarkId::new("one_by_one", name), |b| {
            b.iter(|| {
                let seen = |v| {
                    (0..points)
                        .filter(|&i| surface.sees(black_box(v), i))
                        .count()
                };
                viewpoints.iter().map(seen).sum::<usize>()
            });
        });
    }
    group.finish();
}

/// What else is asked of a surface at every step.
fn surface(c: &mut Criterion) {
    let mut group = c.benchmark_group("surface");
    for (name, surface) in &objects() {
        let viewpoints = viewpoints(surface);
        group.throughput(Throughput::Elements(viewpoints.len() as u64));
        group.bench_function(BenchmarkId::new("signed_distance", name), |b| {
            b.iter(|| -> f64 {
                let distance = |v| surface.signed_distance(black_box(v));
                viewpoints.iter().map(distance).sum()
            });
        });
        group.throughput(Throughput::Elements(1));
        group.bench_function(BenchmarkId::new("place", name), |b| {
            let points = surface.points().to_vec();
            let mut surface = surface.clone();
            b.iter(|| surface.place(black_box(&points)).unwrap());
        });
    }
    group.finish();
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(700));
    targets = visibility, surface
}
criterion_main!(benches);
