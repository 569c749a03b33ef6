// A parallel projection that turns about a target.

/** The direction of pictures that the program draws by default. */
const FROM = [0.55, 0.42, 0.8];
const NEAREST = 4000;

/** Directions in which something may be seen, from that of its normal to steep ones. */
function directionsAround(normal) {
  const n = unit(normal);
  const x = unit(cross(n, Math.abs(n[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0])), y = cross(n, x);
  const tilted = [30, 55, 75].flatMap((degrees) => Array.from({ length: 8 }, (_, k) => {
    const [tilt, around] = [(degrees * Math.PI) / 180, (k * Math.PI) / 4];
    const side = add(scale(x, Math.cos(around)), scale(y, Math.sin(around)));
    return add(scale(n, Math.cos(tilt)), scale(side, Math.sin(tilt)));
  }));
  return [n, ...tilted];
}

class Camera {
  constructor() {
    this.reset();
  }

  reset() {
    this.front = unit(FROM);
    this.right = unit(cross([0, 1, 0], this.front));
    this.up = cross(this.front, this.right);
    this.target = [0, 0, 0];
    this.zoom = 1;
  }

  /** Turns by angles about the vertical and the horizontal axis of the screen. */
  turn(yaw, pitch) {
    const [c, s, d, t] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    const front = add(scale(this.front, c), scale(this.right, -s));
    this.front = unit(add(scale(front, d), scale(this.up, t)));
    this.right = unit(cross(add(scale(this.up, d), scale(front, -t)), this.front));
    this.up = cross(this.front, this.right);
  }

  /** Moves the target by a distance in the plane of the screen. */
  move(x, y) {
    this.target = sub(this.target, add(scale(this.right, x), scale(this.up, y)));
  }

  /** Zooms by a factor; what is at a place of the screen's plane stays there. */
  zoomAt(factor, x, y) {
    const zoom = Math.min(NEAREST, Math.max(0.2, this.zoom * factor));
    const kept = 1 - this.zoom / zoom;
    this.move(-x * kept, -y * kept);
    this.zoom = zoom;
  }

  /** Looks at a point from outside. */
  lookAt(point, normal) {
    this.front = unit(normal);
    const up = Math.abs(this.front[1]) < 0.95 ? [0, 1, 0] : [0, 0, -1];
    this.right = unit(cross(up, this.front));
    this.up = cross(this.front, this.right);
    this.target = point;
  }

  /** Coordinates to the right, upwards and towards the viewer. */
  see(p) {
    const q = sub(p, this.target);
    return [dot(this.right, q), dot(this.up, q), dot(this.front, q)];
  }

  /** The matrix of `see` without its target, by columns. */
  matrix() {
    return [0, 1, 2].flatMap((k) => [this.right[k], this.up[k], this.front[k]]);
  }
}
