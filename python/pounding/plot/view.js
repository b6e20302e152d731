// The view of a report: plain WebGL 2, no other file. Drag turns, Shift-drag moves, the wheel zooms.
"use strict";
(() => {
const holder = document.getElementById("view");
const data = JSON.parse(document.getElementById("view-data").textContent);
const make = (name, parent, set = {}) => parent.appendChild(Object.assign(document.createElement(name), set));

function unpack(text, Type) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  return new Type(bytes.buffer);
}

const style = `#view{border:1px solid #bbb}#view canvas{width:100%;height:30em;display:block;background:#fff;cursor:grab}
#view canvas.gaps{height:9em;border-top:1px solid #ddd;cursor:pointer}#view .scale{width:8em;height:.8em;margin:0 .4em;display:inline-block;
vertical-align:middle;background:linear-gradient(90deg,#440054,#21918c,#fde725)}
#view .bar{padding:.4em .6em;border-top:1px solid #ddd;font-size:.85em;display:flex;flex-wrap:wrap;gap:.3em 1em;align-items:center}
#view .swatch{display:inline-block;width:.9em;height:.9em;margin:0 .3em;vertical-align:-.1em}`;
make("style", document.head, {textContent: style});
const canvas = make("canvas", holder);
const gl = canvas.getContext("webgl2", {antialias: true, preserveDrawingBuffer: true});
if (!gl) {
  holder.textContent = "This browser shows no WebGL 2: look at the .xdmf files in ParaView.";
  return;
}

const points = unpack(data.points, Float32Array);
const count = points.length / 3;
const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
points.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
const size = Math.hypot(...low.map((x, d) => high[d] - x)) || 1;
const modes = data.modes.map((mode) => ({...mode, values: unpack(mode.values, Int16Array)}));
const motion = data.motion.times ? {...data.motion, values: unpack(data.motion.values, Int16Array)} : null;
const components = ["N", "Vy", "Vz", "T", "My", "Mz"].filter((name) => data.members.some((beam) => beam.values[name]));

const state = {turn: -0.9, tilt: 0.35, zoom: 1, shift: [0, 0], show: "model", time: 0, playing: false, factor: 1, colours: true,
  force: ""};
const still = () => state.show === "model";
const clock = () => {  // of the motion [s]
  const last = motion.times.length - 1, before = Math.min(Math.floor(state.time), Math.max(last - 1, 0));
  const after = Math.min(before + 1, last);
  return motion.times[before] + (state.time - before) * (motion.times[after] - motion.times[before]);
};

function program(vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.bindAttribLocation(made, 0, "place");
  gl.bindAttribLocation(made, 1, "moved");
  gl.linkProgram(made);
  return made;
}
const shading = program(`#version 300 es
in vec3 place, moved; uniform mat4 view; uniform float factor, large, nearer, most; out vec3 at; out float share;
void main() { at = place + factor * moved; share = most > 0.0 ? min(length(moved) / most, 1.0) : -1.0; gl_Position = view * vec4(at, 1.0); gl_Position.z -= nearer; gl_PointSize = large; }`,
`#version 300 es
precision highp float; in vec3 at; in float share; uniform vec3 colour, eye; uniform bool lit; out vec4 seen;
void main() { float light = lit ? 0.55 + 0.45 * abs(dot(normalize(cross(dFdx(at), dFdy(at))), eye)) : 1.0;
vec3 low = vec3(0.267, 0.0, 0.329), middle = vec3(0.129, 0.569, 0.549), high = vec3(0.992, 0.906, 0.145);
vec3 own = share < 0.0 ? colour : share < 0.5 ? mix(low, middle, 2.0 * share) : mix(middle, high, 2.0 * share - 1.0);
seen = vec4(own * light, 1.0); }`);
const where = Object.fromEntries(["view", "factor", "large", "nearer", "most", "colour", "eye", "lit"].map(
  (name) => [name, gl.getUniformLocation(shading, name)]));

function buffer(target, values, use = gl.STATIC_DRAW) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, values, use);
  return made;
}
function attribute(place, values, use) {
  const made = buffer(gl.ARRAY_BUFFER, values, use);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
  return made;
}
const placeBuffer = attribute(0, points);
const moved = new Float32Array(points.length);
const movedBuffer = attribute(1, moved, gl.DYNAMIC_DRAW);
const rgb = (text) => [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16) / 255);
const indices = (text) => {
  const values = unpack(text, Uint32Array);
  return {length: values.length, buffer: buffer(gl.ELEMENT_ARRAY_BUFFER, values)};
};
const groups = data.groups.map((group) => ({...group, on: true, rgb: rgb(group.colour),
  triangles: indices(group.triangles), edges: indices(group.edges), lines: indices(group.lines), dots: indices(group.dots)}));
