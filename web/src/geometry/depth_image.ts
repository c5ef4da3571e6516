// SPDX-License-Identifier: BSD-3-Clause
type Vector = [number, number, number];

/** `count` directions spread evenly over the sphere (Fibonacci lattice). */
export function spread(count: number): Vector[] {
  const golden = Math.PI * (3 - Math.sqrt(5));
  return Array.from({ length: count }, (_unused, i) => {
    const z = 1 - (2 * i + 1) / count, r = Math.sqrt(1 - z * z);
    return [r * Math.cos(golden * i), r * Math.sin(golden * i), z];
  });
}

/** Two unit vectors that span the plane across a direction. */
function across([x, y, z]: Vector): [number[], number[]] {
  const a = Math.abs(x) < 0.6 ? [0, -z, y] : [z, 0, -x];
  const size = Math.hypot(a[0]!, a[1]!, a[2]!);
  const u = a.map((value) => value / size);
  return [u, [y * u[2]! - z * u[1]!, z * u[0]! - x * u[2]!, x * u[1]! - y * u[0]!]];
}

/** What of a mesh is seen from far away on one side; drawn on the CPU, so that every machine sees the same. */
export class DepthImage {
  private depth: Float32Array;
  private projected: Float32Array;
  private side: Vector = [0, 0, 1];
  private axes = across([0, 0, 1]);
  /** Of the mesh, that a point may lie behind what hides it; a pixel is about as wide. */
  private bias: number;

  constructor(
    private positions: Float32Array, private triangles: Uint32Array, private centre: number[], private radius: number, private size = 160,
  ) {
    this.depth = new Float32Array(size * size);
    this.projected = new Float32Array(positions.length);
    this.bias = 0.02 * radius;
  }

  /** \param side  unit, from the mesh to the viewer */
  draw(side: Vector): void {
    this.side = side;
    this.axes = across(side);
    for (let i = 0; i < this.positions.length; i += 3) this.project(this.positions, i, this.projected, i);
    this.rasterise();
  }

  /** Whether nothing lies before a vertex of the mesh. */
  seesVertex(v: number): boolean {
    return this.isSeen(this.projected[3 * v]!, this.projected[3 * v + 1]!, this.projected[3 * v + 2]!);
  }

  /** Whether nothing lies before the point that starts at `i` of a list of coordinates. */
  seesPoint(points: Float32Array, i: number): boolean {
    const at = new Float32Array(3);
    this.project(points, i, at, 0);
    return this.isSeen(at[0]!, at[1]!, at[2]!);
  }

  private isSeen(x: number, y: number, z: number): boolean {
    const last = this.size - 1;
    const i = Math.max(0, Math.min(last, x | 0)) + this.size * Math.max(0, Math.min(last, y | 0));
    return z >= this.depth[i]! - this.bias;
  }

  private project(from: Float32Array, i: number, to: Float32Array, k: number): void {
    const [u, w] = this.axes, { centre, side } = this, scale = this.size / (2 * this.radius), half = this.size / 2;
    const x = from[i]! - centre[0]!, y = from[i + 1]! - centre[1]!, z = from[i + 2]! - centre[2]!;
    to[k] = half + scale * (x * u[0]! + y * u[1]! + z * u[2]!);
    to[k + 1] = half + scale * (x * w[0]! + y * w[1]! + z * w[2]!);
    to[k + 2] = x * side[0] + y * side[1] + z * side[2];
  }

  /** Greatest depth towards the viewer in each pixel whose middle a triangle covers. */
  private rasterise(): void {
    const { triangles, projected: p, depth, size } = this;
    depth.fill(-Infinity);
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t]!, b = 3 * triangles[t + 1]!, c = 3 * triangles[t + 2]!;
      const ax = p[a]!, ay = p[a + 1]!, bx = p[b]!, by = p[b + 1]!, cx = p[c]!, cy = p[c + 1]!;
      const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      if (area === 0) continue;
      const x0 = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5)), x1 = Math.min(size - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
      const y0 = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5)), y1 = Math.min(size - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
      for (let y = y0; y <= y1; ++y)
        for (let x = x0; x <= x1; ++x) {
          const px = x + 0.5, py = y + 0.5;
          const wa = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area;
          const wb = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area;
          const wc = 1 - wa - wb;
          if (wa < 0 || wb < 0 || wc < 0) continue;
          const z = wa * p[a + 2]! + wb * p[b + 2]! + wc * p[c + 2]!;
          if (z > depth[x + size * y]!) depth[x + size * y] = z;
        }
    }
  }
}
