//! What planning asks of a surface, for the paper's two objects: the polygon of 14 features, and
//! the hull of 50 features picked from the heart. The whole mesh of the heart stands for the
//! surfaces that are large enough for a tree of boxes.
#![allow(
    clippy::unwrap_used,
    reason = "a failed preparation is a failed benchmark"
)]

#[path = "../tests/common/mod.rs"]
mod common;

use std::hint::black_box;
use std::sync::Arc;
use std::time::Duration;

use adslam_surface::{DEFAULT_PHANTOM_SPACING_CM, Surface, Topology, heart_phantom, pick_features};
use common::Point;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};

fn objects() -> [(&'static str, Surface); 3] {
    let heart = heart_phantom(DEFAULT_PHANTOM_SPACING_CM).unwrap();
    let picked = pick_features(&heart, 50, 1).unwrap();
    let features: Vec<Point> = picked.iter().map(|&i| heart.vertices[i]).collect();
    let mesh = Arc::new(Topology::from_faces(&heart.vertices, &heart.faces).unwrap());
    [
        ("polygon", common::hull(&common::polygon())),
        ("heart50", common::hull(&features)),
        ("heart_mesh", Surface::new(&mesh, &heart.vertices).unwrap()),
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

fn visibility(c: &mut Criterion) {
    let mut group = c.benchmark_group("visibility");
    group
        .sampling_mode(SamplingMode::Flat)
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(700));

    for (name, surface) in &objects() {
        let viewpoints = viewpoints(surface);
        let points = surface.points().len();

        // All lines of sight from all viewpoints; a few of them only for the mesh.
        let stride = points.div_ceil(50);
        let targets: Vec<usize> = (0..points).step_by(stride).collect();
        group.throughput(Throughput::Elements(
            (viewpoints.len() * targets.len()) as u64,
        ));
        group.bench_function(BenchmarkId::new("sees", name), |b| {
            b.iter(|| {
                let lines = viewpoints
                    .iter()
                    .flat_map(|v| targets.iter().map(move |&i| (v, i)));
                lines
                    .filter(|(v, i)| surface.sees(black_box(v), *i))
                    .count()
            });
        });

        group.throughput(Throughput::Elements(viewpoints.len() as u64));
        group.bench_function(BenchmarkId::new("signed_distance", name), |b| {
            b.iter(|| -> f64 {
                let distances = viewpoints
                    .iter()
                    .map(|v| surface.signed_distance(black_box(v)));
                distances.sum()
            });
        });

        let topology = Arc::new(surface.topology().clone());
        group.throughput(Throughput::Elements(1));
        group.bench_function(BenchmarkId::new("surface_new", name), |b| {
            b.iter(|| Surface::new(&topology, black_box(surface.points())).unwrap());
        });
    }

    group.finish();
}

criterion_group!(benches, visibility);
criterion_main!(benches);
