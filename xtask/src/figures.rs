//! `cargo xtask reproduce-figures`

use std::path::PathBuf;
use std::process::ExitCode;

use adslam_cli::{FAILURE, exit_code};
use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::simulate;
use adslam_experiment::tables::TablePlan;
use adslam_figures::{
    Figure, FigureError, boxes, comparison, coverage, environments, estimates, nees, pose_error,
};
use adslam_record::{HistoryRecorder, RunHistory, prepare_folder};
use adslam_report::runs_of_methods;
use adslam_scenario::config::{Config, Selection};
use adslam_scenario::{Object, Scenario};
use adslam_setup::Setup;
use clap::Args;

use crate::environment::Environment;
use crate::paper;

/// The arguments of the task.
#[derive(Debug, Args)]
pub struct FiguresArgs {
    /// The seed of the runs that are drawn
    #[arg(long, default_value_t = 1, value_name = "N")]
    seed: u64,
    /// The folder to write to; made if it does not exist
    #[arg(long, default_value = "results/figures", value_name = "DIR")]
    out: PathBuf,
    /// Which environment
    #[arg(long, default_value = "all")]
    scenario: Environment,
    /// Runs of each method in the box plots; 0 for no box plots
    #[arg(long, default_value_t = 5, value_name = "N")]
    runs: usize,
    /// An STL, OBJ or PLY file, in mm, to take for the heart in place of the built-in phantom
    #[arg(long, value_name = "FILE")]
    mesh: Option<PathBuf>,
}

/// Does it, says what was written, and returns the exit code.
pub fn reproduce(args: &FiguresArgs, interrupt: &Interrupt) -> ExitCode {
    match args.draw(interrupt) {
        Ok(()) => ExitCode::SUCCESS,
        Err(FigureError::Output(error)) => exit_code(Err(error)),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(FAILURE)
        }
    }
}

/// An environment of the paper with one run of each method.
struct Recorded {
    label: String,
    histories: Vec<RunHistory>,
}

impl FiguresArgs {
    fn draw(&self, interrupt: &Interrupt) -> Result<(), FigureError> {
        prepare_folder(&self.out).map_err(Failure::from)?;
        let recorded = self.record(interrupt)?;
        let first = |r: &'_ Recorded| r.histories.first().cloned();
        let objects: Vec<RunHistory> = recorded.iter().filter_map(first).collect();
        let objects: Vec<&RunHistory> = objects.iter().collect();
        self.write(&environments("figure-1", &objects)?)?;
        for Recorded { label, histories } in &recorded {
            let runs: Vec<&RunHistory> = histories.iter().collect();
            // Figures 2 and 4 of the paper are the polygon's, 3 and 5 the heart's.
            let (paths, curves) = match label.as_str() {
                "polygon" => ("figure-2".to_owned(), "figure-4".to_owned()),
                "heart" => ("figure-3".to_owned(), "figure-5".to_owned()),
                label => (format!("estimates-{label}"), format!("comparison-{label}")),
            };
            self.write(&estimates(&paths, &runs)?)?;
            self.write(&comparison(&curves, &runs)?)?;
            self.write(&pose_error(&format!("pose-error-{label}"), &runs)?)?;
            self.write(&nees(&format!("nees-{label}"), &runs)?)?;
            self.write(&coverage(&format!("coverage-{label}"), &runs)?)?;
        }
        if self.runs > 0 {
            self.draw_boxes(interrupt)?;
        }
        Ok(())
    }

    /// Runs every method once in every environment that is asked for; one after the other, so
    /// that none slows down the decisions of another.
    fn record(&self, interrupt: &Interrupt) -> Result<Vec<Recorded>, Failure> {
        let config = Config::load(&paper())?;
        let wanted = self.scenario.labels();
        let mut recorded = Vec::new();
        for plan in config.experiments {
            if !(wanted.is_empty() || wanted.contains(&plan.label)) {
                continue;
            }
            let setup = Setup::new(&self.with_mesh(plan.scenario))?;
            let mut histories = Vec::new();
            for planner in plan.planners {
                eprintln!("running {}, {planner}, seed {}", plan.label, self.seed);
                let mut recorder = HistoryRecorder::new(&setup.model, planner, self.seed);
                simulate(&setup, planner, self.seed, interrupt, &mut recorder)?;
                histories.push(recorder.into_history());
            }
            recorded.push(Recorded {
                label: plan.label,
                histories,
            });
        }
        Ok(recorded)
    }

    fn with_mesh(&self, scenario: Scenario) -> Scenario {
        match (&self.mesh, &scenario.object) {
            (Some(file), Object::Mesh(_) | Object::Phantom(_)) => scenario.with_mesh(file),
            _ => scenario,
        }
    }

    /// The box plots over many runs, from the tables' own seeds.
    fn draw_boxes(&self, interrupt: &Interrupt) -> Result<(), FigureError> {
        let selection = Selection {
            runs: Some(self.runs),
            only: self.scenario.labels(),
            mesh: self.mesh.clone(),
        };
        let plan = TablePlan::load(&paper(), &selection).map_err(Failure::from)?;
        eprintln!("running {} more for the box plots", plan.total_runs());
        let tables = plan.run(interrupt, &|| ());
        for experiment in &tables.experiments {
            let name = format!("boxes-{}", experiment.label);
            let runs = runs_of_methods(experiment);
            self.write(&boxes(&name, &experiment.label, &runs)?)?;
        }
        Ok(tables.into_result()?)
    }

    fn write(&self, figure: &Figure) -> Result<(), FigureError> {
        let [svg, png] = figure.write(&self.out)?;
        println!("wrote {} and {}", svg.display(), png.display());
        Ok(())
    }
}