const marks = data.marks.map((mark) => ({...mark, on: true, rgb: rgb(mark.colour), nodes: indices(mark.nodes)}));

// Displacements of the frame, mode or model at hand [m]; modes: the largest is 1.
function move() {
  moved.fill(0);
  if (state.show === "motion" && motion) {
    const last = motion.times.length - 1, at = Math.min(Math.max(state.time, 0), last);
    const before = Math.min(Math.floor(at), Math.max(last - 1, 0)), part = at - before, after = Math.min(before + 1, last);
    const scale = motion.largest / 32767;
    for (let i = 0; i < moved.length; ++i) {
      const a = motion.values[before * moved.length + i], b = motion.values[after * moved.length + i];
      moved[i] = scale * (a + part * (b - a));
    }
  } else if (state.show.startsWith("mode ")) {
    const mode = modes[Number(state.show.slice(5))], phase = Math.cos(2 * Math.PI * state.time) / 32767;
    for (let i = 0; i < moved.length; ++i) moved[i] = phase * mode.values[i];
  }
  gl.bindBuffer(gl.ARRAY_BUFFER, movedBuffer);
  gl.bufferSubData(gl.ARRAY_BUFFER, 0, moved);
}

// Diagrams of the forces of the beams that were recorded, as triangles, and the largest value at either end now.
const diagram = gl.createBuffer();
function forces() {
  const places = [], shown = {value: 0, name: "", ever: false}, of = motion && state.show === "motion";
  let most = 0;
  const beams = data.members.filter((beam) => beam.values[state.force]);
  for (const beam of beams) for (const end of beam.values[state.force]) most = Math.max(most, Math.abs(end.largest));
  for (const beam of beams) {
    const ends = beam.nodes.map((node) => [0, 1, 2].map((d) => points[3 * node + d] + state.factor * moved[3 * node + d]));
    const way = ["Vy", "Mz"].includes(state.force) ? beam.y : beam.z;
    const values = beam.values[state.force].map((end) => of && end.at ? end.at[Math.round(state.time)] : end.largest);
    if (!of || !beam.values[state.force].every((end) => end.at)) shown.ever = true;
    for (const value of values) if (Math.abs(value) > Math.abs(shown.value)) Object.assign(shown, {value, name: beam.name});
    const tips = ends.map((end, i) => end.map((x, d) => x + 0.12 * size * way[d] * values[i] / (most || 1)));
    for (const corner of [ends[0], ends[1], tips[1], ends[0], tips[1], tips[0]]) places.push(...corner);
  }
  return {places: new Float32Array(places), ...shown};
}
function drawForces() {
  const {places} = forces();
  gl.bindBuffer(gl.ARRAY_BUFFER, diagram);
  gl.bufferData(gl.ARRAY_BUFFER, places, gl.DYNAMIC_DRAW);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.disableVertexAttribArray(1);
  gl.vertexAttrib3f(1, 0, 0, 0);
  gl.uniform1f(where.most, 0);
  gl.uniform1f(where.nearer, 6e-3);
  gl.uniform1i(where.lit, 0);
  gl.uniform3fv(where.colour, rgb("#c2410c"));
  gl.drawArrays(gl.TRIANGLES, 0, places.length / 3);
  gl.bindBuffer(gl.ARRAY_BUFFER, placeBuffer);
  gl.vertexAttribPointer(0, 3, gl.FLOAT, false, 0, 0);
  gl.enableVertexAttribArray(1);
}

// Gap of a contact now [mm]: that of the picture's curve at the time or just before; at rest the first.
function gapNow(gap) {
  const time = state.show === "motion" ? clock() : -Infinity;
  let i = 0;
  while (i + 1 < gap.times.length && gap.times[i + 1] <= time) ++i;
  return gap.gap[i];
}

