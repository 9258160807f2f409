// SPDX-License-Identifier: Apache-2.0
// Shapes that change every frame, in buffers that are made once.
import {
  Box3, BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, Line,
  LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Sphere, Vector3,
} from "three";

export type Point = readonly [number, number, number];

function dynamic(size: number, items: number): BufferAttribute {
  const attribute = new BufferAttribute(new Float32Array(size * items), items);
  attribute.setUsage(DynamicDrawUsage);
  return attribute;
}

/** What was written goes to the graphics library, and no more: `first` and `count` are items. */
export function renew(attribute: BufferAttribute, first: number, count: number): void {
  const { itemSize } = attribute;
  attribute.addUpdateRange(first * itemSize, count * itemSize);
  attribute.needsUpdate = true;
}

/** The same where all that is drawn was written. */
export function renewAll(attribute: BufferAttribute, count: number): void {
  attribute.clearUpdateRanges(); // those that were out of sight pile up
  renew(attribute, 0, count);
}

function paint(colors: BufferAttribute, i: number, color: Color, alpha: number): void {
  colors.setXYZW(i, color.r, color.g, color.b, alpha);
}

const parse = new Color();

/** The extent of what was written, so that what is out of sight is not drawn. */
class Extent {
  private readonly box = new Box3();
  private readonly corner = new Vector3();

  begin(): void {
    this.box.makeEmpty();
  }
  add(x: number, y: number, z: number): void {
    this.box.expandByPoint(this.corner.set(x, y, z));
  }
  end(geometry: BufferGeometry): void {
    geometry.boundingSphere ??= new Sphere();
    this.box.getBoundingSphere(geometry.boundingSphere);
    geometry.boundingSphere.radius += 0.5; // its width
  }
}

// Both sides in one pass: three.js would draw, and prepare, each twice.
function flatMaterial(): MeshBasicMaterial {
  return new MeshBasicMaterial({ vertexColors: true, transparent: true, side: DoubleSide,
    depthWrite: false, forceSinglePass: true });
}

/** Flat bands along paths, all in one mesh; opacity goes from a band's one end to its other. */
export class Ribbons {
  readonly mesh: Mesh;
  private readonly positions: BufferAttribute;
  private readonly colors: BufferAttribute;
  private readonly index: BufferAttribute;
  private readonly counts: number[]; // of each ribbon's points
  private readonly ends: (Point | undefined)[]; // of each ribbon, and so roughly where it is
  private readonly extent = new Extent();

  constructor(count: number, private readonly capacity: number) {
    this.ends = new Array<Point | undefined>(2 * count).fill(undefined);
    const geometry = new BufferGeometry();
    this.positions = dynamic(2 * capacity * count, 3);
    this.colors = dynamic(2 * capacity * count, 4);
    geometry.setAttribute("position", this.positions);
    geometry.setAttribute("color", this.colors);
    this.counts = new Array<number>(count).fill(0);
    this.index = new BufferAttribute(new Uint16Array(6 * capacity * count), 1);
    this.index.setUsage(DynamicDrawUsage);
    geometry.setIndex(this.index);
    this.mesh = new Mesh(geometry, flatMaterial());
    this.bound();
  }

  set(ribbon: number, points: readonly Point[], width_m: number, color: (i: number) => Color,
      alpha: (share: number) => number): void {
    const count = points.length > 1 ? Math.min(points.length, this.capacity) : 0;
    const first = 2 * ribbon * this.capacity;
    for (let i = 0; i < count; i++) {
      const [x, y, z] = points[i]!;
      const before = points[Math.max(0, i - 1)]!;
      const after = points[Math.min(count - 1, i + 1)]!;
      const [dx, dy] = [after[0] - before[0], after[1] - before[1]];
      const length = Math.hypot(dx, dy) || 1;
      const [ox, oy] = [(-dy / length) * width_m * 0.5, (dx / length) * width_m * 0.5];
      const at = first + 2 * i;
      this.positions.setXYZ(at, x + ox, y + oy, z);
      this.positions.setXYZ(at + 1, x - ox, y - oy, z);
      const opacity = alpha(i / (count - 1));
      paint(this.colors, at, color(i), opacity);
      paint(this.colors, at + 1, color(i), opacity);
    }
    if (count !== this.counts[ribbon]) this.join(ribbon, count);
    this.ends[2 * ribbon] = count > 0 ? points[0] : undefined;
    this.ends[2 * ribbon + 1] = count > 0 ? points[count - 1] : undefined;
    this.bound();
    if (count === 0) return;
    for (const attribute of [this.positions, this.colors])
      if (attribute.updateRanges.length > this.ends.length)
        renewAll(attribute, attribute.count); // it was out of sight
      else renew(attribute, first, 2 * count);
  }

  clear(ribbon: number): void {
    this.set(ribbon, [], 0, () => parse, () => 0);
  }

  // A path stays within its length of its ends: twice their distance is far enough.
  private bound(): void {
    this.extent.begin();
    for (const end of this.ends) if (end) this.extent.add(...end);
    this.extent.end(this.mesh.geometry);
    this.mesh.geometry.boundingSphere!.radius = 2 * this.mesh.geometry.boundingSphere!.radius + 2;
    this.mesh.visible = this.ends.some((end) => end !== undefined);
  }

