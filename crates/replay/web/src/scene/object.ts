// The object: its drawn surface, and the hull of its features, which is what hides them.

import {
  BackSide,
  BufferAttribute,
  BufferGeometry,
  DynamicDrawUsage,
  FrontSide,
  Group,
  Mesh,
  MeshStandardMaterial,
} from "three";
import { drawnCount, drawnFaces, drawnVertices, edgesOf, stepAt } from "../history";
import type { Settings } from "../layers";
import { Segments } from "./lines";
import type { Context, Part } from "./part";

export class SurfacePart implements Part {
  readonly object = new Group();
  readonly #geometry = new BufferGeometry();
  readonly #positions: BufferAttribute;
  readonly #materials: MeshStandardMaterial[];
  #shown = -1;

  constructor(private readonly context: Context) {
    const { history, theme } = context;
    this.#positions = new BufferAttribute(new Float32Array(3 * drawnCount(history)), 3);
    this.#positions.setUsage(DynamicDrawUsage);
    this.#geometry.setAttribute("position", this.#positions);
    this.#geometry.setIndex(drawnFaces(history).flat());
    const flat = history.drawn === "features";
    // A closed translucent surface: what is behind first, then what is in front.
    this.#materials = [BackSide, FrontSide].map(
      (side) =>
        new MeshStandardMaterial({
          color: theme.surface,
          side,
          transparent: true,
          depthWrite: false,
          flatShading: flat,
          roughness: 0.65,
          metalness: 0,
        }),
    );
    this.#materials.forEach((material, i) => {
      const mesh = new Mesh(this.#geometry, material);
      mesh.renderOrder = i;
      mesh.frustumCulled = false;
      this.object.add(mesh);
    });
  }

  /** The vertices that are drawn, cm. */
  get vertices(): number[] {
    return Array.from(this.#positions.array);
  }

  show(index: number, settings: Settings): void {
    this.object.visible = settings.shows("surface");
    this.#materials[0].opacity = settings.opacity * 0.6;
    this.#materials[1].opacity = settings.opacity;
    for (const material of this.#materials) material.depthWrite = settings.opacity > 0.97;
    if (!this.object.visible || index === this.#shown) return;
    this.#shown = index;
    const { history } = this.context;
    drawnVertices(history, stepAt(history, index), this.#positions.array as Float32Array);
    this.#positions.needsUpdate = true;
    if (history.drawn !== "features") this.#geometry.computeVertexNormals();
  }
}

export class HullPart implements Part {
  readonly object = new Group();
  readonly #edges: [number, number][];
  readonly #lines: Segments;

  constructor(private readonly context: Context) {
    const { history, theme } = context;
    this.#edges = edgesOf(history.topology);
    this.#lines = new Segments(this.#edges.length, { color: theme.muted, width: 1.2, opacity: 0.7 });
    this.object.add(this.#lines.object);
  }

  show(index: number, settings: Settings): void {
    // The surface that is the features' own gets its edges with it: flat faces need them.
    const { history } = this.context;
    const own = history.drawn === "features" && settings.shows("surface");
    this.object.visible = settings.shows("hull") || own;
    if (!this.object.visible) return;
    const { features } = stepAt(history, index);
    this.#lines.set(this.#edges.map(([i, j]) => [features[i], features[j]]));
  }
}

