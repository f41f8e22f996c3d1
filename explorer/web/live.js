// @ts-check
// The page that travels: sliders, the polynomials of `explorer/export/fitted.py`, and what is drawn from them.
(() => {
  const {clamp, fixed, signed, lerp, roundedPair, soon} = Common, painters = {};
  const one = name => document.querySelector(name), all = name => [...document.querySelectorAll(name)];
  // The inset is that of the page.
  window.RX = /** @type {any} */ ({
    part: name => one(`[data-part=${name}]`), paint(name, draw) { painters[name] = draw; },
  });
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const unpack = ({low, step, data}) =>
    Float32Array.from(new Uint16Array(bytes(data).buffer), count => low + step * count);

  function begin() {
    const model = JSON.parse(document.getElementById('model').textContent);
    const {handles, exponents, power, doubt, digits, unit, inset, disk} = model, {radii, azimuths, root} = disk;
    const points = radii * azimuths, flow = unpack(disk.flow), stall = unpack(disk.stall);
    const margin = Uint8Array.from(flow, value => clamp(Math.round(128 + 1270 * value), 1, 255));
    const tables = disk.fields.map(({table}) => unpack(table));
    const sliders = all('.slider input'), canvas = one('canvas'), tabs = all('[data-field]');
    let field = 0;

    const terms = values => exponents.map(powers => powers.reduce((product, order, k) =>
      product * ((values[k] - handles[k].centre) / handles[k].half) ** order, 1));
    const sum = (coefficients, of) => coefficients.reduce((total, each, k) => total + each * of[k], 0);
    const spread = (rows, of) => Math.hypot(...rows.map(row => sum(row, of)));
    const over = (table, of) => {
      const values = new Float32Array(points);
      for (let k = 0, n = 0; n < table.length; k++)
        for (let point = 0; point < points; point++, n++) values[point] += of[k] * table[n];
      return values;
    };
    const shared = terms(handles.map(handle => handle.shared));

    // Where values are zero, as lines between neighbours; none where there is no flow to speak of.
    function outline(values) {
      const at = (i, j) => {
        const r = 100 * lerp(root, 1, i / (radii - 1)), psi = 2 * Math.PI * j / azimuths;
        return `${(r * Math.sin(psi)).toFixed(1)} ${(r * Math.cos(psi)).toFixed(1)}`;
      };
      let path = '';
      for (let i = 0; i < radii - 1; i++) for (let j = 0; j < azimuths; j++) {
        const corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        const of = corners.map(([row, column]) => row * azimuths + column % azimuths);
        if (of.some(k => flow[k] < disk.clear)) continue;
        const cut = corners.flatMap(([row, column], k) => {
          const [a, b] = [values[of[k]], values[of[(k + 1) % 4]]], share = a / (a - b), next = corners[(k + 1) % 4];
          return a > 0 === b > 0 ? [] : [at(lerp(row, next[0], share), lerp(column, next[1], share))];
        });
        for (let k = 0; k + 1 < cut.length; k += 2) path += `M${cut[k]}L${cut[k + 1]}`;
      }
      return path;
    }
    function paintDisk(of) {
      const {low, high, map, void: open} = disk.fields[field];
      const levels = Uint8Array.from(over(tables[field], of), value =>
        Math.round(1 + 254 * clamp((value - low) / (high - low), 0, 1)));
      const numbers = {radii, azimuths, values: levels, flow: open ? margin : null, map, none: disk.none};
      window.rotorDisk.fill(canvas, numbers, root, Math.min(canvas.clientWidth * devicePixelRatio, 900));
      one('path.stall').setAttribute('d', outline(over(stall, of)));
    }
    function paintInset(values, of) {
      const knots = [0, ...inset.breaks.map(k => values[k]), 1], bent = inset.knots.map(row => sum(row, of));
      const straight = r => {
        const k = Math.max(1, knots.findIndex(knot => r <= knot));
        return lerp(bent[k - 1], bent[k], (r - knots[k - 1]) / (knots[k] - knots[k - 1]));
      };
      const {length} = inset.r, places = [...inset.r, ...inset.cuts.map(({r}) => r)];
      const angles = inset.twist.map((row, k) => sum(row, of) + straight(places[k]) - straight(.75));
      const cuts = inset.cuts.map((cut, k) => ({...cut, theta: angles[length + k]}));
      painters.inset({...inset, theta: angles.slice(0, length), cuts});
    }
    const banded = (size, within) => `${size}\u00a0±\u00a0${within}\u00a0${unit}`;
    const write = (name, words) => { one(name).textContent = words; };
    function paint() {
      const values = sliders.map(slider => Number(slider.value)), of = terms(values);
      const total = sum(power.total, of), change = total - sum(power.total, shared);
      const band = spread(doubt.power, of), least = band < 10 ? 1 : 0;
      const within = Math.max(Math.hypot(spread(doubt.change, of), doubt.error), doubt.least);
      const shown = roundedPair(Math.abs(change), within, doubt.words, doubt.decimals);
      const {word, decimals} = shown, none = !shown.change;
      const size = banded(fixed(shown.change, decimals), fixed(shown.band, decimals));
      const against = none ? 'as much as the shared design'
        : `${size} ${change > 0 ? 'more' : 'less'} than as shared, ${word}`;
      const words = handles.map((handle, k) => (handle.sign ? signed : fixed)(values[k], handle.digits));
      const line = model.line.map(([text, k]) => k === null ? text : words[k]).join('');
      const takes = banded(fixed(total, digits), fixed(band, Math.max(digits, least)));
      write('h1', `${line} needs ${takes}${none ? '' : `: ${against}`}.`);
      write('[data-live=total]', `${fixed(total, digits)} ${unit}`);
      write('[data-live=band]', `± ${fixed(band, Math.max(digits, least))}`);
      write('[data-live=change]', against[0].toUpperCase() + against.slice(1));
      const kind = none || word === 'unclear' ? 'dim' : change > 0 ? 'more' : 'less';
      one('[data-live=change]').className = `change ${kind}`;
      for (const row of all('tr[data-part]')) {
        const now = sum(power[row.dataset.part], of), more = now - sum(power[row.dataset.part], shared);
        row.cells[1].textContent = fixed(now, digits);
        row.cells[2].textContent = Number(fixed(Math.abs(more), decimals)) ? signed(more, decimals) : '';
        one(`[data-bar=${row.dataset.part}]`).style.width = `${Math.max(0, 100 * now / model.longest)}%`;
      }
      sliders.forEach((slider, k) => {
        const output = slider.parentElement.querySelector('output');
        output.textContent = `${words[k]} ${output.dataset.unit}`;
        slider.setAttribute('aria-valuetext', output.textContent);
      });
      tabs.forEach((tab, k) => tab.setAttribute('aria-pressed', String(k === field)));
      all('[data-scale]').forEach((scale, k) => { scale.hidden = k !== field; });
      paintDisk(of);
      paintInset(values, of);
    }
    const again = soon(paint);
    for (const slider of sliders) slider.addEventListener('input', again);
    tabs.forEach((tab, k) => tab.addEventListener('click', () => { field = k; again(); }));
    for (const button of all('[data-to]')) button.addEventListener('click', () => {
      sliders.forEach((slider, k) => { slider.value = handles[k][button.dataset.to]; });
      again();
    });
    for (const name of ['resize', 'beforeprint']) addEventListener(name, again);
    paint();
  }
  addEventListener('DOMContentLoaded', begin);
})();
