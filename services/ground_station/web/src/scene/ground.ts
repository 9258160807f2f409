// SPDX-License-Identifier: Apache-2.0
// The station's map as the ground.
import { BufferGeometry, Float32BufferAttribute, Group, LinearFilter, Mesh, MeshBasicMaterial, Texture,
} from "three";

import type { Metres } from "../ground/place.ts";

const under_m = -0.03; // the grid and all that lies on the ground
const shade = "#a8a8a8"; // so that what is drawn on it is seen

export interface GroundPiece { bitmap: ImageBitmap; corners: [Metres, Metres, Metres] }

/** Upper left, upper right, lower left, lower right; a bitmap's rows begin above. */
export function cornersOnGround([[x, y], [rx, ry], [lx, ly]]: [Metres, Metres, Metres]): number[] {
  return [x, y, under_m, rx, ry, under_m, lx, ly, under_m, rx + lx - x, ry + ly - y, under_m];
}

function meshOf({ bitmap, corners }: GroundPiece): Mesh<BufferGeometry, MeshBasicMaterial> {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(cornersOnGround(corners), 3));
  geometry.setAttribute("uv", new Float32BufferAttribute([0, 0, 1, 0, 0, 1, 1, 1], 2));
  geometry.setIndex([0, 2, 1, 1, 2, 3]);
  const map = new Texture(bitmap);
  map.flipY = false;
  map.generateMipmaps = false;
  map.minFilter = LinearFilter;
  map.needsUpdate = true;
  return new Mesh(geometry, new MeshBasicMaterial({ map, color: shade, depthWrite: false }));
}

export class Ground {
  readonly group = new Group();
  private meshes: Mesh<BufferGeometry, MeshBasicMaterial>[] = [];

  set(pieces: GroundPiece[]): void {
    for (const mesh of this.meshes) {
      mesh.geometry.dispose();
      mesh.material.map?.dispose();
      mesh.material.dispose();
    }
    this.meshes = pieces.map(meshOf);
    this.meshes.forEach((mesh) => (mesh.renderOrder = -1));
    this.group.clear();
    if (this.meshes.length > 0) this.group.add(...this.meshes);
  }
}
