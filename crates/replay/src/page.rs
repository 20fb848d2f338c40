//! The page around the runs.

use adslam_record::RunHistory;

/// How many runs a page can show beside each other.
pub const MOST_RUNS: usize = 2;

const TEMPLATE: &str = include_str!("../web/page.html");
const SCRIPT: &str = include_str!("../web/dist/replay.js");
const STYLE: &str = include_str!("../web/dist/replay.css");
const LICENCES: &str = include_str!("../web/dist/LICENSES.txt");

/// What the browser's tab is called.
pub(crate) fn title(histories: &[&RunHistory]) -> String {
    let runs: Vec<String> = histories
        .iter()
        .map(|run| format!("{}, {}, seed {}", run.scenario, planner(run), run.seed))
        .collect();
    runs.join(" | ")
}

/// What its planner is called.
fn planner(run: &RunHistory) -> &str {
    let look = run.planner_look.as_ref();
    look.map_or(run.planner.as_str(), |look| &look.label)
}

/// Fills the template. What is put in is not looked at again, whatever it contains.
pub(crate) fn fill(title: &str, runs: &str) -> String {
    let title = text(title);
    let size = TEMPLATE.len() + SCRIPT.len() + STYLE.len() + LICENCES.len() + runs.len();
    let mut page = String::with_capacity(size + title.len());
    for (i, part) in TEMPLATE.split("{{").enumerate() {
        let Some((name, rest)) = part.split_once("}}").filter(|_| i > 0) else {
            page.push_str(part);
            continue;
        };
        page.push_str(match name {
            "title" => &title,
            "licences" => LICENCES,
            "style" => STYLE,
            "script" => SCRIPT,
            "runs" => runs,
            _ => "",
        });
        page.push_str(rest);
    }
    page
}

/// Text as HTML shows it.
fn text(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_holds_all_parts_once_and_nothing_from_elsewhere() {
        let page = fill("a <b> & {{script}}", "RUNS {{style}}");
        assert!(page.contains("<title>a &lt;b&gt; &amp; {{script}}"));
        assert_eq!(page.matches("RUNS {{style}}").count(), 1);
        assert_eq!(page.matches(SCRIPT).count(), 1);
        assert_eq!(page.matches(STYLE).count(), 1);
        assert!(page.contains("Copyright") && page.contains("three.js"));
        let outside = page.replace(SCRIPT, "").replace(LICENCES, "");
        assert!(!outside.contains("://"), "the page asks nobody");
        assert!(page.contains("default-src 'none'"));
    }

    #[test]
    fn the_bundle_cannot_end_its_own_element() {
        assert!(!SCRIPT.contains("</script") && !STYLE.contains("</style"));
        assert!(!SCRIPT.contains("<!--") && !LICENCES.contains("--"));
    }
}
