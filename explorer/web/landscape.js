// The landscape of power: balls roll along what the search recorded, the blade beside them twists along.
(() => {
  const {text, part} = RX, page = document.documentElement, LASTS = 6000;
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  const viewer = () => window.__viserMutable, lerp = (a, b, t) => a + (b - a) * t;
  let now = null, at = 1, begun = 0, running = false, shown = '';

  const rounds = () => Math.max(1, ...now.balls.map(one => one.points.length - 1));
  function roll(t) {
    at = t;
    const nodes = viewer()?.nodePoseData, step = t * rounds();
    for (const ball of now.balls) {
      const u = Math.min(step, ball.points.length - 1), k = Math.min(Math.floor(u), ball.points.length - 2);
      const position = k < 0 ? ball.points[0] : ball.points[k].map((v, j) => lerp(v, ball.points[k + 1][j], u - k));
      if (nodes) nodes[ball.node] = {wxyz: [1, 0, 0, 0], position, poseUpdateState: 'needsUpdate'};
    }
    bend(step);
    viewer()?.requestRender?.();
    const slider = part('landscape').querySelector('input'), word = part('landscape').querySelector('output');
    if (slider && document.activeElement !== slider || running) slider.value = t;
    if (word) word.textContent = `round ${Math.round(step)} of ${rounds()}`;
  }
  // The sections of the blade turned to their twist, rounds in between straight.
  function bend(step) {
    const {node, points, outward, rings, angles} = now.blade, u = Math.min(step, angles.length - 1), k = Math.max(0, Math.min(Math.floor(u), angles.length - 2));
    const angle = angles.length < 2 ? angles[0] : angles[k].map((v, j) => lerp(v, angles[k + 1][j], u - k)), last = rings.length - 1;
    viewer()?.nodeRefFromName?.[node]?.traverse?.(mesh => {
      const place = mesh.geometry?.attributes?.position, size = (rings.length + 2) * points + 2;
      if (!mesh.isMesh || place?.count !== size) return;
      const put = (to, ring, [y, z]) => { const c = Math.cos(angle[ring]), s = Math.sin(angle[ring]); place.setXYZ(to, outward[ring], y * c - z * s, y * s + z * c); };
      rings.forEach((one, ring) => one.forEach((p, j) => put(ring * points + j, ring, p)));
      for (let j = 0; j < points; j++) { put(rings.length * points + j, 0, rings[0][j]); put((rings.length + 1) * points + j, last, rings[last][j]); }
      [0, last].forEach((ring, j) => put(size - 2 + j, ring, [0, 1].map(i => rings[ring].reduce((sum, p) => sum + p[i], 0) / points)));
      place.needsUpdate = true;
      mesh.geometry.computeVertexNormals();
    });
  }
  function tick(time) {
    if (!running || !now) return;
    const t = Math.min((time - begun) / LASTS, 1);
    roll(t);
    if (t < 1) requestAnimationFrame(tick); else { running = false; buttons(); }
  }
  function play() {
    if (calm.matches) return roll(1);
    running = true;
    begun = performance.now() - (at < .999 ? at * LASTS : 0);
    buttons();
    requestAnimationFrame(tick);
  }
  const buttons = () => { const button = part('landscape').querySelector('[data-roll]'); if (button) { button.innerHTML = RX.icon(running ? 'pause' : 'play'); button.ariaLabel = running ? 'Stop the replay' : 'Replay the search in 6 s'; } };

  RX.paint('landscape', next => {
    const card = part('landscape');
    page.toggleAttribute('data-landscape', Boolean(next));
    card.hidden = !next;
    now = next;
    if (!next) { running = false; shown = ''; card.innerHTML = ''; return; }
    card.innerHTML = `<div class="rxl-head"><b>Power above the least</b> <span class="rxf-dim">% of ${text(next.least)}</span></div>
      <div class="rxl-grad" style="background:linear-gradient(90deg,${next.colours.join()})"></div>${Charts.bar(next.ticks)}
      <p class="rxl-water" title="${text(next.each)}"><i></i>${text(next.water)}</p><p class="rxl-words"><b>${text(next.words)}</b></p>
      ${next.balls.length ? `<div class="rxf-row rxf-turn"><button data-roll title="Replay the search in 6 s"></button><input type="range" min="0" max="1" step="0.001" value="1" aria-label="Replay of the search"><output class="rxf-num"></output></div>` : ''}
      <p class="rxf-dim">${text(next.note)}</p>`;
    buttons();
    // A search that is new here is played once its nodes are there; another label or theme plays nothing.
    const key = JSON.stringify(next.balls.map(one => one.powers));  // A finer map moves them a little: no reason to begin again.
    const fresh = key !== shown && next.balls.length;
    shown = key;
    const wait = tries => {
      if (now !== next) return;
      const nodes = viewer()?.nodeRefFromName ?? {};
      if (tries && ![...next.balls, next.blade].every(one => nodes[one.node])) return requestAnimationFrame(() => wait(tries - 1));
      if (fresh) { at = 1; play(); } else roll(at);
    };
    if (fresh) running = false;
    wait(600);
  });
  document.addEventListener('input', event => {
    if (!event.target.matches?.('.rxl-card input')) return;
    running = false;
    roll(Number(event.target.value));
    buttons();
  });
  document.addEventListener('click', event => {
    const near = event.target instanceof Element && event.target.closest('[data-roll]');
    if (!near || !RX.state) return;
    if (running) { running = false; buttons(); } else play();
  });

  RX.landscape = {get at() { return at; }, get running() { return running; }};
})();
