use super::*;
use adslam_models::FeatureId;
use nalgebra::DMatrix;
use proptest::prelude::*;

const COUNT: usize = 14;

fn pairs(list: &[(usize, usize)]) -> Vec<PairMeasurement> {
    list.iter()
        .map(|&(from, to)| PairMeasurement {
            from: FeatureId(from),
            to: FeatureId(to),
            z: Vector3::zeros(),
        })
        .collect()
}

fn graph(list: &[(usize, usize)]) -> PairGraph {
    let mut graph = PairGraph::default();
    assert!(!graph.read(&pairs(list), COUNT), "not all pairs");
    graph
}

/// C, with a column for each row of measurements.
fn factor(graph: &PairGraph) -> DMatrix<f64> {
    DMatrix::from_fn(COUNT, graph.rank(), |i, k| {
        graph.factor[(i, graph.order[k])]
    })
}

fn laplacian(list: &[(usize, usize)]) -> DMatrix<f64> {
    let mut l = DMatrix::zeros(COUNT, COUNT);
    for &(a, b) in list {
        for (i, j, sign) in [(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)] {
            l[(i, j)] += sign;
        }
    }
    l
}

/// Any pairs, from one to a tangle, some more than once.
fn any_pairs() -> impl Strategy<Value = Vec<(usize, usize)>> {
    let pair = (0..COUNT, 1..COUNT).prop_map(|(from, step)| (from, (from + step) % COUNT));
    prop::collection::vec(pair, 1..3 * COUNT)
}

proptest! {
    #[test]
    fn the_rows_say_what_the_pairs_say(list in any_pairs()) {
        let graph = graph(&list);
        let (c, l) = (factor(&graph), laplacian(&list));
        prop_assert!((&c * c.transpose() - &l).amax() < 1e-13 * l.amax());
        let eigenvalues = l.symmetric_eigenvalues();
        let rank = eigenvalues.iter().filter(|value| **value > 1e-10).count();
        prop_assert_eq!(graph.rank(), rank);
    }

    /// The two ways to make P Hᵀ and S of some rows.
    #[test]
    fn both_ways_are_the_same(
        list in any_pairs(), root in prop::collection::vec(-1.0..1.0, 48 * 48)
    ) {
        let root = DMatrix::from_vec(48, 48, root);
        let p: DMatrix<f64> = &root * root.transpose();
        let covariance = Covariance::from_lower(48, |i, j| p[(i, j)]);
        let graph = graph(&list);
        let (mut few, mut all) = (Workspace::default(), Workspace::default());
        for block in blocks(0..graph.rank(), 48) {
            for work in [&mut few, &mut all] {
                work.prepare(48, 1);
                work.start_block(3 * block.len());
            }
            graph.set_few_products(&covariance, block.clone(), &mut few);
            graph.set_all_products(&covariance, block, &mut all, Parallelism::Sequential);
            let [(a, s), (b, t)] =
                [&few, &all].map(|work| (&work.products, &work.innovation_covariance));
            prop_assert!((&**a - &**b).norm_max() < 1e-9);
            prop_assert!((&**s - &**t).norm_max() < 1e-9);
        }
    }
}

/// What makes few pairs cheap: nothing is filled in where pairs form trees.
#[test]
fn each_pair_of_a_tree_is_a_row_of_two_entries() {
    let chain: Vec<_> = (1..COUNT).map(|i| (i - 1, i)).collect();
    let star: Vec<_> = (1..COUNT).map(|i| (i, 0)).collect();
    let apart = [(3, 9), (0, 13), (4, 5)];
    for list in [&chain[..], &star, &apart] {
        let graph = graph(list);
        assert_eq!(graph.rank(), list.len());
        for row in 0..graph.rank() {
            let mut entries: Vec<f64> = graph.entries(row).map(|(_, entry)| entry).collect();
            entries.sort_by(f64::total_cmp);
            assert_eq!(entries, [-1.0, 1.0]);
        }
    }
}

#[test]
fn the_same_pairs_are_factored_once() {
    let mut graph = graph(&[(0, 1), (1, 2)]);
    graph.factor[(0, 0)] = 7.0;
    assert!(!graph.read(&pairs(&[(2, 1), (1, 0)]), COUNT));
    assert_eq!(graph.factor[(0, 0)], 7.0, "kept");
    assert!(!graph.read(&pairs(&[(2, 1), (2, 0)]), COUNT));
    assert_ne!(graph.factor[(0, 0)], 7.0, "made anew");
}

#[test]
fn all_pairs_once_are_told_from_any_others() {
    let every: Vec<_> = (0..COUNT)
        .flat_map(|j| (0..j).map(move |i| (i, j)))
        .collect();
    let mut graph = PairGraph::default();
    assert!(graph.read(&pairs(&every), COUNT));
    assert!(!graph.read(&pairs(&every[1..]), COUNT));
    assert!(!graph.read(&pairs(&[&every[..], &every[..]].concat()), COUNT));
    assert!(!graph.read(&pairs(&[(0, 1)]), COUNT));
}
