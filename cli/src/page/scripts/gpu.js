// Programs and buffers of WebGL.

/** A program with its uniforms by name. */
function build(gl, { vertex, fragment }) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  const uniforms = {};
  for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
    const name = gl.getActiveUniform(program, i).name.replace("[0]", "");
    uniforms[name] = gl.getUniformLocation(program, name);
  }
  return { program, uniforms };
}

function setUniforms(gl, uniforms, values) {
  for (const [name, value] of Object.entries(values)) {
    const at = uniforms[name];
    if (at === undefined) continue;
    if (name === "turn") gl.uniformMatrix3fv(at, false, value);
    else if (typeof value === "number") gl.uniform1f(at, value);
    else if (value.length === 2) gl.uniform2fv(at, value);
    else if (value.length === 3) gl.uniform3fv(at, value);
    else gl.uniform4fv(at, value);
  }
}

/** Arrays on the graphics card, drawn by one call. */
class Batch {
  /** `attributes` has an array and the number of components by name. */
  constructor(gl, shader, mode, count, attributes, { instances = 0 } = {}) {
    Object.assign(this, { gl, shader, mode, count, instances });
    this.array = gl.createVertexArray();
    this.buffers = {};
    gl.bindVertexArray(this.array);
    for (const [name, [array, size]] of Object.entries(attributes)) {
      const at = gl.getAttribLocation(shader.program, name);
      this.buffers[name] = gl.createBuffer();
      this.put(name, array);
      if (at < 0) continue;
      const isBytes = array instanceof Uint8Array;
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, isBytes ? gl.UNSIGNED_BYTE : gl.FLOAT, isBytes && size > 1, 0, 0);
      if (instances) gl.vertexAttribDivisor(at, 1);
    }
  }

  put(name, array) {
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.buffers[name]);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, array, this.gl.STATIC_DRAW);
  }

  draw(values) {
    const { gl, shader } = this;
    if (!this.count) return;
    gl.useProgram(shader.program);
    setUniforms(gl, shader.uniforms, values);
    gl.bindVertexArray(this.array);
    if (this.instances) gl.drawArraysInstanced(this.mode, 0, 4, this.instances);
    else gl.drawArrays(this.mode, 0, this.count);
  }
}

/** Segments from a list of pairs of points. */
function segments(gl, shader, pairs) {
  const start = Float32Array.from(pairs.flatMap(([a]) => a));
  const end = Float32Array.from(pairs.flatMap(([, b]) => b));
  const attributes = { start: [start, 3], end: [end, 3] };
  return new Batch(gl, shader, gl.TRIANGLE_STRIP, pairs.length, attributes, { instances: pairs.length });
}

/** Balls from points and their colours. */
function balls(gl, shader, points, colours) {
  const position = Float32Array.from(points.flat());
  const tint = Float32Array.from(colours.flat());
  return new Batch(gl, shader, gl.POINTS, points.length, { position: [position, 3], tint: [tint, 3] });
}
