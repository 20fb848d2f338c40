// What the parts of a scene have in common.

import { type Object3D, type Material, Mesh } from "three";
import type { Theme } from "../colours";
import type { History } from "../history";
import type { Settings } from "../layers";

/** What every part is built from; built anew when the theme changes. */
export interface Context {
  history: History;
  theme: Theme;
  /** The planner's colour. */
  colour: string;
  /** cm: the size of a glyph, a tenth of the sensor's range. */
  unit: number;
}

/** A piece of the scene that can show any step. */
export interface Part {
  readonly object: Object3D;
  show(index: number, settings: Settings): void;
}

/** Frees what a part holds on the graphics card. */
export function dispose(object: Object3D): void {
  object.traverse((node) => {
    if (!(node instanceof Mesh) && !("geometry" in node)) {
      if ("material" in node) disposeMaterial(node.material as Material & { map?: unknown });
      return;
    }
    const { geometry, material } = node as Mesh;
    geometry.dispose();
    for (const m of Array.isArray(material) ? material : [material]) disposeMaterial(m);
  });
}

function disposeMaterial(material: Material & { map?: unknown }): void {
  const map = material.map as { dispose?: () => void } | null | undefined;
  map?.dispose?.();
  material.dispose();
}
