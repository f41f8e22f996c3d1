// @ts-check
// Blades shaped from the pitch of their rings, and disks coloured from numbers (`explorer/picture/disk_numbers.py`): by
// viser's own meshes and materials, which come and go, so that each is looked at before it is drawn.
(() => {
  const {viewer, node} = Common, forms = new Map(), disks = new Map();

  // The rings of an untwisted blade turned nose up, made smaller and moved. After the rings come those of root and tip
  // once more, and the centres of both.
  function formed(straight, [pitch, bent, size]) {
    const rings = pitch.length, points = (straight.length / 3 - 2) / (rings + 2), vertices = straight.slice();
    for (let v = 0, n = 0; n < straight.length; v++, n += 3) {
      const over = v - rings * points, first = over < points || over === 2 * points;
      const ring = over < 0 ? Math.floor(v / points) : first ? 0 : rings - 1, share = size?.[ring] ?? 1;
      const cos = share * Math.cos(pitch[ring]), sin = share * Math.sin(pitch[ring]);
      const [dx, dy, dz] = bent?.[ring] ?? [0, 0, 0];
      vertices[n] += dx;
      vertices[n + 1] = straight[n + 1] * cos - straight[n + 2] * sin + dy;
      vertices[n + 2] = straight[n + 1] * sin + straight[n + 2] * cos + dz;
    }
    return vertices;
  }
  // Whoever gives a mesh other vertices gives it straight ones.
  function shape({geometry}, form) {
    const {userData, attributes: {position}} = geometry;
    if (userData.shaped !== position.array) userData.straight = position.array;
    else if (userData.form === form) return;
    if (userData.straight.length % 3 || (userData.straight.length / 3 - 2) % (form[0].length + 2)) return;
    userData.form = form;
    userData.shaped = position.array = formed(userData.straight, form);
    position.needsUpdate = true;
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
  }

  const HEAD = `
    uniform sampler2D rxNumbers, rxPast, rxMap;
    uniform vec4 rxGrid;
    uniform vec3 rxMarked[5];
    uniform vec2 rxOpacity;
    uniform bool rxVoid, rxAbsent, rxReverse, rxDotted;
    uniform float rxClear;
    varying vec2 rxAt;
    const float TURN = 6.283185307;
    // In rows and columns of the numbers, which lie at whole ones.
    vec2 rxPlace(float r, float psi) {
      return vec2(psi / TURN * rxGrid.y, clamp((r - rxGrid.z) / (1. - rxGrid.z), 0., 1.) * (rxGrid.x - 1.));
    }
    vec4 rxRead(float r, float psi) { return texture2D(rxNumbers, (rxPlace(r, psi) + .5) / rxGrid.yx) * 255.; }
    float rxReadPast(float r, float psi) {
      return texture2D(rxPast, (rxPlace(r, psi) + .5) / rxGrid.yx).r * 255. - 128.;
    }
    // Of the four numbers about a place those that exist, and how much of the place they fill.
    vec2 rxPresent(float r, float psi) {
      vec2 place = rxPlace(r, psi), corner = floor(place), share = place - corner, sum = vec2(0.);
      for (int k = 0; k < 4; k++) {
        vec2 step = vec2(k & 1, k >> 1), part = mix(1. - share, share, step);
        float number = texture2D(rxNumbers, (corner + step + .5) / rxGrid.yx).r * 255.;
        if (number > .5) sum += part.x * part.y * vec2(number, 1.);
      }
      return vec2(sum.x / max(sum.y, 1e-3), sum.y);
    }
    vec3 rxLinear(vec3 c) { return mix(pow((c + .055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(.04045))); }
  `;
  // In the order of the marks: what comes later covers what came before. Lines are as wide everywhere: the distance is
  // the margin over its slope, and lines lie only where the margin changes sign.
  const BODY = `
    vec2 at = rxAt * rxGrid.w;
    float r = length(at), psi = atan(at.x, at.y), pixel = .7 * length(fwidth(at)), h = .006;
    vec4 here = rxRead(r, psi) - vec4(0., vec3(128.));
    vec3 outer = rxRead(r + h, psi).gba - 128., inner = rxRead(r - h, psi).gba - 128.;
    vec3 after = rxRead(r, psi + h / r).gba - 128., before = rxRead(r, psi - h / r).gba - 128.;
    vec3 along = outer - inner, around = after - before, slope = sqrt(along * along + around * around) / (2. * h);
    vec3 low = min(min(outer, inner), min(after, before)), high = max(max(outer, inner), max(after, before));
    vec3 width = max(vec3(.9, .8, 1.) * .0029, .6 * pixel), away = here.gba / max(slope, vec3(1e-3));
    vec3 line = 1. - smoothstep(width - .5 * pixel, width + .5 * pixel, abs(away));
    line *= step(low, vec3(-.001)) * step(vec3(.001), high);
    float clear = step(rxClear - 128., here.g);
    float present = 1., value = here.r;
    if (rxAbsent) { vec2 of = rxPresent(r, psi); value = of.x; present = step(.5, of.y); }
    if (rxVoid) present *= step(0., here.g);
    vec3 colour = texture2D(rxMap, vec2((value - 1.) / 254. * 255. / 256. + .5 / 256., .5)).rgb;
    colour = mix(rxMarked[4], colour, present);
    float opacity = rxOpacity.x;
    float stripes = (at.y - at.x) * 26., stripe = fract(stripes), soft = min(26. * 1.4 * pixel, .3);
    float hatched = smoothstep(0., soft, stripe) * (1. - smoothstep(.36, .36 + soft, stripe));
    hatched *= clear * clamp(.5 - away.g / pixel, 0., 1.) * present;
    colour = mix(colour, .2 * colour + .8 * rxMarked[0], hatched);
    opacity = mix(opacity, .98, hatched);
    if (rxDotted) {
      float past = rxReadPast(r, psi), pastOuter = rxReadPast(r + h, psi), pastInner = rxReadPast(r - h, psi);
      float pastAfter = rxReadPast(r, psi + h / r), pastBefore = rxReadPast(r, psi - h / r);
      float pastSlope = length(vec2(pastOuter - pastInner, pastAfter - pastBefore)) / (2. * h);
      float pastLow = min(min(pastOuter, pastInner), min(pastAfter, pastBefore));
      float pastHigh = max(max(pastOuter, pastInner), max(pastAfter, pastBefore));
      float dotted = 1. - smoothstep(width.g - .5 * pixel, width.g + .5 * pixel, abs(past) / max(pastSlope, 1e-3));
      dotted *= step(pastLow, -.001) * step(.001, pastHigh) * clear * step(fract(160. * (psi + r) / TURN), .45);
      colour = mix(colour, rxMarked[0], dotted);
      opacity = max(opacity, dotted);
    }
    line.g *= clear;
    line.b *= clear * step(fract((psi * 96. + 48. * 2. * r) / TURN), .58) * step(r, .995);
    colour = mix(mix(colour, rxMarked[0], line.g), rxMarked[3], line.b);
    opacity = max(opacity, max(line.g, line.b));
    if (rxReverse) {
      float back = clamp(.5 - away.r / pixel, 0., 1.);
      colour = mix(mix(colour, rxMarked[1], back), rxMarked[2], line.r);
      opacity = max(mix(opacity, .933, back), line.r);
    }
    opacity *= clamp((1. - r) / pixel + .5, 0., 1.) * clamp((r - rxGrid.z) / pixel + .5, 0., 1.) * rxOpacity.y;
    diffuseColor = vec4(rxLinear(colour), opacity);
  `;
  const LINEAR = 1006, REPEAT = 1000;  // Names of three.js.
  function texture(like, width, height) {
    const made = new like.constructor({data: new Uint8Array(4 * width * height), width, height});
    return Object.assign(made, {
      isDataTexture: true, generateMipmaps: false, flipY: false, magFilter: LINEAR, minFilter: LINEAR, wrapS: REPEAT,
      unpackAlignment: 1,
    });
  }
  function colour({material}, disk) {
    // The picture that the node has by itself gives the class of textures.
    if (!material?.map || !disk.numbers || !disk.ink) return;
    const {uniforms, numbers: {grid, clear, absent, reverse, texts, past, void: rxVoid}, ink} = disk;
    const [rows, columns] = grid;
    if (disk.changed) {
      disk.changed = false;
      uniforms.rxNumbers ??= {value: texture(material.map, columns, rows)};
      uniforms.rxPast ??= {value: texture(material.map, columns, rows)};
      uniforms.rxMap ??= {value: texture(material.map, 256, 1)};
      const {rxNumbers: {value: numbers}, rxPast: {value: dotted}, rxMap: {value: map}} = uniforms;
      texts.forEach((text, channel) => unpack(text, numbers.image.data, channel));
      unpack(past, dotted.image.data, 0);
      ink.map.match(/../g).forEach((digits, n) => {
        map.image.data[4 * Math.floor(n / 3) + n % 3] = parseInt(digits, 16);
      });
      numbers.needsUpdate = dotted.needsUpdate = map.needsUpdate = true;
      const values = {
        rxGrid: new Float32Array(grid), rxMarked: new Float32Array(ink.marked.flat()),
        rxOpacity: new Float32Array(ink.opacity), rxVoid, rxAbsent: absent, rxReverse: reverse, rxClear: clear,
        rxDotted: past !== null,
      };
      for (const [name, value] of Object.entries(values)) (uniforms[name] ??= {value}).value = value;
    }
    if (material.userData.disk === disk) return;
    material.userData.disk = disk;
    material.onBeforeCompile = shader => {
      Object.assign(shader.uniforms, uniforms);
      const varying = 'varying vec2 rxAt;\n', put = (text, name, more) => text.replace(`#include <${name}>`, more);
      // Columns of the picture run to starboard, its rows aft.
      shader.vertexShader = varying
        + put(shader.vertexShader, 'uv_vertex', '#include <uv_vertex>\nrxAt = vec2(2. * uv.x - 1., 1. - 2. * uv.y);');
      shader.fragmentShader = HEAD + put(shader.fragmentShader, 'map_fragment', BODY);
    };
    material.customProgramCacheKey = () => 'rxDisk';
    material.needsUpdate = true;
  }
  const numbersOf = text => text instanceof Uint8Array ? text : unpack(text, new Uint8Array(text.length), 0, 1);
  function unpack(text, data, channel, every = 4) {
    if (text === null) {  // Nothing is marked.
      for (let n = channel; n < data.length; n += every) data[n] = 255;
      return data;
    }
    for (let k = 0, n = channel, number = 0; k < text.length; k++, n += every) {
      const step = text.charCodeAt(k) - 35;
      data[n] = number = (number + (step & 1 ? -(step + 1) / 2 : step / 2)) & 255;
    }
    return data;
  }

  const meshes = (name, use) => node(name)?.traverse?.(part => { if (part.isMesh && part.geometry) use(part); });
  function prepare() {
    for (const [name, form] of forms) {
      const own = node(name)?.children?.find(part => part.isMesh);
      if (own) shape(own, form);
    }
    for (const [root, disk] of disks) meshes(`${root}/disk/field`, mesh => colour(mesh, disk));
  }
  let hooked = null;
  function change() {
    const {scene} = viewer(), before = scene?.onBeforeRender;
    if (scene && scene !== hooked) scene.onBeforeRender = (...all) => { before.apply(scene, all); prepare(); };
    hooked = scene ?? null;
    viewer().requestRender?.();
  }
  const diskOf = root => disks.get(root) ?? disks.set(root, {uniforms: {}}).get(root);
  window.rotorDisk = {
    form(wanted) {
      for (const [name, form] of Object.entries(wanted)) forms.set(name, form);
      change();
    },
    ink(root, ink) { Object.assign(diskOf(root), {ink, changed: true}); },
    paint(root, numbers) {
      Object.assign(diskOf(root), {numbers, changed: true});
      change();
    },
    // A plan without a graphics card, so many pixels wide, as the shader does it: linear between the numbers.
    fill(canvas, {radii, azimuths, values, flow, map, none}, root, pixels) {
      const size = Math.round(pixels), [field, back] = [values, flow].map(text => text && numbersOf(text));
      const colours = (map + none).match(/../g).map(digits => parseInt(digits, 16)), VOID = 256;
      const picture = new ImageData(size, size), {data} = picture;
      canvas.width = canvas.height = size;
      for (let row = 0, n = 0; row < size; row++) for (let column = 0; column < size; column++, n += 4) {
        const x = (2 * column + 1) / size - 1, y = (2 * row + 1) / size - 1, r = Math.hypot(x, y);
        const covered = Math.min((1 - r) * size / 2 + .5, (r - root) * size / 2 + .5, 1);
        if (covered <= 0) continue;
        const along = Math.min(Math.max((r - root) / (1 - root), 0), 1) * (radii - 1);
        const around = (Math.atan2(x, y) / (2 * Math.PI) + 1) % 1 * azimuths;
        const i = Math.min(Math.floor(along), radii - 2), j = Math.floor(around), k = (j + 1) % azimuths;
        const u = along - i, v = around - j, corners = [i * azimuths + j, i * azimuths + k];
        let sum = 0, present = 0, margin = 0;
        for (let corner = 0; corner < 4; corner++) {
          const at = corners[corner & 1] + (corner >> 1) * azimuths;
          const part = (corner & 1 ? v : 1 - v) * (corner >> 1 ? u : 1 - u);
          if (field[at]) { sum += part * field[at]; present += part; }
          if (back) margin += part * (back[at] - 128);
        }
        const shade = 3 * (present < .5 || margin < 0 ? VOID : Math.round((sum / present - 1) / 254 * 255));
        for (let channel = 0; channel < 3; channel++) data[n + channel] = colours[shade + channel];
        data[n + 3] = 255 * covered;
      }
      canvas.getContext('2d').putImageData(picture, 0, 0);
    },
    // What is drawn, as numbers that are other than before when it changes.
    drawn(root) { return disks.get(root)?.uniforms.rxNumbers?.value; },
  };
})();
