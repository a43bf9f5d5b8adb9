"use strict";
// A solid that turns, by three.js: arrays of report/pages/page_solid.py, and what is shown of them.
const crackColours = [null, [0.0, 0.447, 0.698], [0.835, 0.369, 0.0]]; // by mode: tension, shear, as in page.css
const fragmentColours = {
    "0": [0.87, 0.84, 0.78], "x": [0.25, 0.25, 0.27], "-": [0.95, 0.95, 0.95],
    "1": [0.55, 0.75, 0.86], "2": [0.93, 0.70, 0.62], "3": [0.70, 0.84, 0.60], "4": [0.80, 0.70, 0.88],
    "5": [0.96, 0.85, 0.50], "6": [0.60, 0.80, 0.75], "7": [0.90, 0.72, 0.82],
};
const rock = [0.82, 0.78, 0.71];
const never = 255, noJoint = 255;
// viridis, in five steps
const stressColours = [[0.27, 0.00, 0.33], [0.23, 0.32, 0.55], [0.13, 0.57, 0.55], [0.37, 0.79, 0.38], [0.99, 0.91, 0.14]];

function mixed(colours, part) {
    const at = Math.min(part * (colours.length - 1), colours.length - 1.001), low = Math.floor(at);
    return colours[low].map((one, i) => one + (at - low) * (colours[low + 1][i] - one));
}

// Reads arrays one after the other.
class Reader {
    constructor(bytes) { this.bytes = bytes; this.at = 0; }
    plain(count) { this.at += count; return this.bytes.subarray(this.at - count, this.at); }
    // whole numbers of seven bits a byte, of either sign
    varints(count) {
        const found = new Int32Array(count);
        for (let i = 0; i < count; ++i) {
            let value = 0, shift = 0, byte;
            do {
                byte = this.bytes[this.at++];
                value += (byte & 127) * 2 ** shift;
                shift += 7;
            } while (byte & 128);
            found[i] = value % 2 ? -(value + 1) / 2 : value / 2;
        }
        return found;
    }
    sums(count) { // those that are told by their growth
        const found = this.varints(count);
        for (let i = 1; i < count; ++i) found[i] += found[i - 1];
        return found;
    }
}

