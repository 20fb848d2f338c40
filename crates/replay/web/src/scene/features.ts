// Features: where they are, where the filter believes them, and how sure it is.

import {
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  MeshStandardMaterial,
  SphereGeometry,
} from "three";
import { ellipsoid } from "../geometry";
import { stepAt } from "../history";
import type { Settings } from "../layers";
import type { Context, Part } from "./part";

export class FeaturesPart implements Part {
  readonly object = new Group();
  readonly #truth: InstancedMesh;
  readonly #estimates: InstancedMesh;
  readonly #ellipsoids: InstancedMesh;
  readonly #ink: Color;
  readonly #seen: Color;

  constructor(private readonly context: Context) {
    const { history, theme, colour, unit } = context;
    const count = history.steps[0].features.length;
    this.#ink = new Color(theme.ink);
    this.#seen = new Color(theme.seen);
    const dot = (radius: number) => new SphereGeometry(radius, 16, 10);
    const truth = new MeshStandardMaterial({ roughness: 0.6 });
    this.#truth = new InstancedMesh(dot(0.17 * unit), truth, count);
    const estimates = new MeshStandardMaterial({ color: colour, roughness: 0.4 });
    this.#estimates = new InstancedMesh(dot(0.14 * unit), estimates, count);
    const shell = new MeshBasicMaterial({
      color: colour,
      transparent: true,
      opacity: 0.28,
      depthWrite: false,
    });
    this.#ellipsoids = new InstancedMesh(new SphereGeometry(1, 24, 16), shell, count);
    this.#ellipsoids.renderOrder = 3;
    for (const mesh of [this.#truth, this.#estimates, this.#ellipsoids]) {
      mesh.frustumCulled = false;
      this.object.add(mesh);
    }
  }

  /** The transforms from the unit sphere to the ellipsoids, column by column. */
  get ellipsoids(): number[] {
    return Array.from(this.#ellipsoids.instanceMatrix.array);
  }

  show(index: number, settings: Settings): void {
    const step = stepAt(this.context.history, index);
    this.#truth.visible = settings.shows("features");
    this.#estimates.visible = settings.shows("estimates");
    this.#ellipsoids.visible = settings.shows("ellipsoids");
    const at = new Matrix4();
    const visible = new Set(step.visible);
    step.features.forEach((p, i) => {
      this.#truth.setMatrixAt(i, at.makeTranslation(p[0], p[1], p[2]));
      this.#truth.setColorAt(i, visible.has(i) ? this.#seen : this.#ink);
    });
    step.estimated_features.forEach((p, i) => {
      this.#estimates.setMatrixAt(i, at.makeTranslation(p[0], p[1], p[2]));
      ellipsoid(p, step.feature_covariances[i], settings.sigmas, at);
      this.#ellipsoids.setMatrixAt(i, at);
    });
    this.#truth.instanceMatrix.needsUpdate = true;
    if (this.#truth.instanceColor) this.#truth.instanceColor.needsUpdate = true;
    this.#estimates.instanceMatrix.needsUpdate = true;
    this.#ellipsoids.instanceMatrix.needsUpdate = true;
  }
}
