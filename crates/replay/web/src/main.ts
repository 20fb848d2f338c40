// The page of `adslam replay`: one or two runs, shown step by step.

import { DARK, LIGHT, methodColour, type Theme } from "./colours";
import { readHistories } from "./history";
import { LAYERS, type LayerId, Settings } from "./layers";
import { Player } from "./player";
import { Stage, type View } from "./scene/stage";
import { Chart } from "./ui/chart";
import { CURVES } from "./ui/curves";
import { h } from "./ui/dom";
import { Hud } from "./ui/hud";
import { help, listen } from "./ui/keys";
import { layersPanel } from "./ui/panel";
import { Transport, VIEWS } from "./ui/transport";

function start(app: HTMLElement): void {
  const histories = readHistories();
  if (histories.length === 0) throw new Error("the page holds no run");
  const wanted = new URLSearchParams(location.hash.slice(1));
  const settings = new Settings();
  const player = new Player(Math.max(...histories.map((history) => history.steps.length)));
  const dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  let theme: Theme = (wanted.get("theme") ?? (dark ? "dark" : "light")) === "dark" ? DARK : LIGHT;
  let view: View | null = "iso";

  document.body.dataset.theme = theme.name;
  const holders = histories.map((history) =>
    h("section", { class: "view", style: `--c:${methodColour(history)}` }),
  );
  const charts = CURVES.map(
    (curve) => new Chart(curve, histories, player.count, (index) => player.seek(index)),
  );
  for (const chart of charts) chart.dress();
  const dialog = help();
  const actions = {
    look: (to: View) => {
      view = to;
      for (const stage of stages) stage.look(to, player.index);
      transport.mark(to);
    },
    theme: () => {
      theme = theme === DARK ? LIGHT : DARK;
      document.body.dataset.theme = theme.name;
      for (const stage of stages) stage.dress(theme);
      for (const chart of charts) chart.dress();
      show();
    },
    help: () => (dialog.open ? dialog.close() : dialog.showModal()),
  };
  const transport = new Transport(player, actions);
  const views = h("div", { class: `views-${histories.length}` }, ...holders);
  app.replaceChildren(
    h("main", {}, views, h("aside", {}, ...charts.map((chart) => chart.element))),
    transport.element,
    dialog,
  );
  const stages = histories.map((history, i) => new Stage(history, holders[i], theme));
  const huds = histories.map((history, i) => {
    const hud = new Hud(history);
    holders[i].append(hud.element);
    return hud;
  });
  holders[0].append(layersPanel(settings, histories.length === 1 && window.innerHeight > 560));
  link(stages, () => {
    view = stages[0].following ? view : null;
    transport.mark(view);
  });

  const show = () => {
    stages.forEach((stage, i) => {
      stage.show(player.index, settings);
      huds[i].show(player.index, settings.shows("candidates"));
    });
    for (const chart of charts) chart.show(player.index);
    transport.show();
  };
  player.onChange(show);
  settings.onChange(show);
  listen(player, settings, actions);

  for (const id of (wanted.get("toggle") ?? "").split(",")) {
    if (LAYERS.some((layer) => layer.id === id)) settings.toggle(id as LayerId);
  }
  player.seek(Number(wanted.get("step") ?? 1) - 1);
  show();
  // The cameras need the size of the views.
  requestAnimationFrame(() => {
    actions.look(VIEWS.find((v) => v.view === wanted.get("view"))?.view ?? "iso");
  });

  Object.assign(window, {
    // For tests, and for those who look behind the page.
    adslam: {
      drawn: (run: number) => ({
        vertices: stages[run].surface.vertices,
        ellipsoids: stages[run].features.ellipsoids,
        arrows: stages[run].candidates.arrows,
      }),
      state: () => ({
        step: player.index + 1,
        steps: player.count,
        playing: player.playing,
        speed: player.speed,
        theme: theme.name,
        view,
        layers: Object.fromEntries(settings.layers),
        runs: stages.map((stage) => ({
          planner: stage.history.planner,
          robot: stage.robot.position,
          candidates: stage.candidates.count,
          camera: stage.camera.position.toArray(),
          target: stage.controls.target.toArray(),
        })),
      }),
    },
  });
}

/** Turning one view turns the others. */
function link(stages: Stage[], turned: () => void): void {
  for (const stage of stages) {
    let own = false;
    stage.controls.addEventListener("start", () => (own = true));
    stage.controls.addEventListener("end", () => (own = false));
    stage.onTurn = () => {
      // Presets move all cameras themselves; only the view that the user turns leads.
      if (!own) return;
      for (const other of stages) if (other !== stage) other.lookAs(stage);
      turned();
    };
  }
}

const app = document.getElementById("app");
try {
  if (app) start(app);
} catch (error) {
  const reason = error instanceof Error ? error.message : String(error);
  const remedy = /webgl/i.test(reason) ? " This page needs WebGL: switch on hardware acceleration." : "";
  app?.replaceChildren(h("p", { class: "failure" }, `The replay cannot be shown: ${reason}.${remedy}`));
  console.error(error);
}
