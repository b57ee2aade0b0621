// Drawing with WebGL 2: one triangle per disc and one quad per line, like the shaders of Talus.

const commonShader = `#version 300 es
precision highp float;
uniform vec2 size;     // size of the picture, px
uniform vec3 camera;   // px per D; origin of the bed, px from the left and from the top
uniform vec2 turn;     // cosine and sine of the clockwise turn
uniform vec3 period;   // length of the bed and shift of this copy, D; alpha beyond the edges
uniform float ratio;   // px of the canvas per px of the page
vec2 project(vec2 p) { return camera.yz + camera.x * vec2(turn.x * p.x + turn.y * p.y, turn.y * p.x - turn.x * p.y); }
float alongBed(vec2 px) {
  vec2 q = (px - camera.yz) / camera.x;
  return turn.x * q.x + turn.y * q.y;
}
vec4 place(vec2 px) { return vec4(px.x / size.x * 2.0 - 1.0, 1.0 - px.y / size.y * 2.0, 0.0, 1.0); }
float within(float x) { return x >= 0.0 && x <= period.x ? 1.0 : period.z; }
`;

const discVertex = `${commonShader}
in vec4 disc;
in vec4 fill;
in vec4 rim;
out vec2 offset;
out float along;
flat out float radius;
flat out float hatched;
flat out vec4 fillColour;
flat out vec4 rimColour;
void main() {
  vec2 corner = gl_VertexID == 0 ? vec2(0.0, -2.0) : vec2(gl_VertexID == 1 ? -1.7320508 : 1.7320508, 1.0);
  radius = camera.x * disc.z;
  hatched = disc.w;
  offset = corner * (radius + 0.5);
  vec2 px = project(disc.xy + vec2(period.y, 0.0)) + offset;
  along = alongBed(px);
  fillColour = vec4(fill.rgb * fill.a, fill.a);
  rimColour = vec4(rim.rgb * rim.a, rim.a);
  gl_Position = place(px);
}`;

const discFragment = `${commonShader}
in vec2 offset;
in float along;
flat in float radius;
flat in float hatched;
flat in vec4 fillColour;
flat in vec4 rimColour;
out vec4 colour;
float coverage(float r, float distance) { return clamp(r - distance + 0.5, 0.0, 1.0); }
float hatch() {
  float period = max(0.8 * radius, 3.0 * ratio);
  float across = (gl_FragCoord.x - gl_FragCoord.y) * 0.70710678;
  return clamp(0.15 * period - abs(fract(across / period) - 0.5) * period + 0.5, 0.0, 1.0);
}
void main() {
  float distance = length(offset);
  float outer = coverage(radius, distance);
  float inner = coverage(radius - min(0.18 * radius, 2.0 * ratio), distance);
  if (hatched > 0.5) inner *= 1.0 - hatch();
  colour = (inner * fillColour + (outer - inner) * rimColour) * within(along);
}`;

const lineVertex = `${commonShader}
in vec4 ends;
in float halfWidth;
in vec4 look;
out vec2 at;
out float along;
flat out float lineLength;
flat out float reach;
flat out vec4 ink;
void main() {
  vec2 from = project(ends.xy + vec2(period.y, 0.0));
  vec2 way = project(ends.zw + vec2(period.y, 0.0)) - from;
  lineLength = length(way);
  vec2 direction = lineLength > 0.0 ? way / lineLength : vec2(1.0, 0.0);
  reach = max(camera.x * halfWidth, 0.35 * ratio);
  ink = vec4(look.rgb * look.a, look.a);
  float border = reach + 0.5;
  at.x = (gl_VertexID & 1) == 0 ? -border : lineLength + border;
  at.y = (gl_VertexID >> 1) == 0 ? -border : border;
  vec2 px = from + at.x * direction + at.y * vec2(-direction.y, direction.x);
  along = alongBed(px);
  gl_Position = place(px);
}`;

const lineFragment = `${commonShader}
in vec2 at;
in float along;
flat in float lineLength;
flat in float reach;
flat in vec4 ink;
out vec4 colour;
void main() {
  float distance = length(vec2(at.x - clamp(at.x, 0.0, lineLength), at.y));
  colour = ink * clamp(reach - distance + 0.5, 0.0, 1.0) * within(along);
}`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(`WebGL: ${gl.getProgramInfoLog(made)}`);
  return made;
}

/** Creates the instances of one kind: a vertex array over buffers, each with its attributes. */
function instances(gl, used, buffers) {
  const vertices = gl.createVertexArray(), made = [];
  gl.bindVertexArray(vertices);
  for (const { bytes, attributes } of buffers) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    let offset = 0;
    for (const [name, count, type] of attributes) {
      const location = gl.getAttribLocation(used, name);
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, count, type, type === gl.UNSIGNED_BYTE, bytes, offset);
      gl.vertexAttribDivisor(location, 1);
      offset += count * (type === gl.FLOAT ? 4 : 1);
    }
    made.push(buffer);
  }
  return { vertices, buffers: made };
}

function fill(gl, kind, arrays) {
  arrays.forEach((array, k) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, kind.buffers[k]);
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.DYNAMIC_DRAW);
  });
}

/** Returns a drawer for a canvas; null if WebGL 2 is unavailable. */
function webglDrawer(canvas) {
  const gl = canvas.getContext("webgl2", { antialias: false, alpha: true, premultipliedAlpha: true, preserveDrawingBuffer: true });
  if (!gl) return null;
  const discs = program(gl, discVertex, discFragment), lines = program(gl, lineVertex, lineFragment);
  const discKind = instances(gl, discs, [
    { bytes: 16, attributes: [["disc", 4, gl.FLOAT]] },
    { bytes: 8, attributes: [["fill", 4, gl.UNSIGNED_BYTE], ["rim", 4, gl.UNSIGNED_BYTE]] },
  ]);
  const lineKind = instances(gl, lines, [
    { bytes: 20, attributes: [["ends", 4, gl.FLOAT], ["halfWidth", 1, gl.FLOAT]] },
    { bytes: 4, attributes: [["look", 4, gl.UNSIGNED_BYTE]] },
  ]);
  let lineCount = 0;

  const drawKind = (used, kind, mode, vertices, count, ratio) => {
    gl.useProgram(used);
    gl.bindVertexArray(kind.vertices);
    const at = (name) => gl.getUniformLocation(used, name);
    gl.uniform2f(at("size"), canvas.width, canvas.height);
    gl.uniform3f(at("camera"), camera.scale * ratio, camera.originX * ratio, camera.originY * ratio);
    gl.uniform2f(at("turn"), Math.cos(camera.turn), Math.sin(camera.turn));
    gl.uniform1f(at("ratio"), ratio);
    for (const shift of shifts) {
      gl.uniform3f(at("period"), bed.length, shift, bed.periodic ? faded : 1);
      gl.drawArraysInstanced(mode, 0, vertices, count);
    }
  };
  return {
    name: "WebGL 2",
    set(shapes) {
      fill(gl, discKind, [shapes.discs, shapes.looks]);
      fill(gl, lineKind, [shapes.lines.numbers, shapes.lines.colours]);
      lineCount = shapes.lines.count;
    },
    draw(ratio) {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      drawKind(discs, discKind, gl.TRIANGLES, 3, bed.grains, ratio);
      if (lineCount > 0) drawKind(lines, lineKind, gl.TRIANGLE_STRIP, 4, lineCount, ratio);
    },
  };
}
