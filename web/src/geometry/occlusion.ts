// SPDX-License-Identifier: BSD-3-Clause
import { DepthImage, spread } from './depth_image';

/** How much of the sky each vertex sees, from depth images of many sides. */
export class Occlusion {
  private seen: Float32Array;
  private weight: Float32Array;
  private sides: [number, number, number][];
  private next = 0;
  private image: DepthImage;

  constructor(positions: Float32Array, triangles: Uint32Array, private normals: Float32Array, centre: number[], radius: number, sides = 48) {
    this.seen = new Float32Array(positions.length / 3);
    this.weight = new Float32Array(positions.length / 3);
    this.image = new DepthImage(positions, triangles, centre, radius);
    this.sides = spread(sides);
  }

  get done(): boolean {
    return this.next >= this.sides.length;
  }

  /** Takes one more direction into account. */
  step(): void {
    const side = this.sides[this.next++]!, { normals } = this;
    this.image.draw(side);
    for (let v = 0; v < this.seen.length; ++v) {
      const facing = normals[3 * v]! * side[0] + normals[3 * v + 1]! * side[1] + normals[3 * v + 2]! * side[2];
      if (facing <= 0.05) continue;
      this.weight[v]! += facing;
      if (this.image.seesVertex(v)) this.seen[v]! += facing;
    }
  }

  /** 0 to 1 for each vertex, from the directions so far; 1 where none was taken. */
  visibility(): Float32Array {
    return this.seen.map((seen, v) => (this.weight[v]! > 0 ? seen / this.weight[v]! : 1));
  }
}