  // The triangles that there are: software takes its time for empty ones too.
  private join(ribbon: number, count: number): void {
    this.counts[ribbon] = count;
    let n = 0;
    this.counts.forEach((points, of) => {
      const first = 2 * of * this.capacity;
      for (let i = first; i < first + 2 * points - 2; i += 2)
        for (const corner of [i, i + 1, i + 2, i + 1, i + 3, i + 2]) this.index.setX(n++, corner);
    });
    if (n > 0) renewAll(this.index, n);
    this.mesh.geometry.setDrawRange(0, n);
  }
}

export interface Fan {
  center: Point;
  radius_m: number;
  bisector_rad: number;
  half_rad: number;
  color: string;
  alpha: number;
}

/** Flat sectors of discs, many in one mesh; the rim fades. */
export class Fans {
  static readonly steps = 12;
  readonly mesh: Mesh;
  private readonly positions: BufferAttribute;
  private readonly colors: BufferAttribute;

  constructor(private readonly capacity: number) {
    const geometry = new BufferGeometry();
    const each = Fans.steps + 2;
    this.positions = dynamic(each * capacity, 3);
    this.colors = dynamic(each * capacity, 4);
    geometry.setAttribute("position", this.positions);
    geometry.setAttribute("color", this.colors);
    const index: number[] = [];
    for (let f = 0; f < capacity; f++)
      for (let i = 0; i < Fans.steps; i++)
        index.push(f * each, f * each + 1 + i, f * each + 2 + i);
    geometry.setIndex(index);
    this.mesh = new Mesh(geometry, flatMaterial());
    this.mesh.frustumCulled = false;
  }

  set(fans: readonly Fan[]): void {
    const each = Fans.steps + 2;
    const count = Math.min(fans.length, this.capacity);
    for (let f = 0; f < count; f++) {
      const fan = fans[f]!;
      const [x, y, z] = fan.center;
      parse.set(fan.color);
      this.positions.setXYZ(f * each, x, y, z);
      paint(this.colors, f * each, parse, fan.alpha);
      for (let i = 0; i <= Fans.steps; i++) {
        const angle = fan.bisector_rad + fan.half_rad * ((2 * i) / Fans.steps - 1);
        this.positions.setXYZ(f * each + 1 + i, x + fan.radius_m * Math.cos(angle),
          y + fan.radius_m * Math.sin(angle), z);
        paint(this.colors, f * each + 1 + i, parse, 0.45 * fan.alpha);
      }
    }
    renewAll(this.positions, each * count);
    renewAll(this.colors, each * count);
    this.mesh.geometry.setDrawRange(0, 3 * Fans.steps * count);
  }
}

/** Separate segments of one colour. */
export class Segments {
  readonly mesh: LineSegments;
  private readonly positions: BufferAttribute;

  constructor(private readonly capacity: number, color: string, opacity: number) {
    const geometry = new BufferGeometry();
    this.positions = dynamic(2 * capacity, 3);
    geometry.setAttribute("position", this.positions);
    geometry.setDrawRange(0, 0);
    this.mesh = new LineSegments(geometry,
      new LineBasicMaterial({ color, transparent: true, opacity, depthWrite: false }));
    this.mesh.frustumCulled = false;
  }

  set(edges: readonly (readonly [Point, Point])[]): void {
    const count = Math.min(edges.length, this.capacity);
    for (let i = 0; i < count; i++) {
      this.positions.setXYZ(2 * i, ...edges[i]![0]);
      this.positions.setXYZ(2 * i + 1, ...edges[i]![1]);
    }
    renewAll(this.positions, 2 * count);
    this.mesh.geometry.setDrawRange(0, 2 * count);
  }
}

/** A line that fades towards its beginning. */
export class FadingLine {
  readonly mesh: Line;
  private readonly positions: BufferAttribute;
  private readonly colors: BufferAttribute;
  private readonly extent = new Extent();

  constructor(private readonly capacity: number, private readonly color: string) {
    const geometry = new BufferGeometry();
    this.positions = dynamic(capacity, 3);
    this.colors = dynamic(capacity, 4);
    geometry.setAttribute("position", this.positions);
    geometry.setAttribute("color", this.colors);
    geometry.setDrawRange(0, 0);
    this.mesh = new Line(geometry, new LineBasicMaterial({ vertexColors: true, transparent: true,
      depthWrite: false }));
    this.extent.end(geometry);
  }

  set(points: readonly { x: number; y: number; z: number }[]): void {
    const count = Math.min(points.length, this.capacity);
    const from = points.length - count;
    parse.set(this.color);
    this.extent.begin();
    for (let i = 0; i < count; i++) {
      const p = points[from + i]!;
      this.positions.setXYZ(i, p.x, p.y, p.z);
      paint(this.colors, i, parse, 0.1 + (0.8 * i) / count);
      this.extent.add(p.x, p.y, p.z);
    }
    this.extent.end(this.mesh.geometry);
    renewAll(this.positions, count);
    renewAll(this.colors, count);
    this.mesh.geometry.setDrawRange(0, count);
  }
}
