// The check boxes of the layers, with the signs that the scene uses for them.

import { LAYERS, type LayerId, type Settings } from "../layers";
import { h } from "./dom";

/** The class of the sign beside a layer; style.css draws them. */
const SIGNS: Partial<Record<LayerId, string>> = {
  surface: "patch surface",
  hull: "line hull",
  features: "ball truth",
  estimates: "ball method",
  ellipsoids: "patch method",
  robot: "cone truth",
  view: "line view",
  sight: "line seen",
  paths: "twin",
  viewpoints: "diamond",
  candidates: "viridis",
  grid: "line grid",
};

export function layersPanel(settings: Settings, open: boolean): HTMLElement {
  const rows = LAYERS.map((layer) => {
    const box = h("input", {
      type: "checkbox",
      "data-layer": layer.id,
      onchange: () => settings.toggle(layer.id),
    });
    box.checked = settings.shows(layer.id);
    settings.onChange(() => {
      box.checked = settings.shows(layer.id);
    });
    return h(
      "label",
      {},
      box,
      h("span", { class: `sign ${SIGNS[layer.id] ?? ""}` }),
      layer.label,
      h("kbd", {}, layer.key),
    );
  });
  const sigmas = h(
    "select",
    {
      id: "sigmas",
      title: "size of the ellipsoids",
      onchange: (event) =>
        settings.set(() => {
          settings.sigmas = Number((event.target as HTMLSelectElement).value);
        }),
    },
    ...[1, 2, 3].map((n) => h("option", { value: n, selected: n === settings.sigmas }, `${n}σ`)),
  );
  const opacity = h("input", {
    type: "range",
    min: 0.1,
    max: 1,
    step: 0.05,
    value: settings.opacity,
    title: "opacity of the surface",
    oninput: (event) =>
      settings.set(() => {
        settings.opacity = Number((event.target as HTMLInputElement).value);
      }),
  });
  return h(
    "details",
    { class: "card layers", open },
    h("summary", {}, "Layers"),
    ...rows,
    h("div", { class: "row" }, "ellipsoids of", sigmas),
    h("div", { class: "row" }, "opacity", opacity),
    h(
      "p",
      { class: "hint" },
      h("span", { class: "ball truth sign" }),
      " true, ",
      h("span", { class: "ball seen sign" }),
      " true and in sight, ",
      h("span", { class: "ball method sign" }),
      " estimated (the method's colour)",
    ),
  );
}
