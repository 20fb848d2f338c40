//! `adslam replay`, and `adslam run --html`

use super::support::{Place, STEPS, polygon};

#[test]
fn one_run_and_two_make_pages_that_need_no_network() {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    let said = place.succeeds("run polygon.toml --planner local --out local --html");
    assert!(said.out.contains("replay.html"), "{said:?}");
    place.succeeds("run polygon.toml --planner combined --out combined");
    assert!(
        !place.path("combined/replay.html").exists(),
        "only if asked for"
    );
    let history = place.json("combined/history.json");
    assert_eq!(history["steps"].as_array().unwrap().len(), STEPS);

    place.succeeds("replay local combined --out pages/both.html");
    place.succeeds("replay local --out pages/local.html");
    assert_eq!(
        place.read("pages/local.html"),
        place.read("local/replay.html")
    );
    for page in ["pages/local.html", "pages/both.html"] {
        let page = place.read(page);
        assert!(page.len() < 5_000_000);
        let from_elsewhere = ["src=\"http", "href=\"http", "src='http", "@import"];
        assert!(from_elsewhere.iter().all(|link| !page.contains(link)));
    }
}

#[test]
fn a_folder_without_a_run_is_refused() {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    std::fs::create_dir(place.path("empty")).unwrap();
    place.refuses(
        "replay empty --out page.html",
        &["empty/history.json", "cannot read"],
    );
    place.succeeds("run polygon.toml --planner local --out local");
    let cut = &place.read("local/history.json")[..500];
    std::fs::write(place.path("local/history.json"), cut).unwrap();
    place.refuses("replay local --out page.html", &["local/history.json"]);
    assert!(!place.path("page.html").exists());
    place.refuses(
        "replay local local local --out page.html",
        &["no more were expected"],
    );
}
