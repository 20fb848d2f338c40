// What a view says about its run at this step, and the scale of the candidates' colours.

import { methodColour, methodLabel, VIRIDIS_CSS } from "../colours";
import { decisionAt, type History, stepAt } from "../history";
import { goalAt, traceRange } from "../scene/plan";
import { h, short } from "./dom";

export class Hud {
  readonly element: HTMLElement;
  readonly #facts = h("dl");
  readonly #warning = h("p", { class: "warning", hidden: true });
  readonly #scale: HTMLElement;
  readonly #best = h("span");
  readonly #worst = h("span");

  constructor(private readonly history: History) {
    const colour = methodColour(history);
    this.#scale = h(
      "div",
      { class: "scale", hidden: true },
      h("b", {}, "Candidate actions"),
      " by trace(P), rad² + cm²",
      h("div", { class: "bar", style: `background:${VIRIDIS_CSS}` }),
      h("div", { class: "ends" }, this.#best, this.#worst),
    );
    this.element = h(
      "div",
      { class: "hud" },
      h(
        "div",
        { class: "card facts" },
        h(
          "h2",
          { style: `--c:${colour}` },
          h("span", { class: "dot" }),
          methodLabel(history),
          h("small", {}, ` ${history.scenario}, seed ${history.seed}`),
        ),
        this.#facts,
        this.#warning,
      ),
      this.#scale,
    );
  }

  show(index: number, candidates: boolean): void {
    const { history } = this;
    const step = stepAt(history, index);
    const decision = decisionAt(history, index);
    const count = step.features.length;
    const goal = goalAt(history, index);
    const facts: [string, string][] = [
      ["in sight", `${step.visible.length} of ${count} features`],
      ["seen so far", `${step.metrics.covered} of ${count}`],
      ["pose error", `${short(step.metrics.pose_error)} rad, cm`],
      ["to the surface", `${short(step.metrics.surface_distance_cm)} cm`],
    ];
    if (history.viewpoints_cm.length > 0) {
      const text = goal === null ? "all visited" : `viewpoint ${goal + 1}`;
      facts.push(["goal", `${text} of ${history.viewpoints_cm.length}`]);
    }
    if (decision && decision.admissible > 0) {
      facts.push(["actions", `${decision.safe} of ${decision.admissible} safe`]);
      if (decision.traces.length > 0) facts.push(["scored", `${decision.traces.length}`]);
    }
    if (decision) facts.push(["decision", `${short(decision.milliseconds)} ms`]);
    else facts.push(["decision", index < history.steps.length - 1 ? "none" : "the run ends here"]);
    this.#facts.replaceChildren(
      ...facts.flatMap(([term, text]) => [h("dt", {}, term), h("dd", {}, text)]),
    );
    const distance = step.metrics.surface_distance_cm;
    const warning =
      distance < 0
        ? "inside the object"
        : decision?.compromised
          ? "no action is safe"
          : distance < history.clearance_cm
            ? `within the clearance of ${short(history.clearance_cm)} cm`
            : "";
    this.#warning.hidden = warning === "";
    this.#warning.textContent = warning;
    this.#scale.hidden = !candidates || !decision || decision.traces.length === 0;
    if (decision && decision.traces.length > 0) {
      const [low, high] = traceRange(decision.traces);
      this.#best.textContent = `${short(low, 5)} best`;
      this.#worst.textContent = `worst ${short(high, 5)}`;
    }
  }
}
