// Numbers on the surface.

/** A digit on the screen, in pixels of the page. */
const DIGIT = [8, 14];
/** How much finer its picture is. */
const FINER = 4;

/** A texture of the digits from 0 to 9, side by side. */
function digitTexture(gl) {
  const [width, height] = DIGIT.map((length) => FINER * length);
  const canvas = Object.assign(document.createElement("canvas"), { width: 10 * width, height });
  const pen = canvas.getContext("2d");
  Object.assign(pen, {
    font: `600 ${0.86 * height}px system-ui, sans-serif`, textAlign: "center", textBaseline: "middle",
    strokeStyle: "#ffffff", lineWidth: 0.22 * height, lineJoin: "round", fillStyle: "#101820",
  });
  for (let digit = 0; digit < 10; ++digit) pen.strokeText(String(digit), (digit + 0.5) * width, 0.53 * height);
  for (let digit = 0; digit < 10; ++digit) pen.fillText(String(digit), (digit + 0.5) * width, 0.53 * height);
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, canvas);
  gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  return texture;
}

/** Labels with a number, a point, a normal there, and the room that each has, as a length. */
function numbersBatch(gl, shader, labels) {
  const position = [], normal = [], digit = [], room = [];
  for (const label of labels) {
    const text = String(label.number);
    [...text].forEach((one, k) => {
      position.push(...label.point);
      normal.push(...label.normal);
      digit.push(Number(one), k, text.length);
      room.push(label.room);
    });
  }
  const attributes = {
    position: [new Float32Array(position), 3], normal: [new Float32Array(normal), 3],
    digit: [new Float32Array(digit), 3], room: [new Float32Array(room), 1],
  };
  return new Batch(gl, shader, gl.TRIANGLE_STRIP, room.length, attributes, { instances: room.length });
}

/** The numbers of edges along the arcs of a layout, each at the middle of its arc. */
function arcLabels(arcs, at, normals) {
  return arcs.map((arc) => {
    const last = arc.length - 1, [a, b] = [arc[Math.floor(last / 2)], arc[Math.ceil(last / 2)]];
    const room = arc.slice(1).reduce((sum, v, k) => sum + norm(sub(at[v], at[arc[k]])), 0);
    return { number: last, point: meanOf([at[a], at[b]]), normal: unit(add(normals[a], normals[b])), room };
  });
}
