//! `adslam run`

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::run::{PAGE_FILE, RunRecorder, RunReport, simulate};
use adslam_record::Observer;
use adslam_record::log::LogRecorder;
use adslam_scenario::Scenario;
use adslam_scenario::registry::Registry;
use adslam_setup::Setup;
use adslam_simulation::StepView;
use indicatif::ProgressBar;

use crate::answer::Answer;
use crate::{RunArgs, progress};

/// Runs one planner once and writes the run into a folder.
///
/// # Errors
/// Bad input, a failure of the run, or an interruption.
pub fn run(args: &RunArgs, registry: &Registry, interrupt: &Interrupt) -> Result<(), Failure> {
    Answer::give(args.json, |answer| {
        run_once(args, registry, interrupt, answer)
    })
}

fn run_once(
    args: &RunArgs,
    registry: &Registry,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), Failure> {
    let mut scenario = Scenario::load_with(&args.scenario, registry)?;
    if let Some(mesh) = &args.mesh {
        scenario = scenario.with_mesh(mesh);
    }
    let setup = Setup::new(&scenario)?;
    answer.warn(&setup.warnings);
    let recorder = RunRecorder::create(&args.out, &setup, args.planner, args.seed, args.unit)?;
    let log = || LogRecorder::create(&args.out, &setup.model, args.planner, args.seed);
    let mut observer = Shown {
        recorder,
        log: args.log.then(log).transpose()?,
        bar: progress::bar(setup.model.steps, "steps"),
    };
    let result = simulate(&setup, args.planner, args.seed, interrupt, &mut observer);
    observer.bar.finish_and_clear();
    let outcome = result?;
    answer.warn(&outcome.warnings);
    let Shown { recorder, log, .. } = observer;
    let page = || adslam_replay::to_file(&[recorder.history()], &args.out.join(PAGE_FILE));
    let page = args.html.then(page).transpose()?;
    let others = page.into_iter().chain(log.map(LogRecorder::finish));
    let warnings = [setup.warnings.as_slice(), &outcome.warnings].concat();
    let summary = &outcome.summary;
    let report = RunReport {
        summary,
        warnings: &warnings,
    };
    let files = recorder.commit(&report, others.collect())?;
    let coverage = summary
        .steps_to_full_coverage
        .map_or("not all seen".to_owned(), |step| {
            format!("all seen at step {step}")
        });
    answer.set("scenario", setup.name());
    answer.set("planner", args.planner.as_str());
    answer.set("summary", report);
    answer.set_files(&files);
    answer.say(format_args!(
        "{}, {}, seed {}: observed {} feature times, {coverage}, mean pose error {:.3} (drift \
         floor {:.3}), mean feature error {:.3} cm",
        setup.name(),
        args.planner,
        args.seed,
        summary.observed,
        summary.pose_error_mean,
        summary.drift_floor_mean,
        summary.feature_error_mean
    ));
    let names: Vec<String> = files
        .iter()
        .filter_map(|f| Some(f.file_name()?.to_string_lossy().into_owned()))
        .collect();
    answer.say(format_args!(
        "wrote {} to {}",
        names.join(", "),
        args.out.display()
    ));
    Ok(())
}

/// Writes the run down and shows how far it is.
struct Shown {
    recorder: RunRecorder,
    log: Option<LogRecorder>,
    bar: ProgressBar,
}

impl Observer for Shown {
    fn step(&mut self, view: &StepView<'_>) -> Result<(), Failure> {
        self.bar.set_position(view.step as u64);
        if let Some(log) = &mut self.log {
            log.step(view)?;
        }
        self.recorder.step(view)
    }
}
