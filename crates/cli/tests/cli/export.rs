//! `adslam export`

use super::support::{Place, STEPS, polygon};

fn place() -> Place {
    let place = Place::new(&[("polygon.toml", &polygon(&[]))]);
    place.succeeds("run polygon.toml --planner global --out run");
    place
}

#[test]
fn every_format_is_written() {
    let place = place();
    let said = place.succeeds("export run --format csv --out new/state.csv");
    assert!(
        said.out.contains(&format!("wrote {STEPS} steps")),
        "{said:?}"
    );
    let rows = place.read("new/state.csv").lines().count();
    assert_eq!(rows, 1 + STEPS * (6 + 3 * 14));
    place.succeeds("export run --format ply --out new/ply");
    let files = std::fs::read_dir(place.path("new/ply")).unwrap().count();
    assert_eq!(files, 2 * STEPS);
    place.succeeds("mesh new/ply/surface-0001.ply --unit cm --features 14");
    place.succeeds("export run --format mcap --out new/run.mcap --period 0.5");
    let bytes = std::fs::read(place.path("new/run.mcap")).unwrap();
    assert!(bytes.starts_with(b"\x89MCAP0\r\n") && bytes.ends_with(b"\x89MCAP0\r\n"));
}

#[test]
fn what_cannot_be_exported_is_refused() {
    let place = place();
    std::fs::create_dir(place.path("empty")).unwrap();
    place.refuses(
        "export empty --format csv --out a.csv",
        &["empty/history.json", "cannot read"],
    );
    place.refuses(
        "export run --format las --out a.las",
        &["las", "mcap", "ply", "csv"],
    );
    for period in ["0", "-1", "NaN", "4000"] {
        let line = format!("export run --format mcap --out a.mcap --period={period}");
        place.refuses(&line, &["s apart", "up to 3600"]);
    }
    place.refuses("export run --format ply --out polygon.toml", &["is a file"]);
    place.refuses("export run --format csv --out run", &["is a folder"]);
}