async function inflated(text) {
    const packed = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

function arraysOf(view, bytes) {
    const { vertices, faces, grains, positions } = view.counts, read = new Reader(bytes);
    const [x, y, z] = [0, 1, 2].map(() => read.sums(vertices));
    const sizes = read.plain(faces);
    const corners = read.sums(sizes.reduce((sum, one) => sum + one, 0));
    const first = read.sums(faces), second = read.varints(faces).map((one, i) => one + first[i]);
    const time = read.plain(faces), mode = read.plain(faces), joint = read.plain(faces), stress = read.plain(grains);
    const letters = read.plain(grains * positions).slice();
    for (let i = grains; i < letters.length; ++i) letters[i] ^= letters[i - grains];
    return { x, y, z, sizes, corners, first, second, time, mode, joint, stress, letters };
}

// Triangles of all faces, each with corners of its own, and the edges of faces that crack or lie on a joint.
function meshesOf(view, arrays) {
    const longest = Math.max(...view.size), middle = view.size.map((one) => 0.5 * one / longest);
    const place = (v) => [arrays.x[v], arrays.y[v], arrays.z[v]].map((one, i) => one / view.counts.steps - middle[i]);
    const points = [], face = [], lines = [], lineFace = [];
    const centres = new Float32Array(3 * view.counts.grains), met = new Float32Array(view.counts.grains);
    let at = 0;
    arrays.sizes.forEach((size, f) => {
        const corners = [...arrays.corners.subarray(at, at + size)].map(place);
        at += size;
        for (let k = 1; k + 1 < size; ++k) {
            points.push(...corners[0], ...corners[k], ...corners[k + 1]);
            face.push(f);
        }
        for (const grain of [arrays.first[f], arrays.second[f]]) {
            if (grain < 0) continue;
            for (const one of corners) for (let i = 0; i < 3; ++i) centres[3 * grain + i] += one[i];
            met[grain] += size;
        }
        if (arrays.time[f] === never && arrays.joint[f] === noJoint) return;
        corners.forEach((one, k) => {
            lines.push(...one, ...corners[(k + 1) % size]);
            lineFace.push(f);
        });
    });
    for (let g = 0; g < met.length; ++g) for (let i = 0; i < 3; ++i) centres[3 * g + i] /= met[g] || 1;
    return { points: new Float32Array(points), face, lines: new Float32Array(lines), lineFace, centres };
}

class SolidView {
    constructor(view, arrays) {
        Object.assign(this, { view, arrays });
        this.mesh = meshesOf(view, arrays);
        this.jointColours = view.colours.map((one) => [1, 3, 5].map((at) => parseInt(one.slice(at, at + 2), 16) / 255));
        this.element = document.getElementById(`${view.name}-canvas`);
        this.renderer = new THREE.WebGLRenderer({ canvas: this.element, antialias: true, preserveDrawingBuffer: true });
        this.renderer.setPixelRatio(window.devicePixelRatio);
        this.renderer.setSize(640, 640, false);
        this.renderer.setClearColor(0xffffff);
        this.scene = new THREE.Scene();
        this.camera = new THREE.PerspectiveCamera(30, 1, 0.05, 20);
        this.camera.up.set(0, 0, 1);
        this.camera.position.set(1.1, -2.1, 1.0);
        this.scene.add(new THREE.AmbientLight(0xffffff, 0.55));
        const light = new THREE.DirectionalLight(0xffffff, 0.6);
        light.position.set(0.4, -0.8, 0.7);
        this.camera.add(light);
        this.scene.add(this.camera);
        this.fill();
        this.controls = new THREE.OrbitControls(this.camera, this.element);
        this.controls.addEventListener("change", () => this.draw());
        const part = (name) => document.getElementById(`${view.name}-${name}`);
        this.inputs = { show: part("show"), colour: part("colour"), axis: part("axis"), cut: part("cut") };
        for (const one of Object.values(this.inputs)) one.addEventListener("input", () => this.update());
        const slider = document.getElementById(`${view.map}-slider`);
        slider.addEventListener("input", () => { this.now = Number(slider.value); this.update(); });
        this.now = Number(slider.value);
        this.update();
    }

    fill() {
        const { points, lines } = this.mesh;
        this.colours = new Float32Array(points.length);
        const solid = this.faces = new THREE.BufferGeometry();
        solid.setAttribute("position", new THREE.BufferAttribute(points, 3));
        solid.setAttribute("color", new THREE.BufferAttribute(this.colours, 3));
        solid.computeVertexNormals();
        const material = new THREE.MeshLambertMaterial({
            vertexColors: THREE.VertexColors, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
        });
        const traces = this.traces = new THREE.BufferGeometry();
        this.lineColours = new Float32Array(lines.length);
        traces.setAttribute("position", new THREE.BufferAttribute(lines, 3));
        traces.setAttribute("color", new THREE.BufferAttribute(this.lineColours, 3));
        this.scene.add(new THREE.Mesh(solid, material));
        // the outside, pale around joints
        const around = this.around = new THREE.BufferGeometry();
        around.setAttribute("position", solid.getAttribute("position"));
        this.scene.add(new THREE.Mesh(around, new THREE.MeshBasicMaterial({
            color: 0x6b6455, transparent: true, opacity: 0.1, side: THREE.DoubleSide, depthWrite: false,
        })));
        this.scene.add(new THREE.LineSegments(traces, new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors })));
    }

    // Whether a grain lies on the side of the cut that is shown, with the section to the eye at first.
    before(grain) {
        if (grain < 0 || this.axis < 0) return grain >= 0;
        const beyond = this.mesh.centres[3 * grain + this.axis] - this.away;
        return this.axis === 1 ? beyond >= 0 : beyond <= 0;
    }

    grainColour(grain) {
        if (this.by === "stress") return mixed(stressColours, this.arrays.stress[grain] / 255);
        if (this.by === "fragment")
            return fragmentColours[String.fromCharCode(this.arrays.letters[this.now * this.view.counts.grains + grain])] || rock;
        return rock;
    }

    update() {
        const { arrays, mesh } = this, longest = Math.max(...this.view.size);
        this.axis = "xyz".indexOf(this.inputs.axis.value);
        this.inputs.cut.disabled = this.axis < 0;
        const side = this.axis < 0 ? 1 : this.view.size[this.axis] / longest;
        this.away = (Number(this.inputs.cut.value) / 100 - 0.5) * side;
        this.by = this.inputs.colour.value;
        const alone = this.inputs.show.value, whole = alone === "faces", byJoint = this.by === "joint", index = [];
        const cracked = (f) => arrays.time[f] <= this.now && arrays.time[f] !== never;
        const state = Array.from(arrays.sizes, (_, f) => {
            const a = this.before(arrays.first[f]), b = this.before(arrays.second[f]);
            const on = this.jointColours[arrays.joint[f]], broken = cracked(f) ? crackColours[arrays.mode[f]] || rock : null;
            if (alone === "cracks") return a || b ? (byJoint && broken && on) || broken : null;
            if (alone === "joints") return on && (a || b) ? (!byJoint && broken) || on : null;
            if (a === b) return null; // within, or cut away
            const grain = a ? arrays.first[f] : arrays.second[f];
            if (byJoint) return on || rock;
            return cracked(f) && this.by === "mode" ? crackColours[arrays.mode[f]] || rock : this.grainColour(grain);
        });
        mesh.face.forEach((f, t) => {
            if (!state[f]) return;
            index.push(3 * t, 3 * t + 1, 3 * t + 2);
            for (let k = 0; k < 3; ++k) this.colours.set(state[f], 9 * t + 3 * k);
        });
        this.faces.setIndex(new THREE.BufferAttribute(new Uint32Array(index), 1));
        this.faces.attributes.color.needsUpdate = true;
        const outside = [];
        if (alone === "joints") mesh.face.forEach((f, t) => {
            if (arrays.second[f] < 0 && this.before(arrays.first[f])) outside.push(3 * t, 3 * t + 1, 3 * t + 2);
        });
        this.around.setIndex(new THREE.BufferAttribute(new Uint32Array(outside), 1));
        const drawn = [];
        mesh.lineFace.forEach((f, e) => {
            const on = this.jointColours[arrays.joint[f]];
            if (!whole || !(on || cracked(f)) || !(this.before(arrays.first[f]) || this.before(arrays.second[f]))) return;
            drawn.push(2 * e, 2 * e + 1);
            const colour = on && (byJoint || !cracked(f)) ? on : crackColours[arrays.mode[f]] || rock;
            for (let k = 0; k < 2; ++k) this.lineColours.set(colour, 6 * e + 3 * k);
        });
        this.traces.setIndex(new THREE.BufferAttribute(new Uint32Array(drawn), 1));
        this.traces.attributes.color.needsUpdate = true;
        this.draw();
    }

    draw() { this.renderer.render(this.scene, this.camera); }
}

// The library stands in the page deflated, a third of its size.
async function load() {
    const script = document.createElement("script");
    script.textContent = new TextDecoder().decode(await inflated(document.getElementById("three").textContent));
    document.head.append(script);
}

const views = {};
let loading;
async function turn(view) {
    const missing = document.getElementById(`${view.name}-missing`);
    const say = (why) => { missing.textContent = `${why}: see the pictures below.`; missing.hidden = false; };
    if (!document.getElementById("three")) return say("No 3D view, because libjs-three was not installed when this page was made");
    if (!window.DecompressionStream) return say("No 3D view, because this browser cannot inflate its arrays");
    const test = document.createElement("canvas");
    if (!(test.getContext("webgl") || test.getContext("experimental-webgl"))) return say("No 3D view, because this browser has no WebGL");
    document.getElementById(`${view.name}-shown`).hidden = false;
    loading = loading || load();
    await loading;
    views[view.name] = new SolidView(view, arraysOf(view, await inflated(view.data)));
}
drawn.views.forEach(turn);
