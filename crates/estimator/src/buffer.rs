//! Memory that is kept.

use std::ops::{Deref, DerefMut};

use faer::Mat;

/// A matrix to write results into. It keeps the room for as many rows, and as many columns, as it ever had.
#[derive(Clone, Debug)]
pub(crate) struct Buffer {
    matrix: Mat<f64>,
    most_rows: usize,
    most_columns: usize,
}

impl Default for Buffer {
    fn default() -> Self {
        Self {
            matrix: Mat::new(),
            most_rows: 0,
            most_columns: 0,
        }
    }
}

impl Buffer {
    /// Gives it a size; what it held is of no interest.
    pub(crate) fn reshape(&mut self, rows: usize, columns: usize) {
        // Without this, more columns would be paid for with fewer rows, and the other way round.
        self.most_rows = self.most_rows.max(rows);
        self.most_columns = self.most_columns.max(columns);
        self.matrix.reserve(self.most_rows, self.most_columns);
        self.matrix.resize_with(rows, columns, |_, _| 0.0);
    }
}

impl Deref for Buffer {
    type Target = Mat<f64>;

    fn deref(&self) -> &Mat<f64> {
        &self.matrix
    }
}

impl DerefMut for Buffer {
    fn deref_mut(&mut self) -> &mut Mat<f64> {
        &mut self.matrix
    }
}
