// SPDX-License-Identifier: BSD-3-Clause
// How much of the sky each vertex sees: depth images from many sides, drawn on the CPU so that every machine shows the same.

/** `count` directions spread evenly over the sphere (Fibonacci lattice). */
export function spread(count: number): [number, number, number][] {
  const golden = Math.PI * (3 - Math.sqrt(5));
  return Array.from({ length: count }, (_unused, i) => {
    const z = 1 - (2 * i + 1) / count, r = Math.sqrt(1 - z * z);
    return [r * Math.cos(golden * i), r * Math.sin(golden * i), z];
  });
}

/** Two unit vectors that span the plane across a direction. */
function across([x, y, z]: [number, number, number]): [number[], number[]] {
  const a = Math.abs(x) < 0.6 ? [0, -z, y] : [z, 0, -x];
  const size = Math.hypot(a[0]!, a[1]!, a[2]!);
  const u = a.map((value) => value / size);
  return [u, [y * u[2]! - z * u[1]!, z * u[0]! - x * u[2]!, x * u[1]! - y * u[0]!]];
}

export class Occlusion {
  private seen: Float32Array;
  private weight: Float32Array;
  private depth: Float32Array;
  private sides: [number, number, number][];
  private next = 0;
  private projected: Float32Array;

  constructor(
    private positions: Float32Array,
    private triangles: Uint32Array,
    private normals: Float32Array,
    private centre: number[],
    private radius: number,
    sides = 48,
    private size = 160,
  ) {
    this.seen = new Float32Array(positions.length / 3);
    this.weight = new Float32Array(positions.length / 3);
    this.depth = new Float32Array(size * size);
    this.projected = new Float32Array(positions.length);
    this.sides = spread(sides);
  }

  get done(): boolean {
    return this.next >= this.sides.length;
  }

  /** Takes one more direction into account. */
  step(): void {
    const side = this.sides[this.next++]!;
    this.project(side);
    this.draw();
    const { projected, normals, size, depth } = this;
    const bias = 0.02 * this.radius;
    for (let v = 0; v < this.seen.length; ++v) {
      const facing = normals[3 * v]! * side[0] + normals[3 * v + 1]! * side[1] + normals[3 * v + 2]! * side[2];
      if (facing <= 0.05) continue;
      const i = Math.min(size - 1, projected[3 * v]! | 0) + size * Math.min(size - 1, projected[3 * v + 1]! | 0);
      this.weight[v]! += facing;
      if (projected[3 * v + 2]! >= depth[i]! - bias) this.seen[v]! += facing;
    }
  }

  /** 0 to 1 for each vertex, from the directions so far; 1 where none was taken. */
  visibility(): Float32Array {
    return this.seen.map((seen, v) => (this.weight[v]! > 0 ? seen / this.weight[v]! : 1));
  }

  private project(side: [number, number, number]): void {
    const [u, w] = across(side), { positions, projected, centre } = this;
    const scale = this.size / (2 * this.radius), half = this.size / 2;
    for (let i = 0; i < positions.length; i += 3) {
      const x = positions[i]! - centre[0]!, y = positions[i + 1]! - centre[1]!, z = positions[i + 2]! - centre[2]!;
      projected[i] = half + scale * (x * u[0]! + y * u[1]! + z * u[2]!);
      projected[i + 1] = half + scale * (x * w[0]! + y * w[1]! + z * w[2]!);
      projected[i + 2] = x * side[0] + y * side[1] + z * side[2];
    }
  }

  /** Greatest depth towards the viewer in each pixel whose middle a triangle covers. */
  private draw(): void {
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
