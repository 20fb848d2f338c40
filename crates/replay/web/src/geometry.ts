// Rotations, covariances and boxes, in the conventions of the Rust crates.

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Sextuple, Triple } from "./history";

/** R(Θ) = Rz(yaw) Ry(pitch) Rx(roll), body to world. */
export function orientation(roll: number, pitch: number, yaw: number): Quaternion {
  const about = (axis: Vector3, angle: number) => new Quaternion().setFromAxisAngle(axis, angle);
  return about(Z, yaw).multiply(about(Y, pitch)).multiply(about(X, roll));
}

const X = new Vector3(1, 0, 0);
const Y = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);

/** A pose (roll, pitch, yaw, x, y, z) as a transform from body to world. */
export interface Placement {
  position: Vector3;
  rotation: Quaternion;
}

export function placement(pose: Sextuple): Placement {
  return {
    position: new Vector3(pose[3], pose[4], pose[5]),
    rotation: orientation(pose[0], pose[1], pose[2]),
  };
}

/** Where a control leads without noise, eq. (2): Θ + Ω, x + R(Θ) v. */
export function predict(pose: Sextuple, control: Sextuple): Placement {
  const from = placement(pose);
  const step = new Vector3(control[3], control[4], control[5]).applyQuaternion(from.rotation);
  return {
    position: from.position.add(step),
    rotation: orientation(pose[0] + control[0], pose[1] + control[1], pose[2] + control[2]),
  };
}

/**
 * Eigenvalues and eigenvectors (columns) of the symmetric matrix (xx, xy, xz, yy, yz, zz), by
 * Jacobi rotations.
 */
export function eigen(m: Sextuple): { values: Triple; vectors: number[][] } {
  const a = [
    [m[0], m[1], m[2]],
    [m[1], m[3], m[4]],
    [m[2], m[4], m[5]],
  ];
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const size = Math.abs(m[0]) + Math.abs(m[3]) + Math.abs(m[5]);
  for (let sweep = 0; sweep < 12; sweep++) {
    const off = Math.abs(a[0][1]) + Math.abs(a[0][2]) + Math.abs(a[1][2]);
    if (off <= 1e-12 * size) break;
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (a[p][q] === 0) continue;
      const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
      const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.hypot(theta, 1));
      const c = 1 / Math.hypot(t, 1);
      const s = t * c;
      for (let k = 0; k < 3; k++) {
        [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
      }
      for (let k = 0; k < 3; k++) {
        [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
        [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
      }
    }
  }
  return { values: [a[0][0], a[1][1], a[2][2]], vectors: v };
}

/** The transform that takes the unit sphere to the ellipsoid of `sigmas` standard deviations. */
export function ellipsoid(centre: Triple, covariance: Sextuple, sigmas: number, out: Matrix4): void {
  const { values, vectors: v } = eigen(covariance);
  const [a, b, c] = values.map((x) => sigmas * Math.sqrt(Math.max(x, 1e-12)));
  out.set(
    v[0][0] * a, v[0][1] * b, v[0][2] * c, centre[0],
    v[1][0] * a, v[1][1] * b, v[1][2] * c, centre[1],
    v[2][0] * a, v[2][1] * b, v[2][2] * c, centre[2],
    0, 0, 0, 1,
  );
}

/** The smallest number of 1, 2 or 5 times a power of ten that is at least `x`. */
export function niceCeil(x: number): number {
  const power = 10 ** Math.floor(Math.log10(x));
  for (const digit of [1, 2, 5]) if (digit * power >= x * 0.999999) return digit * power;
  return 10 * power;
}
