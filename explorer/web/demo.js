// The stand-alone demo: sliders through a computed sweep of twist and speed.
(() => {
  const data = JSON.parse(document.getElementById('demo-data').textContent), $ = id => document.getElementById(`demo-${id}`);
  const box = document.getElementById('demo'), twist = $('twist'), speed = $('speed'), status = box.querySelector('[role=status]');
  const rotor = window.stillRotor(data), {node, pose} = rotor, floats = rotor.floats, edges = rotor.edges;
  const jig = data.jig.map(floats);
  const minus = text => String(text).replace('-', '−'), total = point => point.power.reduce((sum, part) => sum + part, 0);
  const at = (s, t) => data.points[s][t];
  let psi = Math.PI / 5, playing = false, before = 0, calm = 0, shown = null;

  const shapeBlades = angle => {
    if (!shown) return;
    const [s, t] = shown.split(',').map(Number), point = at(s, t);
    rotor.shape('/rotor', point, angle);
  };
  const drawJig = t => {
    const vertices = rotor.turned(jig[t]);
    node(data.ghost)?.traverse?.(part => {
      const ends = part.geometry?.attributes?.instanceStart?.data;
      if (ends?.array?.length !== 3 * edges.length) return;
      edges.forEach((vertex, n) => { for (let i = 0; i < 3; i++) ends.array[3 * n + i] = vertices[3 * vertex + i]; });
      ends.needsUpdate = true;
    });
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
    rotor.paint('/rotor', point);
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
