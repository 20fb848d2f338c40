// What can be shown or hidden.

export const LAYERS = [
  { id: "surface", key: "1", label: "surface", on: true },
  { id: "hull", key: "2", label: "hull of the features", on: false },
  { id: "features", key: "3", label: "true features", on: true },
  { id: "estimates", key: "4", label: "estimated features", on: true },
  { id: "ellipsoids", key: "5", label: "covariance ellipsoids", on: true },
  { id: "robot", key: "6", label: "robot", on: true },
  { id: "view", key: "7", label: "field of view", on: true },
  { id: "sight", key: "8", label: "lines of sight", on: true },
  { id: "paths", key: "9", label: "paths", on: true },
  { id: "viewpoints", key: "0", label: "viewpoints and goal", on: true },
  { id: "candidates", key: "c", label: "candidate actions", on: true },
  { id: "grid", key: "g", label: "grid and axes", on: true },
] as const;

export type LayerId = (typeof LAYERS)[number]["id"];

/** What the user has chosen to see. */
export class Settings {
  readonly layers = new Map<LayerId, boolean>(LAYERS.map((layer) => [layer.id, layer.on]));
  sigmas = 3;
  opacity = 0.45;
  readonly #listeners: (() => void)[] = [];

  onChange(listener: () => void): void {
    this.#listeners.push(listener);
  }

  shows(layer: LayerId): boolean {
    return this.layers.get(layer) === true;
  }

  toggle(layer: LayerId): void {
    this.set(() => this.layers.set(layer, !this.shows(layer)));
  }

  /** Changes something and says so. */
  set(change: () => void): void {
    change();
    for (const listener of this.#listeners) listener();
  }
}
