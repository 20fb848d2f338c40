//! The figures of an experiment, as images inside the page.

use adslam_experiment::tables::{ExperimentTables, PlannerRuns};
use adslam_figures::{
    Figure, FigureError, Method, RunsOfMethod, boxes, comparison, coverage, environments,
    estimates, nees, pose_error,
};
use adslam_record::RunHistory;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{Markup, html};

/// A figure with what stands below it.
struct Drawing {
    caption: &'static str,
    figure: Result<Figure, FigureError>,
}

/// All figures of an experiment: those of its recorded runs, and those over all runs.
pub(crate) fn figures(experiment: &ExperimentTables) -> Markup {
    let runs: Vec<&RunHistory> = experiment.histories.iter().collect();
    let first: Vec<&RunHistory> = runs.first().copied().into_iter().collect();
    let mut drawings = Vec::new();
    if !runs.is_empty() {
        drawings = vec![
            Drawing {
                caption: "The object at the start: what is drawn, and the features with the \
                          surface that they span.",
                figure: environments("environment", &first),
            },
            Drawing {
                caption: "True and estimated path and features of each method, with the \
                          estimates' ellipsoids of three sigmas.",
                figure: estimates("estimates", &runs),
            },
            Drawing {
                caption: "Pose error and decision time against the step. The times are the \
                          only numbers that differ from machine to machine.",
                figure: comparison("comparison", &runs),
            },
            Drawing {
                caption: "Error of each coordinate of the pose within three sigmas of the filter.",
                figure: pose_error("pose-error", &runs),
            },
            Drawing {
                caption: "Consistency: the pose's NEES, with the bounds within which 95 % of \
                          χ² with 6 degrees of freedom lie.",
                figure: nees("nees", &runs),
            },
            Drawing {
                caption: "Features seen at least once, and observed feature times so far.",
                figure: coverage("coverage", &runs),
            },
        ];
    }
    if experiment.planners.iter().any(|p| !p.runs.is_empty()) {
        drawings.push(Drawing {
            caption: "Every number of the tables over all runs: quartiles, whiskers, and each \
                      run as a dot.",
            figure: boxes("boxes", &experiment.label, &runs_of_methods(experiment)),
        });
    }
    html! {
        @for drawing in &drawings { (drawing.markup()) }
    }
}

/// The runs of an experiment as box plots take them.
#[must_use]
pub fn runs_of_methods(experiment: &ExperimentTables) -> Vec<RunsOfMethod<'_>> {
    let of = |planner: &'_ PlannerRuns| Method::new(planner.planner, planner.look.clone());
    let planners = experiment.planners.iter();
    planners
        .map(|planner| RunsOfMethod {
            method: of(planner),
            runs: &planner.runs,
        })
        .collect()
}

impl Drawing {
    /// A figure that cannot be drawn is no reason to lose the others.
    fn markup(&self) -> Markup {
        html! {
            figure {
                @match &self.figure {
                    // An image of its own, so that no name in it meets one of another figure.
                    Ok(figure) => img src=(data_uri(figure.svg())) alt=(figure.title());
                    Err(error) => p .warning { (error) }
                }
                figcaption { (self.caption) }
            }
        }
    }
}

fn data_uri(svg: &str) -> String {
    format!(
        "data:image/svg+xml;base64,{}",
        BASE64_STANDARD.encode(svg.as_bytes())
    )
}
