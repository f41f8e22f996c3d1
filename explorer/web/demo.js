// The stand-alone demo: sliders through a computed sweep of twist and speed.
(() => {
  const data = JSON.parse(document.getElementById('demo-data').textContent), $ = id => document.getElementById(`demo-${id}`);
  const box = document.getElementById('demo'), twist = $('twist'), speed = $('speed'), status = box.querySelector('[role=status]');
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer;
  const faces = new Uint32Array(bytes(data.faces)), edges = new Uint32Array(bytes(data.edges));
  const floats = text => new Float32Array(bytes(text)), shape = floats(data.shape), [rings, points] = data.rings;
  const jig = data.jig.map(floats), flown = {};
  const images = {}, viewer = () => window.__viserMutable, node = name => viewer()?.nodeRefFromName?.[name];
  const minus = text => String(text).replace('-', '−'), total = point => point.power.reduce((sum, part) => sum + part, 0);
  const at = (s, t) => data.points[s][t];
  let psi = Math.PI / 5, playing = false, before = 0, calm = 0, shown = null;

  const pose = (name, [wxyz, position]) => { viewer().nodePoseData[name] = {wxyz, position, poseUpdateState: 'needsUpdate'}; };

  // After the rings come those of root and tip once more, and the centres of both.
  const ringOf = [...Array(rings).keys(), 0, rings - 1].flatMap(ring => Array(points).fill(ring)).concat(0, rings - 1);
  const turned = pitch => {
    const vertices = new Float32Array(shape);
    for (let v = 0; v < shape.length / 3; v++) {
      const angle = pitch[ringOf[v]], cos = Math.cos(angle), sin = Math.sin(angle), y = shape[3 * v + 1], z = shape[3 * v + 2];
      vertices[3 * v + 1] = y * cos - z * sin;
      vertices[3 * v + 2] = y * sin + z * cos;
    }
    return vertices;
  };
  // Harmonics 1, cos ψ, sin ψ, cos 2ψ, … of the pitch of each ring.
  const pitchAt = (waves, angle) => Array.from({length: rings}, (_, ring) => {
    let sum = waves[ring];
    for (let row = 1; row < waves.length / rings; row++) {
      const n = Math.ceil(row / 2);
      sum += waves[row * rings + ring] * (row % 2 ? Math.cos(n * angle) : Math.sin(n * angle));
    }
    return sum;
  });

  const shapeBlades = angle => {
    if (!shown) return;
    const [s, t] = shown.split(',').map(Number), point = at(s, t), waves = flown[shown] ??= floats(point.flown);
    for (let k = 0; k < point.motion.blades; k++)
      shapeBlade(k, turned(pitchAt(waves, angle + 2 * Math.PI * k / point.motion.blades)));
    viewer().requestRender?.();
  };
  const drawJig = t => {
    const vertices = turned(jig[t]);
    node(data.ghost)?.traverse?.(part => {
      const ends = part.geometry?.attributes?.instanceStart?.data;
      if (ends?.array?.length !== 3 * edges.length) return;
      edges.forEach((vertex, n) => { for (let i = 0; i < 3; i++) ends.array[3 * n + i] = vertices[3 * vertex + i]; });
      ends.needsUpdate = true;
    });
  };
  // A viewer keeps a mesh with shared corners, or one corner for each face: both are filled.
  const shapeBlade = (k, vertices) => {
    node(`/rotor/blade_${k}`)?.traverse?.(part => {
      const geometry = part.geometry, place = geometry?.attributes?.position;
      if (!part.isMesh || !place) return;
      if (place.array.length === vertices.length) place.array.set(vertices);
      else if (place.array.length === 3 * faces.length)
        faces.forEach((corner, n) => { for (let i = 0; i < 3; i++) place.array[3 * n + i] = vertices[3 * corner + i]; });
      else return;
      place.needsUpdate = true;
      geometry.computeVertexNormals();
      geometry.computeBoundingSphere();
    });
  };

  const picture = (s, t) => images[[s, t]] ??= new Promise(done => {
    const image = new Image();
    image.onload = () => done(image);
    image.src = `data:image/webp;base64,${at(s, t).disk}`;
  });
  const paint = async (s, t) => {
    const image = await picture(s, t);
    if (shown !== `${s},${t}`) return;
    node('/rotor/disk/field')?.traverse?.(part => {
      if (!part.isMesh || !part.material?.map) return;
      part.material.map.dispose();
      part.material.map.image = image;
      part.material.map.needsUpdate = true;
    });
    viewer().requestRender?.();
  };

  // `apart`: the first point, hover, has another inflow model, so no line leads to it.
  const chart = (svg, xs, ys, here, name, text, apart) => {
    const known = ys.filter(y => y !== null), low = 0.98 * Math.min(...known), high = 1.02 * Math.max(...known);
    const x = value => 34 + 262 * (value - xs[0]) / (xs.at(-1) - xs[0]), y = value => 80 - 70 * (value - low) / (high - low || 1);
    let path = '', pen = false;
    ys.forEach((value, k) => { if (value === null) pen = false; else { path += `${pen ? 'L' : 'M'}${x(xs[k]).toFixed(1)},${y(value).toFixed(1)}`; pen = !(apart && k === 0); } });
    svg.innerHTML = `<path d="M34,8V80H296" fill="none" stroke="#adb5bd"/><path d="${path}" fill="none" stroke="#1c7ed6" stroke-width="2"/>`
      + (apart && ys[0] !== null ? `<circle cx="${x(xs[0])}" cy="${y(ys[0])}" r="3" fill="#1c7ed6"/>` : '')
      + (ys[here] === null ? '' : `<circle cx="${x(xs[here])}" cy="${y(ys[here])}" r="4.5" fill="#e8590c"/>`)
      + `<text x="30" y="14" text-anchor="end">${high.toFixed(0)}</text><text x="30" y="80" text-anchor="end">${low.toFixed(0)}</text>`
      + `<text x="34" y="94">${text(xs[0])}</text><text x="296" y="94" text-anchor="end">${text(xs.at(-1))}</text>`
      + `<text x="165" y="98" text-anchor="middle">${name} · kW</text>`;
  };

  const show = () => {
    const t = Number(twist.value), s = Number(speed.value), point = at(s, t);
    const flight = data.speeds[s] ? `µ ${data.speeds[s].toFixed(3)}, ${data.knots[s].toFixed(0)} kt` : 'hover';
    box.querySelector('[for=demo-twist] b').textContent = `${minus(data.twists[t])}°`;
    box.querySelector('[for=demo-speed] b').textContent = flight;
    const row = data.points[s].map(one => one && total(one)), column = data.points.map(one => one[t] && total(one[t]));
    chart($('over-twist'), data.twists, row, t, data.label, value => `${minus(value)}°`);
    chart($('over-speed'), data.speeds, column, s, 'advance ratio', value => value || 'hover', data.speeds[0] === 0 && !data.joined);
    box.dataset.trimmed = Boolean(point);
    if (!point) {
      status.textContent = 'There is no trim with this twist at this speed. The picture is that of the last trim.';
      $('total').textContent = '–';
      $('change').textContent = '';
      return;
    }
    const power = total(point), least = Math.min(...row.filter(value => value !== null)), best = data.twists[row.indexOf(least)];
    $('total').textContent = `${power.toFixed(0)} kW`;
    $('change').textContent = power > 1.0005 * least ? `+${(100 * (power / least - 1)).toFixed(1)} % above the least` : power > least ? 'within 0.05 % of the least' : 'the least at this speed';
    status.textContent = `Least at this speed: ${minus(best)}°. Stalled: ${point.stall} % of the disk.`;
    const drawn = point.power.reduce((sum, part) => sum + Math.max(part, 0), 0);
    box.querySelector('.bar').innerHTML = point.power.map((part, k) => `<i style="width:${100 * Math.max(part, 0) / drawn}%;background:${data.parts[k][2]}"></i>`).join('');
    box.querySelector('.parts').innerHTML = point.power.map((part, k) =>
      `<span><i style="background:${data.parts[k][2]}"></i><em>${data.parts[k][1]}</em>${part.toFixed(0)}</span>`).join('');
    shown = `${s},${t}`;
    ['/rotor', '/rotor/disk', '/airframe'].forEach((name, k) => pose(name, point.poses[k]));
    shapeBlades(psi);
    drawJig(t);
    paint(s, t);
    rotorScene.move(point.motion);
    calm = performance.now() + 1500;
  };

  // The scene's script closes the gap to the azimuth it hears; at rest it is left alone, so that nothing is drawn.
  const tick = () => {
    const now = performance.now();
    if (playing) psi = (psi + data.rate * Math.min((now - before) / 1000, 0.5)) % (2 * Math.PI);
    before = now;
    if (playing || now < calm) rotorScene.turn(psi);
    else rotorScene.stop();
    if (playing) shapeBlades(rotorScene.psi);
  };

  const begin = () => {
    if (!node('/rotor/blade_0') || !node('/rotor/disk/field')) return setTimeout(begin, 100);
    rotorScene.dress(data.surfaces);
    show();
    setInterval(tick, 50);
    box.dataset.ready = 'true';
  };
  twist.max = data.twists.length - 1;
  speed.max = data.speeds.length - 1;
  [twist.value, speed.value] = data.opening;
  twist.oninput = speed.oninput = show;
  $('play').onclick = () => {
    playing = !playing;
    $('play').textContent = playing ? 'Pause' : 'Play';
    $('play').setAttribute('aria-pressed', playing);
    const point = at(Number(speed.value), Number(twist.value));
    if (playing && point) rotorScene.move(point.motion);
    else calm = performance.now() + 300;
  };
  box.querySelector('.dim').textContent = data.note;
  begin();
})();
