//! On how many threads one step of the filter runs.

/// The threads of one filter step. The choice changes no result, not even its last bit: the work
/// is cut into the same pieces whoever does them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Parallelism {
    /// The calling thread alone: right wherever whole runs are spread over the cores.
    #[default]
    Sequential,
    /// The rayon pool that the caller is in (the global one outside any), for states that are large
    /// enough to gain by it; smaller ones stay on one thread.
    Rayon,
}

/// The smallest state dimension that gains by threads: below it, waking them costs as much as it saves.
const PARALLEL_DIM: usize = 500;

impl Parallelism {
    /// The same choice, or one thread where the state is too small.
    pub(crate) fn for_dim(self, dim: usize) -> Self {
        if dim < PARALLEL_DIM {
            Self::Sequential
        } else {
            self
        }
    }

    /// Does both, in any order.
    pub(crate) fn join(self, a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
        match self {
            Self::Sequential => {
                a();
                b();
            }
            Self::Rayon => {
                rayon::join(a, b);
            }
        }
    }
}
