//! `adslam consistency`

use std::path::{Path, PathBuf};

use adslam_diagnostics::{Failure, Interrupt};
use adslam_experiment::consistency::{
    CHI_SQUARED_CONFIDENCE, ConsistencyCell, ConsistencyPlan, ConsistencyResults, Measure, Verdict,
};
use adslam_figures::{BandedMean, ConsistencyCurve, ConsistencyCurves, Method};
use adslam_names::EstimatorName;
use adslam_record::prepare_folder;
use adslam_scenario::registry::Registry;

use super::study::{finish, other_builds, tell_if_partial};
use crate::ConsistencyArgs;
use crate::answer::Answer;
use crate::paths::folder_of;

/// Does the runs of a consistency study that are not there yet, and says what they show.
///
/// # Errors
/// Bad input, runs that failed, files that cannot be written, or an interruption.
pub fn consistency(
    args: &ConsistencyArgs,
    registry: &Registry,
    interrupt: &Interrupt,
) -> Result<(), Failure> {
    Answer::give(args.json, |answer| judge(args, registry, interrupt, answer))
}

fn judge(
    args: &ConsistencyArgs,
    registry: &Registry,
    interrupt: &Interrupt,
    answer: &mut Answer,
) -> Result<(), Failure> {
    let all = registry.estimators().all().iter();
    let estimators: Vec<EstimatorName> = match args.estimators.as_slice() {
        [] => all.map(|entry| entry.name).collect(),
        some => some.to_vec(),
    };
    let plan = ConsistencyPlan::load_with(
        &args.config,
        &args.selection.selection(),
        &estimators,
        registry,
    )?;
    answer.warn(&plan.warnings());
    answer.set("title", &plan.title);
    let mut study = plan.open(&args.out, other_builds(args.accept_build))?;
    let end = finish(
        &mut study,
        &args.out,
        answer,
        interrupt,
        ConsistencyPlan::run,
    )?;
    if end.interrupted {
        return end.into_result();
    }
    let results = ConsistencyResults::new(&plan, study.records(), study.builds());
    answer.warn(&results.warnings);
    let files = study.write_results(|folder| write(&results, folder))?;
    answer.set_files(&files);
    answer.set("cells", &results.cells);
    for cell in &results.cells {
        let of_pose = cell.judgement(Measure::PoseNees);
        let pose = of_pose.map_or("no pose NEES".to_owned(), |judged| {
            let said = judged.verdict;
            format!("pose NEES {:.2} of 6, {said}", 6.0 * judged.mean)
        });
        let others: Vec<String> = cell
            .judgements
            .iter()
            .filter(|j| j.measure != Measure::PoseNees && j.verdict != Verdict::Consistent)
            .map(|j| format!("{} {}", j.measure.title(), j.verdict))
            .collect();
        let others = match others.as_slice() {
            [] => String::new(),
            some => format!("; {}", some.join(", ")),
        };
        answer.say(format_args!(
            "{}, {}, {}: {pose}{others}",
            cell.label, cell.estimator, cell.planner
        ));
    }
    answer.say(format_args!(
        "wrote consistency.md and {} other files to {}",
        files.len() - 1,
        folder_of(&files[0]).display()
    ));
    tell_if_partial(&study, answer);
    end.into_result()
}

/// The tables, and figures beside them.
fn write(results: &ConsistencyResults, folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut files = results.write(folder)?;
    let figures = folder.join("figures");
    prepare_folder(&figures)?;
    for label in results.labels() {
        for measure in [Measure::PoseNees, Measure::FeatureNis] {
            let figure = adslam_figures::consistency(&curves(label, measure, results))?;
            files.extend(figure.write(&figures)?);
        }
    }
    Ok(files)
}

/// A measure of an experiment as its figure takes it.
fn curves<'a>(
    label: &'a str,
    measure: Measure,
    results: &ConsistencyResults,
) -> ConsistencyCurves<'a> {
    let cells = results.cells.iter().filter(|cell| cell.label == label);
    let curve = |cell: &ConsistencyCell| {
        let means = cell.judgement(measure)?.steps.iter();
        Some(ConsistencyCurve {
            method: Method::new(cell.planner, cell.look.clone()),
            estimator: cell.estimator,
            estimator_look: cell.estimator_look.clone(),
            steps: means
                .map(|step| BandedMean {
                    step: step.step,
                    mean: step.mean,
                    low: step.interval.low,
                    high: step.interval.high,
                })
                .collect(),
        })
    };
    ConsistencyCurves {
        measure: measure.title(),
        label,
        runs: results.runs,
        confidence: CHI_SQUARED_CONFIDENCE,
        curves: cells.filter_map(curve).collect(),
    }
}
