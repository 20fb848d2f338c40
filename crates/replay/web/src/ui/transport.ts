// Play, step, slider, speed, and where to look from.

import { type Player, SPEEDS } from "../player";
import type { View } from "../scene/stage";
import { h, type Icon, icon } from "./dom";

export interface Actions {
  look: (view: View) => void;
  theme: () => void;
  help: () => void;
}

export const VIEWS: { view: View; key: string; label: string; title: string }[] = [
  { view: "iso", key: "i", label: "iso", title: "from a corner" },
  { view: "x", key: "x", label: "x", title: "along x" },
  { view: "y", key: "y", label: "y", title: "along y" },
  { view: "z", key: "z", label: "z", title: "from above, along z" },
  { view: "follow", key: "f", label: "follow", title: "behind the robot" },
];

function iconButton(name: Icon, title: string, act: () => void): HTMLButtonElement {
  const button = h("button", { title, "aria-label": title, onclick: act });
  icon(button, name);
  return button;
}

export class Transport {
  readonly element: HTMLElement;
  readonly #play: HTMLButtonElement;
  readonly #slider: HTMLInputElement;
  readonly #step = h("output");
  readonly #speed: HTMLSelectElement;
  readonly #views = new Map<View, HTMLButtonElement>();

  constructor(
    private readonly player: Player,
    actions: Actions,
  ) {
    const end = player.count - 1;
    this.#play = iconButton("play", "play or pause (space)", () => player.toggle());
    this.#play.classList.add("play");
    this.#slider = h("input", {
      type: "range",
      id: "step",
      min: 1,
      max: player.count,
      value: 1,
      "aria-label": "step",
      oninput: () => player.seek(Number(this.#slider.value) - 1),
    });
    this.#speed = h(
      "select",
      {
        id: "speed",
        title: "speed (− and +)",
        onchange: () => player.setSpeed(Number(this.#speed.value)),
      },
      ...SPEEDS.map((speed) => h("option", { value: speed }, `${speed} steps/s`)),
    );
    for (const { view, key, label, title } of VIEWS) {
      const look = () => actions.look(view);
      const button = h("button", { title: `${title} (${key})`, "data-view": view, onclick: look });
      button.textContent = label;
      this.#views.set(view, button);
    }
    this.element = h(
      "footer",
      {},
      iconButton("start", "first step (home)", () => player.step(-end)),
      iconButton("back", "step back (left)", () => player.step(-1)),
      this.#play,
      iconButton("forth", "step on (right)", () => player.step(1)),
      iconButton("end", "last step (end)", () => player.step(end)),
      this.#slider,
      this.#step,
      this.#speed,
      h("span", { class: "views" }, ...this.#views.values()),
      h("button", { title: "light or dark (t)", onclick: actions.theme }, "◐"),
      h("button", { title: "keys (?)", onclick: actions.help }, "?"),
    );
    this.show();
  }

  show(): void {
    const { player } = this;
    icon(this.#play, player.playing ? "pause" : "play");
    this.#slider.value = `${player.index + 1}`;
    this.#slider.style.setProperty("--at", `${(100 * player.index) / Math.max(player.count - 1, 1)}%`);
    this.#step.textContent = `step ${player.index + 1} / ${player.count}`;
    this.#speed.value = `${player.speed}`;
  }

  /** Marks the side that is looked from; none once the user has turned the scene. */
  mark(view: View | null): void {
    for (const [name, button] of this.#views) button.classList.toggle("on", name === view);
  }
}
