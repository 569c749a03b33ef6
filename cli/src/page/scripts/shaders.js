// The shaders, and what the five kinds of drawing share. Sizes are in pixels of the canvas.

const PROJECT = `#version 300 es
precision highp float;
uniform mat3 turn; uniform vec3 target; uniform vec2 scale; uniform float lift;
/* A place on the screen; depth is the same at any zoom, lifted towards the viewer. */
vec4 project(vec3 p) {
  vec3 q = turn * (p - target);
  return vec4(scale * q.xy, -0.3 * q.z - lift, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
out vec4 colour;`;

/** Triangles: lit faces, and on them the lines of a grid and the edges of the triangles. */
const SURFACE = {
  vertex: `${PROJECT}
in vec3 position; in vec3 normal; in vec2 grid; in vec3 tint; in float mark;
uniform vec4 marks[2];
out vec3 n; out vec2 g; out vec3 c; out vec3 b; out float marked;
void main() {
  gl_Position = project(position);
  n = turn * normal; g = grid; c = tint; marked = 0.0;
  b = vec3(gl_VertexID % 3 == 0, gl_VertexID % 3 == 1, gl_VertexID % 3 == 2);
  int bits = int(mark);
  for (int k = 0; k < 2; ++k) if ((bits >> k & 1) == 1 && marks[k].a > 0.0) { c = marks[k].rgb; marked = 1.0; }
}`,
  fragment: `${FRAGMENT}
in vec3 n; in vec2 g; in vec3 c; in vec3 b; in float marked;
uniform float fill, shading; uniform vec4 gridColour, edgeColour; uniform float gridWidth, edgeWidth;
uniform vec3 inside;
/* How much of a pixel a line covers that is so many pixels away. */
float cover(float distance, float width) { return clamp(0.5 * width + 0.5 - distance, 0.0, 1.0); }
vec2 rates(vec2 x) { return max(vec2(length(vec2(dFdx(x.x), dFdy(x.x))), length(vec2(dFdx(x.y), dFdy(x.y)))), vec2(1e-7)); }
void main() {
  vec3 normal = normalize(n + vec3(0.0, 0.0, 1e-9));
  vec3 base = gl_FrontFacing ? c : mix(c, inside, 0.75);
  if (normal.z < 0.0) normal = -normal;
  float key = max(dot(normal, vec3(-0.39, 0.62, 0.68)), 0.0);
  float light = 0.50 + 0.36 * key + 0.24 * normal.z;
  float glint = 0.10 * pow(max(dot(normal, vec3(-0.21, 0.34, 0.92)), 0.0), 40.0);
  vec3 lit = base * mix(1.0, light, shading) + glint * shading;
  float alpha = max(fill, 0.9 * marked);
  vec2 rate = rates(g);
  vec2 away = abs(fract(g - 0.5) - 0.5) / rate;
  /* Lines that are too dense to be told apart become a tone. */
  float density = clamp((1.0 / max(rate.x, rate.y) - 2.0) / 8.0, 0.12, 1.0);
  float line = gridColour.a * cover(min(away.x, away.y), gridWidth) * density;
  vec3 slope = vec3(rates(b.xy), rates(b.zz).x);
  vec3 edge = b / slope;
  density = clamp(1.0 / (6.0 * max(slope.x, max(slope.y, slope.z))), 0.1, 1.0);
  float wire = edgeColour.a * cover(min(edge.x, min(edge.y, edge.z)), edgeWidth) * density;
  vec4 result = vec4(lit, 1.0) * alpha;
  result = mix(result, vec4(edgeColour.rgb, 1.0), wire);
  result = mix(result, vec4(gridColour.rgb, 1.0), line);
  if (result.a < 0.02) discard;
  colour = result;
}`,
};

const STROKE = `uniform vec2 viewport; uniform float width; uniform vec4 paint;
/* A corner of a segment as wide as the stroke; the vertex's number tells which. */
vec4 stroke(vec4 a, vec4 b) {
  vec2 along = (b.xy - a.xy) * viewport;
  along = length(along) > 1e-6 ? normalize(along) : vec2(1.0, 0.0);
  vec2 across = vec2(-along.y, along.x);
  float side = gl_VertexID % 2 == 0 ? -1.0 : 1.0;
  bool last = gl_VertexID > 1;
  vec4 end = last ? b : a;
  end.xy += (side * across + (last ? along : -along) * 0.5) * width / viewport;
  return end;
}`;

const PAINT = `${FRAGMENT}
uniform vec4 paint;
void main() { colour = vec4(paint.rgb * paint.a, paint.a); }`;

/** Segments, one an instance. */
const LINES = {
  vertex: `${PROJECT}
${STROKE}
in vec3 start; in vec3 end;
void main() { gl_Position = stroke(project(start), project(end)); }`,
  fragment: PAINT,
};

/**
 * Arms of crosses, one an instance. Crosses of a level are shown when there is room for them on the screen,
 * and all have the length that the finest of these levels leaves. Where every face has its cross, arms stay
 * within their faces.
 */
const CROSSES = {
  vertex: `${PROJECT}
${STROKE}
in vec3 centre; in vec3 arm; in float level; in float limit;
uniform float extent, finest, bounded, both;
void main() {
  vec3 reach = arm * mix(extent, min(extent, limit), bounded);
  gl_Position = stroke(project(centre - both * reach), project(centre + reach));
  if (level > finest) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
}`,
  fragment: PAINT,
};

/** Balls of one size on the screen. */
const BALLS = {
  vertex: `${PROJECT}
in vec3 position; in vec3 tint;
uniform float size;
out vec3 c;
void main() { gl_Position = project(position); gl_PointSize = size; c = tint; }`,
  fragment: `${FRAGMENT}
in vec3 c;
uniform float size;
void main() {
  vec2 p = 2.0 * gl_PointCoord - 1.0;
  float r = length(p);
  float alpha = clamp(0.5 * size * (1.0 - r), 0.0, 1.0);
  if (alpha == 0.0) discard;
  vec3 normal = vec3(p.x, -p.y, sqrt(max(0.0, 1.0 - r * r)));
  float key = max(dot(normal, vec3(-0.39, 0.62, 0.68)), 0.0);
  vec3 lit = c * (0.62 + 0.42 * key) + 0.35 * pow(key, 24.0);
  /* A thin dark rim parts the ball from faces of its colour. */
  lit = mix(lit, c * 0.35, smoothstep(1.0 - 4.0 / size, 1.0 - 1.0 / size, r));
  colour = vec4(lit * alpha, alpha);
}`,
};

/**
 * Digits on the screen at points of the surface, one an instance. What faces away is left out, and what has less room
 * on the screen than it needs.
 */
const DIGITS = {
  vertex: `${PROJECT}
in vec3 position; in vec3 normal; in vec3 digit; in float room;
uniform vec2 viewport, size; uniform float unit;
out vec2 at;
void main() {
  vec2 corner = vec2(gl_VertexID % 2, gl_VertexID / 2);
  gl_Position = project(position);
  gl_Position.xy += 2.0 * size * (corner + vec2(digit.y - 0.5 * digit.z, -0.5)) / viewport;
  if ((turn * normal).z < 0.2 || room * unit < size.x * (digit.z + 0.5)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  at = vec2((digit.x + corner.x) / 10.0, 1.0 - corner.y);
}`,
  fragment: `${FRAGMENT}
in vec2 at;
uniform sampler2D glyphs;
void main() {
  colour = texture(glyphs, at);
  if (colour.a < 0.1) discard;
}`,
};
