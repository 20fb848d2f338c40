//! An estimator over a recorded log, and what it says of itself where the log has the truth.
//!
//!     cargo run --bin recorded_log -- samples/polygon.log.jsonl

use std::error::Error;
use std::fs::File;
use std::io::BufReader;
use std::path::PathBuf;

use adslam_agent::Estimators;
use adslam_diagnostics::Interrupt;
use adslam_names::EstimatorName;
use adslam_record::log::{FilterChoice, TailPolicy, filter_log};

fn main() -> Result<(), Box<dyn Error>> {
    let path = PathBuf::from(std::env::args().nth(1).ok_or("give the path of a log")?);
    for estimator in EstimatorName::OURS {
        let choice = FilterChoice {
            estimator: Some(estimator),
            ..FilterChoice::default()
        };
        let log = BufReader::new(File::open(&path)?);
        let each = &mut |_: &_| Ok(());
        let summary = filter_log(
            log,
            &path,
            choice,
            &Estimators::standard(),
            TailPolicy::Refuse,
            &Interrupt::new(),
            each,
        )?;
        let error = summary
            .numbers
            .errors
            .map_or(f64::NAN, |errors| errors.relative_pose_error_mean);
        println!(
            "{estimator:<20} {} steps, mean object-relative pose error {error:.4}",
            summary.steps
        );
    }
    Ok(())
}
