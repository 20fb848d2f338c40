// The keyboard, and the overlay that tells what it does.

import { LAYERS, type Settings } from "../layers";
import type { Player } from "../player";
import { h } from "./dom";
import { type Actions, VIEWS } from "./transport";

export function help(): HTMLDialogElement {
  const rows: [string, string][] = [
    ["space", "play or pause"],
    ["← →", "a step back or on; with shift ten"],
    ["home end", "first or last step"],
    ["− +", "slower or faster"],
    [VIEWS.map((v) => v.key).join(" "), VIEWS.map((v) => v.title).join(", ")],
    ["t", "light or dark"],
    ...LAYERS.map((layer): [string, string] => [layer.key, `show or hide: ${layer.label}`]),
    ["? esc", "this help"],
  ];
  const dialog = h(
    "dialog",
    { class: "card", id: "help" },
    h("h2", {}, "Keys"),
    h("dl", {}, ...rows.flatMap(([keys, what]) => [
      h("dt", {}, ...keys.split(" ").map((key) => h("kbd", {}, key))),
      h("dd", {}, what),
    ])),
    h(
      "p",
      {},
      "Mouse: drag to turn, right button or shift to move, wheel to come nearer. ",
      "Click or drag in a curve to go to a step.",
    ),
    h("button", { onclick: () => dialog.close() }, "close"),
  );
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();
  });
  return dialog;
}

const PRESSED = "button, summary, input[type=checkbox]";

/** Listens to the keys of the whole page. */
export function listen(player: Player, settings: Settings, actions: Actions): void {
  const keys = new Map<string, (event: KeyboardEvent) => void>([
    [" ", () => player.toggle()],
    ["ArrowLeft", (event) => player.step(event.shiftKey ? -10 : -1)],
    ["ArrowRight", (event) => player.step(event.shiftKey ? 10 : 1)],
    ["Home", () => player.step(-player.count)],
    ["End", () => player.step(player.count)],
    ["-", () => player.shiftSpeed(-1)],
    ["+", () => player.shiftSpeed(1)],
    ["=", () => player.shiftSpeed(1)],
    ["t", actions.theme],
    ["?", actions.help],
    ["h", actions.help],
  ]);
  for (const { view, key } of VIEWS) keys.set(key, () => actions.look(view));
  for (const layer of LAYERS) keys.set(layer.key, () => settings.toggle(layer.id));
  // What was clicked gives the keyboard back; a press of a key "clicks" with detail 0.
  window.addEventListener("click", (event) => {
    const active = document.activeElement as HTMLElement | null;
    if (event.detail > 0 && active?.matches(PRESSED)) active.blur();
  });
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    if (target instanceof HTMLSelectElement) return;
    // What was reached with the tabulator keeps the space bar.
    if (event.key === " " && target.matches(PRESSED)) return;
    const act = keys.get(event.key);
    if (!act) return;
    event.preventDefault();
    act(event);
  });
}
