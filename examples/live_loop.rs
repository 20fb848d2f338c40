//! A robot's own loop: it reads a log line by line from standard input, as a robot would send it, and answers each
//! step with the pose that it believes in.
//!
//!     adslam run scenarios/polygon.toml --planner combined --out runs/live --log
//!     cargo run --bin live_loop < runs/live/log.jsonl

use std::error::Error;
use std::io::{self, BufReader, Write};
use std::path::Path;

use adslam_agent::Estimators;
use adslam_record::log::{FilterChoice, Replay};
use serde_json::json;

fn main() -> Result<(), Box<dyn Error>> {
    let name = Path::new("standard input");
    let mut agent = Replay::new(
        BufReader::new(io::stdin()),
        name,
        FilterChoice::default(),
        &Estimators::standard(),
    )?;
    let mut out = io::stdout().lock();
    while let Some(step) = agent.advance()? {
        let belief = agent.belief();
        let sigma = belief.covariance.pose().diagonal().map(f64::sqrt);
        let pose = belief.state.pose.to_vector();
        writeln!(
            out,
            "{}",
            json!({ "step": step, "pose": pose.as_slice(), "sigma": sigma.as_slice() })
        )?;
        out.flush()?;
    }
    Ok(())
}
