//! What a page holds, and how large it gets.

mod common;

use std::fs;

use adslam_names::PlannerName;
use adslam_record::HISTORY_FILE;
use adslam_replay::{EmbedError, embedded_histories, html, write_html};
use common::history;

const MEGABYTE: usize = 1_000_000;

#[test]
fn the_runs_of_a_page_are_those_that_it_was_made_from() {
    let mut first = history("polygon", PlannerName::COMBINED, 5);
    first.scenario = "</script><script>alert('& <!--')\u{2028}".to_owned();
    let second = history("polygon", PlannerName::LOCAL, 4);
    let page = html(&[&first, &second]).unwrap();
    assert_eq!(embedded_histories(&page).unwrap(), [first.clone(), second]);
    assert_eq!(
        page.matches("</script>").count(),
        3,
        "two runs and the program"
    );
    assert!(!page.contains("<script>alert"));
    let page = html(&[&first]).unwrap();
    assert_eq!(embedded_histories(&page).unwrap(), [first]);
}

#[test]
fn a_heart_of_50_features_and_200_steps_stays_below_5_megabytes() {
    let folder = tempfile::tempdir().unwrap();
    let run = history("heart", PlannerName::GLOBAL, 200);
    run.to_file(folder.path()).unwrap().commit().unwrap();
    let stored = fs::metadata(folder.path().join(HISTORY_FILE)).unwrap();
    assert!(stored.len() < 3 * MEGABYTE as u64, "{}", stored.len());
    let out = folder.path().join("replay.html");
    let size = write_html(&[&run], &out).unwrap();
    assert_eq!(fs::metadata(&out).unwrap().len(), size as u64);
    assert!(size < 3 * MEGABYTE, "{size}");
    let size = write_html(&[&run, &run], &out).unwrap();
    assert!(size < 5 * MEGABYTE, "{size}");
}

#[test]
fn what_makes_no_page_is_refused_and_changes_nothing() {
    let run = history("polygon", PlannerName::PREDETERMINED, 2);
    assert!(matches!(html(&[]), Err(EmbedError::Count(0))));
    assert!(matches!(
        html(&[&run, &run, &run]),
        Err(EmbedError::Count(3))
    ));
    let mut broken = run.clone();
    broken.steps[1].features.pop();
    assert!(matches!(html(&[&broken]), Err(EmbedError::DoesNotFit(_))));
    assert!(embedded_histories("<html></html>").is_err());

    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("replay.html");
    fs::write(&out, "before").unwrap();
    let error = write_html(&[&broken], &out).unwrap_err();
    assert!(error.is_bad_input() && error.to_string().contains("no replay can be made"));
    assert_eq!(fs::read_to_string(&out).unwrap(), "before");
}