// Orthographic: right, up and towards the eye, of a turn about the vertical and a tilt.
function axes() {
  const [c, s, ct, st] = [Math.cos(state.turn), Math.sin(state.turn), Math.cos(state.tilt), Math.sin(state.tilt)];
  return [[-s, c, 0], [-c * st, -s * st, ct], [c * ct, s * ct, st]];
}
// Middle and half of what the model takes along an axis of the picture [m].
function extent(axis) {
  let least = Infinity, most = -Infinity;
  for (let i = 0; i < points.length; i += 3) {
    const x = axis[0] * points[i] + axis[1] * points[i + 1] + axis[2] * points[i + 2];
    least = Math.min(least, x);
    most = Math.max(most, x);
  }
  return {middle: (least + most) / 2, half: Math.max((most - least) / 2, 1e-3 * size)};
}
// The canvas as tall as the picture of the model asks for, within bounds.
function shape() {
  const [right, up] = axes();
  const tall = canvas.clientWidth * extent(up).half / extent(right).half;
  canvas.style.height = `${Math.round(Math.min(Math.max(tall, 240), 0.62 * Math.max(window.innerHeight, 480)))}px`;
}
function draw() {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(canvas.clientWidth * ratio);
  canvas.height = Math.round(canvas.clientHeight * ratio);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(1, 1, 1, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  gl.depthFunc(gl.LEQUAL);
  gl.useProgram(shading);
  const [right, up, eye] = axes();
  const [across, height] = [extent(right), extent(up)], aspect = canvas.width / canvas.height;
  const tall = 0.88 * state.zoom * Math.min(1 / height.half, aspect / across.half), wide = tall / aspect;
  const along = (axis, scale, shift, middle) => [...axis.map((x) => x * scale), shift - scale * middle];
  const rows = [along(right, wide, state.shift[0], across.middle), along(up, tall, state.shift[1], height.middle),
    along(eye, -0.5 / size, 0, extent(eye).middle), [0, 0, 0, 1]];
  gl.uniformMatrix4fv(where.view, false, [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column])));
  gl.uniform1f(where.factor, state.factor);
  gl.uniform3fv(where.eye, eye);
  const put = (list, kind, colour, nearer, dot) => {  // nearer: drawn before what it lies on
    if (list.length === 0) return;
    gl.uniform3fv(where.colour, colour);
    gl.uniform1i(where.lit, kind === gl.TRIANGLES ? 1 : 0);
    gl.uniform1f(where.nearer, nearer * 2e-3);
    gl.uniform1f(where.large, dot * ratio);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, list.buffer);
    gl.drawElements(kind, list.length, gl.UNSIGNED_INT, 0);
  };
  const most = state.colours && !still() ? (state.show === "motion" ? motion.largest : 1) : 0;
  gl.uniform1f(where.most, most);
  for (const group of groups.filter((one) => one.on)) {
    put(group.triangles, gl.TRIANGLES, group.rgb, 0, 1);
    put(group.edges, gl.LINES, group.rgb.map((x) => 0.6 * x), 1, 1);
    put(group.lines, gl.LINES, group.rgb.map((x) => 0.8 * x), 2, 1);
    put(group.dots, gl.POINTS, group.rgb.map((x) => 0.7 * x), 3, 7);
  }
  gl.uniform1f(where.most, 0);
  for (const mark of marks.filter((one) => one.on)) {
    const gap = data.gaps.find((one) => mark.name === `contact ${one.name}`);
    const closed = !gap || gapNow(gap) <= 0;
    put(mark.nodes, gl.POINTS, closed ? mark.rgb : rgb("#2f4f6f"), 4, closed ? 7 : 5);
  }
  if (state.force) drawForces();
}

// The gaps over time, and where the motion is.
const curves = data.gaps.length ? make("canvas", holder, {className: "gaps", title: "gaps over time: click for the instant"}) : null;
const first = Math.min(...data.gaps.map((gap) => gap.times[0])), end = Math.max(...data.gaps.map((gap) => gap.times.at(-1)));
function drawGaps() {
  if (!curves) return;
  const ratio = window.devicePixelRatio || 1, pen = curves.getContext("2d");
  curves.width = Math.round(curves.clientWidth * ratio);
  curves.height = Math.round(curves.clientHeight * ratio);
  pen.scale(ratio, ratio);
  const [width, height] = [curves.clientWidth, curves.clientHeight];
  const most = Math.max(...data.gaps.map((gap) => Math.max(...gap.gap))), least = Math.min(0, ...data.gaps.map((gap) => Math.min(...gap.gap)));
  const x = (time) => 50 + (width - 60) * (time - first) / (end - first || 1);
  const y = (gap) => height - 22 - (height - 44) * (gap - least) / (most - least || 1);
  pen.font = "12px sans-serif";
  pen.fillStyle = "#555";
  pen.fillText("gap [mm]", 4, 12);
  for (const value of [0, most]) pen.fillText(value.toPrecision(3), 4, y(value) + 4);
  pen.fillText(`${end.toPrecision(3)} s`, width - 44, height - 6);
  pen.strokeStyle = "#999";
  pen.strokeRect(50, y(0), width - 60, 0);
  data.gaps.forEach((gap, i) => {
    pen.strokeStyle = pen.fillStyle = gap.colour;
    pen.fillText(gap.name, 90 + 110 * i, 12);
    pen.beginPath();
    gap.times.forEach((time, k) => pen.lineTo(x(time), y(gap.gap[k])));
    pen.stroke();
  });
  if (state.show === "motion") {
    pen.strokeStyle = "#d01c1c";
    pen.strokeRect(x(clock()), 16, 0, height - 34);
  }
}
if (curves && motion) curves.onclick = (event) => {
  if (state.show !== "motion") show("motion");
  const time = first + (end - first) * (event.offsetX - 50) / (curves.clientWidth - 60);
  const after = motion.times.findIndex((one) => one >= time);
  state.time = after < 0 ? motion.times.length - 1 : after;
  state.playing = false;
  refresh();
};

// The bar under the picture.
const bar = make("div", holder, {className: "bar"});
const choice = make("select", bar, {title: "quantity shown"});
make("option", choice, {value: "model", textContent: "the model at rest"});
modes.forEach((mode, i) => make("option", choice, {value: `mode ${i}`, textContent: mode.name}));
if (motion) make("option", choice, {value: "motion", textContent: "the motion of the run"});
const play = make("button", bar, {textContent: "play"});
const strike = motion && Math.max(...motion.impulse) > 0 ? make("button", bar, {textContent: "strongest impact"}) : null;
const slider = make("input", bar, {type: "range", min: 0, max: 1, step: "any", value: 0, title: "time"});
const label = make("label", bar, {textContent: "amplified "});
const factor = make("input", label, {type: "number", min: 0, step: "any", style: "width:6em"});
for (const [name, turn, tilt] of [["from the side", -0.9, 0.35], ["plan", -Math.PI / 2, Math.PI / 2],
                                  ["elevation x-z", -Math.PI / 2, 0], ["elevation y-z", 0, 0]]) {
  make("button", bar, {textContent: name, onclick: () => {
    Object.assign(state, {turn, tilt, shift: [0, 0], zoom: 1});
    shape();
    draw();
  }});
}
const paint = make("label", bar);
make("input", paint, {type: "checkbox", checked: true, onchange: (event) => { state.colours = event.target.checked; refresh(); }});
paint.append("colours of displacement: 0");
make("span", paint, {className: "scale"});
const largest = make("span", paint);
const pick = make("select", bar, {title: "force diagram", hidden: components.length === 0});
make("option", pick, {value: "", textContent: "no force diagram"});
for (const name of components) make("option", pick, {value: name, textContent: `diagram of ${name}`});
pick.onchange = () => { state.force = pick.value; refresh(); };
const note = make("div", holder, {className: "bar"});
const legend = make("div", holder, {className: "bar"});
for (const item of [...groups, ...marks]) {
  const entry = make("label", legend);
  make("input", entry, {type: "checkbox", checked: true, onchange: (event) => { item.on = event.target.checked; draw(); }});
  make("span", entry, {className: "swatch", style: `background:${item.colour}`});
  entry.append(item.name);
}

function refresh() {
  move();
  draw();
  drawGaps();
  slider.value = state.time;
  for (const part of [play, slider, factor]) part.disabled = still();
  paint.hidden = still();
  largest.textContent = state.show === "motion" ? `${(1000 * motion.largest).toPrecision(3)} mm` : "largest";
  play.textContent = state.playing ? "stop" : "play";
  let text = data.sag > 0 ? `At rest under its weight, which moves it by ${(1000 * data.sag).toPrecision(3)} mm at most. ` : "At rest. ";
  text += "Drag to turn, Shift-drag to move, wheel to zoom.";
  if (state.show === "motion") {
    const frame = Math.round(state.time);
    text = `t = ${motion.times[frame].toFixed(4)} s; impulse since the frame before ${motion.impulse[frame].toPrecision(3)} N s` +
      (motion.stride > 1 ? ` (every frame counted, one in ${motion.stride} shown)` : "") + ". Displacements are those since the rest, relative to the ground" +
      (state.factor === 1 ? "." : `, times ${state.factor}: gaps are not amplified, so that parts seem to overlap where none do.`);
  } else if (!still()) {
    text = `Largest displacement drawn: ${state.factor} m. Signs and sizes of modes have no meaning.`;
  }
  if (data.gaps.length && (still() || state.show === "motion")) {
    text += ` Gaps: ${data.gaps.map((gap) => `${gap.name} ${gapNow(gap) <= 0 ? "closed" : `${gapNow(gap).toPrecision(3)} mm`}`).join(", ")}.`;
  }
  if (state.force) {
    const {value, name, ever} = forces(), unit = "TM".includes(state.force[0]) ? "kN m" : "kN";
    text += ` ${state.force}: ${(value / 1000).toPrecision(3)} ${unit} in ${name}${ever ? ", of the largest of the samples" : ""}.`;
  }
  note.textContent = text;
}
const round = (value) => Number(value.toPrecision(1));
function show(name) {
  state.show = name;
  state.time = 0;
  state.playing = false;
  state.factor = name === "motion" ? Math.max(1, round(0.04 * size / (motion.largest || 1))) : round(0.06 * size);
  choice.value = name;
  factor.value = state.factor;
  slider.max = name === "motion" ? motion.times.length - 1 : 1;
  refresh();
}
let last = 0;
function run(now) {
  if (!state.playing) return;
  const passed = Math.min(0.1, (now - last) / 1000);
  last = now;
  const frames = state.show === "motion" ? motion.times.length - 1 : 1;
  state.time += state.show === "motion" ? passed * Math.max(10, frames / 20) : passed / 1.5;
  if (state.time > frames) state.time = 0;
  refresh();
  requestAnimationFrame(run);
}
choice.onchange = () => show(choice.value);
play.onclick = () => { state.playing = !state.playing; last = performance.now(); refresh(); requestAnimationFrame(run); };
slider.oninput = () => { state.time = Number(slider.value); state.playing = false; refresh(); };
factor.onchange = () => { state.factor = Number(factor.value) || 0; refresh(); };
if (strike) strike.onclick = () => { show("motion"); state.time = motion.strongest; refresh(); };

let held = null;
canvas.onpointerdown = (event) => { held = [event.clientX, event.clientY]; canvas.setPointerCapture(event.pointerId); };
canvas.onpointerup = () => { held = null; };
canvas.onpointermove = (event) => {
  if (!held) return;
  const [dx, dy] = [event.clientX - held[0], event.clientY - held[1]];
  held = [event.clientX, event.clientY];
  if (event.shiftKey) {
    state.shift[0] += 2 * dx / canvas.clientWidth;
    state.shift[1] -= 2 * dy / canvas.clientHeight;
  } else {
    state.turn -= 0.008 * dx;
    state.tilt = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, state.tilt + 0.008 * dy));
  }
  draw();
};
canvas.style.touchAction = "none";
canvas.onwheel = (event) => { event.preventDefault(); state.zoom *= Math.exp(-0.001 * event.deltaY); draw(); };
window.addEventListener("resize", () => { shape(); draw(); drawGaps(); });
shape();
show("model");

// For tests: what is drawn, as the part of the picture that is not white, how much of its width and height that takes, and a
// sum by which pictures differ.
window.poundingView = {state, show, strike, refresh, forces, modes: modes.length, frames: motion ? motion.times.length : 0, nodes: count,
  picture() {
    draw();
    const pixels = new Uint8Array(4 * canvas.width * canvas.height);
    gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let drawn = 0, sum = 0;
    const columns = new Set(), lines = new Set();
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i] + pixels[i + 1] + pixels[i + 2] < 765) {
        ++drawn;
        columns.add(i / 4 % canvas.width);
        lines.add(Math.floor(i / 4 / canvas.width));
      }
      sum = (sum * 31 + pixels[i] + 7 * pixels[i + 1] + 13 * pixels[i + 2]) % 2147483647;
    }
    const span = (places, whole) => (Math.max(...places) - Math.min(...places)) / whole;
    return {part: drawn / (canvas.width * canvas.height), across: span(columns, canvas.width), tall: span(lines, canvas.height), sum, error: gl.getError()};
  }};
})();
